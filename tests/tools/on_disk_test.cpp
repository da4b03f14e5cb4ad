// Copies of volumes in bricks as users meet them: one line, exit status 1, nothing left behind.
#include "catch.h"
#include "program.h"

#include <sys/resource.h>

namespace {

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// A file whose voxels are compressed, so that they are copied, and the folder of what is kept.
struct Packed {
  Workplace place;
  Packed() {
    ::setenv("XDG_CACHE_HOME", (place / "cache").c_str(), 1);
    make("a.nrrd", "40", "30");
  }
  ~Packed() { ::unsetenv("XDG_CACHE_HOME"); }
  void make(const std::string& name, const std::string& nx, const std::string& ny) const {
    REQUIRE(place.run({"phantom", "blob", "-o", "plain.nrrd", "--size", nx, ny, "20"}).status == 0);
    REQUIRE(place.run({"warp", "plain.nrrd", "-o", name, "--compress"}).status == 0);
    fs::remove(place / "plain.nrrd");
  }
  Outcome info(const std::string& file = "a.nrrd") const {
    return place.run({"info", file, "--set", "volume.access=cache", "--set", "volume.cache=a.bricks"});
  }
};

/// One line that names the copy.
void check_refused(const Outcome& outcome, const std::string& what) {
  CAPTURE(outcome.err);
  CHECK(outcome.status == 1);
  CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
  CHECK(contains(outcome.err, "a.bricks: "));
  CHECK(contains(outcome.err, what));
}

/// A disk with room for so many bytes of each file, for the programs started meanwhile.
class FullDisk {
public:
  explicit FullDisk(rlim_t bytes) {
    ::getrlimit(RLIMIT_FSIZE, &old_);
    const struct rlimit limit { bytes, old_.rlim_max };
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FullDisk() { ::setrlimit(RLIMIT_FSIZE, &old_); }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

private:
  struct rlimit old_ {};
};

} // namespace

TEST_CASE("a copy in bricks that is cut, damaged or of another volume ends with 1 and stays as it is") {
  const Packed packed;
  const Outcome first = packed.info();
  CHECK(first.status == 0);
  CHECK(first.out == packed.place.run({"info", "a.nrrd"}).out);
  const std::string whole = contents(packed.place / "a.bricks");
  put(packed.place / "a.bricks", whole.substr(0, whole.size() / 2));
  check_refused(packed.info(), "it is truncated; delete it, or name another file with volume.cache");
  std::string damaged = whole;
  damaged[whole.size() - 100] = static_cast<char>(damaged[whole.size() - 100] ^ 1);
  put(packed.place / "a.bricks", damaged);
  check_refused(packed.info(), "its header is damaged; delete it");
  CHECK(contents(packed.place / "a.bricks") == damaged);
  put(packed.place / "a.bricks", whole);
  packed.make("b.nrrd", "30", "40");
  check_refused(packed.info("b.nrrd"), "is a copy of another volume");
  fs::rename(packed.place / "b.nrrd", packed.place / "a.nrrd");
  check_refused(packed.info(), "held before it was changed");
  CHECK(contents(packed.place / "a.bricks") == whole);
}

TEST_CASE("a disk that fills while a copy in bricks is written ends with 1 and keeps nothing of it") {
  const Packed packed;
  REQUIRE(packed.place.run({"phantom", "blob", "-o", "b.mha", "--size", "40", "30", "20"}).status == 0);
  for (const char* file : {"a.nrrd", "b.mha"}) { // read in full, and copied without being held in memory
    CAPTURE(file);
    Outcome outcome;
    {
      const FullDisk full(10000); // the copy takes at least the 24000 voxels' bytes
      outcome = packed.info(file);
    }
    check_refused(outcome, "the copy in bricks cannot be written: File too large");
    CHECK(packed.place.entries() == std::vector<std::string>{"a.nrrd", "b.mha", "cache"});
    for (const auto& entry : fs::recursive_directory_iterator(packed.place / "cache"))
      CHECK((entry.is_directory() || entry.path().extension() == ".sha256"));
  }
  CHECK(packed.info().status == 0);
}

TEST_CASE("a picture of a copy with a damaged brick ends with 1, without a picture") {
  const Packed packed;
  REQUIRE(packed.info().status == 0);
  std::string bytes = contents(packed.place / "a.bricks");
  bytes[1000] = static_cast<char>(bytes[1000] ^ 1); // of the only brick
  put(packed.place / "a.bricks", bytes);
  check_refused(packed.place.run({"render", "a.nrrd", "-o", "a.png", "--set", "volume.access=cache", "--set",
                                  "volume.cache=a.bricks", "--set", "render.size=[64,64]"}),
                "brick 0 of 1 is damaged (checksum); delete the file");
  CHECK_FALSE(fs::exists(packed.place / "a.png"));
}

TEST_CASE("info describes a streamed volume as one that is held in memory") {
  const Workplace place;
  ::setenv("XDG_CACHE_HOME", (place / "cache").c_str(), 1);
  REQUIRE(place.run({"phantom", "blob", "-o", "a.mhd", "--size", "40", "30", "20"}).status == 0);
  const Outcome streamed = place.run({"info", "a.mhd", "--set", "volume.access=stream"});
  CHECK(streamed.status == 0);
  CHECK(streamed.out == place.run({"info", "a.mhd"}).out);
  CHECK(place.run({"info", "a.mhd", "--set", "volume.access=memory"}).out == streamed.out);
  ::unsetenv("XDG_CACHE_HOME");
}
