#include "gl/context.h"

#include "core/errors.h"
#include "gl/native.h"

#include <array>

namespace slicelens::gl {
namespace {

// OpenGL's current context is a state of the thread, and each library knows only its own. Mesa's libraries
// share one dispatch table besides, so the old library must let go before another one takes over.
thread_local NativeContext* current = nullptr;

void activate(NativeContext& native) {
  if (current != nullptr && current != &native)
    current->release();
  current = nullptr;
  native.make_current();
  current = &native;
}

void deactivate(NativeContext& native) noexcept {
  if (current == &native) {
    native.release();
    current = nullptr;
  }
}

struct Kind {
  ContextKind kind;
  const char* name;
};
constexpr std::array<Kind, 6> kinds = {{{ContextKind::automatic, "auto"},
                                        {ContextKind::osmesa, "osmesa"},
                                        {ContextKind::egl, "egl"},
                                        {ContextKind::egl_surfaceless, "egl-surfaceless"},
                                        {ContextKind::egl_device, "egl-device"},
                                        {ContextKind::window, "window"}}};

std::vector<ContextKind> attempts(ContextKind kind) {
  if (kind == ContextKind::automatic)
    return {ContextKind::osmesa, ContextKind::egl_surfaceless, ContextKind::egl_device};
  if (kind == ContextKind::egl)
    return {ContextKind::egl_surfaceless, ContextKind::egl_device};
  return {kind};
}

std::unique_ptr<NativeContext> open_native(ContextKind kind, Profile profile) {
  switch (kind) {
  case ContextKind::osmesa:
    return open_osmesa(profile);
  case ContextKind::egl_surfaceless:
    return open_egl_surfaceless(profile);
  case ContextKind::egl_device:
    return open_egl_device(profile);
  default:
    return open_window(profile);
  }
}

std::string text_of(const Functions& gl, GLenum name) {
  const GLubyte* text = gl.GetString(name);
  return text != nullptr ? reinterpret_cast<const char*>(text) : "";
}

int integer_of(const Functions& gl, GLenum name) {
  GLint value = 0;
  gl.GetIntegerv(name, &value);
  return value;
}

ContextInfo describe(const Functions& gl, ContextKind kind) {
  ContextInfo info;
  info.kind = context_kind_name(kind);
  info.vendor = text_of(gl, GL_VENDOR);
  info.renderer = text_of(gl, GL_RENDERER);
  info.version = text_of(gl, GL_VERSION);
  info.glsl = text_of(gl, GL_SHADING_LANGUAGE_VERSION);
  const int mask = integer_of(gl, GL_CONTEXT_PROFILE_MASK);
  info.profile = (mask & GL_CONTEXT_CORE_PROFILE_BIT) != 0 ? "core" : "compatibility";
  info.major = integer_of(gl, GL_MAJOR_VERSION);
  info.minor = integer_of(gl, GL_MINOR_VERSION);
  info.limits.texture_size = integer_of(gl, GL_MAX_TEXTURE_SIZE);
  info.limits.texture_size_3d = integer_of(gl, GL_MAX_3D_TEXTURE_SIZE);
  info.limits.samples = integer_of(gl, GL_MAX_SAMPLES);
  info.limits.color_attachments = integer_of(gl, GL_MAX_COLOR_ATTACHMENTS);
  info.limits.draw_buffers = integer_of(gl, GL_MAX_DRAW_BUFFERS);
  info.limits.texture_units = integer_of(gl, GL_MAX_TEXTURE_IMAGE_UNITS);
  gl.GetQueryiv(GL_TIME_ELAPSED, GL_QUERY_COUNTER_BITS, &info.limits.timer_query_bits);
  gl.GetIntegerv(GL_MAX_VIEWPORT_DIMS, info.limits.viewport_size);
  return info;
}

} // namespace

std::string context_kind_name(ContextKind kind) {
  for (const Kind& entry : kinds)
    if (entry.kind == kind)
      return entry.name;
  return "unknown";
}

std::optional<ContextKind> context_kind(std::string_view name) {
  for (const Kind& entry : kinds)
    if (entry.name == name)
      return entry.kind;
  return std::nullopt;
}

struct Context::State {
  explicit State(std::unique_ptr<NativeContext> opened) : native(std::move(opened)) {}
  ~State() { deactivate(*native); }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  std::unique_ptr<NativeContext> native;
  Functions functions;
  ContextInfo info;
};

Context::Context(std::unique_ptr<State> state) : state_(std::move(state)) {}
Context::Context(Context&&) noexcept = default;
Context& Context::operator=(Context&&) noexcept = default;
Context::~Context() = default;

void Context::make_current() { activate(*state_->native); }
const Functions& Context::functions() const { return state_->functions; }
const ContextInfo& Context::info() const { return state_->info; }
AnyFunction Context::proc_address(const char* name) const { return state_->native->proc_address(name); }

Context open_one(ContextKind kind, Profile profile) {
  auto state = std::make_unique<Context::State>(open_native(kind, profile));
  activate(*state->native);
  const NativeContext& native = *state->native;
  state->functions = load_functions([&](const char* name) { return native.proc_address(name); });
  state->info = describe(state->functions, kind);
  return Context(std::move(state));
}

Context open_context(ContextKind kind, Profile profile) {
  NativeContext* const before = current;
  std::string failures;
  for (const ContextKind attempt : attempts(kind)) {
    try {
      return open_one(attempt, profile);
    } catch (const GraphicsError& error) {
      failures += (failures.empty() ? "" : "; ") + context_kind_name(attempt) + ": " + error.what();
    }
  }
  if (before != nullptr)
    activate(*before);
  throw GraphicsError("no OpenGL 3.3 context: " + failures);
}

std::vector<ContextProbe> probe_contexts() {
  NativeContext* const before = current;
  std::vector<ContextProbe> probes;
  for (const ContextKind kind :
       {ContextKind::osmesa, ContextKind::egl_surfaceless, ContextKind::egl_device, ContextKind::window}) {
    ContextProbe probe;
    probe.kind = context_kind_name(kind);
    try {
      probe.info = open_one(kind, Profile::core).info();
    } catch (const GraphicsError& error) {
      probe.reason = error.what();
    }
    probes.push_back(std::move(probe));
  }
  if (before != nullptr)
    activate(*before);
  return probes;
}

} // namespace slicelens::gl
