// Cutting planes as textured, opaque polygons in the scene (Brunet, Nowak and Gleicher 2006 §4.2, Fig. 5).
#pragma once

#include "gl/program.h"
#include "gl/target.h"
#include "render/gpu_scene.h"

#include <vector>

namespace slicelens {

/// One plane as the shaders take it.
struct CutPlane {
  Plane place;             ///< texture coordinates of the displayed volume
  bool classified = false; ///< the transfer function's colours instead of grey
  glm::dvec2 grey{1, 0};   ///< grey = x · value + y
};

/// The scene's planes.
std::vector<CutPlane> cut_planes(const PreparedScene& prepared);

/// Where the plane cuts the bounds of the displayed volume: 0 or 3 to 6 corners, texture coordinates.
Polygon plane_polygon(const PreparedScene& prepared, const Plane& plane);

/// A camera that looks at the plane from the side its normal points to, upright, orthographic, and shows just
/// the plane's polygon in `width`/`height`. Throws UsageError where the plane misses the displayed volume.
CameraSettings camera_of_plane(const PreparedScene& prepared, const PlaneSettings& plane, double aspect);

/// A clipping plane that leaves nothing of any volume, so that planes stand alone.
ClipSettings clip_everything(const PreparedScene& prepared);

/// Sets the fields of the uniform struct `name`. The program must be in use.
void set_plane(const gl::Functions& gl, const gl::Program& program, const std::string& name,
               const CutPlane& plane);

/// Draws the planes of one prepared scene.
class PlaneRenderer {
public:
  /// Compiles and uploads. Throws GraphicsError.
  PlaneRenderer(const gl::Functions& gl, const PreparedScene& prepared);

  /// Draws the polygons with the state that is set (depth test, blending, colour mask), into the bound
  /// target.
  void draw(const PreparedScene& prepared, const GpuScene& scene) const;

private:
  const gl::Functions* gl_;
  gl::Program program_;
  gl::VertexArray vertex_array_;
  gl::Buffer corners_;
  std::vector<CutPlane> planes_;
  std::vector<std::size_t> ends_; ///< of each plane's corners
};

} // namespace slicelens
