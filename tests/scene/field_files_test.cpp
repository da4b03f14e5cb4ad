// Displacement fields from files: NRRD, MetaImage and NIfTI, of any pose, and what is refused.
#include "catch.h"
#include "core/errors.h"
#include "scene/load_warps.h"
#include "temporary_folder.h"
#include "volume/write.h"

#include <glm/gtc/matrix_transform.hpp>

#include <cstring>
#include <filesystem>
#include <fstream>

using namespace slicelens;
namespace fs = std::filesystem;

namespace {

/// Vectors d(world) on voxels that are turned and of unequal edges, as 3 floats each.
template <class Displacement>
Volume vector_volume(const Displacement& d, int components = 3) {
  Volume volume;
  volume.dims = {20, 24, 16};
  volume.spacing = {3, 2.5, 4};
  volume.direction = glm::dmat3(glm::rotate(glm::dmat4(1), 0.4, glm::normalize(glm::dvec3(1, 2, 3))));
  volume.origin = volume.direction * glm::dvec3(-10, -10, -8);
  volume.type = ScalarType::f32;
  volume.components = components;
  volume.voxels.resize(voxel_bytes(volume));
  auto* out = reinterpret_cast<float*>(volume.voxels.data());
  for (std::size_t i = 0; i < voxel_count(volume); ++i) {
    const glm::dvec3 index(i % 20, i / 20 % 24, i / 480);
    const glm::dvec3 v = d(volume.origin + volume.direction * (volume.spacing * index));
    for (int c = 0; c < components; ++c)
      *out++ = static_cast<float>(v[c % 3]);
  }
  return volume;
}

/// A box within the vectors' own, turned otherwise.
Box data_box() {
  return make_box({30, 20, 10}, {1, 1.5, 2}, {0, 0, 5},
                  glm::dmat3(glm::rotate(glm::dmat4(1), -0.3, glm::normalize(glm::dvec3(2, 1, 0)))));
}

glm::dvec3 in_box(const BoxSpace& space, const glm::dvec3& world) {
  return glm::dvec3(space.box_from_world * glm::dvec4(world, 1));
}

/// A NIfTI-1 file of 3 floats a voxel with an sform of unit spacing, RAS.
void write_nifti(const fs::path& path, int intent, const glm::vec3& vector) {
  std::vector<char> head(352, 0);
  const auto put = [&](std::size_t at, auto value) { std::memcpy(head.data() + at, &value, sizeof value); };
  put(0, std::int32_t{348});
  const std::int16_t dims[8] = {5, 8, 8, 8, 1, 3, 1, 1};
  std::memcpy(head.data() + 40, dims, sizeof dims);
  put(68, static_cast<std::int16_t>(intent));
  put(70, std::int16_t{16}); // float
  put(72, std::int16_t{32});
  for (std::size_t i = 0; i < 8; ++i)
    put(76 + 4 * i, 1.0F);
  put(108, 352.0F);
  put(112, 1.0F);
  put(254, std::int16_t{1});
  for (std::size_t row = 0; row < 3; ++row)
    put(280 + 16 * row + 4 * row, 1.0F);
  std::memcpy(head.data() + 344, "n+1", 4);
  std::ofstream out(path, std::ios::binary);
  out.write(head.data(), 352);
  for (int c = 0; c < 3; ++c) {
    for (int i = 0; i < 512; ++i)
      out.write(reinterpret_cast<const char*>(&vector[c]), 4);
  }
}

} // namespace

TEST_CASE("a constant field in world units shifts a turned volume of other voxels, from both formats and "
          "both ways") {
  const TemporaryFolder folder;
  const glm::dvec3 shift(2, -1, 3);
  const Volume volume = vector_volume([&](const glm::dvec3&) { return shift; });
  const BoxSpace space = box_space(data_box());
  for (const char* name : {"d.nrrd", "d.mha"}) {
    write_volume(volume, folder.path() / name);
    Field field;
    field.file = name;
    field.loaded = std::make_shared<const DisplacementField>(
        read_field(folder.path() / name, FieldVectors::automatic, {}));
    for (const FieldDirection direction : {FieldDirection::inverse, FieldDirection::forward}) {
      field.direction = direction;
      const GridMap map = field_map(field, space);
      const double sign = direction == FieldDirection::inverse ? 1 : -1;
      for (int i = 0; i < 27; ++i) {
        const glm::dvec3 t = glm::dvec3(0.25) + 0.25 * glm::dvec3(i % 3, i / 3 % 3, i / 9);
        const glm::dvec3 world = world_from_texture(data_box(), t);
        const glm::dvec3 u = texture_from_object(map, in_box(space, world));
        CHECK(glm::length(u - in_box(space, world + sign * shift)) < 1e-6);
      }
    }
  }
}

TEST_CASE("a field is trilinear between its voxels, theirs up to its faces, and nothing beyond") {
  // A linear field: trilinear interpolation is exact between the outer centres.
  const auto linear = [](const glm::dvec3& w) {
    return glm::dvec3(0.1 * w.x + 1, 0.05 * w.z, -0.1 * w.y + 0.02 * w.x);
  };
  const TemporaryFolder folder;
  const Volume volume = vector_volume(linear);
  write_volume(volume, folder.path() / "d.nrrd");
  const DisplacementField field = read_field(folder.path() / "d.nrrd", FieldVectors::lps, {});
  const glm::dmat4 index_from_world = glm::inverse(field.world_from_index);
  const auto world = [&](const glm::dvec3& index) {
    return volume.origin + volume.direction * (volume.spacing * index);
  };
  for (const glm::dvec3& index : {glm::dvec3(0.3, 4.7, 9.1), glm::dvec3(18.99, 22.5, 14.2), glm::dvec3(0)}) {
    CHECK(glm::length(displacement_at(field, index_from_world, world(index)) - linear(world(index))) < 1e-4);
  }
  const glm::dvec3 beyond(-0.49, 5, 5);
  CHECK(glm::length(displacement_at(field, index_from_world, world(beyond)) - linear(world({0, 5, 5}))) <
        1e-4);
  CHECK(displacement_at(field, index_from_world, world({-0.51, 5, 5})) == glm::dvec3(0));
  CHECK(displacement_at(field, index_from_world, world({5, 23.51, 5})) == glm::dvec3(0));
}

TEST_CASE("a forward field is inverted: round trips within a thousandth of the volume") {
  const TemporaryFolder folder;
  const auto waves = [](const glm::dvec3& w) {
    return 1.5 * glm::dvec3(std::sin(w.y / 6), std::cos(w.z / 5), std::sin(w.x / 7 + 1));
  };
  write_volume(vector_volume(waves), folder.path() / "d.nrrd");
  Field field;
  field.file = "d.nrrd";
  field.direction = FieldDirection::forward;
  field.loaded = std::make_shared<const DisplacementField>(
      read_field(folder.path() / "d.nrrd", FieldVectors::automatic, {}));
  const BoxSpace space = box_space(data_box());
  const FieldReport report = field_report(field, space);
  INFO("scattered " << report.scattered_rms << ", refined " << report.refined_rms << ", largest "
                    << report.refined_largest);
  CHECK(report.largest_displacement < 1.5 * std::sqrt(3.0) + 1e-6);
  CHECK(report.largest_displacement > 1.5);
  CHECK(report.scattered_rms < 0.1); // of displacements of 1.5
  CHECK(report.refined_rms < 0.3 * report.scattered_rms);
  CHECK(report.refined_largest < 0.03); // 30 units are the longest edge
  CHECK(report.smallest_determinant > 0.2);
  // Points of the data, well inside, shown where the field says: the file is trilinear between voxels of up
  // to 4, off by at most 4²/8 of second derivatives of 1.5/25 on three axes.
  const GridMap map = field_map(field, space);
  for (int i = 0; i < 27; ++i) {
    const glm::dvec3 x =
        world_from_texture(data_box(), glm::dvec3(0.25) + 0.25 * glm::dvec3(i % 3, i / 3 % 3, i / 9));
    const glm::dvec3 shown = in_box(space, x + waves(x));
    CHECK(space.longest * glm::length(texture_from_object(map, shown) - in_box(space, x)) < 0.25);
  }
}

TEST_CASE("vectors of NIfTI are along RAS for intent 1006, along LPS for 1007, or as the key says") {
  const TemporaryFolder folder;
  const auto first = [&](int intent, FieldVectors vectors) {
    write_nifti(folder.path() / "d.nii", intent, {1, 2, 3});
    const DisplacementField field = read_field(folder.path() / "d.nii", vectors, {});
    REQUIRE(field.vectors.size() == 512);
    CHECK(glm::dvec3(field.world_from_index[0]) == glm::dvec3(-1, 0, 0)); // the geometry is RAS in any case
    return field.vectors[100];
  };
  CHECK(first(1006, FieldVectors::automatic) == glm::vec3(-1, -2, 3));
  CHECK(first(1007, FieldVectors::automatic) == glm::vec3(1, 2, 3));
  CHECK(first(1007, FieldVectors::ras) == glm::vec3(-1, -2, 3));
  CHECK(first(1006, FieldVectors::lps) == glm::vec3(1, 2, 3));
}

TEST_CASE("broken fields are refused: components, NaN, truncation, places") {
  const TemporaryFolder folder;
  const auto still = [](const glm::dvec3&) { return glm::dvec3(0); };
  write_volume(vector_volume(still, 2), folder.path() / "two.nrrd");
  CHECK_THROWS_WITH(read_field(folder.path() / "two.nrrd", FieldVectors::automatic, {}),
                    Catch::Contains("2 component"));
  write_volume(vector_volume(still, 1), folder.path() / "one.mha");
  CHECK_THROWS_WITH(read_field(folder.path() / "one.mha", FieldVectors::automatic, {}),
                    Catch::Contains("has 3"));
  Volume nan = vector_volume(still);
  reinterpret_cast<float*>(nan.voxels.data())[77] = std::numeric_limits<float>::quiet_NaN();
  write_volume(nan, folder.path() / "nan.nrrd");
  CHECK_THROWS_WITH(read_field(folder.path() / "nan.nrrd", FieldVectors::automatic, {}),
                    Catch::Contains("NaN"));
  write_volume(vector_volume(still), folder.path() / "cut.mha");
  fs::resize_file(folder.path() / "cut.mha", fs::file_size(folder.path() / "cut.mha") - 1000);
  CHECK_THROWS_AS(read_field(folder.path() / "cut.mha", FieldVectors::automatic, {}), FileError);
  CHECK_THROWS_AS(read_field(folder.path() / "none.nrrd", FieldVectors::automatic, {}), FileError);
  Volume far = vector_volume(still);
  far.origin += glm::dvec3(1000, 0, 0);
  write_volume(far, folder.path() / "far.nrrd");
  Field field;
  field.file = "far.nrrd";
  field.loaded = std::make_shared<const DisplacementField>(
      read_field(folder.path() / "far.nrrd", FieldVectors::automatic, {}));
  CHECK_THROWS_WITH(field_map(field, box_space(data_box())),
                    Catch::Contains("far.nrrd") && Catch::Contains("beside"));
  CHECK_THROWS_WITH(validate(Field{}), Catch::Contains("file"));
  field.resolution = 4;
  CHECK_THROWS_WITH(validate(field), Catch::Contains("8 to 128"));
}
