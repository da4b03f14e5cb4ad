#include "catch.h"
#include "gl/check.h"
#include "gl/program.h"
#include "gl/state.h"
#include "gl/target.h"
#include "gl/texture.h"
#include "gl/timer.h"
#include "gl_fixture.h"

using namespace slicelens;
using gl::Functions;

namespace {

constexpr const char* plain_vertex = "#version 330 core\nvoid main() { gl_Position = vec4(0.0); }\n";

std::string program_error(const Functions& gl, const std::vector<gl::ShaderSource>& sources) {
  try {
    (void)gl::make_program(gl, sources);
  } catch (const GraphicsError& error) {
    return error.what();
  }
  return "";
}

GLint integer_of(const Functions& gl, GLenum name) {
  GLint value = -1;
  gl.GetIntegerv(name, &value);
  return value;
}

} // namespace

TEST_CASE("a handle deletes its object once, when its last owner goes") {
  const gl::Context context = test_context();
  const Functions& gl = context.functions();
  gl::Texture texture = gl::make_texture_1d(gl, {}, 4, {});
  const GLuint name = texture.name();
  CHECK(gl.IsTexture(name) == GL_TRUE);
  {
    gl::Texture owner = std::move(texture);
    CHECK_FALSE(texture);
    CHECK(owner.name() == name);
    texture.reset();
    CHECK(gl.IsTexture(name) == GL_TRUE);
  }
  CHECK(gl.IsTexture(name) == GL_FALSE);

  gl::Texture first = gl::make_texture_1d(gl, {}, 4, {});
  gl::Texture second = gl::make_texture_1d(gl, {}, 4, {});
  const GLuint replaced = first.name();
  const GLuint kept = second.name();
  first = std::move(second);
  CHECK(gl.IsTexture(replaced) == GL_FALSE);
  CHECK(gl.IsTexture(kept) == GL_TRUE);
  first.reset();
  CHECK(gl.IsTexture(kept) == GL_FALSE);
}

TEST_CASE("every kind of handle deletes what it owns") {
  const gl::Context context = test_context();
  const Functions& gl = context.functions();
  const std::byte data[4] = {};
  GLuint buffer = 0, array = 0, sampler = 0, framebuffer = 0, program = 0;
  GLsync fence = nullptr;
  {
    const gl::VertexArray array_owner = gl::make_vertex_array(gl);
    gl.BindVertexArray(array = array_owner.name());
    const gl::Buffer buffer_owner = gl::make_buffer(gl, GL_ARRAY_BUFFER, data);
    const gl::Sampler sampler_owner = gl::make_sampler(gl, GL_LINEAR, GL_REPEAT);
    const gl::Target target = gl::make_target(gl, 2, 2, GL_RGBA8);
    const gl::Program program_owner =
        gl::make_program(gl, {{GL_VERTEX_SHADER, "v", plain_vertex},
                              {GL_FRAGMENT_SHADER, "f", "#version 330 core\nvoid main() {}\n"}});
    const gl::Sync fence_owner = gl::make_fence(gl);
    buffer = buffer_owner.name();
    sampler = sampler_owner.name();
    framebuffer = target.framebuffer.name();
    program = program_owner.name();
    fence = fence_owner.name();
    CHECK(gl.IsVertexArray(array) == GL_TRUE);
    CHECK(gl.IsBuffer(buffer) == GL_TRUE);
    CHECK(gl.IsSampler(sampler) == GL_TRUE);
    CHECK(gl.IsFramebuffer(framebuffer) == GL_TRUE);
    CHECK(gl.IsProgram(program) == GL_TRUE);
    CHECK(gl.IsSync(fence) == GL_TRUE);
  }
  CHECK(gl.IsVertexArray(array) == GL_FALSE);
  CHECK(gl.IsBuffer(buffer) == GL_FALSE);
  CHECK(gl.IsSampler(sampler) == GL_FALSE);
  CHECK(gl.IsFramebuffer(framebuffer) == GL_FALSE);
  CHECK(gl.IsProgram(program) == GL_FALSE);
  CHECK(gl.IsSync(fence) == GL_FALSE);
  gl::check_errors(gl, "handles");
}

TEST_CASE("pending errors are thrown by name and cleared") {
  const gl::Context context = test_context();
  const Functions& gl = context.functions();
  gl::check_errors(gl, "nothing yet");
  gl.Enable(GL_TEXTURE_3D + 0x10000);
  CHECK_THROWS_WITH(gl::check_errors(gl, "enable"), "enable: GL_INVALID_ENUM");
  gl::check_errors(gl, "cleared");
}

TEST_CASE("a compile error names the piece and its line") {
  const gl::Context context = test_context();
  const Functions& gl = context.functions();
  const gl::ShaderSource head = {GL_FRAGMENT_SHADER, "head.glsl", "#version 330 core\nout vec4 color;\n"};
  const gl::ShaderSource fine = {GL_FRAGMENT_SHADER, "lib/fine.glsl", "float one() {\n  return 1.0;\n}"};
  const gl::ShaderSource broken = {GL_FRAGMENT_SHADER, "lib/broken.glsl",
                                   "// a comment\n\nfloat two() { return nonsense; }\n"};
  const gl::ShaderSource main = {GL_FRAGMENT_SHADER, "main.frag", "void main() { color = vec4(one()); }\n"};
  const gl::ShaderSource vertex = {GL_VERTEX_SHADER, "plain.vert", plain_vertex};
  CHECK(program_error(gl, {vertex, head, fine, main}).empty());

  const std::string third = program_error(gl, {vertex, head, fine, broken, main});
  CHECK_THAT(third, Catch::Matchers::StartsWith("lib/broken.glsl:3: "));
  CHECK_THAT(third, Catch::Matchers::Contains("nonsense") && Catch::Matchers::Contains("(fragment shader)"));
  CHECK(third.find('\n') == std::string::npos);

  const gl::ShaderSource broken_head = {GL_FRAGMENT_SHADER, "head.glsl",
                                        "#version 330 core\nout vec4 color = ;\n"};
  CHECK_THAT(program_error(gl, {vertex, broken_head, main}), Catch::Matchers::StartsWith("head.glsl:2: "));

  // Before GLSL 3.30, #line counts from the next line but one.
  const gl::ShaderSource old_head = {GL_FRAGMENT_SHADER, "old.glsl", "#version 140\nout vec4 color;\n"};
  CHECK_THAT(program_error(gl, {vertex, old_head, fine, broken, main}),
             Catch::Matchers::StartsWith("lib/broken.glsl:3: "));
}

TEST_CASE("a link error names the pieces") {
  const gl::Context context = test_context();
  const std::string message = program_error(
      context.functions(),
      {{GL_VERTEX_SHADER, "plain.vert", plain_vertex},
       {GL_FRAGMENT_SHADER, "calls.frag",
        "#version 330 core\nfloat absent();\nout vec4 c;\nvoid main() { c = vec4(absent()); }\n"}});
  CHECK_THAT(message, Catch::Matchers::StartsWith("program of plain.vert + calls.frag does not link: "));
  CHECK_THAT(message, Catch::Matchers::Contains("absent"));
}

TEST_CASE("setting a uniform that the compiler removed does nothing") {
  const gl::Context context = test_context();
  const Functions& gl = context.functions();
  const gl::Program program = gl::make_program(gl, {{GL_VERTEX_SHADER, "plain.vert", plain_vertex},
                                                    {GL_FRAGMENT_SHADER, "f",
                                                     "#version 330 core\nuniform vec3 unused;\nuniform vec4 "
                                                     "used;\nout vec4 c;\nvoid main() { c = used; }\n"}});
  gl.UseProgram(program.name());
  CHECK(gl::uniform_location(gl, program, "unused") == -1);
  gl::set_uniform(gl, program, "unused", glm::vec3(1.0f));
  gl::set_uniform(gl, program, "used", glm::vec4(1.0f, 2.0f, 3.0f, 4.0f));
  gl::check_errors(gl, "uniforms");
  float value[4] = {};
  gl.GetUniformfv(program.name(), gl::uniform_location(gl, program, "used"), value);
  CHECK(value[0] == 1.0f);
  CHECK(value[3] == 4.0f);
  gl::set_uniform(gl, program, "used", 1); // the wrong type is an error, not a silent default
  CHECK_THROWS_AS(gl::check_errors(gl, "wrong type"), GraphicsError);
}

TEST_CASE("a state guard restores what a pass changes") {
  const gl::Context context = test_context();
  const Functions& gl = context.functions();
  const gl::Target outer = gl::make_target(gl, 8, 8, GL_RGBA8);
  const gl::Target inner = gl::make_target(gl, 4, 4, GL_RGBA8);
  const gl::VertexArray array = gl::make_vertex_array(gl);
  const gl::Texture texture = gl::make_texture_3d(gl, {}, {2, 2, 2}, std::span<const std::byte>());
  const gl::Sampler sampler = gl::make_sampler(gl, GL_NEAREST, GL_CLAMP_TO_EDGE);
  const gl::Program program =
      gl::make_program(gl, {{GL_VERTEX_SHADER, "v", plain_vertex},
                            {GL_FRAGMENT_SHADER, "f", "#version 330 core\nvoid main() {}\n"}});
  gl::bind_target(gl, outer);
  gl.Enable(GL_BLEND);
  gl.BlendFuncSeparate(GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_DST_ALPHA);
  gl.BlendEquationSeparate(GL_MAX, GL_MIN);
  gl.Disable(GL_DITHER);
  gl.ClearColor(0.5f, 0.0f, 0.0f, 0.0f);
  gl.PixelStorei(GL_UNPACK_ALIGNMENT, 2);
  gl.PixelStorei(GL_PACK_ROW_LENGTH, 77);
  gl.ColorMask(GL_TRUE, GL_FALSE, GL_TRUE, GL_FALSE);
  gl.UseProgram(program.name());
  gl.BindVertexArray(array.name());
  gl.ActiveTexture(GL_TEXTURE3);
  gl.BindTexture(GL_TEXTURE_3D, texture.name());
  gl.BindSampler(3, sampler.name());
  gl.ActiveTexture(GL_TEXTURE1);
  {
    const gl::StateGuard guard(gl);
    gl::bind_target(gl, inner);
    gl.Disable(GL_BLEND);
    gl.BlendFunc(GL_DST_COLOR, GL_ZERO);
    gl.BlendEquation(GL_FUNC_ADD);
    gl.Enable(GL_DITHER);
    gl.ClearColor(0.0f, 0.0f, 0.0f, 1.0f);
    gl.PixelStorei(GL_UNPACK_ALIGNMENT, 8);
    gl.PixelStorei(GL_PACK_ROW_LENGTH, 0);
    gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl.UseProgram(0);
    gl.BindVertexArray(0);
    gl.ActiveTexture(GL_TEXTURE3);
    gl.BindTexture(GL_TEXTURE_3D, 0);
    gl.BindSampler(3, 0);
  }
  CHECK(integer_of(gl, GL_DRAW_FRAMEBUFFER_BINDING) == static_cast<GLint>(outer.framebuffer.name()));
  GLint viewport[4] = {};
  gl.GetIntegerv(GL_VIEWPORT, viewport);
  CHECK(viewport[2] == 8);
  CHECK(gl.IsEnabled(GL_BLEND) == GL_TRUE);
  CHECK(gl.IsEnabled(GL_DITHER) == GL_FALSE);
  CHECK(integer_of(gl, GL_BLEND_SRC_RGB) == GL_ONE);
  CHECK(integer_of(gl, GL_BLEND_DST_RGB) == GL_ONE_MINUS_SRC_ALPHA);
  CHECK(integer_of(gl, GL_BLEND_SRC_ALPHA) == GL_ZERO);
  CHECK(integer_of(gl, GL_BLEND_DST_ALPHA) == GL_DST_ALPHA);
  CHECK(integer_of(gl, GL_BLEND_EQUATION_RGB) == GL_MAX);
  CHECK(integer_of(gl, GL_BLEND_EQUATION_ALPHA) == GL_MIN);
  GLfloat clear[4] = {};
  gl.GetFloatv(GL_COLOR_CLEAR_VALUE, clear);
  CHECK(clear[0] == 0.5f);
  CHECK(clear[3] == 0.0f);
  CHECK(integer_of(gl, GL_UNPACK_ALIGNMENT) == 2);
  CHECK(integer_of(gl, GL_PACK_ROW_LENGTH) == 77);
  GLboolean mask[4] = {};
  gl.GetBooleanv(GL_COLOR_WRITEMASK, mask);
  CHECK(mask[0] == GL_TRUE);
  CHECK(mask[1] == GL_FALSE);
  CHECK(integer_of(gl, GL_CURRENT_PROGRAM) == static_cast<GLint>(program.name()));
  CHECK(integer_of(gl, GL_VERTEX_ARRAY_BINDING) == static_cast<GLint>(array.name()));
  CHECK(integer_of(gl, GL_ACTIVE_TEXTURE) == GL_TEXTURE1);
  gl.ActiveTexture(GL_TEXTURE3);
  CHECK(integer_of(gl, GL_TEXTURE_BINDING_3D) == static_cast<GLint>(texture.name()));
  CHECK(integer_of(gl, GL_SAMPLER_BINDING) == static_cast<GLint>(sampler.name()));
  gl::check_errors(gl, "guard");
}

TEST_CASE("a state guard outlives an object that was bound") {
  const gl::Context context = test_context();
  const Functions& gl = context.functions();
  gl::Target target = gl::make_target(gl, 4, 4, GL_RGBA8);
  gl::bind_target(gl, target);
  {
    const gl::StateGuard guard(gl);
    target.framebuffer.reset();
  }
  gl::check_errors(gl, "guard"); // binding a deleted name would be GL_INVALID_OPERATION
  CHECK(integer_of(gl, GL_DRAW_FRAMEBUFFER_BINDING) == 0);
}

TEST_CASE("a timer query measures work, or says that it cannot") {
  const gl::Context context = test_context();
  const Functions& gl = context.functions();
  const gl::Target target = gl::make_target(gl, 256, 256, GL_RGBA32F);
  gl::bind_target(gl, target);
  gl::TimerQuery query(gl);
  const double seconds = gl::elapsed_seconds(gl, [&] {
    query.begin();
    for (int i = 0; i < 20; ++i)
      gl.Clear(GL_COLOR_BUFFER_BIT);
    query.end();
  });
  CHECK(seconds > 0.0);
  const std::optional<std::uint64_t> nanoseconds = query.result_nanoseconds();
  if (context.info().limits.timer_query_bits == 0)
    CHECK_FALSE(nanoseconds.has_value());
  // softpipe's timer is sound; llvmpipe's first query claims the machine's uptime and is then withheld.
  if (softpipe_requested())
    CHECK(nanoseconds.has_value());
  if (nanoseconds) {
    CHECK(*nanoseconds > 0);
    CHECK(query.available());
  }
  gl::check_errors(gl, "timer");
}
