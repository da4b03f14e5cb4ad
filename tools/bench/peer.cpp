// Section `vtk`: our slices against VTK's two volume mappers, frame by frame (docs/vtk.md).
#include "study/peer.h"

#include "bench.h"
#include "gl/timer.h"
#include "image/image_io.h"
#include "render/render.h"
#include "render/slices.h"
#include "scene/load.h"
#include "scene/scene_json.h"
#include "study/export.h"
#include "study/metrics.h"
#include "study/process.h"

#include <chrono>
#include <cstdio>
#include <fstream>

namespace slicelens::bench {

namespace {

struct Case {
  const char* name;
  std::vector<KeyValue> changes;
};

std::vector<Case> cases() {
  const KeyValue bone = {"transfer.preset", "CT-Bone"};
  const KeyValue thin = {"transfer.points",
                         "[[-200,0,0,0,0],[100,0.8,0.4,0.3,0.005],[400,1,0.9,0.8,0.02],[1500,1,1,1,0.03]]"};
  const KeyValue diffuse = {"render.shading", "diffuse"};
  return {{"opaque", {bone}},
          {"opaque, diffuse", {bone, diffuse}},
          {"thin", {thin}},
          {"thin, diffuse", {thin, diffuse}},
          {"MIP", {{"transfer.points", "[[-1000,0,0,0,0],[2300,1,0.9,0.7,1]]"}, {"render.mode", "mip"}}}};
}

std::string load_average() {
  std::ifstream in("/proc/loadavg");
  std::string one = "unknown";
  in >> one;
  return one;
}

/// Seconds from an idle driver until the picture is complete: cutting the stack and drawing it.
double seconds_of_slices(const gl::Functions& gl, const PreparedScene& prepared, SliceRenderer& renderer,
                         const GpuScene& textures, const gl::Target& target) {
  gl::finish(gl);
  const auto start = std::chrono::steady_clock::now();
  renderer.slice(prepared);
  renderer.draw(prepared, textures, target, {});
  gl::finish(gl);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void run_case(gl::Context& context, const BenchOptions& options, const Case& test, const Volume& volume,
              const Scene& base) {
  const gl::Functions& gl = context.functions();
  const Scene scene = scene_from_json(scene_to_json(base), "bench", test.changes);
  const PreparedScene prepared = prepare(scene, volume, transfer_of(scene, volume));
  const ScratchFolder folder;
  write_export(prepared, folder / "scene");
  Peer peers[] = {Peer(find_peer()), Peer(find_peer())};
  peers[0].load(folder / "scene", "gpu");
  peers[1].load(folder / "scene", "cpu");
  const Image ours = render(prepared, &context, {}).image;
  const GpuScene textures = upload(gl, prepared, {});
  const gl::Target target =
      gl::make_target(gl, prepared.view.width, prepared.view.height, texture_format(scene.render.target));
  SliceRenderer renderer(gl, prepared);
  std::vector<double> seconds[3];
  for (int run = -1; run < options.runs; ++run) { // the first one is not counted
    const double turn[] = {seconds_of_slices(gl, prepared, renderer, textures, target), peers[0].draw()[0],
                           peers[1].draw()[0]};
    for (std::size_t i = 0; run >= 0 && i < 3; ++i)
      seconds[i].push_back(turn[i]);
  }
  std::vector<std::string> cells = {test.name, spread_text(quartiles(seconds[0]), 3)};
  for (std::size_t i = 0; i < 2; ++i) {
    peers[i].write(folder / "peer.png");
    const auto psnr = compare_images(ours, read_image(folder / "peer.png")).psnr;
    cells.push_back(spread_text(quartiles(seconds[i + 1]), 3));
    cells.push_back(spread_text(ratios(seconds[0], seconds[i + 1]), 2));
    cells.push_back(psnr ? fixed(*psnr, 1) : "equal");
  }
  cells.push_back(load_average());
  print_row(cells);
}

} // namespace

void run_vtk(gl::Context& context, const BenchOptions& options) {
  Scene scene = phantom_scene(options);
  scene.camera.azimuth = 30;
  scene.camera.elevation = 20;
  const Volume volume = load_volume(scene.volume, {}, {});
  std::printf("\n## Slices against VTK\n\n`head` of %zu³ voxels in %zu² pixels, spacing 1, azimuth 30°, "
              "elevation 20°, orthographic; %d frames of each in turn.\n",
              options.edge, options.picture, options.runs);
  print_heading({"scene", "slices, s", "VTK's GPU mapper, s", "slices ÷ it", "PSNR, dB",
                 "VTK's CPU mapper, s", "slices ÷ it", "PSNR, dB", "load average"});
  for (const Case& test : cases())
    run_case(context, options, test, volume, scene);
}

} // namespace slicelens::bench
