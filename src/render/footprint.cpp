#include "render/footprint.h"

#include "render/level_function.h"
#include "render/prepare.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace slicelens {

namespace {

glm::dmat3 scaled_rows(const glm::dvec3& s, const glm::dmat3& m) { return {s * m[0], s * m[1], s * m[2]}; }

/// In voxels of the data as if there were no map.
glm::dmat3 steps_shown(const PreparedScene& prepared, const glm::dvec3& p) {
  const auto& n = prepared.volume.dims;
  const SampleSteps& steps = prepared.steps;
  const double scale = std::max(glm::dot(glm::dvec3(steps.scale), p) + steps.scale.w, 0.0);
  return scaled_rows({n[0], n[1], n[2]},
                     {scale * steps.at_unit[0], scale * steps.at_unit[1], steps.at_unit[2]});
}

/// In voxels of the data: d(voxel index)/d(pixel, sample).
glm::dmat3 steps_in_data(const PreparedScene& prepared, const glm::dvec3& p) {
  const glm::dmat3 shown = steps_shown(prepared, p);
  if (!is_warped(prepared))
    return shown;
  const auto& n = prepared.volume.dims;
  const glm::dvec3 voxels_in_unit = glm::dvec3(n[0], n[1], n[2]) / prepared.space.size; // of box space
  return scaled_rows(voxels_in_unit, jacobian(prepared.maps, box_from_texture(prepared.space, p)) *
                                         scaled_rows(1.0 / voxels_in_unit, shown));
}

bool shows_data(const PreparedScene& prepared, const glm::dvec3& p) {
  const glm::dvec3 t = texture_from_box(
      prepared.space, texture_from_object(prepared.maps, box_from_texture(prepared.space, p)));
  return glm::all(glm::greaterThanEqual(t, glm::dvec3(0))) && glm::all(glm::lessThanEqual(t, glm::dvec3(1)));
}

} // namespace

SampleSteps sample_steps(const PreparedScene& prepared) {
  const View& view = prepared.view;
  const glm::dmat3 texture_from_direction(texture_from_world(prepared.box));
  SampleSteps steps;
  steps.at_unit = texture_from_direction * glm::dmat3(2 * half_width(view) / view.width * view.right,
                                                      2 * view.half_height / view.height * view.up,
                                                      prepared.spacing * view.forward);
  if (view.projection == Projection::perspective) {
    const glm::dmat4& world_from_texture = prepared.box.world_from_texture;
    steps.scale = {glm::transpose(glm::dmat3(world_from_texture)) * view.forward,
                   depth(view, glm::dvec3(world_from_texture[3]))};
  }
  return steps;
}

double footprint_level(const PreparedScene& prepared, const glm::dvec3& p) {
  return LevelFunction().footprint_level(steps_in_data(prepared, p),
                                         static_cast<double>(prepared.levels - 1));
}

double displayed_level(const PreparedScene& prepared, const glm::dvec3& p) {
  return LevelFunction().footprint_level(steps_shown(prepared, p), 32);
}

std::size_t footprint_level_count(const PreparedScene& prepared) {
  const auto& dims = prepared.volume.dims;
  const std::size_t wanted = prepared.scene.render.levels;
  const auto available = static_cast<std::size_t>(std::bit_width(std::max({dims[0], dims[1], dims[2]})));
  const std::size_t most = std::min(available, wanted > 1 ? wanted : max_levels);
  constexpr int cells = 24;
  double coarsest = 0;
  for (int k = 0; k <= cells; ++k) {
    for (int j = 0; j <= cells; ++j) {
      for (int i = 0; i <= cells; ++i) {
        const glm::dvec3 p = glm::mix(prepared.object_low, prepared.object_high,
                                      glm::dvec3(i, j, k) / static_cast<double>(cells));
        if (shows_data(prepared, p))
          coarsest = std::max(coarsest, LevelFunction().footprint_level(steps_in_data(prepared, p),
                                                                        static_cast<double>(most - 1)));
      }
    }
  }
  // Rounding does not make a level of its own.
  return std::min(most, static_cast<std::size_t>(std::ceil(coarsest - 1e-3)) + 1);
}

} // namespace slicelens
