// Copies of volumes in bricks as users meet them: one line, exit status 1, nothing left behind.
#include "catch.h"
#include "program.h"

#include <sys/resource.h>

namespace {

/// A volume of a format that is copied, and the folder of copies.
struct Packed {
  Workplace place;
  Packed() {
    ::setenv("XDG_CACHE_HOME", (place / "cache").c_str(), 1);
    REQUIRE(place.run({"phantom", "blob", "-o", "a.nrrd", "--size", "40,30,20", "--compress"}).status == 0);
  }
  ~Packed() { ::unsetenv("XDG_CACHE_HOME"); }
  Outcome info(const std::string& file = "a.nrrd") const {
    return place.run({"info", file, "--set", "volume.access=cache", "--set", "volume.cache=a.bricks"});
  }
};

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// One line that names the copy.
void check_refused(const Outcome& outcome, const std::string& what) {
  CAPTURE(outcome.err);
  CHECK(outcome.status == 1);
  CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
  CHECK(contains(outcome.err, "a.bricks: "));
  CHECK(contains(outcome.err, what));
}

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
  REQUIRE(packed.place.run({"phantom", "blob", "-o", "b.nrrd", "--size", "30,40,20", "--compress"}).status ==
          0);
  check_refused(packed.info("b.nrrd"), "is a copy of another volume");
  fs::rename(packed.place / "b.nrrd", packed.place / "a.nrrd");
  check_refused(packed.info(), "held before it was changed");
  CHECK(contents(packed.place / "a.bricks") == whole);
}

TEST_CASE("a disk that fills while a copy in bricks is written ends with 1 and keeps nothing of it") {
  const Packed packed;
  struct rlimit old {};
  ::getrlimit(RLIMIT_FSIZE, &old);
  const struct rlimit full { 10000, old.rlim_max }; // the copy takes more than the 24000 voxels' 48000 bytes
  ::setrlimit(RLIMIT_FSIZE, &full);
  const Outcome outcome = packed.info();
  ::setrlimit(RLIMIT_FSIZE, &old);
  check_refused(outcome, "the copy in bricks cannot be written: File too large");
  CHECK(packed.place.entries() == std::vector<std::string>{"a.nrrd"});
  CHECK(packed.info().status == 0);
}

TEST_CASE("info describes a streamed volume as one that is held in memory") {
  const Workplace place;
  ::setenv("XDG_CACHE_HOME", (place / "cache").c_str(), 1);
  REQUIRE(place.run({"phantom", "blob", "-o", "a.mhd", "--size", "40,30,20"}).status == 0);
  const Outcome streamed = place.run({"info", "a.mhd", "--set", "volume.access=stream"});
  CHECK(streamed.status == 0);
  CHECK(streamed.out == place.run({"info", "a.mhd"}).out);
  CHECK(place.run({"info", "a.mhd", "--set", "volume.access=memory"}).out == streamed.out);
  ::unsetenv("XDG_CACHE_HOME");
}
