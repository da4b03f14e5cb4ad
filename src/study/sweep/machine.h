// What a measurement ran on.
#pragma once

#include <cstddef>
#include <string>

namespace slicelens {

struct Machine {
  std::string system;      ///< kernel and its version
  std::string processor;   ///< the model's name
  std::size_t threads = 0; ///< that this process may run on
  std::size_t memory = 0;  ///< bytes
  std::string version;     ///< of Slicelens
  std::string commit;      ///< it was built from; "unknown" outside a checkout, "+" at its end: with changes
  std::string compiler;
};

Machine this_machine();

/// The processes that ran or waited to, over the last minute (/proc/loadavg); negative where not known.
double load_average();

/// The largest resident set of this process since the last call of forget_peak_memory, in bytes (VmHWM of
/// /proc/self/status); 0 where not known.
std::size_t peak_memory();
void forget_peak_memory();

} // namespace slicelens
