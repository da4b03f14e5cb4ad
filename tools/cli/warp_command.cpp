#include "console.h"
#include "core/errors.h"
#include "options.h"
#include "render/bake.h"
#include "study/inputs.h"
#include "volume/write.h"

#include <cstdio>

namespace slicelens::cli {

void run_warp(const WarpOptions& options) {
  SceneInput input = scene_input(options.input, options.set);
  hold_voxels(input, "slicelens warp");
  const std::size_t index = checked_volume(input.scene, options.volume);
  const Progress progress = console_progress();
  PreparedScene all = load(input, progress);
  const PreparedScene prepared = one_volume(std::move(all), index);
  BakeOptions bake_options;
  if (!options.size.empty())
    bake_options.size = {options.size.at(0), options.size.at(1), options.size.at(2)};
  bake_options.as_float = options.as_float;
  bake_options.outside = options.outside;
  const Volume volume = bake(prepared, bake_options, progress);
  write_volume(volume, options.output, {options.compress});
  end_progress();
  std::printf("%s\n", options.output.c_str());
}

} // namespace slicelens::cli
