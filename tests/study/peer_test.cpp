// The protocol spoken with another renderer, and every way in which it can be broken, with shell scripts as
// peers. tests/study/vtk_test.cpp speaks with the real one.
#include "catch.h"
#include "core/errors.h"
#include "study/peer.h"
#include "temporary_folder.h"

#include <signal.h>

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <sstream>
#include <thread>
#include <utility>

using namespace slicelens;
namespace fs = std::filesystem;
using Catch::Matchers::Contains;

namespace {

/// An executable script that answers the greeting, and every other request by `cases` (of a shell's case).
fs::path script(const TemporaryFolder& folder, const std::string& cases, const std::string& name = "peer") {
  const fs::path path =
      folder.put(name, "#!/bin/sh\necho $$ > '" + (folder / "pid").string() +
                           "'\nwhile read -r line; do case $line in *hello*) echo '{\"ok\": true}';;\n" +
                           cases + "\n*) echo '{\"error\": \"no such request\"}';; esac; done\n");
  fs::permissions(path, fs::perms::owner_all);
  return path;
}

std::string failure(const std::function<void()>& call) {
  try {
    call();
  } catch (const FileError& error) {
    return error.what();
  }
  return {};
}

/// Whether the process whose number the script has written is there, even as a zombie.
bool runs(const fs::path& file) {
  std::ifstream in(file);
  pid_t number = 0;
  in >> number;
  REQUIRE(number > 1);
  return ::kill(number, 0) == 0 || errno != ESRCH;
}

/// A grandchild is reaped by others, when they come to it.
bool goes_away(const fs::path& file) {
  for (int i = 0; i < 1000 && runs(file); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  return !runs(file);
}

constexpr const char* good = R"sh(*load*) echo "$line" >&2
  echo '{"ok": true, "renderer": "R", "version": "4.5", "vtk": "9"}';;
*draw*3*) echo '{"seconds": [0.5, 0.25, 1e-3]}';;
*write*) echo '{"ok": true}';;)sh";

} // namespace

TEST_CASE("a peer loads, draws and writes, and is gone afterwards") {
  const TemporaryFolder folder;
  {
    Peer first(script(folder, good));
    const PeerDriver driver = first.load(folder / "scene", "cpu");
    CHECK(driver.renderer == "R");
    CHECK(driver.version == "4.5");
    CHECK(driver.program == "9");
    Peer moved(std::move(first));
    CHECK(moved.draw(3) == std::vector<double>{0.5, 0.25, 1e-3});
    moved.write(folder / "a.png");
    CHECK(runs(folder / "pid"));
    CHECK(failure([&] { first.draw(); }) != ""); // NOLINT: what was moved from refuses
  }
  CHECK_FALSE(runs(folder / "pid"));
}

TEST_CASE("what a peer refuses is told in its own words, and it goes on") {
  const TemporaryFolder folder;
  Peer peer(script(folder, std::string(good) + R"(
*draw*) echo '{"error": "render.mode xray: no"}';;)"));
  CHECK_THAT(failure([&] { peer.draw(2); }), Contains("peer: render.mode xray: no"));
  CHECK(peer.draw(3).size() == 3);
}

TEST_CASE("a peer that cannot be started") {
  const TemporaryFolder folder;
  CHECK_THAT(failure([&] { Peer(folder / "nowhere"); }),
             Contains("nowhere: cannot be started: No such file"));
  const fs::path plain = folder.put("plain", "#!/bin/sh\n");
  CHECK_THAT(failure([&] { Peer peer(plain); }), Contains("Permission denied"));
  const fs::path orphan = folder.put("orphan", "#!/nowhere/python3\n");
  fs::permissions(orphan, fs::perms::owner_all);
  CHECK_THAT(failure([&] { Peer peer(orphan); }), Contains("first line names is not installed"));
  const fs::path lacking =
      folder.put("lacking", "#!/bin/sh\necho noise >&2\necho 'VTK is missing; apt-get it' >&2\n"
                            "exit 1\n");
  fs::permissions(lacking, fs::perms::owner_all);
  CHECK_THAT(failure([&] { Peer peer(lacking); }),
             Contains("ended with status 1: VTK is missing; apt-get it") && !Contains("noise"));
}

TEST_CASE("a peer that breaks the protocol is ended") {
  const TemporaryFolder folder;
  const auto broken = [&](const std::string& answer) {
    Peer peer(script(folder, "*draw*) " + answer + ";;"), 20);
    const std::string message = failure([&] { peer.draw(2); });
    CHECK_FALSE(runs(folder / "pid"));
    CHECK_THAT(failure([&] { peer.draw(2); }), Contains("has ended before"));
    return message;
  };
  CHECK_THAT(broken("echo what"), Contains("no JSON object: what"));
  CHECK_THAT(broken("echo '[1, 2]'"), Contains("no JSON object"));
  CHECK_THAT(broken("echo '{\"ok\": true}'"), Contains("0 times for 2 frames"));
  CHECK_THAT(broken("echo '{\"seconds\": [1]}'"), Contains("1 times for 2 frames"));
  CHECK_THAT(broken("echo '{\"seconds\": [1, \"x\"]}'"), Contains("a time that is none: \"x\""));
  CHECK_THAT(broken("echo '{\"seconds\": [1, -1]}'"), Contains("a time that is none: -1"));
  CHECK_THAT(broken("echo '{\"seconds\": \"none\"}'"), Contains("a time that is none"));
  CHECK_THAT(broken("printf 'a\\nb\\n'"), Contains("more than one line"));
  CHECK_THAT(broken("head -c 2000000 /dev/zero"), Contains("more than 1048576 bytes"));
  CHECK_THAT(broken("echo 'out of memory' >&2; exit 3"), Contains("ended with status 3: out of memory"));
  CHECK_THAT(broken("printf '\\033[31mno display\\033[0m\\n\\033[0m\\n' >&2; exit 3"),
             Contains("status 3: no display"));
  CHECK_THAT(broken("kill -9 $$"), Contains("was ended by signal 9"));
  CHECK_THAT(broken("exec >&-; exec <&-; sleep 60"), Contains("closed its output without an answer"));
}

TEST_CASE("a peer that gives no answer is ended after its time, with what it has started") {
  const TemporaryFolder folder;
  const std::string child = "sleep 300 & echo $! > '" + (folder / "child").string() + "'; ";
  const auto start = std::chrono::steady_clock::now();
  {
    Peer peer(script(folder, "*load*) " + child + "wait;;"), 0.5);
    CHECK_THAT(failure([&] { peer.load(folder.path(), "gpu"); }), Contains("gave no answer within 0.5 s"));
    CHECK_FALSE(runs(folder / "pid"));
    CHECK(goes_away(folder / "child"));
  }
  // Deaf to SIGTERM as well: killed.
  Peer peer(script(folder, "*load*) trap '' TERM; while :; do sleep 1; done;;"), 0.5);
  CHECK_THAT(failure([&] { peer.load(folder.path(), "gpu"); }), Contains("gave no answer"));
  CHECK_FALSE(runs(folder / "pid"));
  // Not a measurement: only that nothing waited for the sleeper of five minutes.
  CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(120));
}

TEST_CASE("the peer's script is where the environment says, else in the source") {
  const char* before = std::getenv("SLICELENS_VTK");
  const std::optional<std::string> kept =
      before == nullptr ? std::nullopt : std::optional<std::string>(before);
  ::setenv("SLICELENS_VTK", "/somewhere/else", 1);
  CHECK(find_peer() == "/somewhere/else");
  ::unsetenv("SLICELENS_VTK");
  CHECK(find_peer() == fs::path(SLICELENS_SOURCE_DIR) / "tools" / "render_with_vtk");
  if (kept)
    ::setenv("SLICELENS_VTK", kept->c_str(), 1);
}
