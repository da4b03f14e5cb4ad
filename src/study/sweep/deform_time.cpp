#include "study/sweep/deform_time.h"

#include "core/stopwatch.h"
#include "gl/timer.h"
#include "render/axis_textures.h"
#include "render/grid_textures.h"

namespace slicelens {

std::optional<double> deform_seconds(gl::Context& context, const PreparedScene& prepared) {
  if (prepared.maps.empty())
    return std::nullopt;
  const gl::Functions& gl = context.functions();
  PreparedScene copy = prepared;
  copy.held.clear(); // splines and fields are solved anew, as after a change
  for (PreparedScene& other : copy.others)
    other.held.clear();
  gl::finish(gl);
  const Stopwatch watch;
  prepare_again(copy);
  const auto grids = upload_grids(gl, drawn_maps(copy));
  AxisTextures tables;
  if (copy.scene.render.pipeline == Pipeline::axis)
    (void)upload_axis_tables(gl, copy, tables);
  gl::finish(gl);
  return watch.seconds();
}

} // namespace slicelens
