// slicelens_bench: measures the foundation and prints Markdown (docs/benchmarks.md).
#include "bench.h"
#include "core/errors.h"
#include "memory.h"
#include "render/render.h"
#include "scene/scene_json.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <thread>

namespace slicelens::bench {

namespace {

/// The processor's name from /proc/cpuinfo.
std::string processor_name() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);) {
    if (line.rfind("model name", 0) == 0)
      return line.substr(line.find(':') + 2);
  }
  return "unknown processor";
}

void run(const BenchOptions& options) {
  const auto wanted = [&](const char* name) {
    return options.sections.empty() ||
           std::find(options.sections.begin(), options.sections.end(), name) != options.sections.end();
  };
  const Scene scene = scene_from_json("{}", "slicelens_bench", {{"render.context", options.context}});
  {
    gl::Context context = open_context_for(scene);
    const gl::ContextInfo& info = context.info();
    std::printf("%s, %u threads; %s, OpenGL %s (%s)\n", processor_name().c_str(),
                std::thread::hardware_concurrency(), info.renderer.c_str(), info.version.c_str(),
                info.kind.c_str());
    if (wanted("fill"))
      run_fill(context, options);
    if (wanted("options"))
      run_options(context, options);
    if (wanted("lens2d"))
      run_lens2d(context, options);
    if (wanted("lens3d"))
      run_lens3d(context, options);
    if (wanted("axis"))
      run_axis(context, options);
    if (wanted("deform"))
      run_deform(context, options);
    if (wanted("grids"))
      run_grids(context, options);
    if (wanted("drag"))
      run_drag(context, options);
    if (wanted("skip"))
      run_skip(context, options);
    if (!options.sections.empty() && wanted("vtk")) // needs more than this program
      run_vtk(context, options);
  }
  if (wanted("phases"))
    run_phases(options);
}

} // namespace

} // namespace slicelens::bench

int main(int argc, char** argv) {
  using namespace slicelens;
  keep_freed_memory();
  bench::BenchOptions options;
  CLI::App app("Measures the slice pipeline against a bare loop, the cost of each option, and the phases of "
               "a picture. Prints Markdown.",
               "slicelens_bench");
  app.add_option(
         "sections", options.sections,
         "fill, options, lens2d, lens3d, axis, deform, grids, drag, skip, phases; none: all of these; "
         "vtk: against VTK, where that is installed")
      ->check(CLI::IsMember({"fill", "options", "lens2d", "lens3d", "axis", "deform", "grids", "drag", "skip",
                             "phases", "vtk"}));
  app.add_option("--volume", options.volumes, "volume files or folders for `phases`")->type_name("PATH");
  app.add_option("--edge", options.edge, "voxels on an edge of the phantom")->check(CLI::Range(8, 1024));
  app.add_option("--picture", options.picture, "pixels on an edge of the picture")
      ->check(CLI::Range(16, 4096));
  app.add_option("--runs", options.runs, "runs of each side")->check(CLI::Range(3, 1000));
  app.add_option("--only", options.only,
                 "of `options`, `axis` and `skip`: the variants whose name contains this")
      ->type_name("TEXT");
  app.add_option("--context", options.context, "auto, osmesa, egl or window");
  CLI11_PARSE(app, argc, argv);
  try {
    bench::run(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "slicelens_bench: %s\n", error.what());
    return 1;
  }
  return 0;
}
