// Section `phases`: from files to a picture on disk, in its parts.
#include "bench.h"
#include "core/errors.h"
#include "image/image_io.h"
#include "render/render.h"
#include "scene/load.h"

#include <chrono>
#include <cstdio>
#include <filesystem>

namespace slicelens::bench {

namespace {

namespace fs = std::filesystem;

double seconds_since(std::chrono::steady_clock::time_point& mark) {
  const auto now = std::chrono::steady_clock::now();
  const double seconds = std::chrono::duration<double>(now - mark).count();
  mark = now;
  return seconds;
}

constexpr const char* phase_names[] = {"load", "context", "upload", "compile", "slice",
                                       "draw", "read",    "write",  "sum"};
constexpr std::size_t phase_count = std::size(phase_names);

/// One picture from the beginning: a context of its own, as every start of the program has.
std::array<double, phase_count> run_once(const Scene& scene, std::string& dims) {
  std::array<double, phase_count> seconds{};
  auto mark = std::chrono::steady_clock::now();
  Volume volume = load_volume(scene.volume, {}, {});
  dims = std::to_string(volume.dims[0]) + "×" + std::to_string(volume.dims[1]) + "×" +
         std::to_string(volume.dims[2]) + " " + name_of(volume.type);
  TransferFunction transfer = transfer_of(scene, volume);
  const PreparedScene prepared = prepare(scene, std::move(volume), std::move(transfer));
  seconds[0] = seconds_since(mark);
  gl::Context context = open_context_for(scene);
  seconds[1] = seconds_since(mark);
  const RenderResult result = render(prepared, &context, {});
  const RenderTimes& t = result.times;
  seconds[2] = t.upload;
  seconds[3] = t.compile;
  seconds[4] = t.slice + t.tessellate;
  seconds[5] = t.draw;
  seconds[6] = t.read;
  seconds_since(mark);
  const fs::path file = fs::temp_directory_path() / "slicelens_bench.png";
  write_image(result.image, file, PixelDepth::png8);
  seconds[7] = seconds_since(mark);
  fs::remove(file);
  for (std::size_t i = 0; i + 1 < phase_count; ++i)
    seconds[phase_count - 1] += seconds[i];
  return seconds;
}

void run_scene(const std::string& name, const Scene& scene, int runs) {
  std::array<std::vector<double>, phase_count> all;
  std::string dims;
  (void)run_once(scene, dims); // fills the file cache and loads the driver's libraries
  for (int i = 0; i < runs; ++i) {
    const auto seconds = run_once(scene, dims);
    for (std::size_t p = 0; p < phase_count; ++p)
      all[p].push_back(seconds[p]);
  }
  std::vector<std::string> cells = {name + ", " + dims};
  for (const std::vector<double>& seconds : all) {
    const Quartiles q = quartiles(seconds);
    cells.push_back(fixed(q.median, 3) + " ±" + fixed((q.third - q.first) / 2, 3));
  }
  print_row(cells);
}

} // namespace

void run_phases(const BenchOptions& options) {
  const int runs = std::max(3, options.runs / 2);
  std::printf("\n## phases: from files to a picture\n\n"
              "Seconds of wall clock in a process whose libraries are loaded, file cache warm, %zu² pixels, "
              "spacing 1, 8-bit PNG; median of %d runs ± half the distance of the quartiles.\n",
              options.picture, runs);
  std::vector<std::string> heading = {"volume"};
  heading.insert(heading.end(), std::begin(phase_names), std::end(phase_names));
  print_heading(heading);
  for (const std::size_t edge : {std::size_t{64}, options.edge}) {
    Scene scene = phantom_scene(options);
    scene.volume.size = {edge, edge, edge};
    run_scene("phantom `head`", scene, runs);
  }
  for (const std::string& file : options.volumes) {
    Scene scene;
    scene.volume.file = file;
    scene.render.size = {options.picture, options.picture};
    fs::path path = fs::path(file).lexically_normal();
    run_scene("`" + path.parent_path().filename().string() + "/" + path.filename().string() + "`", scene,
              runs);
  }
}

} // namespace slicelens::bench
