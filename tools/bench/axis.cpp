// Section `axis`: what Cohen's effects cost, as a fraction of plain slicing (Cohen, Brodlie and Phillips 2008
// §5), and what rewriting the tables costs.
#include "bench.h"
#include "gl/timer.h"
#include "render/slices.h"
#include "scene/load.h"
#include "scene/scene_json.h"
#include "volume/phantom.h"

#include <cstdio>

namespace slicelens::bench {

namespace {

/// The paper's 18 frames a second with all effects beside 43 without.
constexpr double paper_fraction = 18.0 / 43.0;

struct Effects {
  std::string name;
  std::vector<std::string> keys;
};

std::vector<Effects> all_effects() {
  const std::string focus = "[[0.35,0.5],[0.4,0.55],[0.4,0.55]]";
  const std::string shown = "[[0.25,0.6],[0.3,0.65],[0.3,0.65]]";
  const std::string bifocal = R"(warp={"kind":"bifocal","focus":)" + focus + R"(,"shown":)" + shown + "}";
  const std::string fisheye = R"(warp={"kind":"fisheye","center":[0.42,0.47,0.47],"distortion":2})";
  const auto lens = [](const std::string& kind) {
    return R"(warp={"kind":")" + kind +
           R"(","center":[0.42,0.47,0.47],"inner":0.12,"outer":0.25,"magnification":2.5})";
  };
  const std::vector<std::string> everywhere = {"highlight.function=distance", "highlight.power=2",
                                               "attenuation.function=distance", "attenuation.power=2"};
  const std::vector<std::string> focused = {"highlight.function=focus", "attenuation.function=viewpoint",
                                            "attenuation.power=2"};
  const auto joined = [](std::string warp, std::vector<std::string> keys) {
    keys.insert(keys.begin(), std::move(warp));
    return keys;
  };
  return {
      {"bifocal, distance effects", joined(bifocal, everywhere)},
      {"fisheye, distance effects", joined(fisheye, everywhere)},
      {"volume lens, distance effects", joined(lens("volume-lens"), everywhere)},
      {"connected lens, distance effects", joined(lens("connected-lens"), everywhere)},
      {"bifocal, focus highlight, viewpoint attenuation", joined(bifocal, focused)},
      {"volume lens, focus highlight, viewpoint attenuation", joined(lens("volume-lens"), focused)},
      {"connected lens, focus highlight, viewpoint attenuation", joined(lens("connected-lens"), focused)},
      {"volume lens alone", {lens("volume-lens")}},
      {"fisheye alone", {fisheye}},
  };
}

PreparedScene with_keys(const PreparedScene& plain, const std::vector<std::string>& keys,
                        std::vector<KeyValue> changes) {
  changes.emplace_back("render.pipeline", "axis");
  for (const std::string& key : keys)
    changes.push_back(parse_assignment(key));
  PreparedScene result = plain;
  result.scene = scene_from_json(scene_to_json(plain.scene), "bench", changes);
  prepare_again(result);
  return result;
}

/// A changed effect: the tables worked out and written again, beside the frame that is drawn with them.
void run_update(const gl::Functions& gl, const BenchOptions& options, const PreparedScene& plain,
                GpuScene& textures, const gl::Target& target) {
  PreparedScene prepared = with_keys(plain, all_effects()[0].keys, {});
  textures.axis = {};
  std::size_t bytes = upload_axis_tables(gl, prepared, textures.axis);
  SliceRenderer renderer(gl, prepared);
  renderer.slice(prepared);
  const Turns turns = in_turn(
      gl, options.runs,
      [&] {
        prepared.tables = axis_tables_of(prepared);
        bytes = upload_axis_tables(gl, prepared, textures.axis);
      },
      [&] { renderer.draw(prepared, textures, target, {}); });
  const Quartiles share = ratios(turns.a, turns.b);
  std::printf("\nRewriting the tables: %zu bytes, %.3f ms, %.4f [%.4f, %.4f] of a frame.\n", bytes,
              1e3 * median(turns.a), share.median, share.first, share.third);
}

void run_volume(gl::Context& context, const BenchOptions& options, const std::string& name, Scene scene,
                Volume volume) {
  const gl::Functions& gl = context.functions();
  const TransferFunction transfer = transfer_of(scene, volume);
  std::printf("\n%s, %zu×%zu×%zu voxels in %zu×%zu pixels.\n\n", name.c_str(), volume.dims[0], volume.dims[1],
              volume.dims[2], scene.render.size[0], scene.render.size[1]);
  const PreparedScene plain = prepare(std::move(scene), std::move(volume), transfer);
  GpuScene textures = upload(gl, plain, {});
  const gl::Target target = gl::make_target(gl, plain.view.width, plain.view.height, GL_RGBA32F);
  SliceRenderer baseline(gl, plain);
  baseline.slice(plain);
  print_heading({"effects", "paper", "tables filtered", "processor", "nearest, 4096 texels", "processor",
                 "s a frame, plain"});
  for (const Effects& effects : all_effects()) {
    if (effects.name.find(options.only) == std::string::npos)
      continue;
    std::vector<std::string> row = {effects.name, fixed(paper_fraction, 2)};
    std::vector<double> plain_seconds;
    const auto measure = [&](const std::vector<KeyValue>& own) {
      const PreparedScene prepared = with_keys(plain, effects.keys, own);
      textures.axis = {};
      (void)upload_axis_tables(gl, prepared, textures.axis);
      SliceRenderer renderer(gl, prepared);
      renderer.slice(prepared);
      const Turns turns = in_turn(
          gl, options.runs, [&] { baseline.draw(plain, textures, target, {}); },
          [&] { renderer.draw(prepared, textures, target, {}); });
      row.push_back(spread_text(ratios(turns.a, turns.b), 3));
      row.push_back(spread_text(ratios(turns.a_work, turns.b_work), 3));
      plain_seconds.insert(plain_seconds.end(), turns.a.begin(), turns.a.end());
    };
    measure({});
    measure({{"render.axis_filter", "nearest"}, {"render.axis_texels", "4096"}});
    row.push_back(fixed(median(plain_seconds), 3));
    print_row(row);
  }
  run_update(gl, options, plain, textures, target);
}

} // namespace

void run_axis(gl::Context& context, const BenchOptions& options) {
  std::printf(
      "\n## Cohen's effects: frames a second as a fraction of plain slicing\n\n"
      "Pipeline `axis` with mapping, highlight and attenuation beside `slices`, drawn in turn, %d runs "
      "of each. Fractions by wall clock and by processor time of all threads: median and quartiles.\n",
      options.runs);
  Scene scene = phantom_scene(options);
  scene.volume.size = {{512, 512, 146}};
  scene.render.size = {640, 480};
  scene.transfer.preset = "CT-Bone";
  scene.camera.azimuth = 30;
  scene.camera.elevation = 20;
  on_each_volume(options, scene, [&](const std::string& name, Scene own, Volume volume) {
    run_volume(context, options, name, std::move(own), std::move(volume));
  });
}

} // namespace slicelens::bench
