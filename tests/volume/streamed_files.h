// Helpers for tests of volumes that stay on disk.
#pragma once

#include "volume/on_disk.h"
#include "volume/pyramid.h"
#include "volume/streamed.h"
#include "volume/transfer.h"
#include "volume_files.h"

#include <cstdlib>
#include <random>
#include <string>

namespace slicelens {

/// The user's cache folder for one test case.
class CacheFolder {
public:
  CacheFolder() { ::setenv("XDG_CACHE_HOME", folder_.path().c_str(), 1); }
  ~CacheFolder() { ::unsetenv("XDG_CACHE_HOME"); }
  std::filesystem::path path() const { return folder_ / "slicelens"; }
  /// Those of one kind: ".scan", ".bricks" or ".sha256".
  std::vector<std::filesystem::path> files(const std::string& extension) const {
    std::vector<std::filesystem::path> found;
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(path(), error)) {
      if (entry.path().extension() == extension)
        found.push_back(entry.path());
    }
    return found;
  }

private:
  TemporaryFolder folder_;
};

/// Random values over most of the type's range.
inline Volume random_volume(ScalarType type, const std::array<std::size_t, 3>& dims, int components = 1,
                            unsigned seed = 3) {
  Volume volume;
  volume.dims = dims;
  volume.type = type;
  volume.components = components;
  volume.spacing = {0.5, 1.25, 2};
  volume.origin = {-3, 7, 11};
  volume.voxels.resize(voxel_bytes(volume));
  std::mt19937 random(seed);
  visit_scalar_type(type, [&](auto* tag) {
    using T = std::remove_pointer_t<decltype(tag)>;
    T* const out = reinterpret_cast<T*>(volume.voxels.data());
    const double low = std::is_signed_v<T> ? -100.0 : 0.0;
    std::uniform_real_distribution<double> value(low, 100.0);
    for (std::size_t i = 0; i < volume.voxels.size() / sizeof(T); ++i)
      out[i] = static_cast<T>(value(random));
  });
  update_statistics(volume);
  return volume;
}

/// Voxels bit by bit: NaNs are equal to themselves.
inline void check_boxes(const Volume& streamed, const Volume& loaded) {
  const auto& n = loaded.dims;
  CHECK(crop(streamed, {0, 0, 0}, n).voxels == loaded.voxels);
  std::mt19937 random(11);
  for (int trial = 0; trial < 40; ++trial) {
    std::array<std::size_t, 3> first{};
    std::array<std::size_t, 3> size{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      first[axis] = random() % n[axis];
      // Whole rows and planes as well, which are read in fewer pieces.
      if (trial % 3 == 0 && axis < 2)
        first[axis] = 0;
      size[axis] = trial % 3 == 0 && axis < 2 ? n[axis] : 1 + random() % (n[axis] - first[axis]);
    }
    const Volume part = crop(streamed, first, size);
    const Volume expected = crop(loaded, first, size);
    CHECK(part.voxels == expected.voxels);
    CHECK(part.origin == expected.origin);
  }
}

inline void check_equal(const Volume& streamed, const Volume& loaded) {
  REQUIRE(is_streamed(streamed));
  CHECK(streamed.voxels.empty());
  CHECK(streamed.dims == loaded.dims);
  CHECK(streamed.type == loaded.type);
  CHECK(streamed.components == loaded.components);
  CHECK(streamed.spacing == loaded.spacing);
  CHECK(streamed.origin == loaded.origin);
  CHECK(streamed.direction == loaded.direction);
  CHECK(streamed.frames == loaded.frames);
  CHECK(streamed.format == loaded.format);
  CHECK(streamed.min == loaded.min);
  CHECK(streamed.max == loaded.max);
  CHECK(streamed.non_finite == loaded.non_finite);
  // Both add in double, in another order: at most a rounding for each of fewer than 2^27 voxels.
  const double largest = std::max(std::abs(loaded.min), std::abs(loaded.max));
  CHECK(std::abs(streamed.mean - loaded.mean) <= 1e-12 * largest);
  const CellRanges cells = cell_ranges(loaded, 2);
  CHECK(streamed.streamed->cells.size == cells.size);
  CHECK(streamed.streamed->cells.reach == cells.reach);
  CHECK(streamed.streamed->cells.smallest == cells.smallest);
  CHECK(streamed.streamed->cells.largest == cells.largest);
  CHECK(streamed.streamed->samples == transfer_samples(loaded));
  const TransferFunction own = automatic_transfer(streamed);
  const TransferFunction other = automatic_transfer(loaded);
  REQUIRE(own.points.size() == other.points.size());
  for (std::size_t i = 0; i < own.points.size(); ++i) {
    CHECK(own.points[i].value == other.points[i].value);
    CHECK(own.points[i].opacity == other.points[i].opacity);
  }
  check_boxes(streamed, loaded);
}

/// stream_volume against read_volume.
inline void check_streams(const VolumeSource& source) {
  CAPTURE(source.file.string());
  const std::optional<Volume> streamed = stream_volume(source);
  REQUIRE(streamed.has_value());
  check_equal(*streamed, read_volume(source));
}

inline VolumeSource source_for(const std::filesystem::path& file) {
  VolumeSource source;
  source.file = file;
  return source;
}

/// What a call throws, "" for nothing.
template <class Work>
std::string error_of(const Work& work) {
  try {
    work();
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

} // namespace slicelens
