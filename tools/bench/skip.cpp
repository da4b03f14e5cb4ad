// Section `skip`: several planes a pass, and samples left out, against plain slices (docs/skipping.md).
#include "bench.h"
#include "render/rays.h"
#include "render/render.h"
#include "render/slabs.h"
#include "render/slices.h"
#include "scene/load.h"
#include "scene/scene_json.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>

namespace slicelens::bench {

namespace {

/// A scene on the GPU, ready to be drawn again and again.
struct Drawable {
  PreparedScene prepared;
  GpuScene gpu;
  gl::Target target;
  std::unique_ptr<SliceRenderer> slices;
  std::unique_ptr<RayRenderer> rays;
  double geometry_seconds = 0;
};

Drawable make_drawable(const gl::Functions& gl, const PreparedScene& base,
                       const std::vector<KeyValue>& keys) {
  Drawable made;
  made.prepared = base;
  made.prepared.scene = scene_from_json(scene_to_json(base.scene), "bench", keys);
  prepare_again(made.prepared);
  made.gpu = upload(gl, made.prepared, {});
  made.target = gl::make_target(gl, made.prepared.view.width, made.prepared.view.height,
                                texture_format(made.prepared.scene.render.target));
  if (made.prepared.scene.render.pipeline == Pipeline::rays) {
    made.rays = std::make_unique<RayRenderer>(gl, made.prepared);
  } else {
    made.slices = std::make_unique<SliceRenderer>(gl, made.prepared);
    const auto start = std::chrono::steady_clock::now();
    made.slices->slice(made.prepared);
    made.geometry_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
  return made;
}

void draw(Drawable& drawable) {
  if (drawable.rays)
    drawable.rays->draw(drawable.prepared, drawable.gpu, drawable.target, {});
  else
    drawable.slices->draw(drawable.prepared, drawable.gpu, drawable.target, {});
}

struct Way {
  std::string name;
  std::vector<KeyValue> keys;
};

std::vector<Way> ways() {
  const KeyValue front{"render.order", "front-to-back"};
  const KeyValue rays{"render.pipeline", "rays"};
  std::vector<Way> result = {{"plain slices again", {}}};
  for (const std::string planes : {"4", "32", "256"})
    result.push_back({planes + " planes a pass", {{"render.planes_per_pass", planes}}});
  for (const std::string planes : {"1", "32", "64", "256"}) {
    const KeyValue count{"render.planes_per_pass", planes};
    result.push_back({"`empty`, " + planes, {count, {"render.skip", "empty"}}});
    result.push_back({"`empty+hidden`, " + planes, {count, front, {"render.skip", "empty+hidden"}}});
  }
  result.push_back({"rays", {rays}});
  result.push_back({"rays, stopping at opacity 0.998", {rays, {"render.early_termination", "0.998"}}});
  result.push_back({"rays, `empty`", {rays, {"render.skip", "empty"}}});
  result.push_back({"rays, `empty+hidden`", {rays, {"render.skip", "empty+hidden"}}});
  return result;
}

struct Case {
  std::string name;
  std::vector<KeyValue> keys;
};

/// Opaque: what CT-Bone shows. Thin: soft tissue too, a few percent a slice. Full: nothing can be left out.
std::vector<Case> cases() {
  const KeyValue bone{"transfer.preset", "CT-Bone"};
  const KeyValue thin{"transfer.points", "[[-400,0.3,0.2,0.1,0],[200,0.8,0.6,0.4,0.01],[1500,1,1,0.9,0.04]]"};
  const KeyValue full{"transfer.points", "[[-3000,0.3,0.2,0.1,0.0005],[3000,1,1,0.9,0.001]]"};
  const KeyValue light{"render.shading", "diffuse"};
  return {{"opaque (CT-Bone)", {bone}},
          {"opaque, diffuse", {bone, light}},
          {"thin", {thin}},
          {"thin, diffuse", {thin, light}},
          {"everything shows", {full}},
          {"everything shows, diffuse", {full, light}}};
}

double load_now() {
  double loads[1] = {0};
  return getloadavg(loads, 1) == 1 ? loads[0] : 0;
}

double largest_difference(const gl::Functions& gl, const Drawable& a, const Drawable& b) {
  const std::vector<float> p = gl::read_pixels(gl, a.target);
  const std::vector<float> q = gl::read_pixels(gl, b.target);
  double largest = 0;
  for (std::size_t i = 0; i < p.size(); ++i)
    largest = std::max(largest, std::abs(static_cast<double>(p[i]) - static_cast<double>(q[i])));
  return largest;
}

} // namespace

void run_skip(gl::Context& context, const BenchOptions& options) {
  const gl::Functions& gl = context.functions();
  Scene scene = phantom_scene(options);
  scene.camera.azimuth = 30;
  scene.camera.elevation = 20;
  const Volume volume = load_volume(scene.volume, {}, {});
  std::printf(
      "\n## skip: several planes a pass, and samples left out\n\n`head` of %zu³ voxels in %zu² pixels, "
      "spacing 1, azimuth 30°, elevation 20°, orthographic. Each way was drawn in turn with plain "
      "slices, %d runs of each: ratios of wall clock (median and quartiles) and of processor time; "
      "how long the geometry took before, and the largest difference of any value of the picture.\n",
      options.edge, options.picture, options.runs);
  for (const Case& test : cases()) {
    if (test.name.find(options.only) == std::string::npos)
      continue;
    const Scene changed = scene_from_json(scene_to_json(scene), "bench", test.keys);
    const PreparedScene base = prepare(changed, volume, transfer_of(changed, volume));
    Drawable plain = make_drawable(gl, base, {});
    std::printf("\n### %s\n", test.name.c_str());
    print_heading({"way", "time / plain slices'", "processor time / theirs", "s", "geometry, ms",
                   "largest difference", "load average"});
    for (const Way& way : ways()) {
      Drawable drawable = make_drawable(gl, base, way.keys);
      const Turns turns = in_turn(
          gl, options.runs, [&] { draw(drawable); }, [&] { draw(plain); });
      char difference[16];
      std::snprintf(difference, sizeof difference, "%.1e", largest_difference(gl, drawable, plain));
      print_row({way.name, spread_text(ratios(turns.a, turns.b), 2),
                 fixed(ratios(turns.a_work, turns.b_work).median, 2), fixed(median(turns.a), 3),
                 drawable.slices ? fixed(1e3 * drawable.geometry_seconds, 1) : "–", difference,
                 fixed(load_now(), 1)});
    }
  }
}

} // namespace slicelens::bench
