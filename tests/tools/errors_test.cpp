// Wrong calls: one line on stderr that names what is wrong, the contract's exit status, and no harm done.

#include "catch.h"
#include "program.h"

#include <algorithm>

namespace {

using Words = std::vector<std::string>;
using Catch::Matchers::Contains;

/// The call fails with `status`, prints nothing on stdout, and says on one line of stderr all of `named`.
void check_refused(const Workplace& place, const Words& call, int status, const Words& named) {
  const Outcome outcome = place.run(call);
  std::string shown;
  for (const std::string& word : call)
    shown += word + " ";
  CAPTURE(shown, outcome.err);
  CHECK(outcome.status == status);
  CHECK(outcome.out.empty());
  CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
  CHECK(outcome.err.rfind("slicelens: ", 0) == 0);
  CHECK(outcome.err.size() < 600);
  for (const std::string& text : named)
    CHECK_THAT(outcome.err, Contains(text));
}

} // namespace

TEST_CASE("wrong usage ends with 2 and names what would be right") {
  const Workplace place;
  put(place / "s.json", small_scene);
  check_refused(place, {}, 2, {"--help"});
  check_refused(place, {"rendr", "s.json"}, 2, {"'rendr'", "did you mean render"});
  check_refused(place, {"xyzzy"}, 2, {"'xyzzy'", "render", "compare", "info", "phantom", "list", "gallery"});
  check_refused(place, {"render"}, 2, {"input", "slicelens render --help"});
  check_refused(place, {"render", "s.json", "--frobnicate"}, 2, {"--frobnicate"});
  check_refused(place, {"render", "s.json", "-o", "picture.bmp"}, 2, {"picture.bmp", ".png", ".exr"});
  check_refused(place, {"render", "s.json", "-o", "p.png", "--depth", "half"}, 2, {"half", "png"});
  check_refused(place, {"render", "s.json", "-o", "p.png", "--depth", "9"}, 2, {"9"});
  check_refused(place, {"compare", "s.json"}, 2, {"two inputs"});
  check_refused(place, {"compare", "s.json", "s.json", "--factor", "-1"}, 2, {"--factor"});
  check_refused(place, {"phantom", "bal", "-o", "b.nrrd"}, 2, {"'bal'", "ball"});
  check_refused(place, {"phantom", "ball", "-o", "b.stl"}, 2, {"b.stl", ".nrrd", ".mha"});
  check_refused(place, {"phantom", "ball", "-o", "b.nrrd", "--size", "-3"}, 2, {"--size", "-3"});
  check_refused(place, {"phantom", "ball", "-o", "b.nrrd", "--size", "0"}, 2, {"--size", "0"});
  check_refused(place, {"phantom", "ball", "-o", "b.nrrd", "--size", "4", "5"}, 2, {"--size"});
  check_refused(place, {"plot", "s.json"}, 2, {"--output"});
  check_refused(place, {"plot", "s.json", "-o", "p.pdf"}, 2, {"p.pdf", ".svg or .png"});
  check_refused(place, {"plot", "s.json", "-o", "p.svg", "--size", "800"}, 2, {"--size"});
  check_refused(place, {"plot", "s.json", "-o", "p.svg", "--size", "100,800"}, 2, {"--size", "100"});
  check_refused(place, {"plot", "s.json", "-o", "p.svg"}, 2, {"s.json", "no axis maps", "bifocal"});
  check_refused(place, {"plot", "s.json", "-o", "p.svg", "--set", "warp.kind=lamar"}, 2,
                {"s.json", "no axis maps", "'lamar'"});
  check_refused(place, {"list", "colours"}, 2, {"'colours'", "phantoms", "presets"});
  check_refused(place, {"list"}, 2, {"phantoms", "presets"});
  CHECK(place.entries() == Words{"s.json"});
}

TEST_CASE("wrong scenes end with 2 and name file, key and value") {
  const Workplace place;
  put(place / "s.json", small_scene);
  const auto set = [&](const std::string& change) { return Words{"render", "s.json", "--set", change}; };
  check_refused(place, set("render.spcing=1"), 2, {"render.spcing", "render.spacing"});
  check_refused(place, set("rendr.spacing=1"), 2, {"rendr", "render"});
  check_refused(place, set("render.spacing"), 2, {"KEY=VALUE"});
  check_refused(place, set("=1"), 2, {"KEY=VALUE"});
  check_refused(place, set("render.spacing=abc"), 2, {"render.spacing", "abc"});
  check_refused(place, set("render.spacing=-1"), 2, {"render.spacing", "-1"});
  check_refused(place, set("render.spacing=nan"), 2, {"render.spacing"});
  check_refused(place, set("render.mode=mipp"), 2, {"render.mode", "mipp", "mip"});
  check_refused(place, set("render.pipeline=slice"), 2, {"render.pipeline", "slices"});
  check_refused(place,
                {"render", "s.json", "--set", "render.pipeline=fixed-function", "--set", "render.mode=mip"},
                2, {"fixed-function", "render.mode", "dvr"});
  check_refused(place,
                {"render", "s.json", "--set", "render.classification=pre", "--set", "render.shading=diffuse"},
                2, {"render.classification", "render.shading"});
  check_refused(place, set("render.size=[0,5]"), 2, {"render.size"});
  check_refused(place, set("render.size=[5]"), 2, {"render.size"});
  check_refused(place, set("transfer.preset=CT-Bon"), 2, {"CT-Bon"});
  check_refused(place, set("volume.phantom=bal"), 2, {"bal", "ball"});
  check_refused(place, set("camera.view_angle=0"), 2, {"camera.view_angle"});
  put(place / "comma.json", "{\n  \"title\": \"a\",,\n}");
  check_refused(place, {"render", "comma.json"}, 2, {"comma.json", "line 2"});
  put(place / "list.json", "[1, 2]");
  check_refused(place, {"render", "list.json"}, 2, {"list.json"});
  put(place / "empty.json", "");
  check_refused(place, {"render", "empty.json"}, 2, {"empty.json"});
  put(place / "key.json", R"({"camera": {"azimut": 3}})");
  check_refused(place, {"render", "key.json"}, 2, {"key.json", "camera.azimut", "camera.azimuth"});
  CHECK(place.entries() == Words{"comma.json", "empty.json", "key.json", "list.json", "s.json"});
}

TEST_CASE("Cohen's warps and effects: what cannot be drawn ends with 2 and says why") {
  const Workplace place;
  put(place / "s.json", small_scene);
  const auto set = [&](const Words& changes) {
    Words call = {"render", "s.json"};
    for (const std::string& change : changes)
      call.insert(call.end(), {"--set", change});
    return call;
  };
  const auto refused = [&](const Words& changes, const Words& named) {
    check_refused(place, set(changes), 2, named);
  };
  const std::string region = R"([[0.3,0.7],[0.3,0.7],[0.3,0.7]])";
  const auto bifocal = [](const std::string& key, const std::string& x) {
    return R"(warp={"kind":"bifocal",")" + key + R"(":[)" + x + R"(,[0.4,0.6],[0.4,0.6]]})";
  };
  const auto lens = [](const std::string& keys) { return R"(warp={"kind":"volume-lens",)" + keys + "}"; };
  const Words highlight = {"highlight.function=distance", "highlight.focus=" + region};
  const auto with = [](Words changes, const Words& more) {
    changes.insert(changes.end(), more.begin(), more.end());
    return changes;
  };
  const std::string fisheye = R"({"kind":"fisheye"})";
  const std::string box_lens = R"({"kind":"volume-lens"})";

  // Regions.
  refused({bifocal("focus", "[-0.1,0.5]")}, {"bifocal", "focus", "axis x", "-0.1"});
  refused({bifocal("shown", "[0.5,1.2]")}, {"bifocal", "shown", "1.2"});
  refused({bifocal("shown", "[0.5,0.5]")}, {"bifocal", "shown", "empty"});
  refused({bifocal("focus", "[0.6,0.4]")}, {"bifocal", "focus", "reversed"});
  refused({bifocal("focus", "[0,0.4]")}, {"bifocal", "focus", "touch no face"});
  refused({bifocal("focus", "[0.2,1]")}, {"bifocal", "focus", "touch no face"});
  refused({bifocal("focus", "[\"nan\",1]")}, {"focus"});
  refused({"highlight.function=focus", "highlight.focus=[[0.3,0.7],[0.7,0.3],[0.3,0.7]]"},
          {"highlight.focus", "axis y", "reversed"});
  refused({"attenuation.function=distance", "attenuation.focus=[[0.3,0.7],[0.3,0.7],[0,0.7]]"},
          {"attenuation.focus", "axis z", "touch no face"});
  // Lenses.
  refused({R"(warp={"kind":"fisheye","center":[0,0.5,0.5]})"}, {"fisheye", "center"});
  refused({R"(warp={"kind":"fisheye","distortion":-1})"}, {"warp.distortion", "-1"});
  refused({lens(R"("magnification":0)")}, {"magnification", "0"});
  refused({lens(R"("magnification":-2)")}, {"magnification", "-2"});
  refused({lens(R"("magnification":0.5)")}, {"volume-lens", "magnification", "folds", "0.75"});
  refused({lens(R"("inner":0.3,"outer":0.2)")}, {"volume-lens", "inner", "outer"});
  refused({lens(R"("center":[0.1,0.5,0.5])")}, {"volume-lens", "center", "axis x"});
  refused({lens(R"("outer":0.6)")}, {"volume-lens", "outer", "0.6"});
  refused({R"(warp={"kind":"connected-lens","magnification":0.5})"}, {"connected-lens", "folds"});
  // Powers.
  refused(with(highlight, {"highlight.power=-1"}), {"highlight.power", "-1"});
  refused({"attenuation.power=-0.5"}, {"attenuation.power", "-0.5"});
  refused({"attenuation.power=nan"}, {"attenuation.power"});
  // Tables.
  refused({"render.axis_texels=15"}, {"render.axis_texels", "16", "4096", "15"});
  refused({"render.axis_texels=4097"}, {"render.axis_texels", "4097"});
  refused({R"(warp={"kind":"lamar"})", "render.pipeline=axis"},
          {"'axis'", "separable", "'lamar'", "tessellated"});
  refused({"warp=[" + box_lens + "," + fisheye + "]", "render.pipeline=axis"},
          {"'axis'", "mask", "'volume-lens'"});
  refused({"warp=[" + fisheye + R"(,{"kind":"connected-lens"}])", "render.pipeline=axis"},
          {"'axis'", "mask", "'connected-lens'"});
  // Effects without a region, or where they cannot be drawn.
  refused({"highlight.function=distance"}, {"highlight.focus", "region"});
  refused({"attenuation.function=viewpoint"}, {"attenuation.focus", "region"});
  refused({"highlight.function=focus", "warp=" + fisheye}, {"highlight.function", "focal point"});
  refused(with(highlight, {"render.pipeline=slices"}), {"'slices'", "highlight", "axis"});
  refused(with(highlight, {"render.pipeline=fixed-function"}), {"'fixed-function'", "highlight"});
  refused({"attenuation.function=distance", "attenuation.focus=" + region, "render.pipeline=slices"},
          {"'slices'", "attenuation"});
  refused(with(highlight, {"render.classification=pre"}),
          {"render.classification", "pre", "highlight", "post"});
  for (const std::string pipeline : {"slices", "fixed-function"})
    refused({"warp=" + fisheye, "render.pipeline=" + pipeline}, {"'" + pipeline + "'", "'fisheye'", "axis"});
  refused({"warp=" + fisheye, "render.levels=2"}, {"render.levels", "'fisheye'"});
  refused({"warp=" + fisheye, "render.tiles=[2,1,1]"}, {"'axis'", "tiles"});
  refused({R"(warp={"kind":"fishy"})"}, {"fishy", "fisheye"});
  refused({R"(warp={"kind":"fisheye","distorsion":2})"}, {"distorsion", "distortion"});
  CHECK(place.entries() == Words{"s.json"});
}

TEST_CASE("deformations and widgets: what folds or is none ends with 2 and says why") {
  const Workplace place;
  put(place / "s.json", small_scene);
  const auto refused = [&](const std::string& warp, const Words& named) {
    check_refused(place, {"render", "s.json", "--set", "warp=" + warp}, 2, named);
  };
  refused(R"({"kind":"bend","angle":130})", {"'bend'", "angle", "folds", "114.5"});
  refused(R"({"kind":"peeler","radius":0.3})", {"'peeler'", "radius", "folds", "0.5"});
  refused(R"({"kind":"pulse","magnification":0.2})", {"'pulse'", "magnification", "folds", "0.25"});
  refused(R"({"kind":"sine","axis":"x","along":"x"})", {"'sine'", "axis", "along"});
  refused(R"({"kind":"sine","wavelength":0})", {"warp.wavelength", "above 0"});
  refused(R"({"kind":"bend","toward":"-w"})", {"warp.toward", "-w", "-x"});
  refused(R"({"kind":"leafer","leaves":1})", {"'leafer'", "leaves", "2"});
  refused(R"({"kind":"twist","angel":90})", {"angel", "angle"});
}

TEST_CASE("files that are missing or damaged end with 1 and are named") {
  const Workplace place;
  check_refused(place, {"render", "nowhere.json"}, 1, {"nowhere.json"});
  check_refused(place, {"render", "nowhere.nrrd"}, 1, {"nowhere.nrrd"});
  check_refused(place, {"info", "nowhere.nrrd"}, 1, {"nowhere.nrrd"});
  check_refused(place, {"compare", "nowhere.png", "nothing.png"}, 1, {"nowhere.png"});
  check_refused(place, {"gallery", "nowhere.nrrd", "-o", "g"}, 1, {"nowhere.nrrd"});

  REQUIRE(place.run({"phantom", "ball", "-o", "ball.nrrd", "--size", "12"}).status == 0);
  const std::string whole = contents(place / "ball.nrrd");
  put(place / "cut.nrrd", whole.substr(0, whole.size() / 2));
  check_refused(place, {"info", "cut.nrrd"}, 1, {"cut.nrrd"});
  check_refused(place, {"render", "cut.nrrd", "-o", "cut.png"}, 1, {"cut.nrrd"});
  std::string lying = whole;
  const auto sizes = lying.find("sizes: 12 12 12");
  REQUIRE(sizes != std::string::npos);
  lying.replace(sizes, 15, "sizes: 100000 100000 100000");
  put(place / "lying.nrrd", lying);
  check_refused(place, {"info", "lying.nrrd"}, 1, {"lying.nrrd"});
  put(place / "noise.png", "\x89PNG\r\n\x1a\n not a picture");
  check_refused(place, {"render", "noise.png", "-o", "new.png"}, 1, {"noise.png"});
  CHECK_FALSE(fs::exists(place / "cut.png"));
  CHECK_FALSE(fs::exists(place / "new.png"));
}

TEST_CASE("a picture without a scene is refused") {
  const Workplace place;
  put(place / "s.json", small_scene);
  REQUIRE(place.run({"compare", "s.json", "s.json", "-o", "d"}).status == 0);
  check_refused(place, {"render", "d/heatmap.png", "-o", "new.png"}, 2, {"heatmap.png", "scene"});
  check_refused(place, {"compare", "d/a.png", "s.json", "--set", "render.spacing=2"}, 2, {"a.png", "--set"});
}

TEST_CASE("a picture that cannot be written leaves nothing behind and harms no old file") {
  const Workplace place;
  put(place / "s.json", small_scene);
  check_refused(place, {"render", "s.json", "-o", "no/such/p.png"}, 1, {"no/such"});
  fs::create_directories(place / "folder.png");
  check_refused(place, {"render", "s.json", "-o", "folder.png"}, 1, {"folder.png", "folder"});

  put(place / "old.png", "an old picture");
  check_refused(place, {"render", "s.json", "-o", "old.png", "--set", "render.filter=linaer"}, 2, {"linear"});
  check_refused(place, {"render", "gone.nrrd", "-o", "old.png"}, 1, {"gone.nrrd"});
  CHECK(contents(place / "old.png") == "an old picture");

  // Root writes everywhere, so a folder without permission shows nothing there; /proc refuses root as well.
  fs::create_directories(place / "locked");
  put(place / "locked/old.png", "an old picture");
  fs::permissions(place / "locked", fs::perms::owner_read | fs::perms::owner_exec);
  const std::string unwritable = ::geteuid() == 0 ? "/proc/p.png" : "locked/old.png";
  check_refused(place, {"render", "s.json", "-o", unwritable}, 1, {unwritable});
  check_refused(place,
                {"phantom", "box", "--size", "4", "-o", fs::path(unwritable).replace_extension("nrrd")}, 1,
                {fs::path(unwritable).replace_extension("nrrd").string()});
  check_refused(place, {"gallery", "s.json", "-o", "s.json/gallery"}, 1, {"s.json/gallery"});
  fs::permissions(place / "locked", fs::perms::owner_all);
  CHECK(contents(place / "locked/old.png") == "an old picture");
  CHECK(place.entries() == Words{"folder.png", "locked", "old.png", "s.json"});
}

TEST_CASE("output that does not arrive is a failure") {
  const Workplace place;
  put(place / "s.json", small_scene);
  const std::vector<Words> calls = {{"--help"},
                                    {"--version"},
                                    {"list", "keys"},
                                    {"list", "phantoms"},
                                    {"render", "--help"},
                                    {"render", "s.json", "--print-scene"},
                                    {"render", "s.json", "-o", "p.png"}};
  for (const Words& call : calls) {
    CAPTURE(call);
    const Outcome full = place.run(call, "/dev/full");
    CHECK(full.status == 1);
    CHECK(full.err == "slicelens: stdout: cannot be written\n");
    CHECK(place.run(call, "-").status == 1);
  }
  // The pictures of the runs without a stdout are whole: nothing was printed into them.
  REQUIRE(place.run({"render", "s.json", "-o", "q.png"}).status == 0);
  CHECK(contents(place / "p.png") == contents(place / "q.png"));
}
