// 3D Slicer's volume properties: .vp, nine lines of text, and .vp.json, its volume-property-schema 1.0.0.
#include "core/errors.h"
#include "core/files.h"
#include "core/text.h"
#include "scene/json_document.h"
#include "scene/transfer_formats.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <sstream>

namespace slicelens::transfer_formats {

namespace fs = std::filesystem;
using keys_json::Json;

namespace {

constexpr const char* kSchema = "https://raw.githubusercontent.com/slicer/slicer/main/Modules/Loadable/"
                                "VolumeRendering/Resources/Schema/volume-property-schema-v1.0.0.json#";

/// What a scene would have to say to show the file's light.
void mention_display(TransferFile& file) {
  const SlicerDisplay& display = *file.display;
  const auto flat = [](const OpacityPoint& point) { return point.opacity == 1; };
  const auto& gradient = display.gradient_opacity;
  if (!std::all_of(gradient.begin(), gradient.end(), flat))
    file.ignored.emplace_back("gradient opacity");
  if (display.interpolation != 1)
    file.ignored.emplace_back(display.interpolation == 0 ? "interpolation (render.filter nearest)"
                                                         : "interpolation (render.filter cubic)");
  if (display.shade) {
    file.ignored.push_back("shading (render.shading phong, light.ambient " + number_text(display.ambient) +
                           ", light.diffuse " + number_text(display.diffuse) + ", light.specular " +
                           number_text(display.specular) + ", light.power " + number_text(display.power) +
                           ")");
  }
}

/// One line of .vp: numbers separated by spaces.
class Lines {
public:
  explicit Lines(const fs::path& path) : path_(path), in_(read_text(path, kMaxTransferFileBytes)) {}

  std::vector<double> numbers(const std::string& what) {
    what_ = "line " + std::to_string(++line_) + " (" + what + ")";
    std::string line;
    if (!std::getline(in_, line))
      refuse("is missing; a .vp file has nine lines");
    std::vector<double> numbers;
    std::istringstream words(line);
    for (std::string word; words >> word;) {
      char* end = nullptr;
      numbers.push_back(std::strtod(word.c_str(), &end));
      if (*end != 0 || !std::isfinite(numbers.back()))
        refuse("has '" + word.substr(0, 40) + "', which is no number");
    }
    return numbers;
  }

  double number(const std::string& what, double low, double high) {
    const std::vector<double> all = numbers(what);
    if (all.size() != 1 || !(all[0] >= low && all[0] <= high)) {
      refuse("must be one number from " + number_text(low) + " to " + number_text(high));
    }
    return all[0];
  }

  /// A count and so many numbers, `width` for each point; the count is left out.
  std::vector<double> points(const std::string& what, std::size_t width) {
    std::vector<double> all = numbers(what);
    const std::size_t count = all.empty() ? 0 : all.size() - 1;
    if (all.empty() || all[0] != static_cast<double>(count) || count % width != 0 || count == 0) {
      refuse("must begin with how many numbers follow, " + std::to_string(width) + " for each point" +
             (all.empty()
                  ? ""
                  : "; it says " + number_text(all[0]) + " and " + std::to_string(count) + " follow"));
    }
    check_count(path_, "points in " + what_, count / width);
    all.erase(all.begin());
    return all;
  }

  void finish() {
    for (std::string line; std::getline(in_, line);) {
      if (line.find_first_not_of(" \t\r") != std::string::npos)
        throw FileError(path_.string(), "has more than the nine lines of a .vp file");
    }
  }

private:
  [[noreturn]] void refuse(const std::string& problem) const {
    throw FileError(path_.string(), what_ + " " + problem);
  }

  const fs::path& path_;
  std::istringstream in_;
  std::size_t line_ = 0;
  std::string what_;
};

constexpr double kAnyLight = 1000; ///< Slicer's sliders end at 1, and at 50 for the power

/// A number of .vp.json, or what Slicer takes where it is missing.
double number_of(const fs::path& path, const Json& object, const char* key, double otherwise, double low,
                 double high) {
  const auto found = object.find(key);
  if (found == object.end() || found->is_null())
    return otherwise;
  if (!found->is_number() || !(found->get<double>() >= low && found->get<double>() <= high)) {
    throw FileError(path.string(), std::string("'") + key + "' must be a number from " + number_text(low) +
                                       " to " + number_text(high));
  }
  return found->get<double>();
}

bool bool_of(const fs::path& path, const Json& object, const char* key, bool otherwise) {
  const auto found = object.find(key);
  if (found == object.end() || found->is_null())
    return otherwise;
  if (!found->is_boolean())
    throw FileError(path.string(), std::string("'") + key + "' must be true or false");
  return found->get<bool>();
}

/// The points of a function of the component; none where it has none.
const Json* points_of(const fs::path& path, const Json& component, const char* key) {
  const auto function = component.find(key);
  if (function == component.end() || function->is_null())
    return nullptr;
  const auto points = function->is_object() ? function->find("points") : function->end();
  if (!function->is_object() || points == function->end() || !points->is_array() || points->empty())
    throw FileError(path.string(), std::string("'") + key + "' has no list 'points'");
  check_count(path, std::string("points in '") + key + "'", points->size());
  return &*points;
}

/// x and the shape of point `number` of a list; y too where it has one number.
struct JsonPoint {
  double x = 0;
  PieceShape shape;
};

JsonPoint point_of(const fs::path& path, const Json& point, const std::string& where) {
  if (!point.is_object() || !point.contains("x") || !point["x"].is_number())
    throw FileError(path.string(), where + " has no number 'x'");
  return {point["x"].get<double>(),
          {number_of(path, point, "midpoint", 0.5, 0, 1), number_of(path, point, "sharpness", 0, 0, 1)}};
}

std::vector<OpacityPoint> opacities_of(const fs::path& path, const Json& points, const char* key) {
  std::vector<OpacityPoint> result;
  for (const Json& entry : points) {
    const std::string where = std::string("'") + key + "': point " + std::to_string(result.size() + 1);
    const JsonPoint point = point_of(path, entry, where);
    if (!entry.contains("y") || !entry["y"].is_number())
      throw FileError(path.string(), where + " has no number 'y'");
    result.push_back({point.x, entry["y"].get<double>(), point.shape});
  }
  return result;
}

std::vector<ColorPoint> colors_of(const fs::path& path, const Json& points) {
  std::vector<ColorPoint> result;
  for (const Json& entry : points) {
    const std::string where = "'rgbTransferFunction': point " + std::to_string(result.size() + 1);
    const JsonPoint point = point_of(path, entry, where);
    const auto color = entry.find("color");
    const auto is_number = [](const Json& number) { return number.is_number(); };
    if (color == entry.end() || !color->is_array() || color->size() != 3 ||
        !std::all_of(color->begin(), color->end(), is_number))
      throw FileError(path.string(), where + " has no 'color' of three numbers");
    result.push_back({point.x,
                      {(*color)[0].get<double>(), (*color)[1].get<double>(), (*color)[2].get<double>()},
                      point.shape});
  }
  return result;
}

SlicerDisplay display_of(const fs::path& path, const Json& property, const Json& component) {
  SlicerDisplay display;
  const auto interpolation = property.find("interpolationType");
  if (interpolation != property.end()) {
    const std::string word = interpolation->is_string() ? interpolation->get<std::string>() : "";
    if (word != "nearest" && word != "linear" && word != "cubic")
      throw FileError(path.string(), "'interpolationType' must be nearest, linear or cubic");
    display.interpolation = word == "nearest" ? 0 : word == "linear" ? 1 : 2;
  }
  display.shade = bool_of(path, component, "shade", true);
  const auto light = component.find("lighting");
  const Json lighting = light != component.end() && light->is_object() ? *light : Json::object();
  display.ambient = number_of(path, lighting, "ambient", 0.1, 0, kAnyLight);
  display.diffuse = number_of(path, lighting, "diffuse", 0.7, 0, kAnyLight);
  display.specular = number_of(path, lighting, "specular", 0.2, 0, kAnyLight);
  display.power = number_of(path, lighting, "specularPower", 10, 0, kAnyLight);
  const Json* gradient = points_of(path, component, "gradientOpacity");
  if (gradient != nullptr && !bool_of(path, component, "disableGradientOpacity", false))
    display.gradient_opacity = opacities_of(path, *gradient, "gradientOpacity");
  return display;
}

/// First entry of a list in `object`.
const Json& first_of(const fs::path& path, const Json& object, const char* key) {
  const auto list = object.is_object() ? object.find(key) : object.end();
  if (!object.is_object() || list == object.end() || !list->is_array() || list->empty() ||
      !(*list)[0].is_object())
    throw FileError(path.string(),
                    std::string("holds no list '") + key + "'; it is no volume property of 3D Slicer");
  return (*list)[0];
}

/// Other keys of the schema that change the picture.
void mention_others(TransferFile& file, const Json& json, const Json& property, const Json& component) {
  if (json["volumeProperties"].size() > 1)
    file.ignored.emplace_back("volume properties after the first");
  if (property["components"].size() > 1)
    file.ignored.emplace_back("components after the first");
  const auto differs = [&](const Json& object, const char* key, double usual) {
    const auto found = object.find(key);
    if (found != object.end() && found->is_number() && found->get<double>() != usual)
      file.ignored.emplace_back(key);
  };
  differs(component, "componentWeight", 1);
  differs(property, "scatteringAnisotropy", 0);
  const auto clipped = property.find("useClippedVoxelIntensity");
  if (clipped != property.end() && *clipped == true)
    file.ignored.emplace_back("clippedVoxelIntensity");
}

void append(std::string& text, double number) { text += " " + number_text(number); }

const SlicerDisplay& display_to_write(const TransferToWrite& what, const SlicerDisplay& otherwise) {
  return what.display ? *what.display : otherwise;
}

/// The gradient opacity, or 1 everywhere as Slicer writes it.
std::vector<OpacityPoint> gradient_to_write(const SlicerDisplay& display) {
  if (!display.gradient_opacity.empty())
    return display.gradient_opacity;
  return {{0, 1}, {255, 1}};
}

} // namespace

TransferFile read_slicer_text(const fs::path& path) {
  Lines lines(path);
  TransferFile file;
  file.name = path.stem().string();
  SlicerDisplay& display = file.display.emplace();
  display.interpolation = static_cast<int>(lines.number("interpolation", 0, 2));
  display.shade = lines.number("shading", 0, 1) != 0;
  display.diffuse = lines.number("diffuse", 0, kAnyLight);
  display.ambient = lines.number("ambient", 0, kAnyLight);
  display.specular = lines.number("specular", 0, kAnyLight);
  display.power = lines.number("specular power", 0, kAnyLight);
  const std::vector<double> opacities = lines.points("scalar opacity", 2);
  for (std::size_t i = 0; i < opacities.size(); i += 2)
    file.opacity.points.push_back({opacities[i], opacities[i + 1]});
  const std::vector<double> gradient = lines.points("gradient opacity", 2);
  for (std::size_t i = 0; i < gradient.size(); i += 2)
    display.gradient_opacity.push_back({gradient[i], gradient[i + 1]});
  const std::vector<double> colors = lines.points("colour", 4);
  for (std::size_t i = 0; i < colors.size(); i += 4)
    file.color.points.push_back({colors[i], {colors[i + 1], colors[i + 2], colors[i + 3]}});
  lines.finish();
  join_steps(file.color);
  join_steps(file.opacity);
  mention_display(file);
  return file;
}

TransferFile read_slicer_json(const fs::path& path) {
  const Json json = keys_json::parse_file(path, kMaxTransferFileBytes);
  const Json& property = first_of(path, json, "volumeProperties");
  const Json& component = first_of(path, property, "components");
  TransferFile file;
  file.name = path.stem().stem().string();
  file.display = display_of(path, property, component);
  const Json* opacities = points_of(path, component, "scalarOpacity");
  const Json* colors = points_of(path, component, "rgbTransferFunction");
  if (opacities == nullptr || colors == nullptr) {
    throw FileError(path.string(), "its component needs both 'scalarOpacity' and 'rgbTransferFunction'");
  }
  file.opacity.points = opacities_of(path, *opacities, "scalarOpacity");
  file.color.points = colors_of(path, *colors);
  join_steps(file.color);
  join_steps(file.opacity);
  const auto distance = component.find("scalarOpacityUnitDistance");
  if (distance != component.end() && !distance->is_null()) {
    if (!distance->is_number() || !(distance->get<double>() > 0))
      throw FileError(path.string(), "'scalarOpacityUnitDistance' must be a number above 0");
    file.unit_distance = distance->get<double>();
  }
  mention_display(file);
  mention_others(file, json, property, component);
  return file;
}

std::string slicer_text(const TransferToWrite& what) {
  const SlicerDisplay otherwise;
  const SlicerDisplay& display = display_to_write(what, otherwise);
  std::string text;
  for (const double number : {static_cast<double>(display.interpolation), display.shade ? 1.0 : 0.0,
                              display.diffuse, display.ambient, display.specular, display.power})
    text += number_text(number) + "\n";
  const std::vector<TransferPoint> points = written_points(what.transfer);
  text += std::to_string(2 * points.size());
  for (const TransferPoint& p : points) {
    append(text, p.value);
    append(text, p.opacity);
  }
  const std::vector<OpacityPoint> gradient = gradient_to_write(display);
  text += "\n" + std::to_string(2 * gradient.size());
  for (const OpacityPoint& p : gradient) {
    append(text, p.value);
    append(text, p.opacity);
  }
  text += "\n" + std::to_string(4 * points.size());
  for (const TransferPoint& p : points) {
    for (const double number : {p.value, p.r, p.g, p.b})
      append(text, number);
  }
  return text + "\n";
}

std::string slicer_json_text(const TransferToWrite& what) {
  const SlicerDisplay otherwise;
  const SlicerDisplay& display = display_to_write(what, otherwise);
  const std::vector<TransferPoint> points = written_points(what.transfer);
  const auto opacity_point = [](double x, double y, const PieceShape& shape) {
    return Json{{"x", x}, {"y", y}, {"midpoint", shape.midpoint}, {"sharpness", shape.sharpness}};
  };
  Json colors = Json::array();
  Json opacities = Json::array();
  for (const TransferPoint& p : points) {
    colors.push_back(
        {{"x", p.value}, {"color", Json::array({p.r, p.g, p.b})}, {"midpoint", 0.5}, {"sharpness", 0.0}});
    opacities.push_back(opacity_point(p.value, p.opacity, {}));
  }
  Json gradient = Json::array();
  for (const OpacityPoint& p : gradient_to_write(display))
    gradient.push_back(opacity_point(p.value, p.opacity, p.shape));
  Json component = {{"componentWeight", 1.0},
                    {"shade", display.shade},
                    {"lighting",
                     {{"diffuse", display.diffuse},
                      {"ambient", display.ambient},
                      {"specular", display.specular},
                      {"specularPower", display.power}}},
                    {"disableGradientOpacity", false}};
  if (what.transfer.unit_distance)
    component["scalarOpacityUnitDistance"] = *what.transfer.unit_distance;
  component["rgbTransferFunction"] = {{"type", "colorTransferFunction"}, {"points", std::move(colors)}};
  component["scalarOpacity"] = {{"type", "piecewiseLinearFunction"}, {"points", std::move(opacities)}};
  component["gradientOpacity"] = {{"type", "piecewiseLinearFunction"}, {"points", std::move(gradient)}};
  const char* interpolations[] = {"nearest", "linear", "cubic"};
  Json property = {{"effectiveRange", Json::array({points.front().value, points.back().value})},
                   {"isoSurfaceValues", Json::array()},
                   {"independentComponents", true},
                   {"interpolationType", interpolations[display.interpolation]},
                   {"useClippedVoxelIntensity", false},
                   {"clippedVoxelIntensity", 0.0},
                   {"scatteringAnisotropy", 0.0},
                   {"components", Json::array({std::move(component)})}};
  const Json json = {{"@schema", kSchema}, {"volumeProperties", Json::array({std::move(property)})}};
  return json.dump(4) + "\n";
}

} // namespace slicelens::transfer_formats
