#include "console.h"
#include "core/errors.h"
#include "core/files.h"
#include "options.h"
#include "study/axis_tables_page.h"
#include "study/inputs.h"

#include <cstdio>
#include <filesystem>

namespace slicelens::cli {

namespace {

/// A page of straight lines would say nothing.
void refuse_without_tables(const Scene& scene, const std::string& source) {
  if (scene.warp.empty() && !has_effects(scene)) {
    throw UsageError(source + ": has no axis maps, highlight or attenuation to plot; give it a warp of kind "
                              "bifocal, fisheye, volume-lens or connected-lens, or one of the two sections");
  }
  for (const Warp& warp : scene.warp) {
    if (!is_separable(warp)) {
      throw UsageError(source + ": has no axis maps to plot, because its warp '" + kind_of(warp) +
                       "' is no map for each axis; bifocal, fisheye, volume-lens and connected-lens are");
    }
  }
}

std::string title_of(const Scene& scene, const std::string& source) {
  return scene.title.empty() ? std::filesystem::path(source).filename().string() : scene.title;
}

} // namespace

void run_plot(const PlotOptions& options) {
  const PlotFormat format = plot_format(options.output); // refuse a wrong name before the work
  const SceneInput input = scene_input(options.input, options.set);
  refuse_without_tables(input.scene, input.source);
  const PreparedScene prepared = load(input, console_progress());
  PlotPage page = axis_tables_page(title_of(prepared.scene, input.source), prepared);
  if (!options.size.empty()) {
    page.width = options.size.at(0);
    page.height = options.size.at(1);
  }
  write_text_atomically(options.output, draw_plot(page, format));
  end_progress();
  std::printf("%s\n", options.output.c_str());
}

} // namespace slicelens::cli
