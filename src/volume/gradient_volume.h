// What shading needs of a volume beside its voxels: a smooth copy, and derivatives at the voxels.
#pragma once

#include "volume/volume.h"

#include <array>
#include <cstddef>
#include <span>

namespace slicelens {

/// Voxels of a copy with one voxel for `reduction` on each axis: ⌈N/reduction⌉.
std::array<std::size_t, 3> reduced_dims(const std::array<std::size_t, 3>& dims, std::size_t reduction);

/// The volume under a Gaussian, with n = ⌈N/reduction⌉ voxels on each axis of the same box, from which
/// gradients are taken (Brunet, Nowak and Gleicher 2006 §3.4). Voxel i of the copy has its centre at x =
/// (i+½)·N/n voxels of the volume and is the mean of the voxels j with |j+½−x| ≤ 4s, weighted by
/// e^(−(j+½−x)²/2s²), s = sigma·N/n: `sigma` > 0 counts voxels of the copy. Voxels beyond the edge are those
/// at the edge.
///
/// 32-bit floats: values less the volume's smallest, so that large offsets cost no digits; non-finite voxels
/// count as the smallest. Throws UsageError for several components, LimitError on overflow.
Volume gaussian_copy(const Volume& volume, std::size_t reduction, double sigma);

/// Derivatives along i, j and k at the voxels of the planes z0 ≤ k < z1, by central differences clamped at
/// the edge: (v(i+1) − v(i−1))/(max − min), in [−1, 1]; per voxel they are half of that times (max − min).
/// All 0 where the volume is constant. `out` takes three floats for each voxel. One component; non-finite
/// voxels count as the smallest.
void central_differences(const Volume& volume, std::size_t z0, std::size_t z1, std::span<float> out);

} // namespace slicelens
