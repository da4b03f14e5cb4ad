// render.skip over every scene that comes with the program: what it leaves out is not missed.
#include "catch.h"
#include "gl_fixture.h"
#include "study/skip_equality.h"

#include <set>

using namespace slicelens;
namespace fs = std::filesystem;

TEST_CASE("every scene shows the same with samples left out", "[one-driver]") {
  OpenContext context;
  std::set<std::string> ways; // that were drawn and left something out
  for (const fs::path& file : volume_scenes(fs::path(SLICELENS_SOURCE_DIR) / "scenes")) {
    INFO(file.string());
    for (const SkipDifference& difference : skip_differences(context, small_scene(file, 96, 40))) {
      INFO(difference.way << ": largest " << difference.largest << ", over 1/255 " << difference.over);
      if (!difference.refused.empty())
        continue;
      if (difference.leaves_out)
        ways.insert(difference.way);
      // Single samples on outlines where something shows (docs/skipping.md).
      CHECK(static_cast<double>(difference.over) <= 2e-3 * static_cast<double>(difference.values));
    }
  }
  for (const std::string pipeline : {"slices", "fragment", "axis", "grid"}) {
    for (const std::string skip : {"empty", "empty+hidden"}) {
      CHECK(ways.count(pipeline + ", " + skip) == 1);
      CHECK(ways.count(pipeline + ", 32 planes a pass, " + skip) == 1);
    }
  }
  CHECK(ways.count("rays, empty") == 1);
  CHECK(ways.count("rays, empty+hidden") == 1);
}
