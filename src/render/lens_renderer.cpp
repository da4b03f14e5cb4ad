#include "render/lens_renderer.h"

#include "core/errors.h"
#include "gl/check.h"
#include "gl/state.h"
#include "gl/texture.h"
#include "gl/timer.h"
#include "render/fixed_function.h"
#include "render/render.h"
#include "render/shaders.h"
#include "render/warp_glsl.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>

namespace slicelens {

namespace {

/// Macros of shaders/lens_picture.frag. `evaluates`: the fragments evaluate the lens.
std::vector<std::string> macros_of(const PreparedPicture& prepared, bool evaluates) {
  std::vector<std::string> macros = {"MAX_CLIP_PLANES 1"};
  if (prepared.scene.render.filter == Filter::linear_exact)
    macros.emplace_back("FILTER_LINEAR_EXACT");
  if (evaluates && prepared.scene.render.pipeline == LensPipeline::lookup)
    macros.emplace_back("WARP_LOOKUP");
  if (evaluates && prepared.scene.render.pipeline == LensPipeline::fragment) {
    macros.emplace_back("WARP_FRAGMENT");
    macros.emplace_back("WARPED");
  }
  return macros;
}

/// The lenses' maps, in the order in which they are drawn.
std::vector<WarpMap> maps_of(const PreparedPicture& prepared) {
  std::vector<WarpMap> maps;
  for (const LensTessellation& lens : prepared.lenses)
    maps.emplace_back(lens.map);
  return maps;
}

gl::Program make_picture_program(const gl::Functions& gl, const PreparedPicture& prepared, bool evaluates) {
  const std::vector<std::string> macros = macros_of(prepared, evaluates);
  std::vector<gl::ShaderSource> stages = shader_stage(GL_VERTEX_SHADER, "lens_picture.vert", macros);
  const auto fragment =
      shader_stage(GL_FRAGMENT_SHADER, "lens_picture.frag", macros, {warp_chain(maps_of(prepared))});
  stages.insert(stages.end(), fragment.begin(), fragment.end());
  return gl::make_program(gl, stages);
}

gl::Texture upload_image(const gl::Functions& gl, const PreparedPicture& prepared) {
  const Image& image = prepared.source;
  gl::TextureSpec spec;
  spec.filter = prepared.scene.render.filter == Filter::linear ? GL_LINEAR : GL_NEAREST;
  spec.format = GL_RGBA32F;
  if (prepared.scene.render.image_texture == TransferTexture::rgba32f) {
    return gl::make_texture_2d(gl, spec, {image.width, image.height}, std::as_bytes(std::span(image.pixels)));
  }
  spec.format = GL_RGBA8;
  std::vector<std::uint8_t> bytes;
  bytes.reserve(image.pixels.size());
  for (const float value : image.pixels) {
    const float unit = value > 0 ? std::min(value, 1.0F) : 0.0F; // NaN becomes 0
    bytes.push_back(static_cast<std::uint8_t>(std::lround(255 * unit)));
  }
  return gl::make_texture_2d(gl, spec, {image.width, image.height}, std::as_bytes(std::span(bytes)));
}

glm::vec2 clip_corner(const PreparedPicture& prepared, const glm::dvec3& position) {
  const glm::dvec2 pixel = pixel_from_picture(prepared, glm::dvec2(position));
  return glm::vec2(2 * pixel.x / prepared.width - 1, 1 - 2 * pixel.y / prepared.height);
}

/// The same for all points: an affine map of texture coordinates, z dropped.
glm::mat4 clip_from_picture(const PreparedPicture& prepared) {
  const glm::vec2 origin = clip_corner(prepared, {0, 0, 0});
  glm::mat4 clip(1);
  clip[0] = glm::vec4(clip_corner(prepared, {1, 0, 0}) - origin, 0, 0);
  clip[1] = glm::vec4(clip_corner(prepared, {0, 1, 0}) - origin, 0, 0);
  clip[2] = glm::vec4(0);
  clip[3] = glm::vec4(origin, 0, 1);
  return clip;
}

} // namespace

PictureGeometry make_picture_geometry(const PreparedPicture& prepared) {
  const LensMesh mesh = picture_mesh(prepared);
  PictureGeometry geometry;
  std::map<std::array<float, 5>, std::uint32_t> known;
  std::vector<std::uint32_t> index_of;
  for (const LensVertex& vertex : mesh.vertices) {
    const PictureVertex corner{clip_corner(prepared, vertex.position),
                               glm::vec3(vertex.texture.x, vertex.texture.y, vertex.texture.w)};
    const std::array<float, 5> key = {corner.corner.x, corner.corner.y, corner.look.x, corner.look.y,
                                      corner.look.z};
    const auto [entry, fresh] = known.emplace(key, static_cast<std::uint32_t>(geometry.vertices.size()));
    if (fresh)
      geometry.vertices.push_back(corner);
    index_of.push_back(entry->second);
  }
  for (const bool normal : {true, false}) {
    for (std::size_t i = 0; i < mesh.regions.size(); ++i) {
      if ((mesh.regions[i] == LensRegion::normal) != normal)
        continue;
      for (std::size_t k = 0; k < 3; ++k)
        geometry.indices.push_back(index_of[mesh.triangles[3 * i + k]]);
    }
    if (normal)
      geometry.normal_indices = geometry.indices.size();
  }
  return geometry;
}

PictureRenderer::PictureRenderer(const gl::Functions& gl, const PreparedPicture& prepared)
    : gl_(&gl), plain_(make_picture_program(gl, prepared, false)), image_(upload_image(gl, prepared)),
      vertex_array_(gl::make_vertex_array(gl)) {
  const gl::StateGuard guard(gl);
  WarpTable table;
  if (!draws_triangles(prepared.scene.render.pipeline) && !prepared.lenses.empty())
    lens_ = make_picture_program(gl, prepared, true);
  if (prepared.scene.render.pipeline == LensPipeline::lookup && lens_) {
    table = warp_table(prepared);
    gl::TextureSpec spec;
    spec.format = GL_RG32F;
    table_ = gl::make_texture_2d(gl, spec, table.size, std::as_bytes(std::span(table.texels)));
  }
  upload(prepared);
  set_uniforms(plain_, prepared, table);
  if (lens_)
    set_uniforms(lens_, prepared, table);
}

void PictureRenderer::upload(const PreparedPicture& prepared) {
  const gl::Functions& gl = *gl_;
  const PictureGeometry geometry = make_picture_geometry(prepared);
  index_count_ = geometry.indices.size();
  normal_count_ = lens_ ? geometry.normal_indices : index_count_;
  gl.BindVertexArray(vertex_array_.name());
  corners_ = gl::make_buffer(gl, GL_ARRAY_BUFFER, std::as_bytes(std::span(geometry.vertices)));
  gl.EnableVertexAttribArray(0);
  gl.EnableVertexAttribArray(1);
  gl.VertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, sizeof(PictureVertex),
                         reinterpret_cast<const void*>(offsetof(PictureVertex, corner)));
  gl.VertexAttribPointer(1, 3, GL_FLOAT, GL_FALSE, sizeof(PictureVertex),
                         reinterpret_cast<const void*>(offsetof(PictureVertex, look)));
  indices_ = gl::make_buffer(gl, GL_ELEMENT_ARRAY_BUFFER, std::as_bytes(std::span(geometry.indices)));
}

void PictureRenderer::set_uniforms(const gl::Program& program, const PreparedPicture& prepared,
                                   const WarpTable& table) const {
  const gl::Functions& gl = *gl_;
  gl.UseProgram(program.name());
  gl::set_uniform(gl, program, "image_texture", 0);
  gl::set_uniform(gl, program, "warp_table", 1);
  const glm::dvec2 scale = 1.0 / (table.high - table.low);
  gl::set_uniform(gl, program, "table_from_picture", glm::vec4(scale, -table.low * scale));
  set_warp_maps(gl, program, maps_of(prepared), prepared.space);
}

void PictureRenderer::bind(const gl::Target& target) const {
  const gl::Functions& gl = *gl_;
  gl::bind_target(gl, target);
  gl.Disable(GL_DEPTH_TEST);
  gl.Disable(GL_CULL_FACE);
  gl.Disable(GL_DITHER);
  gl.Disable(GL_BLEND);
  if (table_) {
    gl.ActiveTexture(GL_TEXTURE1);
    gl.BindTexture(GL_TEXTURE_2D, table_.name());
  }
  gl.ActiveTexture(GL_TEXTURE0);
  gl.BindTexture(GL_TEXTURE_2D, image_.name());
  gl.BindVertexArray(vertex_array_.name());
  gl.UseProgram(plain_.name());
}

void PictureRenderer::draw_bound() const {
  const gl::Functions& gl = *gl_;
  const auto draw = [&](std::size_t begin, std::size_t end) {
    gl.DrawElements(GL_TRIANGLES, static_cast<GLsizei>(end - begin), GL_UNSIGNED_INT,
                    reinterpret_cast<const void*>(begin * sizeof(std::uint32_t)));
  };
  if (lens_)
    gl.UseProgram(plain_.name());
  draw(0, normal_count_);
  if (!lens_)
    return;
  gl.UseProgram(lens_.name());
  draw(normal_count_, index_count_);
}

void PictureRenderer::draw(const gl::Target& target) const {
  const gl::StateGuard guard(*gl_);
  bind(target);
  gl_->ClearColor(0, 0, 0, 0);
  gl_->Clear(GL_COLOR_BUFFER_BIT);
  draw_bound();
  gl::check_errors(*gl_, "drawing the picture");
}

PictureResult render_picture(const PreparedPicture& prepared, gl::Context* context) {
  PictureResult result;
  if (prepared.scene.render.pipeline == LensPipeline::reference) {
    result.image = draw_reference_picture(prepared);
    result.renderer = "CPU, double precision";
  } else {
    if (context == nullptr)
      throw GraphicsError("pipeline '" + word(prepared.scene.render.pipeline) + "' needs a graphics context");
    const gl::Functions& gl = context->functions();
    const gl::Target target =
        gl::make_target(gl, prepared.width, prepared.height, texture_format(prepared.scene.render.target));
    const auto draw = [&](auto& renderer, const auto& work) {
      result.draw_seconds = gl::elapsed_seconds(gl, work);
      result.triangles = renderer.triangle_count();
    };
    if (prepared.scene.render.pipeline == LensPipeline::fixed_function) {
      FixedFunctionRenderer renderer(*context);
      renderer.set_geometry(picture_mesh(prepared));
      const gl::Texture image = upload_image(gl, prepared);
      const glm::mat4 clip = clip_from_picture(prepared);
      draw(renderer, [&] {
        renderer.draw({GL_TEXTURE_2D, image.name()}, clip, Order::back_to_front, target, {});
      });
    } else {
      const PictureRenderer renderer(gl, prepared);
      draw(renderer, [&] { renderer.draw(target); });
    }
    result.image = make_image(target.width, target.height);
    result.image.pixels = gl::read_pixels(gl, target);
    result.renderer = context->info().renderer;
    result.version = context->info().version;
    result.context = context->info().kind;
  }
  put_over_background(result.image, prepared.scene.render.background);
  draw_overlays(result.image, prepared);
  return result;
}

} // namespace slicelens
