// The view: where a picture is taken from. A plain value made from a scene's camera, shared by slicing,
// tessellation, warps and every renderer.
#pragma once

#include "core/box.h"

#include <glm/glm.hpp>

namespace slicelens {

enum class Projection { orthographic, perspective };

/// A camera frame in world space with the picture it fills. `right`, `up` and `forward` are orthonormal;
/// the right-handed view space of docs/pipeline.md looks down −z, so its z axis is −forward.
struct View {
  Projection projection = Projection::orthographic;
  glm::dvec3 eye{0};           ///< perspective: centre of projection; orthographic: any point on the axis
  glm::dvec3 right{1, 0, 0};   ///< unit
  glm::dvec3 up{0, 0, 1};      ///< unit
  glm::dvec3 forward{0, 1, 0}; ///< unit, the viewing direction
  double half_height = 1;      ///< orthographic: world units; perspective: tangent of half the view angle
  int width = 512;             ///< pixels
  int height = 512;            ///< pixels
};

/// Half the picture's width in the unit of `half_height`. Pixels are square.
double half_width(const View& view);

/// Distance of a world point in front of the eye along `forward`; negative behind it.
double depth(const View& view, const glm::dvec3& world);

/// The ray through image position (x, y) in pixels, (0,0) the top left corner of the picture, pixel centres
/// at +½ (docs/spaces.md). World space, unit direction. Orthographic rays start on the plane through `eye`.
Ray ray_from_pixel(const View& view, double x, double y);

/// Unit vector from `world` towards the viewer.
glm::dvec3 towards_viewer(const View& view, const glm::dvec3& world);

/// OpenGL clip coordinates (y up) of world points; depths in [near, far] map to z/w in [−1, 1]. Perspective
/// needs 0 < near < far.
glm::dmat4 clip_from_world(const View& view, double near, double far);

/// Image position in pixels, y down, of a world point in front of the eye.
glm::dvec2 pixel_from_world(const View& view, const glm::dvec3& world);

} // namespace slicelens
