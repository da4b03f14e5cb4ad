// Classification `pre`: every voxel becomes an associated colour before anything is interpolated, as the
// hardware of 2001 did it (LaMar §4; docs/pipeline.md).
//
// A texel is (C·α', α') rounded to 8 bits, α' = 1 − (1 − α)^(Δ/Δ₀): the correction is baked in once per
// frame. Mode `xray` sums opacities, so its texels hold α itself. Opacities below 1/510 round to nothing:
// that is what 8 bits cost.
//
// A volume of colours (Volume::colors) has C of its own, and α of its own or by its luminance.
#pragma once

#include "gl/texture.h"
#include "render/prepare.h"

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace slicelens {

inline constexpr std::size_t classified_voxel_bytes = 4;

/// The colours of the voxels first, first + 1, … (x fastest, then y, then z) that fill `out`, whose size is
/// classified_voxel_bytes each. Voxels without a value have been filled before
/// (volume/missing.h). Multithreaded.
void classify_voxels(const PreparedScene& prepared, std::size_t first, std::span<std::byte> out);

/// The same for voxels of a part of the volume, or of a coarser level of it. `prepared` must outlive it.
using VoxelClassifier = std::function<void(const Volume& part, std::size_t first, std::span<std::byte> out)>;
VoxelClassifier voxel_classifier(const PreparedScene& prepared);

/// The whole volume.
std::vector<std::byte> classify_voxels(const PreparedScene& prepared);

/// A 3D texture GL_RGBA8 of the whole volume, uploaded in slabs; filtered as render.filter says. Throws
/// LimitError where the driver has no room for 4 bytes a voxel.
gl::Texture upload_classified(const gl::Functions& gl, const PreparedScene& prepared,
                              const Progress& progress);

} // namespace slicelens
