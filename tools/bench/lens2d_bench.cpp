// Section `lens2d`: LaMar's Table 2, pictures per second of six 2D lenses as a fraction of the same renderer
// without one.
#include "bench.h"
#include "image/patterns.h"
#include "render/lens_renderer.h"

#include <cstdio>
#include <string>

namespace slicelens::bench {

namespace {

/// One column of the paper's Table 2, as fractions of its baselines: 456 pictures per second on the Onyx2,
/// 1067 on the GeForce2.
struct PaperRow {
  const char* shape;
  const char* border;
  double onyx;
  double geforce;
};

constexpr PaperRow paper_rows[] = {
    {"square", "simple", 425.0 / 456, 1035.0 / 1067}, {"square", "linear", 390.0 / 456, 1012.0 / 1067},
    {"square", "cubic", 374.0 / 456, 987.0 / 1067},   {"circle", "simple", 380.0 / 456, 900.0 / 1067},
    {"circle", "linear", 357.0 / 456, 908.0 / 1067},  {"circle", "cubic", 332.0 / 456, 907.0 / 1067}};

PreparedPicture prepared_row(const std::string& warp, const std::string& pipeline) {
  const std::string scene =
      R"({"image": {"testcard": {"size": [500, 500]}}, "render": {"pipeline": ")" + pipeline +
      R"(", "target": "rgba8", "image_texture": "rgba8", "filter": "linear"}, "warp": )" + warp + "}";
  ImageScene read = image_scene_from_json(scene, "Table 2");
  Image image = load_image(read.image, {});
  return prepare_picture(std::move(read), std::move(image));
}

std::string warp_of(const PaperRow& row) {
  const bool cubic = std::string(row.border) == "cubic";
  return std::string(R"({"shape": ")") + row.shape + R"(", "border": ")" + row.border +
         R"(", "zoom": 4, "inner": 0.186, "outer": 0.25, "angular_segments": 32, "radial_segments": )" +
         (cubic ? "8" : "4") + "}";
}

constexpr int frames = 50; // of one measurement: enough for the driver to work on several at once

/// Baseline and lens in turn.
Turns measure(const gl::Functions& gl, const PictureRenderer& baseline, const PictureRenderer& lens,
              const gl::Target& target, int runs) {
  const auto draw = [&](const PictureRenderer& renderer) {
    renderer.bind(target);
    for (int i = 0; i < frames; ++i) {
      renderer.draw_bound();
      gl.Flush(); // a picture is shown before the next one starts
    }
  };
  return in_turn(
      gl, runs, [&] { draw(baseline); }, [&] { draw(lens); });
}

} // namespace

void run_lens2d(gl::Context& context, const BenchOptions& options) {
  const gl::Functions& gl = context.functions();
  const gl::Target target = gl::make_target(gl, 500, 500, GL_RGBA8);
  const PictureRenderer baseline(gl, prepared_row("[]", "tessellated"));
  const double plain = median(measure(gl, baseline, baseline, target, options.runs).a) / frames;
  std::printf(
      "\n## lens2d: LaMar's Table 2\n\n500² window, lens 250², zoom region 186², border 32 pixels, "
      "zoom 4; RGBA8 image and target, linear filter; %d measurements of %d pictures, in turn with the "
      "baseline. Baseline (two triangles): %.0f pictures a second. Fractions of its rate by wall clock "
      "and by processor time of all threads; fragment and lookup by processor time.\n",
      options.runs, frames, 1 / plain);
  print_heading({"lens", "wall clock", "processor", "Onyx2", "GeForce2", "triangles", "ns a triangle",
                 "fragment", "lookup"});
  for (const PaperRow& row : paper_rows) {
    const PictureRenderer lens(gl, prepared_row(warp_of(row), "tessellated"));
    const PictureRenderer fragment(gl, prepared_row(warp_of(row), "fragment"));
    const PictureRenderer lookup(gl, prepared_row(warp_of(row), "lookup"));
    const Turns by_vertex = measure(gl, baseline, lens, target, options.runs);
    const Turns by_fragment = measure(gl, baseline, fragment, target, options.runs);
    const Turns by_table = measure(gl, baseline, lookup, target, options.runs);
    const auto more = static_cast<double>(lens.triangle_count() - baseline.triangle_count());
    const double extra = (median(by_vertex.b_work) - median(by_vertex.a_work)) / frames;
    print_row({std::string(row.shape) + " " + row.border, spread_text(ratios(by_vertex.a, by_vertex.b), 2),
               spread_text(ratios(by_vertex.a_work, by_vertex.b_work), 2), fixed(row.onyx, 2),
               fixed(row.geforce, 2), std::to_string(lens.triangle_count()), fixed(1e9 * extra / more, 0),
               fixed(ratios(by_fragment.a_work, by_fragment.b_work).median, 2),
               fixed(ratios(by_table.a_work, by_table.b_work).median, 2)});
  }
}

} // namespace slicelens::bench
