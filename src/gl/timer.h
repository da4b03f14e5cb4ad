// Time that the driver itself spends on drawing.
#pragma once

#include "gl/handle.h"

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>

namespace slicelens::gl {

/// Measures the commands between begin() and end() with GL_TIME_ELAPSED. Only one may run at a time in a
/// context.
///
/// Trust it on hardware and on softpipe. Mesa's llvmpipe (22.3, measured) reports 0.2 to 0.5 of the time that
/// passes, because its threads' times are not joined, and the machine's uptime for the first query of a
/// process: measure there with elapsed_seconds.
class TimerQuery {
public:
  /// Throws GraphicsError when the driver gives no query.
  explicit TimerQuery(const Functions& gl);

  void begin();
  void end();
  /// Whether result_nanoseconds would return without waiting.
  bool available() const;
  /// Nanoseconds between begin and end; waits for the commands to finish. Nothing when the driver's timer has
  /// zero bits (Limits::timer_query_bits), or claims more time than has passed since begin().
  std::optional<std::uint64_t> result_nanoseconds() const;

private:
  const Functions* gl_;
  Query query_;
  bool counts_ = false;
  std::chrono::steady_clock::time_point begun_;
};

/// Waits until all commands given so far are done.
void finish(const Functions& gl);

/// Wall-clock seconds that `work` takes, from an idle driver until all its commands are done.
double elapsed_seconds(const Functions& gl, const std::function<void()>& work);

/// Fragments that `work` hands to blending (GL_SAMPLES_PASSED).
std::uint64_t samples_passed(const Functions& gl, const std::function<void()>& work);

} // namespace slicelens::gl
