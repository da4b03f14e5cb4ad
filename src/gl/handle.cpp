#include "gl/handle.h"

#include "core/errors.h"
#include "gl/check.h"

namespace slicelens::gl {

Buffer make_buffer(const Functions& gl) {
  GLuint name = 0;
  gl.GenBuffers(1, &name);
  return {gl, name};
}

Buffer make_buffer(const Functions& gl, GLenum target, std::span<const std::byte> data, GLenum usage) {
  Buffer buffer = make_buffer(gl);
  check_errors(gl, "before making a buffer");
  gl.BindBuffer(target, buffer.name());
  gl.BufferData(target, static_cast<GLsizeiptr>(data.size()), data.data(), usage);
  const GLenum error = gl.GetError();
  if (error == GL_OUT_OF_MEMORY)
    throw LimitError("the driver has no memory for a buffer of " + std::to_string(data.size()) + " bytes");
  if (error != GL_NO_ERROR)
    throw GraphicsError("making a buffer: " + error_name(error));
  return buffer;
}

VertexArray make_vertex_array(const Functions& gl) {
  GLuint name = 0;
  gl.GenVertexArrays(1, &name);
  return {gl, name};
}

Sampler make_sampler(const Functions& gl, GLenum filter, GLenum wrap) {
  GLuint name = 0;
  gl.GenSamplers(1, &name);
  Sampler sampler(gl, name);
  for (const GLenum side : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
    gl.SamplerParameteri(name, side, static_cast<GLint>(filter));
  for (const GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
    gl.SamplerParameteri(name, axis, static_cast<GLint>(wrap));
  check_errors(gl, "making a sampler");
  return sampler;
}

Framebuffer make_framebuffer(const Functions& gl) {
  GLuint name = 0;
  gl.GenFramebuffers(1, &name);
  return {gl, name};
}

Renderbuffer make_renderbuffer(const Functions& gl) {
  GLuint name = 0;
  gl.GenRenderbuffers(1, &name);
  return {gl, name};
}

Sync make_fence(const Functions& gl) { return {gl, gl.FenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0)}; }

} // namespace slicelens::gl
