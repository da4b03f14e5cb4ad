// Right calls: what each command prints and writes.

#include "catch.h"
#include "program.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace {

using Words = std::vector<std::string>;
using Json = nlohmann::json;
using Catch::Matchers::Contains;

/// Runs a call that must succeed without a word on stderr.
Outcome done(const Workplace& place, const Words& call) {
  Outcome outcome = place.run(call);
  CAPTURE(call, outcome.err);
  REQUIRE(outcome.status == 0);
  CHECK(outcome.err.empty());
  return outcome;
}

/// Width and height from a PNG's first chunk (PNG specification 11.2.2).
std::pair<unsigned, unsigned> png_size(const std::string& png) {
  const auto number = [&](std::size_t at) {
    unsigned value = 0;
    for (std::size_t i = 0; i < 4; ++i)
      value = value << 8 | static_cast<unsigned char>(png.at(at + i));
    return value;
  };
  REQUIRE(png.compare(0, 8, "\x89PNG\r\n\x1a\n") == 0);
  return {number(16), number(20)};
}

} // namespace

TEST_CASE("help of the program and of each command mentions every option") {
  const Workplace place;
  CHECK_THAT(done(place, {"--help"}).out, Contains("render") && Contains("compare") && Contains("info") &&
                                              Contains("phantom") && Contains("list") &&
                                              Contains("gallery") && Contains("plot") &&
                                              Contains("--version") && Contains("Exit status"));
  const std::vector<std::pair<std::string, Words>> options = {
      {"render", {"input", "--output", "--set", "--depth", "--print-scene", "--verbose"}},
      {"compare", {"--output", "--set", "--set-a", "--set-b", "--factor", "--verbose", "psnr_covered"}},
      {"info", {"volume", "--set", "--json", "NRRD", "DICOM"}},
      {"phantom", {"name", "--output", "--size"}},
      {"list", {"contexts", "figures", "keys", "phantoms", "pipelines", "presets", "warps"}},
      {"gallery", {"inputs", "--output", "--set"}},
      {"animate", {"input", "--output", "--vary", "--frames", "--loop", "--fps", "--set", "ffmpeg"}},
      {"export", {"input", "--output", "--set", "render_with_vtk"}},
      {"plot", {"SCENE", "--output", "--set", "--size", "gnuplot-nox"}}};
  for (const auto& [command, words] : options) {
    const std::string text = done(place, {command, "--help"}).out;
    CAPTURE(command, text);
    for (const std::string& word : words)
      CHECK_THAT(text, Contains(word));
  }
}

TEST_CASE("the version and the lists") {
  const Workplace place;
  CHECK(done(place, {"--version"}).out == std::string("slicelens ") + SLICELENS_VERSION + "\n");
  CHECK_THAT(done(place, {"list", "contexts"}).out,
             Contains("osmesa") && Contains("egl") && Contains("window"));
  CHECK_THAT(done(place, {"list", "pipelines"}).out,
             Contains("slices") && Contains("tessellated") && Contains("axis") && Contains("fragment") &&
                 Contains("fixed-function") && Contains("rays") && Contains("reference"));
  CHECK_THAT(done(place, {"list", "presets"}).out,
             Contains("CT-Bone") && Contains("MR-Angio") && Contains("fog"));
  CHECK_THAT(done(place, {"list", "keys"}).out, Contains("render.spacing") && Contains("transfer.points"));
  CHECK_FALSE(done(place, {"list", "figures"}).out.empty());
  CHECK_FALSE(done(place, {"list", "warps"}).out.empty());
  const std::string phantoms = done(place, {"list", "phantoms"}).out;
  for (const char* name : {"box", "ball", "blob", "ramp", "slabs", "checkerboard", "brick", "marschner-lobb",
                           "engine", "head", "head-mr", "head-arteries"})
    CHECK_THAT(phantoms, Contains(name));
}

TEST_CASE("phantoms are written in each format and read back as they are") {
  const Workplace place;
  for (const char* name : {"p.nrrd", "p.mha", "p.nhdr", "p.mhd"}) {
    CHECK(done(place, {"phantom", "box", "--size", "4", "5", "6", "-o", name}).out ==
          name + std::string("\n"));
    const Json info = Json::parse(done(place, {"info", name, "--json"}).out);
    CAPTURE(name, info.dump());
    for (const char* key : {"dims", "spacing", "origin", "direction", "type", "range", "mean", "components",
                            "frames", "format"})
      CHECK(info.contains(key));
    CHECK(info["dims"] == Json({4, 5, 6}));
    // The longest edge has the voxel spacing 1; the box spans the same length on every axis: 6/4, 6/5, 6/6.
    CHECK(info["spacing"][0].get<double>() == Approx(1.5));
    CHECK(info["spacing"][1].get<double>() == Approx(1.2));
    CHECK(info["spacing"][2].get<double>() == Approx(1.0));
    CHECK(info["range"] == Json({1.0, 1.0}));
    CHECK(info["mean"] == 1.0);
    CHECK(info["components"] == 1);
    CHECK(info["frames"] == 1);
    CHECK(info["direction"] == Json({{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}));
    CHECK_THAT(done(place, {"info", name}).out, Contains("dims       4 5 6"));
  }
}

TEST_CASE("render --print-scene shows a scene that means the same") {
  const Workplace place;
  put(place / "s.json", small_scene);
  const std::string first =
      done(place, {"render", "s.json", "--print-scene", "--set", "render.spacing=0.5"}).out;
  CHECK(place.entries() == Words{"s.json"}); // it does nothing else
  const Json scene = Json::parse(first);
  CHECK(scene["title"] == "small");
  CHECK(scene["render"]["spacing"] == 0.5);
  CHECK(scene["render"]["pipeline"] == "slices");
  put(place / "full.json", first);
  CHECK(done(place, {"render", "full.json", "--print-scene"}).out == first);
  done(place, {"render", "s.json", "--set", "render.spacing=0.5", "-o", "a.png"});
  done(place, {"render", "full.json", "-o", "b.png"});
  CHECK(contents(place / "a.png") == contents(place / "b.png"));
}

TEST_CASE("a picture is rendered again from its own metadata, byte for byte") {
  const Workplace place;
  put(place / "s.json", small_scene);
  done(place, {"phantom", "blob", "--size", "12", "-o", "blob.nrrd"});
  const std::vector<Words> pictures = {
      {"s.json", "a.png", "b.png"}, {"s.json", "a.exr", "b.exr"}, {"blob.nrrd", "v.png", "w.png"}};
  for (const Words& names : pictures) {
    done(place,
         {"render", names[0], "-o", names[1], "--set", "camera.azimuth=30", "--set", "render.size=[24,20]"});
    done(place, {"render", names[1], "-o", names[2]});
    CHECK(contents(place / names[1]) == contents(place / names[2]));
  }
  CHECK(png_size(contents(place / "b.png")) == std::pair(24u, 20u));
  done(place, {"render", "a.png", "--set", "render.size=[10,8]", "-o", "small.png"});
  CHECK(png_size(contents(place / "small.png")) == std::pair(10u, 8u));
  // An EXR keeps what a PNG rounds; from either the same PNG comes back.
  done(place, {"render", "a.exr", "-o", "c.png"});
  CHECK(contents(place / "a.png") == contents(place / "c.png"));
  // Without -o the picture takes the input's name, in the current folder, but never its place.
  CHECK(done(place, {"render", "s.json"}).out == "s.png\n");
  CHECK(fs::exists(place / "s.png"));
  CHECK(place.run({"render", "s.png"}).status == 2);
}

TEST_CASE("rendering again refuses a volume that has changed, unless it is named") {
  const Workplace place;
  done(place, {"phantom", "blob", "--size", "12", "-o", "v.nrrd"});
  done(place, {"render", "v.nrrd", "-o", "a.png", "--set", "render.size=[24,20]"});
  done(place, {"phantom", "ball", "--size", "12", "-o", "v.nrrd"});
  const Outcome refused = place.run({"render", "a.png", "-o", "b.png"});
  CHECK(refused.status == 1);
  CHECK_THAT(refused.err, Contains("v.nrrd") && Contains("SHA-256") && Contains("--set volume.file"));
  CHECK(std::count(refused.err.begin(), refused.err.end(), '\n') == 1);
  CHECK_FALSE(fs::exists(place / "b.png"));
  done(place, {"render", "a.png", "-o", "b.png", "--set", "volume.file=v.nrrd"});
  CHECK(contents(place / "a.png") != contents(place / "b.png"));
}

TEST_CASE("a picture says which landmarks made it, and rendering again refuses others") {
  const Workplace place;
  put(place / "points.csv", "0,0,0,1,0,0\n");
  // Of that line, by coreutils' sha256sum.
  const std::string hash = "db910dc4b5de3783127fea43eb4f38cf70f994ea18a8da784ca1c346e8c501be";
  put(place / "s.json", R"({"volume": {"phantom": "blob", "size": [12, 12, 12]}, "render": {"size": [24, 20]},
      "warp": [{"kind": "shift", "offset": [0.1, 0, 0]}, {"kind": "landmarks", "method": "bspline", "file": "points.csv"}]})");
  done(place, {"render", "s.json", "-o", "a.png"});
  CHECK(contents(place / "a.png").find("slicelens:warp1_sha256") != std::string::npos);
  CHECK(contents(place / "a.png").find(hash) != std::string::npos);
  CHECK(contents(place / "a.png").find("slicelens:warp0_sha256") == std::string::npos);
  done(place, {"render", "a.png", "-o", "b.png"});
  put(place / "points.csv", "0,0,0,2,0,0\n");
  const Outcome refused = place.run({"render", "a.png", "-o", "c.png"});
  CHECK(refused.status == 1);
  CHECK_THAT(refused.err, Contains("a.png") && Contains("landmarks") && Contains("SHA-256"));
  CHECK(std::count(refused.err.begin(), refused.err.end(), '\n') == 1);
  CHECK_FALSE(fs::exists(place / "c.png"));
  done(place, {"render", "a.png", "-o", "c.png", "--set", "warp[1].file=points.csv"});
  CHECK(fs::exists(place / "c.png"));
}

TEST_CASE("a scene's paths count from its own folder") {
  const Workplace place;
  fs::create_directories(place / "scenes");
  done(place, {"phantom", "blob", "--size", "12", "-o", "scenes/v.nrrd"});
  put(place / "scenes/s.json", R"({"volume": {"file": "v.nrrd"}, "render": {"size": [24, 20]}})");
  done(place, {"render", "scenes/s.json", "-o", "a.png"});
  done(place, {"render", "a.png", "--set", "volume.file=scenes/v.nrrd", "-o", "b.png"});
  CHECK(png_size(contents(place / "b.png")) == std::pair(24u, 20u));
}

TEST_CASE("compare prints the metrics' contract and writes the pictures") {
  const Workplace place;
  put(place / "s.json", small_scene);
  const Words keys = {"psnr",     "psnr_covered", "ssim",       "ms_ssim", "flip",  "rmse",
                      "mean_abs", "max_abs",      "over_1_255", "width",   "height"};
  const Json same = Json::parse(done(place, {"compare", "s.json", "s.json"}).out);
  for (const std::string& key : keys)
    CHECK(same.contains(key));
  CHECK(same["psnr"].is_null());
  CHECK(same["rmse"] == 0.0);
  CHECK(same["max_abs"] == 0.0);
  CHECK(same["over_1_255"] == 0.0);
  CHECK(same["ssim"].get<double>() == Approx(1));
  CHECK(same["ms_ssim"].is_null()); // five scales do not fit in 24 pixels
  CHECK(same["flip"] == 0.0);
  CHECK(same["width"] == 24);
  CHECK(same["height"] == 20);

  // A scene without opacity shows its background: 0.5 grey against black differs by 0.5 everywhere.
  const Outcome outcome =
      place.run({"compare", "s.json", "--set", "transfer.points=[[0,1,1,1,0],[1,1,1,1,0]]", "--set-a",
                 "render.background=[0,0,0,1]", "--set-b", "render.background=[0.5,0.5,0.5,1]", "-o", "d"});
  REQUIRE(outcome.status == 0);
  const Json metrics = Json::parse(outcome.out);
  CHECK(metrics["rmse"].get<double>() == Approx(0.5).margin(1e-3));
  CHECK(metrics["max_abs"].get<double>() == Approx(0.5).margin(1e-3));
  CHECK(metrics["psnr"].get<double>() == Approx(6.0206).margin(0.02)); // 20·log10(1/0.5)
  CHECK(metrics["over_1_255"] == 1.0);
  for (const char* name : {"a.png", "b.png", "difference_x8.png", "flip.png"})
    CHECK(png_size(contents(place / "d" / name)) == std::pair(24u, 20u));
  CHECK(png_size(contents(place / "d" / "heatmap.png")) == std::pair(24u, 42u)); // with its colour bar
  CHECK_THAT(outcome.err, Contains("times 8"));

  done(place, {"render", "s.json", "-o", "a.png"});
  done(place, {"render", "s.json", "-o", "b.png", "--set", "render.size=[10,8]"});
  const Outcome sizes = place.run({"compare", "a.png", "b.png"});
  CHECK(sizes.status == 2);
  CHECK_THAT(sizes.err, Contains("24") && Contains("10"));
}

TEST_CASE("a gallery of a scene and of volumes holds its pictures") {
  const Workplace place;
  put(place / "s.json", small_scene);
  done(place, {"phantom", "blob", "--size", "12", "-o", "my #1 blob.nrrd"});
  fs::create_directories(place / "other");
  fs::copy_file(place / "s.json", place / "other/s.json");
  const Outcome outcome = place.run({"gallery", "s.json", "my #1 blob.nrrd", "other/s.json", "-o", "new/page",
                                     "--set", "render.size=[24,20]"});
  CAPTURE(outcome.err);
  REQUIRE(outcome.status == 0);
  CHECK(outcome.out == "new/page/index.html\n");
  const std::string page = contents(place / "new/page/index.html");
  int pictures = 0;
  for (const auto& entry : fs::directory_iterator(place / "new/page")) {
    const std::string name = entry.path().filename().string();
    CAPTURE(name);
    CHECK(name.find_first_of(" #?%") == std::string::npos); // would need escapes in a page's links
    if (entry.path().extension() != ".png")
      continue;
    ++pictures;
    CHECK_THAT(page, Contains("src=\"" + name + "\""));
  }
  CHECK(pictures ==
        3 * (1 + 5 + 1)); // slices, rays and their difference: two scenes, five views of the volume
}

TEST_CASE("a gallery compares tables with the exact maps and with rays") {
  const Workplace place;
  put(place / "lens.json", R"({"volume":{"phantom":"blob","size":[16,16,16]},"render":{"size":[24,20]},
                               "warp":{"kind":"volume-lens"}})");
  put(place / "effect.json",
      R"({"volume":{"phantom":"blob","size":[16,16,16]},"render":{"size":[24,20],"pipeline":"rays"},
      "attenuation":{"function":"distance","focus":[[0.4,0.6],[0.4,0.6],[0.4,0.6]]}})");
  REQUIRE(place.run({"gallery", "lens.json", "effect.json", "-o", "page"}).status == 0);
  const std::string page = contents(place / "page/index.html");
  CHECK_THAT(page, Contains("axis against fragment") && Contains("axis against rays"));
  for (const char* scene : {"lens", "effect"}) {
    for (const char* picture : {"slices", "fragment", "difference", "rays"})
      CHECK(fs::exists(place / ("page/" + std::string(scene) + "_" + picture + ".png")));
  }
}

TEST_CASE("render --verbose says where the time went, on stderr") {
  const Workplace place;
  put(place / "s.json", small_scene);
  const Outcome outcome = place.run({"render", "s.json", "-o", "a.png", "--verbose"});
  REQUIRE(outcome.status == 0);
  CHECK(outcome.out == "a.png\n");
  CHECK_THAT(outcome.err, Contains("load") && Contains("upload") && Contains("draw") && Contains("write"));
}

TEST_CASE("fixed function and shaders are compared in one call") {
  // Their contexts have different profiles, so each side opens its own.
  const Workplace place;
  put(place / "s.json", small_scene);
  const Outcome outcome =
      done(place, {"compare", "s.json", "--set-a", "render.pipeline=fixed-function", "--set-b",
                   "render.classification=pre", "--set-b", "render.target=rgba8"});
  CHECK(Json::parse(outcome.out)["max_abs"].get<double>() <= 2.0 / 255 + 1e-6);
  CHECK(done(place, {"render", "s.json", "--set", "render.pipeline=fixed-function", "-o", "f.png"}).out ==
        "f.png\n");
  CHECK(done(place, {"render", "f.png", "-o", "again.png"}).out == "again.png\n");
  CHECK(contents(place / "again.png").size() > 100);
}

TEST_CASE("plot draws the tables of a scene, and says so where gnuplot is missing") {
  const Workplace place;
  put(place / "s.json", small_scene);
  const Words call = {
      "plot", "s.json", "--set", "warp.kind=bifocal", "--set", "attenuation.function=distance"};
  const auto plot = [&](const Words& more) {
    Words words = call;
    words.insert(words.end(), more.begin(), more.end());
    return place.run(words);
  };
  const char* const old = std::getenv("PATH");
  const std::string path = old != nullptr ? old : "/usr/bin:/bin";
  ::setenv("PATH", place.folder().c_str(), 1);
  const Outcome missing = plot({"-o", "t.svg"});
  ::setenv("PATH", path.c_str(), 1);
  CHECK(missing.status == 1);
  CHECK_THAT(missing.err, Contains("gnuplot") && Contains("apt-get install gnuplot-nox"));
  CHECK(std::count(missing.err.begin(), missing.err.end(), '\n') == 1);
  CHECK(place.entries() == Words{"s.json"});

  const Outcome outcome = plot({"-o", "t.svg"});
  if (outcome.status == 1 && outcome.err == missing.err)
    SLICELENS_SKIP("gnuplot is not installed");
  CAPTURE(outcome.err);
  REQUIRE(outcome.status == 0);
  CHECK(outcome.out == "t.svg\n");
  const std::string svg = contents(place / "t.svg");
  CHECK_THAT(svg, Contains(">small<") && Contains(">x'_min<") && Contains(">z + offset<") &&
                      Contains(">attenuation (B)<") && Contains(">identity<"));
  REQUIRE(plot({"-o", "t.png", "--size", "640,700"}).status == 0);
  CHECK(png_size(contents(place / "t.png")) == std::pair(640u, 700u));
  CHECK_THAT(plot({"-o", "t.png", "--size", "300,300"}).err, Contains("too small for its panels"));
  CHECK(place.entries() == Words{"s.json", "t.png", "t.svg"});
}

TEST_CASE("warp writes the deformed volume, and refuses what it cannot write") {
  const Workplace place;
  put(place / "s.json",
      R"({"volume":{"phantom":"blob","size":[12,12,12]},"warp":{"kind":"fisheye","distortion":1}})");
  const Outcome done = place.run({"warp", "s.json", "-o", "out.nrrd", "--size", "6,7,8", "--float"});
  CHECK(done.status == 0);
  CHECK(done.out == "out.nrrd\n");
  const Outcome info = place.run({"info", "out.nrrd"});
  CHECK(info.out.find("6 7 8") != std::string::npos);
  CHECK(info.out.find("float32") != std::string::npos);
  const Outcome name = place.run({"warp", "s.json", "-o", "out.png"});
  CHECK(name.status == 2);
  CHECK(std::count(name.err.begin(), name.err.end(), '\n') == 1);
  CHECK(place.run({"warp", "s.json", "-o", "none/out.nrrd"}).status == 1);
  put(place / "f.json",
      R"({"volume":{"phantom":"blob","size":[12,12,12]},"warp":{"kind":"field","file":"none.nrrd"}})");
  const Outcome missing = place.run({"render", "f.json", "-o", "p.png"});
  CHECK(missing.status == 1);
  CHECK(std::count(missing.err.begin(), missing.err.end(), '\n') == 1);
  CHECK(place.entries() == std::vector<std::string>{"f.json", "out.nrrd", "s.json"});
}
