// Probing the displayed volume along a line, and picking with it (Brunet, Nowak and Gleicher 2006 §4.1;
// docs/papers/brunet_probes.md).
#pragma once

#include "gl/context.h"
#include "render/prepare.h"

#include <optional>
#include <vector>

namespace slicelens {

/// A part of a viewing ray that may meet the displayed volume.
struct ProbeLine {
  glm::dvec3 begin{0}; ///< nearest to the viewer; texture coordinates of the displayed volume
  glm::dvec3 end{0};
  double near = 0; ///< world distance of `begin` from the ray's start: the eye, or the plane through it
  double far = 0;
};

/// The line of image position (x, y), pixels from the top left corner, pixel centres at +½: within the bounds
/// of the displayed volume and the clipping planes that bound it. Nothing where the ray misses them.
std::optional<ProbeLine> probe_line(const PreparedScene& prepared, double x, double y);

struct ProbeSample {
  double distance = 0;   ///< world units from the ray's start
  glm::dvec3 object{0};  ///< where it is shown, texture coordinates of the displayed volume
  glm::dvec3 texture{0}; ///< where its data is
  bool inside = false;   ///< there is data; the rest is 0 otherwise
  double value = 0;
  double opacity = 0;  ///< per reference length Δ₀, after attenuation
  double gradient = 0; ///< length of the displayed volume's gradient, data units per world unit, of the kind
                       ///< that shades the scene, else of central differences
};

/// Most samples of one line.
inline constexpr int max_probe_samples = 16384;

/// Four samples for each slice distance Δ, at least 64 and at most max_probe_samples or the driver's limit.
int probe_sample_count(const PreparedScene& prepared, const ProbeLine& line);

/// `count` samples at (k+½)/count of the line: rasterises it through the scene's shaders and reads it back.
/// The scene must be drawn by `slices` or `fragment`, unclassified. Throws LimitError, GraphicsError,
/// UsageError for a volume of colours.
std::vector<ProbeSample> sample_line(const PreparedScene& prepared, const gl::Context& context,
                                     const ProbeLine& line, int count);

/// The paper's three rules; nothing where no sample fulfils them.
/// First non-zero alpha.
std::optional<std::size_t> first_visible(const std::vector<ProbeSample>& samples);
/// First gradient of at least `threshold`.
std::optional<std::size_t> first_gradient(const std::vector<ProbeSample>& samples, double threshold);
/// The plain running sum of α·Δs/Δ₀ reaches one: `ratio` = Δs/Δ₀, Δs the distance between samples.
std::optional<std::size_t> first_accumulated(const std::vector<ProbeSample>& samples, double ratio);

/// pick.gradient, or a tenth of the data's range over the smallest voxel spacing.
double gradient_threshold(const PreparedScene& prepared);

} // namespace slicelens
