#include "render/prepare_data.h"

#include "core/errors.h"
#include "render/occupancy.h"
#include "render/pages.h"
#include "volume/missing.h"
#include "volume/pyramid.h"
#include "volume/streamed.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>

namespace slicelens {

void fill_missing(PreparedScene& prepared) {
  Volume& volume = prepared.volume;
  if (volume.non_finite == 0 || is_streamed(volume)) // of those on disk whoever loads a box replaces them
    return;
  const bool maximum = prepared.scene.render.mode == Mode::mip;
  const auto empty = maximum ? std::nullopt : empty_value(prepared.transfer, volume.min, volume.max);
  fill_non_finite(volume, empty.value_or(volume.min));
}

void prepare_pyramid(PreparedScene& prepared) {
  const std::size_t count = prepared.levels - 1;
  if (is_streamed(prepared.volume)) {
    const std::vector<Volume>& coarser = prepared.volume.streamed->coarser;
    if (coarser.size() < count)
      throw UsageError("render.levels " + std::to_string(prepared.levels) + " needs " +
                       std::to_string(count) + " coarser levels, and the voxels on disk (" +
                       prepared.volume.streamed->where + ") have " + std::to_string(coarser.size()) +
                       "; set volume.access to cache or memory");
    prepared.pyramid.assign(coarser.begin(), coarser.begin() + static_cast<std::ptrdiff_t>(count));
    return;
  }
  prepared.pyramid.resize(std::min(prepared.pyramid.size(), count));
  while (prepared.pyramid.size() < count)
    prepared.pyramid.push_back(
        half_size(prepared.pyramid.empty() ? prepared.volume : prepared.pyramid.back()));
}

void prepare_cells(PreparedScene& prepared) {
  const RenderSettings& render = prepared.scene.render;
  prepared.skipping = {};
  if (render.skip == Skip::none && !is_paged(prepared))
    return;
  const std::size_t reach = render.filter == Filter::cubic ? 2 : 1;
  const bool on_disk = is_streamed(prepared.volume); // known with the larger reach, which holds for both
  if (on_disk && !prepared.cells)
    prepared.cells = prepared.volume.streamed->cells;
  if (!on_disk && (!prepared.cells || prepared.cells->reach != reach))
    prepared.cells = cell_ranges(prepared.volume, reach);
  if (render.skip == Skip::none)
    return;
  if (!on_disk && (!prepared.small_cells || prepared.small_cells->reach != reach))
    prepared.small_cells = cell_ranges(prepared.volume, reach, small_cell_edge);
  prepare_label_cells(prepared);
  prepared.skipping = skipping_of(prepared);
}

void place(PreparedScene& prepared, const std::optional<glm::dvec3>& middle) {
  Volume& volume = prepared.volume;
  const FileGeometry& file = prepared.file_geometry;
  volume.spacing = file.spacing;
  volume.origin = file.origin;
  volume.direction = file.direction;
  const Placement& placement = prepared.scene.placement;
  if (placement == Placement{})
    return;
  const glm::dvec3 own_middle = center(box_of(volume));
  glm::dmat3 turn(1);
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 about(0);
    about[axis] = 1;
    turn = glm::dmat3(glm::rotate(glm::dmat4(1), glm::radians(placement.rotate[axis]), about)) * turn;
  }
  const glm::dvec3 at =
      (placement.align == Alignment::center && middle ? *middle : own_middle) + placement.translate;
  const glm::dmat3 turned = turn * file.direction;
  // From the middle to voxel (0,0,0), along the axes, which need not be at right angles.
  const glm::dvec3 steps = glm::inverse(file.direction) * (file.origin - own_middle);
  volume.spacing = file.spacing * placement.scale;
  volume.direction = turned;
  volume.origin = at + turned * (steps * placement.scale);
}

} // namespace slicelens
