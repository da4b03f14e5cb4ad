// Section `deform`: Brunet's Table 1, frames per second under a deformation as a fraction of
// undeformed slicing with the same shading.
#include "bench.h"
#include "render/slices.h"
#include "scene/load.h"
#include "scene/scene_json.h"
#include "volume/phantom.h"

#include <cstdio>

namespace slicelens::bench {

namespace {

/// One deformation; the paper's fractions of the undeformed 39 frames a second with a transfer function
/// (Table 1), 0 where it has none.
struct Deformation {
  std::string name;
  std::string warp;
  std::string pipeline;
  double paper_fraction;
};

const std::string sine = R"({"kind":"sine","axis":"x","along":"z","amplitude":0.05,"wavelength":0.5})";
const std::string bent = R"({"kind":"bend","axis":"z","toward":"x","angle":20})";

std::vector<Deformation> deformations() {
  return {{"shift", R"({"kind":"shift","offset":[0.02,0.01,0]})", "fragment", 29.2 / 39},
          {"sine", sine, "fragment", 29.0 / 39},
          {"sine in a grid of 16³", sine, "grid 16", 21.7 / 39},
          {"sine in a grid of 32³", sine, "grid 32", 0},
          {"sine in a grid of 64³", sine, "grid 64", 0},
          {"twist", R"({"kind":"twist","axis":"z","angle":40})", "fragment", 0},
          {"bend", bent, "fragment", 0}};
}

PreparedScene deformed(const PreparedScene& plain, const Deformation& deformation) {
  const std::string pipeline = deformation.pipeline.substr(0, deformation.pipeline.find(' '));
  std::vector<KeyValue> changes = {
      {"warp", deformation.warp}, {"render.pipeline", pipeline}, {"render.gradient_space", "object"}};
  if (pipeline == "grid")
    changes.emplace_back("render.grid_size", deformation.pipeline.substr(5));
  PreparedScene result = plain;
  result.scene = scene_from_json(scene_to_json(plain.scene), "bench", changes);
  prepare_again(result);
  return result;
}

void run_volume(gl::Context& context, const BenchOptions& options, const std::string& name, Scene scene,
                Volume volume) {
  const gl::Functions& gl = context.functions();
  const TransferFunction transfer = transfer_of(scene, volume);
  std::printf("\n%s, %zu×%zu×%zu voxels in %zu×%zu pixels, %s.\n\n", name.c_str(), volume.dims[0],
              volume.dims[1], volume.dims[2], scene.render.size[0], scene.render.size[1],
              scene.render.shading == Shading::none ? "transfer function only"
                                                    : "forward gradient and diffuse light");
  const PreparedScene plain = prepare(std::move(scene), std::move(volume), transfer);
  const GpuScene textures = upload(gl, plain, {});
  const gl::Target target = gl::make_target(gl, plain.view.width, plain.view.height, GL_RGBA32F);
  SliceRenderer baseline(gl, plain);
  baseline.slice(plain);
  const double fragments =
      static_cast<double>(fragments_of(gl, [&] { baseline.draw(plain, textures, target, {}); }));
  print_heading({"deformation", "paper", "frames ÷ plain", "processor", "fragments ÷ plain"});
  for (const Deformation& deformation : deformations()) {
    if (deformation.name.find(options.only) == std::string::npos)
      continue;
    const PreparedScene prepared = deformed(plain, deformation);
    const GpuScene own = upload(gl, prepared, {});
    SliceRenderer renderer(gl, prepared);
    renderer.slice(prepared);
    const Turns turns = in_turn(
        gl, options.runs, [&] { baseline.draw(plain, textures, target, {}); },
        [&] { renderer.draw(prepared, own, target, {}); });
    const double drawn =
        static_cast<double>(fragments_of(gl, [&] { renderer.draw(prepared, own, target, {}); }));
    // The paper names no undeformed rate with shading.
    const bool known = deformation.paper_fraction > 0 && plain.scene.render.shading == Shading::none;
    print_row({deformation.name, known ? fixed(deformation.paper_fraction, 2) : "",
               spread_text(ratios(turns.a, turns.b), 3), spread_text(ratios(turns.a_work, turns.b_work), 3),
               fixed(drawn / fragments, 3)});
  }
}

} // namespace

void run_deform(gl::Context& context, const BenchOptions& options) {
  std::printf(
      "\n## Deformations: frames a second as a fraction of undeformed slicing\n\n"
      "Drawn in turn with `slices` of the same shading, %d runs of each. Fractions by wall clock and by "
      "processor time of all threads: median and quartiles. Fragments are those that are not discarded.\n",
      options.runs);
  Scene scene = phantom_scene(options);
  scene.transfer.preset = "CT-Bone";
  scene.camera.azimuth = 30;
  scene.camera.elevation = 20;
  for (const Shading shading : {Shading::none, Shading::diffuse}) {
    scene.render.shading = shading;
    scene.render.gradient = Gradient::forward;
    if (options.volumes.empty())
      run_volume(context, options, "Head phantom", scene, make_phantom("head", *scene.volume.size));
    for (const std::string& path : options.volumes) {
      Scene real = scene;
      real.volume = {};
      real.volume.file = path;
      run_volume(context, options, path.substr(path.find_last_of('/') + 1), real,
                 load_volume(real.volume, {"."}, {}));
    }
  }
}

} // namespace slicelens::bench
