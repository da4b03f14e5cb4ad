// slicelens_lens2d_bench [RUNS [FRAMES]]: prints LaMar's Table 2 for this machine (docs/benchmarks.md).
#include "lens2d_bench.h"
#include "render/render.h"

#include <cstdio>
#include <cstdlib>
#include <exception>

int main(int argc, char** argv) {
  const int runs = argc > 1 ? std::atoi(argv[1]) : 21;
  const int frames = argc > 2 ? std::atoi(argv[2]) : 100;
  if (runs < 1 || frames < 1) {
    std::fprintf(stderr, "usage: slicelens_lens2d_bench [RUNS [FRAMES]]\n");
    return 2;
  }
  try {
    slicelens::gl::Context context = slicelens::open_context_for({});
    std::printf("%s, OpenGL %s\n", context.info().renderer.c_str(), context.info().version.c_str());
    slicelens::bench::run_lens2d(context, runs, frames);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "slicelens_lens2d_bench: %s\n", error.what());
    return 1;
  }
  return 0;
}
