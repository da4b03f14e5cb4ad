#include "volume/control_points.h"

#include "core/errors.h"
#include "core/text.h"

#include <algorithm>
#include <cmath>

namespace slicelens {

using glm::dvec3;

namespace {

constexpr double kStraight = 0.01; ///< sharpness below which a piece is straight
constexpr double kStepped = 0.99;  ///< and above which it is a step

double mix_ends(ColorSpace, double a, double b, double weight) { return a + (b - a) * weight; }
dvec3 mix_ends(ColorSpace space, const dvec3& a, const dvec3& b, double weight) {
  return mix_colors(space, a, b, weight);
}

const dvec3& end_of(const ColorPoint& point) { return point.rgb; }
double end_of(const OpacityPoint& point) { return point.opacity; }
ColorSpace space_of(const ColorCurve& curve) { return curve.space; }
ColorSpace space_of(const OpacityCurve&) { return ColorSpace::rgb; }

double inner_midpoint(const PieceShape& shape) { return std::clamp(shape.midpoint, 1e-5, 1 - 1e-5); }

/// Fraction of the piece from a to b at which the value lies.
double fraction(double a, double b, double value, bool logarithmic) {
  return logarithmic ? std::log(value / a) / std::log(b / a) : (value - a) / (b - a);
}

double value_at_fraction(double a, double b, double s, bool logarithmic) {
  return logarithmic ? a * std::pow(b / a, s) : a + (b - a) * s;
}

/// Position warped by the midpoint, so that the mean of both ends is reached at ½.
double centred(const PieceShape& shape, double s) {
  const double m = inner_midpoint(shape);
  return s < m ? 0.5 * s / m : 0.5 + 0.5 * (s - m) / (1 - m);
}

/// The curve's narrowing of a bent piece towards its midpoint.
double narrowed(double sharpness, double s) {
  const double power = 1 + 10 * sharpness;
  return s < 0.5 ? 0.5 * std::pow(2 * s, power) : 1 - 0.5 * std::pow(2 * (1 - s), power);
}

/// Between the points `first` and `first + 1`.
template <class Curve>
auto inside_piece(const Curve& curve, std::size_t first, double value) {
  const auto& a = curve.points[first];
  const auto& b = curve.points[first + 1];
  const double s = fraction(a.value, b.value, value, curve.logarithmic);
  const bool bent = a.shape.sharpness >= kStraight && a.shape.sharpness <= kStepped;
  // VTK leaves the Hermite part out in this space.
  const double weight = space_of(curve) == ColorSpace::diverging && bent
                            ? narrowed(a.shape.sharpness, centred(a.shape, s))
                            : piece_weight(a.shape, s);
  return mix_ends(space_of(curve), end_of(a), end_of(b), weight);
}

/// The limit of the curve at `value` from the right, or from the left.
template <class Curve>
auto limit(const Curve& curve, double value, bool right) {
  const auto& points = curve.points;
  const auto upper = right ? std::upper_bound(points.begin(), points.end(), value,
                                              [](double v, const auto& point) { return v < point.value; })
                           : std::lower_bound(points.begin(), points.end(), value,
                                              [](const auto& point, double v) { return point.value < v; });
  auto result = end_of(points.front());
  if (upper == points.begin())
    return result;
  if (upper == points.end()) {
    result = end_of(points.back());
    return result;
  }
  const auto first = static_cast<std::size_t>(upper - points.begin()) - 1;
  const auto& piece = points[first];
  if (piece.shape.sharpness > kStepped && space_of(curve) != ColorSpace::step) {
    // The step inside the piece lies where the added points have it.
    const double step = value_at_fraction(piece.value, points[first + 1].value, inner_midpoint(piece.shape),
                                          curve.logarithmic);
    const bool above = right ? value >= step : value > step;
    result = end_of(points[above ? first + 1 : first]);
    return result;
  }
  result = inside_piece(curve, first, value);
  if (value == points[first].value && space_of(curve) != ColorSpace::step)
    result = end_of(points[first]); // exactly, without the way through another space
  if (!right && value == points[first + 1].value)
    result = end_of(points[first + 1]);
  return result;
}

/// Values at which `curve` has knots, steps or kinks, or bends so much that more points are needed.
template <class Curve>
class KnotFinder {
public:
  KnotFinder(const Curve& curve, std::vector<double>& values)
      : curve_(curve), values_(values),
        half_pieces_(
            std::clamp(4 * kMaxControlPoints / curve.points.size(), std::size_t{2}, kMaxPiecesOfPiece) / 2) {}

  bool find() {
    for (std::size_t i = 0; i < curve_.points.size(); ++i) {
      values_.push_back(curve_.points[i].value);
      if (i + 1 < curve_.points.size() && curve_.points[i].value < curve_.points[i + 1].value)
        find_inside(i);
    }
    return bent_;
  }

private:
  void find_inside(std::size_t piece) {
    const auto& a = curve_.points[piece];
    const auto& b = curve_.points[piece + 1];
    const bool equal = end_of(a) == end_of(b);
    if (equal || space_of(curve_) == ColorSpace::step)
      return;
    const double middle = value_at_fraction(a.value, b.value, inner_midpoint(a.shape), curve_.logarithmic);
    const bool stepped = a.shape.sharpness > kStepped;
    if (stepped || a.shape.midpoint != 0.5)
      values_.push_back(middle);
    if (stepped)
      return;
    if (a.shape.sharpness < kStraight && space_of(curve_) == ColorSpace::rgb && !curve_.logarithmic)
      return;
    bent_ = true;
    values_.push_back(middle);
    refine(piece, a.value, middle, half_pieces_);
    refine(piece, middle, b.value, half_pieces_);
  }

  void refine(std::size_t piece, double low, double high, std::size_t pieces) {
    const double middle = low + (high - low) / 2;
    if (pieces < 2 || !(low < middle && middle < high))
      return;
    double worst = 0;
    for (double s = 0.125; s < 1; s += 0.125) {
      const auto straight =
          mix_ends(ColorSpace::rgb, inside_piece(curve_, piece, low), inside_piece(curve_, piece, high), s);
      worst = std::max(worst, distance(straight, inside_piece(curve_, piece, low + s * (high - low))));
    }
    if (worst <= kResamplingTolerance)
      return;
    refine(piece, low, middle, pieces / 2);
    values_.push_back(middle);
    refine(piece, middle, high, pieces / 2);
  }

  static double distance(double a, double b) { return std::abs(a - b); }
  static double distance(const dvec3& a, const dvec3& b) {
    const dvec3 d = glm::abs(a - b);
    return std::max({d.x, d.y, d.z});
  }

  const Curve& curve_;
  std::vector<double>& values_;
  std::size_t half_pieces_; ///< of one piece's half; fewer where there are many points
  bool bent_ = false;
};

TransferPoint limits(const ColorCurve& color, const OpacityCurve& opacity, double value, bool right) {
  const dvec3 rgb = limit(color, value, right);
  return {value, rgb.r, rgb.g, rgb.b, limit(opacity, value, right)};
}

bool same_color(const TransferPoint& a, const TransferPoint& b) {
  return a.r == b.r && a.g == b.g && a.b == b.b && a.opacity == b.opacity;
}

double measured_deviation(const TransferFunction& transfer, const ColorCurve& color,
                          const OpacityCurve& opacity) {
  double worst = 0;
  for (std::size_t i = 0; i + 1 < transfer.points.size(); ++i) {
    const double low = transfer.points[i].value;
    const double high = transfer.points[i + 1].value;
    for (int k = 1; k <= 8 && low < high; ++k) {
      const double value = low + (high - low) * k / 9.0;
      if (!(low < value && value < high))
        continue;
      const glm::dvec4 is = evaluate(transfer, value);
      const glm::dvec4 d = glm::abs(is - glm::dvec4(evaluate(color, value), evaluate(opacity, value)));
      worst = std::max({worst, d.r, d.g, d.b, d.a});
    }
  }
  return worst;
}

template <class Curve>
void validate_curve(const Curve& curve, const std::string& what) {
  const auto& points = curve.points;
  if (points.empty())
    throw UsageError("there is no " + what + "; at least one is needed");
  if (points.size() > kMaxControlPoints) {
    throw UsageError("there are " + std::to_string(points.size()) + " " + what + "s; at most " +
                     std::to_string(kMaxControlPoints) + " are taken");
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& point = points[i];
    const std::string name = what + " " + std::to_string(i + 1) + " (value " + number_text(point.value) + ")";
    if (!(std::abs(point.value) <= kMaxTransferValue))
      throw UsageError(name + ": the value must be a number within ±1e38");
    if (curve.logarithmic && !(point.value > 0))
      throw UsageError(name + ": a logarithmic scale needs values above 0");
    if (i > 0 && point.value < points[i - 1].value)
      throw UsageError(name + ": values must not decrease, and the one before is " +
                       number_text(points[i - 1].value));
    const auto check = [&](const char* channel, double number) {
      if (!(number >= 0 && number <= 1)) // also catches NaN
        throw UsageError(name + ": " + channel + " is " + number_text(number) + "; it must be in [0,1]");
    };
    if constexpr (std::is_same_v<Curve, ColorCurve>) {
      check("red", point.rgb.r);
      check("green", point.rgb.g);
      check("blue", point.rgb.b);
    } else {
      check("opacity", point.opacity);
    }
    check("midpoint", point.shape.midpoint);
    check("sharpness", point.shape.sharpness);
  }
}

} // namespace

double piece_weight(const PieceShape& shape, double s) {
  s = centred(shape, s);
  if (shape.sharpness > kStepped)
    return s < 0.5 ? 0 : 1;
  if (shape.sharpness < kStraight)
    return s;
  s = narrowed(shape.sharpness, s);
  // Hermite's basis with one slope, (1 − sharpness)(b − a), at both ends: a + w·(b − a).
  const double up = s * s * (3 - 2 * s);
  const double slopes = s * (1 - s) * (1 - 2 * s);
  return std::clamp(up + (1 - shape.sharpness) * slopes, 0.0, 1.0);
}

dvec3 evaluate(const ColorCurve& curve, double value) { return limit(curve, value, true); }
double evaluate(const OpacityCurve& curve, double value) { return limit(curve, value, true); }

void validate(const ColorCurve& curve) { validate_curve(curve, "colour point"); }
void validate(const OpacityCurve& curve) { validate_curve(curve, "opacity point"); }

JoinedCurves join(const ColorCurve& color, const OpacityCurve& opacity) {
  validate(color);
  validate(opacity);
  JoinedCurves joined;
  std::vector<double> values;
  const bool bent_color = KnotFinder(color, values).find();
  const bool bent_opacity = KnotFinder(opacity, values).find();
  joined.resampled = bent_color || bent_opacity;
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  for (const double value : values) {
    const TransferPoint left = limits(color, opacity, value, false);
    const TransferPoint right = limits(color, opacity, value, true);
    joined.transfer.points.push_back(left);
    if (!same_color(left, right))
      joined.transfer.points.push_back(right);
  }
  joined.deviation = measured_deviation(joined.transfer, color, opacity);
  return joined;
}

} // namespace slicelens
