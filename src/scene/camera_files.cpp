#include "scene/camera_files.h"

#include "core/errors.h"
#include "core/files.h"
#include "core/text.h"
#include "scene/camera.h"

#include <pugixml.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <vector>

namespace slicelens {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMaxCameraFileBytes = std::size_t{1} << 20;
constexpr double kMaxNumber = 1e30;

/// Number of elements of each property that is read.
const std::map<std::string, std::size_t>& known_properties() {
  static const std::map<std::string, std::size_t> known = {
      {"CameraPosition", 3},  {"CameraFocalPoint", 3},         {"CameraViewUp", 3},
      {"CameraViewAngle", 1}, {"CameraParallelProjection", 1}, {"CameraParallelScale", 1}};
  return known;
}

using Properties = std::map<std::string, std::vector<double>>;

double element_value(const fs::path& path, const std::string& property, const pugi::xml_node& element) {
  const char* text = element.attribute("value").value();
  char* end = nullptr;
  const double value = std::strtod(text, &end);
  if (*text == 0 || *end != 0 || !(std::abs(value) <= kMaxNumber))
    throw FileError(path.string(), "'" + property + "' has an element that is no number within ±1e30");
  return value;
}

std::vector<double> elements_of(const fs::path& path, const std::string& name, const pugi::xml_node& node,
                                std::size_t count) {
  std::vector<double> values(count, 0.0);
  std::vector<bool> given(count, false);
  for (const pugi::xml_node& element : node.children("Element")) {
    const std::size_t index = element.attribute("index").as_ullong(count);
    if (index >= count || given[index])
      throw FileError(path.string(),
                      "'" + name + "' needs " + std::to_string(count) + " elements, numbered from 0");
    values[index] = element_value(path, name, element);
    given[index] = true;
  }
  if (!std::all_of(given.begin(), given.end(), [](bool is) { return is; }))
    throw FileError(path.string(), "'" + name + "' needs " + std::to_string(count) + " elements");
  return values;
}

/// The properties by name; `ignored` receives those that bend the view in ways that scenes have not.
Properties properties_of(const fs::path& path, const pugi::xml_node& root, std::string& ignored) {
  Properties properties;
  for (const pugi::xml_node& node : root.child("Proxy").children("Property")) {
    const std::string name = node.attribute("name").value();
    const auto known = known_properties().find(name);
    if (known != known_properties().end()) {
      properties[name] = elements_of(path, name, node, known->second);
    } else if (name != "CenterOfRotation" && name != "RotationFactor") { // these guide the mouse
      ignored += (ignored.empty() ? "" : ", ") + name.substr(0, 40);
    }
  }
  for (const char* name : {"CameraPosition", "CameraFocalPoint", "CameraViewUp"}) {
    if (properties.count(name) == 0)
      throw FileError(path.string(), std::string("has no '") + name + "'; it is no whole camera of ParaView");
  }
  return properties;
}

glm::dvec3 vector_of(const std::vector<double>& values) { return {values[0], values[1], values[2]}; }

void check_view(const fs::path& path, const CameraSettings& camera) {
  if (!(camera.view_angle > 0 && camera.view_angle < 180))
    throw FileError(path.string(), "'CameraViewAngle' must be above 0 and below 180 degrees");
  if (camera.parallel_scale && !(*camera.parallel_scale > 0))
    throw FileError(path.string(), "'CameraParallelScale' must be above 0");
  try {
    (void)make_view(camera, {}, 1, 1);
  } catch (const UsageError&) {
    throw FileError(path.string(), "its position, focal point and view up make no view: the first two must "
                                   "differ, and view up must not lie along the line between them");
  }
}

void append_property(std::string& text, const std::string& name, const std::vector<double>& values) {
  text += "    <Property name=\"" + name + "\" id=\"0." + name + "\" number_of_elements=\"" +
          std::to_string(values.size()) + "\">\n";
  for (std::size_t i = 0; i < values.size(); ++i) {
    text += "      <Element index=\"" + std::to_string(i) + "\" value=\"" + number_text(values[i]) + "\"/>\n";
  }
  if (name == "CameraParallelProjection")
    text += "      <Domain name=\"bool\" id=\"0.CameraParallelProjection.bool\"/>\n";
  text += "    </Property>\n";
}

std::vector<double> list_of(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

} // namespace

ReadCamera read_camera_file(const fs::path& path) {
  const std::string text = read_text(path, kMaxCameraFileBytes);
  pugi::xml_document document;
  const pugi::xml_parse_result parsed = document.load_buffer(text.data(), text.size());
  if (!parsed) {
    throw FileError(path.string(), std::string("is no XML: ") + parsed.description() + " at byte " +
                                       std::to_string(parsed.offset));
  }
  const pugi::xml_node root = document.child("PVCameraConfiguration");
  if (!root)
    throw FileError(path.string(), "has no <PVCameraConfiguration>; it is no camera of ParaView");
  ReadCamera read;
  const Properties properties = properties_of(path, root, read.ignored);
  CameraSettings& camera = read.camera;
  camera.position = vector_of(properties.at("CameraPosition"));
  camera.focal_point = vector_of(properties.at("CameraFocalPoint"));
  camera.view_up = vector_of(properties.at("CameraViewUp"));
  const auto number = [&](const char* name, double otherwise) {
    const auto found = properties.find(name);
    return found == properties.end() ? otherwise : found->second[0];
  };
  camera.view_angle = number("CameraViewAngle", 30); // VTK's own defaults
  camera.projection =
      number("CameraParallelProjection", 0) != 0 ? ProjectionName::orthographic : ProjectionName::perspective;
  if (properties.count("CameraParallelScale") != 0)
    camera.parallel_scale = number("CameraParallelScale", 1);
  check_view(path, camera);
  return read;
}

CameraSettings explicit_camera(const CameraSettings& camera, const Box& box) {
  const View view = make_view(camera, box, 1, 1);
  CameraSettings result;
  result.projection = camera.projection;
  result.focal_point = camera.focal_point.value_or(center(box));
  result.position = view.eye;
  // As given where it was given: the view's own is made orthogonal to the viewing direction.
  result.view_up = camera.position && camera.view_up ? *camera.view_up : view.up;
  const bool perspective = camera.projection == ProjectionName::perspective;
  result.view_angle = perspective ? camera.view_angle / camera.zoom : camera.view_angle;
  result.parallel_scale =
      perspective ? camera.parallel_scale.value_or(bounding_radius(box)) : view.half_height;
  return result;
}

void write_camera_file(const fs::path& path, const CameraSettings& camera) {
  if (lower(path.extension().string()) != ".pvcc")
    throw UsageError(path.string() + ": cannot be written; a camera's name ends in .pvcc");
  std::string text =
      "<?xml version=\"1.0\"?>\n<PVCameraConfiguration description=\"ParaView camera "
      "configuration\" version=\"1.0\">\n  <Proxy group=\"views\" type=\"RenderView\" id=\"0\" "
      "servers=\"21\">\n";
  append_property(text, "CameraPosition", list_of(camera.position.value()));
  append_property(text, "CameraFocalPoint", list_of(camera.focal_point.value()));
  append_property(text, "CameraViewUp", list_of(camera.view_up.value()));
  append_property(text, "CenterOfRotation", list_of(camera.focal_point.value()));
  append_property(text, "RotationFactor", {1});
  append_property(text, "CameraViewAngle", {camera.view_angle});
  append_property(text, "CameraParallelScale", {camera.parallel_scale.value()});
  append_property(text, "CameraParallelProjection",
                  {camera.projection == ProjectionName::orthographic ? 1.0 : 0.0});
  text += "  </Proxy>\n</PVCameraConfiguration>\n";
  write_text_atomically(path, text);
}

} // namespace slicelens
