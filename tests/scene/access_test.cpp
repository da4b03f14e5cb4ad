// volume.access and volume.cache: where the voxels are, and what is refused.
#include "catch.h"
#include "core/errors.h"
#include "scene/load.h"
#include "scene/scene_json.h"
#include "temporary_folder.h"
#include "volume/pyramid.h"
#include "volume/streamed.h"
#include "volume/write.h"

#include <cstdlib>

using namespace slicelens;
namespace fs = std::filesystem;

namespace {

std::string refusal(const std::string& volume, const std::string& more = "") {
  try {
    scene_from_json(R"({"volume":{)" + volume + "}" + more + "}", "s.json");
  } catch (const UsageError& error) {
    return error.what();
  }
  return "";
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

const std::string stream = R"("file":"a.nrrd","access":"stream")";
const std::string cache = R"("file":"a.nrrd","access":"cache")";

/// 32 × 16 × 8 voxels that count up.
Volume counting(int components = 1, ScalarType type = ScalarType::u8) {
  Volume volume;
  volume.dims = {32, 16, 8};
  volume.type = type;
  volume.components = components;
  volume.voxels.resize(voxel_bytes(volume));
  for (std::size_t i = 0; i < volume.voxels.size(); ++i)
    volume.voxels[i] = static_cast<std::byte>(i * 7);
  update_statistics(volume);
  return volume;
}

struct Files {
  TemporaryFolder folder;
  Files() {
    ::setenv("XDG_CACHE_HOME", (folder / "cache").c_str(), 1);
    write_volume(counting(), folder / "raw.nrrd");
    write_volume(counting(), folder / "packed.nrrd", {true});
    write_volume(counting(3), folder / "rgb.nrrd");
  }
  ~Files() { ::unsetenv("XDG_CACHE_HOME"); }

  Volume load(const std::string& name, VolumeAccess access, const VoxelBudget& budget) const {
    VolumeSettings settings;
    settings.file = name;
    settings.access = access;
    return load_volume(settings, {folder.path()}, {}, budget);
  }
  /// Where the voxels are: "memory", "stream" or "cache".
  std::string where(const std::string& name, VolumeAccess access, const VoxelBudget& budget = {}) const {
    const Volume volume = load(name, access, budget);
    return is_streamed(volume) ? volume.streamed->where.substr(0, volume.streamed->where.find(':'))
                               : "memory";
  }
};

constexpr std::size_t voxels = 32 * 16 * 8;

} // namespace

TEST_CASE("volume.access auto leaves on disk what the textures do not hold") {
  const Files files;
  // Texels of automatic textures are of 16 bits for volumes of 8.
  const VoxelBudget enough{2 * voxels};
  const VoxelBudget less{2 * voxels - 1};
  CHECK(files.where("raw.nrrd", VolumeAccess::automatic) == "memory");
  for (const char* name : {"raw.nrrd", "packed.nrrd"})
    CHECK(files.where(name, VolumeAccess::automatic, enough) == "memory");
  CHECK(files.where("raw.nrrd", VolumeAccess::automatic, less) == "stream");
  CHECK(files.where("packed.nrrd", VolumeAccess::automatic, less) == "cache");
  CHECK(files.where("raw.nrrd", VolumeAccess::automatic, {less.bytes, VolumeTexture::r8}) == "memory");
  CHECK(files.where("raw.nrrd", VolumeAccess::automatic, {3 * voxels, VolumeTexture::r32f}) == "stream");
  // Coarser levels are made with a copy only.
  const Volume levels =
      files.load("raw.nrrd", VolumeAccess::automatic, {less.bytes, VolumeTexture::automatic, 3});
  REQUIRE(is_streamed(levels));
  CHECK(levels.streamed->coarser.size() == 2);
  // Colours stay together in memory.
  CHECK(files.where("rgb.nrrd", VolumeAccess::automatic, {1}) == "memory");
  CHECK(files.where("rgb.nrrd", VolumeAccess::cache, {1}) == "memory");
  // What is asked for is done.
  CHECK(files.where("raw.nrrd", VolumeAccess::memory, {1}) == "memory");
  CHECK(files.where("raw.nrrd", VolumeAccess::stream) == "stream");
  CHECK(files.where("raw.nrrd", VolumeAccess::cache) == "cache");
  CHECK_THROWS_AS(files.where("packed.nrrd", VolumeAccess::stream), UsageError);
  CHECK_THROWS_AS(files.where("rgb.nrrd", VolumeAccess::stream), UsageError);
  for (const char* name : {"raw.nrrd", "packed.nrrd"}) {
    const Volume volume = files.load(name, VolumeAccess::automatic, less);
    CHECK(crop(volume, {0, 0, 0}, volume.dims).voxels == counting().voxels);
  }
}

TEST_CASE("a stack of pictures beyond the budget is copied once and found again") {
  const Files files;
  fs::create_directories(files.folder / "stack");
  for (int k = 0; k < 4; ++k) { // 8-bit grey pictures of 2 × 2, by libpng's smallest encoder: a TIFF by hand
    std::string tiff("II*\0\x08\0\0\0", 8);
    const auto entry = [&](int tag, int type, int count, int value) {
      for (const int part : {tag, type})
        tiff += {static_cast<char>(part), static_cast<char>(part >> 8)};
      for (const int part : {count, value})
        tiff += {static_cast<char>(part), static_cast<char>(part >> 8), 0, 0};
    };
    tiff += {8, 0};
    entry(256, 4, 1, 2); // width, height
    entry(257, 4, 1, 2);
    entry(258, 3, 1, 8); // bits
    entry(259, 3, 1, 1); // not compressed
    entry(262, 3, 1, 1); // black is 0
    entry(273, 4, 1, 110);
    entry(278, 4, 1, 2); // rows in the strip, and its bytes
    entry(279, 4, 1, 4);
    tiff += std::string(4, '\0');
    tiff += {static_cast<char>(k), static_cast<char>(k + 1), static_cast<char>(k + 2), 9};
    files.folder.put("stack/" + std::to_string(k) + ".tif", tiff);
  }
  const Volume loaded = files.load("stack", VolumeAccess::memory, {});
  REQUIRE(loaded.dims == std::array<std::size_t, 3>{2, 2, 4});
  CHECK(files.where("stack", VolumeAccess::automatic, {32}) == "memory");
  for (int time = 0; time < 2; ++time) {
    CHECK(files.where("stack", VolumeAccess::automatic, {31}) == "cache");
    const Volume copy = files.load("stack", VolumeAccess::automatic, {31});
    CHECK(crop(copy, {0, 0, 0}, copy.dims).voxels == loaded.voxels);
  }
}

TEST_CASE("the budget is render.memory, but for scenes that need all voxels") {
  const auto budget = [](const std::string& render) {
    return budget_of(scene_from_json(R"({"render":{)" + render + "}}", "s.json"));
  };
  CHECK(budget("").bytes == std::uintmax_t{1} << 30);
  CHECK(budget(R"("memory":3)").bytes == 3 << 20);
  CHECK(budget(R"("levels":3)").levels == 3);
  CHECK(budget(R"("volume_texture":"r8")").texture == VolumeTexture::r8);
  const std::uintmax_t unlimited = VoxelBudget().bytes;
  for (const char* render : {R"("pipeline":"reference")", R"("shading":"phong","gradient":"precomputed")"}) {
    CAPTURE(render);
    CHECK(budget(render).bytes == unlimited);
  }
  CHECK(budget(R"("shading":"phong")").bytes < unlimited);
}

TEST_CASE("what volumes on disk cannot do is refused by name") {
  CHECK(refusal(stream).empty());
  CHECK(refusal(cache + R"(,"cache":"a.bricks")").empty());
  CHECK(refusal(R"("file":"a.nrrd","cache":"a.bricks")").empty());
  CHECK(contains(refusal(stream, R"(,"render":{"pipeline":"reference"})"),
                 "render.pipeline 'reference' needs all voxels at once"));
  CHECK(refusal(cache, R"(,"render":{"classification":"pre"})").empty());
  CHECK(contains(refusal(cache, R"(,"render":{"shading":"phong","gradient":"prefiltered"})"),
                 "render.gradient 'prefiltered'"));
  CHECK(contains(refusal(stream, R"(,"render":{"levels":2})"), "set volume.access to cache or memory"));
  CHECK(
      contains(refusal(stream, R"(,"render":{"footprint":"mip"})"), "render.footprint 'mip' needs coarser"));
  CHECK(contains(refusal(R"("phantom":"head","access":"stream")"), "a phantom has none"));
  CHECK(contains(refusal(R"("phantom":"head","access":"cache")"), "a phantom has none"));
  CHECK(contains(refusal(R"("phantom":"head","cache":"a.bricks")"), "a phantom has none"));
  CHECK(contains(refusal(stream + R"(,"cache":"a.bricks")"), "set volume.access to cache or auto"));
  CHECK(contains(refusal(cache + R"(,"cache":"")"), "volume.cache is empty"));
}
