// Progress and warnings travel from the libraries to tools/ through one value; nothing below tools/ prints.
#pragma once

#include <functional>
#include <string>

namespace slicelens {

/// What long work tells its caller. Both functions may be empty. They are called from the calling thread, or
/// from one thread at a time.
struct Progress {
  /// `stage` names the work ("load", "draw"); `done` is in [0,1].
  std::function<void(const std::string& stage, double done)> advance;
  /// One line without newline; the work goes on.
  std::function<void(const std::string& message)> warn;
};

void report_progress(const Progress& progress, const std::string& stage, double done);
void report_warning(const Progress& progress, const std::string& message);

} // namespace slicelens
