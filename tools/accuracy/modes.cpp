// Modes beside dvr and their formulas: minimum, maximum and average along a ray, the first surface, and
// objects told apart by labels.

#include "modes.h"

#include "bench.h"
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

constexpr int kPixels = 96;
constexpr double kViewAngle = 40;
const std::vector<double> kSpacings = {2, 1, 0.5, 0.25, 0.125};
const std::vector<double> kEdges = {16, 32, 64, 128, 256};
/// The value as opacity: white light of that share, in all four channels.
const TransferFunction kValueAsOpacity{{{0, 1, 1, 1, 0}, {1, 1, 1, 1, 1}}, std::nullopt, ""};
/// Shorter chords may have no sample at the coarsest spacing, and then show nothing.
constexpr double kShortestChord = 2;

using Formula = std::function<std::optional<glm::dvec4>(const PreparedScene&, const Ray&)>;

void set_projection(Subject& subject, bool perspective) {
  CameraSettings& camera = subject.prepared.scene.camera;
  camera.projection = perspective ? ProjectionName::perspective : ProjectionName::orthographic;
  camera.view_angle = kViewAngle;
  prepare_again(subject.prepared);
}

/// Mean of |picture − formula| over the pixels that have a formula, the largest of the four channels' means.
double mean_error(const Image& image, const PreparedScene& prepared, const Formula& formula) {
  glm::dvec4 sum(0);
  double count = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const auto expected = formula(prepared, ray_from_pixel(prepared.view, x + 0.5, y + 0.5));
      if (!expected)
        continue;
      for (int c = 0; c < 4; ++c)
        sum[c] += std::abs(static_cast<double>(channel(image, x, y, c)) - (*expected)[c]);
      count += 1;
    }
  }
  return std::max({sum.r, sum.g, sum.b, sum.a}) / count;
}

bool is_crossed(const PreparedScene& s, const Ray& ray) { return box_chord(s.box, ray) >= kShortestChord; }

/// A formula of the ramp's range along the line.
Formula of_ramp(double RampRange::*value, std::size_t edge) {
  return [value, edge](const PreparedScene& s, const Ray& ray) -> std::optional<glm::dvec4> {
    const auto range = ramp_range(s.box, ray, edge);
    return range && is_crossed(s, ray) ? std::optional(glm::dvec4((*range).*value)) : std::nullopt;
  };
}

/// `slabs` under a label volume of their two halves, opacities `a`/2 and `a`.
Subject slab_objects(int n, double a, LabelMode front_mode) {
  Scene scene = oblique_scene(kPixels);
  scene.render.mode = Mode::two_level;
  scene.volume.labels = "halves";
  const auto edge = static_cast<std::size_t>(n);
  Volume volume = make_phantom("slabs", {edge, edge, edge});
  Volume labels = volume;
  labels.type = ScalarType::u8;
  labels.voxels.resize(edge * edge * edge);
  for (std::size_t i = 0; i < labels.voxels.size(); ++i)
    labels.voxels[i] = static_cast<std::byte>(i / edge % edge < edge / 2 ? 1 : 2);
  update_statistics(labels);
  scene.labels = {{1, "front", front_mode, std::nullopt, true},
                  {2, "back", LabelMode::dvr, std::nullopt, true}};
  LoadedLabels loaded{std::move(labels),
                      {constant_transfer({1, 0, 0, a / 2}), constant_transfer({0, 0, 1, a})}};
  return {
      "slabs",
      prepare(std::move(scene), std::move(volume), constant_transfer({0, 0, 0, 0}), {}, std::move(loaded)),
      false};
}

/// One row of a table of errors against spacings: its subject, and formula.
struct Row {
  std::string name;
  Subject subject;
  Mode mode;
  Formula formula;
  bool has_slices = true;
};

std::vector<Row> spacing_rows() {
  constexpr int n = 128;
  const double a = -std::expm1(-2.0 / n);
  std::vector<Row> rows;
  const auto add = [&](const std::string& name, Subject subject, Mode mode, Formula formula,
                       bool has_slices = true) {
    rows.push_back({name, std::move(subject), mode, std::move(formula), has_slices});
  };
  const auto phantom = [](const std::string& name) {
    return phantom_subject(name, n, kValueAsOpacity, kPixels);
  };
  add("ramp, mip", phantom("ramp"), Mode::mip, of_ramp(&RampRange::most, n));
  add("ramp, minip", phantom("ramp"), Mode::minip, of_ramp(&RampRange::least, n));
  add("ramp, average", phantom("ramp"), Mode::average, of_ramp(&RampRange::average, n));
  add("blob, average", phantom("blob"), Mode::average,
      [](const PreparedScene& s, const Ray& ray) -> std::optional<glm::dvec4> {
        return is_crossed(s, ray) ? std::optional(glm::dvec4(blob_average(s.box, ray))) : std::nullopt;
      });
  const glm::dvec4 front(1, 0, 0, a / 2);
  const glm::dvec4 back(0, 0, 1, a);
  add("slabs, two-level: dvr, dvr", slab_objects(n, a, LabelMode::dvr), Mode::two_level,
      [=](const PreparedScene& s, const Ray& ray) -> std::optional<glm::dvec4> {
        return is_crossed(s, ray) ? std::optional(slabs_dvr(s.box, ray, front, back, s.unit_distance))
                                  : std::nullopt;
      });
  add(
      "slabs, two-level: xray, dvr", slab_objects(n, a, LabelMode::xray), Mode::two_level,
      [=](const PreparedScene& s, const Ray& ray) -> std::optional<glm::dvec4> {
        return is_crossed(s, ray)
                   ? std::optional(slabs_xray_front(s.box, ray, front, back, s.unit_distance, s.xray_scale))
                   : std::nullopt;
      },
      false);
  return rows;
}

void spacing_table(const Bench& bench) {
  std::cout
      << "### Minimum, maximum, average and two-level against their formulas\n\n"
         "128³ voxels. Mean of |picture − formula|, the worst channel, over the pixels whose rays are two "
         "voxels and more inside the box (a shorter way may hold no sample, and then nothing is shown). "
         "`slabs, two-level`: labels of the two halves; the half in front is composited or "
         "shown as its line integral.\n\n";
  double worst = 0;
  {
    Table table({"phantom, mode", "projection", "pipeline", "2", "1", "0.5", "0.25", "0.125", "order"});
    for (Row& row : spacing_rows()) {
      for (const bool perspective : {false, true}) {
        set_projection(row.subject, perspective);
        for (const Pipeline pipeline : {Pipeline::slices, Pipeline::rays, Pipeline::reference}) {
          if (pipeline == Pipeline::slices && !row.has_slices)
            continue;
          say("modes: " + row.name + ", " + word(pipeline));
          std::vector<double> errors;
          std::vector<std::string> cells = {row.name, perspective ? "perspective" : "orthographic",
                                            word(pipeline)};
          for (const double spacing : kSpacings) {
            errors.push_back(mean_error(draw(bench, row.subject,
                                             [&](Scene& scene) {
                                               scene.render.pipeline = pipeline;
                                               scene.render.spacing = spacing;
                                               scene.render.mode = row.mode;
                                             }),
                                        row.subject.prepared, row.formula));
            cells.push_back(scientific(errors.back()));
          }
          worst = std::max(worst, errors[3]);
          cells.push_back(fixed(fitted_order(kSpacings, errors), 2));
          table.row(cells);
        }
      }
    }
  }
  bar("largest mean error at spacing 0.25", scientific(worst), "≤ 1e-3", worst <= 1e-3);
  std::cout << std::endl;
}

/// 1 − blob, so that its minimum lies inside the volume.
Subject hollow(int n) {
  Subject subject = phantom_subject("blob", n, kValueAsOpacity, kPixels);
  Volume volume = subject.prepared.volume;
  auto* values = reinterpret_cast<float*>(volume.voxels.data());
  for (std::size_t i = 0; i < volume.voxels.size() / sizeof(float); ++i)
    values[i] = 1 - values[i];
  update_statistics(volume);
  set_volume(subject.prepared, std::move(volume));
  return subject;
}

void hollow_table(const Bench& bench) {
  std::cout << "### MinIP of 1 − `blob` under voxel refinement, spacing 0.5\n\n";
  const Formula formula = [](const PreparedScene& s, const Ray& ray) -> std::optional<glm::dvec4> {
    return is_crossed(s, ray) ? std::optional(glm::dvec4(1 - blob_mip(s.box, ray))) : std::nullopt;
  };
  Table table({"projection", "pipeline", "16³", "32³", "64³", "128³", "256³", "order"});
  for (const bool perspective : {false, true}) {
    for (const Pipeline pipeline : {Pipeline::slices, Pipeline::rays, Pipeline::reference}) {
      say(std::string("modes: 1 − blob, ") + word(pipeline));
      std::vector<double> widths;
      std::vector<double> errors;
      std::vector<std::string> cells = {perspective ? "perspective" : "orthographic", word(pipeline)};
      for (const double n : kEdges) {
        Subject subject = hollow(static_cast<int>(n));
        set_projection(subject, perspective);
        widths.push_back(1 / n);
        errors.push_back(mean_error(draw(bench, subject,
                                         [&](Scene& scene) {
                                           scene.render.pipeline = pipeline;
                                           scene.render.spacing = 0.5;
                                           scene.render.mode = Mode::minip;
                                         }),
                                    subject.prepared, formula));
        cells.push_back(scientific(errors.back()));
      }
      cells.push_back(fixed(fitted_order(widths, errors), 2));
      table.row(cells);
    }
  }
}

} // namespace

void mode_section(const Bench& bench) {
  std::cout << "## Modes\n\nTarget rgba32f, filter linear-exact, " << kPixels
            << "² pixels, oblique view; perspective: view angle " << fixed(kViewAngle, 0)
            << "°. `order`: fitted.\n\n";
  spacing_table(bench);
  hollow_table(bench);
  surface_tables(bench);
  mode_spacing_table(bench);
}

} // namespace slicelens::accuracy
