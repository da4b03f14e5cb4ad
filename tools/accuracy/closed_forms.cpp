// Rendered phantoms against their formulas (volume/closed_forms.h), and the orders at which errors fall.

#include "volume/closed_forms.h"

#include "bench.h"
#include "scene/names.h"
#include "study/statistics.h"
#include "volume/phantom.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <memory>

namespace slicelens::accuracy {

namespace {

constexpr int kVoxels = 128;
constexpr int kPixels = 96;
const std::vector<Pipeline> kPipelines = {Pipeline::slices, Pipeline::rays, Pipeline::reference};
const std::vector<double> kSpacings = {2, 1, 0.5, 0.25, 0.125};

/// Opacity per voxel of `depth` optical depths over the edge of a box of kVoxels.
double opacity_for(double depth) { return -std::expm1(-depth / kVoxels); }

using Formula = std::function<glm::dvec4(const PreparedScene&, const Ray&)>;

struct ClosedForm {
  std::string phantom;
  TransferFunction transfer;
  Formula expected; ///< associated colour
};

glm::dvec4 grey(double value) { return glm::dvec4(value); }

std::vector<ClosedForm> closed_forms(double depth) {
  const double a = opacity_for(depth);
  const glm::dvec4 low(1, 0.2, 0, 0);
  const glm::dvec4 high(0.1, 0.5, 1, 2 * a);
  const glm::dvec4 front(1, 0, 0, a / 2);
  const glm::dvec4 back(0, 0, 1, a);
  return {
      {"box", constant_transfer({1, 1, 1, a}),
       [a](const PreparedScene& s, const Ray& ray) {
         return grey(
             opacity_from_extinction(extinction_from_opacity(a, s.unit_distance), box_chord(s.box, ray)));
       }},
      {"ramp",
       {{{0, low.r, low.g, low.b, low.a}, {1, high.r, high.g, high.b, high.a}}, std::nullopt, ""},
       [low, high](const PreparedScene& s, const Ray& ray) {
         return ramp_dvr(s.box, ray, kVoxels, low, high, s.unit_distance);
       }},
      {"slabs", step_transfer(1.5, front, back),
       [front, back](const PreparedScene& s, const Ray& ray) {
         return slabs_dvr(s.box, ray, front, back, s.unit_distance);
       }},
      {"ball", step_transfer(0, {1, 1, 1, 0}, {1, 1, 1, a}),
       [a](const PreparedScene& s, const Ray& ray) {
         return grey(
             opacity_from_extinction(extinction_from_opacity(a, s.unit_distance), ball_chord(s.box, ray)));
       }},
  };
}

/// Means of |value − formula| over the pixels that show the box; the largest of the four channels' means.
double mean_error(const Image& image, const PreparedScene& scene, const Formula& formula) {
  glm::dvec4 sum(0);
  double count = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const Ray ray = ray_from_pixel(scene.view, x + 0.5, y + 0.5);
      if (!(box_chord(scene.box, ray) > 0))
        continue;
      const glm::dvec4 expected = formula(scene, ray);
      for (int c = 0; c < 4; ++c)
        sum[c] += std::abs(static_cast<double>(channel(image, x, y, c)) - expected[c]);
      count += 1;
    }
  }
  return std::max({sum.r, sum.g, sum.b, sum.a}) / count;
}

/// The same after drawing. `prepared` keeps the projection for the formula.
double measured(const Bench& bench, Subject& subject, const Formula& formula, Pipeline pipeline,
                double spacing, Mode mode = Mode::dvr) {
  const Image image = draw(bench, subject, [&](Scene& scene) {
    scene.render.pipeline = pipeline;
    scene.render.spacing = spacing;
    scene.render.mode = mode;
  });
  return mean_error(image, subject.prepared, formula);
}

void set_projection(Subject& subject, bool perspective) {
  CameraSettings& camera = subject.prepared.scene.camera;
  camera.projection = perspective ? ProjectionName::perspective : ProjectionName::orthographic;
  camera.view_angle = 40;
  prepare_again(subject.prepared);
}

void spacing_tables(const Bench& bench) {
  double worst_at_quarter = 0;
  double ball_low = 1e9;
  double ball_high = 0;
  for (const bool perspective : {false, true}) {
    std::cout << "### Against the spacing, " << (perspective ? "perspective (40°)" : "orthographic")
              << "\n\n";
    Table table({"phantom", "pipeline", "2", "1", "0.5", "0.25", "0.125", "order"});
    for (const ClosedForm& form : closed_forms(2)) {
      say("closed forms: " + form.phantom);
      Subject subject = phantom_subject(form.phantom, kVoxels, form.transfer, kPixels);
      set_projection(subject, perspective);
      for (const Pipeline pipeline : kPipelines) {
        std::vector<double> errors;
        std::vector<std::string> cells = {form.phantom, word(pipeline)};
        for (const double spacing : kSpacings) {
          errors.push_back(measured(bench, subject, form.expected, pipeline, spacing));
          cells.push_back(scientific(errors.back()));
        }
        const double order = fitted_order(kSpacings, errors);
        cells.push_back(fixed(order, 2));
        table.row(cells);
        worst_at_quarter = std::max(worst_at_quarter, form.phantom == "ball" ? 0 : errors[3]);
        if (form.phantom == "ball") {
          ball_low = std::min(ball_low, order);
          ball_high = std::max(ball_high, order);
        }
      }
    }
  }
  bar("box, ramp and slabs at spacing 0.25, largest mean error of all pipelines and projections",
      scientific(worst_at_quarter), "≤ 1e-3", worst_at_quarter <= 1e-3);
  bar("order of the ball's error in the spacing", fixed(ball_low, 2) + " to " + fixed(ball_high, 2),
      "first order", ball_low > 0.9 && ball_high < 1.3);
  std::cout << std::endl;
}

void depth_table(const Bench& bench) {
  std::cout << "### Against the optical depth: `box`, spacing 0.25, orthographic\n\n";
  Table table({"optical depth of an edge", "opacity per voxel", "slices", "rays", "reference"});
  for (const double depth : {0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 64.0, 256.0}) {
    const ClosedForm form = closed_forms(depth).front();
    Subject subject = phantom_subject(form.phantom, kVoxels, form.transfer, kPixels);
    std::vector<std::string> cells = {fixed(depth, 1), fixed(opacity_for(depth), 4)};
    for (const Pipeline pipeline : kPipelines)
      cells.push_back(scientific(measured(bench, subject, form.expected, pipeline, 0.25)));
    table.row(cells);
  }
}

/// X-ray or maximum of the blob at 16³ to 256³ voxels.
void blob_table(const Bench& bench, bool xray) {
  const std::array<int, 5> sizes = {16, 32, 64, 128, 256};
  std::cout << "### `blob` under voxel refinement: " << (xray ? "X-ray" : "MIP") << "\n\n";
  // The value as opacity: white light of that share, in all four channels.
  const TransferFunction identity{{{0, 1, 1, 1, 0}, {1, 1, 1, 1, 1}}, std::nullopt, ""};
  const Formula formula = [xray](const PreparedScene& s, const Ray& ray) {
    if (xray)
      return grey(s.xray_scale * blob_xray_clipped(s.box, ray, s.unit_distance));
    return grey(blob_mip(s.box, ray));
  };
  double at_128 = 0;
  auto table = std::make_unique<Table>(
      std::vector<std::string>{"projection", "pipeline", "16³", "32³", "64³", "128³", "256³", "order"});
  for (const bool perspective : {false, true}) {
    for (const Pipeline pipeline : kPipelines) {
      say(std::string("closed forms: blob, ") + word(pipeline));
      std::vector<double> widths;
      std::vector<double> errors;
      std::vector<std::string> cells = {perspective ? "perspective" : "orthographic", word(pipeline)};
      for (const int n : sizes) {
        Subject subject = phantom_subject("blob", n, identity, kPixels);
        subject.prepared.scene.render.xray_scale = 2.56 / n; // the same grey at any n, .8 in the middle
        set_projection(subject, perspective);
        widths.push_back(1.0 / n);
        errors.push_back(measured(bench, subject, formula, pipeline, 0.5, xray ? Mode::xray : Mode::mip));
        cells.push_back(scientific(errors.back()));
        if (n == 128)
          at_128 = std::max(at_128, errors.back());
      }
      cells.push_back(fixed(fitted_order(widths, errors), 2));
      table->row(cells);
    }
  }
  table.reset();
  bar(std::string("blob 128³, ") + (xray ? "X-ray of `xray_scale`·S" : "MIP") + ", largest mean error",
      scientific(at_128), "≤ 1e-3", at_128 <= 1e-3);
  std::cout << std::endl;
}

} // namespace

void closed_form_section(const Bench& bench) {
  std::cout
      << "## Closed forms\n\n"
         "Mean of |picture − formula| over the pixels that show the box, the worst of the four channels; "
         "target rgba32f, filter linear-exact, "
      << kPixels << "² pixels, " << kVoxels
      << "³ voxels, oblique view (azimuth 33°, elevation 21°, roll 10°). "
         "The box's edge has optical depth 2.\n\n";
  spacing_tables(bench);
  depth_table(bench);
  blob_table(bench, true);
  blob_table(bench, false);
}

} // namespace slicelens::accuracy
