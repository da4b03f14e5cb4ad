// EGL without a surface: Mesa's surfaceless platform, and the device platform that proprietary drivers need.
#include "core/errors.h"
#include "core/text.h"
#include "gl/check.h"
#include "gl/library.h"
#include "gl/native.h"

#define EGL_NO_PLATFORM_SPECIFIC_TYPES
#define EGL_EGL_PROTOTYPES 0
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <algorithm>

namespace slicelens::gl {
namespace {

struct Egl {
  Library library{{"libEGL.so.1"}};
  PFNEGLGETPROCADDRESSPROC address = library.function<PFNEGLGETPROCADDRESSPROC>("eglGetProcAddress");
  PFNEGLGETERRORPROC error = library.function<PFNEGLGETERRORPROC>("eglGetError");
  PFNEGLQUERYSTRINGPROC query_string = library.function<PFNEGLQUERYSTRINGPROC>("eglQueryString");
  PFNEGLINITIALIZEPROC initialize = library.function<PFNEGLINITIALIZEPROC>("eglInitialize");
  PFNEGLBINDAPIPROC bind_api = library.function<PFNEGLBINDAPIPROC>("eglBindAPI");
  PFNEGLCHOOSECONFIGPROC choose_config = library.function<PFNEGLCHOOSECONFIGPROC>("eglChooseConfig");
  PFNEGLCREATECONTEXTPROC create = library.function<PFNEGLCREATECONTEXTPROC>("eglCreateContext");
  PFNEGLDESTROYCONTEXTPROC destroy = library.function<PFNEGLDESTROYCONTEXTPROC>("eglDestroyContext");
  PFNEGLMAKECURRENTPROC make_current = library.function<PFNEGLMAKECURRENTPROC>("eglMakeCurrent");

  std::string last_error() const {
    static constexpr const char* names[] = {
        "EGL_SUCCESS",       "EGL_NOT_INITIALIZED", "EGL_BAD_ACCESS",        "EGL_BAD_ALLOC",
        "EGL_BAD_ATTRIBUTE", "EGL_BAD_CONFIG",      "EGL_BAD_CONTEXT",       "EGL_BAD_CURRENT_SURFACE",
        "EGL_BAD_DISPLAY",   "EGL_BAD_MATCH",       "EGL_BAD_NATIVE_PIXMAP", "EGL_BAD_NATIVE_WINDOW",
        "EGL_BAD_PARAMETER", "EGL_BAD_SURFACE"};
    const EGLint code = error();
    const EGLint index = code - EGL_SUCCESS;
    return index >= 0 && index < static_cast<EGLint>(std::size(names)) ? names[index]
                                                                       : "an unknown EGL error";
  }

  /// The extensions of a display, or those of the library for EGL_NO_DISPLAY.
  bool has(EGLDisplay display, const std::string& extension) const {
    const char* list = query_string(display, EGL_EXTENSIONS);
    return list != nullptr &&
           (" " + std::string(list) + " ").find(" " + extension + " ") != std::string::npos;
  }

  template <class Function>
  Function extension(const char* name) const {
    return reinterpret_cast<Function>(address(name));
  }
};

class EglContext final : public NativeContext {
public:
  EglContext(Egl egl, EGLDisplay display, Profile profile) : egl_(std::move(egl)), display_(display) {
    EGLint major = 0;
    EGLint minor = 0;
    // Displays are never terminated: they are shared by everything in the process that asks for the same
    // platform, and EGL counts no users.
    if (display_ == EGL_NO_DISPLAY || egl_.initialize(display_, &major, &minor) == EGL_FALSE)
      throw GraphicsError("eglInitialize failed: " + egl_.last_error());
    if (!egl_.has(display_, "EGL_KHR_surfaceless_context"))
      throw GraphicsError("the driver lacks EGL_KHR_surfaceless_context");
    if (egl_.bind_api(EGL_OPENGL_API) == EGL_FALSE)
      throw GraphicsError("the driver offers no desktop OpenGL: " + egl_.last_error());
    const EGLConfig config = choose_config();
    for (const auto& [wanted_major, wanted_minor] : wanted_versions) {
      const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                   wanted_major,
                                   EGL_CONTEXT_MINOR_VERSION,
                                   wanted_minor,
                                   EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                   profile == Profile::core ? EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT
                                                            : EGL_CONTEXT_OPENGL_COMPATIBILITY_PROFILE_BIT,
                                   EGL_NONE};
      context_ = egl_.create(display_, config, EGL_NO_CONTEXT, attributes);
      if (context_ != EGL_NO_CONTEXT)
        return;
    }
    throw GraphicsError("eglCreateContext gives no 3.3 context of this profile: " + egl_.last_error());
  }
  ~EglContext() override { egl_.destroy(display_, context_); }

  void make_current() override {
    egl_.bind_api(EGL_OPENGL_API);
    if (egl_.make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_FALSE)
      throw GraphicsError("eglMakeCurrent failed: " + egl_.last_error());
  }
  void release() noexcept override {
    egl_.make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  }
  AnyFunction proc_address(const char* name) const override { return egl_.address(name); }

private:
  EGLConfig choose_config() const {
    const EGLint attributes[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
                                 EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    if (egl_.choose_config(display_, attributes, &config, 1, &count) != EGL_FALSE && count > 0)
      return config;
    if (egl_.has(display_, "EGL_KHR_no_config_context"))
      return nullptr; // EGL_NO_CONFIG_KHR
    throw GraphicsError("the driver offers no configuration for desktop OpenGL");
  }

  Egl egl_;
  EGLDisplay display_;
  EGLContext context_ = EGL_NO_CONTEXT;
};

PFNEGLGETPLATFORMDISPLAYEXTPROC platform_display(const Egl& egl, const std::string& platform) {
  if (!egl.has(EGL_NO_DISPLAY, platform))
    throw GraphicsError("libEGL lacks " + platform);
  const auto function = egl.extension<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
  if (function == nullptr)
    throw GraphicsError("libEGL lacks eglGetPlatformDisplayEXT");
  return function;
}

/// All EGL devices, those that rasterise in software last.
std::vector<EGLDeviceEXT> devices(const Egl& egl) {
  const auto query = egl.extension<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
  const auto query_string = egl.extension<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");
  EGLint count = 0;
  if (query == nullptr || query_string == nullptr || query(0, nullptr, &count) == EGL_FALSE || count < 1)
    throw GraphicsError("EGL lists no devices");
  std::vector<EGLDeviceEXT> list(static_cast<std::size_t>(count));
  if (query(count, list.data(), &count) == EGL_FALSE || count < 1)
    throw GraphicsError("EGL lists no devices");
  list.resize(static_cast<std::size_t>(count));
  std::stable_partition(list.begin(), list.end(), [&](EGLDeviceEXT device) {
    const char* extensions = query_string(device, EGL_EXTENSIONS);
    return extensions == nullptr ||
           std::string(extensions).find("EGL_MESA_device_software") == std::string::npos;
  });
  return list;
}

} // namespace

std::unique_ptr<NativeContext> open_egl_surfaceless(Profile profile) {
  Egl egl;
  const auto display = platform_display(egl, "EGL_MESA_platform_surfaceless");
  return std::make_unique<EglContext>(egl, display(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr), profile);
}

std::unique_ptr<NativeContext> open_egl_device(Profile profile) {
  Egl egl;
  const auto display = platform_display(egl, "EGL_EXT_platform_device");
  std::vector<std::string> failures;
  for (EGLDeviceEXT device : devices(egl)) {
    try {
      return std::make_unique<EglContext>(egl, display(EGL_PLATFORM_DEVICE_EXT, device, nullptr), profile);
    } catch (const GraphicsError& error) {
      failures.push_back("device " + std::to_string(failures.size()) + ": " + error.what());
    }
  }
  throw GraphicsError(join(failures));
}

} // namespace slicelens::gl
