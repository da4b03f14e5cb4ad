// ImageVis3D's one-dimensional transfer functions (.1dt): the number of rows, then red, green, blue and
// opacity of each, as text.
#include "core/errors.h"
#include "core/files.h"
#include "core/text.h"
#include "scene/transfer_formats.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>

namespace slicelens::transfer_formats {

namespace fs = std::filesystem;

TransferFile read_table(const fs::path& path) {
  std::istringstream in(read_text(path, kMaxTransferFileBytes));
  std::string word;
  const auto number = [&](const std::string& what) {
    if (!(in >> word))
      throw FileError(path.string(), "ends before " + what);
    char* end = nullptr;
    const double value = std::strtod(word.c_str(), &end);
    if (*end != 0 || !std::isfinite(value))
      throw FileError(path.string(), what + " is '" + word.substr(0, 40) + "', which is no number");
    return value;
  };
  const double count = number("the number of rows");
  if (!(count >= 2 && count <= static_cast<double>(kMaxControlPoints)) || count != std::floor(count)) {
    throw FileError(path.string(), "begins with '" + word.substr(0, 40) +
                                       "'; the number of rows must be a whole one from 2 to " +
                                       std::to_string(kMaxControlPoints));
  }
  TransferFile file;
  file.name = path.stem().string();
  file.rows = true;
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    double rgba[4];
    for (double& channel : rgba)
      channel = number("row " + std::to_string(i + 1) + " of " + number_text(count));
    const double row = static_cast<double>(i);
    file.color.points.push_back({row, {rgba[0], rgba[1], rgba[2]}});
    file.opacity.points.push_back({row, rgba[3]});
  }
  if (in >> word)
    throw FileError(path.string(), "has more than the " + number_text(count) + " rows that it begins with");
  return file;
}

std::string table_text(const TransferToWrite& what, double& deviation) {
  const double low = what.rows_range[0];
  const double high = what.rows_range[1];
  if (!(low < high) || !std::isfinite(high - low))
    throw UsageError("a table needs a range of values from the first to the last row; give --range LOW,HIGH");
  if (what.rows < 2 || what.rows > kMaxControlPoints) {
    throw UsageError("a table has from 2 to " + std::to_string(kMaxControlPoints) + " rows, not " +
                     std::to_string(what.rows));
  }
  const double last = static_cast<double>(what.rows - 1);
  TransferFunction table;
  std::string text = std::to_string(what.rows) + "\n";
  for (std::size_t i = 0; i < what.rows; ++i) {
    const double f = static_cast<double>(i) / last;
    const double value = low * (1 - f) + high * f;
    const glm::dvec4 rgba = evaluate(what.transfer, value);
    table.points.push_back({value, rgba.r, rgba.g, rgba.b, rgba.a});
    text += number_text(rgba.r) + " " + number_text(rgba.g) + " " + number_text(rgba.b) + " " +
            number_text(rgba.a) + "\n";
  }
  // Both functions are straight between rows and points, so the largest difference is at a point.
  for (std::size_t i = 0; i < what.transfer.points.size(); ++i) {
    const TransferPoint& p = what.transfer.points[i];
    const glm::dvec4 d = glm::abs(evaluate(table, p.value) - glm::dvec4(p.r, p.g, p.b, p.opacity));
    deviation = std::max({deviation, d.r, d.g, d.b, d.a});
  }
  return text;
}

} // namespace slicelens::transfer_formats
