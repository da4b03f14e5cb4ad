#include "study/skip_equality.h"

#include "core/errors.h"
#include "core/files.h"
#include "render/slabs.h"
#include "scene/image_scene.h"
#include "scene/names.h"
#include "volume/phantom.h"

#include <algorithm>
#include <cmath>

namespace slicelens {

namespace {

/// "[a,b,c]" with every number at most `limit` and the longest at `limit` or as it is.
std::string scaled(std::vector<std::size_t> numbers, std::size_t limit) {
  const std::size_t longest = *std::max_element(numbers.begin(), numbers.end());
  std::string text;
  for (const std::size_t number : numbers) {
    const std::size_t value = longest > limit ? std::max<std::size_t>(1, number * limit / longest) : number;
    text += (text.empty() ? "[" : ",") + std::to_string(value);
  }
  return text + "]";
}

std::string size_of_phantom(const VolumeSettings& volume, std::size_t voxels) {
  const auto size = volume.size.value_or(phantom_info(*volume.phantom).size);
  return scaled({size.begin(), size.end()}, voxels);
}

/// Slices that render.skip can draw: of meshes their samples' places are found at the fragment instead.
Pipeline slices_of(const Scene& scene) {
  const Pipeline own = scene.render.pipeline;
  if (own == Pipeline::slices || own == Pipeline::axis || own == Pipeline::fragment || own == Pipeline::grid)
    return own;
  return scene.warp.empty() ? Pipeline::slices : Pipeline::fragment;
}

/// The scene with other settings, or why there is no such picture.
std::string prepare_with(PreparedScene& prepared, const RenderSettings& render) {
  prepared.scene.render = render;
  try {
    validate(prepared.scene);
    prepare_again(prepared);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "";
}

void compare(SkipDifference& difference, const Image& a, const Image& b) {
  difference.values = a.pixels.size();
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    const double apart = std::abs(static_cast<double>(a.pixels[i]) - static_cast<double>(b.pixels[i]));
    difference.largest = std::max(difference.largest, apart);
    difference.over += apart > 1.0 / 255 ? 1 : 0;
  }
}

/// All ways of one pipeline.
void add_ways(std::vector<SkipDifference>& list, OpenContext& context, PreparedScene& prepared,
              const RenderSettings& plain) {
  const std::string pipeline = word(plain.pipeline);
  SkipDifference first;
  first.way = pipeline;
  first.refused = prepare_with(prepared, plain);
  if (!first.refused.empty()) {
    list.push_back(first);
    return;
  }
  const Image expected = render_with(context, prepared, {}).image;
  const bool slices = draws_slices(plain.pipeline);
  for (const Skip skip : {Skip::none, Skip::empty, Skip::empty_and_hidden}) {
    for (const std::size_t planes : {std::size_t{1}, std::size_t{32}}) {
      if ((!slices && planes > 1) || (skip == Skip::none && planes == 1))
        continue;
      RenderSettings render = plain;
      render.skip = skip;
      render.planes_per_pass = planes;
      SkipDifference difference;
      difference.way = pipeline + (planes > 1 ? ", 32 planes a pass, " : ", ") + word(skip);
      difference.refused = prepare_with(prepared, render);
      if (difference.refused.empty()) {
        difference.leaves_out = prepared.skipping.empty || marks_hidden(prepared);
        compare(difference, render_with(context, prepared, {}).image, expected);
      }
      list.push_back(difference);
    }
  }
}

} // namespace

std::vector<std::filesystem::path> volume_scenes(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.path().extension() == ".json" && !is_image_scene(read_text(entry.path())))
      files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

SceneInput small_scene(const std::filesystem::path& file, std::size_t pixels, std::size_t voxels) {
  SceneInput input = scene_input(file.string(), {});
  std::vector<std::string> set = {
      "render.size=" + scaled({input.scene.render.size.begin(), input.scene.render.size.end()}, pixels)};
  const std::string key = input.scene.others.empty() ? "volume" : "volumes[0]";
  if (input.scene.volume.phantom)
    set.push_back(key + ".size=" + size_of_phantom(input.scene.volume, voxels));
  for (std::size_t i = 0; i < input.scene.others.size(); ++i) {
    const VolumeSettings& volume = input.scene.others[i].volume;
    if (volume.phantom)
      set.push_back("volumes[" + std::to_string(i + 1) + "].size=" + size_of_phantom(volume, voxels));
  }
  return scene_input(file.string(), set);
}

std::vector<SkipDifference> skip_differences(OpenContext& context, const SceneInput& input) {
  PreparedScene prepared = load(input, {});
  RenderSettings plain = prepared.scene.render;
  plain.skip = Skip::none;
  plain.planes_per_pass = 1;
  plain.early_termination = 1;
  plain.proxy = Proxy::planes;
  std::vector<SkipDifference> list;
  plain.pipeline = slices_of(prepared.scene);
  plain.order = Order::front_to_back; // that of `empty+hidden`
  add_ways(list, context, prepared, plain);
  plain.pipeline = Pipeline::rays;
  plain.order = RenderSettings().order;
  add_ways(list, context, prepared, plain);
  return list;
}

} // namespace slicelens
