// OpenGL contexts without a screen, and the hidden window. All libraries are opened at run time.
#pragma once

#include "gl/functions.h"

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace slicelens::gl {

/// Where a context comes from. `automatic` tries osmesa, egl_surfaceless and egl_device in this order; `egl`
/// the last two. `window` is a hidden GLFW window and needs a display.
enum class ContextKind { automatic, osmesa, egl, egl_surfaceless, egl_device, window };

/// `compatibility` keeps the fixed-function pipeline; its functions are not in the table, ask
/// Context::proc_address for them.
enum class Profile { core, compatibility };

/// "auto", "osmesa", "egl", "egl-surfaceless", "egl-device", "window".
std::string context_kind_name(ContextKind kind);
/// The kind of that name, or nothing.
std::optional<ContextKind> context_kind(std::string_view name);

/// What the driver allows, from glGet.
struct Limits {
  int texture_size = 0;          ///< texels per edge of a 1D or 2D texture
  int texture_size_3d = 0;       ///< texels per edge of a 3D texture
  int samples = 0;               ///< samples per pixel of a multisampled target
  int color_attachments = 0;     ///< colour textures of one framebuffer
  int draw_buffers = 0;          ///< outputs of one fragment shader
  int texture_units = 0;         ///< textures of one fragment shader
  int timer_query_bits = 0;      ///< bits of GL_TIME_ELAPSED; 0: timer queries say nothing
  int viewport_size[2] = {0, 0}; ///< largest viewport, width and height in pixels
};

struct ContextInfo {
  std::string kind;     ///< "osmesa", "egl-surfaceless", "egl-device" or "window"
  std::string vendor;   ///< GL_VENDOR
  std::string renderer; ///< GL_RENDERER, for instance "llvmpipe (LLVM 15.0.6, 256 bits)"
  std::string version;  ///< GL_VERSION
  std::string glsl;     ///< GL_SHADING_LANGUAGE_VERSION
  std::string profile;  ///< "core" or "compatibility", as the driver says
  int major = 0;
  int minor = 0;
  Limits limits;
};

/// The part of a context that depends on its library (context_*.cpp). Destroying it destroys the context.
class NativeContext {
public:
  virtual ~NativeContext() = default;
  /// Throws GraphicsError when the library refuses.
  virtual void make_current() = 0;
  /// Leaves the thread without a current context, as far as this library is concerned.
  virtual void release() noexcept = 0;
  virtual AnyFunction proc_address(const char* name) const = 0;
};

/// One OpenGL context of version 3.3 or later, with the highest version that the driver gives. It has no
/// usable default framebuffer: draw into a target (gl/target.h). Use it from one thread at a time. Destroy
/// what was made in it (handles) before it, while it is current: handles refer to its function table.
class Context {
public:
  Context(Context&&) noexcept;
  Context& operator=(Context&&) noexcept;
  ~Context();

  /// Makes it this thread's current context, after releasing another library's. Throws GraphicsError.
  void make_current();
  /// The table stays where it is when the Context moves.
  const Functions& functions() const;
  const ContextInfo& info() const;
  /// A function outside the table (an extension, fixed function) by its full name, or null where the library
  /// knows none; EGL and GLX give an address for any name.
  AnyFunction proc_address(const char* name) const;

private:
  struct State;
  explicit Context(std::unique_ptr<State> state);
  friend Context open_one(ContextKind, Profile);
  std::unique_ptr<State> state_;
};

/// Opens a context and makes it current. The driver follows the usual environment (GALLIUM_DRIVER,
/// LIBGL_ALWAYS_SOFTWARE). Throws GraphicsError: one line with every attempt and why it failed.
Context open_context(ContextKind kind, Profile profile = Profile::core);

struct ContextProbe {
  std::string kind;                ///< "osmesa", "egl-surfaceless", "egl-device", "window"
  std::optional<ContextInfo> info; ///< what was opened
  std::string reason;              ///< one line: why it could not be
};

/// Opens and closes each kind in turn. The context that was current before stays current.
std::vector<ContextProbe> probe_contexts();

} // namespace slicelens::gl
