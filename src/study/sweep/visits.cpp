#include "study/sweep/visits.h"

#include "core/errors.h"
#include "render/render_session.h"
#include "study/statistics.h"
#include "study/sweep/fill_limits.h"
#include "study/sweep/machine.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>

namespace slicelens {

namespace {

constexpr std::size_t kept_volumes = std::size_t{2} << 30;

double wall_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Seconds of a number of frames, by phase.
struct FrameTimes {
  std::vector<double> draw;
  std::vector<double> gpu;
  std::vector<double> processor;
  std::vector<double> read;
};

std::vector<std::pair<std::string, double>> medians(const SetUpTimes& set_up, const FrameTimes& frames) {
  std::vector<std::pair<std::string, double>> seconds = {{"upload", set_up.upload},
                                                         {"compile", set_up.compile},
                                                         {"slice", set_up.slice},
                                                         {"tessellate", set_up.tessellate},
                                                         {"draw", median(frames.draw)}};
  if (frames.gpu.size() == frames.draw.size())
    seconds.emplace_back("draw_gpu", median(frames.gpu));
  seconds.emplace_back("draw_processor", median(frames.processor));
  if (!frames.read.empty())
    seconds.emplace_back("read", median(frames.read));
  return seconds;
}

/// The reference has one phase.
FrameTimes time_reference(const PreparedScene& prepared, const TimingProtocol& protocol) {
  FrameTimes times;
  for (std::size_t i = 0; i < protocol.frames; ++i) {
    const double start = wall_seconds();
    const double processor = processor_seconds();
    (void)render(prepared, nullptr, {});
    times.draw.push_back(wall_seconds() - start);
    times.processor.push_back(processor_seconds() - processor);
  }
  return times;
}

FrameTimes time_session(RenderSession& session, const TimingProtocol& protocol) {
  for (std::size_t i = 0; i < protocol.warm_up; ++i)
    (void)session.draw({});
  FrameTimes times;
  for (std::size_t i = 0; i < protocol.frames; ++i) {
    const double processor = processor_seconds();
    const DrawTime drawn = session.draw({});
    times.processor.push_back(processor_seconds() - processor);
    times.draw.push_back(drawn.wall);
    if (drawn.gpu)
      times.gpu.push_back(*drawn.gpu);
    const double start = wall_seconds();
    (void)session.read();
    times.read.push_back(wall_seconds() - start);
  }
  return times;
}

} // namespace

struct Visitor::State {
  SceneStore store{kept_volumes};
  OpenContext context;
};

Visitor::Visitor() : state_(std::make_unique<State>()) {}
Visitor::~Visitor() = default;

SceneStore& Visitor::store() { return state_->store; }

DrawnPicture Visitor::draw(const SceneInput& input, const std::optional<std::string>& peer,
                           const Progress& progress) {
  if (peer)
    throw UsageError("pipeline vtk-" + *peer + " is not there yet");
  const std::string sha256 = state_->store.sha256(input);
  const PreparedScene& prepared = state_->store.get(input, progress);
  forget_peak_memory();
  RenderResult result = render_with(state_->context, prepared, progress);
  add_metadata(result, prepared.scene, sha256);
  DrawnPicture drawn;
  const auto count = [&](const char* name, double value) { drawn.counts.emplace_back(name, value); };
  const Pipeline pipeline = prepared.scene.render.pipeline;
  if (draws_slices(pipeline)) {
    count("slices", static_cast<double>(result.slices));
    count("triangles", static_cast<double>(result.triangles));
    count("draw_calls", static_cast<double>(result.draw_calls));
    RenderSession session(*state_->context.context, prepared, {});
    count("fragments", static_cast<double>(session.count_fragments()));
    count("samples", *drawn.counts.back().second);
  } else {
    count("samples", samples_along_rays(prepared));
  }
  count("texture_bytes", static_cast<double>(result.texture_bytes));
  count("peak_bytes", static_cast<double>(peak_memory()));
  drawn.texts = {{"renderer", result.renderer},
                 {"gl_version", result.version},
                 {"context", result.context},
                 {"texture", result.texture}};
  drawn.image = std::move(result.image);
  return drawn;
}

std::vector<std::pair<std::string, double>> Visitor::time(const SceneInput& input,
                                                          const std::optional<std::string>& peer,
                                                          const TimingProtocol& protocol,
                                                          const Progress& progress) {
  if (peer)
    throw UsageError("pipeline vtk-" + *peer + " is not there yet");
  const PreparedScene& prepared = state_->store.get(input, progress);
  if (prepared.scene.render.pipeline == Pipeline::reference)
    return medians({}, time_reference(prepared, protocol));
  open_context(state_->context, prepared.scene);
  RenderSession session(*state_->context.context, prepared, {});
  return medians(session.set_up(), time_session(session, protocol));
}

std::vector<std::pair<std::string, double>> Visitor::time_limits(const Scene& like) {
  Scene scene = like;
  scene.render.pipeline = Pipeline::slices;
  open_context(state_->context, scene);
  const FillRates rates = FillLimits(state_->context.context->functions()).measure();
  return {{"untextured", rates.untextured}, {"textured", rates.textured}, {"classified", rates.classified}};
}

double samples_along_rays(const PreparedScene& prepared) {
  const glm::dmat4 texture_from_world = glm::inverse(prepared.box.world_from_texture);
  const glm::dvec3 size = prepared.object_high - prepared.object_low;
  // Behind an orthographic eye, which is any point on the axis, there is something to see.
  const double start = prepared.view.projection == Projection::perspective ? 0 : -INFINITY;
  double length = 0;
  for (int y = 0; y < prepared.view.height; ++y) {
    for (int x = 0; x < prepared.view.width; ++x) {
      const Ray world = ray_from_pixel(prepared.view, x + 0.5, y + 0.5);
      // In the displayed box as a unit cube; lengths along the ray stay those of the world.
      const glm::dvec3 origin = glm::dvec3(texture_from_world * glm::dvec4(world.origin, 1));
      const glm::dvec3 direction = glm::dvec3(texture_from_world * glm::dvec4(world.direction, 0));
      if (const auto inside = intersect_unit_cube({(origin - prepared.object_low) / size, direction / size}))
        length += std::max(0.0, inside->far - std::max(start, inside->near));
    }
  }
  return length / prepared.spacing;
}

} // namespace slicelens
