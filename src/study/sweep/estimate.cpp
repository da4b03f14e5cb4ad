#include "study/sweep/estimate.h"

#include <cmath>
#include <utility>

namespace slicelens {

std::string duration_text(double seconds) {
  const long all = std::lround(std::ceil(seconds));
  if (all < 60)
    return std::to_string(all) + " s";
  if (all < 3600)
    return std::to_string(all / 60) + " min " + std::to_string(all % 60) + " s";
  return std::to_string(all / 3600) + " h " + std::to_string(all % 3600 / 60) + " min";
}

Estimate::Estimate(const Progress& progress, std::string stage, std::size_t count)
    : progress_(progress), stage_(std::move(stage)), count_(count) {}

void Estimate::step() {
  ++done_;
  const double passed = watch_.seconds();
  const auto done = static_cast<double>(done_);
  std::string text = stage_ + " " + std::to_string(done_) + "/" + std::to_string(count_);
  if (done_ < count_)
    text += ", " + duration_text(passed / done * static_cast<double>(count_ - done_)) + " left";
  report_progress(progress_, text, done / static_cast<double>(count_));
}

Progress quiet(const Progress& outer, std::set<std::string>& said) {
  Progress progress;
  progress.warn = [&outer, &said](const std::string& message) {
    if (said.insert(message).second)
      report_warning(outer, message);
  };
  return progress;
}

} // namespace slicelens
