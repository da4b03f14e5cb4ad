#include "render/cut_planes.h"

#include "core/errors.h"
#include "render/shaders.h"
#include "render/stack_geometry.h"
#include "render/uniforms.h"
#include "render/warp_glsl.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>

namespace slicelens {

namespace {

Plane place_of(const PreparedScene& prepared, const PlaneSettings& plane) {
  const Plane world{plane.normal, glm::dot(plane.normal, world_from_texture(prepared.box, plane.point))};
  return pull_back(world, prepared.box.world_from_texture);
}

/// Upwards on a picture of a plane: world +z, or +y for planes that lie flat.
glm::dvec3 up_on(const glm::dvec3& normal) {
  const glm::dvec3 up = std::abs(normal.z) < 0.99 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, -1, 0);
  return glm::normalize(up - glm::dot(up, normal) * normal);
}

} // namespace

std::vector<CutPlane> cut_planes(const PreparedScene& prepared) {
  std::vector<CutPlane> planes;
  for (const PlaneSettings& settings : prepared.scene.planes) {
    const glm::dvec2 range = settings.range.value_or(glm::dvec2(prepared.volume.min, prepared.volume.max));
    const double length = range.y > range.x ? range.y - range.x : 1;
    planes.push_back({place_of(prepared, settings),
                      settings.style == PlaneStyle::transfer,
                      {1 / length, -range.x / length}});
  }
  return planes;
}

Polygon plane_polygon(const PreparedScene& prepared, const Plane& plane) {
  const glm::dvec3 size = prepared.object_high - prepared.object_low;
  const glm::dmat4 texture_from_region = glm::scale(glm::translate(glm::dmat4(1), prepared.object_low), size);
  Polygon polygon = cut_unit_cube(pull_back(plane, texture_from_region));
  for (glm::dvec3& corner : polygon)
    corner = prepared.object_low + corner * size;
  return polygon;
}

CameraSettings camera_of_plane(const PreparedScene& prepared, const PlaneSettings& plane, double aspect) {
  const Polygon polygon = plane_polygon(prepared, place_of(prepared, plane));
  if (polygon.empty()) {
    throw UsageError("the plane misses the displayed volume; its point is given in texture coordinates, "
                     "[0.5,0.5,0.5] is the middle");
  }
  const glm::dvec3 normal = glm::normalize(plane.normal);
  const glm::dvec3 up = up_on(normal);
  const glm::dvec3 right = glm::cross(up, normal);
  const glm::dvec3 origin = world_from_texture(prepared.box, plane.point);
  glm::dvec2 low(1e300);
  glm::dvec2 high(-1e300);
  for (const glm::dvec3& corner : polygon) {
    const glm::dvec3 world = world_from_texture(prepared.box, corner) - origin;
    const glm::dvec2 at(glm::dot(world, right), glm::dot(world, up));
    low = glm::min(low, at);
    high = glm::max(high, at);
  }
  const glm::dvec2 middle = 0.5 * (low + high);
  CameraSettings camera;
  camera.focal_point = origin + middle.x * right + middle.y * up;
  camera.position = *camera.focal_point + 2 * bounding_radius(prepared.box) * normal;
  camera.view_up = up;
  camera.parallel_scale = 0.5 * std::max(high.y - low.y, (high.x - low.x) / aspect);
  return camera;
}

ClipSettings clip_everything(const PreparedScene& prepared) {
  // Far beyond the last corner, facing away.
  return {glm::dvec3(100), glm::dmat3(prepared.box.world_from_texture) * glm::dvec3(1), ClipSpace::object};
}

void set_plane(const gl::Functions& gl, const gl::Program& program, const std::string& name,
               const CutPlane& plane) {
  set_uniform(gl, program, (name + ".place").c_str(), glm::vec4(plane.place.normal, -plane.place.offset));
  set_uniform(gl, program, (name + ".classified").c_str(), plane.classified ? 1 : 0);
  set_uniform(gl, program, (name + ".grey").c_str(), glm::vec2(plane.grey));
}

PlaneRenderer::PlaneRenderer(const gl::Functions& gl, const PreparedScene& prepared)
    : gl_(&gl), planes_(cut_planes(prepared)) {
  std::vector<std::string> macros = common_macros(prepared);
  std::erase(macros, "WARP_TESSELLATED"); // polygons have no lens of their own: the exact map
  std::vector<gl::ShaderSource> stages = shader_stage(GL_VERTEX_SHADER, "slices.vert", macros);
  const auto fragment =
      shader_stage(GL_FRAGMENT_SHADER, "plane.frag", macros, {warp_chain(drawn_maps(prepared))});
  stages.insert(stages.end(), fragment.begin(), fragment.end());
  program_ = gl::make_program(gl, stages);
  vertex_array_ = gl::make_vertex_array(gl);
  std::vector<glm::vec3> corners;
  for (const CutPlane& plane : planes_) {
    for (const glm::dvec3& corner : plane_polygon(prepared, plane.place))
      corners.emplace_back(corner);
    ends_.push_back(corners.size());
  }
  gl.BindVertexArray(vertex_array_.name());
  corners_ = gl::make_buffer(gl, GL_ARRAY_BUFFER, std::as_bytes(std::span(corners)));
  const GLint location = gl.GetAttribLocation(program_.name(), "corner");
  gl.EnableVertexAttribArray(static_cast<GLuint>(location));
  gl.VertexAttribPointer(static_cast<GLuint>(location), 3, GL_FLOAT, GL_FALSE, sizeof(glm::vec3), nullptr);
  gl.BindVertexArray(0);
}

void PlaneRenderer::draw(const PreparedScene& prepared, const GpuScene& scene) const {
  const gl::Functions& gl = *gl_;
  gl.UseProgram(program_.name());
  set_common_uniforms(gl, program_, prepared, scene);
  set_uniform(gl, program_, "clip_from_texture", glm::mat4(clip_from_texture(prepared)));
  gl.BindVertexArray(vertex_array_.name());
  std::size_t begin = 0;
  for (std::size_t i = 0; i < planes_.size(); ++i) {
    set_plane(gl, program_, "plane", planes_[i]);
    gl.DrawArrays(GL_TRIANGLE_FAN, static_cast<GLint>(begin), static_cast<GLsizei>(ends_[i] - begin));
    begin = ends_[i];
  }
}

} // namespace slicelens
