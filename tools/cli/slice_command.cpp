#include "console.h"
#include "core/errors.h"
#include "core/text.h"
#include "image/image_io.h"
#include "options.h"
#include "render/cut_planes.h"
#include "scene/names.h"
#include "study/inputs.h"

#include <cstdio>

namespace slicelens::cli {

namespace {

glm::dvec3 vector_of(const std::vector<double>& values, const glm::dvec3& otherwise) {
  return values.size() == 3 ? glm::dvec3(values[0], values[1], values[2]) : otherwise;
}

PlaneSettings plane_of(const SliceOptions& options) {
  PlaneSettings plane;
  plane.point = vector_of(options.point, plane.point);
  plane.normal = vector_of(options.normal, plane.normal);
  if (options.range.size() == 2)
    plane.range = glm::dvec2(options.range[0], options.range[1]);
  for (const auto& [style, name] : names_of(PlaneStyle{})) {
    if (options.style == name) {
      plane.style = style;
      return plane;
    }
  }
  throw UsageError("--style: '" + options.style + "' is not known; give one of " +
                   join(words_of(PlaneStyle{})));
}

} // namespace

/// The picture is that of a scene of its own: the plane alone, faced by the camera. So it can be rendered
/// again like any other.
void run_slice(const SliceOptions& options) {
  const PixelDepth depth = pixel_depth(options.output, options.depth); // refuse a wrong name before the work
  SceneInput input = scene_input(options.input, options.set);
  const std::size_t index = checked_volume(input.scene, options.volume);
  input.scene.render.mode = Mode::dvr;
  input.scene.render.footprint = Footprint::point;
  input.scene.overlay = {};
  Scene alone = scene_of_volume(input.scene, index);
  alone.planes = {plane_of(options)};
  validate(alone);
  std::string sha256;
  PreparedScene all = load(input, console_progress(), &sha256);
  PreparedScene prepared = one_volume(std::move(all), index);
  prepared.scene.planes = alone.planes;
  const auto& size = prepared.scene.render.size;
  prepared.scene.camera = camera_of_plane(prepared, prepared.scene.planes[0],
                                          static_cast<double>(size[0]) / static_cast<double>(size[1]));
  prepared.scene.clip = {clip_everything(prepared)};
  prepare_again(prepared);
  OpenContext context;
  open_context(context, prepared.scene);
  RenderResult result = render_with(context, prepared, console_progress());
  add_metadata(result, prepared.scene, sha256);
  write_image(result.image, options.output, depth);
  end_progress();
  std::printf("%s\n", options.output.c_str());
}

} // namespace slicelens::cli
