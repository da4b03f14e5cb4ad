#include "console.h"
#include "core/errors.h"
#include "core/text.h"
#include "image/image_io.h"
#include "image/pictures.h"
#include "json_output.h"
#include "options.h"
#include "scene/load.h"
#include "scene/load_warps.h"
#include "scene/scene_json.h"
#include "study/flip.h"
#include "study/inputs.h"
#include "study/metrics.h"

#include <cstdio>
#include <filesystem>
#include <optional>
#include <system_error>

namespace slicelens::cli {

namespace {

namespace fs = std::filesystem;

/// One side of a comparison.
struct Side {
  Image image;
  glm::dvec3 background{0};
};

Side read_side(const std::string& path) {
  Side side{read_image(path), glm::dvec3(0)};
  const auto scene = side.image.metadata.find("slicelens:scene");
  if (scene != side.image.metadata.end())
    side.background = glm::dvec3(scene_from_json(scene->second, path).render.background);
  return side;
}

/// Renders scenes one after the other; a volume that both sides show is read once.
class SceneSides {
public:
  Side render_side(const std::string& input, const std::vector<std::string>& set, bool verbose) {
    const SceneInput scene = scene_input(input, set);
    const Progress progress = console_progress();
    const std::string folder = fs::path(input).parent_path().string();
    if (prepared_ && folder == folder_) {
      load_again(*prepared_, scene, progress);
    } else {
      prepared_.reset();
      prepared_ = load(scene, progress);
      folder_ = folder;
    }
    RenderResult result = render_with(context_, *prepared_, progress);
    end_progress();
    if (verbose)
      std::fprintf(stderr, "%s: %s, draw %.3f s\n", input.c_str(), result.renderer.c_str(),
                   result.times.draw);
    return {std::move(result.image), glm::dvec3(scene.scene.render.background)};
  }

private:
  OpenContext context_;
  std::optional<PreparedScene> prepared_;
  std::string folder_; ///< that its files are named from
};

std::vector<std::string> joined(const std::vector<std::string>& a, const std::vector<std::string>& b) {
  std::vector<std::string> all = a;
  all.insert(all.end(), b.begin(), b.end());
  return all;
}

Side side_of(SceneSides& scenes, const std::string& input, const std::vector<std::string>& set,
             bool verbose) {
  if (kind_of(input) != InputKind::picture)
    return scenes.render_side(input, set, verbose);
  if (!set.empty()) {
    throw UsageError(input + " is a picture, which --set cannot change; give the scene it was rendered from");
  }
  return read_side(input);
}

void write_pictures(const CompareOptions& options, const Side& a, const Side& b) {
  std::error_code error;
  fs::create_directories(options.folder, error);
  if (error)
    throw FileError(options.folder, "cannot be made: " + error.message());
  const fs::path folder(options.folder);
  write_image(a.image, folder / "a.png", PixelDepth::png8);
  write_image(b.image, folder / "b.png", PixelDepth::png8);
  const std::string name = "difference_x" + number_text(options.factor) + ".png";
  write_image(difference_image(a.image, b.image, options.factor), folder / name, PixelDepth::png8);
  write_image(heat_map(a.image, b.image, 1 / options.factor), folder / "heatmap.png", PixelDepth::png8);
  write_image(flip_picture(flip_errors(a.image, b.image, a.background, b.background)), folder / "flip.png",
              PixelDepth::png8);
  std::fprintf(
      stderr, "%s: difference times %s; heat map from 0 (black) to %s (brightest); FLIP from 0 to 1\n",
      options.folder.c_str(), number_text(options.factor).c_str(), number_text(1 / options.factor).c_str());
}

} // namespace

void run_compare(const CompareOptions& options) {
  SceneSides scenes;
  const std::string& b_input = options.b.empty() ? options.a : options.b;
  if (options.b.empty() && options.set_a == options.set_b) {
    throw UsageError("compare needs two inputs, or one scene with different --set-a and --set-b");
  }
  const Side a = side_of(scenes, options.a, joined(options.set, options.set_a), options.verbose);
  const Side b = side_of(scenes, b_input, joined(options.set, options.set_b), options.verbose);
  const Metrics metrics = compare_images(a.image, b.image, a.background, b.background);
  if (!options.folder.empty())
    write_pictures(options, a, b);
  std::printf("%s\n", metrics_json(metrics).c_str());
}

} // namespace slicelens::cli
