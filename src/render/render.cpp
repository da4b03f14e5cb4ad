#include "render/render.h"

#include "core/errors.h"
#include "core/stopwatch.h"
#include "render/paged_draw.h"
#include "render/reference.h"
#include "render/render_session.h"
#include "render/scene_overlay.h"
#include "scene/names.h"

#include <algorithm>

namespace slicelens {

namespace {

std::string limits_text(const gl::Limits& limits) {
  return "2D " + std::to_string(limits.texture_size) + ", 3D " + std::to_string(limits.texture_size_3d) +
         ", texture units " + std::to_string(limits.texture_units) + ", timer bits " +
         std::to_string(limits.timer_query_bits);
}

void render_on_gpu(const PreparedScene& prepared, gl::Context& context, const Progress& progress,
                   RenderResult& result) {
  RenderSession session(context, prepared, progress);
  const SetUpTimes& set_up = session.set_up();
  result.times.upload = set_up.upload;
  result.times.compile = set_up.compile;
  result.times.slice = set_up.slice;
  result.times.tessellate = set_up.tessellate;
  const DrawTime drawn = session.draw(progress);
  result.times.draw = drawn.wall;
  result.times.gpu_draw = drawn.gpu;
  Stopwatch watch;
  result.image = session.read();
  result.times.read = watch.lap();
  result.slices = session.slice_count();
  result.triangles = session.triangle_count();
  result.draw_calls = session.draw_call_count();
  result.renderer = context.info().renderer;
  result.version = context.info().version;
  result.context = context.info().kind;
  result.limits = limits_text(context.info().limits);
  result.texture = session.textures().texture;
  result.texture_bytes = session.textures().bytes;
  result.whole_texture_bytes = session.textures().whole_bytes;
  result.pools = pool_counts(session.textures());
  result.volume_textures = std::max<std::size_t>(1, session.textures().bricks.size());
}

} // namespace

gl::Profile profile_of(Pipeline pipeline) {
  return pipeline == Pipeline::fixed_function ? gl::Profile::compatibility : gl::Profile::core;
}

GLenum texture_format(Target target) {
  switch (target) {
  case Target::rgba8:
    return GL_RGBA8;
  case Target::rgba16f:
    return GL_RGBA16F;
  case Target::rgba32f:
    break;
  }
  return GL_RGBA32F;
}

gl::Context open_context_for(const Scene& scene) {
  const gl::Profile profile = profile_of(scene.render.pipeline);
  gl::ContextKind kind = gl::ContextKind::automatic;
  switch (scene.render.context) {
  case ContextName::osmesa:
    kind = gl::ContextKind::osmesa;
    break;
  case ContextName::egl:
    kind = gl::ContextKind::egl;
    break;
  case ContextName::window:
    kind = gl::ContextKind::window;
    break;
  case ContextName::automatic:
    break;
  }
  try {
    return gl::open_context(kind, profile);
  } catch (const GraphicsError& error) {
    if (profile == gl::Profile::core)
      throw;
    throw GraphicsError("pipeline '" + word(scene.render.pipeline) +
                        "' needs a context of the compatibility profile: " + error.what());
  }
}

RenderResult render(const PreparedScene& prepared, gl::Context* context, const Progress& progress) {
  RenderResult result;
  if (prepared.scene.overlay.stack != 0) {
    result.image = draw_stack_from_the_side(prepared);
    result.renderer = "CPU, lines";
    return result;
  }
  if (prepared.scene.render.pipeline == Pipeline::reference) {
    Stopwatch watch;
    result.image = render_reference(prepared, progress);
    result.times.draw = watch.lap();
    result.renderer = "CPU, double precision";
  } else {
    if (context == nullptr)
      throw GraphicsError("pipeline '" + word(prepared.scene.render.pipeline) + "' needs a graphics context");
    render_on_gpu(prepared, *context, progress, result);
  }
  if (prepared.scene.render.mode == Mode::xray)
    show_line_integrals(result.image, prepared.xray_scale);
  put_over_background(result.image, prepared.scene.render.background);
  draw_overlays(result.image, prepared);
  return result;
}

void put_over_background(Image& image, const glm::dvec4& background) {
  for (std::size_t i = 0; i + 3 < image.pixels.size(); i += 4) {
    const double through = (1.0 - static_cast<double>(image.pixels[i + 3])) * background.a;
    for (int c = 0; c < 3; ++c) {
      float& value = image.pixels[i + static_cast<std::size_t>(c)];
      value = static_cast<float>(static_cast<double>(value) + through * background[c]);
    }
    image.pixels[i + 3] = static_cast<float>(static_cast<double>(image.pixels[i + 3]) + through);
  }
}

void show_line_integrals(Image& image, double scale) {
  for (std::size_t i = 0; i + 3 < image.pixels.size(); i += 4) {
    for (std::size_t c = 0; c < 4; ++c)
      image.pixels[i + c] = static_cast<float>(static_cast<double>(image.pixels[i + c]) * scale);
    image.pixels[i + 3] = std::min(1.0F, image.pixels[i + 3]);
  }
}

} // namespace slicelens
