#include "render/uniforms.h"

#include "render/grid_textures.h"
#include "render/label_textures.h"
#include "render/several_volumes.h"
#include "render/stack_geometry.h"
#include "render/tiled_draw.h"
#include "scene/names.h"

#include <algorithm>
#include <cctype>

namespace slicelens {

namespace {

std::string upper_case(std::string text) {
  for (char& c : text)
    c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

/// Whether one of several volumes is classified by its gradient.
bool any_shapes(const PreparedScene& prepared) {
  return std::any_of(prepared.others.begin(), prepared.others.end(),
                     [](const PreparedScene& other) { return uses_gradients(other.scene); });
}

void add_shading_macros(const PreparedScene& prepared, std::vector<std::string>& macros) {
  const RenderSettings& render = prepared.scene.render;
  if (!uses_gradients(prepared.scene) && !any_shapes(prepared))
    return;
  if (!prepared.scene.transfer.shapes.empty())
    macros.emplace_back("TRANSFER_2D");
  if (render.modulate_by_gradient)
    macros.emplace_back("MODULATED");
  if (render.shading != Shading::none) {
    macros.emplace_back("SHADED");
    macros.push_back("SHADING_" + upper_case(word(render.shading)));
  }
  macros.emplace_back("GRADIENTS");
  macros.push_back("GRADIENT_" + upper_case(word(render.gradient)));
  if (reads_value_with_gradient(prepared))
    macros.emplace_back("VALUE_WITH_GRADIENT");
  if (prepared.gradient_space == GradientSpace::object)
    macros.emplace_back("GRADIENT_IN_OBJECT_SPACE");
  if (!prepared.scene.light.direction)
    macros.emplace_back("LIGHT_AT_EYE");
}

} // namespace

std::vector<std::string> common_macros(const PreparedScene& prepared) {
  const RenderSettings& render = prepared.scene.render;
  std::vector<std::string> macros;
  if (render.filter == Filter::linear_exact)
    macros.emplace_back("FILTER_LINEAR_EXACT");
  if (render.filter == Filter::cubic)
    macros.emplace_back("FILTER_CUBIC");
  if (render.classification == Classification::pre)
    macros.emplace_back("CLASSIFICATION_PRE");
  if (render.classification == Classification::preintegrated)
    macros.emplace_back("PREINTEGRATED");
  if (is_paged(prepared))
    macros.emplace_back("PAGED");
  if (is_paged(prepared) || is_bricked(prepared))
    macros.push_back("LEVELS " + std::to_string(prepared.levels));
  if (render.footprint == Footprint::mip && prepared.levels > 1)
    macros.emplace_back("FOOTPRINT");
  switch (render.mode) {
  case Mode::dvr:
    macros.emplace_back("MODE_DVR");
    break;
  case Mode::mip:
    macros.emplace_back("MODE_MIP");
    break;
  case Mode::minip:
    macros.insert(macros.end(), {"MODE_MIP", "MODE_MINIP"});
    break;
  case Mode::average:
    macros.insert(macros.end(), {"MODE_MIP", "MODE_AVERAGE"});
    break;
  case Mode::two_level:
    macros.insert(macros.end(), {"MODE_DVR", "LABELS"});
    if (has_local_modes(prepared.labels))
      macros.emplace_back("LOCAL_MODES");
    break;
  case Mode::iso:
    macros.emplace_back("MODE_ISO");
    break;
  case Mode::xray:
    macros.emplace_back("MODE_XRAY");
    break;
  }
  add_shading_macros(prepared, macros);
  if (prepared.view.projection == Projection::perspective)
    macros.emplace_back("PERSPECTIVE");
  if (render.proxy == Proxy::shells)
    macros.emplace_back("SHELLS");
  if (render.pipeline == Pipeline::axis) {
    macros.emplace_back("AXIS_TABLES");
    if (is_unmasked(prepared.tables))
      macros.emplace_back("AXIS_UNMASKED");
    else if (prepared.tables.mask == AxisMask::weight)
      macros.emplace_back("AXIS_WEIGHTS");
  } else if (is_warped(prepared)) {
    macros.emplace_back("WARPED");
    if (render.pipeline == Pipeline::tessellated)
      macros.emplace_back("WARP_TESSELLATED");
    if (is_subdivided(prepared))
      macros.emplace_back("WARP_SUBDIVIDED");
    if (render.pipeline == Pipeline::fragment || render.pipeline == Pipeline::grid)
      macros.emplace_back("WARP_FRAGMENT");
  }
  if (has_highlight(prepared.effects))
    macros.emplace_back("HIGHLIGHT");
  if (has_attenuation(prepared.effects))
    macros.emplace_back("ATTENUATION");
  if ((is_warped(prepared) || !prepared.others.empty()) && !prepared.data_clip.empty())
    macros.emplace_back("DATA_PLANES");
  if (render.jitter > 0)
    macros.emplace_back("JITTER");
  for (std::string& macro : volume_macros(prepared))
    macros.push_back(std::move(macro));
  macros.push_back("MAX_CLIP_PLANES " +
                   std::to_string(1 + prepared.data_clip.size() + prepared.object_clip.size()));
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

std::vector<glm::vec4> plane_vectors(const std::vector<Plane>& planes) {
  std::vector<glm::vec4> vectors;
  for (const Plane& plane : planes)
    vectors.emplace_back(plane.normal, -plane.offset);
  return vectors;
}

void set_warp_uniforms(const gl::Functions& gl, const gl::Uniforms& program, const PreparedScene& prepared,
                       const TextureUnits& units) {
  if (prepared.scene.render.pipeline != Pipeline::axis)
    set_warp_maps(gl, program, drawn_maps(prepared), prepared.space, units.grids);
  const std::vector<glm::vec4> planes = plane_vectors(prepared.data_clip);
  set_uniform(gl, program, "data_plane_count", static_cast<int>(planes.size()));
  if (!planes.empty())
    set_uniform(gl, program, "data_planes", std::span<const glm::vec4>(planes));
}

void set_axis_tables(const gl::Functions& gl, const gl::Program& program, const AxisTextures& tables) {
  const std::array<const char*, 3> names = {"axis_table_x", "axis_table_y", "axis_table_z"};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    gl.ActiveTexture(GL_TEXTURE0 + axis_unit + static_cast<GLenum>(axis));
    gl.BindTexture(GL_TEXTURE_1D, tables[axis].name());
    set_uniform(gl, program, names[axis], static_cast<int>(axis_unit + axis));
  }
}

void set_shading_uniforms(const gl::Functions& gl, const gl::Uniforms& program, const PreparedScene& prepared,
                          const GradientTexture& gradients, GLenum unit) {
  if (gradients.texture) {
    gl.ActiveTexture(GL_TEXTURE0 + unit);
    gl.BindTexture(GL_TEXTURE_3D, gradients.texture.name());
    set_uniform(gl, program, "gradient_texture", static_cast<int>(unit));
  }
  set_uniform(gl, program, "voxel", gradients.voxel);
  set_uniform(gl, program, "gradient_scale", gradients.scale);
  const glm::dmat3 world_from_texture(prepared.box.world_from_texture);
  set_uniform(gl, program, "world_from_gradient",
              glm::mat3(glm::transpose(glm::inverse(world_from_texture))));
  set_uniform(gl, program, "full_gradient",
              static_cast<float>(prepared.scene.render.modulate_by_gradient.value_or(1)));
  const LightSettings& light = prepared.scene.light;
  set_uniform(gl, program, "to_light", glm::vec3(light_direction(prepared, -prepared.view.forward)));
  set_uniform(gl, program, "ambient", static_cast<float>(light.ambient));
  set_uniform(gl, program, "diffuse", static_cast<float>(light.diffuse));
  set_uniform(gl, program, "specular", static_cast<float>(light.specular));
  set_uniform(gl, program, "power", static_cast<float>(light.power));
  set_uniform(gl, program, "cool", glm::vec3(light.cool));
  set_uniform(gl, program, "warm", glm::vec3(light.warm));
  set_uniform(gl, program, "two_sided", light.two_sided ? 1 : 0);
}

void set_volume_uniforms(const gl::Functions& gl, const gl::Uniforms& program, const PreparedScene& prepared,
                         const GpuScene& scene, const TextureUnits& units) {
  set_warp_uniforms(gl, program, prepared, units);
  bind_grids(gl, scene.grids, units.grids);
  if (scene.pool) {
    scene.pool->bind(gl, program, units.volume, units.pages);
  } else {
    gl.ActiveTexture(GL_TEXTURE0 + units.volume);
    gl.BindTexture(GL_TEXTURE_3D, scene.volume.name());
    set_uniform(gl, program, "volume_texture", static_cast<int>(units.volume));
  }
  gl.ActiveTexture(GL_TEXTURE0 + units.transfer);
  gl.BindTexture(GL_TEXTURE_1D, scene.transfer.name());
  set_uniform(gl, program, "transfer_texture", static_cast<int>(units.transfer));
  if (scene.transfer_2d) {
    gl.ActiveTexture(GL_TEXTURE0 + units.transfer_2d);
    gl.BindTexture(GL_TEXTURE_2D, scene.transfer_2d.name());
    set_uniform(gl, program, "transfer_2d_texture", static_cast<int>(units.transfer_2d));
    set_uniform(gl, program, "transfer_2d_place", scene.transfer_2d_place);
  }
  set_uniform(gl, program, "value_from_texel", scene.value_from_texel);
  set_uniform(gl, program, "transfer_from_value", scene.transfer_from_value);
  set_uniform(gl, program, "transfer_from_texel", scene.transfer_from_texel);
  set_shading_uniforms(gl, program, prepared, scene.gradients, units.gradient);
}

/// What shaders/gpu/region.glsl and step.glsl declare, and the settings of iso and jitter.
void set_sample_uniforms(const gl::Functions& gl, const gl::Program& program, const PreparedScene& prepared) {
  const RenderSettings& render = prepared.scene.render;
  set_uniform(gl, program, "object_low", glm::vec3(prepared.object_low));
  set_uniform(gl, program, "object_high", glm::vec3(prepared.object_high));
  // Under a warp a straight ray leaves and enters the data's half-spaces more than once: gpu/warp.glsl tests
  // each sample.
  std::vector<glm::vec4> planes = plane_vectors(prepared.object_clip);
  if (!is_warped(prepared)) {
    for (const glm::vec4& plane : plane_vectors(prepared.data_clip))
      planes.push_back(plane);
  }
  set_uniform(gl, program, "clip_count", static_cast<int>(planes.size()));
  if (!planes.empty())
    set_uniform(gl, program, "clip_planes", std::span<const glm::vec4>(planes));
  set_uniform(gl, program, "isovalue", static_cast<float>(isovalue_of(prepared)));
  set_uniform(gl, program, "jitter", static_cast<float>(render.jitter));
  set_uniform(gl, program, "jitter_seed", static_cast<int>(render.jitter_seed));
  const View& view = prepared.view;
  const glm::dmat4& world_from_texture = prepared.box.world_from_texture;
  const glm::dmat4 texture_from_world = slicelens::texture_from_world(prepared.box);
  set_uniform(gl, program, "sample_step",
              glm::vec3(-prepared.spacing * (glm::dmat3(texture_from_world) * view.forward)));
  set_uniform(gl, program, "eye_place", glm::vec3(texture_from_world * glm::dvec4(view.eye, 1)));
  const glm::dvec3 slope = glm::transpose(glm::dmat3(world_from_texture)) * view.forward;
  set_uniform(
      gl, program, "step_of_depth",
      glm::vec4(glm::dvec4(slope, depth(view, glm::dvec3(world_from_texture[3]))) / prepared.spacing));
}

void set_common_uniforms(const gl::Functions& gl, const gl::Program& program, const PreparedScene& prepared,
                         const GpuScene& scene) {
  if (prepared.others.empty())
    set_volume_uniforms(gl, program, prepared, scene);
  else
    set_volumes(gl, program, prepared, scene);
  set_sample_uniforms(gl, program, prepared);
  if (scene.labels.table)
    set_labels(gl, program, scene.labels, scene.pool ? scene.pool->labels() : scene.labels.labels);
  if (has_highlight(prepared.effects) || has_attenuation(prepared.effects))
    set_struct(gl, program, "effects", prepared.effects);
  if (scene.axis[0])
    set_axis_tables(gl, program, scene.axis);
  if (scene.segments) {
    gl.ActiveTexture(GL_TEXTURE0 + segment_unit);
    gl.BindTexture(GL_TEXTURE_2D, scene.segments.name());
    set_uniform(gl, program, "segment_texture", static_cast<int>(segment_unit));
    set_uniform(gl, program, "segment_from_texel", scene.segment_from_texel);
  }
  if (!scene.bricks.empty() || scene.pool) {
    set_uniform(gl, program, "log_zoom", static_cast<float>(prepared.log_zoom));
    const auto& dims = prepared.volume.dims;
    set_uniform(gl, program, "volume_voxels", glm::vec3(dims[0], dims[1], dims[2]));
    set_uniform(gl, program, "sample_steps", glm::mat3(prepared.steps.at_unit));
    set_uniform(gl, program, "sample_step_scale", glm::vec4(prepared.steps.scale));
  }
  if (!scene.bricks.empty()) {
    set_level_samplers(gl, program, scene);
    bind_tile(gl, program, scene, 0);
  }
  set_uniform(gl, program, "to_eye_axis", glm::vec3(-prepared.view.forward));
  set_uniform(gl, program, "distance_ratio",
              static_cast<float>(prepared.scene.render.opacity_correction == OpacityCorrection::none
                                     ? 1
                                     : axis_distance_ratio(prepared)));
}

} // namespace slicelens
