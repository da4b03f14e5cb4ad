// What every fuzz target shares: a place for its files, and what an answer may be. A target hands bytes to a
// reader, which must give a value or throw one of the errors of core/errors.h with one line; anything else
// (another exception, a report of the sanitizers, a time-out, more memory than a file of this size can ask
// for) is a finding.
#pragma once

#include "core/errors.h"

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace slicelens::fuzz {

/// A folder for this process in memory where there is one, removed at exit.
inline const std::filesystem::path& folder() {
  static const std::filesystem::path path = [] {
    const std::filesystem::path shared = "/dev/shm";
    const bool in_memory = std::filesystem::exists(shared);
    std::string name =
        ((in_memory ? shared : std::filesystem::temp_directory_path()) / "slicelens_fuzz_XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr)
      std::abort();
    static const std::string made = name;
    std::atexit([] {
      std::error_code error;
      std::filesystem::remove_all(made, error);
    });
    return std::filesystem::path(name);
  }();
  return path;
}

inline std::filesystem::path write(const std::string& name, const std::string& bytes) {
  const std::filesystem::path path = folder() / name;
  std::ofstream(path, std::ios::binary) << bytes;
  return path;
}

/// Runs `read`; an Error must be one line of a length that a terminal shows.
template <class Read>
int one_line_or_value(const Read& read) {
  try {
    read();
  } catch (const Error& error) {
    const std::string text = error.what();
    if (text.empty() || text.size() > 4000 || text.find('\n') != std::string::npos) {
      std::fprintf(stderr, "not one line: '%s'\n", text.c_str());
      std::abort();
    }
  }
  return 0;
}

inline std::string text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

} // namespace slicelens::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
