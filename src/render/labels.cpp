#include "render/labels.h"

#include "core/errors.h"
#include "core/text.h"
#include "render/prepare.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <type_traits>
#include <unordered_map>

namespace slicelens {

namespace {

/// From label numbers to rows; 0 for those without an entry.
class RowOf {
public:
  explicit RowOf(const std::vector<std::size_t>& named) : small_(std::size_t{1} << 16) {
    for (std::size_t i = 0; i < named.size(); ++i) {
      if (named[i] < small_.size())
        small_[named[i]] = static_cast<std::uint8_t>(i + 1);
      else
        large_.emplace(named[i], static_cast<std::uint8_t>(i + 1));
    }
  }

  std::uint8_t operator()(std::uint64_t label) const {
    if (label < small_.size())
      return small_[label];
    const auto found = large_.find(label);
    return found == large_.end() ? std::uint8_t{0} : found->second;
  }

private:
  std::vector<std::uint8_t> small_;
  std::unordered_map<std::uint64_t, std::uint8_t> large_;
};

std::string dims_text(const Volume& volume) {
  return std::to_string(volume.dims[0]) + " x " + std::to_string(volume.dims[1]) + " x " +
         std::to_string(volume.dims[2]);
}

/// Where the label of voxel (i, j, k) of the volume is stored: first + i·step[0] + j·step[1] + k·step[2].
struct Walk {
  std::ptrdiff_t first = 0;
  std::array<std::ptrdiff_t, 3> step{};
};

/// From voxel numbers to world space.
glm::dmat3 voxel_axes(const glm::dmat3& direction, const glm::dvec3& spacing) {
  return {direction[0] * spacing.x, direction[1] * spacing.y, direction[2] * spacing.z};
}

/// The label volume's voxels in the volume's order. Files may store the same voxels along other axes or from
/// the other end; voxels of another place are refused.
Walk walk_of(const PreparedScene& prepared, const Volume& labels, const std::string& name) {
  if (labels.components != 1)
    throw UsageError(name + " has several components a voxel; a label volume has one");
  const FileGeometry& file = prepared.file_geometry;
  const auto& dims = prepared.volume.dims;
  const glm::dmat3 to_label = glm::inverse(voxel_axes(labels.direction, labels.spacing));
  const glm::dmat3 axes = to_label * voxel_axes(file.direction, file.spacing);
  const glm::dvec3 shift = to_label * (file.origin - labels.origin);
  const std::array<std::ptrdiff_t, 3> strides = {
      1, static_cast<std::ptrdiff_t>(labels.dims[0]),
      static_cast<std::ptrdiff_t>(labels.dims[0] * labels.dims[1])};
  Walk walk;
  glm::dmat3 whole(0);
  glm::dvec3 start(0);
  for (int axis = 0; axis < 3; ++axis) {
    int own = 0; // axis of the labels that this one runs along
    for (int k = 1; k < 3; ++k)
      own = std::abs(axes[axis][k]) > std::abs(axes[axis][own]) ? k : own;
    const auto from = static_cast<std::size_t>(axis);
    const auto to = static_cast<std::size_t>(own);
    if (labels.dims[to] != dims[from] || whole[0][own] != 0 || whole[1][own] != 0) {
      throw UsageError(name + " has " + dims_text(labels) + " voxels, the volume " +
                       dims_text(prepared.volume) + "; labels must lie on the volume's own grid");
    }
    const bool backwards = axes[axis][own] < 0;
    whole[axis][own] = backwards ? -1 : 1;
    walk.step[from] = backwards ? -strides[to] : strides[to];
    if (backwards) {
      start[own] = static_cast<double>(dims[from] - 1);
      walk.first += static_cast<std::ptrdiff_t>(dims[from] - 1) * strides[to];
    }
  }
  double farthest = 0;
  for (int k = 0; k < 8; ++k) {
    const glm::dvec3 corner =
        glm::dvec3(k & 1, k >> 1 & 1, k >> 2 & 1) * (glm::dvec3(dims[0], dims[1], dims[2]) - 1.0);
    farthest = std::max(farthest, glm::length(axes * corner + shift - (whole * corner + start)));
  }
  if (farthest > 0.1) {
    throw UsageError(name + " lies " + number_text(farthest) +
                     " of its voxels away from the volume at a corner; labels must lie on the volume's own "
                     "grid (spacing, origin and axes)");
  }
  return walk;
}

/// The row of a label of any type; negative ones have no entry. Nothing where the value is not whole.
template <class T>
std::optional<std::uint8_t> row_of_value(T label, const RowOf& row_of) {
  if constexpr (std::is_floating_point_v<T>) {
    if (!(std::abs(label) < T(9e15) && std::floor(label) == label)) // NaN and infinities neither
      return std::nullopt;
  }
  return label < T(0) ? std::uint8_t{0} : row_of(static_cast<std::uint64_t>(label));
}

/// Fills `rows` in the volume's order. False where a label is not a whole number.
template <class T>
bool rows_of(const T* labels, const Walk& walk, const std::array<std::size_t, 3>& dims, const RowOf& row_of,
             std::uint8_t* rows) {
  std::atomic<bool> whole = true;
  tbb::parallel_for(std::size_t{0}, dims[2], [&](std::size_t k) {
    for (std::size_t j = 0; j < dims[1]; ++j) {
      const std::ptrdiff_t line = walk.first + static_cast<std::ptrdiff_t>(j) * walk.step[1] +
                                  static_cast<std::ptrdiff_t>(k) * walk.step[2];
      std::uint8_t* out = rows + (k * dims[1] + j) * dims[0];
      for (std::size_t i = 0; i < dims[0]; ++i) {
        const auto row = row_of_value(labels[line + static_cast<std::ptrdiff_t>(i) * walk.step[0]], row_of);
        if (!row)
          whole = false;
        out[i] = row.value_or(0);
      }
    }
  });
  return whole;
}

void make_rows(PreparedScene& prepared, const Volume& labels, const Walk& walk, const std::string& name) {
  PreparedLabels& own = prepared.labels;
  const RowOf row_of(own.named);
  own.rows.assign(voxel_count(prepared.volume), 0);
  own.in_cells.clear();
  const bool whole = visit_scalar_type(labels.type, [&](auto* tag) {
    using T = std::remove_pointer_t<decltype(tag)>;
    return rows_of(reinterpret_cast<const T*>(labels.voxels.data()), walk, prepared.volume.dims, row_of,
                   own.rows.data());
  });
  if (!whole)
    throw UsageError(name + " holds " + name_of(labels.type) +
                     " values that are not whole; labels are numbers of objects");
}

LabelRow row_of_label(const PreparedScene& prepared, const LabelSettings& settings,
                      const std::optional<TransferFunction>& transfer) {
  LabelRow row{transfer.value_or(prepared.transfer), settings.mode, 1};
  if (!settings.visible)
    return {constant_transfer({0, 0, 0, 0}), LabelMode::dvr, 1};
  const double own = row.transfer.unit_distance.value_or(smallest_spacing(prepared.volume));
  if (transfer && prepared.scene.render.opacity_correction != OpacityCorrection::none)
    row.length_ratio = prepared.unit_distance / own;
  return row;
}

} // namespace

void prepare_labels(PreparedScene& prepared) {
  PreparedLabels& own = prepared.labels;
  const Scene& scene = prepared.scene;
  own.table.clear();
  if (scene.render.mode != Mode::two_level)
    return;
  if (!own.loaded)
    throw UsageError("mode 'two-level' needs the data of volume.labels, which have not been read");
  const std::string name = "volume.labels " + scene.volume.labels.value_or("");
  const Walk walk = walk_of(prepared, own.loaded->volume, name);
  std::vector<std::size_t> named;
  for (const LabelSettings& label : scene.labels)
    named.push_back(label.label);
  if (own.rows.empty() || named != own.named) {
    own.named = named;
    make_rows(prepared, own.loaded->volume, walk, name);
  }
  own.table.push_back({prepared.transfer, LabelMode::dvr, 1});
  const auto& transfers = own.loaded->transfers;
  for (std::size_t i = 0; i < scene.labels.size(); ++i)
    own.table.push_back(
        row_of_label(prepared, scene.labels[i], i < transfers.size() ? transfers[i] : std::nullopt));
}

void prepare_label_cells(PreparedScene& prepared) {
  PreparedLabels& own = prepared.labels;
  if (own.table.empty() || !own.in_cells.empty())
    return;
  const auto& dims = prepared.volume.dims;
  std::array<std::size_t, 3> cells{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    cells[axis] = (dims[axis] + cell_edge - 1) / cell_edge;
  own.in_cells.resize(cells[0] * cells[1] * cells[2]);
  // Every voxel belongs to its cell, and to the next one where it lies beside its face.
  const auto cells_of = [](std::size_t voxel, std::size_t count) {
    return std::array{(voxel - std::min<std::size_t>(voxel, 1)) / cell_edge,
                      std::min((voxel + 1) / cell_edge, count - 1)};
  };
  tbb::parallel_for(std::size_t{0}, cells[2], [&](std::size_t c) {
    const std::size_t begin = c * cell_edge - std::min<std::size_t>(c, 1);
    const std::size_t end = std::min((c + 1) * cell_edge + 1, dims[2]);
    for (std::size_t row = begin * dims[1]; row < end * dims[1]; ++row) {
      const auto y = cells_of(row % dims[1], cells[1]);
      for (std::size_t i = 0; i < dims[0]; ++i) {
        const std::uint8_t label = own.rows[row * dims[0] + i];
        const auto x = cells_of(i, cells[0]);
        for (std::size_t b = y[0]; b <= y[1]; ++b) {
          for (std::size_t a = x[0]; a <= x[1]; ++a)
            own.in_cells[(c * cells[1] + b) * cells[0] + a].set(label);
        }
      }
    }
  });
}

bool has_local_modes(const PreparedLabels& labels) {
  return std::any_of(labels.table.begin(), labels.table.end(),
                     [](const LabelRow& row) { return row.mode != LabelMode::dvr; });
}

} // namespace slicelens
