#include "console.h"
#include "core/errors.h"
#include "core/text.h"
#include "image/image_io.h"
#include "options.h"
#include "scene/load.h"
#include "scene/vary.h"
#include "study/ffmpeg.h"
#include "study/inputs.h"
#include "study/sweep/estimate.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <set>
#include <system_error>

namespace slicelens::cli {

namespace {

namespace fs = std::filesystem;

/// What to render and where to, checked as a whole before the first frame.
struct Animation {
  SceneText text;
  std::vector<Variation> variations;
  std::size_t frames = 0;
  bool loop = false;
  fs::path folder; ///< of the frames
  fs::path video;  ///< empty: none, the frames are all
};

bool is_folder(const std::string& output) {
  std::error_code error;
  return output.back() == '/' || fs::is_directory(output, error);
}

SceneInput changed(const SceneText& text, const std::vector<KeyValue>& more) {
  std::vector<KeyValue> changes = text.changes;
  changes.insert(changes.end(), more.begin(), more.end());
  SceneInput input = text.input;
  input.scene = scene_from_json(text.text, text.input.source, changes);
  return input;
}

SceneInput frame_input(const Animation& animation, std::size_t index) {
  return changed(animation.text,
                 changes_at(animation.variations, time_of_frame(index, animation.frames, animation.loop)));
}

std::vector<KeyValue> end_values(const std::vector<Variation>& variations, bool last) {
  std::vector<KeyValue> changes;
  for (const Variation& variation : variations)
    changes.push_back({variation.key, last ? variation.to : variation.from});
  return changes;
}

/// Tries one end of all variations together, since only together they may make sense; what fails alone as
/// well is to blame. Gives the scene.
Scene try_end(const SceneText& text, const std::vector<Variation>& variations, bool last) {
  try {
    return changed(text, end_values(variations, last)).scene;
  } catch (const UsageError& together) {
    for (const Variation& variation : variations) {
      try {
        changed(text, end_values({variation}, last));
      } catch (const UsageError& alone) {
        throw UsageError("--vary " + variation.key + "=" + variation.from + ":" + variation.to + ": " +
                         alone.what());
      }
    }
    throw;
  }
}

std::vector<Variation> variations_of(const SceneText& text, const std::vector<std::string>& vary) {
  std::vector<Variation> variations;
  for (const std::string& word : vary)
    variations.push_back(parse_variation(word));
  const Scene first = try_end(text, variations, false);
  try_end(text, variations, true);
  for (Variation& variation : variations)
    variation.whole = is_whole_key(first, variation.key);
  return variations;
}

/// Other frames can fail where single ends do not: keys that vary together, say.
void check_frames(const Animation& animation, double rate) {
  std::optional<std::array<std::size_t, 2>> size;
  for (std::size_t i = 0; i < animation.frames; ++i) {
    RenderSettings render;
    try {
      render = frame_input(animation, i).scene.render;
    } catch (const UsageError& error) {
      throw UsageError("frame " + std::to_string(i) + ": " + error.what());
    }
    if (animation.video.empty())
      continue;
    if (size && *size != render.size)
      throw UsageError("render.size varies, but the frames of a video have one size; give a folder with -o");
    if (!size)
      check_video(animation.video, render.size, rate);
    size = render.size;
    if (render.background.a < 1) {
      throw UsageError("render.background: a video has no transparency; set its last number to 1, or give a "
                       "folder with -o");
    }
  }
}

Animation animation_of(const AnimateOptions& options) {
  if (options.output.empty())
    throw UsageError("-o is empty; give a name that ends in .mp4, .gif or /");
  Animation animation;
  animation.frames = options.frames;
  animation.loop = options.loop;
  animation.folder = options.output;
  if (!is_folder(options.output)) {
    animation.video = options.output;
    animation.folder += ".frames";
    check_video(animation.video, {2, 2}, options.fps); // its name, before the scene is read
  }
  std::set<std::string> keys;
  for (const std::string& text : options.vary) {
    if (!keys.insert(parse_variation(text).key).second)
      throw UsageError("--vary " + text + ": this key varies already; give it once");
  }
  animation.text = scene_text(options.input, options.set);
  animation.variations = variations_of(animation.text, options.vary);
  check_frames(animation, options.fps);
  return animation;
}

void make_folder(const Animation& animation) {
  std::error_code error;
  const fs::path parent = animation.video.parent_path();
  if (!animation.video.empty() && !parent.empty() && !fs::is_directory(parent, error))
    throw FileError(animation.video.string(),
                    "the folder " + parent.string() + " does not exist; create it first");
  fs::create_directories(animation.folder, error);
  if (error || !fs::is_directory(animation.folder, error))
    throw FileError(animation.folder.string(), "cannot be made a folder for the frames: " + error.message());
}

using FileTime = fs::file_time_type;

/// When the newest of the files that warps, transfer function and camera come from was written: pictures hold
/// their names only.
FileTime newest_warp_file(const SceneInput& input) {
  std::vector<fs::path> files;
  const auto add = [&](const std::optional<std::string>& file, const char* key) {
    if (file)
      files.push_back(resolve_file(*file, input.folders, key));
  };
  add(input.scene.transfer.file, "transfer.file");
  add(input.scene.camera.file, "camera.file");
  for (const Warp& warp : input.scene.warp) {
    if (const auto* landmarks = std::get_if<Landmarks>(&warp)) {
      add(landmarks->file, "warp.file");
      add(landmarks->source, "warp.source");
      add(landmarks->target, "warp.target");
    } else if (const auto* field = std::get_if<Field>(&warp)) {
      add(field->file, "warp.file");
    }
  }
  FileTime newest = FileTime::min();
  for (const fs::path& file : files) {
    std::error_code error;
    const FileTime time = fs::last_write_time(file, error);
    if (error)
      throw FileError(file.string(), "cannot be read: " + error.message());
    newest = std::max(newest, time);
  }
  return newest;
}

/// Whether the file is this frame already. A damaged file is no frame; a whole picture that Slicelens did not
/// write is somebody's work and is refused.
bool is_rendered(const fs::path& file, const Scene& scene, const std::string& sha256, FileTime newest) {
  std::error_code error;
  if (!fs::exists(file, error))
    return false;
  std::map<std::string, std::string> metadata;
  try {
    metadata = read_metadata(file);
  } catch (const FileError&) {
    return false;
  }
  if (metadata.count("slicelens:version") == 0)
    throw FileError(file.string(), "is not a picture by slicelens and would be replaced; give another name "
                                   "with -o");
  const FileTime written = fs::last_write_time(file, error);
  return !error && written >= newest && metadata["slicelens:scene"] == scene_to_json(scene, -1) &&
         metadata["slicelens:version"] == SLICELENS_VERSION && metadata["slicelens:volume_sha256"] == sha256;
}

std::vector<std::size_t> missing_frames(const Animation& animation, const std::string& sha256) {
  const FileTime newest = newest_warp_file(animation.text.input);
  std::vector<std::size_t> missing;
  for (std::size_t i = 0; i < animation.frames; ++i) {
    if (!is_rendered(animation.folder / frame_name(i), frame_input(animation, i).scene, sha256, newest))
      missing.push_back(i);
  }
  return missing;
}

/// One context for all; the volume is read once.
void render_frames(const Animation& animation, const std::vector<std::size_t>& missing,
                   const std::string& sha256, const Progress& console) {
  std::set<std::string> said;
  const Progress progress = quiet(console, said);
  OpenContext context;
  std::optional<PreparedScene> prepared;
  Estimate estimate(console, "frame", missing.size());
  for (std::size_t done = 0; done < missing.size(); ++done) {
    const SceneInput input = frame_input(animation, missing[done]);
    if (prepared)
      load_again(*prepared, input, progress);
    else
      prepared = load(input, console);
    RenderResult result = render_with(context, *prepared, progress);
    add_metadata(result, prepared->scene, sha256);
    write_image(result.image, animation.folder / frame_name(missing[done]), PixelDepth::png8);
    estimate.step();
  }
}

} // namespace

void run_animate(const AnimateOptions& options) {
  const Animation animation = animation_of(options);
  std::future<std::string> hashing = start_hash(animation.text.input);
  const std::string sha256 = hashing.valid() ? hashing.get() : "";
  make_folder(animation);
  const std::vector<std::size_t> missing = missing_frames(animation, sha256);
  if (missing.size() < animation.frames) {
    std::fprintf(stderr, "%zu of %zu frames are there already\n", animation.frames - missing.size(),
                 animation.frames);
  }
  const Progress progress = console_progress();
  render_frames(animation, missing, sha256, progress);
  if (!animation.video.empty()) {
    report_progress(progress, "video", 1);
    write_video(animation.video, {animation.folder, animation.frames, options.fps});
  }
  end_progress();
  std::printf("%s\n", options.output.c_str());
}

} // namespace slicelens::cli
