#include "console.h"
#include "core/errors.h"
#include "core/files.h"
#include "inputs.h"
#include "options.h"
#include "study/axis_tables_page.h"

#include <cstdio>
#include <filesystem>

namespace slicelens::cli {

namespace {

/// What the page of a scene's tables shows.
struct ScenePlot {
  std::array<std::vector<glm::vec4>, 3> texels;
  std::array<FocusMarks, 3> marks;
};

// TODO: the tables of the prepared scene, once scenes have axis maps.
ScenePlot axis_tables_of(const PreparedScene&, const std::string& source) {
  throw UsageError(source + ": has no axis maps, highlight or attenuation to plot");
}

std::string title_of(const Scene& scene, const std::string& source) {
  return scene.title.empty() ? std::filesystem::path(source).filename().string() : scene.title;
}

} // namespace

void run_plot(const PlotOptions& options) {
  const PlotFormat format = plot_format(options.output); // refuse a wrong name before the work
  const SceneInput input = scene_input(options.input, options.set);
  const PreparedScene prepared = load(input, console_progress());
  const ScenePlot plot = axis_tables_of(prepared, input.source);
  PlotPage page = axis_tables_page(title_of(prepared.scene, input.source), plot.texels, plot.marks);
  if (!options.size.empty()) {
    page.width = options.size.at(0);
    page.height = options.size.at(1);
  }
  write_text_atomically(options.output, draw_plot(page, format));
  end_progress();
  std::printf("%s\n", options.output.c_str());
}

} // namespace slicelens::cli
