// Maps in control textures against the same maps in the shader (Brunet, Nowak and Gleicher 2006, Figure 3).

#include "bench.h"
#include "scene/load.h"
#include "volume/phantom.h"

#include <algorithm>
#include <iostream>

namespace slicelens::accuracy {

namespace {

/// The scene of scenes/brunet/fig03d.json, on a transparent background.
PreparedScene sine_brick(std::size_t edge, std::size_t pixels) {
  Scene scene;
  scene.volume.phantom = "brick";
  scene.volume.size = {edge, edge, edge};
  scene.camera.azimuth = 30;
  scene.camera.elevation = 20;
  scene.camera.zoom = 1.4;
  scene.render.size = {pixels, pixels};
  scene.render.pipeline = Pipeline::fragment;
  scene.render.shading = Shading::diffuse;
  scene.render.background = {0, 0, 0, 0};
  Sine sine;
  sine.axis = Axis::x;
  sine.along = Axis::z;
  sine.amplitude = 0.08;
  sine.wavelength = 0.5;
  scene.warp = {sine};
  Volume volume = make_phantom("brick", *scene.volume.size);
  TransferFunction transfer = transfer_of(scene, volume);
  return prepare(std::move(scene), std::move(volume), std::move(transfer));
}

} // namespace

void grid_section(const Bench& bench) {
  std::cout
      << "## Control textures\n\n"
         "Brunet's Figure 3: the brick of 256³ voxels under a sine (scenes/brunet/fig03d.json), 512² pixels, "
         "pipeline `grid` against `fragment`. Errors of the map in voxels.\n\n";
  PreparedScene scene = sine_brick(256, 512);
  const Image exact = render(scene, &bench.context, {}).image;
  Table table(
      {"nodes", "largest error", "rms error", "PSNR (dB)", "PSNR, covered pixels", "largest difference"});
  scene.scene.render.pipeline = Pipeline::grid;
  for (const std::size_t nodes : {8, 16, 32, 64, 128}) {
    say("grids: " + std::to_string(nodes) + " nodes");
    scene.scene.render.grid_size = {nodes, nodes, nodes};
    prepare_again(scene);
    const MapGridError error = map_grid_error(scene);
    const Difference d = difference(render(scene, &bench.context, {}).image, exact);
    table.row({std::to_string(nodes) + "³", fixed(error.largest, 3), fixed(error.rms, 3), decibel(d.psnr),
               decibel(d.psnr_covered), fixed(d.largest, 3)});
  }
}

} // namespace slicelens::accuracy
