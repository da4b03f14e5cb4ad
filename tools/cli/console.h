// What the program says on stderr: warnings, and a progress bar on a terminal.
#pragma once

#include "core/progress.h"

namespace slicelens::cli {

/// Warnings as lines "slicelens: warning: …". On a terminal also a bar, shown once work has lasted half a
/// second.
Progress console_progress();

/// Removes the bar before other output.
void end_progress();

} // namespace slicelens::cli
