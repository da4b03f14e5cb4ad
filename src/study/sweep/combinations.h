// Every combination of what a study varies, and the scenes that follow from it.
#pragma once

#include "study/inputs.h"
#include "study/sweep/study.h"

namespace slicelens {

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

/// The scene that its picture is compared with, or nothing. Throws as scene_of does.
std::optional<SceneInput> reference_of(const Study& study, const Combination& combination);

/// The index of the combination that differs only in what timing.baseline says, or nothing where there is
/// none.
std::optional<std::size_t> baseline_of(const Study& study, const std::vector<Combination>& all,
                                       const Combination& combination);

/// 16 hexadecimal digits that name a text (FNV-1a of 64 bits): not for secrets, only for file names and for
/// recognising what has been measured.
std::string content_name(const std::string& text);

} // namespace slicelens
