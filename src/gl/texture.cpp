#include "gl/texture.h"

#include "core/errors.h"
#include "gl/check.h"
#include "gl/state.h"

#include <algorithm>

namespace slicelens::gl {
namespace {

struct FormatLayout {
  GLenum internal;
  GLenum format;
  GLenum type;
};

#define SLICELENS_NORMALISED(prefix, layout)                                                                 \
  {prefix##8, layout, GL_UNSIGNED_BYTE}, {prefix##16, layout, GL_UNSIGNED_SHORT},                            \
      {prefix##8_SNORM, layout, GL_BYTE}, {prefix##16_SNORM, layout, GL_SHORT},                              \
      {prefix##16F, layout, GL_HALF_FLOAT}, {                                                                \
    prefix##32F, layout, GL_FLOAT                                                                            \
  }
#define SLICELENS_INTEGER(prefix, layout)                                                                    \
  {prefix##8UI, layout, GL_UNSIGNED_BYTE}, {prefix##16UI, layout, GL_UNSIGNED_SHORT},                        \
      {prefix##32UI, layout, GL_UNSIGNED_INT}, {prefix##8I, layout, GL_BYTE},                                \
      {prefix##16I, layout, GL_SHORT}, {                                                                     \
    prefix##32I, layout, GL_INT                                                                              \
  }

constexpr FormatLayout layouts[] = {
    SLICELENS_NORMALISED(GL_R, GL_RED),      SLICELENS_NORMALISED(GL_RG, GL_RG),
    SLICELENS_NORMALISED(GL_RGB, GL_RGB),    SLICELENS_NORMALISED(GL_RGBA, GL_RGBA),
    SLICELENS_INTEGER(GL_R, GL_RED_INTEGER), SLICELENS_INTEGER(GL_RG, GL_RG_INTEGER),
};
#undef SLICELENS_NORMALISED
#undef SLICELENS_INTEGER

std::size_t channels_of(GLenum format) {
  switch (format) {
  case GL_RED:
  case GL_RED_INTEGER:
    return 1;
  case GL_RG:
  case GL_RG_INTEGER:
    return 2;
  case GL_RGB:
    return 3;
  default:
    return 4;
  }
}

std::size_t bytes_of(GLenum type) {
  switch (type) {
  case GL_BYTE:
  case GL_UNSIGNED_BYTE:
    return 1;
  case GL_SHORT:
  case GL_UNSIGNED_SHORT:
  case GL_HALF_FLOAT:
    return 2;
  case GL_INT:
  case GL_UNSIGNED_INT:
  case GL_FLOAT:
    return 4;
  default:
    throw GraphicsError("texture source type " + error_name(type) +
                        " is not a byte, short, int, half or float");
  }
}

/// One texture being made: what all three dimensions share.
struct Job {
  const Functions& gl;
  const TextureSpec& spec;
  TexelLayout layout;
  int dimensions;
  GLenum target;
  GLenum proxy;
  GLenum limit_name;
  std::array<int, 3> size;
};

Job make_job(const Functions& gl, const TextureSpec& spec, int dimensions, std::array<int, 3> size) {
  const TexelLayout layout = texel_layout(spec.format, spec.source_type);
  if (dimensions == 1)
    return {gl, spec, layout, 1, GL_TEXTURE_1D, GL_PROXY_TEXTURE_1D, GL_MAX_TEXTURE_SIZE, size};
  if (dimensions == 2)
    return {gl, spec, layout, 2, GL_TEXTURE_2D, GL_PROXY_TEXTURE_2D, GL_MAX_TEXTURE_SIZE, size};
  return {gl, spec, layout, 3, GL_TEXTURE_3D, GL_PROXY_TEXTURE_3D, GL_MAX_3D_TEXTURE_SIZE, size};
}

std::string size_text(const Job& job) {
  std::string text = std::to_string(job.size[0]);
  for (std::size_t i = 1; i < static_cast<std::size_t>(job.dimensions); ++i)
    text += " x " + std::to_string(job.size[i]);
  return text;
}

std::size_t plane_bytes(const Job& job) {
  return checked_product(checked_product(static_cast<std::size_t>(job.size[0]),
                                         static_cast<std::size_t>(job.size[1]), "texture"),
                         job.layout.bytes, "texture");
}

std::size_t total_bytes(const Job& job) {
  return checked_product(plane_bytes(job), static_cast<std::size_t>(job.size[2]), "texture");
}

[[noreturn]] void throw_no_memory(const Job& job) {
  throw LimitError("the driver has no room for a texture of " + size_text(job) + " texels (" +
                   std::to_string(total_bytes(job) >> 20) + " MiB); a smaller one is needed");
}

void check_size(const Job& job) {
  GLint limit = 0;
  job.gl.GetIntegerv(job.limit_name, &limit);
  for (const int edge : job.size) {
    if (edge < 1)
      throw GraphicsError("a texture of " + size_text(job) + " texels; every edge must be at least 1");
    if (edge > limit)
      throw LimitError("a texture of " + size_text(job) + " texels is larger than this driver's limit of " +
                       std::to_string(limit) + " per edge");
  }
}

/// Defines the level-0 image of `target` (the texture or its proxy) without content.
void define_image(const Job& job, GLenum target) {
  const auto& [w, h, d] = job.size;
  const auto internal = static_cast<GLint>(job.spec.format);
  const GLenum format = job.layout.format;
  const GLenum type = job.layout.type;
  if (job.dimensions == 1)
    job.gl.TexImage1D(target, 0, internal, w, 0, format, type, nullptr);
  else if (job.dimensions == 2)
    job.gl.TexImage2D(target, 0, internal, w, h, 0, format, type, nullptr);
  else
    job.gl.TexImage3D(target, 0, internal, w, h, d, 0, format, type, nullptr);
}

void upload(const Job& job, int z0, int z1, const std::byte* data) {
  const auto& [w, h, d] = job.size;
  const GLenum format = job.layout.format;
  const GLenum type = job.layout.type;
  if (job.dimensions == 1)
    job.gl.TexSubImage1D(job.target, 0, 0, w, format, type, data);
  else if (job.dimensions == 2)
    job.gl.TexSubImage2D(job.target, 0, 0, 0, w, h, format, type, data);
  else
    job.gl.TexSubImage3D(job.target, 0, 0, 0, z0, w, h, z1 - z0, format, type, data);
}

void check_made(const Job& job) {
  const GLenum error = job.gl.GetError();
  if (error == GL_NO_ERROR)
    return;
  clear_errors(job.gl);
  if (error == GL_OUT_OF_MEMORY)
    throw_no_memory(job);
  throw GraphicsError("making a texture of " + size_text(job) + " texels: " + error_name(error));
}

void set_parameters(const Job& job) {
  const auto set = [&](GLenum name, GLenum value) {
    job.gl.TexParameteri(job.target, name, static_cast<GLint>(value));
  };
  set(GL_TEXTURE_MIN_FILTER, job.spec.filter);
  set(GL_TEXTURE_MAG_FILTER, job.spec.filter);
  set(GL_TEXTURE_WRAP_S, job.spec.wrap);
  if (job.dimensions > 1)
    set(GL_TEXTURE_WRAP_T, job.spec.wrap);
  if (job.dimensions > 2)
    set(GL_TEXTURE_WRAP_R, job.spec.wrap);
  set(GL_TEXTURE_BASE_LEVEL, 0);
  set(GL_TEXTURE_MAX_LEVEL, 0);
  job.gl.TexParameterfv(job.target, GL_TEXTURE_BORDER_COLOR, job.spec.border.data());
}

/// Makes the texture and lets `fill` upload into it while it is bound.
template <class Fill>
Texture make_texture(const Job& job, const Fill& fill) {
  check_size(job);
  (void)total_bytes(job); // refuses sizes that cannot be addressed
  check_errors(job.gl, "before making a texture");
  const TextureBindingGuard binding(job.gl, job.target);
  const UnpackGuard unpack(job.gl);
  define_image(job, job.proxy);
  GLint width = 0;
  job.gl.GetTexLevelParameteriv(job.proxy, 0, GL_TEXTURE_WIDTH, &width);
  if (job.gl.GetError() == GL_NO_ERROR && width == 0)
    throw_no_memory(job);
  clear_errors(job.gl);
  GLuint name = 0;
  job.gl.GenTextures(1, &name);
  Texture texture(job.gl, name);
  job.gl.BindTexture(job.target, name);
  set_parameters(job);
  define_image(job, job.target);
  check_made(job);
  fill();
  check_made(job);
  return texture;
}

Texture make_from_data(const Job& job, std::span<const std::byte> data) {
  const bool sizes_are_valid = *std::min_element(job.size.begin(), job.size.end()) > 0;
  if (sizes_are_valid && !data.empty() && data.size() != total_bytes(job))
    throw GraphicsError("a texture of " + size_text(job) + " texels needs " +
                        std::to_string(total_bytes(job)) + " bytes; " + std::to_string(data.size()) +
                        " were given");
  return make_texture(job, [&] {
    if (!data.empty())
      upload(job, 0, job.size[2], data.data());
  });
}

} // namespace

TexelLayout texel_layout(GLenum format, GLenum source_type) {
  for (const FormatLayout& layout : layouts) {
    if (layout.internal == format) {
      const GLenum type = source_type != 0 ? source_type : layout.type;
      return {layout.format, type, channels_of(layout.format) * bytes_of(type)};
    }
  }
  throw GraphicsError("texture format " + error_name(format) + " is not one of those that Slicelens uploads");
}

Texture make_texture_1d(const Functions& gl, const TextureSpec& spec, int width,
                        std::span<const std::byte> data) {
  return make_from_data(make_job(gl, spec, 1, {width, 1, 1}), data);
}

Texture make_texture_2d(const Functions& gl, const TextureSpec& spec, std::array<int, 2> size,
                        std::span<const std::byte> data) {
  return make_from_data(make_job(gl, spec, 2, {size[0], size[1], 1}), data);
}

Texture make_texture_3d(const Functions& gl, const TextureSpec& spec, std::array<int, 3> size,
                        std::span<const std::byte> data) {
  return make_from_data(make_job(gl, spec, 3, size), data);
}

Texture make_texture_3d(const Functions& gl, const TextureSpec& spec, std::array<int, 3> size,
                        const FillSlab& fill, const Progress& progress) {
  const Job job = make_job(gl, spec, 3, size);
  return make_texture(job, [&] {
    const std::size_t plane = plane_bytes(job);
    const int depth = size[2];
    const int step =
        static_cast<int>(std::clamp<std::size_t>(slab_bytes / plane, 1, static_cast<std::size_t>(depth)));
    std::vector<std::byte> slab(plane * static_cast<std::size_t>(step));
    for (int z0 = 0; z0 < depth; z0 += step) {
      const int z1 = std::min(z0 + step, depth);
      fill(z0, z1, std::span(slab).first(plane * static_cast<std::size_t>(z1 - z0)));
      upload(job, z0, z1, slab.data());
      report_progress(progress, "upload", static_cast<double>(z1) / depth);
    }
  });
}

void update_texture_3d(const Functions& gl, const Texture& texture, const TextureSpec& spec,
                       std::array<int, 3> first, std::array<int, 3> size, std::span<const std::byte> data) {
  const Job job = make_job(gl, spec, 3, size);
  if (data.size() != total_bytes(job))
    throw GraphicsError("a part of " + size_text(job) + " texels needs " + std::to_string(total_bytes(job)) +
                        " bytes; " + std::to_string(data.size()) + " were given");
  const TextureBindingGuard binding(gl, GL_TEXTURE_3D);
  const UnpackGuard unpack(gl);
  gl.BindTexture(GL_TEXTURE_3D, texture.name());
  gl.TexSubImage3D(GL_TEXTURE_3D, 0, first[0], first[1], first[2], size[0], size[1], size[2],
                   job.layout.format, job.layout.type, data.data());
  check_made(job);
}

} // namespace slicelens::gl
