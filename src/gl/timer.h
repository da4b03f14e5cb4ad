// Time that the driver itself spends on drawing.
#pragma once

#include "gl/handle.h"

#include <cstdint>
#include <optional>

namespace slicelens::gl {

/// Measures the commands between begin() and end() with GL_TIME_ELAPSED. Only one may run at a time in a
/// context. Software rasterisers defer work: call finish before end() to have all of it counted.
class TimerQuery {
public:
  /// Throws GraphicsError when the driver gives no query.
  explicit TimerQuery(const Functions& gl);

  void begin();
  void end();
  /// Whether result_nanoseconds would return without waiting.
  bool available() const;
  /// Nanoseconds between begin and end; waits for the commands to finish. Nothing when the driver's timer has
  /// zero bits (Limits::timer_query_bits).
  std::optional<std::uint64_t> result_nanoseconds() const;

private:
  const Functions* gl_;
  Query query_;
  bool counts_ = false;
};

/// Waits until all commands given so far are done.
void finish(const Functions& gl);

} // namespace slicelens::gl
