#include "study/sweep/machine.h"

#include "study/commit.h"

#include <sched.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <fstream>

namespace slicelens {

namespace {

std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  std::string line;
  while (std::getline(file, line)) {
    const std::size_t colon = line.find(": ");
    if (line.rfind("model name", 0) == 0 && colon != std::string::npos)
      return line.substr(colon + 2);
  }
  return "unknown";
}

std::size_t threads() {
  cpu_set_t set;
  CPU_ZERO(&set);
  if (::sched_getaffinity(0, sizeof set, &set) != 0)
    return 0;
  return static_cast<std::size_t>(CPU_COUNT(&set));
}

} // namespace

Machine this_machine() {
  Machine machine;
  struct utsname name {};
  if (::uname(&name) == 0)
    machine.system = std::string(name.sysname) + " " + name.release + " " + name.machine;
  machine.processor = processor_name();
  machine.threads = threads();
  const long pages = ::sysconf(_SC_PHYS_PAGES);
  const long page = ::sysconf(_SC_PAGE_SIZE);
  if (pages > 0 && page > 0)
    machine.memory = static_cast<std::size_t>(pages) * static_cast<std::size_t>(page);
  machine.version = SLICELENS_VERSION;
  machine.commit = SLICELENS_COMMIT;
#if defined(__clang__)
  machine.compiler = "clang " __clang_version__;
#else
  machine.compiler = "gcc " __VERSION__;
#endif
  return machine;
}

double load_average() {
  std::ifstream file("/proc/loadavg");
  double load = -1;
  return file >> load ? load : -1;
}

std::size_t peak_memory() {
  std::ifstream file("/proc/self/status");
  std::string word;
  while (file >> word) {
    std::size_t kibibytes = 0;
    if (word == "VmHWM:" && file >> kibibytes)
      return kibibytes * 1024;
  }
  return 0;
}

void forget_peak_memory() {
  std::ofstream file("/proc/self/clear_refs");
  file << "5"; // proc(5): resets the peak resident set size
}

} // namespace slicelens
