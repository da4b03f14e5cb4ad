#include "scene/scene_json.h"

#include "scene/keys_json.h"

namespace slicelens {

using namespace keys_json;

KeyValue parse_assignment(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw UsageError("'" + text + "' is not KEY=VALUE; write for instance render.spacing=0.5");
  }
  return {text.substr(0, equals), text.substr(equals + 1)};
}

Scene scene_keys_from_json(const std::string& text, const std::string& source,
                           const std::vector<KeyValue>& changes) {
  const Json json = changed_document(text, source, changes);
  Scene scene;
  try {
    Reader reader(json, "");
    scene_keys(reader, scene);
    reader.finish();
    if (!scene.volume.file && !scene.volume.phantom)
      scene.volume.phantom = "head";
    if (scene.volume.labels && !has_value(json, "render", "mode"))
      scene.render.mode = Mode::two_level;
    if (!has_value(json, "render", "pipeline"))
      scene.render.pipeline = default_pipeline(scene);
    use_pipeline_defaults(scene.render, has_value(json, "render", "classification"),
                          has_value(json, "render", "target"),
                          has_value(json, "render", "opacity_correction"));
  } catch (const UsageError& error) {
    throw UsageError(source + ": " + error.what());
  }
  return scene;
}

Scene scene_from_json(const std::string& text, const std::string& source,
                      const std::vector<KeyValue>& changes) {
  Scene scene = scene_keys_from_json(text, source, changes);
  try {
    validate(scene);
  } catch (const UsageError& error) {
    throw UsageError(source + ": " + error.what());
  }
  return scene;
}

std::string scene_to_json(const Scene& scene, int indent) {
  Writer writer;
  scene_keys(writer, scene);
  return writer.object.dump(indent, ' ', true, Json::error_handler_t::replace);
}

std::vector<std::pair<std::string, std::string>> list_scene_keys() {
  std::vector<std::pair<std::string, std::string>> keys;
  Lister lister{keys, ""};
  const Scene scene;
  scene_keys(lister, scene);
  return keys;
}

} // namespace slicelens
