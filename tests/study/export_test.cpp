// What another renderer is told of a scene: numbers that can be worked out by hand.
#include "catch.h"
#include "core/errors.h"
#include "refusal.h"
#include "render/prepare.h"
#include "scene/load.h"
#include "scene/scene_json.h"
#include "study/export.h"
#include "temporary_folder.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <sstream>

using namespace slicelens;
namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace {

std::string bytes_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

/// 2 × 3 × 4 voxels of 1.5 × 2 × 0.5, turned: i runs along +y, j along −x, k along +z.
Volume small_volume() {
  Volume volume;
  volume.dims = {2, 3, 4};
  volume.spacing = {1.5, 2, 0.5};
  volume.origin = {10, 20, 30};
  volume.direction = glm::dmat3(glm::dvec3(0, 1, 0), glm::dvec3(-1, 0, 0), glm::dvec3(0, 0, 1));
  volume.type = ScalarType::i16;
  std::vector<std::int16_t> values(24);
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = static_cast<std::int16_t>(100 * static_cast<int>(i) - 300);
  volume.voxels.resize(48);
  std::memcpy(volume.voxels.data(), values.data(), 48);
  update_statistics(volume);
  return volume;
}

TransferFunction step_transfer() {
  return {{{-300, 0, 0, 0, 0}, {50, 1, 0.5, 0, 0}, {50, 1, 1, 1, 0.25}}, {}, ""};
}

PreparedScene small_scene(const std::string& text) {
  return prepare(scene_from_json(text, "test"), small_volume(), step_transfer());
}

Json exported(const PreparedScene& prepared, const TemporaryFolder& folder) {
  write_export(prepared, folder / "out");
  return Json::parse(bytes_of(folder / "out/scene.json"));
}

} // namespace

TEST_CASE("an exported scene holds every number that its picture depends on") {
  const TemporaryFolder folder;
  const Json scene =
      exported(small_scene(R"({"render": {"size": [40, 30], "spacing": 2, "mode": "mip", "shading": "none"},
                      "camera": {"zoom": 2}, "light": {"direction": [0, -3, 4], "ambient": 0.125}})"),
               folder);
  CHECK(scene["format"] == "slicelens-export");
  const Json& volume = scene["volume"];
  CHECK(volume["dims"] == Json({2, 3, 4}));
  CHECK(volume["spacing"] == Json({1.5, 2.0, 0.5}));
  CHECK(volume["origin"] == Json({10.0, 20.0, 30.0}));
  CHECK(volume["direction"] == Json::parse("[[0.0,1.0,0.0],[-1.0,0.0,0.0],[0.0,0.0,1.0]]"));
  CHECK(volume["type"] == "int16");
  CHECK(volume["range"] == Json({-300.0, 2000.0}));
  // Little endian: −300 is 0xFED4, the second value −200 is 0xFF38.
  REQUIRE(volume["endian"] == "little");
  const std::string voxels = bytes_of(folder / ("out/" + volume["file"].get<std::string>()));
  REQUIRE(voxels.size() == 48);
  CHECK(voxels.substr(0, 4) == "\xD4\xFE\x38\xFF");
  // Δ₀ is the smallest spacing; Δ is twice that.
  CHECK(scene["transfer"]["unit_distance"] == 0.5);
  CHECK(scene["transfer"]["nodes"] == Json::parse("[[-300.0,0.0,0.0,0.0,0.0],[50.0,1.0,0.5,0.0,0.0],"
                                                  "[50.0,1.0,1.0,1.0,0.25]]"));
  CHECK(scene["render"]["spacing"] == 1.0);
  CHECK(scene["render"]["size"] == Json({40, 30}));
  CHECK(scene["render"]["mode"] == "mip");
  CHECK(scene["render"]["background"] == Json({0.0, 0.0, 0.0, 1.0}));
  CHECK(scene["render"]["isovalue"] == 850.0); // the middle of −300 to 2000
  CHECK(scene["light"]["ambient"] == 0.125);
  CHECK(scene["light"]["direction"][1].get<double>() == Approx(-0.6));
  CHECK(scene["light"]["direction"][2].get<double>() == Approx(0.8));
}

TEST_CASE("an exported camera is the default one, worked out") {
  const TemporaryFolder folder;
  const Json camera = exported(small_scene(R"({"camera": {"zoom": 2}})"), folder)["camera"];
  // The box is 2·1.5 = 3 along y, 3·2 = 6 along −x, 4·0.5 = 2 along z; its diagonal is 7. Voxel (0,0,0)'s
  // centre is at (10, 20, 30), the box's at (10 − 2, 20 + 0.75, 30 + 0.75).
  CHECK(camera["projection"] == "orthographic");
  CHECK(camera["focal_point"][0].get<double>() == Approx(8));
  CHECK(camera["focal_point"][1].get<double>() == Approx(20.75));
  CHECK(camera["focal_point"][2].get<double>() == Approx(30.75));
  CHECK(camera["parallel_scale"].get<double>() == Approx(3.5 / 2)); // half the diagonal by the zoom
  CHECK(camera["view_up"][2].get<double>() == Approx(1));
  CHECK(camera["position"][0].get<double>() == Approx(8)); // looks along +y
  CHECK(camera["position"][1].get<double>() < 20.75 - 3.5);
  const PreparedScene close = small_scene(R"({"camera": {"projection": "perspective", "view_angle": 60}})");
  const Json perspective = Json::parse(exported_camera(close));
  CHECK(perspective["projection"] == "perspective");
  CHECK(perspective["view_angle"].get<double>() == Approx(60));
  CHECK(perspective["position"][1].get<double>() == Approx(20.75 - 3.5 / std::sin(M_PI / 6)));
}

TEST_CASE("what only Slicelens draws is not exported, and the refusal names its key") {
  const auto words = [](const std::string& text) {
    return refusal([&] { require_exportable(scene_from_json(text, "test")); });
  };
  using Catch::Matchers::StartsWith;
  CHECK(words("{}").empty());
  CHECK_THAT(words(R"({"warp": {"kind": "lamar"}})"), StartsWith("warp: "));
  CHECK_THAT(words(R"({"volumes": [{"phantom": "ball"}, {"phantom": "head"}]})"), StartsWith("volumes: "));
  CHECK_THAT(words(R"({"clip": [{"point": [0.5, 0.5, 0.5]}]})"), StartsWith("clip: "));
  CHECK_THAT(words(R"({"crop": {"low": [0.1, 0, 0]}})"), StartsWith("crop: "));
  CHECK_THAT(words(R"({"highlight": {"function": "distance", "focus": [[0.4,0.6],[0.4,0.6],[0.4,0.6]]}})"),
             StartsWith("highlight: "));
  CHECK_THAT(words(R"({"planes": [{}]})"), StartsWith("planes: "));
  CHECK_THAT(words(R"({"overlay": {"legend": true}})"), StartsWith("overlay: "));
  CHECK_THAT(words(R"({"volume": {"phantom": "organs", "labels": "organs-labels"}})"),
             StartsWith("volume.labels: "));
  CHECK_THAT(words(R"({"render": {"modulate_by_gradient": 10}})"),
             StartsWith("render.modulate_by_gradient: "));
  CHECK_THAT(words(R"({"render": {"jitter": 1}})"), StartsWith("render.jitter: "));
  CHECK_THAT(words(R"({"render": {"classification": "preintegrated"}})"),
             StartsWith("render.classification: "));
  CHECK_THAT(words(R"({"render": {"opacity_correction": "none"}})"),
             StartsWith("render.opacity_correction: "));
}

TEST_CASE("an export that cannot be written leaves an old one as it was") {
  const TemporaryFolder folder;
  const PreparedScene prepared = small_scene("{}");
  CHECK_THROWS_AS(write_export(prepared, folder / "none/out"), FileError);
  CHECK_THROWS_AS(write_export(prepared, folder.put("file", "text")), FileError);
  write_export(prepared, folder / "out");
  const std::string voxels = bytes_of(folder / "out/volume.raw");
  fs::remove(folder / "out/scene.json");
  fs::create_directory(folder / "out/scene.json"); // in the way
  PreparedScene other = small_scene("{}");
  other.volume.voxels[0] = std::byte{7};
  CHECK_THROWS_AS(write_export(other, folder / "out"), FileError);
  CHECK(bytes_of(folder / "out/volume.raw") == voxels);
  std::size_t files = 0;
  for ([[maybe_unused]] const auto& entry : fs::directory_iterator(folder / "out"))
    ++files;
  CHECK(files == 2); // and nothing half-written
}
