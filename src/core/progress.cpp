#include "core/progress.h"

namespace slicelens {

void report_progress(const Progress& progress, const std::string& stage, double done) {
  if (progress.advance)
    progress.advance(stage, done);
}

void report_warning(const Progress& progress, const std::string& message) {
  if (progress.warn)
    progress.warn(message);
}

} // namespace slicelens
