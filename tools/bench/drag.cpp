// Sections `grids` and `drag`: Brunet's Tables 2 and 3, what the size of a control texture costs in a still
// picture and while a landmark moves.
#include "bench.h"
#include "gl/timer.h"
#include "render/grid_textures.h"
#include "render/slices.h"
#include "scene/load.h"
#include "volume/phantom.h"
#include "warp/multilevel_bspline.h"
#include "warp/thin_plate_spline.h"

#include <chrono>
#include <cmath>
#include <cstdio>

namespace slicelens::bench {

namespace {

/// The size of the paper's mouse, shaded as in its Figure 1. `planes`: samples per voxel.
PreparedScene torso(const BenchOptions& options, double planes) {
  Scene scene = phantom_scene(options);
  scene.volume.size = {256, 256, 192};
  scene.transfer.preset = "CT-Bone";
  scene.camera.azimuth = 30;
  scene.camera.elevation = 20;
  scene.render.spacing = 1 / planes;
  scene.render.shading = Shading::tone;
  scene.render.gradient = Gradient::forward;
  Volume volume = make_phantom("head", *scene.volume.size);
  TransferFunction transfer = transfer_of(scene, volume);
  return prepare(std::move(scene), std::move(volume), std::move(transfer));
}

/// A scene with everything that it takes to draw it again and again.
struct Drawing {
  PreparedScene prepared;
  GpuScene textures;
  SliceRenderer renderer;

  Drawing(const gl::Functions& gl, PreparedScene scene)
      : prepared(std::move(scene)), textures(upload(gl, prepared, {})), renderer(gl, prepared) {
    renderer.slice(prepared);
  }
};

PreparedScene changed(PreparedScene scene, Warp warp, Pipeline pipeline, std::size_t nodes) {
  scene.scene.warp = {std::move(warp)};
  scene.scene.render.pipeline = pipeline;
  scene.scene.render.grid_size = {nodes, nodes, nodes};
  scene.scene.render.gradient_space = GradientSpace::object;
  prepare_again(scene);
  return scene;
}

Sine wave() {
  Sine sine;
  sine.axis = Axis::x;
  sine.along = Axis::z;
  sine.amplitude = 0.05;
  sine.wavelength = 0.5;
  return sine;
}

/// Twenty landmarks about the middle of the volume, texture coordinates. The first goes to and fro with
/// `step`.
Landmarks landmarks(LandmarkMethod method, std::size_t nodes, int step) {
  Landmarks result;
  result.space = LandmarkSpace::texture;
  result.method = method;
  result.resolution = nodes;
  result.pairs.emplace();
  for (int i = 0; i < 20; ++i) {
    const double turn = 2.39996 * i; // the golden angle: evenly over a sphere
    const double z = 1 - (i + 0.5) / 10;
    const double r = std::sqrt(1 - z * z);
    const glm::dvec3 source = 0.5 + 0.35 * glm::dvec3(r * std::cos(turn), r * std::sin(turn), z);
    const double move = i == 0 ? 0.04 + 0.001 * (step % 8) : 0.02 * std::sin(3.0 * i);
    result.pairs->push_back({source, source + move * glm::dvec3(1, 0.5, -0.5)});
  }
  return result;
}

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Seconds of each phase of one picture while a landmark moves.
struct DragTimes {
  std::vector<double> solve; ///< the spline alone
  std::vector<double> fill;  ///< its bounds and its grid, and all else of prepare_again
  std::vector<double> upload;
  std::vector<double> slice;
  std::vector<double> draw;
};

/// The spline's system alone, as landmark_map solves it.
void solve(const Landmarks& points, const BoxSpace& space) {
  std::vector<glm::dvec3> sources;
  std::vector<glm::dvec3> targets;
  for (const LandmarkPair& pair : landmarks_in_box(points, space)) {
    sources.push_back(pair[0]);
    targets.push_back(pair[1]);
  }
  if (points.method == LandmarkMethod::tps)
    (void)fit_thin_plate_spline(targets, sources, points.stiffness);
  else
    (void)fit_multilevel_bspline(targets, sources, glm::dvec3(-1), glm::dvec3(2), points.levels);
}

void drag(const gl::Functions& gl, Drawing& drawing, const gl::Target& target, const Landmarks& points,
          DragTimes& times) {
  const double start = now();
  solve(points, drawing.prepared.space);
  const double solved = now();
  drawing.prepared.scene.warp = {points};
  prepare_again(drawing.prepared);
  const double prepared = now();
  drawing.textures.grids = upload_grids(gl, drawn_maps(drawing.prepared));
  gl::finish(gl);
  const double uploaded = now();
  drawing.renderer.slice(drawing.prepared);
  const double sliced = now();
  drawing.renderer.draw(drawing.prepared, drawing.textures, target, {});
  gl::finish(gl);
  times.solve.push_back(solved - start);
  times.fill.push_back(prepared - solved - (solved - start));
  times.upload.push_back(uploaded - prepared);
  times.slice.push_back(sliced - uploaded);
  times.draw.push_back(now() - sliced);
}

double sum_of(const DragTimes& t, std::size_t i) {
  return t.solve[i] + t.fill[i] + t.upload[i] + t.slice[i] + t.draw[i];
}

std::string milliseconds(const std::vector<double>& seconds) {
  return fixed(1000 * quartiles(seconds).median, 2);
}

/// One row of Table 3. The still frame is that of the same scene.
void drag_row(const gl::Functions& gl, const BenchOptions& options, const PreparedScene& plain,
              LandmarkMethod method, std::size_t nodes, const std::string& paper) {
  Drawing drawing(gl, changed(plain, landmarks(method, nodes, 0), Pipeline::fragment, nodes));
  const gl::Target target = gl::make_target(gl, plain.view.width, plain.view.height, GL_RGBA32F);
  const auto still = [&] { drawing.renderer.draw(drawing.prepared, drawing.textures, target, {}); };
  gl::elapsed_seconds(gl, still);
  DragTimes times;
  std::vector<double> fractions;
  std::vector<double> stills;
  for (int run = 0; run < options.runs; ++run) {
    stills.push_back(gl::elapsed_seconds(gl, still));
    drag(gl, drawing, target, landmarks(method, nodes, run + 1), times);
    fractions.push_back(stills.back() / sum_of(times, times.draw.size() - 1));
  }
  print_row({method == LandmarkMethod::tps ? "thin plate" : "B-spline", std::to_string(nodes) + "³",
             fixed(plain.scene.render.spacing, 0), paper, spread_text(quartiles(fractions), 3),
             milliseconds(stills), milliseconds(times.solve), milliseconds(times.fill),
             milliseconds(times.upload), milliseconds(times.slice), milliseconds(times.draw)});
}

} // namespace

void run_grids(gl::Context& context, const BenchOptions& options) {
  std::printf(
      "\n## Deformations: the size of the control texture\n\n"
      "Brunet's Table 2: head phantom of 256×256×192 voxels in %zu² pixels, tone shading with forward "
      "gradients, a sine. Frames a second as a fraction of undeformed slicing, drawn in turn, %d runs of "
      "each: "
      "median and quartiles by wall clock and by processor time. The paper's frames a second are divided by "
      "those of its formula in the shader, and so are ours in the column before.\n",
      options.picture, options.runs);
  print_heading({"planes per voxel", "sine", "÷ plain", "processor", "÷ in the shader", "paper"});
  const gl::Functions& gl = context.functions();
  for (const double planes : {0.5, 1.0}) {
    Drawing plain(gl, torso(options, planes));
    const gl::Target target =
        gl::make_target(gl, plain.prepared.view.width, plain.prepared.view.height, GL_RGBA32F);
    const auto measure = [&](Pipeline pipeline, std::size_t nodes) {
      Drawing other(gl, changed(plain.prepared, wave(), pipeline, nodes));
      return in_turn(
          gl, options.runs, [&] { plain.renderer.draw(plain.prepared, plain.textures, target, {}); },
          [&] { other.renderer.draw(other.prepared, other.textures, target, {}); });
    };
    const auto row = [&](const std::string& name, const Turns& turns, double formula, double paper) {
      const Quartiles wall = ratios(turns.a, turns.b);
      print_row({fixed(planes, 1), name, spread_text(wall, 3),
                 spread_text(ratios(turns.a_work, turns.b_work), 3), fixed(wall.median / formula, 2),
                 fixed(paper, 2)});
    };
    const Turns formula = measure(Pipeline::fragment, 32);
    const double base = ratios(formula.a, formula.b).median;
    const bool half = planes < 1;
    row("in a grid of 16³", measure(Pipeline::grid, 16), base, half ? 7.12 / 12.25 : 3.71 / 6.57);
    row("in a grid of 32³", measure(Pipeline::grid, 32), base, half ? 7.12 / 12.25 : 3.71 / 6.57);
    row("in a grid of 64³", measure(Pipeline::grid, 64), base, half ? 6.57 / 12.25 : 3.55 / 6.57);
    row("in the shader", formula, base, 1);
  }
}

void run_drag(gl::Context& context, const BenchOptions& options) {
  std::printf("\n## Deformations: a landmark is moved\n\n"
              "Brunet's Table 3: the volume, view and shading of its Table 2 under 20 landmarks, one of "
              "which moves. `still ÷ "
              "drag` is the time of a picture with the landmark at rest over that of solving, filling, "
              "uploading, slicing and "
              "drawing, measured in turn, %d runs: median and quartiles. The paper's are Table 3's frames a "
              "second over Table "
              "2's (B-splines; none for 8³ in its Table 2). Phases in ms, medians.\n",
              options.runs);
  print_heading({"spline", "nodes", "spacing", "paper", "still ÷ drag", "still", "solve", "fill", "upload",
                 "slice", "draw"});
  const gl::Functions& gl = context.functions();
  for (const double planes : {0.5, 1.0}) {
    const PreparedScene plain = torso(options, planes);
    const bool half = planes < 1;
    for (const LandmarkMethod method : {LandmarkMethod::tps, LandmarkMethod::bspline}) {
      drag_row(gl, options, plain, method, 8, "");
      drag_row(gl, options, plain, method, 16, fixed(half ? 6.19 / 7.12 : 3.96 / 3.71, 2));
      drag_row(gl, options, plain, method, 32, fixed(half ? 1.63 / 7.12 : 1.41 / 3.71, 2));
    }
  }
}

} // namespace slicelens::bench
