// `slicelens lens` as its users call it.

#include "catch.h"
#include "program.h"

#include <algorithm>

namespace {

using Words = std::vector<std::string>;
using Catch::Matchers::Contains;

void check_refused(const Workplace& place, const Words& call, int status, const Words& named) {
  const Outcome outcome = place.run(call);
  CAPTURE(call, outcome.err);
  CHECK(outcome.status == status);
  CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
  for (const std::string& text : named)
    CHECK_THAT(outcome.err, Contains(text));
}

} // namespace

TEST_CASE("lens: a picture carries its scene and is drawn again from it") {
  const Workplace place;
  REQUIRE(place
              .run({"lens", "testcard", "-o", "card.png", "--set", "image.testcard.size=[60,40]", "--set",
                    "warp=[]"})
              .status == 0);
  const Outcome first =
      place.run({"lens", "card.png", "-o", "a.png", "--set", "image.file=card.png", "--set", "warp=null",
                 "--wireframe", "--outline", "--lattice", "8", "--magnification"});
  CAPTURE(first.err);
  REQUIRE(first.status == 0);
  CHECK(first.out == "a.png\n");
  REQUIRE(place.run({"lens", "a.png", "-o", "b.png"}).status == 0);
  CHECK(contents(place / "a.png") == contents(place / "b.png"));
  // Other data under the same name is refused.
  REQUIRE(place.run({"lens", "checkerboard", "-o", "card.png"}).status == 0);
  check_refused(place, {"lens", "a.png", "-o", "c.png"}, 1, {"card.png", "SHA-256"});
  CHECK_FALSE(fs::exists(place / "c.png"));
}

TEST_CASE("lens: any picture is taken as it is") {
  const Workplace place;
  put(place / "s.json", small_scene);
  REQUIRE(place.run({"render", "s.json", "-o", "volume.png"}).status == 0);
  const Outcome outcome = place.run(
      {"lens", "volume.png", "-o", "lens.png", "--set", "warp.zoom=2", "--set", "warp.center=[0.3,0.7]"});
  CAPTURE(outcome.err);
  CHECK(outcome.status == 0);
  const Outcome printed = place.run({"lens", "volume.png", "-o", "x.png", "--print-scene"});
  CHECK_THAT(printed.out, Contains("\"file\": \"volume.png\""));
  check_refused(place, {"render", "lens.png", "-o", "y.png"}, 2, {"lens.png", "slicelens lens"});
}

TEST_CASE("lens: wrong calls say what would be right and leave nothing") {
  const Workplace place;
  put(place / "noise.png", "\x89PNG\r\n\x1a\n not a picture");
  put(place / "flat.json", R"({"image": {"checkerboard": {"squares": 4}}})");
  const auto set = [](const std::string& change) {
    return Words{"lens", "checkerboard", "-o", "p.png", "--set", change};
  };
  check_refused(place, {"lens", "checkerboard"}, 2, {"--output"});
  check_refused(place, {"lens", "checkerboard", "-o", "p.bmp"}, 2, {"p.bmp", ".png"});
  check_refused(place, {"lens", "nowhere.png", "-o", "p.png"}, 1, {"nowhere.png"});
  check_refused(place, {"lens", "noise.png", "-o", "p.png"}, 1, {"noise.png"});
  check_refused(place, {"lens", "checkerboard", "-o", "p.png", "--lattice", "0"}, 2, {"--lattice"});
  check_refused(place, set("warp.inner=0.5"), 2, {"inner", "outer"});
  check_refused(place, set("warp.zoom=-1"), 2, {"warp.zoom"});
  check_refused(place, set("warp.zom=2"), 2, {"warp.zom", "warp.zoom"});
  check_refused(place, set("warp.kind=lamr"), 2, {"lamr", "lamar"});
  check_refused(place, set("warp.center=[0.5]"), 2, {"warp.center", "[x, y]"});
  check_refused(place, set("warp.depth_inner=0.1"), 2, {"depth_inner", "no depth"});
  check_refused(place, set("render.pipeline=rays"), 2, {"rays", "tessellated"});
  check_refused(place, set("image.checkerboard.squares=0"), 2, {"squares"});
  check_refused(place, set("image.checkerboard.size=[0,5]"), 2, {"image.checkerboard.size"});
  check_refused(place, set("image.checkerboard.size=[32768,32768]"), 2, {"image.checkerboard.size"});
  check_refused(place, set("render.size=[99999,1]"), 2, {"render.size"});
  check_refused(place, {"render", "flat.json", "-o", "p.png"}, 2, {"flat.json", "slicelens lens"});
  CHECK(place.entries() == Words{"flat.json", "noise.png"});
}
