// Inside src/volume only: how a phantom's formula is handed to make_phantom.
#pragma once

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <functional>
#include <span>

namespace slicelens {

/// The grid a phantom is evaluated on.
struct PhantomGrid {
  std::array<std::size_t, 3> dims{1, 1, 1};
  glm::dvec3 edges{1}; ///< lengths of the box edges, world units

  /// Texture coordinate of a voxel centre on one axis.
  double texture(std::size_t axis, std::size_t index) const {
    return (static_cast<double>(index) + 0.5) / static_cast<double>(dims[axis]);
  }
  double spacing(std::size_t axis) const {
    return edges[static_cast<glm::length_t>(axis)] / static_cast<double>(dims[axis]);
  }
};

/// Fills the row of voxels (0…nx−1, j, k) with values in data units. Called from several threads at a time.
using PhantomRows =
    std::function<void(const PhantomGrid& grid, std::size_t j, std::size_t k, std::span<double> row)>;

/// Rows of a formula in texture coordinates.
template <class Formula>
PhantomRows rows_of(Formula formula) {
  return [formula](const PhantomGrid& grid, std::size_t j, std::size_t k, std::span<double> row) {
    glm::dvec3 t(0, grid.texture(1, j), grid.texture(2, k));
    for (std::size_t i = 0; i < row.size(); ++i) {
      t.x = grid.texture(0, i);
      row[i] = formula(t);
    }
  };
}

PhantomRows checkerboard_rows();
PhantomRows brick_rows();
PhantomRows engine_rows();
PhantomRows head_rows(bool magnetic_resonance);
PhantomRows head_artery_rows();
PhantomRows organ_rows();
PhantomRows organ_label_rows();
PhantomRows colon_rows();

} // namespace slicelens
