// Transfer functions in the files of other programs: ParaView's colour maps (JSON, and the older XML), 3D
// Slicer's volume properties (.vp, .vp.json) and ImageVis3D's tables (.1dt). docs/transfer_files.md has what
// each format holds and what is lost on the way.
#pragma once

#include "scene/scene.h"
#include "volume/control_points.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace slicelens {

enum class TransferFormat {
  paraview_json, ///< .json
  paraview_xml,  ///< .xml; read only
  slicer_text,   ///< .vp
  slicer_json,   ///< .vp.json
  table          ///< .1dt
};

/// By the name's end; none where it is none of these.
std::optional<TransferFormat> transfer_format_of(const std::filesystem::path& path);

/// What a volume property of 3D Slicer holds beside colour and opacity.
struct SlicerDisplay {
  int interpolation = 1; ///< 0 nearest, 1 linear, 2 cubic
  bool shade = false;
  double ambient = 0.3;
  double diffuse = 0.7;
  double specular = 0.2;
  double power = 10;
  std::vector<OpacityPoint> gradient_opacity; ///< over the gradient's magnitude; empty: 1 everywhere
};

/// A file as it is.
struct TransferFile {
  std::string name; ///< of the map, or the file's
  ColorCurve color;
  OpacityCurve opacity;                               ///< no points: the file has none
  bool rows = false;                                  ///< a table: values are row numbers, of no unit
  std::optional<double> unit_distance = std::nullopt; ///< of the opacities
  std::optional<SlicerDisplay> display = std::nullopt;
  std::vector<std::string> ignored; ///< what the file says and a transfer function cannot hold
};

/// Reads a file. `map` names the colour map where there are several; otherwise it may be empty. Throws
/// FileError for a file that cannot be read, is larger than kMaxTransferFileBytes, or is damaged, and
/// UsageError where `map` is needed or not in the file.
TransferFile read_transfer_file(const std::filesystem::path& path, const std::string& map = "");

/// The values that the first and the last point of a file are moved to, the others in proportion.
using ValueRange = glm::dvec2;

/// A file's transfer function.
struct ReadTransfer {
  TransferFunction transfer;
  /// What was resampled, assumed or left out, without the file's name; empty when the function is the file's,
  /// exactly.
  std::string note;
};

/// Joins colour and opacity. Without opacity points the opacity rises from 0 to 1 over the colours' span, as
/// in ParaView. Throws FileError naming `path`.
ReadTransfer transfer_of(const TransferFile& file, const std::filesystem::path& path,
                         const std::optional<ValueRange>& range = std::nullopt);

/// What is written.
struct TransferToWrite {
  TransferFunction transfer;
  std::optional<SlicerDisplay> display = std::nullopt; ///< none: Slicer's light of a scene's defaults
  ValueRange rows_range{0, 1};                         ///< of tables: values of the first and the last row
  std::size_t rows = 256;                              ///< of tables, 2 to kMaxControlPoints
};

/// Writes by the name's end. Returns what the format could not hold, as one sentence, or an empty text: then
/// reading gives the same function again, exactly. A step is written as two points at neighbouring doubles,
/// because programs that use VTK keep only one point at a value; reading makes it one step again. Throws
/// FileError, and UsageError for a name of no format that can be written.
std::string write_transfer_file(const std::filesystem::path& path, const TransferToWrite& what);

inline constexpr std::size_t kMaxTransferFileBytes = std::size_t{16} << 20;

/// The display of a scene's section `light`, with its shading and filter, as a volume property has it.
SlicerDisplay slicer_display(const Scene& scene);

} // namespace slicelens
