// What cannot be read or written: refused in one line, in bounded memory, without harm.
#include "catch.h"
#include "core/files.h"
#include "image_files.h"

#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>

using namespace slicelens;

namespace {

/// Limits the size of any file that this process writes, as a full disk would.
struct FullDisk {
  rlimit before{};
  void (*handler)(int);
  explicit FullDisk(rlim_t bytes) : handler(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &before);
    const rlimit limit{bytes, before.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FullDisk() {
    ::setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;
};

} // namespace

TEST_CASE("what is no image is refused in one line") {
  const Scratch scratch("refused");
  const auto refused = [](const fs::path& path) {
    const std::string message = message_of([&] { read_image(path); });
    INFO(message);
    CHECK(contains(message, path.filename().string()));
    CHECK_FALSE(contains(message, "\n"));
    CHECK_THROWS_AS(read_image(path), FileError);
    CHECK_THROWS_AS(read_metadata(path), FileError);
  };
  refused(scratch / "missing.png");
  refused(scratch.folder);
  REQUIRE(::mkfifo((scratch / "fifo.png").c_str(), 0600) == 0);
  refused(scratch / "fifo.png");
  for (const std::string name : {"empty.png", "empty.exr", "empty.jpg", "empty.tif", "empty.null", "empty"}) {
    write_bytes(scratch / name, "");
    refused(scratch / name);
    write_bytes(scratch / ("text" + name), "not an image\nat all\n");
    refused(scratch / ("text" + name));
  }
}

TEST_CASE("a file cut short anywhere is refused, never read in part") {
  const Scratch scratch("cut");
  Image image = random_image(32, 32, 9);
  image.metadata["slicelens:scene"] = "{}";
  for (const PixelDepth depth : {PixelDepth::png8, PixelDepth::exr_half}) {
    const fs::path file = scratch / name_for(depth);
    write_image(image, file, depth);
    const std::string bytes = read_text(file);
    for (std::size_t length = 0; length < bytes.size(); length += 37) {
      write_bytes(file, bytes.substr(0, length));
      const std::string message = message_of([&] { read_image(file); });
      INFO(length << " of " << bytes.size() << " bytes: " << message);
      CHECK(contains(message, file.filename().string() + ": "));
      CHECK_FALSE(contains(message, "\n"));
    }
  }
}

TEST_CASE("a header that claims an absurd size is refused") {
  const Scratch scratch("absurd");
  // one transparent pixel behind an IHDR that says otherwise
  const auto png = [](std::uint32_t width, std::uint32_t height) {
    return png_of(width, height, 8, 6, "", std::string(5, '\0'));
  };
  write_bytes(scratch / "one.png", png(1, 1));
  CHECK(read_image(scratch / "one.png").width == 1); // the frame around is right
  for (const auto& [width, height] :
       {std::pair{70000U, 1U}, {1U, 900000U}, {65536U, 65536U}, {8193U, 8192U}}) {
    write_bytes(scratch / "big.png", png(width, height));
    const std::string message = message_of([&] { read_image(scratch / "big.png"); });
    INFO(message);
    // 8193·8192 pixels are just above 1 GiB of RGBA floats
    CHECK(contains(message, "65536 on a side"));
  }
  write_bytes(scratch / "big.exr", exr_of("Y", {0, 0, 69999, 3}, {0, 0, 69999, 3}, 1));
  CHECK(contains(message_of([&] { read_image(scratch / "big.exr"); }), "65536 on a side"));
  write_bytes(scratch / "big.exr", exr_of("Y", {0, 0, 3, 3}, {0, 0, 99999, 99999}, 1));
  CHECK(contains(message_of([&] { read_image(scratch / "big.exr"); }), "65536 on a side"));
  write_bytes(scratch / "far.exr",
              exr_of("Y", {2000000000, 0, 2000000003, 3}, {-2000000000, 0, -1999999997, 3}, 1));
  CHECK(message_of([&] { read_image(scratch / "far.exr"); }).find('\n') == std::string::npos);
  write_bytes(scratch / "big.png", png(8000, 8000));
  CHECK(contains(message_of([&] { read_image(scratch / "big.png"); }), "too short"));
}

TEST_CASE("every damaged byte of a PNG is noticed") {
  const Scratch scratch("damaged");
  const fs::path file = scratch / "a.png";
  write_image(random_image(6, 5, 10), file, PixelDepth::png8);
  const std::string bytes = read_text(file);
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    std::string damaged = bytes;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
    write_bytes(file, damaged);
    INFO(at);
    CHECK_THROWS_AS(read_image(file), FileError);
  }
}

TEST_CASE("a full disk is one line, leaves no rest, and the old file is unharmed") {
  const Scratch scratch("full");
  for (const PixelDepth depth : all_depths) {
    const fs::path file = scratch / name_for(depth);
    write_bytes(file, "old");
    const Image image = random_image(100, 100, 11);
    std::string message;
    {
      const FullDisk full(4096);
      message = message_of([&] { write_image(image, file, depth); });
    }
    CHECK(contains(message, file.filename().string()));
    CHECK(contains(message, "cannot be written"));
    CHECK_FALSE(contains(message, "Success"));
    CHECK(read_text(file) == "old");
    fs::remove(file);
    CHECK(fs::is_empty(scratch.folder));
  }
}
