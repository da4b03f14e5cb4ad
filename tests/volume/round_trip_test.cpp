#include "volume/write.h"
#include "volume_files.h"

#include <sys/resource.h>
#include <sys/wait.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <functional>

using namespace slicelens;
namespace fs = std::filesystem;

namespace {

const std::vector<ScalarType> all_types = {ScalarType::u8,  ScalarType::i8,  ScalarType::u16, ScalarType::i16,
                                           ScalarType::u32, ScalarType::i32, ScalarType::u64, ScalarType::i64,
                                           ScalarType::f32, ScalarType::f64};

/// 5 × 4 × 3 voxels with the extreme values of the type in them, and an oblique direction: a rotation by the
/// angles whose sines and cosines are (3/5, 4/5) and (5/13, 12/13), exact in the product of two matrices.
Volume oblique(ScalarType type, int components) {
  Volume v;
  v.dims = {5, 4, 3};
  v.spacing = {0.1, 2.5, 1.0 / 3.0};
  v.origin = {-12.25, 1e-3, 1234.5678901234567};
  const glm::dmat3 about_z(4.0 / 5, 3.0 / 5, 0, -3.0 / 5, 4.0 / 5, 0, 0, 0, 1);
  const glm::dmat3 about_x(1, 0, 0, 0, 12.0 / 13, 5.0 / 13, 0, -5.0 / 13, 12.0 / 13);
  v.direction = about_z * about_x;
  v.type = type;
  v.components = components;
  v.voxels.resize(voxel_bytes(v));
  visit_scalar_type(type, [&](auto* tag) {
    using T = std::remove_pointer_t<decltype(tag)>;
    T* const out = reinterpret_cast<T*>(v.voxels.data());
    const std::size_t count = v.voxels.size() / sizeof(T);
    for (std::size_t i = 0; i < count; ++i)
      out[i] = static_cast<T>(i % 120);
    out[0] = std::numeric_limits<T>::lowest();
    out[count - 1] = std::numeric_limits<T>::max();
  });
  return v;
}

void check_same(const Volume& a, const Volume& b) {
  CHECK(a.dims == b.dims);
  CHECK(a.type == b.type);
  CHECK(a.components == b.components);
  CHECK(a.voxels == b.voxels);
  for (int axis = 0; axis < 3; ++axis) {
    // 17 digits are written; the libraries then form spacing · direction and take it apart again.
    CHECK(std::abs(a.spacing[axis] - b.spacing[axis]) < 1e-14 * 2.5 * 4);
    CHECK(std::abs(a.origin[axis] - b.origin[axis]) < 1e-12);
    for (int row = 0; row < 3; ++row)
      CHECK(std::abs(a.direction[axis][row] - b.direction[axis][row]) < 1e-14);
  }
}

} // namespace

TEST_CASE("every scalar type, 1 to 4 components and an oblique direction survive NRRD and MetaImage") {
  const TemporaryFolder folder;
  for (const char* name : {"a.nrrd", "a.nhdr", "a.mha", "a.mhd"}) {
    for (const ScalarType type : all_types) {
      for (int components = 1; components <= 4; ++components) {
        for (const bool compress : {false, true}) {
          CAPTURE(name, name_of(type), components, compress);
          const Volume written = oblique(type, components);
          WriteOptions options;
          options.compress = compress;
          write_volume(written, folder / name, options);
          const Volume read = read_file(folder / name);
          check_same(written, read);
          CHECK(read.format == (std::string(name)[2] == 'm' ? "MetaImage" : "NRRD"));
          CHECK(read.frames == 1);
        }
      }
    }
  }
}

TEST_CASE("statistics of a volume that was read are those of its values") {
  const TemporaryFolder folder;
  Volume v;
  v.dims = {2, 2, 1};
  v.type = ScalarType::f32;
  v.voxels.resize(16);
  const std::vector<float> values = {-2.5f, 4.0f, 0.5f, std::nanf("")};
  std::memcpy(v.voxels.data(), values.data(), 16);
  write_volume(v, folder / "a.nrrd");
  const Volume read = read_file(folder / "a.nrrd");
  CHECK(read.min == -2.5);
  CHECK(read.max == 4.0);
  CHECK(read.mean == Approx(2.0 / 3).epsilon(1e-15)); // (−2.5 + 4 + 0.5)/3
  CHECK(read.non_finite == 1);
}

namespace {

/// The rows of a volume that is there.
RowSource rows_of(const Volume& volume) {
  return [&volume](std::size_t first, std::span<std::byte> out) {
    const std::size_t row = voxel_bytes(volume) / (volume.dims[1] * volume.dims[2]);
    std::memcpy(out.data(), volume.voxels.data() + first * row, out.size());
  };
}

std::vector<std::pair<std::string, std::string>> files_in(const fs::path& folder) {
  std::vector<std::pair<std::string, std::string>> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    std::ifstream in(entry.path(), std::ios::binary);
    files.emplace_back(entry.path().filename().string(), std::string(std::istreambuf_iterator<char>(in), {}));
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// Whether writing fails with one line that names `path`, where no file may be larger than 100 000 bytes: a
/// full disk in small, writes beyond it fail (EFBIG).
void check_fails_when_full(const fs::path& path, const std::function<void()>& write) {
  const pid_t child = ::fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{100000, 100000};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    int result = 1;
    try {
      write();
    } catch (const FileError& error) {
      const std::string text = error.what();
      result = contains(text, path.string()) && !contains(text, "\n") ? 0 : 2;
    }
    ::_exit(result);
  }
  int status = -1;
  ::waitpid(child, &status, 0);
  REQUIRE(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 0);
}

} // namespace

TEST_CASE("rows are written as the whole volume is, byte for byte") {
  for (const char* name : {"a.nrrd", "a.nhdr", "a.mha", "a.mhd"}) {
    for (const ScalarType type : all_types) {
      for (const int components : {1, 3}) {
        CAPTURE(name, name_of(type), components);
        const TemporaryFolder whole;
        const TemporaryFolder streamed;
        const Volume volume = oblique(type, components);
        write_volume(volume, whole / name);
        Volume empty = volume;
        empty.voxels.clear();
        write_rows(empty, rows_of(volume), streamed / name);
        CHECK(files_in(whole.path()) == files_in(streamed.path()));
      }
    }
  }
}

TEST_CASE("rows are asked for in order and in parts") {
  const TemporaryFolder folder;
  Volume volume;
  volume.dims = {1 << 20, 7, 10}; // 70 MiB: three parts of at most 32
  volume.type = ScalarType::u8;
  std::size_t next = 0;
  std::size_t largest = 0;
  write_rows(
      volume,
      [&](std::size_t first, std::span<std::byte> out) {
        CHECK(first == next);
        next += out.size() >> 20;
        largest = std::max(largest, out.size());
        std::fill(out.begin(), out.end(), std::byte{0});
      },
      folder / "a.mha");
  CHECK(next == 70);
  CHECK(largest == std::size_t{32} << 20);
}

TEST_CASE("a disk without room is named before anything is written") {
  const TemporaryFolder folder;
  Volume volume;
  volume.dims = {std::size_t{1} << 20, std::size_t{1} << 20, std::size_t{1} << 10}; // a pebibyte
  volume.type = ScalarType::u8;
  bool asked = false;
  std::string message;
  try {
    write_rows(
        volume, [&](std::size_t, std::span<std::byte>) { asked = true; }, folder / "a.nhdr");
  } catch (const FileError& error) {
    message = error.what();
  }
  CHECK_FALSE(asked);
  CHECK(contains(message, (folder / "a.nhdr").string()));
  CHECK(contains(message, "1048576 GiB"));
  CHECK(fs::is_empty(folder.path()));
}

TEST_CASE("an existing file stays unharmed when a volume cannot be written") {
  const TemporaryFolder folder;
  const Volume small = oblique(ScalarType::u8, 1);
  Volume large = small;
  large.dims = {200, 200, 10};
  large.voxels.assign(voxel_bytes(large), std::byte{7});
  for (const char* name : {"a.nrrd", "a.mha", "a.mhd", "a.nhdr"}) {
    CAPTURE(name);
    write_volume(small, folder / name);
    check_fails_when_full(folder / name, [&] { write_volume(large, folder / name); });
    check_same(small, read_file(folder / name));
    check_fails_when_full(folder / name, [&] { write_rows(large, rows_of(large), folder / name); });
    check_same(small, read_file(folder / name));
  }
  // Four names, two of them with a data file beside; nothing temporary is left.
  std::size_t files = 0;
  for (const auto& entry : fs::directory_iterator(folder.path())) {
    CHECK(entry.path().filename().string()[0] != '.');
    ++files;
  }
  CHECK(files <= 6);
}

TEST_CASE("writing refuses unknown extensions and missing folders by name") {
  const TemporaryFolder folder;
  const Volume v = oblique(ScalarType::u8, 1);
  CHECK_THROWS_AS(write_volume(v, folder / "a.png"), UsageError);
  CHECK_THROWS_AS(write_volume(v, folder.path() / "missing" / "a.nrrd"), FileError);
  CHECK_THROWS_AS(write_volume(Volume(), folder / "a.nrrd"), UsageError);
}
