// Kinds of gradient against the normals of a sphere, as it is and deformed.

#include "bench.h"
#include "scene/names.h"
#include "volume/closed_forms.h"
#include "volume/phantom.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <numeric>

namespace slicelens::accuracy {

namespace {

constexpr int kVoxels = 64;
constexpr int kPixels = 96;
constexpr double kSpacing = 0.125;
constexpr double kRadius = kBallRadius * kVoxels; // voxels

/// Black under `transfer`, so that shading `tone` shows k = (1 + n·l)/2 of the first opaque sample.
Subject opaque_subject(const std::string& name, Volume volume, TransferFunction transfer) {
  Scene scene = oblique_scene(kPixels);
  scene.render.pipeline = Pipeline::rays;
  scene.render.spacing = kSpacing;
  scene.render.early_termination = 0.99;
  scene.render.shading = Shading::tone;
  scene.light.cool = {0, 0, 0};
  scene.light.warm = {1, 1, 1};
  return {name, prepare(std::move(scene), std::move(volume), std::move(transfer)), true};
}

/// Opaque from `threshold` on.
Subject sphere_subject(const std::string& name, Volume volume, double threshold) {
  return opaque_subject(name, std::move(volume), step_transfer(threshold, {0, 0, 0, 0}, {0, 0, 0, 1}));
}

struct Kind {
  std::string name;
  Gradient gradient;
  GradientResolution resolution = GradientResolution::full;
};

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> list = {
      {"forward", Gradient::forward},
      {"central", Gradient::central},
      {"prefiltered, full", Gradient::prefiltered, GradientResolution::full},
      {"prefiltered, half", Gradient::prefiltered, GradientResolution::half},
      {"prefiltered, quarter", Gradient::prefiltered, GradientResolution::quarter},
      {"precomputed", Gradient::precomputed}};
  return list;
}

struct Display {
  std::string name;
  std::vector<Warp> warps;
};

/// Focal point and lens beside the sphere's centre, so that the deformed sphere has no symmetry.
std::vector<Display> displays() {
  Fisheye fisheye;
  fisheye.center = {0.4, 0.3, 0.55};
  fisheye.distortion = glm::dvec3(2);
  const LensBox box = {{0.35, 0.3, 0.55}, glm::dvec3(0.12), glm::dvec3(0.3), 2};
  Twist twist;
  twist.center = {0.4, 0.45, 0.5};
  twist.angle = 120;
  Sine sine;
  sine.axis = Axis::x;
  sine.along = Axis::z;
  sine.amplitude = 0.04;
  sine.wavelength = 0.5;
  return {{"undeformed", {}},
          {"fisheye", {fisheye}},
          {"connected lens", {ConnectedLens{box}}},
          {"twist", {twist}},
          {"sine", {sine}}};
}

/// Signed distance in voxels from the sphere of what is shown at p, texture coordinates.
double level(const PreparedScene& prepared, const glm::dvec3& p) {
  const glm::dvec3 u = texture_from_object(prepared.maps, box_from_texture(prepared.space, p));
  return kVoxels * glm::length(u - 0.5) - kRadius; // the box is a cube
}

/// Outward normal of the deformed sphere where the ray first meets it, by differences of the exact level:
/// world axes are the box's own. Nothing where it is met under more than 60°, where a step along the ray goes
/// far round the surface.
std::optional<glm::dvec3> true_normal(const PreparedScene& prepared, const Ray& ray) {
  const glm::dmat4 texture_from_world = glm::inverse(prepared.box.world_from_texture);
  const auto at = [&](double s) {
    return glm::dvec3(texture_from_world * glm::dvec4(ray.origin + s * ray.direction, 1));
  };
  const double middle = -glm::dot(ray.origin, ray.direction); // the box's centre is the world's origin
  constexpr double step = 0.1;
  double s = middle - kVoxels;
  while (s < middle + kVoxels && level(prepared, at(s)) > 0)
    s += step;
  if (s >= middle + kVoxels)
    return std::nullopt;
  double low = s - step;
  for (int i = 0; i < 50; ++i) {
    const double half = 0.5 * (low + s);
    (level(prepared, at(half)) > 0 ? low : s) = half;
  }
  glm::dvec3 normal(0);
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 h(0);
    h[axis] = 1e-6;
    normal[axis] = level(prepared, at(s) + h) - level(prepared, at(s) - h);
  }
  normal = glm::normalize(normal);
  return -glm::dot(normal, ray.direction) > 0.5 ? std::optional(normal) : std::nullopt;
}

/// Three pictures whose light lies along the world's axes: the normals that shading sees.
std::array<Image, 3> lit_along_axes(const Bench& bench, Subject& subject, const Change& change) {
  std::array<Image, 3> along;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    along[axis] = draw(bench, subject, [&](Scene& scene) {
      glm::dvec3 light(0);
      light[static_cast<int>(axis)] = 1;
      scene.light.direction = light;
      change(scene);
    });
  }
  return along;
}

/// Angle in degrees between a true normal and the one at a pixel.
double angle_at(const std::array<Image, 3>& along, int x, int y, const glm::dvec3& normal) {
  glm::dvec3 seen;
  for (int axis = 0; axis < 3; ++axis)
    seen[axis] = 2 * static_cast<double>(channel(along[static_cast<std::size_t>(axis)], x, y, 0)) - 1;
  const double cosine = glm::length(seen) > 0 ? glm::dot(glm::normalize(seen), normal) : 0;
  return glm::degrees(std::acos(std::clamp(cosine, -1.0, 1.0)));
}

/// Angles between true normals and those of the picture, in degrees.
std::vector<double> sphere_angles(const Bench& bench, Subject& subject, const Display& display,
                                  const Change& change) {
  const std::array<Image, 3> along = lit_along_axes(bench, subject, [&](Scene& scene) {
    scene.warp = display.warps;
    change(scene);
  });
  const Scene before = subject.prepared.scene;
  subject.prepared.scene.warp = display.warps;
  prepare_again(subject.prepared);
  std::vector<double> angles;
  for (int y = 0; y < kPixels; ++y) {
    for (int x = 0; x < kPixels; ++x) {
      const auto normal =
          true_normal(subject.prepared, ray_from_pixel(subject.prepared.view, x + 0.5, y + 0.5));
      if (!normal || channel(along[0], x, y, 3) < 0.5F)
        continue;
      angles.push_back(angle_at(along, x, y, *normal));
    }
  }
  subject.prepared.scene = before;
  prepare_again(subject.prepared);
  return angles;
}

double mean_of(const std::vector<double>& angles) {
  return std::accumulate(angles.begin(), angles.end(), 0.0) / static_cast<double>(angles.size());
}

/// "mean, 95th percentile".
std::string error_cell(const Bench& bench, Subject& subject, const Display& display, const Change& change) {
  std::vector<double> angles = sphere_angles(bench, subject, display, change);
  if (angles.empty())
    return "–";
  const std::size_t most = angles.size() * 95 / 100;
  std::nth_element(angles.begin(), angles.begin() + static_cast<std::ptrdiff_t>(most), angles.end());
  return fixed(mean_of(angles), 2) + ", " + fixed(angles[most], 2);
}

/// "mean, largest".
std::string mean_and_largest(const std::vector<double>& angles) {
  return fixed(mean_of(angles), 2) + ", " + fixed(*std::max_element(angles.begin(), angles.end()), 2);
}

/// The Marschner-Lobb signal, opaque, cut across the view through its middle: every pixel shows the first
/// sample behind the cut.
Subject cut_signal(int n) {
  const auto edge = static_cast<std::size_t>(n);
  Subject subject =
      opaque_subject("marschner-lobb " + std::to_string(n) + "³",
                     make_phantom("marschner-lobb", {edge, edge, edge}), constant_transfer({0, 0, 0, 1}));
  ClipSettings cut;
  cut.normal = subject.prepared.view.forward;
  subject.prepared.scene.clip = {cut};
  prepare_again(subject.prepared);
  return subject;
}

/// Angles between the signal's own gradients and those of the picture, an eighth of the box away from its
/// faces and more.
std::vector<double> signal_angles(const Bench& bench, Subject& subject, const Change& change) {
  const std::array<Image, 3> along = lit_along_axes(bench, subject, change);
  const PreparedScene& prepared = subject.prepared;
  const glm::dmat4 to_texture = texture_from_world(prepared.box);
  std::vector<double> angles;
  for (int y = 0; y < kPixels; ++y) {
    for (int x = 0; x < kPixels; ++x) {
      const Ray ray = ray_from_pixel(prepared.view, x + 0.5, y + 0.5);
      // The box's centre is the world's origin; the first sample is half a step behind it.
      const double s = 0.5 * prepared.spacing - glm::dot(ray.origin, ray.direction);
      const glm::dvec3 t(to_texture * glm::dvec4(ray.origin + s * ray.direction, 1));
      const glm::dvec3 off = glm::abs(t - 0.5);
      if (std::max({off.x, off.y, off.z}) < 0.375)
        angles.push_back(angle_at(along, x, y, -glm::normalize(marschner_lobb_gradient(t))));
    }
  }
  return angles;
}

/// Kinds, and the filter that `central` differences are taken of, on spheres and on the signal.
void signal_table(const Bench& bench, Subject& smooth, Subject& solid) {
  std::cout
      << "### Spheres and the Marschner-Lobb signal, undeformed: mean and largest angle\n\n"
         "Spheres as above. The signal is cut across the view through its middle, which shows gradients "
         "of every direction; angles are against its formula at the very points sampled, an eighth of the "
         "box and more away from its faces. 40³ is the paper's own sampling.\n\n";
  struct Way {
    std::string name;
    Kind kind;
    Filter filter = Filter::linear_exact;
  };
  std::vector<Way> ways;
  for (const Kind& kind : kinds())
    ways.push_back({kind.name, kind});
  ways.push_back({"central, filter nearest", kinds()[1], Filter::nearest});
  ways.push_back({"central, filter cubic", kinds()[1], Filter::cubic});
  std::vector<Subject> signals;
  std::vector<std::string> heads = {"gradient", "ball 64³", "solid-ball 64³"};
  for (const int n : {40, 80, 160}) {
    signals.push_back(cut_signal(n));
    heads.push_back(signals.back().name);
  }
  Table table(heads);
  for (const Way& way : ways) {
    say("gradients: spheres and signal, " + way.name);
    const auto change = [&](Scene& scene) {
      scene.render.gradient = way.kind.gradient;
      scene.render.gradient_resolution = way.kind.resolution;
      scene.render.filter = way.filter;
    };
    std::vector<std::string> cells = {way.name};
    for (Subject* sphere : {&smooth, &solid})
      cells.push_back(mean_and_largest(sphere_angles(bench, *sphere, displays()[0], change)));
    for (Subject& signal : signals)
      cells.push_back(mean_and_largest(signal_angles(bench, signal, change)));
    table.row(cells);
  }
}

void kinds_table(const Bench& bench, Subject& subject) {
  std::cout << "### " << subject.name << "\n\n";
  std::vector<std::string> heads = {"gradient"};
  for (const Display& display : displays()) {
    if (display.warps.empty()) {
      heads.push_back(display.name);
    } else {
      heads.push_back(display.name + ", data");
      heads.push_back(display.name + ", object");
    }
  }
  Table table(heads);
  for (const Kind& kind : kinds()) {
    std::vector<std::string> cells = {kind.name};
    for (const Display& display : displays()) {
      for (const GradientSpace space : {GradientSpace::data, GradientSpace::object}) {
        if (space == GradientSpace::object && display.warps.empty())
          continue;
        if (space == GradientSpace::object && kind.gradient == Gradient::precomputed) {
          cells.emplace_back("–");
          continue;
        }
        say("gradients: " + subject.name + ", " + kind.name + ", " + display.name + ", " + word(space));
        cells.push_back(error_cell(bench, subject, display, [&](Scene& scene) {
          scene.render.gradient = kind.gradient;
          scene.render.gradient_resolution = kind.resolution;
          scene.render.gradient_space = space;
        }));
      }
    }
    table.row(cells);
  }
}

void sigma_table(const Bench& bench, Subject& subject) {
  std::cout << "### Prefiltered: the Gaussian's width. " << subject.name << ", undeformed\n\n";
  Table table({"gradient_sigma", "full", "half", "quarter"});
  for (const double sigma : {0.5, 0.75, 1.0, 1.5, 2.0}) {
    std::vector<std::string> cells = {fixed(sigma, 2)};
    for (const GradientResolution resolution :
         {GradientResolution::full, GradientResolution::half, GradientResolution::quarter}) {
      say("gradients: sigma " + fixed(sigma, 2) + ", " + word(resolution));
      cells.push_back(error_cell(bench, subject, displays()[0], [&](Scene& scene) {
        scene.render.gradient = Gradient::prefiltered;
        scene.render.gradient_resolution = resolution;
        scene.render.gradient_sigma = sigma;
      }));
    }
    table.row(cells);
  }
}

} // namespace

void gradient_section(const Bench& bench) {
  std::cout
      << "## Gradients\n\nAngle in degrees between the normal that shading sees and the analytic one of a "
         "sphere of "
      << fixed(kRadius, 1) << " voxels' radius in " << kVoxels
      << "³ voxels: mean, 95th percentile, where rays meet the surface under less than 60°. Rays, spacing "
      << kSpacing << ", linear-exact, " << kPixels
      << "² pixels, orthographic, oblique. The sample that is shaded lies up to a step behind the surface, "
         "which on "
         "the undeformed sphere turns its normal by at most "
      << fixed(glm::degrees(kSpacing * std::tan(glm::radians(60.0)) / kRadius), 2)
      << "°. Fisheye: d = 2 at (0.4, 0.3, 0.55); connected lens: magnification 2 at (0.35, 0.3, 0.55), "
         "inner 0.12, "
         "outer 0.3; twist: 120° along z about (0.4, 0.45, 0.5); sine: x along z, amplitude 0.04, wavelength "
         "0.5. `data`, `object`: render.gradient_space.\n\n";
  Subject smooth = sphere_subject("Phantom `ball`: a signed distance in floats",
                                  make_phantom("ball", {kVoxels, kVoxels, kVoxels}), 0);
  Subject solid = sphere_subject("Phantom `solid-ball`: voxels inside or outside, 8 bits",
                                 make_phantom("solid-ball", {kVoxels, kVoxels, kVoxels}), 127.5);
  kinds_table(bench, smooth);
  kinds_table(bench, solid);
  sigma_table(bench, solid);
  signal_table(bench, smooth, solid);
}

} // namespace slicelens::accuracy
