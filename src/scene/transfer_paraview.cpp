// ParaView's colour maps: the JSON that its colour map editor imports and exports (objects with ColorSpace,
// RGBPoints [x,r,g,b, …] and Points [x,opacity,midpoint,sharpness, …]), and the XML of versions before 4.3.
#include "core/errors.h"
#include "core/files.h"
#include "core/text.h"
#include "scene/json_document.h"
#include "scene/transfer_formats.h"

#include <pugixml.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace slicelens::transfer_formats {

namespace fs = std::filesystem;
using keys_json::Json;

namespace {

ColorSpace space_named(const fs::path& path, const std::string& name, bool wrapped) {
  if (name == "RGB")
    return ColorSpace::rgb;
  if (name == "HSV")
    return wrapped ? ColorSpace::hsv_wrapped : ColorSpace::hsv;
  if (name == "Wrapped") // the name in XML
    return ColorSpace::hsv_wrapped;
  if (name == "Lab")
    return ColorSpace::lab;
  if (name == "Diverging")
    return ColorSpace::diverging;
  if (name == "Step")
    return ColorSpace::step;
  throw FileError(path.string(), "the colour space '" + name.substr(0, 40) +
                                     "' is not known; RGB, HSV, Wrapped, Lab, Diverging and Step are");
}

/// A flat list of numbers, `width` for each point.
std::vector<double> flat_numbers(const fs::path& path, const Json& map, const char* key, std::size_t width) {
  const auto found = map.find(key);
  if (found == map.end() || found->is_null())
    return {};
  const std::string name = std::string("'") + key + "'";
  if (!found->is_array() || found->size() % width != 0) {
    throw FileError(path.string(), name + " must be a list of " + std::to_string(width) +
                                       " numbers for each point" +
                                       (found->is_array() ? ", not " + std::to_string(found->size()) : ""));
  }
  check_count(path, "points in " + name, found->size() / width);
  std::vector<double> numbers;
  numbers.reserve(found->size());
  for (const Json& entry : *found) {
    if (!entry.is_number())
      throw FileError(path.string(), name + ": entry " + std::to_string(numbers.size()) + " is no number");
    numbers.push_back(entry.get<double>());
  }
  return numbers;
}

bool flag(const Json& map, const char* key) {
  const auto found = map.find(key);
  if (found == map.end())
    return false;
  return found->is_boolean() ? found->get<bool>() : found->is_number() && found->get<double>() != 0;
}

std::string text_of(const Json& map, const char* key, const std::string& otherwise) {
  const auto found = map.find(key);
  return found != map.end() && found->is_string() ? found->get<std::string>() : otherwise;
}

/// Keys that say nothing about what is drawn, or are read.
bool needs_no_mention(const std::string& key) {
  static const std::vector<std::string> keys = {
      "Name",       "ColorSpace", "RGBPoints", "Points",      "UseLogScale", "HSVWrap", "Creator",
      "DefaultMap", "License",    "Source",    "Description", "Category",    "Groups",  "@schema"};
  return std::find(keys.begin(), keys.end(), key) != keys.end();
}

TransferFile file_of_map(const fs::path& path, const Json& map) {
  TransferFile file;
  file.name = text_of(map, "Name", path.stem().string());
  const std::vector<double> colors = flat_numbers(path, map, "RGBPoints", 4);
  if (colors.empty()) {
    throw FileError(path.string(), map.contains("IndexedColors")
                                       ? "holds indexed colours for categories, which have no values; a "
                                         "colour map with 'RGBPoints' is needed"
                                       : "its colour map has no 'RGBPoints' [value, r, g, b, …]");
  }
  file.color.space = space_named(path, text_of(map, "ColorSpace", "RGB"), flag(map, "HSVWrap"));
  file.color.logarithmic = flag(map, "UseLogScale");
  for (std::size_t i = 0; i < colors.size(); i += 4)
    file.color.points.push_back({colors[i], {colors[i + 1], colors[i + 2], colors[i + 3]}});
  const std::vector<double> opacities = flat_numbers(path, map, "Points", 4);
  for (std::size_t i = 0; i < opacities.size(); i += 4)
    file.opacity.points.push_back({opacities[i], opacities[i + 1], {opacities[i + 2], opacities[i + 3]}});
  join_steps(file.color);
  join_steps(file.opacity);
  for (const auto& [key, value] : map.items()) {
    if (!needs_no_mention(key))
      file.ignored.push_back(key.substr(0, 40));
  }
  return file;
}

double attribute(const fs::path& path, const pugi::xml_node& point, const char* name, std::size_t number) {
  const char* text = point.attribute(name).value();
  char* end = nullptr;
  const double value = std::strtod(text, &end);
  if (*text == 0 || *end != 0 || !std::isfinite(value)) {
    throw FileError(path.string(),
                    "<Point> " + std::to_string(number) + ": attribute '" + name + "' must be a number");
  }
  return value;
}

TransferFile file_of_xml_map(const fs::path& path, const pugi::xml_node& map) {
  TransferFile file;
  file.name = *map.attribute("name").value() != 0 ? map.attribute("name").value() : path.stem().string();
  if (map.attribute("indexedLookup").as_bool()) {
    throw FileError(path.string(), "holds indexed colours for categories, which have no values; a colour map "
                                   "with 'x' in each <Point> is needed");
  }
  file.color.space =
      space_named(path, map.attribute("space") ? map.attribute("space").value() : "RGB", false);
  bool opaque = true;
  bool all = true;
  for (const pugi::xml_node& point : map.children("Point")) {
    const std::size_t number = file.color.points.size() + 1;
    check_count(path, "points", number);
    const double x = attribute(path, point, "x", number);
    file.color.points.push_back({x,
                                 {attribute(path, point, "r", number), attribute(path, point, "g", number),
                                  attribute(path, point, "b", number)}});
    if (point.attribute("o"))
      file.opacity.points.push_back({x, attribute(path, point, "o", number)});
    all = all && point.attribute("o");
    opaque = opaque && (!point.attribute("o") || file.opacity.points.back().opacity == 1);
  }
  if (file.color.points.empty())
    throw FileError(path.string(), "its <ColorMap> has no <Point x r g b>");
  // ParaView writes o="1" on every point, whatever the opacity function is.
  if (opaque || !all)
    file.opacity.points.clear();
  if (!opaque && !all)
    file.ignored.emplace_back("the opacity 'o' of some points");
  join_steps(file.color);
  join_steps(file.opacity);
  for (const pugi::xml_node& child : map.children()) {
    const std::string name = child.name();
    if (child.type() == pugi::node_element && name != "Point" &&
        std::find(file.ignored.begin(), file.ignored.end(), name) == file.ignored.end())
      file.ignored.push_back(name.substr(0, 40));
  }
  return file;
}

} // namespace

TransferFile read_paraview_json(const fs::path& path, const std::string& map) {
  const Json json = keys_json::parse_file(path, kMaxTransferFileBytes);
  std::vector<const Json*> maps;
  std::vector<std::string> names;
  const auto add = [&](const Json& entry) {
    if (!entry.is_object()) {
      throw FileError(path.string(), "is no list of colour maps; ParaView writes [{\"ColorSpace\": …, "
                                     "\"RGBPoints\": […]}]");
    }
    maps.push_back(&entry);
    names.push_back(text_of(entry, "Name", ""));
  };
  if (json.is_array()) {
    for (const Json& entry : json)
      add(entry);
  } else {
    add(json);
  }
  return file_of_map(path, *maps[choose_map(path, names, map)]);
}

TransferFile read_paraview_xml(const fs::path& path, const std::string& map) {
  const std::string text = read_text(path, kMaxTransferFileBytes);
  pugi::xml_document document;
  const pugi::xml_parse_result parsed = document.load_buffer(text.data(), text.size());
  if (!parsed) {
    throw FileError(path.string(), std::string("is no XML: ") + parsed.description() + " at byte " +
                                       std::to_string(parsed.offset));
  }
  std::vector<pugi::xml_node> maps;
  std::vector<std::string> names;
  const auto add = [&](const pugi::xml_node& node) {
    maps.push_back(node);
    names.emplace_back(node.attribute("name").value());
  };
  if (const pugi::xml_node single = document.child("ColorMap"))
    add(single);
  for (const pugi::xml_node& node : document.child("ColorMaps").children("ColorMap"))
    add(node);
  if (maps.empty())
    throw FileError(path.string(), "has no <ColorMap>; it is no colour map of ParaView");
  return file_of_xml_map(path, maps[choose_map(path, names, map)]);
}

std::string paraview_json_text(const TransferToWrite& what) {
  Json map = Json::object();
  map["ColorSpace"] = "RGB";
  map["Name"] = what.transfer.name.empty() ? "Slicelens" : what.transfer.name;
  Json colors = Json::array();
  Json opacities = Json::array();
  for (const TransferPoint& p : written_points(what.transfer)) {
    for (const double number : {p.value, p.r, p.g, p.b})
      colors.push_back(number);
    for (const double number : {p.value, p.opacity, 0.5, 0.0})
      opacities.push_back(number);
  }
  map["Points"] = std::move(opacities);
  map["RGBPoints"] = std::move(colors);
  // A name out of an XML file, or a file's own, need not be UTF-8.
  return Json::array({std::move(map)}).dump(1, '\t', false, Json::error_handler_t::replace) + "\n";
}

} // namespace slicelens::transfer_formats
