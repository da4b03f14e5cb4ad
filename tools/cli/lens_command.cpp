#include "console.h"
#include "core/errors.h"
#include "core/files.h"
#include "core/text.h"
#include "image/image_io.h"
#include "lens_inputs.h"
#include "options.h"
#include "render/lens_picture.h"
#include "render/render.h"
#include "scene/image_scene.h"
#include "scene/load.h"
#include "volume/read.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <system_error>

namespace slicelens::cli {

namespace {

namespace fs = std::filesystem;

std::vector<KeyValue> changes_of(const LensOptions& options) {
  std::vector<KeyValue> changes;
  if (options.wireframe)
    changes.push_back({"overlay.wireframe", "segments"});
  if (options.outline)
    changes.push_back({"overlay.outline", "true"});
  if (options.lattice)
    changes.push_back({"overlay.lattice", std::to_string(*options.lattice)});
  if (options.magnification)
    changes.push_back({"overlay.magnification", "0.8"});
  for (const std::string& text : options.set)
    changes.push_back(parse_assignment(text));
  return changes;
}

void print_verbose(const PreparedPicture& prepared, const PictureResult& result) {
  std::fprintf(stderr, "image      %dx%d in %dx%d\nrenderer   %s %s\n", prepared.source.width,
               prepared.source.height, prepared.width, prepared.height, result.renderer.c_str(),
               result.context.c_str());
  for (const LensTessellation& lens : prepared.lenses) {
    std::fprintf(stderr, "lens       %zu angular and %zu radial segments\n", lens.ring.size(),
                 lens.radial_segments);
  }
  if (result.triangles > 0)
    std::fprintf(stderr, "triangles  %zu\n", result.triangles);
  std::fprintf(stderr, "draw       %8.3f s\n", result.draw_seconds);
}

} // namespace

void run_lens(const LensOptions& options) {
  const ImageSceneInput input = image_scene_input(options.input, changes_of(options));
  if (options.print_scene) {
    std::printf("%s\n", image_scene_to_json(input.scene).c_str());
    return;
  }
  const PixelDepth depth = pixel_depth(options.output, options.depth); // refuse a wrong name before the work
  const std::string hash = hash_of(input, options.input);
  const PreparedPicture prepared = prepare_picture(input.scene, load_image(input.scene.image, input.folders));
  std::optional<gl::Context> context;
  if (input.scene.render.pipeline != LensPipeline::reference) {
    Scene wanted;
    wanted.render.context = input.scene.render.context;
    if (input.scene.render.pipeline == LensPipeline::fixed_function)
      wanted.render.pipeline = Pipeline::fixed_function; // which needs a compatibility context
    context.emplace(open_context_for(wanted));
  }
  PictureResult result = render_picture(prepared, context ? &*context : nullptr);
  auto& metadata = result.image.metadata;
  metadata["slicelens:image_scene"] = image_scene_to_json(prepared.scene, -1);
  metadata["slicelens:image_sha256"] = hash;
  metadata["slicelens:version"] = SLICELENS_VERSION;
  metadata["slicelens:renderer"] = result.renderer;
  metadata["slicelens:gl_version"] = result.version;
  metadata["slicelens:context"] = result.context;
  write_image(result.image, options.output, depth);
  if (options.verbose)
    print_verbose(prepared, result);
  std::printf("%s\n", options.output.c_str());
}

} // namespace slicelens::cli
