// Section `fill`: the slice pipeline against the bare loop.
#include "bare_loop.h"
#include "bench.h"
#include "render/slices.h"
#include "scene/load.h"
#include "scene/names.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace slicelens::bench {

namespace {

struct Case {
  std::string name;
  double azimuth = 0;
  double elevation = 0;
  double zoom = 1;
  bool squares = true; ///< the bare loop draws squares over the whole picture, else the slice polygons
  bool eight_bit = false;
};

double largest_difference(const std::vector<float>& a, const std::vector<float>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    largest = std::max(largest, std::abs(static_cast<double>(a[i]) - static_cast<double>(b[i])));
  return largest;
}

std::string difference_text(double difference) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1g", difference);
  return text;
}

void run_case(gl::Context& context, const BenchOptions& options, const Case& test, PreparedScene& prepared) {
  const gl::Functions& gl = context.functions();
  Scene& scene = prepared.scene;
  scene.camera.azimuth = test.azimuth;
  scene.camera.elevation = test.elevation;
  scene.camera.zoom = test.zoom;
  scene.render.target = test.eight_bit ? Target::rgba8 : Target::rgba32f;
  scene.render.volume_texture = test.eight_bit ? VolumeTexture::r8 : VolumeTexture::automatic;
  scene.render.transfer_texture = test.eight_bit ? TransferTexture::rgba8 : TransferTexture::rgba32f;
  prepare_again(prepared);
  const GpuScene gpu = upload(gl, prepared, {});
  const GLenum format = test.eight_bit ? GL_RGBA8 : GL_RGBA32F;
  const gl::Target ours_target = gl::make_target(gl, prepared.view.width, prepared.view.height, format);
  const gl::Target bare_target = gl::make_target(gl, prepared.view.width, prepared.view.height, format);
  SliceRenderer renderer(gl, prepared);
  renderer.slice(prepared);
  BareLoop bare(gl);
  if (test.squares)
    bare.set_squares(prepared);
  else
    bare.set_polygons(prepared);
  const auto draw_ours = [&] { renderer.draw(prepared, gpu, ours_target, {}); };
  const auto draw_bare = [&] { bare.draw(gpu, bare_target); };
  const auto ours = static_cast<double>(fragments_of(gl, draw_ours));
  const auto bares = static_cast<double>(fragments_of(gl, draw_bare));
  const double difference =
      largest_difference(gl::read_pixels(gl, ours_target), gl::read_pixels(gl, bare_target));
  // a: the bare loop's seconds, b: ours, so that a/b is our rate as a fraction of its, at equal fragments.
  const Turns turns = in_turn(gl, options.runs, draw_bare, draw_ours);
  const auto rate = [&](const std::vector<double>& a, const std::vector<double>& b) {
    const Quartiles q = ratios(a, b);
    return spread_text({q.first * ours / bares, q.median * ours / bares, q.third * ours / bares}, 3);
  };
  print_row({test.name, fixed(ours * 1e-6, 1), fixed(bares * 1e-6, 1),
             fixed(ours / median(turns.b) * 1e-6, 1), fixed(bares / median(turns.a) * 1e-6, 1),
             rate(turns.a, turns.b), rate(turns.a_work, turns.b_work), difference_text(difference)});
}

} // namespace

void run_fill(gl::Context& context, const BenchOptions& options) {
  const Scene scene = phantom_scene(options);
  Volume volume = load_volume(scene.volume, {}, {});
  TransferFunction transfer = transfer_of(scene, volume);
  PreparedScene prepared = prepare(scene, std::move(volume), std::move(transfer));
  std::printf(
      "\n## fill: the slice pipeline against a bare loop\n\n"
      "`head` of %zu³ voxels in %zu² pixels, spacing 1, unshaded, %d runs of each in turn. The ratio "
      "is of fragments per second, ours to the bare loop's, by wall clock and by processor time of all "
      "threads: median and quartiles of neighbouring runs.\n",
      options.edge, options.picture, options.runs);
  print_heading({"view", "ours, 10⁶ fragments", "bare", "ours, 10⁶/s", "bare, 10⁶/s", "ratio, wall clock",
                 "ratio, processor", "largest difference"});
  const double fill_picture = std::sqrt(3.0); // the default camera frames the box's diagonal
  const std::vector<Case> cases = {
      {"face-on, one quad a slice", 0, 0, fill_picture, true, false},
      {"face-on, textures and target of 8 bits", 0, 0, fill_picture, true, true},
      {"oblique, quads over the whole picture", 30, 20, 1.4, true, false},
      {"oblique, our polygons one by one", 30, 20, 1.4, false, false},
      {"oblique, our polygons, 8 bits", 30, 20, 1.4, false, true},
  };
  for (const Case& test : cases)
    run_case(context, options, test, prepared);
}

} // namespace slicelens::bench
