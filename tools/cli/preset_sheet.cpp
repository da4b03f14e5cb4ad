#include "preset_sheet.h"

#include "image/pictures.h"
#include "scene/load.h"
#include "scene/scene_json.h"
#include "volume/phantom.h"

#include <map>

namespace slicelens::cli {

std::string preset_scene(const PresetInfo& preset) {
  const bool xray = preset.name.find("X-ray") != std::string::npos;
  const bool mip = preset.name.find("MIP") != std::string::npos;
  const std::string mode = xray  ? R"("mode": "xray", "xray_scale": 0.3)"
                           : mip ? R"("mode": "mip")"
                                 : R"("shading": "diffuse")";
  return R"({ "volume": { "phantom": ")" + std::string(preset.relative ? "head-mr" : "head") +
         R"(", "size": [128, 128, 128] }, "transfer": { "preset": ")" + preset.name +
         R"(" }, "camera": { "azimuth": 30, "elevation": 10, "zoom": 1.5 }, "render": { "size": [160, 160], "spacing": 0.5, )" +
         mode + " } }";
}

Image preset_sheet(OpenContext& context, const Progress& progress) {
  std::map<std::string, Volume> heads;
  std::vector<Image> tiles;
  std::vector<std::string> captions;
  for (const PresetInfo& preset : presets()) {
    if (!preset.relative && preset.unit != "HU")
      continue; // of another phantom's values
    const Scene scene = scene_from_json(preset_scene(preset), preset.name);
    Volume& head = heads[*scene.volume.phantom];
    if (head.voxels.empty())
      head = load_volume(scene.volume, {}, progress);
    TransferFunction transfer = transfer_of(scene, head);
    PreparedScene prepared = prepare(scene, std::move(head), std::move(transfer));
    tiles.push_back(render_with(context, prepared, progress).image);
    head = std::move(prepared.volume);
    captions.push_back(preset.name);
  }
  constexpr int columns = 7;
  return contact_sheet(tiles, captions, columns, 4, glm::vec3(0.06F));
}

} // namespace slicelens::cli
