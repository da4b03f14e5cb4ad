#include "image/colormap.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace slicelens {

namespace {

/// OKLab to linear sRGB (Ottosson 2020).
glm::dvec3 linear_from_oklab(const glm::dvec3& lab) {
  const double l = lab.x + 0.3963377774 * lab.y + 0.2158037573 * lab.z;
  const double m = lab.x - 0.1055613458 * lab.y - 0.0638541728 * lab.z;
  const double s = lab.x - 0.0894841775 * lab.y - 1.2914855480 * lab.z;
  const double l3 = l * l * l;
  const double m3 = m * m * m;
  const double s3 = s * s * s;
  return {4.0767416621 * l3 - 3.3077115913 * m3 + 0.2309699292 * s3,
          -1.2684380046 * l3 + 2.6097574011 * m3 - 0.3413193965 * s3,
          -0.0041960863 * l3 - 0.7034186147 * m3 + 1.7076147010 * s3};
}

/// The transfer function of sRGB (IEC 61966-2-1).
double display_from_linear(double value) {
  const double v = std::clamp(value, 0.0, 1.0);
  return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
}

} // namespace

glm::vec3 heat_color(double t) {
  if (std::isnan(t))
    return glm::vec3(1);
  const double at = std::clamp(t, 0.0, 1.0);
  const double hue = (285 + 180 * at) * std::numbers::pi / 180;
  const double chroma =
      (0.52 - 0.42 * at) * at; // below what sRGB can show along this path, so nothing is clipped
  const glm::dvec3 rgb = linear_from_oklab({0.97 * at, chroma * std::cos(hue), chroma * std::sin(hue)});
  return {static_cast<float>(display_from_linear(rgb.r)), static_cast<float>(display_from_linear(rgb.g)),
          static_cast<float>(display_from_linear(rgb.b))};
}

} // namespace slicelens
