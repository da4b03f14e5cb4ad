// Every combination of what a study varies, and the scenes that follow from it.
#pragma once

#include "scene/image_scene.h"
#include "study/inputs.h"
#include "study/sweep/study.h"

#include <glm/glm.hpp>

#include <variant>

namespace slicelens {

/// A 2D scene (`slicelens lens`) and where its relative paths count from.
struct PictureInput {
  ImageScene scene;
  std::vector<std::filesystem::path> folders;
  std::string source;
};

/// What is drawn: a volume's scene or a picture's.
using StudyInput = std::variant<SceneInput, PictureInput>;

struct Combination {
  std::size_t index = 0; ///< counted from 0 in the study's order: the last axis changes fastest
  std::vector<Label> labels;
  std::size_t scene = 0;           ///< of Study::scenes
  std::vector<KeyValue> changes;   ///< all of them: the study's, then those of its axes
  std::optional<std::string> peer; ///< "gpu" or "cpu": drawn by VTK (render.pipeline vtk-gpu, vtk-cpu)
};

/// All of them. Throws LimitError beyond a million.
std::vector<Combination> combinations_of(const Study& study);

bool holds(const Condition& condition, const std::vector<Label>& labels);

/// "render.spacing 0.5, proxy planes"
std::string label_text(const std::vector<Label>& labels);

/// The combination's scene, its folders and its name in messages. Throws UsageError where keys do not go
/// together.
SceneInput scene_of(const Study& study, const Combination& combination);

/// The same for studies of either kind.
StudyInput input_of(const Study& study, const Combination& combination);

/// The scene that its picture is compared with, or nothing. Throws as scene_of does.
std::optional<StudyInput> reference_of(const Study& study, const Combination& combination);

/// The whole scene on one line.
std::string scene_text_of(const StudyInput& input);

/// What its picture lies over, without opacity.
glm::dvec3 background_of(const StudyInput& input);

/// The index of the combination that differs only in what timing.baseline says, or nothing where there is
/// none.
std::optional<std::size_t> baseline_of(const Study& study, const std::vector<Combination>& all,
                                       const Combination& combination);

/// 16 hexadecimal digits that name a text (FNV-1a of 64 bits): not for secrets, only for file names and for
/// recognising what has been measured.
std::string content_name(const std::string& text);

} // namespace slicelens
