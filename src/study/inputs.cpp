#include "study/inputs.h"

#include "core/errors.h"
#include "core/files.h"
#include "core/text.h"
#include "image/image_io.h"
#include "scene/image_scene.h"
#include "scene/load.h"
#include "scene/load_labels.h"
#include "scene/load_warps.h"
#include "scene/names.h"
#include "scene/scene_json.h"
#include "volume/kept_sha256.h"

#include <algorithm>
#include <system_error>
#include <utility>

namespace slicelens {

namespace fs = std::filesystem;

namespace {

std::vector<KeyValue> assignments(const std::vector<std::string>& set) {
  std::vector<KeyValue> changes;
  for (const std::string& text : set)
    changes.push_back(parse_assignment(text));
  return changes;
}

/// A path given on the command line counts from the current folder, one in a file from that file's folder;
/// the other place is tried second.
std::vector<fs::path> folders_for(const fs::path& home, const std::vector<KeyValue>& changes) {
  const bool from_command = std::any_of(changes.begin(), changes.end(), [](const KeyValue& c) {
    return c.key == "volume.file" || c.key == "volume.labels" ||
           (c.key.rfind("volumes", 0) == 0 && c.key.ends_with(".file"));
  });
  if (home.empty() || home == ".")
    return {"."};
  if (from_command)
    return {".", home};
  return {home, "."};
}

void require_hash(const SceneInput& input, const std::string& sha256) {
  if (input.expected_sha256.empty() || sha256.empty() || input.expected_sha256 == sha256)
    return;
  if (!input.scene.others.empty() || label_file(input.scene, input.folders))
    throw FileError(
        input.source,
        "one of its volumes is not the one that it was rendered from (SHA-256 " + sha256 + ", then " +
            input.expected_sha256 + "); name the right one with --set " +
            (input.scene.others.empty() ? "volume.file=… or volume.labels=…" : "volumes[0].file=…"));
  throw FileError(*input.scene.volume.file, "is not the volume that " + input.source +
                                                " was rendered from (SHA-256 " + sha256.substr(0, 12) +
                                                "…, then " + input.expected_sha256.substr(0, 12) +
                                                "…); name the right one with --set volume.file=…");
}

/// The names under which a picture keeps the hashes of what warps have read: those of the first volume, then
/// those of others.
std::vector<std::pair<std::string, const Warp*>> named_warps(const Scene& scene) {
  std::vector<std::pair<std::string, const Warp*>> list;
  const auto add = [&](const std::string& owner, const std::vector<Warp>& warps) {
    for (std::size_t i = 0; i < warps.size(); ++i)
      list.emplace_back("slicelens:" + owner + "warp" + std::to_string(i) + "_sha256", &warps[i]);
  };
  add("", scene.warp);
  for (std::size_t k = 0; k < scene.others.size(); ++k)
    add("volume" + std::to_string(k + 1) + "_", scene.others[k].warp);
  return list;
}

void require_warp_hashes(const SceneInput& input, const Scene& loaded) {
  for (const auto& [name, warp] : named_warps(loaded)) {
    const auto expected = input.expected_warp_sha256.find(name);
    const std::string hash = loaded_sha256(*warp);
    if (expected == input.expected_warp_sha256.end() || hash == expected->second)
      continue;
    throw FileError(input.source, "the files of its warp '" + kind_of(*warp) +
                                      "' have changed since it was rendered (SHA-256 " + hash.substr(0, 12) +
                                      "…, then " + expected->second.substr(0, 12) +
                                      "…); put the right ones there or name them with --set warp…");
  }
}

} // namespace

InputKind kind_of(const std::string& input) {
  const std::string extension = lower(fs::path(input).extension().string());
  if (extension == ".json")
    return InputKind::scene;
  static const std::vector<std::string> pictures = {".png", ".exr", ".tif", ".tiff", ".jpg", ".jpeg"};
  std::error_code error;
  if (std::find(pictures.begin(), pictures.end(), extension) != pictures.end() &&
      fs::is_regular_file(input, error))
    return InputKind::picture;
  return InputKind::volume;
}

SceneInput scene_text_input(const std::string& text, const std::string& source,
                            const std::vector<std::string>& set) {
  const std::vector<KeyValue> changes = assignments(set);
  return {scene_from_json(text, source, changes), folders_for("", changes), "", source};
}

namespace {

SceneText read_scene(const std::string& text, const std::string& source, const fs::path& home,
                     const std::vector<KeyValue>& changes) {
  return {text, changes, {scene_from_json(text, source, changes), folders_for(home, changes), "", source}};
}

SceneText scene_of_picture(const std::string& picture, const std::vector<KeyValue>& changes) {
  const auto metadata = read_metadata(picture);
  const auto scene = metadata.find("slicelens:scene");
  if (metadata.count("slicelens:image_scene") != 0)
    throw UsageError(picture + ": holds the scene of a picture; draw it again with slicelens lens");
  if (scene == metadata.end()) {
    throw UsageError(picture + ": this picture holds no Slicelens scene; to render an image stack give its "
                               "folder or a pattern such as slice_*.png");
  }
  SceneText result = read_scene(scene->second, picture, fs::path(picture).parent_path(), changes);
  const auto hash = metadata.find("slicelens:volume_sha256");
  const bool other_volume = std::any_of(changes.begin(), changes.end(),
                                        [](const KeyValue& c) { return c.key.rfind("volume", 0) == 0; });
  if (hash != metadata.end() && !other_volume)
    result.input.expected_sha256 = hash->second;
  const bool other_warp = std::any_of(changes.begin(), changes.end(), [](const KeyValue& c) {
    return c.key.rfind("warp", 0) == 0 || c.key.rfind("volumes", 0) == 0;
  });
  for (const auto& [name, warp] : named_warps(result.input.scene)) {
    const auto warp_hash = metadata.find(name);
    if (!other_warp && warp_hash != metadata.end())
      result.input.expected_warp_sha256[name] = warp_hash->second;
  }
  return result;
}

} // namespace

SceneText scene_text(const std::string& input, const std::vector<std::string>& set) {
  const std::vector<KeyValue> changes = assignments(set);
  if (kind_of(input) == InputKind::scene) {
    const std::string text = read_text(input);
    if (is_image_scene(text))
      throw UsageError(input + ": a scene of a picture; draw it with slicelens lens");
    return read_scene(text, input, fs::path(input).parent_path(), changes);
  }
  if (kind_of(input) == InputKind::picture)
    return scene_of_picture(input, changes);
  std::vector<KeyValue> with_file = {{"volume.file", input}};
  with_file.insert(with_file.end(), changes.begin(), changes.end());
  SceneText result = read_scene("{}", input, "", with_file);
  result.input.folders = {"."};
  return result;
}

SceneInput scene_input(const std::string& input, const std::vector<std::string>& set) {
  return scene_text(input, set).input;
}

std::future<std::string> start_hash(const SceneInput& input) {
  std::vector<std::vector<fs::path>> volumes; // the files of each
  bool any = false;
  for (std::size_t i = 0; i < volume_count(input.scene); ++i) {
    const VolumeSettings settings = scene_of_volume(input.scene, i).volume;
    volumes.push_back(settings.file ? files_of(source_of(settings, input.folders)) : std::vector<fs::path>{});
    any = any || settings.file;
  }
  if (const auto labels = label_file(input.scene, input.folders)) {
    volumes.push_back({*labels});
    any = true;
  }
  if (!any)
    return {};
  return std::async(std::launch::async, [volumes] {
    std::string hashes;
    for (const std::vector<fs::path>& files : volumes)
      hashes += (hashes.empty() ? "" : " ") + (files.empty() ? std::string("-") : sha256_of_volume(files));
    return hashes;
  });
}

PreparedScene load(const SceneInput& input, const Progress& progress, std::string* sha256,
                   std::future<std::string> hashing) {
  if (!hashing.valid() && (sha256 != nullptr || !input.expected_sha256.empty()))
    hashing = start_hash(input);
  Volume volume = load_volume(input.scene.volume, input.folders, progress, budget_of(input.scene));
  const std::string hash = hashing.valid() ? hashing.get() : "";
  require_hash(input, hash);
  if (sha256 != nullptr)
    *sha256 = hash;
  Scene scene = input.scene;
  load_camera_file(scene, input.folders, progress);
  load_transfer_file(scene.transfer, volume, input.folders, progress);
  TransferFunction transfer = transfer_of(scene, volume);
  load_warp_files(scene, input.folders, progress);
  require_warp_hashes(input, scene);
  std::optional<LoadedLabels> labels = load_labels(scene, volume, input.folders, progress);
  std::vector<LoadedVolume> others = load_others(scene, input.folders, progress);
  for (std::size_t i = 0; i < others.size(); ++i) // what load_others has read, and said what was to be said
    load_transfer_file(scene.others[i].transfer, others[i].volume, input.folders, {});
  return prepare(std::move(scene), std::move(volume), std::move(transfer), std::move(others),
                 std::move(labels));
}

void hold_voxels(SceneInput& input, const std::string& what) {
  const auto hold = [&](VolumeSettings& volume) {
    if (volume.access == VolumeAccess::stream || volume.access == VolumeAccess::cache)
      throw UsageError(what + " needs all voxels at once, which volume.access '" + word(volume.access) +
                       "' does not hold; set volume.access to memory");
    volume.access = VolumeAccess::memory;
    volume.cache.reset();
  };
  hold(input.scene.volume);
  for (auto& other : input.scene.others)
    hold(other.volume);
}

std::size_t checked_volume(const Scene& scene, int index) {
  if (index < 0 || static_cast<std::size_t>(index) >= volume_count(scene)) {
    throw UsageError("--volume " + std::to_string(index) + ": the scene has " +
                     std::to_string(volume_count(scene)) + " volume(s), counted from 0");
  }
  return static_cast<std::size_t>(index);
}

void load_again(PreparedScene& prepared, const SceneInput& input, const Progress& progress) {
  const auto text_of = [](const auto& section, auto Scene::*member) {
    Scene alone;
    alone.*member = section;
    return scene_to_json(alone, -1);
  };
  Scene scene = input.scene;
  const bool same_labels = prepared.labels.loaded && text_of(prepared.scene.volume, &Scene::volume) ==
                                                         text_of(scene.volume, &Scene::volume);
  bool same_warps = volume_count(prepared.scene) == volume_count(scene);
  const std::size_t had = prepared.others.size();
  prepared.others.resize(scene.others.size());
  for (std::size_t i = 0; i < volume_count(scene); ++i) {
    Scene now = scene_of_volume(scene, i);
    PreparedScene& one = i == 0 ? prepared : prepared.others[i - 1];
    const bool known = i <= had;
    const Scene before = known ? scene_of_volume(one.scene, 0) : Scene{};
    if (!known || text_of(before.volume, &Scene::volume) != text_of(now.volume, &Scene::volume))
      set_volume(one, load_volume(now.volume, input.folders, progress, budget_of(scene)));
    TransferSettings& transfer = i == 0 ? scene.transfer : scene.others[i - 1].transfer;
    load_transfer_file(transfer, one.volume, input.folders, progress);
    now.transfer = transfer;
    one.transfer = transfer_of(now, one.volume);
    same_warps = same_warps && text_of(before.warp, &Scene::warp) == text_of(now.warp, &Scene::warp);
  }
  if (same_warps) { // with what their files hold
    scene.warp = std::move(prepared.scene.warp);
    for (std::size_t i = 0; i < scene.others.size(); ++i)
      scene.others[i].warp = std::move(prepared.scene.others[i].warp);
  } else {
    load_warp_files(scene, input.folders, progress);
  }
  if (scene.render.mode == Mode::two_level) {
    if (same_labels)
      prepared.labels.loaded->transfers =
          load_label_transfers(scene, prepared.volume, input.folders, progress);
    else
      prepared.labels = {load_labels(scene, prepared.volume, input.folders, progress), {}, {}, {}};
  }
  load_camera_file(scene, input.folders, progress);
  prepared.scene = std::move(scene);
  prepare_again(prepared);
}

void open_context(OpenContext& context, const Scene& scene) {
  if (scene.render.pipeline == Pipeline::reference)
    return;
  const gl::Profile profile = profile_of(scene.render.pipeline);
  if (context.context && context.name == scene.render.context && context.profile == profile)
    return;
  context.context.reset();
  context.context.emplace(open_context_for(scene));
  context.name = scene.render.context;
  context.profile = profile;
}

RenderResult render_with(OpenContext& context, const PreparedScene& prepared, const Progress& progress) {
  if (prepared.scene.render.pipeline == Pipeline::reference)
    return render(prepared, nullptr, progress);
  open_context(context, prepared.scene);
  return render(prepared, &*context.context, progress);
}

void add_metadata(RenderResult& result, const Scene& scene, const std::string& sha256) {
  auto& metadata = result.image.metadata;
  metadata["slicelens:scene"] = scene_to_json(scene, -1);
  metadata["slicelens:version"] = SLICELENS_VERSION;
  metadata["slicelens:renderer"] = result.renderer;
  if (!result.version.empty())
    metadata["slicelens:gl_version"] = result.version;
  if (!result.context.empty())
    metadata["slicelens:context"] = result.context;
  if (!result.limits.empty())
    metadata["slicelens:gl_limits"] = result.limits;
  if (!sha256.empty())
    metadata["slicelens:volume_sha256"] = sha256;
  for (const auto& [name, warp] : named_warps(scene)) {
    const std::string hash = loaded_sha256(*warp);
    if (!hash.empty())
      metadata[name] = hash;
  }
}

} // namespace slicelens
