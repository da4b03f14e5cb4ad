#include "catch.h"
#include "core/errors.h"
#include "scene/load.h"
#include "scene/scene_json.h"
#include "volume/phantom.h"

using namespace slicelens;

namespace {

/// The message of the UsageError that reading `text` throws; empty when it throws none.
std::string refusal(const std::string& text, const std::vector<KeyValue>& changes = {}) {
  try {
    scene_from_json(text, "s.json", changes);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "";
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

} // namespace

TEST_CASE("an empty scene has every default") {
  const Scene scene = scene_from_json("{}", "s.json");
  CHECK(scene.volume.phantom == "head");
  CHECK(scene.render.spacing == 1);
  CHECK(scene.render.pipeline == Pipeline::slices);
  CHECK(scene.render.background == glm::dvec4(0, 0, 0, 1));
}

TEST_CASE("keys of all kinds are read, with comments allowed") {
  const Scene scene = scene_from_json(R"({
    // a comment
    "title": "x", "volume": {"file": "a.raw", "size": [4,5,6], "type": "short", "endian": "big"},
    "transfer": {"points": [[0, 0,0,0,0], [10, 1,1,1,0.5]], "unit_distance": 2},
    "camera": {"projection": "perspective", "azimuth": 30},
    "render": {"mode": "mip", "size": [64, 32], "filter": "linear-exact", "background": [1,1,1,0]},
    "clip": [{"point": [0.5,0.5,0.5], "normal": [1,0,0]}] /* end */ })",
                                      "s.json");
  CHECK(scene.volume.file == "a.raw");
  CHECK((*scene.volume.size)[2] == 6);
  CHECK(scene.volume.type == ScalarType::i16);
  CHECK(scene.volume.big_endian == true);
  CHECK((*scene.transfer.points)[1][4] == 0.5);
  CHECK(scene.camera.projection == ProjectionName::perspective);
  CHECK(scene.render.mode == Mode::mip);
  CHECK(scene.render.filter == Filter::linear_exact);
  CHECK(scene.clip.at(0).normal == glm::dvec3(1, 0, 0));
}

TEST_CASE("writing and reading again gives the same scene") {
  const std::string once = scene_to_json(scene_from_json(
      R"({"volume":{"phantom":"ball","size":[9,8,7]},"render":{"spacing":0.1},"clip":[{"normal":[0,0,1]}],"light":{"direction":[1,2,3]}})",
      "s"));
  CHECK(scene_to_json(scene_from_json(once, "s")) == once);
}

TEST_CASE("unknown keys name the nearest known one") {
  CHECK(contains(refusal(R"({"render":{"spaceing":1}})"),
                 "render.spaceing is not a scene key; did you mean render.spacing?"));
  CHECK(contains(refusal(R"({"rendr":{}})"), "did you mean render?"));
  CHECK(contains(refusal(R"({"clip":[{"nromal":[1,0,0]}]})"), "clip[0].nromal"));
}

TEST_CASE("wrong types and values are refused with what would be right") {
  CHECK(contains(refusal(R"({"render":{"spacing":0}})"),
                 "render.spacing: 0 is not valid; give a number above 0"));
  CHECK(contains(refusal(R"({"render":{"spacing":"1"}})"), "give a number"));
  CHECK(contains(refusal(R"({"render":{"mode":"drv"}})"), "give one of dvr, mip, minip, average, xray, iso"));
  CHECK(contains(refusal(R"({"render":{"size":[64]}})"), "list of 2"));
  CHECK(contains(refusal(R"({"render":{"size":[-1,5]}})"), "render.size[0]"));
  CHECK(contains(refusal(R"({"render":{"size":[0,5]}})"), "render.size"));
  CHECK(contains(refusal(R"({"render":{"background":[0,0,2,1]}})"), "from 0 to 1"));
  CHECK(contains(refusal(R"({"volume":{"file":"a","phantom":"b"}})"), "keep one"));
  CHECK(contains(refusal(R"({"camera":{"position":[0,0,0],"azimuth":3}})"), "camera.position excludes"));
  CHECK(contains(refusal(R"({"light":{"direction":[0,0,0]}})"), "zero vector"));
  CHECK(contains(refusal("{\n \"title\": }"), "line 2"));
  CHECK(contains(refusal("[]"), "object"));
}

TEST_CASE("combinations that make no sense are refused by name") {
  CHECK(contains(refusal(R"({"render":{"mode":"xray","target":"rgba8"}})"), "xray"));
  CHECK(contains(refusal(R"({"render":{"early_termination":0.9}})"), "early_termination"));
  CHECK(contains(refusal(R"({"render":{"pipeline":"rays","order":"front-to-back"}})"), "order"));
  CHECK(contains(refusal(R"({"render":{"mode":"mip","shading":"diffuse"}})"), "shading"));
}

TEST_CASE("gradients that cannot be had are refused by name") {
  const std::string fisheye = R"("warp":{"kind":"fisheye"})";
  const auto render = [](const std::string& keys) { return R"("render":{"shading":"phong",)" + keys + "}"; };
  const std::string space = R"("gradient_space":"object")";
  CHECK(contains(refusal("{" + render(R"("gradient":"precomputed",)" + space) + "," + fisheye + "}"),
                 "render.gradient_space to data"));
  CHECK(contains(refusal("{" + render(R"("gradient":"prefiltered","tiles":[2,1,1])") + "}"),
                 "render.gradient 'prefiltered' needs a second texture"));
  CHECK(contains(refusal("{" + render(R"("gradient":"precomputed","levels":2)") + "}"),
                 "render.gradient 'precomputed' needs a second texture"));
  CHECK(contains(refusal("{" + render(space + R"(,"tiles":[2,1,1],"pipeline":"tessellated")") +
                         R"(,"warp":{"kind":"lamar"}})"),
                 "render.gradient_space 'object'"));
  CHECK(contains(refusal(R"({"render":{"gradient_sigma":0.2}})"), "render.gradient_sigma"));
  CHECK(contains(refusal(R"({"render":{"gradient_sigma":9}})"), "render.gradient_sigma"));
  CHECK(contains(refusal(R"({"render":{"shading":"tone","mode":"xray"}})"), "render.shading"));
  CHECK(contains(refusal(R"({"render":{"shading":"phong","classification":"pre"}})"), "render.shading"));
  CHECK(contains(refusal(R"({"render":{"shading":"tone","pipeline":"fixed-function"}})"), "render.shading"));
  CHECK(contains(refusal(R"({"light":{"power":0}})"), "light.power"));
  CHECK(contains(refusal(R"({"light":{"cool":[0,0,2]}})"), "light.cool"));
}

TEST_CASE("the first warp decides where gradients are taken unless a key does") {
  const auto space = [](const std::string& keys) { return gradient_space_of(scene_from_json(keys, "s")); };
  CHECK(space("{}") == GradientSpace::data);
  CHECK(space(R"({"render":{"gradient_space":"object"}})") == GradientSpace::data); // the same without a warp
  for (const std::string kind : {"lamar", "bifocal", "fisheye", "volume-lens", "connected-lens"}) {
    const std::string warp = R"("warp":{"kind":")" + kind + R"("})";
    CHECK(space("{" + warp + "}") == GradientSpace::data);
    CHECK(space(R"({"render":{"gradient_space":"object"},)" + warp + "}") == GradientSpace::object);
    CHECK(space(R"({"render":{"gradient":"precomputed"},)" + warp + "}") == GradientSpace::data);
  }
}

TEST_CASE("changes by --set reach every key and one alternative removes the other") {
  const std::vector<KeyValue> changes = {
      parse_assignment("render.spacing=0.5"), parse_assignment("volume.file=x.nrrd"),
      parse_assignment("render.mode=mip"), parse_assignment("render.size=[8,9]")};
  const Scene scene = scene_from_json(R"({"volume":{"phantom":"ball"}})", "s", changes);
  CHECK(scene.render.spacing == 0.5);
  CHECK(scene.volume.file == "x.nrrd");
  CHECK_FALSE(scene.volume.phantom.has_value());
  CHECK(scene.render.size[1] == 9);
  const Scene file = scene_from_json(R"({"volume":{"phantom":"ball","size":[9,8,7]}})", "s",
                                     {parse_assignment("volume.file=x")});
  CHECK_FALSE(file.volume.size.has_value()); // that was the phantom's
  CHECK(scene_from_json(R"({"volume":{"file":"a.raw","size":[9,8,7]}})", "s",
                        {parse_assignment("volume.file=b.raw")})
            .volume.size.has_value());
  CHECK(scene_from_json(R"({"volume":{"file":"a"}})", "s", {parse_assignment("volume.phantom=ball")})
            .volume.phantom == "ball");
  CHECK(scene_from_json("{}", "s", {parse_assignment("volume.file=a")}).volume.file ==
        "a"); // a section not yet there
  CHECK(contains(refusal("{}", {parse_assignment("render.spacng=1")}), "did you mean render.spacing?"));
  CHECK(contains(refusal("{}", {parse_assignment("title.x.y=1"), parse_assignment("title.x=1")}), "title"));
  CHECK_THROWS_AS(parse_assignment("spacing"), UsageError);
  const Scene clipped =
      scene_from_json(R"({"clip":[{"normal":[1,0,0]}]})", "s", {parse_assignment("clip[0].point=[0,0,0]")});
  CHECK(clipped.clip[0].point == glm::dvec3(0));
  CHECK(contains(refusal("{}", {parse_assignment("clip[3].point=[0,0,0]")}), "clip"));
}

TEST_CASE("bytes that are no UTF-8 and numbers beyond doubles are refused or kept as text, never worse") {
  CHECK(contains(refusal("{}", {{"render.spacing", "0\xdf.6"}}), "render.spacing"));
  CHECK(contains(refusal("{\"render\":{\"spacing\":1e999}}"), "beyond the range"));
  CHECK(contains(refusal("{}", {{"render.spacing", "1e999"}}), "render.spacing"));
  // A file's name need not be UTF-8; the scene's text has U+FFFD in its place.
  const Scene scene = scene_from_json("{}", "s.json", {{"volume.file", "a\xff.nrrd"}});
  CHECK(*scene.volume.file == "a\xff.nrrd");
  CHECK(contains(scene_to_json(scene), "\\ufffd"));
}

TEST_CASE("every key has a help text") {
  const auto keys = list_scene_keys();
  CHECK(keys.size() > 40);
  for (const auto& [key, help] : keys)
    CHECK_FALSE(help.empty());
}

TEST_CASE("a warp is one object or a list, and chooses its paper's pipeline") {
  const Scene one =
      scene_from_json(R"({"warp":{"kind":"lamar","zoom":3,"radial_segments":"adaptive"}})", "s");
  REQUIRE(one.warp.size() == 1);
  const auto& lens = std::get<LamarLens>(one.warp[0]);
  CHECK(lens.zoom == 3);
  CHECK_FALSE(lens.radial_segments.has_value());
  CHECK(one.render.pipeline == Pipeline::tessellated);
  CHECK(scene_from_json(R"({"render":{"pipeline":"rays"},"warp":{"kind":"lamar"}})", "s").render.pipeline ==
        Pipeline::rays);
  CHECK(scene_from_json("{}", "s").render.pipeline == Pipeline::slices);
  const Scene two = scene_from_json(R"({"warp":[{"kind":"lamar"},{"kind":"lamar","zoom":2}]})", "s",
                                    {parse_assignment("warp[1].zoom=5")});
  CHECK(std::get<LamarLens>(two.warp.at(1)).zoom == 5);
  for (const Scene& scene : {one, two}) {
    const std::string text = scene_to_json(scene);
    CHECK(scene_to_json(scene_from_json(text, "s")) == text);
  }
  CHECK(contains(refusal(R"({"warp":{"zoom":3}})"), "warp.kind"));
  CHECK(contains(refusal(R"({"warp":{"kind":"lamr"}})"), "lamar"));
  CHECK(contains(refusal(R"({"warp":{"kind":"lamar","zom":3}})"), "did you mean warp.zoom?"));
  CHECK(contains(refusal(R"({"warp":{"kind":"lamar","radial_segments":"many"}})"), "adaptive"));
}

TEST_CASE("window and level stretch every kind of transfer function, also of one of several volumes") {
  const Scene scene = scene_from_json(
      R"({"volumes":[{"phantom":"ball","size":[8,8,8],"transfer":{"preset":"grey-ramp","window":10,"level":100}},
                     {"phantom":"ball","size":[8,8,8],"transfer":{"points":[[0,0,0,0,0],[4,1,1,1,1]],"level":-6}},
                     {"phantom":"ball","size":[8,8,8],"transfer":{"window":2}}]})",
      "s");
  const LoadedVolume preset = load_volume_of(scene, 0, {}, {});
  CHECK(preset.transfer.points.front().value == 95);
  CHECK(preset.transfer.points.back().value == 105);
  const LoadedVolume points = load_volume_of(scene, 1, {}, {});
  CHECK(points.transfer.points.front().value == -8);
  CHECK(points.transfer.points.back().value == -4);
  Scene plain = scene;
  plain.others[1].transfer.window.reset();
  const LoadedVolume own = load_volume_of(plain, 2, {}, {});
  const LoadedVolume narrow = load_volume_of(scene, 2, {}, {});
  const auto middle = [](const LoadedVolume& loaded) {
    return (loaded.transfer.points.front().value + loaded.transfer.points.back().value) / 2;
  };
  CHECK(narrow.transfer.points.back().value - narrow.transfer.points.front().value == Approx(2));
  CHECK(middle(narrow) == Approx(middle(own)));
  CHECK_THROWS_AS(scene_from_json(R"({"transfer":{"window":0}})", "s"), UsageError);
  CHECK_THROWS_AS(scene_from_json(R"({"transfer":{"window":-5}})", "s"), UsageError);
}

TEST_CASE("window and level stretch the automatic function of a volume") {
  Scene scene = scene_from_json(R"({"volume":{"file":"x.nrrd"},"transfer":{"window":50,"level":7}})", "s");
  const Volume volume = make_phantom("head", {16, 16, 16}, {});
  const TransferFunction transfer = transfer_of(scene, volume);
  CHECK(transfer.name == "automatic");
  CHECK(transfer.points.front().value == -18);
  CHECK(transfer.points.back().value == 32);
}
