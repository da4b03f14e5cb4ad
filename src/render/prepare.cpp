#include "render/prepare.h"

#include "core/errors.h"
#include "scene/camera.h"

namespace slicelens {

PreparedScene prepare(Scene scene, Volume volume, TransferFunction transfer) {
  PreparedScene prepared;
  prepared.scene = std::move(scene);
  prepared.volume = std::move(volume);
  prepared.transfer = std::move(transfer);
  if (prepared.volume.components != 1)
    throw UsageError("a volume of several components cannot be drawn; choose volume.component");
  prepare_again(prepared);
  return prepared;
}

void prepare_again(PreparedScene& prepared) {
  const Scene& scene = prepared.scene;
  const double h = smallest_spacing(prepared.volume);
  prepared.box = box_of(prepared.volume);
  prepared.view = make_view(scene.camera, prepared.box, static_cast<int>(scene.render.size[0]),
                            static_cast<int>(scene.render.size[1]));
  prepared.spacing = scene.render.spacing * h;
  prepared.unit_distance = prepared.transfer.unit_distance.value_or(h);
  prepared.xray_scale =
      scene.render.xray_scale.value_or(prepared.unit_distance / (2 * bounding_radius(prepared.box)));
  prepared.clip.clear();
  for (const ClipSettings& plane : scene.clip) {
    const Plane world{plane.normal, glm::dot(plane.normal, world_from_texture(prepared.box, plane.point))};
    prepared.clip.push_back(pull_back(world, prepared.box.world_from_texture));
  }
}

double axis_distance_ratio(const PreparedScene& prepared) {
  return prepared.spacing / prepared.unit_distance;
}

Correction correction_of(const PreparedScene& prepared) {
  const RenderSettings& render = prepared.scene.render;
  if (render.opacity_correction == OpacityCorrection::none)
    return Correction::none;
  if (render.opacity_correction == OpacityCorrection::fragment && render.pipeline == Pipeline::slices &&
      prepared.view.projection == Projection::perspective) {
    return Correction::per_fragment;
  }
  return axis_distance_ratio(prepared) == 1 ? Correction::none : Correction::constant;
}

glm::dvec3 light_direction(const PreparedScene& prepared, const glm::dvec3& to_eye) {
  const auto& direction = prepared.scene.light.direction;
  return direction ? glm::normalize(*direction) : to_eye;
}

} // namespace slicelens
