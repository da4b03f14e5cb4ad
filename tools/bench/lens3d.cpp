// Section `lens3d`: LaMar's Table 3, frames per second with a lens as a fraction of the same renderer without
// one.
#include "bench.h"
#include "gl/timer.h"
#include "render/slices.h"
#include "scene/load.h"
#include "volume/phantom.h"

#include <algorithm>
#include <cstdio>

namespace slicelens::bench {

namespace {

/// One row of the paper's Table 3 (skull, Onyx2 InfiniteReality: 5.9 frames a second without a lens).
struct LensType {
  LensShape shape;
  LensBorder border;
  std::size_t radial_segments;
  double paper_fraction;
};

const std::vector<LensType>& lens_types() {
  static const std::vector<LensType> types = {
      {LensShape::square, LensBorder::simple, 1, 4.8 / 5.9},
      {LensShape::square, LensBorder::linear, 4, 4.6 / 5.9},
      {LensShape::square, LensBorder::cubic, 8, 4.4 / 5.9},
      {LensShape::circle, LensBorder::simple, 1, 4.3 / 5.9},
      {LensShape::circle, LensBorder::linear, 4, 3.9 / 5.9},
      {LensShape::circle, LensBorder::cubic, 8, 3.6 / 5.9},
  };
  return types;
}

std::string type_name(const LensType& type) {
  const std::string border = type.border == LensBorder::simple   ? "simple"
                             : type.border == LensBorder::linear ? "linear"
                                                                 : "cubic";
  return std::string(type.shape == LensShape::square ? "square " : "circular ") + border;
}

void run_volume(gl::Context& context, const BenchOptions& options, const std::string& name, Scene scene,
                Volume volume) {
  const gl::Functions& gl = context.functions();
  TransferFunction transfer = preset("CT-Bone");
  PreparedScene plain = prepare(scene, std::move(volume), transfer);
  const GpuScene textures = upload(gl, plain, {});
  const gl::Target target = gl::make_target(gl, plain.view.width, plain.view.height, GL_RGBA32F);
  SliceRenderer baseline(gl, plain);
  baseline.slice(plain);
  std::printf("\n%s: %zu slices, %zu triangles without a lens.\n\n", name.c_str(), baseline.slice_count(),
              baseline.triangle_count());
  print_heading({"lens", "paper", "geometry kept", "processor", "geometry made anew", "processor",
                 "triangles", "fragments ÷ plain", "ns a triangle"});
  const double plain_fragments =
      static_cast<double>(fragments_of(gl, [&] { baseline.draw(plain, textures, target, {}); }));
  for (const LensType& type : lens_types()) {
    PreparedScene lensed = plain;
    LamarLens lens;
    lens.shape = type.shape;
    lens.border = type.border;
    lens.radial_segments = type.radial_segments;
    lens.angular_segments = 16;
    lensed.scene.warp = {lens};
    lensed.scene.render.pipeline = Pipeline::tessellated;
    prepare_again(lensed);
    SliceRenderer renderer(gl, lensed);
    renderer.slice(lensed);
    const Turns kept = in_turn(
        gl, options.runs, [&] { baseline.draw(plain, textures, target, {}); },
        [&] { renderer.draw(lensed, textures, target, {}); });
    const Turns anew = in_turn(
        gl, options.runs,
        [&] {
          baseline.slice(plain);
          baseline.draw(plain, textures, target, {});
        },
        [&] {
          renderer.slice(lensed);
          renderer.draw(lensed, textures, target, {});
        });
    const double fragments =
        static_cast<double>(fragments_of(gl, [&] { renderer.draw(lensed, textures, target, {}); })) /
        plain_fragments;
    // What the lens adds beyond its fragments' share of the plain picture, for each triangle it adds.
    const double added = median(kept.b) - median(kept.a) * fragments;
    const double triangles =
        static_cast<double>(renderer.triangle_count()) - static_cast<double>(baseline.triangle_count());
    print_row({type_name(type), fixed(type.paper_fraction, 2), spread_text(ratios(kept.a, kept.b), 3),
               spread_text(ratios(kept.a_work, kept.b_work), 3), spread_text(ratios(anew.a, anew.b), 3),
               spread_text(ratios(anew.a_work, anew.b_work), 3), std::to_string(renderer.triangle_count()),
               fixed(fragments, 3), fixed(added * 1e9 / std::max(triangles, 1.0), 0)});
  }
}

} // namespace

void run_lens3d(gl::Context& context, const BenchOptions& options) {
  std::printf(
      "\n## A lens in 3D: frames a second as a fraction of the same renderer without it\n\n"
      "LaMar's Table 3: 16 angular segments, 4 linear or 8 cubic radial ones, zoom 4, outer radius "
      "0.2 of the longest edge; pipeline "
      "`tessellated` beside `slices`, drawn in turn. Fractions by wall clock and by processor time of all "
      "threads: median and quartiles.\n");
  Scene scene = phantom_scene(options);
  scene.camera.azimuth = 30;
  scene.camera.elevation = 10;
  on_each_volume(options, scene, [&](const std::string& name, Scene own, Volume volume) {
    run_volume(context, options, name, std::move(own), std::move(volume));
  });
}

} // namespace slicelens::bench
