// Move-only owners of OpenGL objects, and the functions that make the plain ones. Programs, textures, targets
// and timer queries have headers of their own.
#pragma once

#include "gl/functions.h"

#include <cstddef>
#include <span>
#include <utility>

namespace slicelens::gl {

/// Owns one OpenGL object and deletes it. Destroy it before its Context and while that is current. An empty
/// handle (default made or moved from) has name 0.
template <class Traits>
class Handle {
public:
  using Name = typename Traits::Name;

  Handle() = default;
  /// Takes over `name`, made in the current context.
  Handle(const Functions& gl, Name name) : gl_(&gl), name_(name) {}
  Handle(Handle&& other) noexcept
      : gl_(std::exchange(other.gl_, nullptr)), name_(std::exchange(other.name_, Name{})) {}
  Handle& operator=(Handle&& other) noexcept {
    if (this != &other) {
      reset();
      gl_ = std::exchange(other.gl_, nullptr);
      name_ = std::exchange(other.name_, Name{});
    }
    return *this;
  }
  ~Handle() { reset(); }

  Name name() const { return name_; }
  explicit operator bool() const { return name_ != Name{}; }
  void reset() noexcept {
    if (name_ != Name{})
      Traits::destroy(*gl_, name_);
    gl_ = nullptr;
    name_ = Name{};
  }

private:
  const Functions* gl_ = nullptr;
  Name name_{};
};

struct BufferTraits {
  using Name = GLuint;
  static void destroy(const Functions& gl, Name name) { gl.DeleteBuffers(1, &name); }
};
struct TextureTraits {
  using Name = GLuint;
  static void destroy(const Functions& gl, Name name) { gl.DeleteTextures(1, &name); }
};
struct SamplerTraits {
  using Name = GLuint;
  static void destroy(const Functions& gl, Name name) { gl.DeleteSamplers(1, &name); }
};
struct VertexArrayTraits {
  using Name = GLuint;
  static void destroy(const Functions& gl, Name name) { gl.DeleteVertexArrays(1, &name); }
};
struct FramebufferTraits {
  using Name = GLuint;
  static void destroy(const Functions& gl, Name name) { gl.DeleteFramebuffers(1, &name); }
};
struct RenderbufferTraits {
  using Name = GLuint;
  static void destroy(const Functions& gl, Name name) { gl.DeleteRenderbuffers(1, &name); }
};
struct ShaderTraits {
  using Name = GLuint;
  static void destroy(const Functions& gl, Name name) { gl.DeleteShader(name); }
};
struct ProgramTraits {
  using Name = GLuint;
  static void destroy(const Functions& gl, Name name) { gl.DeleteProgram(name); }
};
struct QueryTraits {
  using Name = GLuint;
  static void destroy(const Functions& gl, Name name) { gl.DeleteQueries(1, &name); }
};
struct SyncTraits {
  using Name = GLsync;
  static void destroy(const Functions& gl, Name name) { gl.DeleteSync(name); }
};

using Buffer = Handle<BufferTraits>;
using Texture = Handle<TextureTraits>;
using Sampler = Handle<SamplerTraits>;
using VertexArray = Handle<VertexArrayTraits>;
using Framebuffer = Handle<FramebufferTraits>;
using Renderbuffer = Handle<RenderbufferTraits>;
using Shader = Handle<ShaderTraits>;
using Program = Handle<ProgramTraits>;
using Query = Handle<QueryTraits>;
using Sync = Handle<SyncTraits>;

/// A name without storage; it becomes a buffer at its first glBindBuffer.
Buffer make_buffer(const Functions& gl);
/// A buffer of data.size() bytes holding `data`, left bound to `target` (GL_ARRAY_BUFFER …; for
/// GL_ELEMENT_ARRAY_BUFFER that is a state of the bound vertex array). Throws LimitError when the driver has
/// no room.
Buffer make_buffer(const Functions& gl, GLenum target, std::span<const std::byte> data,
                   GLenum usage = GL_STATIC_DRAW);
VertexArray make_vertex_array(const Functions& gl);
/// Filter for minification and magnification, one wrap mode for all axes.
Sampler make_sampler(const Functions& gl, GLenum filter, GLenum wrap);
Framebuffer make_framebuffer(const Functions& gl);
Renderbuffer make_renderbuffer(const Functions& gl);
/// A fence after all commands so far.
Sync make_fence(const Functions& gl);

} // namespace slicelens::gl
