#include "console.h"
#include "options.h"
#include "study/export.h"
#include "study/inputs.h"

#include <cstdio>

namespace slicelens::cli {

void run_export(const ExportOptions& options) {
  SceneInput input = scene_input(options.input, options.set);
  hold_voxels(input, "slicelens export");
  require_exportable(input.scene); // before the data are read
  const PreparedScene prepared = load(input, console_progress());
  write_export(prepared, options.folder);
  end_progress();
  std::printf("%s\n", options.folder.c_str());
}

} // namespace slicelens::cli
