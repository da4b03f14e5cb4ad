// What render.skip and render.planes_per_pass are refused with: one line that names the key and what to do.
#include "catch.h"
#include "core/errors.h"
#include "scene/scene_json.h"

using namespace slicelens;

namespace {

std::string refusal(const std::string& render, const std::string& more = "") {
  try {
    scene_from_json(R"({"render":{)" + render + "}" + more + "}", "s.json");
  } catch (const UsageError& error) {
    return error.what();
  }
  return "";
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

const std::string passes = R"("planes_per_pass":8)";
const std::string empty = R"("skip":"empty")";
const std::string hidden = R"("skip":"empty+hidden")";
const std::string twist = R"(,"warp":{"kind":"twist"})";

} // namespace

TEST_CASE("the defaults leave nothing out and draw plane by plane") {
  const Scene scene = scene_from_json("{}", "s.json");
  CHECK(scene.render.skip == Skip::none);
  CHECK(scene.render.planes_per_pass == 1);
}

TEST_CASE("several planes a pass: what is taken and what is refused by name") {
  CHECK(refusal(passes).empty());
  CHECK(refusal(passes + R"(,"mode":"mip")").empty());
  CHECK(refusal(passes + R"(,"pipeline":"fragment")", twist).empty());
  CHECK(contains(refusal(R"("planes_per_pass":0)"), "render.planes_per_pass must be from 1 to 4096, not 0"));
  CHECK(contains(refusal(R"("planes_per_pass":4097)"), "not 4097"));
  CHECK(contains(refusal(passes + R"(,"pipeline":"rays")"), "pipeline 'rays' has none"));
  CHECK(contains(refusal(passes + R"(,"pipeline":"tessellated")", twist),
                 "use slices, axis, fragment or grid"));
  CHECK(contains(refusal(passes + R"(,"mode":"iso")"), "mode 'iso'"));
  CHECK(contains(refusal(passes + R"(,"proxy":"shells")", R"(,"camera":{"projection":"perspective"})"),
                 "set render.proxy to planes"));
  CHECK(contains(refusal(passes + R"(,"tiles":[2,1,1])"), "set render.tiles to [1,1,1]"));
  CHECK(contains(refusal(passes, R"(,"planes":[{"point":[0.5,0.5,0.5]}])"), "remove planes"));
}

TEST_CASE("labels: what is taken and what is refused by name") {
  const std::string volume = R"(,"volume":{"phantom":"organs","labels":"organs-labels"})";
  const std::string whole = volume + R"(,"labels":[{"label":3,"mode":"mip"}])";
  const std::string unseen = volume + R"(,"labels":[{"label":3,"mode":"mip","visible":false}])";
  for (const std::string& key : {empty, passes}) {
    CHECK(refusal(key, volume).empty());
    CHECK(refusal(key, unseen).empty());
    CHECK(contains(refusal(key, whole), "use pipeline rays, or mode dvr"));
  }
  CHECK(refusal(empty + R"(,"pipeline":"rays")", whole).empty());
  CHECK(refusal(hidden + R"(,"pipeline":"rays")", whole).empty());
}

TEST_CASE("samples left out: what is taken and what is refused by name") {
  CHECK(refusal(empty).empty());
  CHECK(refusal(empty + R"(,"pipeline":"rays")").empty());
  CHECK(refusal(hidden + R"(,"pipeline":"rays")").empty());
  CHECK(refusal(hidden + R"(,"order":"front-to-back")").empty());
  CHECK(contains(refusal(R"("skip":"hidden")"), "empty+hidden"));
  CHECK(contains(refusal(hidden), "set render.order to front-to-back"));
  CHECK(contains(refusal(hidden + R"(,"mode":"mip","order":"front-to-back")"), "set render.skip to empty"));
  CHECK(contains(refusal(empty + R"(,"pipeline":"reference")"), "the reference samples everything"));
  CHECK(contains(refusal(empty + R"(,"mode":"average")"), "mode 'average'"));
  CHECK(refusal(empty + R"(,"mode":"iso","pipeline":"rays")").empty());
  CHECK(contains(refusal(empty + R"(,"mode":"iso")"), "use pipeline rays"));
  CHECK(contains(refusal(hidden + R"(,"mode":"iso","pipeline":"rays")"), "set render.skip to empty"));
  CHECK(refusal(hidden + R"(,"classification":"preintegrated","order":"front-to-back")").empty());
  CHECK(refusal(empty + R"(,"classification":"pre")").empty());
  CHECK(contains(refusal(empty + R"(,"footprint":"mip")"), "render.footprint to point"));
  CHECK(
      contains(refusal(empty + R"(,"pipeline":"tessellated")", twist), "use slices, axis, fragment or grid"));
  CHECK(contains(refusal(empty, R"(,"volumes":[{"phantom":"head"},{"phantom":"head"}])"), "one volume"));
}
