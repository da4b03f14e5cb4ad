// What render.skip changes in the picture of a scene: by its promise at most 1/255 of any value.
#pragma once

#include "study/inputs.h"

#include <filesystem>
#include <string>
#include <vector>

namespace slicelens {

/// One way to draw a scene against the same without leaving anything out.
struct SkipDifference {
  std::string way;         ///< "fragment, 32 planes a pass, empty+hidden"
  std::string refused;     ///< why it is not drawn, one line; empty: it is
  bool leaves_out = false; ///< whether there was enough to leave out for trying
  double largest = 0;      ///< of any value of the picture
  std::size_t over = 0;    ///< values more than 1/255 apart
  std::size_t values = 0;  ///< of the picture
};

/// All scene files in a folder and below it, in order, but for scenes of pictures: there is nothing to skip.
std::vector<std::filesystem::path> volume_scenes(const std::filesystem::path& folder);

/// The scene file, at most `pixels` wide and high and, where it shows phantoms, of at most `voxels` on an
/// edge. Throws as scene_input.
SceneInput small_scene(const std::filesystem::path& file, std::size_t pixels, std::size_t voxels);

/// The scene drawn by slices, those of its own pipeline where that one can, else `fragment`, and by rays:
/// render.skip `empty` and `empty+hidden`, slices one and 32 in a pass, against single slices, or rays, that
/// leave out nothing; 32 in a pass also with `none`, which tells what passes change by themselves. Where the
/// plain picture is refused already nothing is listed but that. Throws as load.
std::vector<SkipDifference> skip_differences(OpenContext& context, const SceneInput& input);

} // namespace slicelens
