#include "gl/program.h"

#include "core/errors.h"
#include "core/text.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>

namespace slicelens::gl {
namespace {

using Pieces = std::vector<const ShaderSource*>;

const char* stage_name(GLenum stage) {
  switch (stage) {
  case GL_VERTEX_SHADER:
    return "vertex shader";
  case GL_GEOMETRY_SHADER:
    return "geometry shader";
  case GL_FRAGMENT_SHADER:
    return "fragment shader";
  case GL_COMPUTE_SHADER:
    return "compute shader";
  default:
    return "shader";
  }
}

/// The number after #version, or 110, which GLSL takes without one.
int glsl_version(const std::string& text) {
  const std::size_t at = text.find("#version");
  return at == std::string::npos ? 110 : std::atoi(text.c_str() + at + 8);
}

// Every piece has a range of line numbers of its own. GLSL's string numbers (`#line line string`) were meant
// for this, but Mesa reports string 0 for errors in expressions whatever they say.
constexpr std::size_t lines_per_piece = 100000;

/// All pieces as one text, each after a #line that starts its range.
std::string concatenate(const Pieces& pieces) {
  // The line after `#line n` is n from GLSL 3.30 on and n + 1 before.
  const std::size_t first_line = glsl_version(pieces.front()->text) >= 330 ? 1 : 0;
  std::string text;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (i > 0) // nothing may stand before #version, and the first piece starts at line 1 anyway
      text += "#line " + std::to_string(i * lines_per_piece + first_line) + "\n";
    text += pieces[i]->text;
    if (!text.empty() && text.back() != '\n')
      text += '\n';
  }
  return text;
}

/// Reads an unsigned number at `at` and moves past it; false when there is none.
bool read_number(const std::string& line, std::size_t& at, std::size_t& number) {
  if (at >= line.size() || std::isdigit(static_cast<unsigned char>(line[at])) == 0)
    return false;
  number = 0;
  for (; at < line.size() && std::isdigit(static_cast<unsigned char>(line[at])) != 0; ++at)
    number =
        std::min<std::size_t>(number * 10 + static_cast<std::size_t>(line[at] - '0'), std::size_t{1} << 30);
  return true;
}

/// "0:12(3): error: …" (Mesa), "0(12) : error …" (NVIDIA) and "ERROR: 0:12: …" (others) become "piece:12: …".
std::string with_names(std::string line, const Pieces& pieces) {
  for (const char* prefix : {"ERROR: ", "error: "})
    if (line.rfind(prefix, 0) == 0)
      line.erase(0, 7);
  std::size_t at = 0;
  std::size_t string = 0;
  std::size_t number = 0;
  if (!read_number(line, at, string) || at >= line.size() || (line[at] != ':' && line[at] != '('))
    return line;
  if (!read_number(line, ++at, number) || number / lines_per_piece >= pieces.size())
    return line;
  const std::size_t text = line.find_first_not_of("0123456789():, \t", at);
  return pieces[number / lines_per_piece]->name + ":" + std::to_string(number % lines_per_piece) + ": " +
         (text == std::string::npos ? "" : line.substr(text));
}

/// The first line of a log that reports an error, or its first line.
std::string first_error(const std::string& log) {
  std::string first;
  for (std::size_t at = 0; at < log.size();) {
    const std::size_t end = std::min(log.find('\n', at), log.size());
    std::string line = log.substr(at, end - at);
    at = end + 1;
    if (!line.empty() && line.back() == '\r')
      line.pop_back();
    if (lower(line).find("error") != std::string::npos)
      return line;
    if (first.empty())
      first = line;
  }
  return first.empty() ? "the driver gives no reason" : first;
}

std::string shader_log(const Functions& gl, GLuint shader) {
  GLint length = 0;
  gl.GetShaderiv(shader, GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
  gl.GetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), nullptr, log.data());
  return log.c_str();
}

std::string program_log(const Functions& gl, GLuint program) {
  GLint length = 0;
  gl.GetProgramiv(program, GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
  gl.GetProgramInfoLog(program, static_cast<GLsizei>(log.size()), nullptr, log.data());
  return log.c_str();
}

Shader compile(const Functions& gl, GLenum stage, const Pieces& pieces) {
  Shader shader(gl, gl.CreateShader(stage));
  if (!shader)
    throw GraphicsError(pieces.front()->name + ": the driver has no " + stage_name(stage));
  const std::string text = concatenate(pieces);
  const GLchar* string = text.c_str();
  gl.ShaderSource(shader.name(), 1, &string, nullptr);
  gl.CompileShader(shader.name());
  GLint compiled = GL_FALSE;
  gl.GetShaderiv(shader.name(), GL_COMPILE_STATUS, &compiled);
  if (compiled == GL_FALSE) {
    const std::string line = first_error(shader_log(gl, shader.name()));
    const std::string named = with_names(line, pieces);
    const bool has_name = named != line;
    throw GraphicsError((has_name ? "" : pieces.front()->name + ": ") + named + " (" + stage_name(stage) +
                        ")");
  }
  return shader;
}

std::string names_of(const std::vector<ShaderSource>& sources) {
  std::vector<std::string> names;
  for (const ShaderSource& source : sources)
    names.push_back(source.name);
  return join(names, " + ");
}

} // namespace

Program make_program(const Functions& gl, const std::vector<ShaderSource>& sources) {
  std::vector<std::pair<GLenum, Pieces>> stages;
  for (const ShaderSource& source : sources) {
    auto stage =
        std::find_if(stages.begin(), stages.end(), [&](const auto& s) { return s.first == source.stage; });
    if (stage == stages.end())
      stage = stages.insert(stages.end(), {source.stage, {}});
    stage->second.push_back(&source);
  }
  Program program(gl, gl.CreateProgram());
  std::vector<Shader> shaders;
  for (const auto& [stage, pieces] : stages) {
    shaders.push_back(compile(gl, stage, pieces));
    gl.AttachShader(program.name(), shaders.back().name());
  }
  gl.LinkProgram(program.name());
  for (const Shader& shader : shaders)
    gl.DetachShader(program.name(), shader.name());
  GLint linked = GL_FALSE;
  gl.GetProgramiv(program.name(), GL_LINK_STATUS, &linked);
  if (linked == GL_FALSE)
    throw GraphicsError("program of " + names_of(sources) +
                        " does not link: " + first_error(program_log(gl, program.name())));
  return program;
}

GLint uniform_location(const Functions& gl, const Uniforms& uniforms, const char* name) {
  if (uniforms.suffix.empty())
    return gl.GetUniformLocation(uniforms.program.name(), name);
  std::string full(name);
  full.insert(std::min(full.find_first_of(".["), full.size()), uniforms.suffix);
  return gl.GetUniformLocation(uniforms.program.name(), full.c_str());
}

void set_uniform(const Functions& gl, const Uniforms& uniforms, const char* name, int value) {
  gl.Uniform1i(uniform_location(gl, uniforms, name), value);
}
void set_uniform(const Functions& gl, const Uniforms& uniforms, const char* name, float value) {
  gl.Uniform1f(uniform_location(gl, uniforms, name), value);
}
void set_uniform(const Functions& gl, const Uniforms& uniforms, const char* name, const glm::ivec2& value) {
  gl.Uniform2iv(uniform_location(gl, uniforms, name), 1, &value[0]);
}
void set_uniform(const Functions& gl, const Uniforms& uniforms, const char* name, const glm::ivec3& value) {
  gl.Uniform3iv(uniform_location(gl, uniforms, name), 1, &value[0]);
}
void set_uniform(const Functions& gl, const Uniforms& uniforms, const char* name, const glm::vec2& value) {
  gl.Uniform2fv(uniform_location(gl, uniforms, name), 1, &value[0]);
}
void set_uniform(const Functions& gl, const Uniforms& uniforms, const char* name, const glm::vec3& value) {
  gl.Uniform3fv(uniform_location(gl, uniforms, name), 1, &value[0]);
}
void set_uniform(const Functions& gl, const Uniforms& uniforms, const char* name, const glm::vec4& value) {
  gl.Uniform4fv(uniform_location(gl, uniforms, name), 1, &value[0]);
}
void set_uniform(const Functions& gl, const Uniforms& uniforms, const char* name, const glm::mat3& value) {
  gl.UniformMatrix3fv(uniform_location(gl, uniforms, name), 1, GL_FALSE, &value[0][0]);
}
void set_uniform(const Functions& gl, const Uniforms& uniforms, const char* name, const glm::mat4& value) {
  gl.UniformMatrix4fv(uniform_location(gl, uniforms, name), 1, GL_FALSE, &value[0][0]);
}
void set_uniform(const Functions& gl, const Uniforms& uniforms, const char* name,
                 std::span<const glm::vec4> values) {
  if (!values.empty())
    gl.Uniform4fv(uniform_location(gl, uniforms, name), static_cast<GLsizei>(values.size()), &values[0][0]);
}

} // namespace slicelens::gl
