// What pictures with samples left out are compared with, and the scenes for it.
#pragma once

#include "catch.h"
#include "render_fixture.h"
#include "volume_fixture.h"

namespace slicelens {

inline constexpr double visible = 1.0 / 255;

/// The head of 48³ voxels, bone dense and skin thin; air, and so the box's outline, is transparent.
inline PreparedScene head_scene() {
  return prepare_phantom(
      R"({"volume":{"phantom":"head","size":[48,48,48]},"camera":{"azimuth":33,"elevation":21,"roll":10},
          "render":{"size":[80,64],"filter":"linear-exact","background":[0,0,0,0]}})",
      {{{-500, 0.4, 0.2, 0.1, 0}, {200, 0.8, 0.6, 0.4, 0.05}, {1200, 1, 1, 0.9, 0.7}}, std::nullopt, ""});
}

inline std::vector<std::string> with(std::vector<std::string> keys, const std::vector<std::string>& more) {
  keys.insert(keys.end(), more.begin(), more.end());
  return keys;
}

inline const std::vector<std::string> projections = {"orthographic", "perspective"};
inline const std::string twist = R"(warp={"kind":"twist","axis":"z","angle":70})";
inline const std::string lens =
    R"(warp={"kind":"lamar","center":[0.5,0.4,0.55],"inner":0.15,"outer":0.3,"zoom":3})";
inline const std::string fisheye = R"(warp={"kind":"fisheye","distortion":3})";

/// What plain slices are compared with. `hidden`: also empty+hidden; `flips`: share of values that may be
/// others because something shows on an outline.
struct Bar {
  bool hidden = true;
  double flips = 0;
  double largest = visible;
};
inline constexpr Bar no_hidden{false};
inline constexpr Bar outlines{true, 1e-3};

/// Plain slices, or rays, against the same with samples left out, both projections, one slice or many in a
/// pass.
inline void check_skipping(const PreparedScene& scene, const std::vector<std::string>& settings,
                           const Bar& bar = {}) {
  gl::Context context = test_context();
  for (const std::string& projection : projections) {
    const PreparedScene plain = changed(scene, with(settings, {"camera.projection=" + projection}));
    const Image expected = picture(plain, context);
    const bool rays = plain.scene.render.pipeline == Pipeline::rays;
    for (const std::string planes : {"1", "5", "256"}) {
      if (rays && planes != "1")
        continue;
      INFO(projection << ", " << planes << " planes");
      const std::vector<std::string> keys = {"render.planes_per_pass=" + planes, "render.skip=empty"};
      CHECK(share_over(picture(changed(plain, keys), context), expected, bar.largest) <= bar.flips);
      if (!bar.hidden)
        continue;
      std::vector<std::string> more = {"render.planes_per_pass=" + planes, "render.skip=empty+hidden"};
      if (!rays)
        more.push_back("render.order=front-to-back");
      CHECK(share_over(picture(changed(plain, more), context), expected, bar.largest) <= bar.flips);
    }
  }
}

/// The head under functions that show much, little, a narrow band, and its inside only.
inline void check_functions(const std::vector<std::string>& settings, const Bar& bar = {}) {
  PreparedScene scene = head_scene();
  const std::vector<TransferFunction> functions = {
      scene.transfer,
      rising(-900, 1200, 0.02),
      rising(300, 310, 1),
      {{{50, 1, 0.5, 0.2, 0}, {60, 1, 0.5, 0.2, 0.8}, {70, 1, 0.5, 0.2, 0}}, std::nullopt, "band"}};
  for (std::size_t i = 0; i < functions.size(); ++i) {
    INFO("function " << i);
    scene.transfer = functions[i];
    check_skipping(scene, settings, bar);
  }
}

/// A volume of 24³ zeros but for what f says, one world unit a voxel.
template <class Function>
PreparedScene small_scene(TransferFunction transfer, const Function& f) {
  return prepare(scene_from_json(R"({"volume":{"phantom":"head"},"camera":{"azimuth":33,"elevation":21},
      "render":{"size":[64,48],"background":[0,0,0,0]}})",
                                 "test"),
                 volume_of(ScalarType::u16, {24, 24, 24}, f), std::move(transfer));
}

inline TransferFunction tent(double value) {
  return {{{value - 1, 1, 1, 1, 0}, {value, 1, 1, 1, 1}, {value + 1, 1, 1, 1, 0}}, std::nullopt, "tent"};
}

} // namespace slicelens
