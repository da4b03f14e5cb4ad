#include "lens_inputs.h"

#include "core/errors.h"
#include "core/files.h"
#include "core/text.h"
#include "image/image_io.h"
#include "scene/load.h"
#include "volume/read.h"

#include <algorithm>
#include <system_error>

namespace slicelens::cli {

namespace fs = std::filesystem;

namespace {

std::string pattern_scene(const std::string& input) {
  std::error_code error;
  if (fs::exists(input, error))
    return "";
  return input == "checkerboard" || input == "testcard" ? R"({"image": {")" + input + R"(": {}}})" : "";
}

} // namespace

ImageSceneInput image_scene_input(const std::string& input, const std::vector<KeyValue>& changes) {
  const std::string pattern = pattern_scene(input);
  if (!pattern.empty())
    return {image_scene_from_json(pattern, input, changes), {"."}, ""};
  const bool from_command = std::any_of(changes.begin(), changes.end(),
                                        [](const KeyValue& c) { return c.key.rfind("image", 0) == 0; });
  fs::path home = fs::path(input).parent_path();
  if (home.empty())
    home = ".";
  const std::vector<fs::path> folders =
      from_command ? std::vector<fs::path>{".", home} : std::vector<fs::path>{home, "."};
  if (lower(fs::path(input).extension().string()) == ".json")
    return {image_scene_from_json(read_text(input), input, changes), folders, ""};
  const auto metadata = read_metadata(input);
  const auto scene = metadata.find("slicelens:image_scene");
  if (scene != metadata.end()) {
    const auto hash = metadata.find("slicelens:image_sha256");
    return {image_scene_from_json(scene->second, input, changes), folders,
            hash != metadata.end() && !from_command ? hash->second : ""};
  }
  if (from_command)
    throw UsageError(input + ": is the image already; leave --set image.… out or give a scene");
  ImageScene plain = image_scene_from_json("{}", input, changes);
  plain.image = {input, std::nullopt, std::nullopt};
  return {plain, {"."}, ""};
}

std::string hash_of(const ImageSceneInput& input, const std::string& source) {
  if (!input.scene.image.file)
    return "";
  const std::string hash = sha256_of({resolve_file(*input.scene.image.file, input.folders, "image.file")});
  if (!input.expected_sha256.empty() && hash != input.expected_sha256) {
    throw FileError(*input.scene.image.file, "is not the image that " + source +
                                                 " was made from (SHA-256 differs); name the right one with "
                                                 "--set image.file=…");
  }
  return hash;
}

} // namespace slicelens::cli
