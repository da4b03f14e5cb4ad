// Copies of volumes in bricks against the volumes, and what becomes of copies that are damaged or of
// something else.
#include "streamed_files.h"
#include "volume/write.h"

#include <sys/resource.h>
#include <sys/wait.h>

#include <cmath>
#include <csignal>
#include <limits>
#include <thread>

using namespace slicelens;
namespace fs = std::filesystem;

namespace {

const WriteOptions packed{true};

CacheRequest request_for(const fs::path& file, std::size_t levels = 1) {
  CacheRequest request;
  request.file = file;
  request.levels = levels;
  return request;
}

std::string bytes_in(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// A small volume of which files are made that are wrong in one way.
struct Copied {
  TemporaryFolder folder;
  CacheFolder cache;
  VolumeSource source;
  fs::path copy;
  Volume volume = random_volume(ScalarType::i16, {70, 20, 10});

  Copied() {
    source = source_for(folder / "a.nrrd");
    copy = folder / "a.bricks";
    write_volume(volume, source.file, packed);
    cached_volume(source, request_for(copy));
  }
  std::string refusal() const {
    return error_of([&] { cached_volume(source, request_for(copy)); });
  }
};

std::string flipped(std::string bytes, std::size_t at) {
  bytes[at] = static_cast<char>(bytes[at] ^ 0x20);
  return bytes;
}

} // namespace

TEST_CASE("a copy in bricks gives every volume's voxels, whatever their type and number") {
  const CacheFolder cache;
  const TemporaryFolder folder;
  const std::vector<std::array<std::size_t, 3>> sizes = {
      {1, 1, 1}, {64, 64, 64}, {65, 63, 1}, {130, 70, 66}, {200, 3, 68}, {5, 133, 60}, {128, 1, 197}};
  const std::vector<ScalarType> types = {ScalarType::u8,  ScalarType::i16, ScalarType::u32, ScalarType::i64,
                                         ScalarType::f32, ScalarType::f64, ScalarType::u16};
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    CAPTURE(i);
    const Volume volume = random_volume(types[i], sizes[i]);
    // Read in full before it is copied, and copied row by row.
    write_volume(volume, folder / "a.nrrd", packed);
    check_equal(cached_volume(source_for(folder / "a.nrrd"), {}), read_file(folder / "a.nrrd"));
    write_volume(volume, folder / "b.mha");
    check_equal(cached_volume(source_for(folder / "b.mha"), {}), read_file(folder / "b.mha"));
  }
  CHECK(cache.files(".bricks").size() >= 2 * sizes.size());
}

TEST_CASE("coarser levels of a copy are those of the volume in memory") {
  const CacheFolder cache;
  const TemporaryFolder folder;
  for (const ScalarType type : {ScalarType::i16, ScalarType::f32, ScalarType::u32}) {
    CAPTURE(name_of(type));
    Volume volume = random_volume(type, {275, 131, 70});
    if (type == ScalarType::f32)
      reinterpret_cast<float*>(volume.voxels.data())[1000] = std::numeric_limits<float>::quiet_NaN();
    write_volume(volume, folder / "a.nrrd");
    const VolumeSource source = source_for(folder / "a.nrrd");
    const Volume copy = cached_volume(source, {{}, 4});
    Volume level = read_volume(source);
    check_equal(copy, level);
    REQUIRE(copy.streamed->coarser.size() == 3);
    for (const Volume& coarser : copy.streamed->coarser) {
      level = half_size(level);
      CHECK(coarser.dims == level.dims);
      CHECK(coarser.type == level.type);
      CHECK(coarser.spacing == level.spacing);
      CHECK(coarser.origin == level.origin);
      CHECK(coarser.min == level.min);
      CHECK(coarser.max == level.max);
      check_boxes(coarser, level);
    }
  }
}

TEST_CASE("no more levels are made than the volume has voxels for") {
  const CacheFolder cache;
  const TemporaryFolder folder;
  write_volume(random_volume(ScalarType::u8, {9, 3, 2}), folder / "a.nrrd");
  const Volume copy = cached_volume(source_for(folder / "a.nrrd"), {{}, 8});
  REQUIRE(copy.streamed->coarser.size() == 3); // 9, 5, 3, 2: a fourth would be of 1 voxel over 16
  CHECK(copy.streamed->coarser.back().dims == std::array<std::size_t, 3>{2, 1, 1});
}

TEST_CASE("a copy is made once, and again when it needs more levels") {
  const CacheFolder cache;
  const TemporaryFolder folder;
  const VolumeSource source = source_for(folder / "a.nrrd");
  write_volume(random_volume(ScalarType::u8, {100, 80, 30}), source.file, packed);
  CHECK_FALSE(cached_already(source, {}));
  cached_volume(source, {{}, 2});
  REQUIRE(cache.files(".bricks").size() == 1);
  const fs::path file = cache.files(".bricks").front();
  const auto time = fs::last_write_time(file);
  REQUIRE(cached_already(source, {{}, 2}));
  CHECK_FALSE(cached_already(source, {{}, 3}));
  CHECK(cached_volume(source, {{}, 1}).streamed->coarser.size() == 1);
  CHECK(fs::last_write_time(file) == time);
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  const Volume more = cached_volume(source, {{}, 3});
  CHECK(more.streamed->coarser.size() == 2);
  check_equal(more, read_volume(source));
  CHECK(fs::last_write_time(file) != time);
  CHECK(cache.files(".bricks").size() == 1);
  // Another name of the same contents is the same volume; another spacing has its own place in the world.
  fs::copy(source.file, folder / "b.nrrd");
  CHECK(cached_already(source_for(folder / "b.nrrd"), {}));
  VolumeSource wide = source;
  wide.spacing = glm::dvec3(3, 4, 5);
  CHECK(cached_volume(wide, {}).spacing == glm::dvec3(3, 4, 5));
  CHECK(cached_volume(source, {}).spacing == glm::dvec3(0.5, 1.25, 2));
}

TEST_CASE(
    "the hash of a source is kept as long as it is not written to, and worked out again where damaged") {
  const CacheFolder cache;
  const TemporaryFolder folder;
  const VolumeSource source = source_for(folder / "a.nrrd");
  write_volume(random_volume(ScalarType::u8, {30, 20, 10}), source.file, packed);
  cached_volume(source, {});
  REQUIRE(cache.files(".sha256").size() == 1);
  const fs::path kept = cache.files(".sha256").front();
  const std::string text = bytes_in(kept);
  CHECK(text.substr(0, 64) == sha256_of({source.file}));
  for (const std::string& damaged : {flipped(text, 0), flipped(text, 100), text.substr(0, 64), text + "0"}) {
    write_bytes(kept, damaged);
    CHECK(cached_already(source, {}).has_value());
    CHECK(bytes_in(kept) == text);
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  write_volume(random_volume(ScalarType::u8, {30, 20, 10}, 1, 8), source.file, packed);
  CHECK_FALSE(cached_already(source, {}));
  CHECK(cache.files(".sha256").size() == 2);
}

TEST_CASE("a chosen frame and component are copied, several components are not") {
  const CacheFolder cache;
  const TemporaryFolder folder;
  const Volume volume = random_volume(ScalarType::u8, {20, 10, 5}, 3);
  VolumeSource source = source_for(folder / "a.nrrd");
  write_volume(volume, source.file, packed);
  CHECK_FALSE(is_streamed(cached_volume(source, {})));
  CHECK(cache.files(".bricks").empty());
  for (const int component : {0, 2}) {
    source.component = component;
    check_equal(cached_volume(source, {}), read_volume(source));
  }
  CHECK(cache.files(".bricks").size() == 2);
}

TEST_CASE("a named copy that is cut, damaged or no copy is refused and left as it is") {
  const Copied copied;
  const std::string whole = bytes_in(copied.copy);
  std::vector<std::string> wrong = {"", "slbrick1", "no copy of anything", whole + "x"};
  for (const std::size_t length : {whole.size() - 1, whole.size() / 2, std::size_t{64}, std::size_t{63}})
    wrong.push_back(whole.substr(0, length));
  for (std::size_t at = 0; at < 40; at += 3)
    wrong.push_back(flipped(whole, at));
  const std::size_t header = whole.size() - 3000; // within the list of samples and cells
  for (std::size_t at = header; at < whole.size(); at += 97)
    wrong.push_back(flipped(whole, at));
  for (const std::string& bytes : wrong) {
    CAPTURE(bytes.size());
    write_bytes(copied.copy, bytes);
    const std::string refusal = copied.refusal();
    CHECK(contains(refusal, "a.bricks: "));
    CHECK(contains(refusal, "; delete it, or name another file with volume.cache"));
    CHECK(bytes_in(copied.copy) == bytes);
  }
  write_bytes(copied.copy, whole);
  CHECK(copied.refusal().empty());
}

TEST_CASE("a damaged brick is refused when it is read") {
  const Copied copied;
  const std::string whole = bytes_in(copied.copy);
  write_bytes(copied.copy, flipped(whole, 64 + 10));
  const Volume copy = cached_volume(copied.source, request_for(copied.copy));
  const std::string refusal = error_of([&] { crop(copy, {0, 0, 0}, {8, 8, 8}); });
  CHECK(contains(refusal, "brick 0 of 2 is damaged (checksum); delete the file"));
  CHECK(crop(copy, {68, 0, 0}, {2, 20, 10}).voxels == crop(copied.volume, {68, 0, 0}, {2, 20, 10}).voxels);
}

TEST_CASE("a copy that shrinks while it is read is refused") {
  const Copied copied;
  const Volume copy = cached_volume(copied.source, request_for(copied.copy));
  fs::resize_file(copied.copy, 5000);
  CHECK(contains(error_of([&] { crop(copy, {0, 0, 0}, {8, 8, 8}); }), "a.bricks: became shorter"));
}

TEST_CASE("a named copy of another volume, or of one that was changed, is refused and left as it is") {
  Copied copied;
  const std::string whole = bytes_in(copied.copy);
  const fs::path first = copied.source.file;
  copied.source.file = copied.folder / "other.nrrd";
  write_volume(random_volume(ScalarType::i16, {70, 20, 10}, 1, 5), copied.source.file);
  CHECK(contains(copied.refusal(), "is a copy of another volume"));
  copied.source.file = first;
  copied.source.spacing = glm::dvec3(1, 1, 1);
  CHECK(contains(copied.refusal(), "is a copy of other voxels of"));
  copied.source.spacing.reset();
  write_volume(random_volume(ScalarType::i16, {70, 20, 10}, 1, 5), first, packed);
  CHECK(contains(copied.refusal(), "held before it was changed; delete it"));
  CHECK(bytes_in(copied.copy) == whole);
  // The volume itself must not be taken for its copy's place.
  copied.copy = first;
  const std::string volume = bytes_in(first);
  CHECK(contains(copied.refusal(), "is no copy of a volume in bricks"));
  CHECK(bytes_in(first) == volume);
}

TEST_CASE("a damaged copy in the user's folder is made again, with a warning") {
  const CacheFolder cache;
  const TemporaryFolder folder;
  const VolumeSource source = source_for(folder / "a.nrrd");
  write_volume(random_volume(ScalarType::i16, {70, 20, 10}), source.file, packed);
  cached_volume(source, {});
  fs::resize_file(cache.files(".bricks").front(), 1000);
  std::string warnings;
  Progress progress;
  progress.warn = [&](const std::string& message) { warnings += message + "\n"; };
  check_equal(cached_volume(source, {}, progress), read_volume(source));
  CHECK(contains(warnings, "it is truncated; it is made again"));
}

TEST_CASE("where there is no room for a copy nothing is left behind") {
  const TemporaryFolder folder;
  const TemporaryFolder place;
  const CacheFolder cache;
  write_volume(random_volume(ScalarType::i16, {100, 100, 50}), folder / "a.nrrd", packed);
  write_volume(random_volume(ScalarType::i16, {100, 100, 50}), folder / "b.nrrd");
  for (const char* name : {"a.nrrd", "b.nrrd"}) { // read in full, and streamed
    const pid_t child = ::fork();
    REQUIRE(child >= 0);
    if (child == 0) {
      const struct rlimit limit { 300000, 300000 }; // the copy needs more than a million bytes
      ::signal(SIGXFSZ, SIG_IGN);                   // as the program does
      ::setrlimit(RLIMIT_FSIZE, &limit);
      std::string problem;
      try {
        cached_volume(source_for(folder / name), request_for(place / "copy"));
      } catch (const FileError& error) {
        problem = error.what();
      }
      const bool said = contains(problem, "copy: the copy in bricks cannot be written: File too large") &&
                        contains(problem, "name another place with volume.cache");
      ::_exit(said ? 0 : 1);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    CHECK(status == 0);
    CHECK(fs::is_empty(place.path()));
  }
  CHECK(contains(
      error_of([&] { cached_volume(source_for(folder / "a.nrrd"), request_for(place / "none/copy")); }),
      "does not exist"));
  // An old copy stays whole when a larger one does not fit.
  cached_volume(source_for(folder / "a.nrrd"), request_for(place / "copy"));
  const std::string old = bytes_in(place / "copy");
  const pid_t child = ::fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    const struct rlimit limit { 300000, 300000 };
    ::signal(SIGXFSZ, SIG_IGN);
    ::setrlimit(RLIMIT_FSIZE, &limit);
    const bool refused = !error_of([&] {
                            cached_volume(source_for(folder / "a.nrrd"), request_for(place / "copy", 3));
                          }).empty();
    ::_exit(refused ? 0 : 1);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  CHECK(status == 0);
  CHECK(bytes_in(place / "copy") == old);
}

TEST_CASE("without a folder of the user's a copy needs a name") {
  const CacheFolder cache;
  const TemporaryFolder folder;
  write_volume(random_volume(ScalarType::u8, {10, 10, 5}), folder / "a.nrrd", packed);
  folder.put("file", "");
  ::setenv("XDG_CACHE_HOME", (folder / "file").c_str(), 1);
  CHECK(contains(error_of([&] { cached_volume(source_for(folder / "a.nrrd"), {}); }), "does not exist"));
}
