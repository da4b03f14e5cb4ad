// The labels of a scene, ready to be looked up (mode `two-level`: Hauser, Mroz, Bischi and Gröller 2001).
#pragma once

#include "scene/load_labels.h"

#include <bitset>
#include <cstdint>
#include <optional>
#include <vector>

namespace slicelens {

struct PreparedScene;

/// How samples of one label, or of all that the table does not name, are shown.
struct LabelRow {
  TransferFunction transfer; ///< of opacity 0 where the label is not visible
  LabelMode mode = LabelMode::dvr;
  double length_ratio = 1; ///< the scene's reference length as a share of the label's own
};

/// Rows of a table of labels.
using LabelSet = std::bitset<max_labels + 1>;

/// Row 0 is all labels that the scene's table does not name, row i + 1 its entry i.
struct PreparedLabels {
  std::optional<LoadedLabels> loaded;
  std::vector<std::uint8_t> rows; ///< for each voxel its row; x fastest
  std::vector<LabelRow> table;    ///< empty under other modes
  std::vector<std::size_t> named; ///< label numbers that `rows` has been made for
  /// The rows in each cell of volume/cell_ranges.h and one voxel around it; where render.skip needs them.
  std::vector<LabelSet> in_cells = {};
};

/// Fills prepared.labels from what is loaded. Throws UsageError where labels are missing, are no whole
/// numbers, or lie on another grid than the volume.
void prepare_labels(PreparedScene& prepared);

/// Fills prepared.labels.in_cells unless it is filled already; nothing without labels.
void prepare_label_cells(PreparedScene& prepared);

/// Whether a run through any object is more than its samples one by one.
bool has_local_modes(const PreparedLabels& labels);

} // namespace slicelens
