#include "catch.h"
#include "core/errors.h"
#include "scene/vary.h"

using namespace slicelens;

namespace {

std::string value_at(const std::string& text, double t, bool whole = false) {
  Variation variation = parse_variation(text);
  variation.whole = whole;
  const auto changes = changes_at({variation}, t);
  REQUIRE(changes.size() == 1);
  CHECK(changes[0].key == variation.key);
  return changes[0].value;
}

} // namespace

TEST_CASE("a variation is linear and meets its ends exactly") {
  CHECK(value_at("camera.azimuth=0:360", 0) == "0.0");
  CHECK(value_at("camera.azimuth=0:360", 0.25) == "90.0");
  CHECK(value_at("camera.azimuth=0:360", 1) == "360.0");
  CHECK(value_at("a=0.1:0.7", 0) == "0.1");
  CHECK(value_at("a=0.1:0.7", 1) == "0.7"); // 0.1 + 1·(0.7 − 0.1) is not 0.7 in binary
  CHECK(value_at("a=-1e2:1e2", 0.5) == "0.0");
  CHECK(value_at("a=[0,1]:[1,-1]", 0.5) == "[0.5,0.0]");
  CHECK(value_at("a=[[0,4],[2,2]]:[[4,0],[2,6]]", 0.25) == "[[1.0,3.0],[2.0,3.0]]");
  CHECK(value_at("a=2:5", 0.5, true) == "4"); // 3.5, rounded away from zero
  CHECK(value_at("a=[16,16]:[32,17]", 0.25, true) == "[20,16]");
}

TEST_CASE("what cannot vary is refused by name") {
  for (const char* text : {"", "a", "a=1", "=1:2", "a:1=2", "a=1:", "a=:1", "a=x:y", "a=1:2:3",
                           "a=true:false", "a=\"1\":\"2\"", "a=[]:[]", "a=[1,2]:[1]", "a=1:[1]",
                           "a=[1,x]:[1,2]", "a=1e999:2", "a=nan:1", "a={}:{}", "a=null:1"}) {
    CAPTURE(text);
    CHECK_THROWS_AS(parse_variation(text), UsageError);
  }
}

TEST_CASE("the frames of a loop leave out the last one") {
  CHECK(time_of_frame(0, 5, false) == 0);
  CHECK(time_of_frame(1, 5, false) == 0.25);
  CHECK(time_of_frame(4, 5, false) == 1);
  CHECK(time_of_frame(3, 4, true) == 0.75);
  CHECK(time_of_frame(0, 1, false) == 0);
  CHECK(time_of_frame(0, 1, true) == 0);
}

TEST_CASE("keys of whole numbers are known from the scene") {
  const Scene scene = scene_from_json(R"({"warp": {"kind": "leafer"}, "volume": {"size": [8, 8, 8]}})", "s");
  for (const char* key : {"render.size", "volume.size", "render.grid_size", "warp.leaves", "warp[0].leaves",
                          "warp.0.leaves", "volume.frame"}) {
    CAPTURE(key);
    CHECK(is_whole_key(scene, key));
  }
  for (const char* key : {"camera.azimuth", "render.background", "warp.angle", "warp[1].leaves", "title",
                          "camera.position", "camera", "camera.azimuth.x", "nothing"}) {
    CAPTURE(key);
    CHECK_FALSE(is_whole_key(scene, key));
  }
}
