#include "catch.h"
#include "gl/check.h"
#include "gl/context.h"
#include "gl/target.h"
#include "gl_fixture.h"

#include <algorithm>
#include <numeric>

using namespace slicelens;
using gl::Context;
using gl::ContextKind;
using gl::Functions;

namespace {

/// Clears a small target to a colour whose components have no rounding in 8 bits, and expects it back.
void check_clear(const Functions& gl, float red) {
  const gl::Target target = gl::make_target(gl, 7, 3, GL_RGBA8);
  gl::bind_target(gl, target);
  gl.ClearColor(red, 0.0f, 1.0f, 51.0f / 255.0f);
  gl.Clear(GL_COLOR_BUFFER_BIT);
  const std::vector<float> pixels = gl::read_pixels(gl, target);
  REQUIRE(pixels.size() == 4 * 7 * 3);
  for (std::size_t i = 0; i < pixels.size(); i += 4) {
    CHECK(pixels[i] == red);
    CHECK(pixels[i + 1] == 0.0f);
    CHECK(pixels[i + 2] == 1.0f);
    CHECK(pixels[i + 3] == Approx(51.0 / 255.0).margin(1e-7)); // one rounding of 51/255 to float
  }
  gl::check_errors(gl, "clear");
}

/// Removes a variable of the environment and puts it back.
class WithoutVariable {
public:
  explicit WithoutVariable(const char* name) : name_(name) {
    if (const char* value = std::getenv(name)) {
      value_ = value;
      ::unsetenv(name);
    }
  }
  ~WithoutVariable() {
    if (value_)
      ::setenv(name_, value_->c_str(), 1);
  }

private:
  const char* name_;
  std::optional<std::string> value_;
};

std::optional<Context> try_open(ContextKind kind) {
  try {
    return gl::open_context(kind);
  } catch (const GraphicsError& error) {
    std::cout << error.what() << std::endl;
    return std::nullopt;
  }
}

} // namespace

TEST_CASE("an OSMesa context clears to the colour asked for") {
  Context context = gl::open_context(ContextKind::osmesa);
  CHECK(context.info().kind == "osmesa");
  CHECK(context.info().profile == "core");
  check_clear(context.functions(), 1.0f);
}

TEST_CASE("the automatic context is OSMesa where there is one") {
  CHECK(gl::open_context(ContextKind::automatic).info().kind == "osmesa");
}

TEST_CASE("a surfaceless EGL context clears to the colour asked for") {
  auto context = try_open(ContextKind::egl_surfaceless);
  if (!context)
    SLICELENS_SKIP("no surfaceless EGL context here");
  CHECK(context->info().kind == "egl-surfaceless");
  check_clear(context->functions(), 1.0f);
}

TEST_CASE("an EGL device context clears to the colour asked for") {
  auto context = try_open(ContextKind::egl_device);
  if (!context)
    SLICELENS_SKIP("no EGL device context here");
  CHECK(context->info().kind == "egl-device");
  check_clear(context->functions(), 1.0f);
}

TEST_CASE("a hidden window's context clears to the colour asked for") {
  if (std::getenv("DISPLAY") == nullptr)
    SLICELENS_SKIP("no display");
  auto context = try_open(ContextKind::window);
  if (!context)
    SLICELENS_SKIP("no window can be opened on this display");
  CHECK(context->info().kind == "window");
  check_clear(context->functions(), 1.0f);
}

TEST_CASE("the driver that the environment names is the one that draws") {
  const Context context = test_context();
  const char* driver = std::getenv("GALLIUM_DRIVER");
  if (driver == nullptr)
    SLICELENS_SKIP("GALLIUM_DRIVER is not set");
  CHECK(context.info().renderer.find(driver) != std::string::npos);
}

TEST_CASE("a compatibility context keeps the fixed-function pipeline") {
  const Context context = test_context(gl::Profile::compatibility);
  CHECK(context.info().profile == "compatibility");
  using Begin = void (*)(GLenum);
  using End = void (*)();
  const auto begin = reinterpret_cast<Begin>(context.proc_address("glBegin"));
  const auto end = reinterpret_cast<End>(context.proc_address("glEnd"));
  REQUIRE(begin != nullptr);
  REQUIRE(end != nullptr);
  // EGL without a surface has no framebuffer of its own to begin in.
  const gl::Target target = gl::make_target(context.functions(), 2, 2, GL_RGBA8);
  gl::bind_target(context.functions(), target);
  begin(GL_TRIANGLES);
  end();
  gl::check_errors(context.functions(), "fixed function");
}

TEST_CASE("the function table holds all of OpenGL 3.3 and nothing above the context's version") {
  const Context context = test_context();
  const Functions& gl = context.functions();
  for (const int version : {10, 11, 12, 13, 14, 15, 20, 21, 30, 31, 32, 33})
    CHECK(gl::missing_functions(gl, version).empty());
  const int own = 10 * context.info().major + context.info().minor;
  REQUIRE(own >= 33);
  if (own < 42)
    CHECK(gl.TexStorage3D == nullptr);
  else
    CHECK(gl.TexStorage3D != nullptr);
  // An empty table misses what 3.3 added, by their names in the specification.
  const std::vector<std::string> missing = gl::missing_functions(Functions{}, 33);
  CHECK(std::find(missing.begin(), missing.end(), "glQueryCounter") != missing.end());
  CHECK(std::find(missing.begin(), missing.end(), "glBindSampler") != missing.end());
}

TEST_CASE("a missing function of OpenGL 3.3 is refused by name") {
  const Context context = test_context();
  const auto without_clear = [&](const char* name) {
    return std::string(name) == "glClear" ? nullptr : context.proc_address(name);
  };
  CHECK_THROWS_WITH(gl::load_functions(without_clear), Catch::Matchers::Contains("glClear,"));
}

TEST_CASE("limits are those that OpenGL 3.3 guarantees, or better") {
  // OpenGL 3.3 core specification, section 6.2, the tables of implementation-dependent values.
  const gl::Limits limits = test_context().info().limits;
  CHECK(limits.texture_size >= 1024);
  CHECK(limits.texture_size_3d >= 256);
  CHECK(limits.color_attachments >= 8);
  CHECK(limits.draw_buffers >= 8);
  CHECK(limits.texture_units >= 16);
  CHECK(limits.viewport_size[0] >= 1024);
}

TEST_CASE("two contexts live side by side and one after the other") {
  Context opened = test_context();
  const Functions& gl = opened.functions();
  Context first = std::move(opened); // the table must not move with it: handles refer to it
  REQUIRE(&first.functions() == &gl);
  const gl::Target target = gl::make_target(gl, 2, 2, GL_RGBA32F);
  gl::bind_target(gl, target);
  gl.ClearColor(0.25f, 0.5f, 0.75f, 1.0f);
  gl.Clear(GL_COLOR_BUFFER_BIT);
  {
    auto other = try_open(ContextKind::egl);
    Context second = other ? std::move(*other) : gl::open_context(ContextKind::osmesa);
    check_clear(second.functions(), 0.0f);
    first.make_current();
    CHECK(gl::read_pixels(gl, target)[0] == 0.25f);
    second.make_current();
    check_clear(second.functions(), 1.0f);
  }
  first.make_current();
  CHECK(gl::read_pixels(gl, target)[2] == 0.75f);
}

TEST_CASE("a context that cannot be opened says why in one line and leaves the old one current") {
  const WithoutVariable display("DISPLAY");
  const WithoutVariable wayland("WAYLAND_DISPLAY");
  const Context context = gl::open_context(ContextKind::osmesa); // needs no display
  std::string message;
  try {
    (void)gl::open_context(ContextKind::window);
  } catch (const GraphicsError& error) {
    message = error.what();
  }
  CHECK_THAT(message, Catch::Matchers::StartsWith("no OpenGL 3.3 context: window: "));
  CHECK_THAT(message, Catch::Matchers::Contains("DISPLAY") || Catch::Matchers::Contains("libglfw"));
  CHECK(message.find('\n') == std::string::npos);
  check_clear(context.functions(), 1.0f);
}

TEST_CASE("probing names every kind, with a renderer or a reason") {
  const WithoutVariable display("DISPLAY");
  const Context context = gl::open_context(ContextKind::osmesa); // needs no display
  const std::vector<gl::ContextProbe> probes = gl::probe_contexts();
  REQUIRE(probes.size() == 4);
  const std::vector<std::string> expected = {"osmesa", "egl-surfaceless", "egl-device", "window"};
  for (std::size_t i = 0; i < probes.size(); ++i) {
    CHECK(probes[i].kind == expected[i]);
    CHECK(probes[i].info.has_value() == probes[i].reason.empty());
  }
  CHECK(probes[0].info.has_value());
  CHECK_FALSE(probes[3].info.has_value());
  check_clear(context.functions(), 0.0f);
}

TEST_CASE("names of context kinds read back") {
  for (const ContextKind kind : {ContextKind::automatic, ContextKind::osmesa, ContextKind::egl,
                                 ContextKind::egl_surfaceless, ContextKind::egl_device, ContextKind::window})
    CHECK(gl::context_kind(gl::context_kind_name(kind)) == kind);
  CHECK(gl::context_kind_name(ContextKind::automatic) == "auto");
  CHECK_FALSE(gl::context_kind("glx").has_value());
}
