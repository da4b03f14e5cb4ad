#include "gl/fixed_function.h"

#include "core/errors.h"

namespace slicelens::gl {

namespace {

/// Everything besides StateGuard's switches that can stand between a textured triangle and its pixels.
/// Texture targets and generated coordinates are those of unit 0; the clip planes are the first six clip
/// distances.
constexpr std::array<GLenum, fixed_switch_count> switch_names = {0x0B50, // GL_LIGHTING
                                                                 0x0B60, // GL_FOG
                                                                 0x0BC0, // GL_ALPHA_TEST
                                                                 0x0C60, // GL_TEXTURE_GEN_S
                                                                 0x0C61, // GL_TEXTURE_GEN_T
                                                                 0x0C62, // GL_TEXTURE_GEN_R
                                                                 0x0C63, // GL_TEXTURE_GEN_Q
                                                                 0x8458, // GL_COLOR_SUM
                                                                 0x0B42, // GL_POLYGON_STIPPLE
                                                                 GL_POLYGON_SMOOTH,
                                                                 GL_COLOR_LOGIC_OP,
                                                                 GL_STENCIL_TEST,
                                                                 GL_TEXTURE_1D,
                                                                 GL_TEXTURE_2D,
                                                                 GL_TEXTURE_3D,
                                                                 GL_TEXTURE_CUBE_MAP,
                                                                 GL_CLIP_DISTANCE0,
                                                                 GL_CLIP_DISTANCE1,
                                                                 GL_CLIP_DISTANCE2,
                                                                 GL_CLIP_DISTANCE3,
                                                                 GL_CLIP_DISTANCE4,
                                                                 GL_CLIP_DISTANCE5};

struct Matrix {
  GLenum mode;
  GLenum value;
};
constexpr std::array<Matrix, 3> matrix_names = {{{fixed::modelview, fixed::modelview_matrix},
                                                 {fixed::projection, fixed::projection_matrix},
                                                 {GL_TEXTURE, fixed::texture_matrix}}};

template <class Function>
void load(const Context& context, const char* name, Function& function) {
  function = reinterpret_cast<Function>(context.proc_address(name));
  if (function == nullptr)
    throw GraphicsError(std::string("this compatibility context has no function ") + name);
}

} // namespace

FixedFunctions load_fixed_functions(const Context& context) {
  if (context.info().profile != "compatibility") {
    throw GraphicsError("fixed-function drawing needs a compatibility context; this one (" +
                        context.info().kind + ") has the core profile");
  }
  FixedFunctions functions;
  load(context, "glMatrixMode", functions.MatrixMode);
  load(context, "glLoadMatrixf", functions.LoadMatrixf);
  load(context, "glLoadIdentity", functions.LoadIdentity);
  load(context, "glTexEnvi", functions.TexEnvi);
  load(context, "glGetTexEnviv", functions.GetTexEnviv);
  load(context, "glClientActiveTexture", functions.ClientActiveTexture);
  load(context, "glEnableClientState", functions.EnableClientState);
  load(context, "glVertexPointer", functions.VertexPointer);
  load(context, "glTexCoordPointer", functions.TexCoordPointer);
  return functions;
}

FixedFunctionGuard::FixedFunctionGuard(const Functions& gl, const FixedFunctions& fixed)
    : gl_(gl), fixed_(fixed) {
  gl.GetIntegerv(GL_ACTIVE_TEXTURE, &active_unit_);
  gl.GetIntegerv(fixed::client_active_texture, &client_unit_);
  gl.GetIntegerv(fixed::matrix_mode, &matrix_mode_);
  gl.ActiveTexture(GL_TEXTURE0);
  fixed.ClientActiveTexture(GL_TEXTURE0);
  for (std::size_t i = 0; i < switch_names.size(); ++i) {
    switches_[i] = gl.IsEnabled(switch_names[i]) != GL_FALSE;
    gl.Disable(switch_names[i]);
  }
  for (std::size_t i = 0; i < matrix_names.size(); ++i) {
    gl.GetFloatv(matrix_names[i].value, matrices_[i].data());
    fixed.MatrixMode(matrix_names[i].mode);
    fixed.LoadIdentity();
  }
  fixed.GetTexEnviv(fixed::texture_environment, fixed::texture_environment_mode, &environment_mode_);
  fixed.TexEnvi(fixed::texture_environment, fixed::texture_environment_mode, GL_REPLACE);
}

FixedFunctionGuard::~FixedFunctionGuard() {
  gl_.ActiveTexture(GL_TEXTURE0);
  fixed_.TexEnvi(fixed::texture_environment, fixed::texture_environment_mode, environment_mode_);
  for (std::size_t i = 0; i < matrix_names.size(); ++i) {
    fixed_.MatrixMode(matrix_names[i].mode);
    fixed_.LoadMatrixf(matrices_[i].data());
  }
  for (std::size_t i = 0; i < switch_names.size(); ++i) {
    if (switches_[i])
      gl_.Enable(switch_names[i]);
    else
      gl_.Disable(switch_names[i]);
  }
  fixed_.MatrixMode(static_cast<GLenum>(matrix_mode_));
  fixed_.ClientActiveTexture(static_cast<GLenum>(client_unit_));
  gl_.ActiveTexture(static_cast<GLenum>(active_unit_));
}

} // namespace slicelens::gl
