#include "console.h"
#include "core/errors.h"
#include "core/files.h"
#include "core/text.h"
#include "options.h"
#include "render/probe.h"
#include "study/inputs.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>

namespace slicelens::cli {

namespace {

using Json = nlohmann::ordered_json;

Json list_of(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

/// A sample in every space (docs/spaces.md); view space is right-handed and looks down −z.
Json hit_json(const PreparedScene& prepared, const std::vector<ProbeSample>& samples,
              const std::optional<std::size_t>& index) {
  if (!index)
    return nullptr;
  const ProbeSample& sample = samples[*index];
  const View& view = prepared.view;
  const glm::dvec3 world = world_from_texture(prepared.box, sample.object);
  const glm::dvec3 from_eye = world - view.eye;
  const auto& n = prepared.volume.dims;
  Json json = Json::object();
  json["sample"] = *index;
  json["distance"] = sample.distance;
  json["view"] = list_of(
      {glm::dot(from_eye, view.right), glm::dot(from_eye, view.up), -glm::dot(from_eye, view.forward)});
  json["world"] = list_of(world);
  json["object"] = list_of(sample.object);
  json["texture"] = list_of(sample.texture);
  json["voxel"] = list_of(sample.texture * glm::dvec3(n[0], n[1], n[2]) - 0.5);
  json["value"] = sample.value;
  json["opacity"] = sample.opacity;
  json["gradient"] = sample.gradient;
  return json;
}

std::string profile_csv(const std::vector<ProbeSample>& samples, double ratio) {
  std::string text = "distance,object_x,object_y,object_z,texture_x,texture_y,texture_z,inside,value,opacity,"
                     "gradient,accumulated\n";
  double sum = 0;
  for (const ProbeSample& s : samples) {
    sum += s.inside ? s.opacity * ratio : 0;
    for (const double number :
         {s.distance, s.object.x, s.object.y, s.object.z, s.texture.x, s.texture.y, s.texture.z})
      text += number_text(number) + ",";
    text += s.inside ? "1," : "0,";
    text += number_text(s.value) + "," + number_text(s.opacity) + "," + number_text(s.gradient) + "," +
            number_text(sum) + "\n";
  }
  return text;
}

/// What a probe needs: the exact maps at each sample, values and not colours, one texture.
void use_probe_settings(RenderSettings& render, bool warped) {
  render.pipeline = warped ? Pipeline::fragment : Pipeline::slices;
  render.mode = Mode::dvr;
  render.shading = Shading::none;
  render.classification = Classification::post;
  render.tiles = {1, 1, 1};
  render.levels = 1;
  render.footprint = Footprint::point;
}

bool is_warped_scene(const Scene& scene) {
  return !scene.warp.empty() || std::any_of(scene.others.begin(), scene.others.end(),
                                            [](const VolumeLayer& layer) { return !layer.warp.empty(); });
}

} // namespace

void run_pick(const PickOptions& options) {
  SceneInput input = scene_input(options.input, options.set);
  hold_voxels(input, "slicelens pick");
  const auto& size = input.scene.render.size;
  const double x = options.at[0];
  const double y = options.at[1];
  if (!(x >= 0 && x <= static_cast<double>(size[0]) && y >= 0 && y <= static_cast<double>(size[1]))) {
    throw UsageError("--at " + number_text(x) + "," + number_text(y) + " lies outside the picture of " +
                     std::to_string(size[0]) + " x " + std::to_string(size[1]) +
                     " pixels; (0,0) is its top left corner");
  }
  const std::size_t index = checked_volume(input.scene, options.volume);
  use_probe_settings(input.scene.render, is_warped_scene(input.scene));
  PreparedScene all = load(input, console_progress());
  const PreparedScene prepared = one_volume(std::move(all), index);
  end_progress();
  const std::optional<ProbeLine> line = probe_line(prepared, x, y);
  Json json = Json::object();
  json["at"] = {x, y};
  if (volume_count(input.scene) > 1)
    json["volume"] = index;
  std::vector<ProbeSample> samples;
  double ratio = 0;
  if (line) {
    OpenContext context;
    open_context(context, prepared.scene);
    const int count = options.samples.value_or(probe_sample_count(prepared, *line));
    samples = sample_line(prepared, *context.context, *line, count);
    const double distance = (line->far - line->near) / count;
    ratio = distance / prepared.unit_distance;
    json["samples"] = count;
    json["sample_distance"] = distance;
  } else {
    json["samples"] = 0;
  }
  const double threshold = gradient_threshold(prepared);
  json["gradient_threshold"] = threshold;
  json["alpha"] = hit_json(prepared, samples, first_visible(samples));
  json["gradient"] = hit_json(prepared, samples, first_gradient(samples, threshold));
  json["accumulated"] = hit_json(prepared, samples, first_accumulated(samples, ratio));
  if (!options.profile.empty())
    write_text_atomically(options.profile, profile_csv(samples, ratio));
  std::printf("%s\n", json.dump(2, ' ', true, nlohmann::ordered_json::error_handler_t::replace).c_str());
}

} // namespace slicelens::cli
