#include "gl/state.h"

#include <algorithm>

namespace slicelens::gl {
namespace {

constexpr std::array<GLenum, 6> switch_names = {GL_BLEND,        GL_DEPTH_TEST, GL_CULL_FACE,
                                                GL_SCISSOR_TEST, GL_DITHER,     GL_FRAMEBUFFER_SRGB};

// In the order in which StateGuard restores them.
enum Integer : std::size_t {
  blend_source_color,
  blend_target_color,
  blend_source_alpha,
  blend_target_alpha,
  blend_equation_color,
  blend_equation_alpha,
  draw_framebuffer,
  read_framebuffer,
  program,
  vertex_array,
  array_buffer,
  pixel_unpack_buffer,
  pixel_pack_buffer,
  active_texture,
  depth_function,
  first_pixel_store
};
constexpr std::array<GLenum, first_pixel_store> integer_names = {GL_BLEND_SRC_RGB,
                                                                 GL_BLEND_DST_RGB,
                                                                 GL_BLEND_SRC_ALPHA,
                                                                 GL_BLEND_DST_ALPHA,
                                                                 GL_BLEND_EQUATION_RGB,
                                                                 GL_BLEND_EQUATION_ALPHA,
                                                                 GL_DRAW_FRAMEBUFFER_BINDING,
                                                                 GL_READ_FRAMEBUFFER_BINDING,
                                                                 GL_CURRENT_PROGRAM,
                                                                 GL_VERTEX_ARRAY_BINDING,
                                                                 GL_ARRAY_BUFFER_BINDING,
                                                                 GL_PIXEL_UNPACK_BUFFER_BINDING,
                                                                 GL_PIXEL_PACK_BUFFER_BINDING,
                                                                 GL_ACTIVE_TEXTURE,
                                                                 GL_DEPTH_FUNC};

constexpr std::array<GLenum, 6> unpack_names = {GL_UNPACK_ALIGNMENT,    GL_UNPACK_ROW_LENGTH,
                                                GL_UNPACK_IMAGE_HEIGHT, GL_UNPACK_SKIP_PIXELS,
                                                GL_UNPACK_SKIP_ROWS,    GL_UNPACK_SKIP_IMAGES};
constexpr std::array<GLenum, 4> pack_names = {GL_PACK_ALIGNMENT, GL_PACK_ROW_LENGTH, GL_PACK_SKIP_PIXELS,
                                              GL_PACK_SKIP_ROWS};

constexpr std::array<GLenum, 3> texture_targets = {GL_TEXTURE_1D, GL_TEXTURE_2D, GL_TEXTURE_3D};
constexpr std::array<GLenum, 3> texture_bindings = {GL_TEXTURE_BINDING_1D, GL_TEXTURE_BINDING_2D,
                                                    GL_TEXTURE_BINDING_3D};

GLint integer_of(const Functions& gl, GLenum name) {
  GLint value = 0;
  gl.GetIntegerv(name, &value);
  return value;
}

void set_switch(const Functions& gl, GLenum name, bool on) {
  if (on)
    gl.Enable(name);
  else
    gl.Disable(name);
}

/// Deleting a bound program or framebuffer unbinds it only in part; binding a deleted name is an error, so a
/// name that no longer exists is restored as 0.
GLuint alive(GLint name, PFNGLISTEXTUREPROC exists) {
  const auto object = static_cast<GLuint>(name);
  return object != 0 && exists(object) != GL_FALSE ? object : 0;
}

} // namespace

StateGuard::StateGuard(const Functions& gl) : gl_(gl) {
  for (const GLenum name : integer_names)
    integers_.push_back(integer_of(gl, name));
  for (const GLenum name : unpack_names)
    integers_.push_back(integer_of(gl, name));
  for (const GLenum name : pack_names)
    integers_.push_back(integer_of(gl, name));
  for (std::size_t i = 0; i < switch_names.size(); ++i)
    switches_[i] = gl.IsEnabled(switch_names[i]) != GL_FALSE;
  gl.GetIntegerv(GL_VIEWPORT, viewport_.data());
  gl.GetIntegerv(GL_SCISSOR_BOX, scissor_.data());
  gl.GetFloatv(GL_BLEND_COLOR, blend_color_.data());
  gl.GetFloatv(GL_COLOR_CLEAR_VALUE, clear_color_.data());
  gl.GetBooleanv(GL_COLOR_WRITEMASK, color_mask_.data());
  gl.GetBooleanv(GL_DEPTH_WRITEMASK, &depth_mask_);
  const int units = std::min(texture_units, integer_of(gl, GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS));
  for (int i = 0; i < units; ++i) {
    gl.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(i));
    Unit unit{};
    for (std::size_t t = 0; t < texture_bindings.size(); ++t)
      unit.textures[t] = integer_of(gl, texture_bindings[t]);
    unit.sampler = integer_of(gl, GL_SAMPLER_BINDING);
    units_.push_back(unit);
  }
  gl.ActiveTexture(static_cast<GLenum>(integers_[active_texture]));
}

StateGuard::~StateGuard() {
  const Functions& gl = gl_;
  const auto value = [&](std::size_t i) { return static_cast<GLenum>(integers_[i]); };
  for (std::size_t i = 0; i < units_.size(); ++i) {
    gl.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(i));
    for (std::size_t t = 0; t < texture_targets.size(); ++t)
      gl.BindTexture(texture_targets[t], alive(units_[i].textures[t], gl.IsTexture));
    gl.BindSampler(static_cast<GLuint>(i), alive(units_[i].sampler, gl.IsSampler));
  }
  gl.ActiveTexture(value(active_texture));
  gl.DepthFunc(value(depth_function));
  gl.BlendFuncSeparate(value(blend_source_color), value(blend_target_color), value(blend_source_alpha),
                       value(blend_target_alpha));
  gl.BlendEquationSeparate(value(blend_equation_color), value(blend_equation_alpha));
  gl.BlendColor(blend_color_[0], blend_color_[1], blend_color_[2], blend_color_[3]);
  gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, alive(integers_[draw_framebuffer], gl.IsFramebuffer));
  gl.BindFramebuffer(GL_READ_FRAMEBUFFER, alive(integers_[read_framebuffer], gl.IsFramebuffer));
  gl.UseProgram(alive(integers_[program], gl.IsProgram));
  gl.BindVertexArray(alive(integers_[vertex_array], gl.IsVertexArray));
  gl.BindBuffer(GL_ARRAY_BUFFER, alive(integers_[array_buffer], gl.IsBuffer));
  gl.BindBuffer(GL_PIXEL_UNPACK_BUFFER, alive(integers_[pixel_unpack_buffer], gl.IsBuffer));
  gl.BindBuffer(GL_PIXEL_PACK_BUFFER, alive(integers_[pixel_pack_buffer], gl.IsBuffer));
  std::size_t next = first_pixel_store;
  for (const GLenum name : unpack_names)
    gl.PixelStorei(name, integers_[next++]);
  for (const GLenum name : pack_names)
    gl.PixelStorei(name, integers_[next++]);
  for (std::size_t i = 0; i < switch_names.size(); ++i)
    set_switch(gl, switch_names[i], switches_[i]);
  gl.Viewport(viewport_[0], viewport_[1], viewport_[2], viewport_[3]);
  gl.Scissor(scissor_[0], scissor_[1], scissor_[2], scissor_[3]);
  gl.ClearColor(clear_color_[0], clear_color_[1], clear_color_[2], clear_color_[3]);
  gl.ColorMask(color_mask_[0], color_mask_[1], color_mask_[2], color_mask_[3]);
  gl.DepthMask(depth_mask_);
}

TextureBindingGuard::TextureBindingGuard(const Functions& gl, GLenum target) : gl_(gl), target_(target) {
  for (std::size_t t = 0; t < texture_targets.size(); ++t)
    if (texture_targets[t] == target)
      texture_ = integer_of(gl, texture_bindings[t]);
}

TextureBindingGuard::~TextureBindingGuard() { gl_.BindTexture(target_, static_cast<GLuint>(texture_)); }

UnpackGuard::UnpackGuard(const Functions& gl)
    : gl_(gl), buffer_(integer_of(gl, GL_PIXEL_UNPACK_BUFFER_BINDING)) {
  for (std::size_t i = 0; i < unpack_names.size(); ++i) {
    values_[i] = integer_of(gl, unpack_names[i]);
    gl.PixelStorei(unpack_names[i], unpack_names[i] == GL_UNPACK_ALIGNMENT ? 1 : 0);
  }
  gl.BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
}

UnpackGuard::~UnpackGuard() {
  for (std::size_t i = 0; i < unpack_names.size(); ++i)
    gl_.PixelStorei(unpack_names[i], values_[i]);
  gl_.BindBuffer(GL_PIXEL_UNPACK_BUFFER, static_cast<GLuint>(buffer_));
}

PackGuard::PackGuard(const Functions& gl)
    : gl_(gl), buffer_(integer_of(gl, GL_PIXEL_PACK_BUFFER_BINDING)),
      framebuffer_(integer_of(gl, GL_READ_FRAMEBUFFER_BINDING)) {
  for (std::size_t i = 0; i < pack_names.size(); ++i) {
    values_[i] = integer_of(gl, pack_names[i]);
    gl.PixelStorei(pack_names[i], pack_names[i] == GL_PACK_ALIGNMENT ? 1 : 0);
  }
  gl.BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
}

PackGuard::~PackGuard() {
  for (std::size_t i = 0; i < pack_names.size(); ++i)
    gl_.PixelStorei(pack_names[i], values_[i]);
  gl_.BindBuffer(GL_PIXEL_PACK_BUFFER, static_cast<GLuint>(buffer_));
  gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(framebuffer_));
}

} // namespace slicelens::gl
