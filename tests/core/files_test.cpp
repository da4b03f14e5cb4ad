#include "catch.h"
#include "core/errors.h"
#include "core/files.h"

#include <fstream>

using namespace slicelens;
namespace fs = std::filesystem;

TEST_CASE("a failing write leaves the old file and no rest behind") {
  const fs::path folder = fs::temp_directory_path() / "slicelens_files_test";
  fs::remove_all(folder);
  fs::create_directories(folder);
  const fs::path file = folder / "a.txt";
  write_text_atomically(file, "old");
  CHECK_THROWS_AS(write_atomically(file,
                                   [](const fs::path& temporary) {
                                     std::ofstream(temporary) << "half";
                                     throw FileError("x", "disk full");
                                   }),
                  FileError);
  CHECK(read_text(file) == "old");
  CHECK(std::distance(fs::directory_iterator(folder), fs::directory_iterator()) == 1);
  CHECK_THROWS_AS(write_text_atomically(folder / "missing" / "a.txt", "x"), FileError);
  CHECK_THROWS_AS(read_text(file, 2), FileError);
  fs::remove_all(folder);
}
