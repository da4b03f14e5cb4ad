#include "volume/closed_forms.h"

#include "volume/phantom.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace slicelens {

namespace {

/// The line in texture space, parameters counted in world length from the point nearest to the ray's origin.
struct TextureLine {
  Ray ray;            ///< texture space; the parameter is world length
  double lowest = 0;  ///< where it enters the box
  double highest = 0; ///< where it leaves the box
};

std::optional<TextureLine> line_in_box(const Box& box, const Ray& ray) {
  const glm::dmat4 to_texture = texture_from_world(box);
  const glm::dvec3 unit = glm::normalize(ray.direction);
  TextureLine line;
  line.ray.origin = glm::dvec3(to_texture * glm::dvec4(ray.origin, 1));
  line.ray.direction = glm::dvec3(to_texture * glm::dvec4(unit, 0));
  const auto hit = intersect_unit_cube(line.ray);
  if (!hit)
    return std::nullopt;
  line.lowest = hit->near;
  line.highest = hit->far;
  return line;
}

/// World parameter (length from the ray's origin) of the point of the line nearest to `point`.
double nearest_parameter(const glm::dvec3& point, const Ray& ray) {
  return glm::dot(point - ray.origin, glm::normalize(ray.direction));
}

double blob_sigma(const Box& box) { return kBlobSigma * extent(box).x; }

glm::dvec4 over(const glm::dvec4& front, const glm::dvec4& back) { return front + (1 - front.a) * back; }

glm::dvec4 constant_segment(const glm::dvec4& rgba, double length, double unit_distance) {
  const double alpha = opacity_from_extinction(extinction_from_opacity(rgba.a, unit_distance), length);
  return {glm::dvec3(rgba) * alpha, alpha};
}

/// ∫ −ln u du, which is 0 at u = 0.
double log_integral(double u) { return u > 0 ? u - u * std::log(u) : 0; }

/// Optical depth from 0 to s when opacity goes linearly from a0 to a1 over `length`.
double linear_depth(double a0, double a1, double s, double length, double unit_distance) {
  const double slope = (a1 - a0) / length;
  const double u0 = 1 - a0;
  const double u1 = 1 - (a0 + slope * s);
  // Where opacity hardly changes over s the antiderivative's difference cancels; the midpoint rule's error,
  // of third order in the change, is then below rounding.
  if (std::abs(u1 - u0) < 1e-5 * std::max(u0, u1)) {
    const double u = (u0 + u1) / 2;
    return s > 0 ? (u > 0 ? -std::log(u) * s / unit_distance : std::numeric_limits<double>::infinity()) : 0;
  }
  return std::max(0.0, (log_integral(u1) - log_integral(u0)) / (u1 - u0) * s / unit_distance);
}

/// ∫ f over [a, b] by 8-point Gauss-Legendre, halved until two levels agree to `tolerance`.
template <class Function>
double integrate(const Function& f, double a, double b, double tolerance, int depth = 0) {
  constexpr double x[4] = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267, 0.9602898564975363};
  constexpr double w[4] = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745, 0.1012285362903763};
  const auto rule = [&](double low, double high) {
    const double middle = (low + high) / 2;
    const double half = (high - low) / 2;
    double sum = 0;
    for (int i = 0; i < 4; ++i)
      sum += w[i] * (f(middle - half * x[i]) + f(middle + half * x[i]));
    return sum * half;
  };
  const double middle = (a + b) / 2;
  const double coarse = rule(a, b);
  const double fine = rule(a, middle) + rule(middle, b);
  if (depth >= 40 || std::abs(fine - coarse) <= tolerance)
    return fine;
  return integrate(f, a, middle, tolerance / 2, depth + 1) +
         integrate(f, middle, b, tolerance / 2, depth + 1);
}

/// A segment along which colour and opacity go linearly from `first` to `last`.
glm::dvec4 linear_segment(const glm::dvec4& first, const glm::dvec4& last, double length,
                          double unit_distance) {
  if (!(length > 0))
    return glm::dvec4(0);
  const auto transmittance = [&](double s) {
    return std::exp(-linear_depth(first.a, last.a, s, length, unit_distance));
  };
  // ∫ c τ T ds = −∫ c dT = c(0) − c(L)·T(L) + ∫ c' T ds.
  const double end = transmittance(length);
  const double mean = integrate(transmittance, 0, length, 1e-13 * length) / length;
  const glm::dvec3 c0(first);
  const glm::dvec3 c1(last);
  return {c0 - c1 * end + (c1 - c0) * mean, 1 - end};
}

} // namespace

double extinction_from_opacity(double alpha, double unit_distance) {
  return -std::log1p(-alpha) / unit_distance;
}

double opacity_from_extinction(double tau, double length) {
  return length > 0 ? -std::expm1(-tau * length) : 0; // 0·∞ would be NaN
}

double box_chord(const Box& box, const Ray& ray) {
  const auto line = line_in_box(box, ray);
  return line ? line->highest - line->lowest : 0;
}

std::optional<double> sphere_hit(const glm::dvec3& center, double radius, const Ray& ray) {
  const double half = sphere_chord(center, radius, ray) / 2;
  const glm::dvec3 unit = glm::normalize(ray.direction);
  if (!(half > 0))
    return std::nullopt;
  return (glm::dot(center - ray.origin, unit) - half) / glm::length(ray.direction);
}

double impact_distance(const glm::dvec3& point, const Ray& ray) {
  const double s = nearest_parameter(point, ray);
  return glm::length(ray.origin + s * glm::normalize(ray.direction) - point);
}

double sphere_chord(const glm::dvec3& center, double radius, const Ray& ray) {
  const double b = impact_distance(center, ray);
  return b < radius ? 2 * std::sqrt((radius - b) * (radius + b)) : 0;
}

double ball_chord(const Box& box, const Ray& ray) {
  return sphere_chord(center(box), kBallRadius * extent(box).x, ray);
}

double blob_xray(const Box& box, const Ray& ray, double unit_distance) {
  const double sigma = blob_sigma(box);
  const double b = impact_distance(center(box), ray) / sigma;
  return sigma / unit_distance * std::sqrt(2 * std::numbers::pi) * kBlobAmplitude * std::exp(-b * b / 2);
}

double blob_xray_clipped(const Box& box, const Ray& ray, double unit_distance) {
  const auto line = line_in_box(box, ray);
  if (!line)
    return 0;
  const double scale = std::numbers::sqrt2 * blob_sigma(box);
  const double middle = nearest_parameter(center(box), ray);
  const double inside =
      (std::erf((line->highest - middle) / scale) - std::erf((line->lowest - middle) / scale)) / 2;
  return blob_xray(box, ray, unit_distance) * inside;
}

double blob_average(const Box& box, const Ray& ray) {
  const double chord = box_chord(box, ray);
  return chord > 0 ? blob_xray_clipped(box, ray, 1) / chord : 0;
}

double blob_mip(const Box& box, const Ray& ray) {
  const auto line = line_in_box(box, ray);
  if (!line)
    return 0;
  const double s = std::clamp(nearest_parameter(center(box), ray), line->lowest, line->highest);
  const glm::dvec3 point = ray.origin + s * glm::normalize(ray.direction);
  const double b = glm::length(point - center(box)) / blob_sigma(box);
  return kBlobAmplitude * std::exp(-b * b / 2);
}

double ramp_value(double t_x, std::size_t nx) {
  const double half = 0.5 / static_cast<double>(nx);
  return std::clamp(t_x, half, 1 - half);
}

glm::dvec4 ramp_dvr(const Box& box, const Ray& ray, std::size_t nx, const glm::dvec4& low,
                    const glm::dvec4& high, double unit_distance) {
  const auto line = line_in_box(box, ray);
  if (!line)
    return glm::dvec4(0);
  const auto classify = [&](double s) {
    const double v = ramp_value(line->ray.origin.x + s * line->ray.direction.x, nx);
    return low * (1 - v) + high * v;
  };
  // The value is linear between, and constant beyond, the two places where the line passes an outer voxel
  // centre's plane.
  double cuts[4] = {line->lowest, line->lowest, line->highest, line->highest};
  if (line->ray.direction.x != 0) {
    const double half = 0.5 / static_cast<double>(nx);
    const double a = (half - line->ray.origin.x) / line->ray.direction.x;
    const double b = (1 - half - line->ray.origin.x) / line->ray.direction.x;
    cuts[1] = std::clamp(std::min(a, b), line->lowest, line->highest);
    cuts[2] = std::clamp(std::max(a, b), line->lowest, line->highest);
  }
  glm::dvec4 sum(0);
  for (int i = 0; i < 3; ++i) {
    const double length = cuts[i + 1] - cuts[i];
    const glm::dvec4 segment =
        i == 1 ? linear_segment(classify(cuts[1]), classify(cuts[2]), length, unit_distance)
               : constant_segment(classify((cuts[i] + cuts[i + 1]) / 2), length, unit_distance);
    sum = over(sum, segment);
  }
  return sum;
}

std::optional<RampRange> ramp_range(const Box& box, const Ray& ray, std::size_t nx) {
  const auto line = line_in_box(box, ray);
  if (!line)
    return std::nullopt;
  const double enter = line->ray.origin.x + line->lowest * line->ray.direction.x;
  const double leave = line->ray.origin.x + line->highest * line->ray.direction.x;
  const double first = std::min(enter, leave);
  const double last = std::max(enter, leave);
  const double half = 0.5 / static_cast<double>(nx);
  // ∫ from 0 to x of the value, which is linear between the outer voxel centres.
  const auto integral = [half](double x) {
    const double middle = std::clamp(x, half, 1 - half);
    return half * std::min(x, half) + (middle * middle - half * half) / 2 +
           (1 - half) * std::max(x - (1 - half), 0.0);
  };
  RampRange range{ramp_value(first, nx), ramp_value(last, nx), ramp_value((first + last) / 2, nx)};
  if (last - first > 1e-9) // else the quotient is rounding, and the middle is the mean
    range.average = (integral(last) - integral(first)) / (last - first);
  return range;
}

namespace {

/// The line's two parts on the sides of t_y = ½.
struct SlabLengths {
  double first = 0; ///< of the slab that the ray meets first
  double second = 0;
  bool front_first = true;
};

std::optional<SlabLengths> slab_lengths(const Box& box, const Ray& ray) {
  const auto line = line_in_box(box, ray);
  if (!line)
    return std::nullopt;
  const double speed = line->ray.direction.y;
  const double enter = line->ray.origin.y + line->lowest * speed;
  double cut = line->highest; // the whole chord in the slab where the line enters
  if (speed != 0)
    cut = std::clamp((0.5 - line->ray.origin.y) / speed, line->lowest, line->highest);
  return SlabLengths{cut - line->lowest, line->highest - cut, speed != 0 ? speed > 0 : enter < 0.5};
}

} // namespace

glm::dvec4 slabs_dvr(const Box& box, const Ray& ray, const glm::dvec4& front, const glm::dvec4& back,
                     double unit_distance) {
  const auto lengths = slab_lengths(box, ray);
  if (!lengths)
    return glm::dvec4(0);
  const glm::dvec4& first = lengths->front_first ? front : back;
  const glm::dvec4& second = lengths->front_first ? back : front;
  return over(constant_segment(first, lengths->first, unit_distance),
              constant_segment(second, lengths->second, unit_distance));
}

glm::dvec4 slabs_xray_front(const Box& box, const Ray& ray, const glm::dvec4& front, const glm::dvec4& back,
                            double unit_distance, double scale) {
  const auto lengths = slab_lengths(box, ray);
  if (!lengths)
    return glm::dvec4(0);
  const double in_front = lengths->front_first ? lengths->first : lengths->second;
  const double behind = lengths->front_first ? lengths->second : lengths->first;
  const double alpha = std::min(scale * front.a * in_front / unit_distance, 1.0);
  const glm::dvec4 integral(glm::dvec3(front) * alpha, alpha);
  const glm::dvec4 composited = constant_segment(back, behind, unit_distance);
  return lengths->front_first ? over(integral, composited) : over(composited, integral);
}

namespace {
constexpr double kPeaks = 6;         // f_M
constexpr double kModulation = 0.25; // α
} // namespace

double marschner_lobb(const glm::dvec3& t) {
  constexpr double pi = std::numbers::pi;
  const glm::dvec3 p = 2.0 * t - 1.0;
  const double r = std::sqrt(p.x * p.x + p.y * p.y);
  const double rho_r = std::cos(2 * pi * kPeaks * std::cos(pi * r / 2));
  return (1 - std::sin(pi * p.z / 2) + kModulation * (1 + rho_r)) / (2 * (1 + kModulation));
}

glm::dvec3 marschner_lobb_gradient(const glm::dvec3& t) {
  constexpr double pi = std::numbers::pi;
  const glm::dvec3 p = 2.0 * t - 1.0;
  const double r = std::sqrt(p.x * p.x + p.y * p.y);
  const double by_r = kModulation * std::sin(2 * pi * kPeaks * std::cos(pi * r / 2)) * pi * pi * kPeaks *
                      std::sin(pi * r / 2);
  const glm::dvec2 outward = r > 0 ? glm::dvec2(p) / r : glm::dvec2(0);
  // The factor 2 of p = 2t − 1 cancels that of the denominator.
  return glm::dvec3(by_r * outward, -pi / 2 * std::cos(pi * p.z / 2)) / (1 + kModulation);
}

} // namespace slicelens
