// A hidden GLFW window: the driver of the user's own display.
#include "core/errors.h"
#include "gl/library.h"
#include "gl/native.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace slicelens::gl {
namespace {

struct Glfw {
  Library library{{"libglfw.so.3"}};
  decltype(&glfwInit) init = library.function<decltype(&glfwInit)>("glfwInit");
  decltype(&glfwGetError) get_error = library.function<decltype(&glfwGetError)>("glfwGetError");
  decltype(&glfwDefaultWindowHints) default_hints =
      library.function<decltype(&glfwDefaultWindowHints)>("glfwDefaultWindowHints");
  decltype(&glfwWindowHint) hint = library.function<decltype(&glfwWindowHint)>("glfwWindowHint");
  decltype(&glfwCreateWindow) create = library.function<decltype(&glfwCreateWindow)>("glfwCreateWindow");
  decltype(&glfwDestroyWindow) destroy = library.function<decltype(&glfwDestroyWindow)>("glfwDestroyWindow");
  decltype(&glfwMakeContextCurrent) make_current =
      library.function<decltype(&glfwMakeContextCurrent)>("glfwMakeContextCurrent");
  decltype(&glfwGetProcAddress) address =
      library.function<decltype(&glfwGetProcAddress)>("glfwGetProcAddress");

  std::string last_error() const {
    const char* text = nullptr;
    const int code = get_error(&text);
    if (code == GLFW_NO_ERROR || text == nullptr)
      return "GLFW gives no reason";
    std::string line(text);
    return line.substr(0, line.find('\n'));
  }
};

class WindowContext final : public NativeContext {
public:
  explicit WindowContext(Profile profile) {
    // GLFW is never terminated: that would close the windows of everything else in the process.
    if (glfw_.init() == GLFW_FALSE)
      throw GraphicsError(glfw_.last_error());
    for (const auto& [major, minor] : wanted_versions) {
      glfw_.default_hints();
      glfw_.hint(GLFW_VISIBLE, GLFW_FALSE);
      glfw_.hint(GLFW_CONTEXT_VERSION_MAJOR, major);
      glfw_.hint(GLFW_CONTEXT_VERSION_MINOR, minor);
      glfw_.hint(GLFW_OPENGL_PROFILE,
                 profile == Profile::core ? GLFW_OPENGL_CORE_PROFILE : GLFW_OPENGL_COMPAT_PROFILE);
      window_ = glfw_.create(16, 16, "slicelens", nullptr, nullptr);
      if (window_ != nullptr)
        return;
    }
    throw GraphicsError(glfw_.last_error());
  }
  ~WindowContext() override { glfw_.destroy(window_); }

  void make_current() override {
    glfw_.get_error(nullptr);
    glfw_.make_current(window_);
    const char* text = nullptr;
    if (glfw_.get_error(&text) != GLFW_NO_ERROR)
      throw GraphicsError(std::string("glfwMakeContextCurrent failed: ") + (text != nullptr ? text : ""));
  }
  void release() noexcept override { glfw_.make_current(nullptr); }
  AnyFunction proc_address(const char* name) const override { return glfw_.address(name); }

private:
  Glfw glfw_;
  GLFWwindow* window_ = nullptr;
};

} // namespace

std::unique_ptr<NativeContext> open_window(Profile profile) {
  return std::make_unique<WindowContext>(profile);
}

} // namespace slicelens::gl
