#include "study/sweep/combinations.h"

#include "core/errors.h"
#include "core/text.h"

#include <algorithm>
#include <cstdio>

namespace slicelens {

namespace {

constexpr std::size_t most_combinations = 1000000;

/// VTK's pipelines are no scene's: the scene itself is drawn by slices, and `peer` says what draws it.
void take_peer(Combination& combination) {
  for (KeyValue& change : combination.changes) {
    if (change.key != "render.pipeline")
      continue;
    combination.peer.reset();
    for (const char* mapper : {"gpu", "cpu"}) {
      if (change.value == "\"vtk-" + std::string(mapper) + "\"") {
        combination.peer = mapper;
        change.value = "\"slices\"";
      }
    }
  }
}

Combination combination_at(const Study& study, std::size_t number) {
  Combination combination;
  combination.changes = study.set;
  std::vector<const SweepValue*> values(study.axes.size());
  for (std::size_t i = study.axes.size(); i-- > 0;) {
    const std::size_t count = study.axes[i].values.size();
    values[i] = &study.axes[i].values[number % count];
    number /= count;
  }
  for (const SweepValue* value : values) {
    combination.labels.insert(combination.labels.end(), value->labels.begin(), value->labels.end());
    combination.changes.insert(combination.changes.end(), value->changes.begin(), value->changes.end());
    if (value->scene)
      combination.scene = *value->scene;
  }
  take_peer(combination);
  return combination;
}

/// Where relative paths of its files are looked for, in order and once each.
std::vector<std::filesystem::path> folders_of(const BaseScene& base, const Study& study) {
  std::vector<std::filesystem::path> folders;
  for (std::filesystem::path folder : {base.folder, study.folder, std::filesystem::path(".")}) {
    if (folder.empty())
      folder = ".";
    if (std::find(folders.begin(), folders.end(), folder) == folders.end())
      folders.push_back(folder);
  }
  return folders;
}

std::string source_of(const BaseScene& base, const std::string& name) {
  return name.empty() ? base.source : base.source + " (" + name + ")";
}

SceneInput volume_input(const BaseScene& base, const std::vector<KeyValue>& changes, const Study& study,
                        const std::string& name) {
  SceneInput input;
  input.source = source_of(base, name);
  input.scene = scene_from_json(base.text, input.source, changes);
  input.folders = folders_of(base, study);
  return input;
}

StudyInput any_input(const BaseScene& base, const std::vector<KeyValue>& changes, const Study& study,
                     const std::string& name) {
  if (!is_image_scene(base.text))
    return volume_input(base, changes, study, name);
  const std::string source = source_of(base, name);
  return PictureInput{image_scene_from_json(base.text, source, changes), folders_of(base, study), source};
}

} // namespace

std::vector<Combination> combinations_of(const Study& study) {
  std::size_t count = 1;
  for (const SweepAxis& axis : study.axes) {
    count = checked_product(count, axis.values.size(), "the number of combinations");
    if (count > most_combinations)
      throw LimitError("the study has more than a million combinations; vary fewer keys, or some together");
  }
  std::vector<Combination> all;
  for (std::size_t number = 0; number < count; ++number) {
    Combination combination = combination_at(study, number);
    const bool left_out =
        std::any_of(study.except.begin(), study.except.end(),
                    [&](const Condition& condition) { return holds(condition, combination.labels); });
    if (left_out)
      continue;
    combination.index = all.size();
    all.push_back(std::move(combination));
  }
  if (all.empty())
    throw UsageError(study.name + ": except leaves no combination");
  return all;
}

bool holds(const Condition& condition, const std::vector<Label>& labels) {
  return std::all_of(condition.begin(), condition.end(), [&](const auto& wanted) {
    return std::any_of(labels.begin(), labels.end(), [&](const Label& label) {
      return label.first == wanted.first &&
             std::find(wanted.second.begin(), wanted.second.end(), label.second) != wanted.second.end();
    });
  });
}

std::string label_text(const std::vector<Label>& labels) {
  std::vector<std::string> parts;
  for (const Label& label : labels)
    parts.push_back(label.first + " " + label.second);
  return join(parts);
}

SceneInput scene_of(const Study& study, const Combination& combination) {
  return volume_input(study.scenes[combination.scene], combination.changes, study,
                      label_text(combination.labels));
}

StudyInput input_of(const Study& study, const Combination& combination) {
  return any_input(study.scenes[combination.scene], combination.changes, study,
                   label_text(combination.labels));
}

std::optional<StudyInput> reference_of(const Study& study, const Combination& combination) {
  if (!study.reference)
    return std::nullopt;
  const ReferenceScene& reference = *study.reference;
  if (reference.scene)
    return any_input(*reference.scene, reference.changes, study, "reference");
  std::vector<KeyValue> changes = combination.changes;
  changes.insert(changes.end(), reference.changes.begin(), reference.changes.end());
  return any_input(study.scenes[combination.scene], changes, study, "reference");
}

std::string scene_text_of(const StudyInput& input) {
  if (const auto* volume = std::get_if<SceneInput>(&input))
    return scene_to_json(volume->scene, -1);
  return image_scene_to_json(std::get<PictureInput>(input).scene, -1);
}

glm::dvec3 background_of(const StudyInput& input) {
  return std::visit([](const auto& one) { return glm::dvec3(one.scene.render.background); }, input);
}

std::optional<std::size_t> baseline_of(const Study& study, const std::vector<Combination>& all,
                                       const Combination& combination) {
  if (study.timing.baseline.empty())
    return std::nullopt;
  std::vector<Label> wanted = combination.labels;
  for (Label& label : wanted) {
    for (const Label& other : study.timing.baseline) {
      if (label.first == other.first)
        label.second = other.second;
    }
  }
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const Combination& one) { return one.labels == wanted; });
  return found == all.end() ? std::nullopt : std::optional<std::size_t>(found->index);
}

std::string content_name(const std::string& text) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (const char c : text) {
    hash ^= static_cast<unsigned char>(c);
    hash *= 0x100000001b3ULL;
  }
  char name[17];
  std::snprintf(name, sizeof name, "%016llx", static_cast<unsigned long long>(hash));
  return name;
}

} // namespace slicelens
