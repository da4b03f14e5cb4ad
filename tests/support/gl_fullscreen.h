// Runs a fragment shader once per pixel of a target: the simplest way for a test to see what a shader
// computes.
#pragma once

#include "gl/check.h"
#include "gl/program.h"
#include "gl/target.h"

#include <string>

/// A program whose fragment shader is `#version 330 core`, `out vec4 color;` and then `body`, run on one
/// triangle that covers the viewport. gl_FragCoord gives the pixel, y upwards.
inline slicelens::gl::Program fullscreen_program(const slicelens::gl::Functions& gl,
                                                 const std::string& body) {
  return slicelens::gl::make_program(
      gl, {{GL_VERTEX_SHADER, "fullscreen.vert",
            "#version 330 core\n"
            "void main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, "
            "0.0, 1.0); }\n"},
           {GL_FRAGMENT_SHADER, "head.frag", "#version 330 core\nout vec4 color;\n"},
           {GL_FRAGMENT_SHADER, "body.frag", body}});
}

/// Draws it into what is bound.
inline void draw_fullscreen(const slicelens::gl::Functions& gl, const slicelens::gl::Program& program) {
  const slicelens::gl::VertexArray array = slicelens::gl::make_vertex_array(gl);
  gl.BindVertexArray(array.name());
  gl.UseProgram(program.name());
  gl.DrawArrays(GL_TRIANGLES, 0, 3);
  slicelens::gl::check_errors(gl, "draw_fullscreen");
}
