#include "study/sweep/quality.h"

#include "core/errors.h"
#include "study/lens_metrics.h"
#include "study/metrics.h"

#include <algorithm>

namespace slicelens {

namespace {

bool is_lens_metric(const std::string& name) {
  const auto& names = lens_metric_names();
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// The one called `name`.
Value value_of(const std::vector<Value>& values, const std::string& name) {
  return *std::find_if(values.begin(), values.end(), [&](const Value& one) { return one.first == name; });
}

} // namespace

void check_metric(const std::string& name, const std::string& path) {
  if (is_lens_metric(name))
    return;
  try {
    validate_metric(name);
  } catch (const UsageError& error) {
    throw UsageError(path + ": " + error.what());
  }
}

bool needs_reference(const std::string& metric) { return !is_lens_metric(metric); }

std::vector<Value> measure_quality(const std::vector<std::string>& metrics, const PreparedScene* prepared,
                                   const Shown& picture, const Shown& reference) {
  std::vector<std::string> of_pictures;
  std::vector<std::string> of_lenses;
  for (const std::string& name : metrics)
    (is_lens_metric(name) ? of_lenses : of_pictures).push_back(name);
  std::vector<Value> measured;
  if (!of_pictures.empty())
    measured =
        measure(of_pictures, *picture.image, *reference.image, picture.background, reference.background);
  if (prepared == nullptr && !of_lenses.empty())
    throw UsageError("metric '" + of_lenses.front() + "' is of lenses in volumes; a picture's lens has none");
  const std::vector<Value> lens =
      of_lenses.empty() ? std::vector<Value>{} : measure_lens(of_lenses, *prepared);
  measured.insert(measured.end(), lens.begin(), lens.end());
  std::vector<Value> values;
  for (const std::string& name : metrics)
    values.push_back(value_of(measured, name));
  return values;
}

} // namespace slicelens
