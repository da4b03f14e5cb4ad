#include "warp/volume_lens.h"

#include "core/errors.h"
#include "core/text.h"

#include <algorithm>
#include <cmath>

namespace slicelens {

namespace {

using BoxFunctions = shared::VolumeLensFunctions<double>;
using ConnectedFunctions = shared::ConnectedLensFunctions<double>;

void validate_axis(const LensBox& box, int axis, const std::string& warp) {
  const std::string on_axis = std::string(" on axis ") + "xyz"[axis];
  const double inner = box.inner[axis];
  const double outer = box.outer[axis];
  const double center = box.center[axis];
  if (!(inner > 0))
    throw UsageError(warp + "inner must be a half-width above 0, not " + number_text(inner));
  if (!(inner < outer)) {
    throw UsageError(warp + "inner (" + number_text(inner) + ") must be smaller than outer (" +
                     number_text(outer) + ")" + on_axis);
  }
  if (!(center - inner > 0 && center + inner < 1)) {
    throw UsageError(warp + "the focus region, center " + number_text(center) + " plus and minus inner " +
                     number_text(inner) + on_axis + ", must lie within the volume and touch no face");
  }
  // Rounding must not refuse a lens whose box ends on a face.
  if (!(center - outer >= -1e-12 && center + outer <= 1 + 1e-12)) {
    throw UsageError(warp + "the lens, center " + number_text(center) + " plus and minus outer " +
                     number_text(outer) + on_axis + ", reaches beyond the volume; make outer at most " +
                     number_text(std::min(center, 1 - center)));
  }
  if (box.magnification < (outer + inner) / (2 * outer)) {
    throw UsageError(warp + "magnification " + number_text(box.magnification) +
                     " folds the border over itself" + on_axis + "; make it at least " +
                     number_text((outer + inner) / (2 * outer)));
  }
}

void validate_box(const LensBox& box, const std::string& warp) {
  if (!(box.magnification > 0 && box.magnification <= 1e4)) {
    throw UsageError(warp + "magnification must be above 0 and at most 10000, not " +
                     number_text(box.magnification));
  }
  for (int axis = 0; axis < 3; ++axis)
    validate_axis(box, axis, warp);
}

/// A minifying connected lens has the smallest determinant where its border bends along all three axes, and
/// there may fold before its profile does (docs/papers/cohen_vessels.md). One corner is as all the others.
/// Between the grid's points the determinant may be some 0.005 smaller.
void refuse_fold(const LensBox& box, const std::string& warp) {
  constexpr int points = 49;
  const ConnectedLensMap map = connected_lens_map(box, {});
  const glm::dvec3 step = (box.outer - box.inner) / double(points - 1);
  for (int q = 0; q < points * points * points; ++q) {
    const glm::dvec3 index(q % points, q / points % points, q / points / points);
    if (glm::determinant(jacobian(map, box.center + box.inner + index * step)) < 0.01) {
      throw UsageError(warp + "magnification " + number_text(box.magnification) +
                       " folds the corners of the border over themselves; make it larger, or the border "
                       "between inner and outer wider");
    }
  }
}

/// Where lens_axis shows the data coordinate u.
double shown_on_axis(double u, double center, double inner, double outer, double magnification) {
  const double side = u < center ? -1 : 1;
  const double d = side * (u - center);
  const double m = 1 / magnification;
  if (d >= outer)
    return u;
  if (d <= inner * m)
    return center + side * d / m;
  const double bend = outer * (1 - m) / ((outer - inner) * (outer - inner));
  const double rest = d - inner * m;
  const double s = 2 * rest / (m + std::sqrt(std::max(m * m + 4 * bend * rest, 0.0)));
  return center + side * (inner + s);
}

} // namespace

void validate(const VolumeLens& lens) { validate_box(lens.box, "warp 'volume-lens': "); }

void validate(const ConnectedLens& lens) {
  const std::string warp = "warp 'connected-lens': ";
  validate_box(lens.box, warp);
  if (lens.box.magnification < 1)
    refuse_fold(lens.box, warp);
}

AxisRanges focus_of(const LensBox& box) { return ranges_of(box.center - box.inner, box.center + box.inner); }

VolumeLensMap volume_lens_map(const LensBox& box, const BoxSpace& space) {
  return {space.size, box.center, box.inner, box.outer, box.magnification};
}

ConnectedLensMap connected_lens_map(const LensBox& box, const BoxSpace& space) {
  return {space.size, box.center, box.inner, box.outer, box.magnification};
}

glm::dvec3 texture_from_object(const VolumeLensMap& map, const glm::dvec3& p) {
  return BoxFunctions().volume_lens_texture_from_object(map, p);
}

glm::dmat3 jacobian(const VolumeLensMap& map, const glm::dvec3& p) {
  return BoxFunctions().volume_lens_jacobian(map, p);
}

glm::dvec3 texture_from_object(const ConnectedLensMap& map, const glm::dvec3& p) {
  return ConnectedFunctions().connected_lens_texture_from_object(map, p);
}

glm::dmat3 jacobian(const ConnectedLensMap& map, const glm::dvec3& p) {
  return ConnectedFunctions().connected_lens_jacobian(map, p);
}

int piece_of(const VolumeLensMap& map, const glm::dvec3& p) {
  return BoxFunctions().volume_lens_masks(map, texture_from_box({map.size, 1}, p)) ? 1 : 0;
}

glm::dvec3 magnified_from_texture(const VolumeLensMap& map, const glm::dvec3& u) {
  glm::dvec3 t = texture_from_box({map.size, 1}, u);
  for (int axis = 0; axis < 3; ++axis)
    t[axis] = shown_on_axis(t[axis], map.center[axis], map.inner[axis], map.outer[axis], map.magnification);
  return box_from_texture({map.size, 1}, t);
}

glm::dvec3 object_from_texture(const VolumeLensMap& map, const glm::dvec3& u) {
  return BoxFunctions().volume_lens_masks(map, texture_from_box({map.size, 1}, u))
             ? magnified_from_texture(map, u)
             : u;
}

glm::dvec3 object_from_texture(const ConnectedLensMap& map, const glm::dvec3& u) {
  // The box lens' answer is right where all weights are 1; steps are halved until they bring the image
  // nearer.
  glm::dvec3 p =
      object_from_texture(VolumeLensMap{map.size, map.center, map.inner, map.outer, map.magnification}, u);
  glm::dvec3 error = texture_from_object(map, p) - u;
  for (int i = 0; i < 100 && glm::length(error) > 1e-14; ++i) {
    const glm::dvec3 step = glm::inverse(jacobian(map, p)) * error;
    double scale = 1;
    glm::dvec3 next = p;
    glm::dvec3 next_error = error;
    do {
      next = p - scale * step;
      next_error = texture_from_object(map, next) - u;
      scale /= 2;
    } while (glm::length(next_error) >= glm::length(error) && scale > 1e-6);
    if (glm::length(next_error) >= glm::length(error))
      break;
    p = next;
    error = next_error;
  }
  return p;
}

} // namespace slicelens
