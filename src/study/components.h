// Connected components of a boolean volume: does a displayed vessel hang together?
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace slicelens {

/// A boolean volume. Voxel (i,j,k) is number (k·ny + j)·nx + i of `voxels`; anything but 0 belongs to the
/// object.
struct VoxelMask {
  std::array<std::size_t, 3> dims{1, 1, 1}; ///< voxels along i, j, k, each ≥ 1
  std::vector<std::uint8_t> voxels;         ///< as many as the product of dims
};

/// Which voxels are neighbours: those that share a face (6), or a face, an edge or a corner (26). Opposite
/// sides of the volume are never neighbours.
enum class Connectivity { faces = 6, corners = 26 };

/// The number of voxels of every component, largest first; empty for an empty mask.
struct Components {
  std::vector<std::size_t> sizes;
};

/// The components of the voxels that are not 0 (Rosenfeld and Pfaltz, "Sequential Operations in Digital
/// Picture Processing", JACM 13(4) 1966, with runs of voxels in place of single ones). Linear in the voxels
/// but for the inverse Ackermann function of union-find; memory is proportional to the runs. Throws
/// UsageError when a size is 0 or `voxels` does not fit `dims`, LimitError when their product overflows.
Components connected_components(const VoxelMask& mask, Connectivity connectivity = Connectivity::corners);

/// The largest component alone (of equally large ones the first in memory); empty for an empty mask. Throws
/// as connected_components does.
VoxelMask largest_component(const VoxelMask& mask, Connectivity connectivity = Connectivity::corners);

/// Components of at least `smallest` voxels beside the tiny ones below that.
struct ComponentCount {
  std::size_t large = 0;
  std::size_t tiny = 0;
  std::size_t tiny_voxels = 0; ///< voxels in all tiny ones together
};
ComponentCount count_components(const Components& components, std::size_t smallest);

/// Voxels of all components.
std::size_t voxel_count(const Components& components);

} // namespace slicelens
