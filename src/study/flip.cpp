#include "study/flip.h"

#include "core/errors.h"
#include "core/text.h"
#include "image/colormap.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

namespace slicelens {

using glm::dvec3;

namespace {

// Andersson et al. 2020, §4: the exponents of the colour and the feature pipeline, and the two numbers that
// spread the colour errors over [0,1]: p_c·c_max goes to p_t.
constexpr double q_c = 0.7;
constexpr double q_f = 0.5;
constexpr double p_c = 0.4;
constexpr double p_t = 0.95;
constexpr double feature_width = 0.082; ///< degrees from peak to trough of the edge detector (§4.2)

/// XYZ of linear sRGB under D65, rows as they are written on paper.
glm::dmat3 xyz_from_rgb() {
  return glm::transpose(glm::dmat3(10135552.0 / 24577794, 8788810.0 / 24577794, 4435075.0 / 24577794, //
                                   2613072.0 / 12288897, 8788810.0 / 12288897, 887015.0 / 12288897,   //
                                   1425312.0 / 73733382, 8788810.0 / 73733382, 70074185.0 / 73733382));
}

/// X, Y and Z, each divided by that of white.
dvec3 relative_xyz(const dvec3& rgb) {
  static const glm::dmat3 matrix = xyz_from_rgb();
  static const dvec3 white = matrix * dvec3(1);
  return matrix * rgb / white;
}

dvec3 rgb_from_relative_xyz(const dvec3& xyz) {
  static const glm::dmat3 inverse = glm::inverse(xyz_from_rgb());
  static const dvec3 white = xyz_from_rgb() * dvec3(1);
  return inverse * (xyz * white);
}

double linear_from_srgb(double value) {
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

/// L*a*b* without its cube roots: the linear opponent space that is filtered (§4.1).
dvec3 opponent(const dvec3& xyz) { return {116 * xyz.y - 16, 500 * (xyz.x - xyz.y), 200 * (xyz.y - xyz.z)}; }

dvec3 xyz_from_opponent(const dvec3& ycc) {
  const double y = (ycc.x + 16) / 116;
  return {y + ycc.y / 500, y, y - ycc.z / 200};
}

/// CIE L*a*b* with a* and b* scaled by L*/100, because chroma shows less in the dark (§4.1).
dvec3 hunt_lab(const dvec3& rgb) {
  constexpr double delta = 6.0 / 29;
  dvec3 root = relative_xyz(rgb);
  for (int c = 0; c < 3; ++c)
    root[c] = root[c] > delta * delta * delta ? std::cbrt(root[c]) : root[c] / (3 * delta * delta) + 4.0 / 29;
  const dvec3 lab = opponent(root);
  return {lab.x, 0.01 * lab.x * lab.y, 0.01 * lab.x * lab.z};
}

double hyab(const dvec3& a, const dvec3& b) { return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z); }

/// Errors below p_c·c_max fill [0, p_t], the rare ones above the rest (§4.1).
double spread(double error) {
  static const double largest = std::pow(hunt_hyab(dvec3(0, 1, 0), dvec3(0, 0, 1)), q_c);
  const double knee = p_c * largest;
  if (error < knee)
    return p_t * error / knee;
  return p_t + (1 - p_t) * (error - knee) / (largest - knee);
}

/// One Gaussian of a contrast sensitivity function: amplitude·√(π/b)·e^(−π²d²/b), d in degrees.
struct Sensitivity {
  double amplitude = 0;
  double b = 1;
};
/// Achromatic, red-green and blue-yellow (§4.1): the last is a sum of two.
constexpr std::array<std::array<Sensitivity, 2>, 3> sensitivities = {
    {{{{1, 0.0047}, {0, 1}}}, {{{1, 0.0053}, {0, 1}}}, {{{34.1, 0.04}, {13.5, 0.025}}}}};

void each_row(int height, const auto& work) {
  tbb::parallel_for(tbb::blocked_range<int>(0, height, 8), [&](const auto& range) {
    for (int y = range.begin(); y != range.end(); ++y)
      work(y);
  });
}

std::vector<double> gaussian(int radius, const auto& exponent) {
  std::vector<double> weights;
  for (int i = -radius; i <= radius; ++i)
    weights.push_back(std::exp(-exponent(static_cast<double>(i))));
  return weights;
}

/// The plane as the eye resolves it at that distance: filtered with the channel's function, weights' sum 1.
PixelPlane seen(const PixelPlane& plane, const std::array<Sensitivity, 2>& function, double ppd) {
  constexpr double widest = 0.04; // all three filters have the radius of the widest, three deviations
  constexpr double pi = std::numbers::pi;
  const int radius = static_cast<int>(std::ceil(3 * std::sqrt(widest / (2 * pi * pi)) * ppd));
  PixelPlane result = make_plane(plane.width, plane.height);
  double total = 0;
  for (const Sensitivity& part : function) {
    if (part.amplitude == 0)
      continue;
    const double scale = part.amplitude * std::sqrt(pi / part.b);
    const auto weights = gaussian(radius, [&](double i) { return pi * pi * (i / ppd) * (i / ppd) / part.b; });
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    const PixelPlane blurred = filtered(plane, weights, weights);
    for (std::size_t i = 0; i < result.values.size(); ++i)
      result.values[i] += scale * blurred.values[i];
    total += scale * sum * sum;
  }
  for (double& value : result.values)
    value /= total;
  return result;
}

/// First and second derivative of a Gaussian across, and the Gaussian for the other direction. The positive
/// weights of a detector, taken over the plane, have the sum 1, the negative ones −1 (§4.2).
struct Detectors {
  std::vector<double> edge;
  std::vector<double> point;
  std::vector<double> along;
};

void normalize(std::vector<double>& weights) {
  double positive = 0;
  double negative = 0;
  for (const double weight : weights)
    (weight > 0 ? positive : negative) += std::abs(weight);
  for (double& weight : weights)
    weight /= weight > 0 ? positive : negative;
}

Detectors detectors(double ppd) {
  const double deviation = 0.5 * feature_width * ppd;
  const int radius = static_cast<int>(std::ceil(3 * deviation));
  Detectors result;
  result.along = gaussian(radius, [&](double i) { return i * i / (2 * deviation * deviation); });
  result.edge = result.along;
  result.point = result.along;
  for (int i = -radius; i <= radius; ++i) {
    const auto k = static_cast<std::size_t>(i + radius);
    result.edge[k] *= -i;
    result.point[k] *= i * i / (deviation * deviation) - 1;
  }
  normalize(result.edge);
  normalize(result.point);
  const double sum = std::accumulate(result.along.begin(), result.along.end(), 0.0);
  for (double& weight : result.along)
    weight /= sum;
  return result;
}

/// Length of the responses across and down.
PixelPlane response(const PixelPlane& plane, const std::vector<double>& detector,
                    const std::vector<double>& along) {
  PixelPlane across = filtered(plane, detector, along);
  const PixelPlane down = filtered(plane, along, detector);
  for (std::size_t i = 0; i < across.values.size(); ++i)
    across.values[i] = std::hypot(across.values[i], down.values[i]);
  return across;
}

/// What the two pipelines make of one picture.
struct Percept {
  std::vector<dvec3> colors; ///< filtered, Hunt-adjusted L*a*b*
  PixelPlane edges;
  PixelPlane points;
};

Percept percept(const Image& image, const dvec3& background, double ppd) {
  std::array<PixelPlane, 3> channels;
  channels.fill(make_plane(image.width, image.height));
  PixelPlane luminance = channels[0];
  each_row(image.height, [&](int y) {
    for (int x = 0; x < image.width; ++x) {
      dvec3 rgb = glm::clamp(color_over(image, x, y, background), 0.0, 1.0);
      for (int c = 0; c < 3; ++c)
        rgb[c] = linear_from_srgb(rgb[c]);
      const dvec3 xyz = relative_xyz(rgb);
      const dvec3 ycc = opponent(xyz);
      for (int c = 0; c < 3; ++c)
        channels[static_cast<std::size_t>(c)].at(x, y) = ycc[c];
      luminance.at(x, y) = xyz.y;
    }
  });
  for (std::size_t c = 0; c < 3; ++c)
    channels[c] = seen(channels[c], sensitivities[c], ppd);
  Percept result;
  result.colors.resize(luminance.values.size());
  each_row(image.height, [&](int y) {
    for (int x = 0; x < image.width; ++x) {
      const dvec3 ycc(channels[0].at(x, y), channels[1].at(x, y), channels[2].at(x, y));
      result.colors[static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                    static_cast<std::size_t>(x)] =
          hunt_lab(glm::clamp(rgb_from_relative_xyz(xyz_from_opponent(ycc)), 0.0, 1.0));
    }
  });
  const Detectors d = detectors(ppd);
  result.edges = response(luminance, d.edge, d.along);
  result.points = response(luminance, d.point, d.along);
  return result;
}

} // namespace

double pixels_per_degree(double distance, double pixels, double width) {
  return distance * (pixels / width) * std::numbers::pi / 180;
}

double hunt_hyab(const dvec3& a, const dvec3& b) { return hyab(hunt_lab(a), hunt_lab(b)); }

PixelPlane flip_errors(const Image& a, const Image& b, const dvec3& background_a, const dvec3& background_b,
                       double pixels_per_degree) {
  if (a.width != b.width || a.height != b.height || a.width < 1 || a.height < 1)
    throw UsageError("FLIP needs two pictures of the same size, with pixels");
  if (!(pixels_per_degree >= 1 && pixels_per_degree <= 1000)) {
    throw UsageError("pixels per degree must be from 1 to 1000, not " + number_text(pixels_per_degree) +
                     "; a 3840 pixels and 0.7 m wide display at 0.7 m has 67");
  }
  const Percept pa = percept(a, background_a, pixels_per_degree);
  const Percept pb = percept(b, background_b, pixels_per_degree);
  PixelPlane errors = make_plane(a.width, a.height);
  for (std::size_t i = 0; i < errors.values.size(); ++i) {
    const double color = spread(std::pow(hyab(pa.colors[i], pb.colors[i]), q_c));
    const double feature = std::max(std::abs(pa.edges.values[i] - pb.edges.values[i]),
                                    std::abs(pa.points.values[i] - pb.points.values[i]));
    // √2 is the largest length of two responses (§4.2). A feature difference raises the error (§4.3).
    const double share = std::min(feature / std::numbers::sqrt2, 1.0);
    errors.values[i] = std::min(std::pow(color, 1 - std::pow(share, q_f)), 1.0);
  }
  return errors;
}

double mean_of(const PixelPlane& plane) {
  return std::accumulate(plane.values.begin(), plane.values.end(), 0.0) /
         static_cast<double>(plane.values.size());
}

Image flip_picture(const PixelPlane& errors) {
  Image image = make_image(errors.width, errors.height);
  for (int y = 0; y < errors.height; ++y) {
    for (int x = 0; x < errors.width; ++x) {
      const glm::vec3 color = heat_color(errors.at(x, y));
      for (int c = 0; c < 3; ++c)
        channel(image, x, y, c) = color[c];
      channel(image, x, y, 3) = 1;
    }
  }
  return image;
}

} // namespace slicelens
