// What users name for `slicelens lens`: images, patterns, 2D scenes, pictures of them.
#pragma once

#include "scene/image_scene.h"

#include <filesystem>
#include <string>
#include <vector>

namespace slicelens::cli {

/// A 2D scene and where its relative paths count from.
struct ImageSceneInput {
  ImageScene scene;
  std::vector<std::filesystem::path> folders;
  std::string expected_sha256; ///< of image.file, when the scene comes from a picture
};

/// The 2D scene of a scene file, of a picture that slicelens wrote, of a pattern's name, or of an image with
/// every other key at its default.
ImageSceneInput image_scene_input(const std::string& input, const std::vector<KeyValue>& changes);

/// The hash of the image's file; empty for patterns. Throws FileError when it is not the expected one;
/// `source` is what the user named.
std::string hash_of(const ImageSceneInput& input, const std::string& source);

} // namespace slicelens::cli
