#include "render/grid_textures.h"

#include "core/errors.h"

namespace slicelens {

std::vector<gl::Texture> upload_grids(const gl::Functions& gl, const std::vector<WarpMap>& maps) {
  std::vector<gl::Texture> textures;
  for (const WarpMap& map : maps) {
    const auto* held = std::get_if<GridMap>(&map);
    if (held == nullptr)
      continue;
    if (textures.size() == max_grids) {
      throw UsageError("a list of warps can hold at most " + std::to_string(max_grids) +
                       " landmarks and fields; pipeline 'grid' draws any number");
    }
    const MapGrid& grid = *held->grid;
    gl::TextureSpec spec;
    spec.format = GL_RGBA32F;
    const std::array<int, 3> size = {static_cast<int>(grid.size[0]), static_cast<int>(grid.size[1]),
                                     static_cast<int>(grid.size[2])};
    textures.push_back(gl::make_texture_3d(gl, spec, size, std::as_bytes(std::span(grid.offsets))));
  }
  return textures;
}

void bind_grids(const gl::Functions& gl, const std::vector<gl::Texture>& grids,
                const std::vector<GLenum>& units) {
  for (std::size_t i = 0; i < grids.size(); ++i) {
    gl.ActiveTexture(GL_TEXTURE0 + units.at(i));
    gl.BindTexture(GL_TEXTURE_3D, grids[i].name());
  }
}

std::size_t grid_bytes(const std::vector<WarpMap>& maps) {
  std::size_t bytes = 0;
  for (const WarpMap& map : maps) {
    if (const auto* held = std::get_if<GridMap>(&map))
      bytes += held->grid->offsets.size() * sizeof(glm::vec4);
  }
  return bytes;
}

} // namespace slicelens
