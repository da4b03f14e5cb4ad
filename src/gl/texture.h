// Textures of one, two and three dimensions.
#pragma once

#include "core/progress.h"
#include "gl/handle.h"

#include <array>
#include <functional>

namespace slicelens::gl {

/// How a texture stores and reads its texels.
struct TextureSpec {
  GLenum format = GL_R8;          ///< sized internal format; see texel_layout for those known
  GLenum filter = GL_LINEAR;      ///< GL_NEAREST or GL_LINEAR; no mip levels
  GLenum wrap = GL_CLAMP_TO_EDGE; ///< for all axes
  std::array<float, 4> border{};  ///< what GL_CLAMP_TO_BORDER reads
  GLenum source_type = 0;         ///< type of one value of the data given (GL_FLOAT …); 0: the format's own
};

/// How texels lie in memory when they are given to or read from a texture of a format.
struct TexelLayout {
  GLenum format = GL_RED; ///< GL_RED, GL_RG, GL_RGB, GL_RGBA or their _INTEGER forms
  GLenum type = GL_UNSIGNED_BYTE;
  std::size_t bytes = 1; ///< per texel
};

/// The layout for the formats R, RG, RGB and RGBA with 8, 16, 8_SNORM, 16_SNORM, 16F and 32F, and 8, 16 and
/// 32 bit integers (I, UI) of R and RG. `source_type` replaces the type of one value unless 0. Throws
/// GraphicsError for other formats.
TexelLayout texel_layout(GLenum format, GLenum source_type = 0);

/// Writes the texels of the planes z0 ≤ z < z1 into `slab`, which has exactly their size: x fastest, then y,
/// then z, tightly packed, no row padding.
using FillSlab = std::function<void(int z0, int z1, std::span<std::byte> slab)>;

/// Bytes of one upload step: small beside a volume, large beside the cost of a call.
inline constexpr std::size_t slab_bytes = std::size_t{16} << 20;

/// Textures of the given size in texels. `data` holds all texels tightly packed in the layout of `spec`, row
/// y = 0 first (t = 0), or is empty for a texture without defined content. They leave the bindings, the pixel
/// store and the unpack buffer as they were. Errors: LimitError when the size is above the driver's limit
/// (naming both) or the driver has no memory for it; GraphicsError when `data` has another size than the
/// texture.
Texture make_texture_1d(const Functions& gl, const TextureSpec& spec, int width,
                        std::span<const std::byte> data);
Texture make_texture_2d(const Functions& gl, const TextureSpec& spec, std::array<int, 2> size,
                        std::span<const std::byte> data);
Texture make_texture_3d(const Functions& gl, const TextureSpec& spec, std::array<int, 3> size,
                        std::span<const std::byte> data);

/// The same, filled by calls of `fill` for slabs of at most slab_bytes (or one plane, when a plane is
/// larger), so that no second copy of the volume is needed. Slabs come in order and cover every plane once.
/// Reports the stage "upload". An exception from `fill` goes on and leaves no texture behind.
Texture make_texture_3d(const Functions& gl, const TextureSpec& spec, std::array<int, 3> size,
                        const FillSlab& fill, const Progress& progress = {});

/// Replaces the texels of a box of a 3D texture that was made with `spec`: `data` holds them tightly packed.
/// Bindings and pixel store stay as they were. Throws GraphicsError when `data` has another size or the box
/// does not lie in the texture.
void update_texture_3d(const Functions& gl, const Texture& texture, const TextureSpec& spec,
                       std::array<int, 3> first, std::array<int, 3> size, std::span<const std::byte> data);

} // namespace slicelens::gl
