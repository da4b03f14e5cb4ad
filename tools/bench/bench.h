// What the sections of slicelens_bench share: measuring in turn, counting fragments, Markdown tables.
#pragma once

#include "gl/context.h"
#include "render/gpu_scene.h"
#include "render/prepare.h"
#include "study/statistics.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace slicelens::bench {

struct BenchOptions {
  std::vector<std::string> sections; ///< "fill", "options", "phases" …; empty: all
  std::vector<std::string> volumes;  ///< files or folders for `phases`, beside the phantoms
  std::size_t edge = 256;            ///< voxels on an edge of the phantom of `fill` and `options`
  std::size_t picture = 512;         ///< pixels on an edge of the picture
  int runs = 9;                      ///< of each side
  std::string only;                  ///< of `options`, `axis` and `skip`: those whose name contains it
  std::string context = "auto";      ///< render.context
};

/// Seconds of two jobs that were run A B A B …, after one run of each that is not counted.
struct Turns {
  std::vector<double> a; ///< wall clock
  std::vector<double> b;
  std::vector<double>
      a_work; ///< processor time of all threads: what a software driver works, whatever else runs
  std::vector<double> b_work;
};
Turns in_turn(const gl::Functions& gl, int runs, const std::function<void()>& a,
              const std::function<void()>& b);

/// Quartiles of a[i]/b[i]: neighbours in time see the same load of the machine.
Quartiles ratios(const std::vector<double>& a, const std::vector<double>& b);

/// Fragments that `draw` hands to blending (GL_SAMPLES_PASSED).
std::uint64_t fragments_of(const gl::Functions& gl, const std::function<void()>& draw);

/// A scene of the head phantom with everything else at its default.
Scene phantom_scene(const BenchOptions& options);

/// Calls run(name, scene, volume) for the head phantom of the scene, and for each of options.volumes.
void on_each_volume(const BenchOptions& options, const Scene& scene,
                    const std::function<void(const std::string&, Scene, Volume)>& run);

/// "0.953 [0.941, 0.967]": the median and both quartiles.
std::string spread_text(const Quartiles& quartiles, int digits);
/// A number with a fixed count of decimals.
std::string fixed(double value, int digits);

/// Prints one row of a Markdown table to stdout, and its heading with the line below it.
void print_row(const std::vector<std::string>& cells);
void print_heading(const std::vector<std::string>& cells);

/// The sections. Each prints its own text and tables.
void run_fill(gl::Context& context, const BenchOptions& options);
void run_options(gl::Context& context, const BenchOptions& options);
void run_phases(const BenchOptions& options);
void run_lens2d(gl::Context& context, const BenchOptions& options);
void run_lens3d(gl::Context& context, const BenchOptions& options);
void run_axis(gl::Context& context, const BenchOptions& options);
void run_deform(gl::Context& context, const BenchOptions& options);
void run_grids(gl::Context& context, const BenchOptions& options);
void run_drag(gl::Context& context, const BenchOptions& options);
void run_skip(gl::Context& context, const BenchOptions& options);
void run_vtk(gl::Context& context, const BenchOptions& options); ///< needs what docs/vtk.md lists

} // namespace slicelens::bench
