#include "render/axis_textures.h"

#include "gl/check.h"
#include "gl/state.h"

namespace slicelens {

std::size_t upload_axis_tables(const gl::Functions& gl, const PreparedScene& prepared,
                               AxisTextures& textures) {
  const gl::TextureBindingGuard guard(gl, GL_TEXTURE_1D);
  std::size_t bytes = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::vector<glm::vec4>& texels = prepared.tables.texels[axis];
    const auto data = std::as_bytes(std::span(texels));
    bytes += data.size();
    GLint width = 0;
    if (textures[axis]) {
      gl.BindTexture(GL_TEXTURE_1D, textures[axis].name());
      gl.GetTexLevelParameteriv(GL_TEXTURE_1D, 0, GL_TEXTURE_WIDTH, &width);
    }
    if (static_cast<std::size_t>(width) == texels.size()) {
      const gl::UnpackGuard unpack(gl);
      gl.TexSubImage1D(GL_TEXTURE_1D, 0, 0, width, GL_RGBA, GL_FLOAT, data.data());
      continue;
    }
    gl::TextureSpec spec;
    spec.format = GL_RGBA32F;
    spec.filter = prepared.scene.render.axis_filter == AxisFilter::linear ? GL_LINEAR : GL_NEAREST;
    textures[axis] = gl::make_texture_1d(gl, spec, static_cast<int>(texels.size()), data);
  }
  gl::check_errors(gl, "writing the axis tables");
  return bytes;
}

} // namespace slicelens
