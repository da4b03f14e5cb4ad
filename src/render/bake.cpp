#include "render/bake.h"

#include "core/errors.h"
#include "core/text.h"
#include "render/voxel_filter.h"
#include "volume/streamed.h"

#include <tbb/parallel_for.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <mutex>

namespace slicelens {

namespace {

/// Whole voxels of the volume that hold the displayed bounds, or `size` voxels over them.
Volume placed(const PreparedScene& prepared, const BakeOptions& options) {
  const Volume& volume = prepared.volume;
  Volume result;
  result.direction = volume.direction;
  result.format = "baked";
  const glm::dvec3 n(volume.dims[0], volume.dims[1], volume.dims[2]);
  glm::dvec3 first(0); // corner of the result, in voxels of the volume from its own corner
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    // A hair beyond a face is rounding.
    first[axis] = std::min(0.0, std::floor(prepared.object_low[axis] * n[axis] + 1e-6));
    const double last = std::max(n[axis], std::ceil(prepared.object_high[axis] * n[axis] - 1e-6));
    const double count = last - first[axis];
    if (!(count < 1e6))
      throw LimitError("the displayed volume is too large to be baked: " + number_text(count) +
                       " voxels on an axis");
    result.dims[a] = options.size ? (*options.size)[a] : static_cast<std::size_t>(count);
    result.spacing[axis] = volume.spacing[axis] * count / static_cast<double>(result.dims[a]);
  }
  result.origin = volume.origin + volume.direction * (volume.spacing * (first - 0.5) + 0.5 * result.spacing);
  result.type = options.as_float ? ScalarType::f32 : volume.type;
  return result;
}

void check_room(const Volume& result) {
  const std::size_t bytes = voxel_bytes(result);
  const auto pages = static_cast<std::size_t>(std::max(0L, ::sysconf(_SC_PHYS_PAGES)));
  const auto page = static_cast<std::size_t>(std::max(0L, ::sysconf(_SC_PAGESIZE)));
  if (bytes / std::max<std::size_t>(page, 1) > pages) {
    throw LimitError("the baked volume of " + std::to_string(result.dims[0]) + "x" +
                     std::to_string(result.dims[1]) + "x" + std::to_string(result.dims[2]) +
                     " voxels does not fit the memory; give a smaller --size");
  }
}

/// The nearest value of type T.
template <class T>
T stored(double value) {
  if constexpr (std::is_floating_point_v<T>) {
    return static_cast<T>(value);
  } else {
    const auto low = static_cast<double>(std::numeric_limits<T>::lowest());
    const auto high = static_cast<double>(std::numeric_limits<T>::max());
    const double rounded = std::round(value);
    if (rounded <= low)
      return std::numeric_limits<T>::lowest();
    return rounded >= high ? std::numeric_limits<T>::max() : static_cast<T>(rounded);
  }
}

/// One voxel of the result after the other.
template <class In, class Out>
struct Baker {
  const PreparedScene& prepared;
  const Volume& result;
  double outside;
  glm::dmat4 texture_from_index{1};
  glm::ivec3 dims{0};

  double voxel(int i, int j, int k) const {
    const auto& n = prepared.volume.dims;
    const auto index = (static_cast<std::size_t>(k) * n[1] + static_cast<std::size_t>(j)) * n[0] +
                       static_cast<std::size_t>(i);
    const double value =
        static_cast<double>(reinterpret_cast<const In*>(prepared.volume.voxels.data())[index]);
    return std::isfinite(value) ? value : prepared.volume.min;
  }

  double value(const glm::dvec3& index) const {
    const glm::dvec3 p(texture_from_index * glm::dvec4(index, 1));
    const glm::dvec3 u = texture_from_box(
        prepared.space, texture_from_object(prepared.maps, box_from_texture(prepared.space, p)));
    // Half a millionth of the volume: faces that a map keeps in place stay inside.
    if (glm::any(glm::lessThan(u, glm::dvec3(-5e-7))) || glm::any(glm::greaterThan(u, glm::dvec3(1 + 5e-7))))
      return outside;
    return filtered(prepared.scene.render.filter, dims, u * glm::dvec3(dims),
                    [this](int i, int j, int k) { return voxel(i, j, k); });
  }

  void fill_row(std::size_t row, Out* out) const {
    for (std::size_t i = 0; i < result.dims[0]; ++i)
      out[i] = stored<Out>(value(glm::dvec3(i, row % result.dims[1], row / result.dims[1])));
  }
};

template <class In, class Out>
void fill(const PreparedScene& prepared, Volume& result, double outside, const Progress& progress) {
  const auto& n = prepared.volume.dims;
  Baker<In, Out> baker{prepared, result, outside};
  baker.dims = glm::ivec3(n[0], n[1], n[2]);
  glm::dmat4 world_from_index(1);
  for (int axis = 0; axis < 3; ++axis)
    world_from_index[axis] = glm::dvec4(result.direction[axis] * result.spacing[axis], 0);
  world_from_index[3] = glm::dvec4(result.origin, 1);
  baker.texture_from_index = texture_from_world(prepared.box) * world_from_index;
  Out* const voxels = reinterpret_cast<Out*>(result.voxels.data());
  const std::size_t rows = result.dims[1] * result.dims[2];
  std::atomic<std::size_t> done = 0;
  std::mutex reporting;
  tbb::parallel_for(std::size_t{0}, rows, [&](std::size_t row) {
    baker.fill_row(row, voxels + row * result.dims[0]);
    const std::size_t count = ++done;
    if (progress.advance && count % 256 == 0) {
      const std::lock_guard lock(reporting);
      report_progress(progress, "bake", static_cast<double>(count) / static_cast<double>(rows));
    }
  });
}

} // namespace

Volume bake(const PreparedScene& prepared, const BakeOptions& options, const Progress& progress) {
  if (!prepared.volume.colors.rgba.empty())
    throw UsageError("a volume of colours cannot be baked; choose one component with volume.component");
  require_voxels(prepared.volume, "baking");
  Volume result = placed(prepared, options);
  check_room(result);
  const double outside = options.outside.value_or(prepared.volume.min);
  visit_scalar_type(result.type, [&](auto* tag) {
    using Out = std::remove_pointer_t<decltype(tag)>;
    if (!std::isfinite(outside) ||
        (std::is_integral_v<Out> && static_cast<double>(stored<Out>(outside)) != outside)) {
      throw UsageError("--outside " + number_text(outside) + " is no value of type " + name_of(result.type) +
                       "; give another or --float");
    }
  });
  result.voxels.resize(voxel_bytes(result));
  visit_scalar_type(prepared.volume.type, [&](auto* tag) {
    using In = std::remove_pointer_t<decltype(tag)>;
    if (options.as_float)
      fill<In, float>(prepared, result, outside, progress);
    else
      fill<In, In>(prepared, result, outside, progress);
  });
  update_statistics(result);
  return result;
}

} // namespace slicelens
