// The part of a study file that says what varies. For the readers of this folder only.
#pragma once

#include "study/sweep/study.h"
#include "study/sweep/study_json.h"

namespace slicelens::study_json {

/// The values that `json` lists, or that a range stands for: {"from", "to"} with "step", "factor", or "count"
/// and "scale" (linear, log). Throws UsageError for none, for ranges that do not end or have more than 100
/// 000 values, and for what is no list.
std::vector<Json> values_of(const Json& json, const std::string& path);

/// `vary`: an object of keys that are crossed, or a list of axes: objects of keys that go together, or
/// {"name", "cases"}. `scenes` are the names that a case may take with "scene".
std::vector<SweepAxis> axes_of(const Json& json, const std::string& path,
                               const std::vector<BaseScene>& scenes);

/// {"render.spacing": 0.5, …} as changes.
std::vector<KeyValue> changes_of(const Json& json, const std::string& path);

} // namespace slicelens::study_json
