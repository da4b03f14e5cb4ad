#include "bare_loop.h"

namespace slicelens::bench {

namespace {

constexpr const char* vertex_text = R"(#version 330 core
layout(location = 0) in vec2 place;
layout(location = 1) in vec3 corner;
out vec3 t;
void main() {
  t = corner;
  gl_Position = vec4(place, 0.0, 1.0);
}
)";

// value_to_table joins texel → value → table coordinate in one multiplication and addition.
constexpr const char* fragment_text = R"(#version 330 core
uniform sampler3D volume;
uniform sampler1D table;
uniform vec2 value_to_table;
in vec3 t;
out vec4 result;
void main() {
  vec4 color = texture(table, value_to_table.x * texture(volume, t).r + value_to_table.y);
  result = vec4(color.rgb * color.a, color.a);
}
)";

SliceStack stack_of(const PreparedScene& prepared) {
  SliceRequest request;
  request.box = prepared.box;
  request.view = prepared.view;
  request.spacing = prepared.spacing;
  return make_slice_stack(request);
}

void append(std::vector<float>& corners, const glm::dvec2& place, const glm::dvec3& texture) {
  for (const double value : {place.x, place.y, texture.x, texture.y, texture.z})
    corners.push_back(static_cast<float>(value));
}

} // namespace

BareLoop::BareLoop(const gl::Functions& gl)
    : gl_(&gl), program_(gl::make_program(gl, {{GL_VERTEX_SHADER, "bare.vert", vertex_text},
                                               {GL_FRAGMENT_SHADER, "bare.frag", fragment_text}})),
      vertex_array_(gl::make_vertex_array(gl)) {}

void BareLoop::set_corners(const std::vector<float>& corners) {
  const gl::Functions& gl = *gl_;
  corners_ = gl::make_buffer(gl, GL_ARRAY_BUFFER, std::as_bytes(std::span(corners)));
  gl.BindVertexArray(vertex_array_.name());
  gl.BindBuffer(GL_ARRAY_BUFFER, corners_.name());
  constexpr GLsizei stride = 5 * sizeof(float);
  gl.EnableVertexAttribArray(0);
  gl.EnableVertexAttribArray(1);
  gl.VertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, stride, nullptr);
  gl.VertexAttribPointer(1, 3, GL_FLOAT, GL_FALSE, stride, reinterpret_cast<const void*>(2 * sizeof(float)));
  gl.BindVertexArray(0);
}

void BareLoop::set_squares(const PreparedScene& prepared) {
  const View& view = prepared.view;
  const glm::dvec3 middle = center(prepared.box);
  const glm::dmat4 texture_from_world = glm::inverse(prepared.box.world_from_texture);
  const glm::dvec3 axis = view.eye + glm::dot(middle - view.eye, view.forward) * view.forward;
  std::vector<float> corners;
  fans_.clear();
  for (const Slice& slice : stack_of(prepared).slices) {
    fans_.push_back({static_cast<GLint>(4 * fans_.size()), 4});
    for (const glm::dvec2 place :
         {glm::dvec2(-1, -1), glm::dvec2(1, -1), glm::dvec2(1, 1), glm::dvec2(-1, 1)}) {
      const glm::dvec3 world = axis + slice.distance * view.forward +
                               place.x * half_width(view) * view.right + place.y * view.half_height * view.up;
      append(corners, place, glm::dvec3(texture_from_world * glm::dvec4(world, 1)));
    }
  }
  set_corners(corners);
}

void BareLoop::set_polygons(const PreparedScene& prepared) {
  const View& view = prepared.view;
  const SliceStack stack = stack_of(prepared);
  std::vector<float> corners;
  fans_.clear();
  for (const Slice& slice : stack.slices)
    fans_.push_back({static_cast<GLint>(slice.first), static_cast<GLsizei>(slice.count)});
  for (const glm::dvec3& corner : stack.corners) {
    const glm::dvec2 pixel =
        pixel_from_world(view, glm::dvec3(prepared.box.world_from_texture * glm::dvec4(corner, 1)));
    append(corners, {2 * pixel.x / view.width - 1, 1 - 2 * pixel.y / view.height}, corner);
  }
  set_corners(corners);
}

void BareLoop::draw(const GpuScene& scene, const gl::Target& target) const {
  const gl::Functions& gl = *gl_;
  gl::bind_target(gl, target);
  gl.ClearColor(0, 0, 0, 0);
  gl.Clear(GL_COLOR_BUFFER_BIT);
  gl.Enable(GL_BLEND);
  gl.BlendEquation(GL_FUNC_ADD);
  gl.BlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  gl.UseProgram(program_.name());
  gl.ActiveTexture(GL_TEXTURE0);
  gl.BindTexture(GL_TEXTURE_3D, scene.volume.name());
  gl.ActiveTexture(GL_TEXTURE1);
  gl.BindTexture(GL_TEXTURE_1D, scene.transfer.name());
  gl::set_uniform(gl, program_, "volume", 0);
  gl::set_uniform(gl, program_, "table", 1);
  gl::set_uniform(
      gl, program_, "value_to_table",
      glm::vec2(scene.value_from_texel.x * scene.transfer_from_value.x,
                scene.value_from_texel.y * scene.transfer_from_value.x + scene.transfer_from_value.y));
  gl.BindVertexArray(vertex_array_.name());
  for (const Fan& fan : fans_)
    gl.DrawArrays(GL_TRIANGLE_FAN, fan.first, fan.count);
  gl.Disable(GL_BLEND);
}

} // namespace slicelens::bench
