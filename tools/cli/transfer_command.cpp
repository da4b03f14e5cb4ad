#include "console.h"
#include "core/errors.h"
#include "core/files.h"
#include "options.h"
#include "scene/camera_files.h"
#include "scene/load.h"
#include "scene/transfer_files.h"
#include "study/inputs.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>

namespace slicelens::cli {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// A transfer function to write, and the values that a table of it should span.
struct Source {
  TransferToWrite what;
  ValueRange span{0, 1};
};

/// By its name, and for .json, which scenes are too, by what it holds.
bool is_transfer_file(const std::string& input) {
  const auto format = transfer_format_of(input);
  if (format != TransferFormat::paraview_json)
    return format.has_value();
  const Json json = Json::parse(read_text(input), nullptr, false, true);
  return json.is_array() || (json.is_object() && (json.contains("RGBPoints") || json.contains("ColorSpace") ||
                                                  json.contains("IndexedColors")));
}

bool is_preset(const std::string& input) {
  return std::any_of(presets().begin(), presets().end(),
                     [&](const PresetInfo& info) { return info.name == input; });
}

void span_points(Source& source) {
  const auto& points = source.what.transfer.points;
  source.span = {points.front().value, points.back().value};
}

Source from_file(const TransferOptions& options, const std::optional<ValueRange>& range,
                 const Progress& progress) {
  const TransferFile file = read_transfer_file(options.input, options.map);
  TransferFile shown = file;
  if (file.display) { // kept by the formats that hold it
    std::erase_if(shown.ignored, [](const std::string& what) {
      return what.rfind("shading", 0) == 0 || what.rfind("gradient", 0) == 0 ||
             what.rfind("interpolation", 0) == 0;
    });
  }
  ReadTransfer read = transfer_of(shown, options.input, range);
  if (file.rows && !range)
    read.note += (read.note.empty() ? "" : "; ") +
                 std::string("the values are row numbers; stretch them with --range LOW,HIGH");
  if (!read.note.empty())
    report_warning(progress, options.input + ": " + read.note);
  Source source{{std::move(read.transfer), file.display}};
  span_points(source);
  return source;
}

Source from_preset(const TransferOptions& options, const std::optional<ValueRange>& range,
                   const Progress& progress) {
  const auto info = std::find_if(presets().begin(), presets().end(),
                                 [&](const PresetInfo& preset) { return preset.name == options.input; });
  if (info->relative && !range)
    report_warning(progress, options.input +
                                 ": is relative to the data's range; its values are written for 0 "
                                 "to 1, give --range LOW,HIGH");
  const ValueRange data = range.value_or(ValueRange(0, 1));
  Source source{{preset(options.input, data[0], data[1])}};
  span_points(source);
  return source;
}

Source from_scene(const TransferOptions& options, const Progress& progress) {
  const SceneInput input = scene_input(options.input, options.set);
  const std::size_t index = checked_volume(input.scene, options.volume);
  const LoadedVolume loaded = load_volume_of(input.scene, index, input.folders, progress);
  const Volume& volume = loaded.volume;
  Source source{{loaded.transfer, slicer_display(input.scene)}};
  const glm::dvec3& spacing = volume.spacing;
  if (transfer_format_of(options.output) == TransferFormat::slicer_json &&
      !source.what.transfer.unit_distance)
    source.what.transfer.unit_distance = std::min({spacing.x, spacing.y, spacing.z});
  source.span = table_range(volume, options.rows);
  return source;
}

std::string scene_section(const TransferFunction& transfer) {
  Json points = Json::array();
  for (const TransferPoint& p : transfer.points)
    points.push_back(Json::array({p.value, p.r, p.g, p.b, p.opacity}));
  Json section = {{"points", std::move(points)}};
  if (transfer.unit_distance)
    section["unit_distance"] = *transfer.unit_distance;
  return Json{{"transfer", std::move(section)}}.dump();
}

Json list_of(const glm::dvec3& v) { return Json::array({v.x, v.y, v.z}); }

std::string camera_section(const CameraSettings& camera) {
  const bool perspective = camera.projection == ProjectionName::perspective;
  Json section = {{"projection", perspective ? "perspective" : "orthographic"},
                  {"position", list_of(*camera.position)},
                  {"focal_point", list_of(*camera.focal_point)},
                  {"view_up", list_of(*camera.view_up)},
                  {"view_angle", camera.view_angle},
                  {"parallel_scale", *camera.parallel_scale}};
  return Json{{"camera", std::move(section)}}.dump();
}

} // namespace

void run_transfer(const TransferOptions& options) {
  std::optional<ValueRange> range;
  if (!options.range.empty()) {
    range = ValueRange(options.range.at(0), options.range.at(1));
    if (!((*range)[0] < (*range)[1]))
      throw UsageError("--range takes LOW,HIGH with the first below the second");
  }
  const Progress progress = console_progress();
  const bool file = is_transfer_file(options.input);
  if (!file && !options.map.empty())
    throw UsageError("--map names a colour map of a ParaView file, and " + options.input + " is none");
  const bool scene = !file && !is_preset(options.input);
  if (!options.set.empty() && !scene)
    throw UsageError("--set changes a scene, and " + options.input + " is none");
  if (options.volume != 0 && !scene)
    throw UsageError("--volume chooses among a scene's volumes, and " + options.input + " is none");
  Source source = file    ? from_file(options, range, progress)
                  : scene ? from_scene(options, progress)
                          : from_preset(options, range, progress);
  end_progress();
  if (options.output.empty()) {
    std::printf("%s\n", scene_section(source.what.transfer).c_str());
    return;
  }
  source.what.rows_range = range.value_or(source.span);
  source.what.rows = options.rows;
  const std::string lost = write_transfer_file(options.output, source.what);
  if (!lost.empty())
    report_warning(progress, options.output + ": " + lost);
  std::printf("%s\n", options.output.c_str());
}

void run_camera(const CameraOptions& options) {
  const SceneInput input = scene_input(options.input, options.set);
  const Progress progress = console_progress();
  const Volume volume = load_volume(input.scene.volume, input.folders, progress);
  Scene scene = input.scene;
  load_camera_file(scene, input.folders, progress);
  const CameraSettings camera = explicit_camera(scene.camera, box_of(volume));
  end_progress();
  if (options.output.empty()) {
    std::printf("%s\n", camera_section(camera).c_str());
    return;
  }
  write_camera_file(options.output, camera);
  std::printf("%s\n", options.output.c_str());
}

} // namespace slicelens::cli
