// Shader programs from named pieces of source.
#pragma once

#include "gl/handle.h"

#include <glm/glm.hpp>

#include <string>
#include <utility>
#include <vector>

namespace slicelens::gl {

/// One piece of GLSL. The pieces of a stage are compiled as one shader in the order given; the first one of
/// each stage starts with its #version.
struct ShaderSource {
  GLenum stage = GL_FRAGMENT_SHADER; ///< GL_VERTEX_SHADER, GL_GEOMETRY_SHADER, GL_FRAGMENT_SHADER …
  std::string name;                  ///< as messages should name it, for instance "lib/composite.glsl"
  std::string text;
};

/// Compiles and links. Throws GraphicsError with the driver's first error, "<piece>:<line>: <driver's text>"
/// where the driver gives a line; warnings are ignored.
Program make_program(const Functions& gl, const std::vector<ShaderSource>& sources);

/// The uniforms of a program. `suffix` ends the name of each, before its first "." or "[": programs that hold
/// the same declarations more than once tell them apart by it.
struct Uniforms {
  const Program& program;
  std::string suffix;

  Uniforms(const Program& program_, std::string suffix_ = {})
      : program(program_), suffix(std::move(suffix_)) {}
};

/// Location of a uniform, or -1 when the program has none of that name or the compiler removed it as unused:
/// glUniform* ignores -1.
GLint uniform_location(const Functions& gl, const Uniforms& uniforms, const char* name);

/// Sets a uniform of the program in use (glUseProgram). A uniform that the compiler removed is ignored; a
/// type that does not fit is an OpenGL error (check_errors). Samplers are set as int (their texture unit).
void set_uniform(const Functions& gl, const Uniforms& uniforms, const char* name, int value);
void set_uniform(const Functions& gl, const Uniforms& uniforms, const char* name, float value);
void set_uniform(const Functions& gl, const Uniforms& uniforms, const char* name, const glm::ivec2& value);
void set_uniform(const Functions& gl, const Uniforms& uniforms, const char* name, const glm::ivec3& value);
void set_uniform(const Functions& gl, const Uniforms& uniforms, const char* name, const glm::vec2& value);
void set_uniform(const Functions& gl, const Uniforms& uniforms, const char* name, const glm::vec3& value);
void set_uniform(const Functions& gl, const Uniforms& uniforms, const char* name, const glm::vec4& value);
void set_uniform(const Functions& gl, const Uniforms& uniforms, const char* name, const glm::mat3& value);
void set_uniform(const Functions& gl, const Uniforms& uniforms, const char* name, const glm::mat4& value);
/// Elements 0 … of an array.
void set_uniform(const Functions& gl, const Uniforms& uniforms, const char* name,
                 std::span<const glm::vec4> values);

} // namespace slicelens::gl
