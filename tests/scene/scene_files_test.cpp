// The scene files that come with the program.
#include "catch.h"
#include "core/files.h"
#include "scene/image_scene.h"
#include "scene/scene_json.h"

#include <algorithm>
#include <filesystem>
#include <vector>

using namespace slicelens;
namespace fs = std::filesystem;

namespace {

std::vector<fs::path> scene_files(const std::string& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(fs::path(SLICELENS_SOURCE_DIR) / "scenes" / folder)) {
    if (entry.path().extension() == ".json")
      files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

} // namespace

TEST_CASE("every figure file is a valid scene with a title") {
  const auto folder = GENERATE(as<std::string>(), "brunet", "cohen", "gallery", "lamar");
  const std::vector<fs::path> files = scene_files(folder);
  CHECK(files.size() > 10);
  for (const fs::path& file : files) {
    CAPTURE(file.string());
    const std::string text = read_text(file);
    std::string title;
    if (is_image_scene(text))
      CHECK_NOTHROW(title = image_scene_from_json(text, file.string()).title);
    else
      CHECK_NOTHROW(title = scene_from_json(text, file.string()).title);
    CHECK_FALSE(title.empty());
  }
}

TEST_CASE("Cohen's figures are drawn by his tables, and each says how to give real data") {
  for (const fs::path& file : scene_files("cohen")) {
    CAPTURE(file.string());
    const std::string text = read_text(file);
    CHECK(scene_from_json(text, file.string()).render.pipeline == Pipeline::axis);
    CHECK(text.find("--set volume.file=") != std::string::npos);
  }
}
