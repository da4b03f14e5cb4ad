// The volume: a plain value that every reader and phantom gives and every renderer takes.
#pragma once

#include "core/box.h"

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace slicelens {

enum class ScalarType { u8, i8, u16, i16, u32, i32, u64, i64, f32, f64 };

/// Bytes of one scalar: 1, 2, 4 or 8.
std::size_t size_of(ScalarType type);

/// "uint8", "int8", … "float32", "float64": the names of `volume.type` and of `slicelens info`.
std::string name_of(ScalarType type);

/// The type of a name as name_of gives it, or one of the usual synonyms (uchar, short, ushort, int, float,
/// double …). Throws UsageError naming the nearest one.
ScalarType scalar_type_from_name(const std::string& name);

struct StreamedVoxels;

/// Colours of voxels, in the order of the voxels.
struct VoxelColors {
  std::vector<std::uint8_t> rgba; ///< straight R G B A of each voxel, 255 for 1; empty: there are none
  bool has_opacity = false;       ///< A is the data's own opacity per reference length; else it says nothing
};

/// A regular grid of samples. Voxel (i,j,k) has its centre at origin + direction·(spacing ∘ (i,j,k)) in world
/// space (LPS, the data's own unit of length) and its component c is scalar number ((k·ny + j)·nx +
/// i)·components + c of `voxels`, in the machine's byte order.
struct Volume {
  std::array<std::size_t, 3> dims{1, 1, 1}; ///< voxels along i, j, k
  glm::dvec3 spacing{1};                    ///< > 0, world units
  glm::dvec3 origin{0};                     ///< world position of voxel (0,0,0)'s centre
  glm::dmat3 direction{1};                  ///< columns: world directions of the axes i, j, k (unit vectors)
  ScalarType type = ScalarType::u8;
  int components = 1;            ///< 1 to 4, interleaved
  std::vector<std::byte> voxels; ///< dims product · components · size_of(type) bytes
  double min = 0;                ///< smallest finite value over all components (see update_statistics)
  double max = 0;                ///< largest finite value over all components
  double mean = 0;               ///< mean of the finite values over all components
  std::size_t non_finite = 0;    ///< scalars that are NaN or infinite
  std::size_t frames = 1;        ///< frames in the file this one was chosen from
  std::string format;            ///< "NRRD", "MetaImage", "NIfTI", "DICOM", "phantom" …
  /// Voxels that stay in their file (volume/streamed.h); `voxels` is empty then, the statistics are known.
  std::shared_ptr<const StreamedVoxels> streamed;
  VoxelColors colors; ///< of a volume of colours, whose voxels are luminances (with_luminance)
};

/// Number of voxels. Throws LimitError on overflow.
std::size_t voxel_count(const Volume& volume);

/// Bytes that `voxels` must hold. Throws LimitError on overflow.
std::size_t voxel_bytes(const Volume& volume);

/// Scalar number `index` of `voxels` as a double (64-bit integers beyond 2⁵³ are rounded).
double scalar_at(const Volume& volume, std::size_t index);

/// The value of component `component` of voxel (i,j,k).
double value_at(const Volume& volume, std::size_t i, std::size_t j, std::size_t k, int component = 0);

/// Computes min, max, mean and non_finite from the voxels in one pass, in parallel. Without any finite value
/// min, max and mean are 0.
void update_statistics(Volume& volume);

/// Whether voxels of 3 or 4 components hold colours: RGB or RGBA in whole numbers without a sign, of 8 or 16
/// bits. Other vectors are data.
bool holds_colors(const Volume& volume);

/// A volume that holds_colors as one of luminances, 0.2126 R + 0.7152 G + 0.0722 B (ITU-R BT.709-6 §3, of the
/// values as they are), rounded to its type, with the colours beside them in 8 bits.
Volume with_luminance(const Volume& volume);

/// The volume's box in world space: faces half a voxel outside the outer voxel centres.
Box box_of(const Volume& volume);

/// The smallest of the three spacings: h of docs/pipeline.md.
double smallest_spacing(const Volume& volume);

/// Calls `function` with a null pointer of the C++ type of `type`, so that code is written once for all
/// scalar types: `visit_scalar_type(v.type, [&](auto* tag) { using T = std::remove_pointer_t<decltype(tag)>;
/// … })`.
template <class Function>
decltype(auto) visit_scalar_type(ScalarType type, Function&& function) {
  switch (type) {
  case ScalarType::u8:
    return function(static_cast<std::uint8_t*>(nullptr));
  case ScalarType::i8:
    return function(static_cast<std::int8_t*>(nullptr));
  case ScalarType::u16:
    return function(static_cast<std::uint16_t*>(nullptr));
  case ScalarType::i16:
    return function(static_cast<std::int16_t*>(nullptr));
  case ScalarType::u32:
    return function(static_cast<std::uint32_t*>(nullptr));
  case ScalarType::i32:
    return function(static_cast<std::int32_t*>(nullptr));
  case ScalarType::u64:
    return function(static_cast<std::uint64_t*>(nullptr));
  case ScalarType::i64:
    return function(static_cast<std::int64_t*>(nullptr));
  case ScalarType::f32:
    return function(static_cast<float*>(nullptr));
  case ScalarType::f64:
    break;
  }
  return function(static_cast<double*>(nullptr));
}

} // namespace slicelens
