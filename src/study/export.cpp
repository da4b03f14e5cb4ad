#include "study/export.h"

#include "core/errors.h"
#include "core/files.h"
#include "scene/camera_files.h"
#include "scene/names.h"
#include "volume/streamed.h"

#include <nlohmann/json.hpp>

#include <bit>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>
#include <utility>
#include <vector>

namespace slicelens {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

Json list_of(const glm::dvec3& v) { return Json::array({v.x, v.y, v.z}); }

bool draws_over(const OverlaySettings& overlay) {
  return overlay.wireframe != Wireframe::none || overlay.outline || overlay.lattice > 0 ||
         overlay.magnification > 0 || overlay.stack > 0 || overlay.landmarks > 0 || is_annotated(overlay);
}

Json camera_of(const PreparedScene& prepared) {
  const CameraSettings camera = explicit_camera(prepared.scene.camera, prepared.box);
  return {{"projection", word(camera.projection)},
          {"position", list_of(*camera.position)},
          {"focal_point", list_of(*camera.focal_point)},
          {"view_up", list_of(*camera.view_up)},
          {"view_angle", camera.view_angle},
          {"parallel_scale", *camera.parallel_scale}};
}

Json volume_of(const Volume& volume) {
  const glm::dmat3& axes = volume.direction;
  return {{"file", "volume.raw"},
          {"type", name_of(volume.type)},
          {"endian", std::endian::native == std::endian::little ? "little" : "big"},
          {"dims", volume.dims},
          {"spacing", list_of(volume.spacing)},
          {"origin", list_of(volume.origin)},
          {"direction", Json::array({list_of(axes[0]), list_of(axes[1]), list_of(axes[2])})},
          {"range", Json::array({volume.min, volume.max})}};
}

Json transfer_json(const PreparedScene& prepared) {
  Json nodes = Json::array();
  for (const TransferPoint& p : prepared.transfer.points)
    nodes.push_back(Json::array({p.value, p.r, p.g, p.b, p.opacity}));
  return {{"nodes", std::move(nodes)}, {"unit_distance", prepared.unit_distance}};
}

Json render_of(const PreparedScene& prepared) {
  const RenderSettings& render = prepared.scene.render;
  const glm::dvec4& background = render.background;
  return {{"mode", word(render.mode)},
          {"size", render.size},
          {"spacing", prepared.spacing},
          {"shading", word(render.shading)},
          {"gradient", word(render.gradient)},
          {"filter", word(render.filter)},
          {"background", Json::array({background.x, background.y, background.z, background.w})},
          {"isovalue", isovalue_of(prepared)},
          {"xray_scale", prepared.xray_scale}};
}

Json light_of(const LightSettings& light) {
  return {{"direction", light.direction ? list_of(glm::normalize(*light.direction)) : Json("camera")},
          {"ambient", light.ambient},
          {"diffuse", light.diffuse},
          {"specular", light.specular},
          {"power", light.power},
          {"two_sided", light.two_sided},
          {"cool", list_of(light.cool)},
          {"warm", list_of(light.warm)}};
}

void write_voxels(const Volume& volume, const fs::path& temporary, const fs::path& path) {
  std::ofstream out(temporary, std::ios::binary);
  out.write(reinterpret_cast<const char*>(volume.voxels.data()),
            static_cast<std::streamsize>(voxel_bytes(volume)));
  out.close();
  if (!out)
    throw FileError(path.string(), std::string("cannot be written: ") + std::strerror(errno));
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  if (fs::is_directory(folder, error))
    return;
  if (fs::exists(folder, error))
    throw FileError(folder.string(), "is a file; give the name of a folder to export to");
  if (!fs::create_directory(folder, error) || error)
    throw FileError(folder.string(), "the folder cannot be made" + (error ? ": " + error.message() : ""));
}

} // namespace

void require_exportable(const Scene& scene) {
  const RenderSettings& render = scene.render;
  const std::pair<bool, const char*> rules[] = {
      {!scene.others.empty(), "volumes: only one volume can be exported"},
      {!scene.warp.empty(),
       "warp: a deformation cannot be exported (slicelens warp writes the deformed volume)"},
      {scene.volume.labels || render.mode == Mode::two_level || !scene.labels.empty(),
       "volume.labels: labels cannot be exported"},
      {!scene.clip.empty(), "clip: clipping planes cannot be exported"},
      {scene.crop.has_value(), "crop: a cropped volume cannot be exported"},
      {scene.highlight.function != HighlightFunction::off, "highlight: effects cannot be exported"},
      {scene.attenuation.function != AttenuationFunction::off, "attenuation: effects cannot be exported"},
      {!scene.planes.empty(), "planes: cutting planes cannot be exported"},
      {draws_over(scene.overlay), "overlay: what is drawn over the picture cannot be exported"},
      {!scene.transfer.shapes.empty(),
       "transfer.shapes: a transfer function of value and gradient cannot be exported; give transfer.points"},
      {render.modulate_by_gradient.has_value(),
       "render.modulate_by_gradient: opacities that follow the gradient cannot be exported"},
      {render.jitter > 0, "render.jitter: jittered samples cannot be exported; set it to 0"},
      {render.classification != Classification::post, "render.classification: only 'post' can be exported, "
                                                      "values that are classified where they are sampled"},
      {render.opacity_correction == OpacityCorrection::none,
       "render.opacity_correction: 'none' cannot be exported; give 'fragment'"},
      {render.footprint != Footprint::point,
       "render.footprint: a pyramid cannot be exported; set it to 'point'"}};
  for (const auto& [refused, message] : rules) {
    if (refused)
      throw UsageError(message);
  }
}

std::string exported_camera(const PreparedScene& prepared) { return camera_of(prepared).dump(); }

void write_export(const PreparedScene& prepared, const fs::path& folder) {
  if (!prepared.volume.colors.rgba.empty())
    throw UsageError("volume.file: a volume of colours cannot be exported; choose volume.component");
  require_exportable(prepared.scene);
  require_voxels(prepared.volume, "an export");
  const Json scene = {{"format", "slicelens-export"},        {"version", 1},
                      {"title", prepared.scene.title},       {"volume", volume_of(prepared.volume)},
                      {"transfer", transfer_json(prepared)}, {"camera", camera_of(prepared)},
                      {"render", render_of(prepared)},       {"light", light_of(prepared.scene.light)}};
  const std::string text = scene.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
  make_folder(folder);
  const fs::path voxels = folder / "volume.raw";
  write_atomically(voxels, [&](const fs::path& temporary) {
    write_voxels(prepared.volume, temporary, voxels);
    write_text_atomically(folder / "scene.json", text); // last of all that may fail for want of space
  });
}

} // namespace slicelens
