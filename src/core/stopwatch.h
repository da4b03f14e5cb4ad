// Wall clock for the phases of work.
#pragma once

#include <chrono>

namespace slicelens {

/// Starts when it is made.
class Stopwatch {
public:
  /// Seconds since the last lap, or since the start.
  double lap() {
    const Clock::time_point now = Clock::now();
    const double seconds = std::chrono::duration<double>(now - mark_).count();
    mark_ = now;
    return seconds;
  }

  /// The same without beginning another lap.
  double seconds() const { return std::chrono::duration<double>(Clock::now() - mark_).count(); }

private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point mark_ = Clock::now();
};

} // namespace slicelens
