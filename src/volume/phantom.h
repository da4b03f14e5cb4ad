// Embedded test volumes, evaluated from formulas, so that nothing need be downloaded.
#pragma once

#include "core/progress.h"
#include "volume/volume.h"
#include "volume/write.h"

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace slicelens {

struct PhantomInfo {
  std::string name;
  std::string description; ///< one line
  /// The values as a formula in the texture coordinates t ∈ [0,1]³, or in millimetres for the heads.
  std::string formula;
  std::array<std::size_t, 3> size{128, 128, 128}; ///< default number of voxels
  std::string preset;                             ///< transfer function preset that shows it well
};

/// All phantoms, in the order in which they are listed to users.
const std::vector<PhantomInfo>& phantoms();

/// A phantom of the given name. Values are evaluated at voxel centres t = (i+½)/N (`checkerboard` and the
/// solids are averaged over about one voxel, so that they have no stairs).
///
/// Place in the world: every phantom fills its box at any `size` ≥ 1 per axis, and the box has the same shape
/// at any size: a cube, but for `engine` and the organs,
/// which are half as high as long, and `colon`, which is half as deep. The longest edge is 256 mm for
/// the heads, 160 mm for the organs and 320 mm for the colon, and max(size) units otherwise, so cubic sizes
/// have spacing 1 (and `engine` at 2n×2n×n); in general spacing = edge/size per axis. The box centre is the
/// world origin; direction is the identity, which in LPS puts a head's left at +x, its back at +y and its
/// crown at +z.
///
/// Deterministic: the same bytes whatever the number of threads. Throws UsageError for an unknown name
/// (naming the nearest) or a zero size, and LimitError, before any allocation, for more than kMaxPhantomEdge
/// voxels on an edge or more than kMaxPhantomBytes.
Volume make_phantom(const std::string& name, const std::array<std::size_t, 3>& size,
                    const Progress& progress = {});

/// The same at the phantom's default size.
Volume make_phantom(const std::string& name, const Progress& progress = {});

/// A phantom whose voxels are not made yet, for files larger than memory.
struct PhantomSource {
  Volume volume; ///< place and type; no voxels, no statistics
  RowSource rows;
};

/// The values are those of make_phantom, and so are the errors but for kMaxPhantomBytes.
PhantomSource phantom_source(const std::string& name, const std::array<std::size_t, 3>& size);

/// The entry of phantoms(). Throws UsageError naming the nearest one.
const PhantomInfo& phantom_info(const std::string& name);

/// One label of `organs-labels` and the value of the same organ in `organs`.
struct OrganInfo {
  int label = 0; ///< 0 is the air outside
  std::string name;
  double value = 0;
};

/// All labels in ascending order, each label its own index.
const std::vector<OrganInfo>& organs();

constexpr std::size_t kMaxPhantomEdge = 16384;
constexpr std::size_t kMaxPhantomBytes = std::size_t{4} << 30; ///< in memory

/// The parameters of the phantoms with closed forms (closed_forms.h), lengths as fractions of the box edge.
constexpr double kBallRadius = 0.4;    ///< `ball`
constexpr double kBallClamp = 0.1;     ///< `ball`: values lie in [−kBallClamp, kBallClamp]
constexpr double kBlobSigma = 0.125;   ///< `blob`
constexpr double kBlobAmplitude = 1.0; ///< `blob`
constexpr double kSlabFront = 1.0;     ///< `slabs`: value where t_y < ½
constexpr double kSlabBack = 2.0;      ///< `slabs`: value where t_y > ½

} // namespace slicelens
