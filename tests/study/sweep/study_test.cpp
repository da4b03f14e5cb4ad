// Study files: what they mean and what is refused.
#include "catch.h"
#include "core/errors.h"
#include "study/sweep/combinations.h"

#include <algorithm>

using namespace slicelens;

namespace {

Study read(const std::string& json, const StudyChoice& choice = {}) {
  return study_from_json(json, "test.json", ".", choice);
}

std::vector<std::string> names(const Study& study) {
  std::vector<std::string> texts;
  for (const Combination& one : combinations_of(study))
    texts.push_back(label_text(one.labels));
  return texts;
}

std::string refusal(const std::string& json) {
  try {
    (void)read(json);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "accepted";
}

std::string with_vary(const std::string& vary) { return R"({"vary": )" + vary + "}"; }

} // namespace

TEST_CASE("keys of an object are crossed, the last one changes fastest") {
  const Study study = read(with_vary(R"({"render.spacing": [2, 1], "render.pipeline": ["slices", "rays"]})"));
  REQUIRE(names(study) == std::vector<std::string>{"render.spacing 2, render.pipeline slices",
                                                   "render.spacing 2, render.pipeline rays",
                                                   "render.spacing 1, render.pipeline slices",
                                                   "render.spacing 1, render.pipeline rays"});
  const SceneInput input = scene_of(study, combinations_of(study)[3]);
  REQUIRE(input.scene.render.spacing == 1);
  REQUIRE(input.scene.render.pipeline == Pipeline::rays);
}

TEST_CASE("keys of one axis go together, axes are crossed") {
  const Study study =
      read(with_vary(R"([{"volume.size": [[8,8,8], [16,16,16]], "render.size": [[64,64], [128,128]]},
                                         {"name": "light", "cases": {"off": {}, "on": {"render.shading": "diffuse"}}}])"));
  REQUIRE(names(study) ==
          std::vector<std::string>{"volume.size [8,8,8], render.size [64,64], light off",
                                   "volume.size [8,8,8], render.size [64,64], light on",
                                   "volume.size [16,16,16], render.size [128,128], light off",
                                   "volume.size [16,16,16], render.size [128,128], light on"});
}

TEST_CASE("ranges go by step, by factor and by count") {
  REQUIRE(names(read(with_vary(R"({"camera.azimuth": {"from": 0, "to": 90, "step": 45}})"))) ==
          std::vector<std::string>{"camera.azimuth 0", "camera.azimuth 45", "camera.azimuth 90"});
  REQUIRE(names(read(with_vary(R"({"render.spacing": {"from": 4, "to": 0.5, "factor": 0.5}})"))) ==
          std::vector<std::string>{"render.spacing 4", "render.spacing 2", "render.spacing 1",
                                   "render.spacing 0.5"});
  REQUIRE(names(read(with_vary(R"({"camera.zoom": {"from": 1, "to": 100, "count": 3, "scale": "log"}})"))) ==
          std::vector<std::string>{"camera.zoom 1", "camera.zoom 10", "camera.zoom 100"});
  // 0.1·3 is not 0.3 in binary; the end of a range is not lost to that, and prints as people write it.
  REQUIRE(names(read(with_vary(R"({"render.spacing": {"from": 0.1, "to": 0.3, "step": 0.1}})"))) ==
          std::vector<std::string>{"render.spacing 0.1", "render.spacing 0.2", "render.spacing 0.3"});
}

TEST_CASE("several scenes are an axis of their own, or a case's choice") {
  const Study study = read(R"({"scenes": {"a": {"render": {"spacing": 2}}, "b": {"render": {"spacing": 3}}},
                               "vary": {"camera.azimuth": [0, 90]}})");
  REQUIRE(names(study) == std::vector<std::string>{"scene a, camera.azimuth 0", "scene a, camera.azimuth 90",
                                                   "scene b, camera.azimuth 0",
                                                   "scene b, camera.azimuth 90"});
  REQUIRE(scene_of(study, combinations_of(study)[2]).scene.render.spacing == 3);
  const Study chosen = read(R"({"scenes": {"a": {"render": {"spacing": 2}}, "b": {"render": {"spacing": 3}}},
    "vary": [{"name": "what", "cases": {"first": {"scene": "a"}, "second": {"scene": "b", "camera.azimuth": 30}}}]})");
  REQUIRE(names(chosen) == std::vector<std::string>{"what first", "what second"});
  REQUIRE(scene_of(chosen, combinations_of(chosen)[1]).scene.render.spacing == 3);
}

TEST_CASE("combinations can be left out, and find their baseline") {
  const Study study = read(
      R"({"vary": [{"render.spacing": [2, 1]}, {"name": "lens", "cases": {"plain": {}, "turned": {"camera.roll": 5},
                               "tilted": {"camera.elevation": 5}}}],
                               "except": [{"render.spacing": 2, "lens": ["turned", "tilted"]}],
                               "timing": {"baseline": {"lens": "plain"}}})");
  const auto all = combinations_of(study);
  REQUIRE(all.size() == 4);
  REQUIRE(all[1].labels == std::vector<Label>{{"render.spacing", "1"}, {"lens", "plain"}});
  for (const std::size_t index : {1, 2, 3})
    REQUIRE(baseline_of(study, all, all[index]) == std::optional<std::size_t>(1));
  REQUIRE(baseline_of(study, all, all[0]) == std::optional<std::size_t>(0));
}

TEST_CASE("the reference is the combination's scene with changes, or a scene of its own") {
  const Study study =
      read(R"({"vary": {"render.spacing": [2, 1]}, "reference": {"set": {"render.spacing": 0.25}}})");
  const auto all = combinations_of(study);
  REQUIRE(std::get<SceneInput>(*reference_of(study, all[0])).scene.render.spacing == 0.25);
  const Study other =
      read(R"({"vary": {"render.spacing": [2, 1]}, "reference": {"scene": {"camera": {"azimuth": 7}}}})");
  REQUIRE(std::get<SceneInput>(*reference_of(other, all[0])).scene.camera.azimuth == 7);
  REQUIRE(std::get<SceneInput>(*reference_of(other, all[0])).scene.render.spacing ==
          1); // the default: nothing varies there
  REQUIRE_FALSE(reference_of(read("{}"), combinations_of(read("{}"))[0]).has_value());
}

TEST_CASE("vtk pipelines are drawn by a peer") {
  const Study study = read(with_vary(R"({"render.pipeline": ["slices", "vtk-gpu", "vtk-cpu"]})"));
  const auto all = combinations_of(study);
  REQUIRE_FALSE(all[0].peer.has_value());
  REQUIRE(all[1].peer == std::optional<std::string>("gpu"));
  REQUIRE(all[2].peer == std::optional<std::string>("cpu"));
  REQUIRE(scene_of(study, all[2]).scene.render.pipeline == Pipeline::slices);
}

TEST_CASE("a quick form patches the study") {
  const std::string json =
      R"({"vary": {"render.spacing": [2, 1, 0.5]}, "quick": {"vary": {"render.spacing": [2]}, "timing": false}})";
  REQUIRE(combinations_of(read(json)).size() == 3);
  StudyChoice choice;
  choice.quick = true;
  REQUIRE(combinations_of(read(json, choice)).size() == 1);
  REQUIRE_FALSE(read(json, choice).timing.measure);
}

TEST_CASE("a study that cannot be meant is refused by name") {
  struct Case {
    std::string json;
    std::string says;
  };
  const std::vector<Case> cases = {
      {"[1]", "give an object"},
      {"{\"vary\": {\"render.spacing\": [1,]\n}", "line 1"},
      {R"({"varry": {}})", "did you mean vary?"},
      {with_vary(R"({"render.spacng": [1]})"), "did you mean render.spacing?"},
      {with_vary(R"({"render.spacing": []})"), "has no values"},
      {with_vary(R"({"render.spacing": [-1]})"), "above 0"},
      {with_vary(R"({"render.spacing": 1})"), "give a list of values or a range"},
      {with_vary(R"([{"render.spacing": [1, 2], "camera.zoom": [1]}])"), "equally many"},
      {with_vary(R"([{"render.spacing": [1]}, {"render.spacing": [2]}])"), "given twice"},
      {with_vary(R"([{"cases": {"a": {}}}])"), "name is missing"},
      {with_vary(R"([{"name": "x", "cases": {}}])"), "at least one case"},
      {with_vary(R"({"render.spacing": {"from": 1, "to": 2}})"), "one of step, factor and count"},
      {with_vary(R"({"render.spacing": {"from": 1, "to": 2, "step": -1}})"), "never leads"},
      {with_vary(R"({"render.spacing": {"from": 1, "to": 2, "factor": 0.5}})"), "never leads"},
      {with_vary(R"({"render.spacing": {"from": 1, "to": 2, "step": 1e-9}})"), "more than"},
      {R"({"scene": {}, "scenes": {}})", "keep one"},
      {R"({"except": [{"render.spacing": 1}]})", "does not vary"},
      {R"({"vary": {"render.spacing": [1]}, "except": [{"render.spacing": 2}]})", "has no value 2"},
      {R"({"vary": {"render.spacing": [1]}, "except": [{"render.spacing": 1}]})", "leaves no combination"},
      {R"({"metrics": ["psnr"]})", "compares with a reference"},
      {R"({"reference": {}, "metrics": ["pnsr"]})", "did you mean psnr?"},
      {R"({"timing": {"rounds": 0}})", "from 1 to"},
      {R"({"timing": {"baseline": {"lens": "plain"}}})", "does not vary"},
      {R"({"reference": {"set": {"render.spacng": 1}}})", "did you mean render.spacing?"},
      {R"({"paper": [{"source": "x"}]})", "source, quantity and values"},
      {R"({"charts": [{"x": "render.spacing"}]})", "needs x and y"},
  };
  for (const Case& one : cases) {
    INFO(one.json);
    REQUIRE(refusal(one.json).find(one.says) != std::string::npos);
  }
  REQUIRE_THROWS_AS(read(R"({"scene": "no_such_scene.json"})"), FileError);
}

TEST_CASE("a study may be of 2D lenses") {
  const Study study = read(R"({"scene": {"image": {"testcard": {"size": [64, 64]}}},
    "vary": {"render.pipeline": ["tessellated", "lookup"], "warp.zoom": [2]},
    "reference": {"set": {"render.pipeline": "reference"}}})");
  const auto all = combinations_of(study);
  REQUIRE(std::get<PictureInput>(input_of(study, all[1])).scene.render.pipeline == LensPipeline::lookup);
  REQUIRE(std::get<PictureInput>(*reference_of(study, all[1])).scene.render.pipeline ==
          LensPipeline::reference);
  REQUIRE(refusal(R"({"scene": {"image": {}}, "vary": {"warp.zom": [2]}})").find("warp.zoom") !=
          std::string::npos);
}
