#include "scene/landmark_files.h"

#include "core/errors.h"
#include "core/files.h"
#include "core/text.h"
#include "scene/json_document.h"

#include <cmath>
#include <cstdlib>
#include <sstream>

namespace slicelens {

namespace fs = std::filesystem;
using keys_json::Json;

namespace {

enum class Format { json, csv, fcsv, markups };

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

Format format_of(const fs::path& path) {
  const std::string name = lower(path.filename().string());
  if (ends_with(name, ".mrk.json"))
    return Format::markups;
  if (ends_with(name, ".json"))
    return Format::json;
  if (ends_with(name, ".fcsv"))
    return Format::fcsv;
  if (ends_with(name, ".csv") || ends_with(name, ".txt"))
    return Format::csv;
  throw FileError(path.string(),
                  "is no list of points by its name; .json, .csv, .txt, .fcsv and .mrk.json are");
}

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream in(line);
  for (std::string cell; std::getline(in, cell, ',');)
    cells.push_back(trimmed(cell));
  return cells;
}

/// Whether the whole text is one finite number.
bool read_number(const std::string& text, double& value) {
  char* end = nullptr;
  value = std::strtod(text.c_str(), &end);
  return !text.empty() && *end == 0 && std::isfinite(value);
}

/// Lines of `count` numbers each, from column `first` on.
std::vector<std::vector<double>> read_rows(const fs::path& path, const std::string& text, std::size_t first,
                                           std::size_t count, bool heading) {
  std::vector<std::vector<double>> rows;
  std::istringstream in(text);
  int number = 0;
  bool any = false;
  for (std::string line; std::getline(in, line);) {
    ++number;
    line = trimmed(line);
    if (line.empty() || line[0] == '#')
      continue;
    const std::vector<std::string> cells = cells_of(line);
    std::vector<double> row(count);
    double ignored = 0;
    const bool words = !any && heading && !cells.empty() && !read_number(cells[0], ignored);
    any = true;
    if (words)
      continue;
    bool good = first > 0 ? cells.size() >= first + count : cells.size() == count;
    for (std::size_t i = 0; good && i < count; ++i)
      good = read_number(cells[first + i], row[i]);
    if (!good) {
      throw FileError(path.string(), "line " + std::to_string(number) + " does not hold " +
                                         std::to_string(count) + " numbers separated by commas" +
                                         (first > 0 ? " after the name" : ""));
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

glm::dvec3 point_of(const fs::path& path, const Json& json, const std::string& where) {
  glm::dvec3 point(0);
  bool good = json.is_array() && json.size() == 3;
  for (std::size_t i = 0; good && i < 3; ++i) {
    good = json[i].is_number() && std::isfinite(json[i].get<double>());
    if (good)
      point[static_cast<int>(i)] = json[i].get<double>();
  }
  if (!good)
    throw FileError(path.string(), where + " is no point; give three numbers [x, y, z]");
  return point;
}

Json list_of(const fs::path& path, const char* of) {
  Json json = keys_json::parse_file(path);
  if (!json.is_array())
    throw FileError(path.string(), std::string("holds no list; give ") + of);
  return json;
}

glm::dvec3 lps_of(const glm::dvec3& point, bool ras) {
  return ras ? glm::dvec3(-point.x, -point.y, point.z) : point;
}

/// "LPS", "RAS", or 3D Slicer's older 0 (RAS) and 1 (LPS).
bool is_ras(const fs::path& path, const std::string& system) {
  const std::string word = lower(system);
  if (word == "ras" || word == "0")
    return true;
  if (word == "lps" || word == "1")
    return false;
  throw FileError(path.string(), "its coordinate system is '" + system + "'; LPS and RAS are known");
}

std::vector<glm::dvec3> read_fcsv(const fs::path& path) {
  const std::string text = read_text(path);
  bool ras = true; // what 3D Slicer means when it says nothing
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    const std::size_t equals = line.find('=');
    if (line.rfind("#", 0) == 0 && lower(line).find("coordinatesystem") != std::string::npos &&
        equals != std::string::npos)
      ras = is_ras(path, trimmed(line.substr(equals + 1)));
  }
  std::vector<glm::dvec3> points;
  for (const std::vector<double>& row : read_rows(path, text, 1, 3, false))
    points.push_back(lps_of({row[0], row[1], row[2]}, ras));
  return points;
}

std::vector<glm::dvec3> read_markups(const fs::path& path) {
  const Json json = keys_json::parse_file(path);
  const auto lists = json.is_object() ? json.find("markups") : json.end();
  if (!json.is_object() || lists == json.end() || !lists->is_array() || lists->empty() ||
      !(*lists)[0].is_object() || !(*lists)[0].contains("controlPoints") ||
      !(*lists)[0]["controlPoints"].is_array()) {
    throw FileError(path.string(),
                    "holds no 'markups' with 'controlPoints'; it is no list of points of 3D Slicer");
  }
  const Json& list = (*lists)[0];
  const auto system = list.find("coordinateSystem");
  if (system != list.end() && !system->is_string())
    throw FileError(path.string(), "its 'coordinateSystem' is no text; LPS and RAS are known");
  const bool ras = system != list.end() && is_ras(path, system->get<std::string>());
  std::vector<glm::dvec3> points;
  for (const Json& control : list["controlPoints"]) {
    const std::string where = "control point " + std::to_string(points.size() + 1);
    const auto position = control.is_object() ? control.find("position") : control.end();
    if (!control.is_object() || position == control.end())
      throw FileError(path.string(), where + " has no 'position'; it is not placed yet");
    points.push_back(lps_of(point_of(path, *position, where), ras));
  }
  return points;
}

} // namespace

std::vector<LandmarkPair> read_landmark_pairs(const fs::path& path) {
  const Format format = format_of(path);
  if (format == Format::fcsv || format == Format::markups) {
    throw FileError(path.string(),
                    "holds single points; give it as warp.source or warp.target, with the other "
                    "ends of the pairs in a second file");
  }
  std::vector<LandmarkPair> pairs;
  if (format == Format::csv) {
    for (const std::vector<double>& row : read_rows(path, read_text(path), 0, 6, true))
      pairs.push_back({glm::dvec3(row[0], row[1], row[2]), glm::dvec3(row[3], row[4], row[5])});
    return pairs;
  }
  for (const Json& entry : list_of(path, "[[[sx,sy,sz],[tx,ty,tz]], …]")) {
    const std::string where = "pair " + std::to_string(pairs.size() + 1);
    if (!entry.is_array() || entry.size() != 2)
      throw FileError(path.string(), where + " is no pair of points; give [[sx,sy,sz],[tx,ty,tz]]");
    pairs.push_back(
        {point_of(path, entry[0], where + "'s source"), point_of(path, entry[1], where + "'s target")});
  }
  return pairs;
}

std::vector<glm::dvec3> read_points(const fs::path& path, bool texture) {
  const Format format = format_of(path);
  if (texture && (format == Format::fcsv || format == Format::markups))
    throw FileError(path.string(), "holds world positions; set warp.space to world");
  if (format == Format::fcsv)
    return read_fcsv(path);
  if (format == Format::markups)
    return read_markups(path);
  std::vector<glm::dvec3> points;
  if (format == Format::csv) {
    for (const std::vector<double>& row : read_rows(path, read_text(path), 0, 3, true))
      points.emplace_back(row[0], row[1], row[2]);
    return points;
  }
  for (const Json& entry : list_of(path, "[[x,y,z], …]"))
    points.push_back(point_of(path, entry, "point " + std::to_string(points.size() + 1)));
  return points;
}

} // namespace slicelens
