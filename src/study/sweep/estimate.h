// How long work that goes step by step will still take.
#pragma once

#include "core/progress.h"
#include "core/stopwatch.h"

#include <cstddef>
#include <set>
#include <string>

namespace slicelens {

/// "2 min 5 s", rounded up.
std::string duration_text(double seconds);

/// Reports the stage "picture 3/60, 2 min left" after every step. `progress` must outlive it.
class Estimate {
public:
  Estimate(const Progress& progress, std::string stage, std::size_t count);
  void step();

private:
  const Progress& progress_;
  std::string stage_;
  std::size_t count_ = 0;
  std::size_t done_ = 0;
  Stopwatch watch_;
};

/// Progress of one step of many: each warning once (`said` keeps them), no stages of its own, which would
/// flicker. Both arguments must outlive the result.
Progress quiet(const Progress& outer, std::set<std::string>& said);

} // namespace slicelens
