#include "render/uniforms.h"

namespace slicelens {

std::vector<std::string> common_macros(const PreparedScene& prepared) {
  const RenderSettings& render = prepared.scene.render;
  std::vector<std::string> macros;
  if (render.filter == Filter::linear_exact)
    macros.emplace_back("FILTER_LINEAR_EXACT");
  switch (render.mode) {
  case Mode::dvr:
    macros.emplace_back("MODE_DVR");
    break;
  case Mode::mip:
    macros.emplace_back("MODE_MIP");
    break;
  case Mode::xray:
    macros.emplace_back("MODE_XRAY");
    break;
  }
  if (render.shading == Shading::diffuse) {
    macros.emplace_back("SHADING_DIFFUSE");
    macros.emplace_back(render.gradient == Gradient::forward ? "GRADIENT_FORWARD" : "GRADIENT_CENTRAL");
    if (!prepared.scene.light.direction)
      macros.emplace_back("LIGHT_AT_EYE");
  }
  if (prepared.view.projection == Projection::perspective)
    macros.emplace_back("PERSPECTIVE");
  switch (correction_of(prepared)) {
  case Correction::none:
    break;
  case Correction::constant:
    macros.emplace_back("CORRECT_CONSTANT");
    break;
  case Correction::per_fragment:
    macros.emplace_back("CORRECT_FRAGMENT");
    break;
  }
  return macros;
}

void set_common_uniforms(const gl::Functions& gl, const gl::Program& program, const PreparedScene& prepared,
                         const GpuScene& scene) {
  const Volume& volume = prepared.volume;
  const LightSettings& light = prepared.scene.light;
  gl.ActiveTexture(GL_TEXTURE0);
  gl.BindTexture(GL_TEXTURE_3D, scene.volume.name());
  gl.ActiveTexture(GL_TEXTURE1);
  gl.BindTexture(GL_TEXTURE_1D, scene.transfer.name());
  set_uniform(gl, program, "volume_texture", 0);
  set_uniform(gl, program, "transfer_texture", 1);
  set_uniform(gl, program, "value_from_texel", scene.value_from_texel);
  set_uniform(gl, program, "transfer_from_value", scene.transfer_from_value);
  set_uniform(gl, program, "transfer_from_texel", scene.transfer_from_texel);
  set_uniform(gl, program, "voxel",
              glm::vec3(1.0 / glm::dvec3(volume.dims[0], volume.dims[1], volume.dims[2])));
  const glm::dmat3 world_from_texture(prepared.box.world_from_texture);
  set_uniform(gl, program, "world_from_gradient",
              glm::mat3(glm::transpose(glm::inverse(world_from_texture))));
  set_uniform(gl, program, "to_light", glm::vec3(light_direction(prepared, -prepared.view.forward)));
  set_uniform(gl, program, "ambient", static_cast<float>(light.ambient));
  set_uniform(gl, program, "diffuse", static_cast<float>(light.diffuse));
  set_uniform(gl, program, "two_sided", light.two_sided ? 1 : 0);
  set_uniform(gl, program, "to_eye_axis", glm::vec3(-prepared.view.forward));
  set_uniform(gl, program, "distance_ratio",
              static_cast<float>(prepared.scene.render.opacity_correction == OpacityCorrection::none
                                     ? 1
                                     : axis_distance_ratio(prepared)));
}

} // namespace slicelens
