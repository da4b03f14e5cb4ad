#include "console.h"
#include "core/errors.h"
#include "image/image_io.h"
#include "options.h"
#include "scene/names.h"
#include "scene/scene_json.h"
#include "study/inputs.h"
#include "study/sweep/machine.h"

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <future>
#include <optional>
#include <system_error>

namespace slicelens::cli {

namespace {

namespace fs = std::filesystem;

std::string output_path(const RenderOptions& options) {
  if (!options.output.empty())
    return options.output;
  fs::path name = fs::path(options.input).lexically_normal();
  if (!name.has_filename())
    name = name.parent_path();
  const std::string output = name.stem().string() + ".png";
  std::error_code error;
  if (fs::exists(output, error) && fs::equivalent(output, options.input, error)) {
    throw UsageError("the picture would replace " + options.input + "; give another name with -o");
  }
  return output;
}

double seconds_since(std::chrono::steady_clock::time_point& mark) {
  const auto now = std::chrono::steady_clock::now();
  const double seconds = std::chrono::duration<double>(now - mark).count();
  mark = now;
  return seconds;
}

/// Lets TBB open its libraries and start its threads, by a reduction large enough to be shared out.
void start_threads() {
  Volume zeros;
  zeros.dims = {128, 128, 64};
  zeros.voxels.resize(voxel_bytes(zeros));
  update_statistics(zeros);
}

void print_report(const Landmarks& landmarks, const BoxSpace& space) {
  const LandmarkReport report = landmark_report(landmarks, space);
  std::fprintf(stderr, "landmarks  %zu by %s, missed by at most %.3g, rms %.3g; as drawn %.3g, rms %.3g\n",
               report.count, word(landmarks.method).c_str(), report.largest, report.rms, report.grid_largest,
               report.grid_rms);
  if (report.duplicates > 0)
    std::fprintf(stderr, "           %zu pairs given more than once\n", report.duplicates);
  if (report.smallest_determinant <= 0)
    std::fprintf(stderr, "           the map folds: smallest determinant %.3g\n",
                 report.smallest_determinant);
}

void print_report(const Field& field, const BoxSpace& space) {
  const FieldReport report = field_report(field, space);
  std::fprintf(stderr, "field      displaces by at most %.3g; ", report.largest_displacement);
  if (field.direction == FieldDirection::forward) {
    std::fprintf(stderr,
                 "inverted: round trip off by at most %.3g, rms %.3g, before refining %.3g, rms %.3g\n",
                 report.refined_largest, report.refined_rms, report.scattered_largest, report.scattered_rms);
  } else {
    std::fprintf(stderr, "as drawn off by at most %.3g, rms %.3g\n", report.grid_largest, report.grid_rms);
  }
  if (report.smallest_determinant <= 0)
    std::fprintf(stderr, "           the map folds: smallest determinant %.3g\n",
                 report.smallest_determinant);
}

void print_verbose(const RenderResult& result, const PreparedScene& prepared, double load, double codec,
                   double write) {
  const auto& dims = prepared.volume.dims;
  std::fprintf(stderr, "volume     %zux%zux%zu %s, values %g to %g, %s\n", dims[0], dims[1], dims[2],
               name_of(prepared.volume.type).c_str(), prepared.volume.min, prepared.volume.max,
               prepared.volume.format.c_str());
  std::fprintf(stderr, "renderer   %s %s\n", result.renderer.c_str(), result.context.c_str());
  if (!result.version.empty())
    std::fprintf(stderr, "version    %s\nlimits     %s\n", result.version.c_str(), result.limits.c_str());
  if (!result.texture.empty())
    std::fprintf(stderr, "texture    %s, %.1f MiB\n", result.texture.c_str(),
                 static_cast<double>(result.texture_bytes) / (1 << 20));
  if (result.volume_textures > 1)
    std::fprintf(stderr, "           in %zu textures; one of full resolution would take %.1f MiB\n",
                 result.volume_textures, static_cast<double>(result.whole_texture_bytes) / (1 << 20));
  for (const PoolCounts& pool : result.pools) {
    std::fprintf(
        stderr,
        "bricks     %zu of %zu pages needed, a pool of %zu bricks\n           %zu loaded in %zu parts "
        "and %.3f s, %.1f MiB read from disk\n",
        pool.needed, pool.pages, pool.capacity, pool.loads, pool.parts, pool.seconds,
        static_cast<double>(pool.read_bytes) / (1 << 20));
  }
  if (result.slices > 0)
    std::fprintf(stderr, "slices     %zu, %zu triangles, %zu draw calls\n", result.slices, result.triangles,
                 result.draw_calls);
  for (const LensTessellation& lens : prepared.lenses) {
    std::fprintf(stderr, "lens       %zu angular and %zu radial segments\n", lens.ring.size(),
                 lens.radial_segments);
  }
  for (const HeldWarp& held : prepared.held)
    std::visit([&](const auto& warp) { print_report(warp, held.space); }, held.warp);
  if (prepared.map_grid) {
    const MapGridError error = map_grid_error(prepared);
    const auto& size = prepared.map_grid->grid->size;
    std::fprintf(stderr, "grid       %zux%zux%zu nodes, off by at most %.3g voxels, rms %.3g\n", size[0],
                 size[1], size[2], error.largest, error.rms);
  }
  const RenderTimes& t = result.times;
  std::fprintf(stderr,
               "load       %8.3f s\ncodec      %8.3f s\ncontext    %8.3f s\nupload     %8.3f s\ncompile    "
               "%8.3f s\nslice      "
               "%8.3f s\ndraw       %8.3f s",
               load, codec, t.context, t.upload, t.compile, t.slice + t.tessellate, t.draw);
  if (t.gpu_draw)
    std::fprintf(stderr, "  (driver's timer %.3f s)", *t.gpu_draw);
  std::fprintf(stderr, "\nread       %8.3f s\nwrite      %8.3f s\n", t.read, write);
  if (const std::size_t peak = peak_memory())
    std::fprintf(stderr, "memory     %8.1f MiB at most\n", static_cast<double>(peak) / (1 << 20));
}

} // namespace

void run_render(const RenderOptions& options) {
  const SceneInput input = scene_input(options.input, options.set);
  if (options.print_scene) {
    std::printf("%s\n", scene_to_json(input.scene).c_str());
    return;
  }
  const std::string output = output_path(options);
  const PixelDepth depth = pixel_depth(output, options.depth); // refuse a wrong name before the work
  const Progress progress = console_progress();
  auto mark = std::chrono::steady_clock::now();

  OpenContext context;
  open_context(context, input.scene);
  const double open = seconds_since(mark);
  // No thread starts and no other library opens while the codec's libraries are being loaded, so whatever is
  // to run beside that must be there before.
  start_threads();
  std::future<std::string> hashing = start_hash(input);
  preload_codec();
  std::string sha256;
  const PreparedScene prepared = load(input, progress, &sha256, std::move(hashing));
  const double loading = seconds_since(mark);
  await_codec();
  const double codec = seconds_since(mark);
  RenderResult result = render_with(context, prepared, progress);
  result.times.context = open;
  add_metadata(result, prepared.scene, sha256);
  seconds_since(mark);
  write_image(result.image, output, depth);
  end_progress();
  if (options.verbose)
    print_verbose(result, prepared, loading, codec, seconds_since(mark));
  std::printf("%s\n", output.c_str());
}

} // namespace slicelens::cli
