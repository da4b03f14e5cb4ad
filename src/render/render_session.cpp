#include "render/render_session.h"

#include "core/stopwatch.h"
#include "gl/timer.h"
#include "render/render.h"
#include "render/slabs.h"

namespace slicelens {

RenderSession::RenderSession(gl::Context& context, const PreparedScene& prepared, const Progress& progress)
    : context_(&context), prepared_(&prepared) {
  const gl::Functions& gl = context.functions();
  Stopwatch watch;
  textures_ = upload(gl, prepared, progress);
  target_ = gl::make_target(gl, prepared.view.width, prepared.view.height,
                            texture_format(prepared.scene.render.target));
  if (!prepared.scene.planes.empty())
    gl::attach_depth(gl, target_);
  gl::finish(gl);
  set_up_.upload = watch.lap();
  renderer_.emplace(make_renderer());
  set_up_.compile = watch.lap();
  slice();
}

RenderSession::Renderer RenderSession::make_renderer() {
  const Pipeline pipeline = prepared_->scene.render.pipeline;
  if (pipeline == Pipeline::fixed_function)
    return FixedFunctionRenderer(*context_);
  if (draws_slices(pipeline))
    return SliceRenderer(context_->functions(), *prepared_);
  return RayRenderer(context_->functions(), *prepared_);
}

void RenderSession::slice() {
  if (std::holds_alternative<RayRenderer>(*renderer_))
    return;
  Stopwatch watch;
  const StackGeometry geometry =
      draws_slabs(*prepared_) ? make_slab_geometry(*prepared_) : make_stack_geometry(*prepared_);
  set_up_.slice = geometry.cut_seconds;
  set_up_.tessellate = watch.lap() - geometry.cut_seconds;
  if (auto* fixed = std::get_if<FixedFunctionRenderer>(&*renderer_))
    fixed->set_geometry(geometry);
  else
    std::get<SliceRenderer>(*renderer_).set_geometry(geometry);
  gl::finish(context_->functions());
  set_up_.upload += watch.lap();
}

void RenderSession::draw_frame(const Progress& progress) {
  std::visit([&](auto& renderer) { renderer.draw(*prepared_, textures_, target_, progress); }, *renderer_);
}

DrawTime RenderSession::draw(const Progress& progress, std::size_t batch) {
  const gl::Functions& gl = context_->functions();
  gl::finish(gl);
  DrawTime time;
  Stopwatch watch;
  gl::TimerQuery query(gl);
  query.begin();
  for (std::size_t i = 0; i < batch; ++i) {
    draw_frame(progress);
    gl.Flush();
  }
  gl::finish(gl);
  query.end();
  time.wall = watch.lap() / static_cast<double>(batch);
  if (const auto nanoseconds = query.result_nanoseconds())
    time.gpu = static_cast<double>(*nanoseconds) * 1e-9 / static_cast<double>(batch);
  return time;
}

Image RenderSession::read() const {
  Image image = make_image(target_.width, target_.height);
  image.pixels = gl::read_pixels(context_->functions(), target_);
  return image;
}

std::uint64_t RenderSession::count_fragments() {
  return gl::samples_passed(context_->functions(), [&] { draw_frame({}); });
}

std::size_t RenderSession::slice_count() const {
  return std::visit(
      [](const auto& renderer) -> std::size_t {
        if constexpr (requires { renderer.slice_count(); })
          return renderer.slice_count();
        return 0;
      },
      *renderer_);
}

std::size_t RenderSession::triangle_count() const {
  return std::visit(
      [](const auto& renderer) -> std::size_t {
        if constexpr (requires { renderer.triangle_count(); })
          return renderer.triangle_count();
        return 0;
      },
      *renderer_);
}

std::size_t RenderSession::draw_call_count() const {
  return std::visit(
      [](const auto& renderer) -> std::size_t {
        if constexpr (requires { renderer.draw_call_count(); })
          return renderer.draw_call_count();
        return 0;
      },
      *renderer_);
}

} // namespace slicelens
