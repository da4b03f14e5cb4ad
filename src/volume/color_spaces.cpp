#include "volume/color_spaces.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace slicelens {

using glm::dvec3;

namespace {

// sRGB (IEC 61966-2-1) with the matrices and the white point to four digits, as VTK has them.
constexpr double kWhite[3] = {0.9505, 1.0, 1.089};

double linear_from_display(double v) { return v > 0.04045 ? std::pow((v + 0.055) / 1.055, 2.4) : v / 12.92; }

double display_from_linear(double v) {
  return v > 0.0031308 ? 1.055 * std::pow(v, 1 / 2.4) - 0.055 : 12.92 * v;
}

/// The cube root of CIE 1976 with its straight piece near black, and its inverse.
double lightness(double t) { return t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16.0 / 116; }
double from_lightness(double f) {
  const double cube = f * f * f;
  return cube > 0.008856 ? cube : (f - 16.0 / 116) / 7.787;
}

/// Moreland's polar form of L*a*b*: magnitude, saturation angle, hue angle.
dvec3 msh_from_lab(const dvec3& lab) {
  const double magnitude = glm::length(lab);
  const double saturation = magnitude > 0.001 ? std::acos(std::min(lab.x / magnitude, 1.0)) : 0.0;
  return {magnitude, saturation, saturation > 0.001 ? std::atan2(lab.z, lab.y) : 0.0};
}

dvec3 lab_from_msh(const dvec3& msh) {
  return {msh.x * std::cos(msh.y), msh.x * std::sin(msh.y) * std::cos(msh.z),
          msh.x * std::sin(msh.y) * std::sin(msh.z)};
}

/// A hue for the unsaturated end, so that the change looks even (Moreland 2009, §4.3).
double adjusted_hue(const dvec3& saturated, double unsaturated_magnitude) {
  if (saturated.x >= unsaturated_magnitude - 0.1)
    return saturated.z;
  const double spin = saturated.y *
                      std::sqrt(unsaturated_magnitude * unsaturated_magnitude - saturated.x * saturated.x) /
                      (saturated.x * std::sin(saturated.y));
  return saturated.z > -0.3 * std::numbers::pi ? saturated.z + spin : saturated.z - spin;
}

dvec3 mix_diverging(const dvec3& rgb_a, const dvec3& rgb_b, double weight) {
  dvec3 a = msh_from_lab(lab_from_rgb(rgb_a));
  dvec3 b = msh_from_lab(lab_from_rgb(rgb_b));
  const double apart = std::abs(std::remainder(a.z - b.z, 2 * std::numbers::pi));
  if (a.y > 0.05 && b.y > 0.05 && apart > 0.33 * std::numbers::pi) {
    const dvec3 white(std::max({a.x, b.x, 88.0}), 0, 0);
    if (weight < 0.5) {
      b = white;
      weight = 2 * weight;
    } else {
      a = white;
      weight = 2 * weight - 1;
    }
  }
  if (a.y < 0.05 && b.y > 0.05)
    a.z = adjusted_hue(b, a.x);
  else if (b.y < 0.05 && a.y > 0.05)
    b.z = adjusted_hue(a, b.x);
  return rgb_from_lab(lab_from_msh(glm::mix(a, b, weight)));
}

dvec3 mix_hsv(const dvec3& rgb_a, const dvec3& rgb_b, double weight, bool wrapped) {
  dvec3 a = hsv_from_rgb(rgb_a);
  dvec3 b = hsv_from_rgb(rgb_b);
  if (wrapped && std::abs(a.x - b.x) > 0.5)
    (a.x > b.x ? a.x : b.x) -= 1;
  dvec3 hsv = glm::mix(a, b, weight);
  hsv.x -= std::floor(hsv.x);
  return rgb_from_hsv(hsv);
}

} // namespace

dvec3 lab_from_rgb(const dvec3& rgb) {
  const dvec3 v(linear_from_display(rgb.r), linear_from_display(rgb.g), linear_from_display(rgb.b));
  const double x = lightness((0.4124 * v.r + 0.3576 * v.g + 0.1805 * v.b) / kWhite[0]);
  const double y = lightness((0.2126 * v.r + 0.7152 * v.g + 0.0722 * v.b) / kWhite[1]);
  const double z = lightness((0.0193 * v.r + 0.1192 * v.g + 0.9505 * v.b) / kWhite[2]);
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

dvec3 rgb_from_lab(const dvec3& lab) {
  const double f = (lab.x + 16) / 116;
  const double x = kWhite[0] * from_lightness(f + lab.y / 500);
  const double y = kWhite[1] * from_lightness(f);
  const double z = kWhite[2] * from_lightness(f - lab.z / 200);
  dvec3 rgb(display_from_linear(3.2406 * x - 1.5372 * y - 0.4986 * z),
            display_from_linear(-0.9689 * x + 1.8758 * y + 0.0415 * z),
            display_from_linear(0.0557 * x - 0.2040 * y + 1.0570 * z));
  rgb /= std::max({rgb.r, rgb.g, rgb.b, 1.0});
  return glm::max(rgb, 0.0);
}

dvec3 hsv_from_rgb(const dvec3& rgb) {
  const double value = std::max({rgb.r, rgb.g, rgb.b});
  const double spread = value - std::min({rgb.r, rgb.g, rgb.b});
  if (spread <= 0)
    return {0, 0, value};
  double sixths = 0;
  if (rgb.r == value)
    sixths = (rgb.g - rgb.b) / spread;
  else if (rgb.g == value)
    sixths = 2 + (rgb.b - rgb.r) / spread;
  else
    sixths = 4 + (rgb.r - rgb.g) / spread;
  return {sixths < 0 ? sixths / 6 + 1 : sixths / 6, spread / value, value};
}

dvec3 rgb_from_hsv(const dvec3& hsv) {
  const auto channel = [&](double shift) {
    const double k = std::fmod(shift + 6 * hsv.x, 6.0);
    return hsv.z * (1 - hsv.y * std::clamp(std::min(k, 4 - k), 0.0, 1.0));
  };
  return {channel(5), channel(3), channel(1)};
}

dvec3 mix_colors(ColorSpace space, const dvec3& a, const dvec3& b, double weight) {
  dvec3 rgb(0);
  switch (space) {
  case ColorSpace::rgb:
    rgb = glm::mix(a, b, weight);
    break;
  case ColorSpace::hsv:
  case ColorSpace::hsv_wrapped:
    rgb = mix_hsv(a, b, weight, space == ColorSpace::hsv_wrapped);
    break;
  case ColorSpace::lab:
    rgb = rgb_from_lab(glm::mix(lab_from_rgb(a), lab_from_rgb(b), weight));
    break;
  case ColorSpace::diverging:
    rgb = mix_diverging(a, b, weight);
    break;
  case ColorSpace::step:
    rgb = b;
    break;
  }
  return glm::clamp(rgb, 0.0, 1.0);
}

} // namespace slicelens
