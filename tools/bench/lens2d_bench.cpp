#include "lens2d_bench.h"

#include "gl/timer.h"
#include "image/patterns.h"
#include "render/lens_renderer.h"
#include "study/statistics.h"

#include <cstdio>
#include <string>
#include <vector>

namespace slicelens::bench {

namespace {

/// One column of the paper's Table 2, as fractions of its baselines: 456 pictures per second on the Onyx2, 1067 on the
/// GeForce2.
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

struct Measured {
  double seconds = 0; ///< of one picture
  double ratio = 0;   ///< rate as a fraction of the baseline's
};

/// Runs baseline and lens in turn; the ratio is the median of neighbours', which see the same load.
Measured measure(const gl::Functions& gl, const PictureRenderer& baseline, const PictureRenderer& lens,
                 const gl::Target& target, int runs, int frames) {
  const auto seconds = [&](const PictureRenderer& renderer) {
    renderer.bind(target);
    return gl::elapsed_seconds(gl, [&] {
             for (int i = 0; i < frames; ++i) {
               renderer.draw_bound();
               gl.Flush(); // a picture is shown before the next one starts
             }
           }) /
           frames;
  };
  seconds(baseline);
  seconds(lens);
  std::vector<double> times;
  std::vector<double> ratios;
  for (int i = 0; i < runs; ++i) {
    const double without = seconds(baseline);
    times.push_back(seconds(lens));
    ratios.push_back(without / times.back());
  }
  return {median(times), median(ratios)};
}

} // namespace

void run_lens2d(gl::Context& context, int runs, int frames) {
  const gl::Functions& gl = context.functions();
  const gl::Target target = gl::make_target(gl, 500, 500, GL_RGBA8);
  const PictureRenderer baseline(gl, prepared_row("[]", "tessellated"));
  const double plain = measure(gl, baseline, baseline, target, runs, frames).seconds;
  std::printf("\n## lens2d: LaMar's Table 2\n\n500² window, lens 250², zoom region 186², border 32 pixels, zoom 4; "
              "RGBA8 image and target, linear filter; %d × %d pictures in turn with the baseline. Baseline (two "
              "triangles): %.0f pictures a second, %.1f µs each.\n\n"
              "| lens | tessellated | Onyx2 | GeForce2 | triangles | ns per triangle | fragment | lookup |\n"
              "| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n",
              runs, frames, 1 / plain, plain * 1e6);
  for (const PaperRow& row : paper_rows) {
    const PictureRenderer lens(gl, prepared_row(warp_of(row), "tessellated"));
    const PictureRenderer fragment(gl, prepared_row(warp_of(row), "fragment"));
    const PictureRenderer lookup(gl, prepared_row(warp_of(row), "lookup"));
    const Measured by_vertex = measure(gl, baseline, lens, target, runs, frames);
    const Measured by_fragment = measure(gl, baseline, fragment, target, runs, frames);
    const Measured by_table = measure(gl, baseline, lookup, target, runs, frames);
    const double extra = by_vertex.seconds * (1 - by_vertex.ratio);
    const auto triangles = static_cast<double>(lens.triangle_count());
    std::printf("| %s, %s | %.3f | %.2f | %.2f | %zu | %.0f | %.3f | %.3f |\n", row.shape, row.border,
                by_vertex.ratio, row.onyx, row.geforce, lens.triangle_count(),
                1e9 * extra / (triangles - static_cast<double>(baseline.triangle_count())), by_fragment.ratio,
                by_table.ratio);
    std::fflush(stdout);
  }
}

} // namespace slicelens::bench
