#include "warp/bifocal.h"

#include "core/errors.h"

namespace slicelens {

namespace {
using Functions = shared::BifocalFunctions<double>;
}

void validate(const Bifocal& bifocal) {
  validate_inside(bifocal.focus, "warp 'bifocal': focus");
  validate_inside(bifocal.shown, "warp 'bifocal': shown");
}

BifocalMap bifocal_map(const Bifocal& bifocal, const BoxSpace& space) {
  return {space.size, low_of(bifocal.focus), high_of(bifocal.focus), low_of(bifocal.shown),
          high_of(bifocal.shown)};
}

glm::dvec3 texture_from_object(const BifocalMap& map, const glm::dvec3& p) {
  return Functions().bifocal_texture_from_object(map, p);
}

glm::dmat3 jacobian(const BifocalMap& map, const glm::dvec3& p) {
  return Functions().bifocal_jacobian(map, p);
}

glm::dvec3 object_from_texture(const BifocalMap& map, const glm::dvec3& u) {
  // The inverse of a piecewise linear map is the one with both regions exchanged.
  return texture_from_object(BifocalMap{map.size, map.shown_low, map.shown_high, map.low, map.high}, u);
}

} // namespace slicelens
