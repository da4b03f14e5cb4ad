// Slices drawn several in a pass, and samples left out, show the picture of plain slices.
//
// Bars. Several planes a pass take the very samples of plain slices and composite them in the same order, so
// only rounding parts them: 1e-4 of any value, most of it what floats make of a sample's place (3e-6 of the
// volume) times the steepest slope of the transfer function. On the outline of the volume and of what
// clipping planes leave, the rasteriser snaps the corners of polygons to 1/256 of a pixel and so adds or
// leaves out single samples: at most 0.1 % of all values, where something shows there. Skipping leaves out
// samples that are nothing, or behind 1 − 1/512 of opacity: 1/255.
#include "skip_fixture.h"

using namespace slicelens;

namespace {

constexpr double rounding = 1e-4;

/// Plain slices against several planes a pass, both projections, all counts and both orders. `flips`: share
/// of values that may be others because something shows on an outline.
void check_passes(const std::vector<std::string>& settings, double flips = 0) {
  gl::Context context = test_context();
  for (const std::string& projection : projections) {
    const PreparedScene plain = changed(head_scene(), with(settings, {"camera.projection=" + projection}));
    const Image expected = picture(plain, context);
    CHECK(share_over(expected, make_image(expected.width, expected.height), 0.02) > 0.02); // there is one
    for (const std::string planes : {"2", "7", "256"}) {
      for (const std::string order : {"back-to-front", "front-to-back"}) {
        INFO(projection << ", " << planes << " planes, " << order);
        const Image passes =
            picture(changed(plain, {"render.planes_per_pass=" + planes, "render.order=" + order}), context);
        CHECK(share_over(passes, expected, rounding) <= flips);
      }
    }
  }
}

} // namespace

TEST_CASE("planes in a pass are plain slices: emission and absorption") { check_passes({}); }
TEST_CASE("planes in a pass are plain slices: maximum") { check_passes({"render.mode=mip"}); }
TEST_CASE("planes in a pass are plain slices: minimum") {
  check_passes({"render.mode=minip", R"(crop={"low":[0.31,0.32,0.3],"high":[0.7,0.71,0.69]})"}, 1e-3);
}
TEST_CASE("planes in a pass are plain slices: mean") {
  check_passes({"render.mode=average", R"(crop={"low":[0.31,0.32,0.3],"high":[0.7,0.71,0.69]})"}, 1e-3);
}
TEST_CASE("planes in a pass are plain slices: X-ray") {
  check_passes({"render.mode=xray", "render.xray_scale=0.1"});
}
TEST_CASE("planes in a pass are plain slices: diffuse light") {
  check_passes({"render.shading=diffuse", "light.direction=[1,-1,0.5]"});
}
TEST_CASE("planes in a pass are plain slices: white highlights, light at the eye") {
  check_passes({"render.shading=phong", "render.gradient=forward"});
}
TEST_CASE("planes in a pass are plain slices: tone") { check_passes({"render.shading=tone"}); }
TEST_CASE("planes in a pass are plain slices: pre-integrated") {
  check_passes({"render.classification=preintegrated"});
}
TEST_CASE("planes in a pass are plain slices: jitter") { check_passes({"render.jitter=0.8"}); }
TEST_CASE("planes in a pass are plain slices: clipping planes") {
  check_passes({R"(clip=[{"point":[0.51,0.5,0.5],"normal":[-1,0.3,0.2]}])", "render.spacing=0.6"}, 1e-3);
}
TEST_CASE("planes in a pass are plain slices: highlight and attenuation") {
  check_passes({"render.pipeline=fragment", twist,
                R"(highlight={"function":"distance","focus":[[0.3,0.6],[0.3,0.6],[0.3,0.6]]})",
                R"(attenuation={"function":"distance","focus":[[0.3,0.6],[0.3,0.6],[0.3,0.6]]})"});
}
TEST_CASE("planes in a pass are plain slices: a maximum's own highlight") {
  check_passes({"render.mode=mip", "render.pipeline=fragment", twist,
                R"(highlight={"function":"distance","focus":[[0.3,0.6],[0.3,0.6],[0.3,0.6]]})"});
}
TEST_CASE("planes in a pass are plain slices: twist") {
  check_passes({"render.pipeline=fragment", twist});
  check_passes({"render.pipeline=fragment", twist, "render.shading=diffuse"});
}
TEST_CASE("planes in a pass are plain slices: a lens") { check_passes({"render.pipeline=fragment", lens}); }
TEST_CASE("planes in a pass are plain slices: a grid") { check_passes({"render.pipeline=grid", twist}); }
TEST_CASE("planes in a pass are plain slices: Cohen's tables") {
  check_passes({"render.pipeline=axis", fisheye});
}

TEST_CASE("skipping changes nothing: emission and absorption") { check_functions({}); }
TEST_CASE("skipping changes nothing: diffuse light") { check_functions({"render.shading=diffuse"}); }
TEST_CASE("skipping changes nothing: white highlights") { check_functions({"render.shading=phong"}); }
TEST_CASE("skipping changes nothing: cubic filter") { check_functions({"render.filter=cubic"}); }
TEST_CASE("skipping changes nothing: nearest filter") {
  // Between two voxels rounding decides.
  check_functions({"render.filter=nearest"}, outlines);
}
TEST_CASE("skipping changes nothing: maximum") { check_functions({"render.mode=mip"}, no_hidden); }
TEST_CASE("skipping changes nothing: minimum") {
  check_functions({"render.mode=minip", R"(crop={"low":[0.31,0.32,0.3],"high":[0.7,0.71,0.69]})"},
                  {false, 1e-3});
}
TEST_CASE("skipping changes nothing: X-ray") {
  check_functions({"render.mode=xray", "render.xray_scale=0.1"}, no_hidden);
}
TEST_CASE("skipping changes nothing: jitter and fine spacing") {
  // softpipe: a place rounded otherwise is a visible step under the steep function, at one pixel, whatever is
  // left out.
  check_functions({"render.jitter=1", "render.spacing=0.4"}, outlines);
}
TEST_CASE("skipping changes nothing: gradients change opacities") {
  check_functions({"render.modulate_by_gradient=100"});
}
TEST_CASE("skipping changes nothing: clipping planes") {
  check_functions({R"(clip=[{"point":[0.51,0.5,0.5],"normal":[-1,0.3,0.2]}])"}, outlines);
}
TEST_CASE("skipping changes nothing: twist") { check_functions({"render.pipeline=fragment", twist}); }
TEST_CASE("skipping changes nothing: a lens") { check_functions({"render.pipeline=fragment", lens}); }
TEST_CASE("skipping changes nothing: a twisted lens, clipped on display") {
  check_functions({"render.pipeline=fragment", "warp=[" + lens.substr(5) + "," + twist.substr(5) + "]",
                   R"(clip=[{"point":[0.5,0.5,0.5],"normal":[-1,0.3,0.2],"space":"object"}])"});
}
TEST_CASE("skipping changes nothing: fisheye and grid") {
  check_functions({"render.pipeline=axis", fisheye});
  check_functions({"render.pipeline=grid", twist});
}
TEST_CASE("skipping changes nothing: rays", "[one-driver]") {
  check_functions({"render.pipeline=rays"});
  check_functions({"render.pipeline=rays", "render.shading=diffuse"});
  check_functions({"render.pipeline=rays", "render.mode=mip"}, no_hidden);
  check_functions({"render.pipeline=rays", "render.mode=xray", "render.xray_scale=0.1"}, no_hidden);
  check_functions({"render.pipeline=rays", twist});
  check_functions({"render.pipeline=rays", lens, "render.jitter=1"});
}
TEST_CASE("skipping changes nothing: the papers' 8 bits") {
  // Drivers round what they filter of 8-bit textures to 8 bits; the last bit of a place may take it to the
  // next code.
  check_functions({"render.volume_texture=r8", "render.transfer_texture=rgba8"}, {true, 0, 2 * visible});
}

TEST_CASE("skipping keeps one voxel in the corner of empty cells", "[one-driver]") {
  for (const int at : {7, 8, 23}) {
    for (const std::string filter : {"linear", "linear-exact", "cubic", "nearest"}) {
      INFO("voxel " << at << ", " << filter);
      const PreparedScene scene = small_scene(
          rising(0, 1000, 1), [&](int i, int j, int k) { return i == at && j == at && k == at ? 1000 : 0; });
      gl::Context context = test_context();
      const PreparedScene filtered = changed(scene, {"render.filter=" + filter, "render.spacing=0.3"});
      const Image expected = picture(filtered, context);
      CHECK(share_over(expected, make_image(64, 48), 0.1) > 0);
      check_skipping(scene, {"render.filter=" + filter, "render.spacing=0.3"});
    }
  }
}

TEST_CASE("skipping keeps values that show only exactly") {
  // A ramp whose single steps are each one value; only one shows. Then only the smallest, only the largest.
  const auto ramp = [](int i, int, int) { return 100 * i; };
  for (const double value : {1100.0, 0.0, 2300.0, 1150.0})
    check_skipping(small_scene(tent(value), ramp), {"render.spacing=0.25"});
  check_skipping(small_scene(step_transfer(1600, {0, 0, 0, 0}, {1, 1, 1, 1}), ramp), {});
}

TEST_CASE("skipping: opaque from the first slice, all empty, all full") {
  const auto ramp = [](int i, int j, int k) { return 10 * (i + j + k); };
  check_skipping(small_scene(grey(1), ramp), {}, outlines);
  check_skipping(small_scene(grey(0), ramp), {});
  check_skipping(small_scene(grey(0.01), ramp), {}, outlines);
  check_skipping(small_scene(grey(0.6), ramp), {"render.pipeline=rays"});
  check_skipping(small_scene(grey(0), ramp), {"render.pipeline=rays"});
  check_skipping(small_scene(grey(0), ramp), {"render.mode=mip"}, no_hidden);
}
