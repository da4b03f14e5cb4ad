// Control points as VTK's colour and opacity functions have them: separate curves, a midpoint and a sharpness
// on every piece, colours interpolated in several spaces. They become one piecewise linear transfer function,
// exactly where that is possible, else with a measured error.
#pragma once

#include "volume/color_spaces.h"
#include "volume/transfer.h"

#include <cstddef>
#include <string>
#include <vector>

namespace slicelens {

/// How a piece between two control points runs (vtkPiecewiseFunction, vtkColorTransferFunction).
struct PieceShape {
  double midpoint = 0.5; ///< in [0,1]: fraction of the piece at which the mean of both ends is reached
  double sharpness = 0; ///< in [0,1]: below 0.01 straight, above 0.99 a step at the midpoint, between a curve
};

struct ColorPoint {
  double value = 0;   ///< data units
  glm::dvec3 rgb{0};  ///< in [0,1]³
  PieceShape shape{}; ///< of the piece that begins here
};

struct OpacityPoint {
  double value = 0;
  double opacity = 0; ///< in [0,1]
  PieceShape shape{};
};

struct ColorCurve {
  ColorSpace space = ColorSpace::rgb;
  std::vector<ColorPoint> points; ///< values non-decreasing
  bool logarithmic = false;       ///< pieces run over the logarithm of the value; all values are above 0
};

struct OpacityCurve {
  std::vector<OpacityPoint> points;
  bool logarithmic = false;
};

/// Share of the upper end at fraction s in [0,1] of a piece: VTK's modified Hermite curve, which is the same
/// for every channel.
double piece_weight(const PieceShape& shape, double s);

/// Colour and opacity at a value, exact; constant beyond the ends. A step's own value belongs to its right
/// side. Curves must be valid.
glm::dvec3 evaluate(const ColorCurve& curve, double value);
double evaluate(const OpacityCurve& curve, double value);

/// Throws UsageError, naming `what` ("colour point"), the point's number and value, unless there is at least
/// one point, values are finite within ±kMaxTransferValue and non-decreasing (above 0 where logarithmic), and
/// colours, opacities, midpoints and sharpnesses lie in [0,1].
void validate(const ColorCurve& curve);
void validate(const OpacityCurve& curve);

/// The two curves as one function.
struct JoinedCurves {
  TransferFunction transfer;
  /// Largest difference of any channel from the curves, measured at eight places between every two points.
  /// Straight and stepped pieces in RGB are exact up to rounding.
  double deviation = 0;
  bool resampled = false; ///< whether any piece was bent and so is replaced by straight ones
};

/// What resampling aims at: a quarter of one step of 8 bits.
inline constexpr double kResamplingTolerance = 1.0 / 1024;
/// Most straight pieces that one bent piece becomes; fewer in curves of more than 16 points.
inline constexpr std::size_t kMaxPiecesOfPiece = 4096;
/// Most points of a curve.
inline constexpr std::size_t kMaxControlPoints = 16384;

/// Throws UsageError as validate does, and for more than kMaxControlPoints points in a curve.
JoinedCurves join(const ColorCurve& color, const OpacityCurve& opacity);

} // namespace slicelens
