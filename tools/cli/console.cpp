#include "console.h"

#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <memory>

namespace slicelens::cli {

namespace {

using Clock = std::chrono::steady_clock;

struct Bar {
  Clock::time_point start = Clock::now();
  Clock::time_point shown{};
};

void draw_bar(Bar& bar, const std::string& stage, double done) {
  const auto now = Clock::now();
  if (now - bar.start < std::chrono::milliseconds(500))
    return;
  if (now - bar.shown < std::chrono::milliseconds(100) && done < 1)
    return;
  bar.shown = now;
  constexpr int width = 30;
  const int full = static_cast<int>(done * width + 0.5);
  std::fprintf(stderr, "\r\033[K%-8s [%.*s%.*s] %3.0f %%", stage.c_str(), full,
               "##############################", width - full, "..............................", done * 100);
  std::fflush(stderr);
}

} // namespace

Progress console_progress() {
  Progress progress;
  progress.warn = [](const std::string& message) {
    end_progress();
    std::fprintf(stderr, "slicelens: warning: %s\n", message.c_str());
  };
  if (::isatty(STDERR_FILENO) != 0) {
    auto bar = std::make_shared<Bar>();
    progress.advance = [bar](const std::string& stage, double done) { draw_bar(*bar, stage, done); };
  }
  return progress;
}

void end_progress() {
  if (::isatty(STDERR_FILENO) != 0)
    std::fprintf(stderr, "\r\033[K");
}

} // namespace slicelens::cli
