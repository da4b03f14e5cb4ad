#include "render/label_textures.h"

#include "render/pages.h"

#include <algorithm>
#include <cstring>

namespace slicelens {

namespace {

/// First of three units: those of a pyramid's levels, which two-level scenes do not have.
constexpr GLenum first_unit = 3;

gl::Texture upload_rows_of_voxels(const gl::Functions& gl, const PreparedScene& prepared,
                                  const Progress& progress) {
  gl::TextureSpec spec;
  spec.format = GL_R8UI;
  spec.filter = GL_NEAREST; // integer textures have no other
  const auto& dims = prepared.volume.dims;
  const std::array<int, 3> size = {static_cast<int>(dims[0]), static_cast<int>(dims[1]),
                                   static_cast<int>(dims[2])};
  const std::size_t plane = dims[0] * dims[1];
  return gl::make_texture_3d(
      gl, spec, size,
      [&](int z0, int, std::span<std::byte> slab) {
        std::memcpy(slab.data(), prepared.labels.rows.data() + static_cast<std::size_t>(z0) * plane,
                    slab.size());
      },
      progress);
}

} // namespace

LabelTextures upload_labels(const gl::Functions& gl, const PreparedScene& prepared,
                            const Progress& progress) {
  LabelTextures textures;
  const std::vector<LabelRow>& rows = prepared.labels.table;
  if (rows.empty())
    return textures;
  const bool eight_bit = prepared.scene.render.transfer_texture == TransferTexture::rgba8;
  std::vector<TransferTable> tables;
  std::size_t width = 0;
  for (const LabelRow& row : rows) {
    tables.push_back(make_table(row.transfer, eight_bit ? 256 : 0, prepared.volume.min, prepared.volume.max));
    width = std::max(width, texel_count(tables.back()));
  }
  std::vector<float> texels(4 * width * rows.size(), 0.0F);
  std::vector<glm::vec4> infos;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const TransferTable& table = tables[i];
    std::copy(table.rgba.begin(), table.rgba.end(),
              texels.begin() + static_cast<std::ptrdiff_t>(4 * width * i));
    const double last = static_cast<double>(texel_count(table) - 1);
    const double scale = last / (table.last - table.first);
    infos.emplace_back(scale, -scale * table.first, last, rows[i].length_ratio);
    infos.emplace_back(static_cast<float>(rows[i].mode), 0, 0, 0);
  }
  gl::TextureSpec spec;
  spec.format = eight_bit ? GL_RGBA8 : GL_RGBA32F;
  spec.source_type = GL_FLOAT;
  spec.filter = GL_NEAREST;
  const int height = static_cast<int>(rows.size());
  textures.table = gl::make_texture_2d(gl, spec, {static_cast<int>(width), height},
                                       std::as_bytes(std::span<const float>(texels)));
  spec.format = GL_RGBA32F;
  textures.rows =
      gl::make_texture_2d(gl, spec, {2, height}, std::as_bytes(std::span<const glm::vec4>(infos)));
  const bool paged = is_paged(prepared); // then they lie beside the bricks
  if (!paged)
    textures.labels = upload_rows_of_voxels(gl, prepared, progress);
  textures.bytes = (paged ? 0 : prepared.labels.rows.size()) + width * rows.size() * (eight_bit ? 4 : 16) +
                   32 * rows.size();
  return textures;
}

void set_labels(const gl::Functions& gl, const gl::Program& program, const LabelTextures& textures,
                const gl::Texture& rows_of_voxels) {
  const auto bind = [&](const char* name, GLenum unit, GLenum target, const gl::Texture& texture) {
    gl.ActiveTexture(GL_TEXTURE0 + unit);
    gl.BindTexture(target, texture.name());
    set_uniform(gl, program, name, static_cast<int>(unit));
  };
  bind("label_texture", first_unit, GL_TEXTURE_3D, rows_of_voxels);
  bind("label_table", first_unit + 1, GL_TEXTURE_2D, textures.table);
  bind("label_rows", first_unit + 2, GL_TEXTURE_2D, textures.rows);
}

} // namespace slicelens
