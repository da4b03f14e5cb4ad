#include "bench.h"

#include "gl/timer.h"
#include "scene/load.h"
#include "volume/phantom.h"

#include <cstdio>
#include <ctime>

namespace slicelens::bench {

Turns in_turn(const gl::Functions& gl, int runs, const std::function<void()>& a,
              const std::function<void()>& b) {
  Turns turns;
  gl::elapsed_seconds(gl, a); // drivers compile a shader for the state of its first draw
  gl::elapsed_seconds(gl, b);
  const auto run = [&](const std::function<void()>& work, std::vector<double>& wall,
                       std::vector<double>& processor) {
    const std::clock_t start = std::clock();
    wall.push_back(gl::elapsed_seconds(gl, work));
    processor.push_back(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  };
  for (int i = 0; i < runs; ++i) {
    run(a, turns.a, turns.a_work);
    run(b, turns.b, turns.b_work);
  }
  return turns;
}

Quartiles ratios(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> values;
  for (std::size_t i = 0; i < a.size(); ++i)
    values.push_back(a[i] / b[i]);
  return quartiles(values);
}

std::uint64_t fragments_of(const gl::Functions& gl, const std::function<void()>& draw) {
  return gl::samples_passed(gl, draw);
}

Scene phantom_scene(const BenchOptions& options) {
  Scene scene;
  scene.volume.phantom = "head";
  scene.volume.size = {options.edge, options.edge, options.edge};
  scene.render.size = {options.picture, options.picture};
  return scene;
}

std::string fixed(double value, int digits) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", digits, value);
  return text;
}

void on_each_volume(const BenchOptions& options, const Scene& scene,
                    const std::function<void(const std::string&, Scene, Volume)>& run) {
  run("Head phantom", scene, make_phantom("head", *scene.volume.size));
  for (const std::string& path : options.volumes) {
    Scene real = scene;
    real.volume = {};
    real.volume.file = path;
    run(path.substr(path.find_last_of('/') + 1), real, load_volume(real.volume, {"."}, {}));
  }
}

std::string spread_text(const Quartiles& quartiles, int digits) {
  return fixed(quartiles.median, digits) + " [" + fixed(quartiles.first, digits) + ", " +
         fixed(quartiles.third, digits) + "]";
}

void print_row(const std::vector<std::string>& cells) {
  std::string line = "|";
  for (const std::string& cell : cells)
    line += " " + cell + " |";
  std::printf("%s\n", line.c_str());
  std::fflush(stdout);
}

void print_heading(const std::vector<std::string>& cells) {
  std::printf("\n");
  print_row(cells);
  std::string line = "|";
  for (std::size_t i = 0; i < cells.size(); ++i)
    line += i == 0 ? " --- |" : " ---: |";
  std::printf("%s\n", line.c_str());
}

} // namespace slicelens::bench
