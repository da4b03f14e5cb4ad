#include "json_output.h"

#include <nlohmann/json.hpp>

namespace slicelens::cli {

using Json = nlohmann::ordered_json;

std::string metrics_json(const Metrics& metrics) {
  Json json = Json::object();
  for (const auto& [name, value] : as_pairs(metrics)) {
    if (!value) {
      json[name] = nullptr;
    } else if (name == "width" || name == "height") {
      json[name] = static_cast<int>(*value);
    } else {
      json[name] = *value;
    }
  }
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

std::string volume_json(const Volume& volume) {
  Json json = Json::object();
  json["dims"] = volume.dims;
  json["spacing"] = {volume.spacing.x, volume.spacing.y, volume.spacing.z};
  json["origin"] = {volume.origin.x, volume.origin.y, volume.origin.z};
  // One row for each world axis, so that the matrix reads as it is written on paper.
  json["direction"] = Json::array();
  for (int row = 0; row < 3; ++row) {
    json["direction"].push_back(
        {volume.direction[0][row], volume.direction[1][row], volume.direction[2][row]});
  }
  json["type"] = name_of(volume.type);
  json["range"] = {volume.min, volume.max};
  json["mean"] = volume.mean;
  json["components"] = volume.components;
  json["frames"] = volume.frames;
  json["format"] = volume.format;
  if (volume.non_finite > 0)
    json["non_finite"] = volume.non_finite;
  return json.dump(2, ' ', true, nlohmann::ordered_json::error_handler_t::replace);
}

} // namespace slicelens::cli
