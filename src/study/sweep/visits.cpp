#include "study/sweep/visits.h"

#include "core/errors.h"
#include "core/stopwatch.h"
#include "gl/state.h"
#include "gl/timer.h"
#include "image/image_io.h"
#include "render/lens_renderer.h"
#include "render/render_session.h"
#include "scene/load.h"
#include "study/export.h"
#include "study/peer.h"
#include "study/process.h"
#include "study/statistics.h"
#include "study/sweep/deform_time.h"
#include "study/sweep/fill_limits.h"
#include "study/sweep/machine.h"

#include <algorithm>
#include <cmath>
#include <ctime>

namespace slicelens {

namespace {

constexpr std::size_t kept_volumes = std::size_t{2} << 30;

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Seconds of a number of frames, by phase.
struct FrameTimes {
  std::vector<double> draw;
  std::vector<double> gpu;
  std::vector<double> processor;
  std::vector<double> read;
};

Seconds medians(const SetUpTimes& set_up, const FrameTimes& frames) {
  Seconds seconds = {{"upload", set_up.upload},
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
    const Stopwatch watch;
    const double processor = processor_seconds();
    (void)render(prepared, nullptr, {});
    times.draw.push_back(watch.seconds());
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
    const DrawTime drawn = session.draw({}, protocol.batch);
    times.processor.push_back((processor_seconds() - processor) / static_cast<double>(protocol.batch));
    times.draw.push_back(drawn.wall);
    if (drawn.gpu)
      times.gpu.push_back(*drawn.gpu);
    const Stopwatch watch;
    (void)session.read();
    times.read.push_back(watch.seconds());
  }
  return times;
}

/// Pictures by a pipeline without a renderer of its own are drawn whole: `draw_seconds` is theirs.
FrameTimes time_whole_pictures(const PreparedPicture& prepared, gl::Context* context,
                               const TimingProtocol& protocol) {
  FrameTimes times;
  for (std::size_t i = 0; i < protocol.warm_up + protocol.frames; ++i) {
    const double processor = processor_seconds();
    const PictureResult result = render_picture(prepared, context);
    if (i < protocol.warm_up)
      continue;
    times.draw.push_back(result.draw_seconds);
    times.processor.push_back(processor_seconds() - processor);
  }
  return times;
}

FrameTimes time_picture(const PreparedPicture& prepared, gl::Context* context,
                        const TimingProtocol& protocol) {
  if (context == nullptr || prepared.scene.render.pipeline == LensPipeline::fixed_function)
    return time_whole_pictures(prepared, context, protocol);
  const gl::Functions& gl = context->functions();
  const gl::StateGuard guard(gl);
  const PictureRenderer renderer(gl, prepared);
  const gl::Target target =
      gl::make_target(gl, prepared.width, prepared.height, texture_format(prepared.scene.render.target));
  renderer.bind(target);
  const auto draw = [&] {
    for (std::size_t i = 0; i < protocol.batch; ++i) {
      renderer.draw_bound();
      gl.Flush(); // a picture is shown before the next one starts
    }
  };
  FrameTimes times;
  const auto batch = static_cast<double>(protocol.batch);
  for (std::size_t i = 0; i < protocol.warm_up + protocol.frames; ++i) {
    const double processor = processor_seconds();
    const double wall = gl::elapsed_seconds(gl, draw);
    if (i < protocol.warm_up)
      continue;
    times.draw.push_back(wall / batch);
    times.processor.push_back((processor_seconds() - processor) / batch);
  }
  return times;
}

} // namespace

/// A running peer with the scene that it holds.
struct HeldPeer {
  ScratchFolder folder;
  Peer peer{find_peer()};
  std::string scene;
  PeerDriver driver;
};

struct Visitor::State {
  SceneStore store{kept_volumes};
  OpenContext context;
  std::map<std::string, HeldPeer> peers; ///< by mapper

  HeldPeer& peer_with(const SceneInput& input, const std::string& mapper, const Progress& progress);
  DrawnPicture draw_by_peer(const SceneInput& input, const std::string& mapper, const Progress& progress);
  Seconds time_peer(const SceneInput& input, const std::string& mapper, const TimingProtocol& protocol,
                    const Progress& progress);

  DrawnPicture draw_volume(const SceneInput& input, const Progress& progress);
  DrawnPicture draw_picture(const PictureInput& input);
  gl::Context* context_for(const ImageScene& scene);
};

DrawnPicture Visitor::State::draw_volume(const SceneInput& input, const Progress& progress) {
  const std::string sha256 = store.sha256(input);
  const PreparedScene& prepared = store.get(input, progress);
  forget_peak_memory();
  RenderResult result = render_with(context, prepared, progress);
  add_metadata(result, prepared.scene, sha256);
  const auto peak = static_cast<double>(peak_memory()); // before the second session below
  DrawnPicture drawn;
  const auto count = [&](const char* name, double value) { drawn.counts.emplace_back(name, value); };
  if (draws_slices(prepared.scene.render.pipeline)) {
    count("slices", static_cast<double>(result.slices));
    count("triangles", static_cast<double>(result.triangles));
    count("draw_calls", static_cast<double>(result.draw_calls));
    RenderSession session(*context.context, prepared, {});
    const auto fragments = static_cast<double>(session.count_fragments());
    count("fragments", fragments);
    count("samples", fragments);
  } else {
    count("samples", samples_along_rays(prepared));
  }
  count("texture_bytes", static_cast<double>(result.texture_bytes));
  count("peak_bytes", peak);
  if (!result.pools.empty()) {
    PoolCounts all;
    for (const PoolCounts& pool : result.pools) {
      all.parts += pool.parts;
      all.loads += pool.loads;
      all.read_bytes += pool.read_bytes;
    }
    count("brick_parts", static_cast<double>(all.parts));
    count("bricks_loaded", static_cast<double>(all.loads));
    count("read_bytes", static_cast<double>(all.read_bytes));
  }
  drawn.texts = {{"renderer", result.renderer},
                 {"gl_version", result.version},
                 {"context", result.context},
                 {"texture", result.texture}};
  drawn.image = std::move(result.image);
  return drawn;
}

/// The peer after it has taken the scene, which it does only where it holds another one.
HeldPeer& Visitor::State::peer_with(const SceneInput& input, const std::string& mapper,
                                    const Progress& progress) {
  HeldPeer& held = peers[mapper];
  const std::string scene = scene_to_json(input.scene, -1) + store.sha256(input);
  if (held.scene == scene)
    return held;
  held.scene.clear();
  write_export(store.get(input, progress), held.folder / "scene");
  try {
    held.driver = held.peer.load(held.folder / "scene", mapper);
  } catch (const FileError&) {
    peers.erase(mapper); // it may be gone; the next scene gets a new one
    throw;
  }
  held.scene = scene;
  return held;
}

DrawnPicture Visitor::State::draw_by_peer(const SceneInput& input, const std::string& mapper,
                                          const Progress& progress) {
  HeldPeer& held = peer_with(input, mapper, progress);
  (void)held.peer.draw();
  held.peer.write(held.folder / "picture.png");
  DrawnPicture drawn;
  drawn.image = read_image(held.folder / "picture.png");
  drawn.texts = {
      {"renderer", "VTK " + held.driver.program + ", " + mapper + " mapper; " + held.driver.renderer},
      {"gl_version", held.driver.version}};
  return drawn;
}

Seconds Visitor::State::time_peer(const SceneInput& input, const std::string& mapper,
                                  const TimingProtocol& protocol, const Progress& progress) {
  HeldPeer& held = peer_with(input, mapper, progress);
  (void)held.peer.draw(protocol.warm_up);
  return {{"draw", median(held.peer.draw(protocol.frames))}};
}

/// Null for the reference.
gl::Context* Visitor::State::context_for(const ImageScene& scene) {
  if (scene.render.pipeline == LensPipeline::reference)
    return nullptr;
  Scene wanted;
  wanted.render.context = scene.render.context;
  if (scene.render.pipeline == LensPipeline::fixed_function)
    wanted.render.pipeline = Pipeline::fixed_function; // which needs a compatibility context
  open_context(context, wanted);
  return &*context.context;
}

void require_volume(const StudyInput& input, const std::optional<std::string>& peer) {
  if (peer && std::holds_alternative<PictureInput>(input))
    throw UsageError("render.pipeline vtk-" + *peer +
                     " draws volumes; a 2D lens is drawn by our own pipelines");
}

PreparedPicture prepared_picture(const PictureInput& input) {
  return prepare_picture(input.scene, load_image(input.scene.image, input.folders));
}

DrawnPicture Visitor::State::draw_picture(const PictureInput& input) {
  const PreparedPicture prepared = prepared_picture(input);
  PictureResult result = render_picture(prepared, context_for(input.scene));
  result.image.metadata["slicelens:image_scene"] = image_scene_to_json(input.scene, -1);
  DrawnPicture drawn;
  drawn.counts = {{"triangles", static_cast<double>(result.triangles)}};
  drawn.texts = {{"renderer", result.renderer}, {"gl_version", result.version}, {"context", result.context}};
  drawn.image = std::move(result.image);
  return drawn;
}

Visitor::Visitor() : state_(std::make_unique<State>()) {}
Visitor::~Visitor() = default;

std::string Visitor::sha256(const StudyInput& input) {
  if (const auto* volume = std::get_if<SceneInput>(&input))
    return state_->store.sha256(*volume);
  const PictureInput& picture = std::get<PictureInput>(input);
  if (!picture.scene.image.file)
    return "";
  return sha256_of({resolve_file(*picture.scene.image.file, picture.folders, "image.file")});
}

const PreparedScene* Visitor::prepared(const StudyInput& input, const Progress& progress) {
  const auto* volume = std::get_if<SceneInput>(&input);
  return volume == nullptr ? nullptr : &state_->store.get(*volume, progress);
}

DrawnPicture Visitor::draw(const StudyInput& input, const std::optional<std::string>& peer,
                           const Progress& progress) {
  require_volume(input, peer);
  if (peer)
    return state_->draw_by_peer(std::get<SceneInput>(input), *peer, progress);
  if (const auto* picture = std::get_if<PictureInput>(&input))
    return state_->draw_picture(*picture);
  return state_->draw_volume(std::get<SceneInput>(input), progress);
}

Seconds Visitor::time(const StudyInput& input, const std::optional<std::string>& peer,
                      const TimingProtocol& protocol, const Progress& progress) {
  require_volume(input, peer);
  if (peer)
    return state_->time_peer(std::get<SceneInput>(input), *peer, protocol, progress);
  if (const auto* picture = std::get_if<PictureInput>(&input))
    return medians({},
                   time_picture(prepared_picture(*picture), state_->context_for(picture->scene), protocol));
  const PreparedScene& scene = state_->store.get(std::get<SceneInput>(input), progress);
  if (scene.scene.render.pipeline == Pipeline::reference)
    return medians({}, time_reference(scene, protocol));
  open_context(state_->context, scene.scene);
  RenderSession session(*state_->context.context, scene, {});
  Seconds seconds = medians(session.set_up(), time_session(session, protocol));
  if (const auto deform = deform_seconds(*state_->context.context, scene))
    seconds.insert(seconds.begin(), {"deform", *deform});
  return seconds;
}

Seconds Visitor::time_limits(const StudyInput& like) {
  Scene wanted;
  wanted.render.context = std::visit([](const auto& one) { return one.scene.render.context; }, like);
  wanted.render.pipeline = Pipeline::slices;
  open_context(state_->context, wanted);
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
