#include "core/embedded.h"
#include "core/errors.h"
#include "core/text.h"
#include "gl/context.h"
#include "options.h"
#include "scene/image_scene.h"
#include "scene/names.h"
#include "scene/scene_json.h"
#include "volume/phantom.h"
#include "volume/transfer.h"

#include <algorithm>
#include <cstdio>
#include <functional>

namespace slicelens {

const std::vector<EmbeddedFile>& embedded_scenes(); // made at build time

namespace cli {

namespace {

void row(const std::string& name, const std::string& text) {
  std::printf("%-32s %s\n", name.c_str(), text.c_str());
}

void list_contexts() {
  for (const gl::ContextProbe& probe : gl::probe_contexts()) {
    row(probe.kind, probe.info ? "can be opened: " + probe.info->renderer + ", OpenGL " + probe.info->version
                               : "not here: " + probe.reason);
  }
}

void list_pipelines() {
  row("slices", "view-aligned textured slices, blended (OpenGL); the default");
  row("tessellated", "slices cut into triangles that carry a lens, or any warp, at their corners (OpenGL)");
  row("axis", "slices whose warp and effects are read from a 1D texture for each axis (OpenGL)");
  row("fragment", "slices whose warps are evaluated at each fragment (OpenGL)");
  row("grid", "slices whose warps are sampled into a 3D texture that each fragment looks up (OpenGL)");
  row("fixed-function", "tessellated, by the hardware path of 2001: no shaders, colours of 8 bits (OpenGL "
                        "compatibility profile)");
  row("rays", "a ray through each pixel in a fragment shader (OpenGL)");
  row("reference", "rays in double precision on the CPU: the truth to compare with");
}

void list_phantoms() {
  for (const PhantomInfo& phantom : phantoms())
    row(phantom.name, phantom.description + " (preset " + phantom.preset + ")");
}

void list_labels() {
  std::printf("label  value in organs  organ (phantoms organs-labels and organs)\n");
  for (const OrganInfo& organ : organs())
    std::printf("%5d  %15g  %s\n", organ.label, organ.value, organ.name.c_str());
}

void list_presets() {
  for (const PresetInfo& preset : presets())
    row(preset.name, preset.description +
                         (preset.relative ? " [relative to the data's range]" : " [" + preset.unit + "]"));
}

void list_keys() {
  for (const auto& [key, help] : list_scene_keys())
    row(key, help);
}

void list_lens_keys() {
  for (const auto& [key, help] : list_image_scene_keys())
    row(key, help);
}

void list_figures() {
  for (const EmbeddedFile& file : embedded_scenes())
    row(file.name, scene_from_json(file.text, file.name).title);
}

void list_warps() {
  for (const WarpInfo& warp : warp_infos())
    row(warp.kind, warp.description + "; pipelines " + join(warp.pipelines));
}

} // namespace

void run_list(const ListOptions& options) {
  const std::vector<std::pair<std::string, std::function<void()>>> lists = {
      {"contexts", list_contexts},   {"figures", list_figures},     {"keys", list_keys},
      {"labels", list_labels},       {"lens-keys", list_lens_keys}, {"phantoms", list_phantoms},
      {"pipelines", list_pipelines}, {"presets", list_presets},     {"warps", list_warps}};
  std::vector<std::string> names;
  for (const auto& [name, list] : lists) {
    if (name == options.what) {
      list();
      return;
    }
    names.push_back(name);
  }
  const std::string problem =
      options.what.empty() ? "list needs to know of what" : "there is no list of '" + options.what + "'";
  throw UsageError(problem + "; give one of " + join(names));
}

} // namespace cli

} // namespace slicelens
