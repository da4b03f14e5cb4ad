// Which of a chart's rows belong to one line and to one panel. For the report's files only.
#pragma once

#include "study/sweep/results.h"

#include <optional>
#include <string>
#include <vector>

namespace slicelens::report {

using Rows = std::vector<const Row*>;
using Names = std::vector<std::string>;

/// The number in a column, or the one number of a list: [128, 128] is 128.
std::optional<double> axis_number(const StudyResults& results, const Row& row, const std::string& column);

/// The row's labels in these columns.
Names labels_of(const Row& row, const Names& columns);

/// The different labels of the rows, in their order.
std::vector<Names> tuples(const Rows& rows, const Names& columns);

/// "render.filter linear, render.spacing 1"
std::string tuple_text(const Names& columns, const Names& labels);

/// Columns of texts first, because they make better families of points than numbers do.
Names texts_first(const StudyResults& results, Names columns);

/// What tells points with the same x apart: columns of the other axes, and of x's own where it repeats x;
/// texts first. There is at least one row.
Names other_columns(const StudyResults& results, const Rows& rows, const std::string& x);

/// Which columns make lines and which panels; the rows of others are left out but for one value.
struct Split {
  Names series;
  Names panels;
  Names notes;
  Rows rows;
};

/// At most most_series lines and most_panels panels (report_charts.h); `wanted` (empty: as many as fit) makes
/// the lines. The notes say what is left out.
Split split_of(const Rows& rows, const Names& columns, const Names& wanted);

} // namespace slicelens::report
