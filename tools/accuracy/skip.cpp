// render.skip over the scenes that come with the program: what it changes in their pictures.

#include "bench.h"
#include "core/errors.h"
#include "study/skip_equality.h"

#include <algorithm>
#include <iostream>
#include <map>

namespace slicelens::accuracy {

namespace {

constexpr std::size_t kPixels = 128;
constexpr std::size_t kVoxels = 96;

/// Of all scenes drawn one way.
struct Way {
  int scenes = 0;
  int left_out = 0;
  int over = 0; ///< scenes with a value more than 1/255 apart
  double largest_share = 0;
  double largest = 0;
  std::string worst; ///< the scene of the largest share, else of the largest difference
};

void add(Way& way, const SkipDifference& difference, const std::string& scene) {
  ++way.scenes;
  way.left_out += difference.leaves_out ? 1 : 0;
  way.over += difference.over > 0 ? 1 : 0;
  const double share = static_cast<double>(difference.over) / static_cast<double>(difference.values);
  if (share > way.largest_share || (share == way.largest_share && difference.largest > way.largest))
    way.worst = scene;
  way.largest_share = std::max(way.largest_share, share);
  way.largest = std::max(way.largest, difference.largest);
}

} // namespace

void skip_section(const Bench&) {
  namespace fs = std::filesystem;
  std::cout << "## Samples left out: every scene of scenes/, at most " << kPixels << " pixels and " << kVoxels
            << " voxels on an edge\n\n";
  OpenContext context;
  std::map<std::string, Way> ways;
  std::map<std::string, std::vector<std::string>> refusals;
  std::vector<std::string> over;
  for (const fs::path& file : volume_scenes(SLICELENS_SCENES_DIR)) {
    const std::string scene = file.parent_path().filename().string() + "/" + file.stem().string();
    say(scene);
    for (const SkipDifference& difference : skip_differences(context, small_scene(file, kPixels, kVoxels))) {
      if (!difference.refused.empty()) {
        refusals[difference.refused].push_back(scene + " (" + difference.way + ")");
        continue;
      }
      add(ways[difference.way], difference, scene);
      if (difference.over > 0)
        over.push_back("- " + scene + ", " + difference.way + ": " + std::to_string(difference.over) +
                       " of " + std::to_string(difference.values) + " values, the largest " +
                       scientific(difference.largest));
    }
  }
  {
    Table table({"way", "scenes drawn", "something left out", "with a value over 1/255",
                 "largest share of values", "largest difference", "where"});
    for (const auto& [name, way] : ways) {
      table.row({name, std::to_string(way.scenes), std::to_string(way.left_out), std::to_string(way.over),
                 percent(way.largest_share), scientific(way.largest), way.worst});
    }
  }
  for (const std::string& line : over)
    std::cout << line << "\n";
  std::cout << "\nRefused:\n\n";
  for (const auto& [reason, scenes] : refusals)
    std::cout << "- " << scenes.size() << ": " << reason << " (first: " << scenes.front() << ")\n";
}

} // namespace slicelens::accuracy
