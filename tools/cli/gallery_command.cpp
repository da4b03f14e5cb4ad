#include "console.h"
#include "core/embedded.h"
#include "core/errors.h"
#include "core/files.h"
#include "image/image_io.h"
#include "image/pictures.h"
#include "lens_inputs.h"
#include "options.h"
#include "preset_sheet.h"
#include "render/lens_picture.h"
#include "scene/load.h"
#include "scene/load_warps.h"
#include "scene/names.h"
#include "scene/scene_json.h"
#include "study/axis_tables_page.h"
#include "study/gallery.h"
#include "study/inputs.h"

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <set>
#include <system_error>

namespace slicelens {

const std::vector<EmbeddedFile>& embedded_scenes(); // made at build time

namespace cli {

namespace {

namespace fs = std::filesystem;

/// A scene of the gallery and how a user names it.
struct GalleryScene {
  std::string name;
  std::string argument; ///< of `slicelens render` or `slicelens lens`
  SceneInput input;
  std::optional<ImageSceneInput> image; ///< instead, for a lens over a picture
};

/// What a gallery shows of a user's volume: the same data by each mode.
std::vector<GalleryScene> scenes_of_volume(const std::string& volume, const std::vector<std::string>& set) {
  const std::vector<std::pair<std::string, std::vector<std::string>>> views = {
      {"direct volume rendering", {"camera.azimuth=30", "camera.elevation=10"}},
      {"direct volume rendering, diffuse light",
       {"camera.azimuth=30", "camera.elevation=10", "render.shading=diffuse"}},
      {"perspective, diffuse light",
       {"camera.azimuth=-30", "camera.elevation=20", "camera.projection=perspective",
        "render.shading=diffuse"}},
      {"maximum intensity projection", {"render.mode=mip", "transfer.preset=grey-ramp"}},
      {"X-ray", {"render.mode=xray"}},
  };
  fs::path path = fs::path(volume).lexically_normal();
  if (!path.has_filename())
    path = path.parent_path();
  std::vector<GalleryScene> scenes;
  for (const auto& [title, changes] : views) {
    std::vector<std::string> all = {"title=" + path.filename().string() + ": " + title};
    all.insert(all.end(), changes.begin(), changes.end());
    std::string argument = "'" + volume + "'";
    for (const std::string& change : changes)
      argument += " --set " + change;
    for (const std::string& change : set)
      argument += " --set '" + change + "'";
    all.insert(all.end(), set.begin(), set.end());
    scenes.push_back({path.stem().string() + "_" + std::to_string(scenes.size() + 1),
                      argument,
                      scene_input(volume, all),
                      {}});
  }
  return scenes;
}

/// Makes the names fit for files and for links without escapes, and no two the same.
void name_files(std::vector<GalleryScene>& scenes) {
  std::set<std::string> taken;
  for (GalleryScene& scene : scenes) {
    for (char& c : scene.name) {
      if (static_cast<unsigned char>(c) < 0x80 && std::isalnum(static_cast<unsigned char>(c)) == 0 &&
          c != '-' && c != '.')
        c = '_';
    }
    const std::string name = scene.name;
    for (int n = 2; !taken.insert(scene.name).second; ++n)
      scene.name = name + "_" + std::to_string(n);
  }
}

std::vector<GalleryScene> scenes_of(const GalleryOptions& options) {
  std::vector<GalleryScene> scenes;
  if (options.inputs.empty()) {
    for (const EmbeddedFile& file : embedded_scenes()) {
      scenes.push_back({fs::path(file.name).stem().string(),
                        fs::path(file.name).stem().string() + ".json",
                        scene_text_input(file.text, file.name, options.set),
                        {}});
    }
  }
  for (const std::string& input : options.inputs) {
    if (kind_of(input) == InputKind::volume) {
      for (GalleryScene& scene : scenes_of_volume(input, options.set))
        scenes.push_back(std::move(scene));
    } else if (kind_of(input) == InputKind::scene && is_image_scene(read_text(input))) {
      std::vector<KeyValue> changes;
      for (const std::string& text : options.set)
        changes.push_back(parse_assignment(text));
      scenes.push_back(
          {fs::path(input).stem().string(), "'" + input + "'", {}, image_scene_input(input, changes)});
    } else {
      scenes.push_back(
          {fs::path(input).stem().string(), "'" + input + "'", scene_input(input, options.set), {}});
    }
  }
  name_files(scenes);
  return scenes;
}

/// The scene's own pipeline where that draws slices; else the one that slices its warps and effects.
Pipeline slicing_pipeline(const Scene& scene) {
  if (draws_slices(scene.render.pipeline))
    return scene.render.pipeline;
  return scene.warp.size() > 1 ? Pipeline::fragment : default_pipeline(scene);
}

/// Keeps the last volume, which neighbouring scenes often share.
class Gallery {
public:
  explicit Gallery(const GalleryOptions& options) : folder_(options.folder) {}

  GalleryEntry make_entry(const GalleryScene& scene, const Progress& progress) {
    return scene.image ? make_lens_entry(scene) : make_volume_entry(scene, progress);
  }

  /// All presets on one picture.
  GalleryEntry make_preset_entry(const Progress& progress) {
    GalleryEntry entry;
    entry.name = "presets";
    entry.title = "All presets on the head phantom";
    entry.data = "128×128×128, head for presets in HU, head-mr for those relative to the data's range";
    entry.pictures.push_back(
        {save(preset_sheet(context_, progress), "presets.png"),
         "each preset of slicelens list presets; CT-MIP, MR-MIP and CT-X-ray in the mode "
         "that they are made for"});
    entry.scene_json = preset_scene(presets().front());
    entry.command =
        "slicelens render presets.json -o tile.png --set transfer.preset=" + presets().front().name;
    write_text_atomically(folder_ / "presets.json", entry.scene_json + "\n");
    return entry;
  }

  const std::string& driver() const { return driver_; }

private:
  GalleryEntry make_volume_entry(const GalleryScene& scene, const Progress& progress) {
    GalleryEntry entry;
    entry.name = scene.name;
    entry.title = scene.input.scene.title.empty() ? scene.name : scene.input.scene.title;
    entry.scene_json = scene_to_json(scene.input.scene);
    entry.command = "slicelens render " + scene.argument + " -o " + scene.name + ".png";
    const Pipeline slicing = slicing_pipeline(scene.input.scene);
    const RenderResult slices = draw(scene.input, slicing, progress);
    driver_ = slices.renderer + ", OpenGL " + slices.version;
    entry.pictures.push_back({save(slices.image, scene.name + "_slices.png"),
                              word(slicing) + ": " + std::to_string(slices.slices) + " planes, drawn in " +
                                  milliseconds(slices.times.draw)});
    const glm::dvec3 background(scene.input.scene.render.background);
    const bool tables =
        slicing == Pipeline::axis && (!scene.input.scene.warp.empty() || has_effects(scene.input.scene));
    if (tables) {
      const RenderResult exact = draw(scene.input, Pipeline::fragment, progress);
      entry.pictures.push_back(
          {save(exact.image, scene.name + "_fragment.png"),
           "fragment: the exact maps at each fragment, drawn in " + milliseconds(exact.times.draw)});
      compare(entry, "axis against fragment", slices.image, exact.image, background);
    }
    const bool rays_can = scene.input.scene.overlay.stack == 0 && slicing != Pipeline::fixed_function &&
                          scene.input.scene.render.tiles == std::array<std::size_t, 3>{1, 1, 1};
    if (rays_can) {
      const RenderResult rays = draw(scene.input, Pipeline::rays, progress);
      entry.pictures.push_back(
          {save(rays.image, scene.name + "_rays.png"), "rays, drawn in " + milliseconds(rays.times.draw)});
      compare(entry, word(slicing) + " against rays", slices.image, rays.image, background);
    }
    if (tables)
      plot_tables(entry, scene.input.scene, progress);
    entry.data = std::to_string(prepared_->volume.dims[0]) + "×" + std::to_string(prepared_->volume.dims[1]) +
                 "×" + std::to_string(prepared_->volume.dims[2]) + " " + name_of(prepared_->volume.type) +
                 ", " + prepared_->volume.format;
    if (scene.argument == scene.name + ".json")
      write_text_atomically(folder_ / scene.argument, entry.scene_json + "\n");
    return entry;
  }

  GalleryEntry make_lens_entry(const GalleryScene& scene) {
    ImageSceneInput input = *scene.image;
    GalleryEntry entry;
    entry.name = scene.name;
    entry.title = input.scene.title.empty() ? scene.name : input.scene.title;
    entry.scene_json = image_scene_to_json(input.scene);
    entry.command = "slicelens lens " + scene.argument + " -o " + scene.name + ".png";
    const PictureResult shown = draw_lens(input);
    driver_ = shown.renderer + ", OpenGL " + shown.version;
    entry.pictures.push_back({save(shown.image, scene.name + "_lens.png"),
                              word(input.scene.render.pipeline) + ": " + std::to_string(shown.triangles) +
                                  " triangles, drawn in " + milliseconds(shown.draw_seconds)});
    const bool affine = std::any_of(input.scene.warp.begin(), input.scene.warp.end(), [](const Warp& warp) {
      const auto* lens = std::get_if<LamarLens>(&warp);
      return lens != nullptr && !lens->homogeneous;
    });
    if (input.scene.render.pipeline == LensPipeline::tessellated && !affine) {
      input.scene.overlay = {}; // lines would count as differences
      const PictureResult corners = draw_lens(input);
      input.scene.render.pipeline = LensPipeline::fragment;
      const PictureResult exact = draw_lens(input);
      entry.pictures.push_back(
          {save(exact.image, scene.name + "_fragment.png"), "fragment: the exact profile at each pixel"});
      compare(entry, "tessellated against fragment", corners.image, exact.image,
              glm::dvec3(input.scene.render.background));
    }
    entry.data = "picture of " + std::to_string(shown.image.width) + "×" +
                 std::to_string(shown.image.height) + " pixels";
    return entry;
  }

  PictureResult draw_lens(const ImageSceneInput& input) {
    Scene wanted;
    wanted.render.context = input.scene.render.context;
    if (input.scene.render.pipeline == LensPipeline::fixed_function)
      wanted.render.pipeline = Pipeline::fixed_function; // which needs a compatibility context
    const PreparedPicture prepared =
        prepare_picture(input.scene, load_image(input.scene.image, input.folders));
    open_context(context_, wanted);
    return render_picture(prepared, &*context_.context);
  }

  /// The tables as curves and texels, as PNG on the page and as SVG beside it, where there is a gnuplot.
  void plot_tables(GalleryEntry& entry, const Scene& scene, const Progress& progress) {
    if (!plots_)
      return;
    const auto separable = [](const Warp& warp) { return is_separable(warp); };
    if (!std::all_of(scene.warp.begin(), scene.warp.end(), separable))
      return;
    try {
      const PlotPage page = axis_tables_page(entry.title, *prepared_);
      const std::string name = entry.name + "_tables";
      write_text_atomically(folder_ / (name + ".svg"), draw_plot(page, PlotFormat::svg));
      write_text_atomically(folder_ / (name + ".png"), draw_plot(page, PlotFormat::png));
      entry.pictures.push_back({name + ".png", "the three tables (" + name + ".svg)"});
    } catch (const FileError& problem) {
      plots_ = false;
      report_warning(progress, std::string("the tables are not plotted: ") + problem.what());
    }
  }

  /// Metrics; and a heat map of an entry's first comparison.
  void compare(GalleryEntry& entry, const std::string& what, const Image& a, const Image& b,
               const glm::dvec3& background) {
    if (entry.comparisons.empty()) {
      entry.pictures.push_back({save(heat_map(a, b, 0.02), entry.name + "_difference.png"),
                                what + ": largest difference at each pixel; the bar shows the scale"});
    }
    entry.comparisons.push_back({what, compare_images(a, b, background, background)});
  }

  static std::string milliseconds(double seconds) {
    return std::to_string(std::lround(1000 * seconds)) + " ms";
  }

  RenderResult draw(const SceneInput& input, Pipeline pipeline, const Progress& progress) {
    SceneInput drawn = input;
    drawn.scene.render.pipeline = pipeline;
    if (pipeline == Pipeline::rays)
      drawn.scene.render.order = Order::back_to_front; // the key is for slices
    if (prepared_ && folders_ == input.folders && volumes_of(prepared_->scene) == volumes_of(input.scene)) {
      load_again(*prepared_, drawn, progress);
    } else {
      prepared_.reset();
      prepared_ = load(drawn, progress, &sha256_);
      folders_ = input.folders;
    }
    RenderResult result = render_with(context_, *prepared_, progress);
    add_metadata(result, prepared_->scene, sha256_);
    return result;
  }

  /// What decides which data are read.
  static std::string volumes_of(const Scene& scene) {
    Scene alone;
    alone.volume = scene.volume;
    for (const VolumeLayer& layer : scene.others)
      alone.others.push_back({layer.volume, {}, {}, {}});
    return scene_to_json(alone, -1);
  }

  std::string save(const Image& image, const std::string& name) {
    write_image(image, folder_ / name, PixelDepth::png8);
    return name;
  }

  bool plots_ = true;
  fs::path folder_;
  OpenContext context_;
  std::optional<PreparedScene> prepared_; ///< the last scene, whose volumes neighbouring scenes often share
  std::vector<fs::path> folders_;         ///< that its files are named from
  std::string sha256_;
  std::string driver_;
};

} // namespace

void run_gallery(const GalleryOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  const std::vector<GalleryScene> scenes = scenes_of(options);
  for (const GalleryScene& scene : scenes) { // refuse a wrong name before the work
    if (scene.input.scene.volume.file)
      source_of(scene.input.scene.volume, scene.input.folders);
  }
  std::error_code error;
  fs::create_directories(options.folder, error);
  if (error)
    throw FileError(options.folder, "cannot be made: " + error.message());
  const Progress progress = console_progress();
  Gallery gallery(options);
  std::vector<GalleryEntry> entries;
  for (const GalleryScene& scene : scenes) {
    end_progress();
    std::fprintf(stderr, "%zu/%zu %s\n", entries.size() + 1, scenes.size(), scene.name.c_str());
    entries.push_back(gallery.make_entry(scene, progress));
  }
  if (options.inputs.empty()) {
    end_progress();
    std::fprintf(stderr, "presets\n");
    entries.push_back(gallery.make_preset_entry(progress));
  }
  end_progress();
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const std::string lead = "Volumes are drawn twice: as a stack of blended, view-aligned slices through a 3D "
                           "texture, and by a ray caster that samples the "
                           "same points. Tables of Cohen's effects are compared with the exact maps as well. "
                           "Lenses over pictures are drawn by their tessellation and exactly.";
  const fs::path page = fs::path(options.folder) / "index.html";
  write_text_atomically(page, gallery_page("Slicelens gallery", lead, entries, gallery.driver(), seconds));
  std::printf("%s\n", page.string().c_str());
}

} // namespace cli

} // namespace slicelens
