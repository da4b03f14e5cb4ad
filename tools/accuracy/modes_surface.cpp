// The first surface (mode iso) of phantom `ball` against the sphere.

#include "modes.h"
#include "scene/names.h"
#include "study/statistics.h"
#include "volume/closed_forms.h"
#include "volume/phantom.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>

namespace slicelens::accuracy {

namespace {

constexpr int kPixels = 192;
constexpr double kViewAngle = 40;
const std::vector<double> kSpacings = {8, 4, 2, 1, 0.5};
const std::vector<Pipeline> kPipelines = {Pipeline::fragment, Pipeline::rays, Pipeline::reference};

/// A black surface under a white highlight that falls linearly on every axis from the box's centre: the
/// picture is place_code of the point that is shown.
Subject coded_ball(int n, bool perspective) {
  Subject subject = phantom_subject("ball", n, constant_transfer({0, 0, 0, 1}), kPixels);
  Scene& scene = subject.prepared.scene;
  scene.render.mode = Mode::iso;
  scene.render.isovalue = 0;
  scene.highlight.function = HighlightFunction::distance;
  scene.highlight.color = glm::dvec3(1);
  scene.highlight.focus = AxisRanges{{{0.4, 0.6}, {0.4, 0.6}, {0.4, 0.6}}};
  scene.camera.projection = perspective ? ProjectionName::perspective : ProjectionName::orthographic;
  scene.camera.view_angle = kViewAngle;
  prepare_again(subject.prepared);
  return subject;
}

double place_code(const Box& box, const glm::dvec3& world) {
  const glm::dvec3 t(texture_from_world(box) * glm::dvec4(world, 1));
  double product = 1;
  for (int axis = 0; axis < 3; ++axis)
    product *= std::max(1 - 2 * std::abs(t[axis] - 0.5), 0.0);
  return product;
}

/// How far a surface is from the sphere.
struct Found {
  double mean = 0;    ///< of the distance along the ray, voxels
  double largest = 0; ///< of the same
  int missing = 0;    ///< pixels whose ray meets the sphere and shows nothing
  int extra = 0;      ///< pixels that show a surface beside it
  int exact = 0;      ///< pixels whose ray meets it
};

/// Distances are read from the code by its slope along the ray, where that is steep enough (0.5 over the
/// box's edge) and the ray meets the sphere under less than 75°.
Found compare(const Image& image, const PreparedScene& prepared) {
  const Box& box = prepared.box;
  const double edge = extent(box).x;
  const double radius = kBallRadius * edge;
  Found found;
  double count = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const Ray ray = ray_from_pixel(prepared.view, x + 0.5, y + 0.5);
      const auto hit = sphere_hit(center(box), radius, ray);
      const bool shown = channel(image, x, y, 3) > 0.5F;
      found.exact += hit ? 1 : 0;
      found.missing += hit && !shown ? 1 : 0;
      found.extra += !hit && shown ? 1 : 0;
      if (!hit || !shown)
        continue;
      const glm::dvec3 point = ray.origin + *hit * ray.direction;
      const double cosine = -glm::dot(point - center(box), ray.direction) / radius;
      const glm::dvec3 step = 1e-3 * ray.direction;
      const double slope = (place_code(box, point + step) - place_code(box, point - step)) / 2e-3;
      if (cosine < std::cos(glm::radians(75.0)) || std::abs(slope) * edge < 0.5)
        continue;
      const double code = static_cast<double>(channel(image, x, y, 0));
      const double distance = std::abs((code - place_code(box, point)) / slope);
      found.mean += distance;
      found.largest = std::max(found.largest, distance);
      count += 1;
    }
  }
  found.mean /= count;
  return found;
}

Found measured(const Bench& bench, Subject& subject, Pipeline pipeline, double spacing) {
  const Image image = draw(bench, subject, [&](Scene& scene) {
    scene.render.pipeline = pipeline;
    scene.render.spacing = spacing;
  });
  return compare(image, subject.prepared);
}

std::string drawn_by(Pipeline pipeline) {
  return pipeline == Pipeline::fragment ? "slices (fragment)" : word(pipeline);
}

void spacing_table(const Bench& bench) {
  constexpr int n = 64;
  std::cout << "### First surface of `ball` against the sphere: spacing, " << n << "³ voxels, " << kPixels
            << "² pixels\n\n"
               "Mean and largest distance along the ray between the surface that is shown and the sphere, in "
               "voxels; then the pixels that miss it and the pixels beside it that show a surface.\n\n";
  Table table({"projection", "drawn by", "rays that meet it", "8", "4", "2", "1", "0.5"});
  for (const bool perspective : {false, true}) {
    Subject subject = coded_ball(n, perspective);
    for (const Pipeline pipeline : kPipelines) {
      say(std::string("modes: iso by spacing, ") + word(pipeline));
      std::vector<std::string> cells;
      for (const double spacing : kSpacings) {
        const Found found = measured(bench, subject, pipeline, spacing);
        if (cells.empty())
          cells = {perspective ? "perspective" : "orthographic", drawn_by(pipeline),
                   std::to_string(found.exact)};
        cells.push_back(fixed(found.mean, 4) + ", " + fixed(found.largest, 3) + "; " +
                        std::to_string(found.missing) + ", " + std::to_string(found.extra));
      }
      table.row(cells);
    }
  }
}

void voxel_table(const Bench& bench) {
  std::cout << "### First surface of `ball` under voxel refinement: spacing 1\n\n"
               "Mean distance along the ray, as a share of the box's edge.\n\n";
  double lowest = 1e9;
  {
    Table table({"projection", "drawn by", "16³", "32³", "64³", "128³", "256³", "order"});
    for (const bool perspective : {false, true}) {
      for (const Pipeline pipeline : kPipelines) {
        say(std::string("modes: iso by voxels, ") + word(pipeline));
        std::vector<double> widths;
        std::vector<double> errors;
        std::vector<std::string> cells = {perspective ? "perspective" : "orthographic", drawn_by(pipeline)};
        for (const int n : {16, 32, 64, 128, 256}) {
          Subject subject = coded_ball(n, perspective);
          widths.push_back(1.0 / n);
          errors.push_back(measured(bench, subject, pipeline, 1).mean / n);
          cells.push_back(scientific(errors.back()));
        }
        lowest = std::min(lowest, fitted_order(widths, errors));
        cells.push_back(fixed(fitted_order(widths, errors), 2));
        table.row(cells);
      }
    }
  }
  bar("order in the voxels", fixed(lowest, 2) + " and more", "≥ 1.8", lowest >= 1.8);
  std::cout << std::endl;
}

} // namespace

void surface_tables(const Bench& bench) {
  spacing_table(bench);
  voxel_table(bench);
}

} // namespace slicelens::accuracy
