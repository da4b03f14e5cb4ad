// Catch2 2.13 and 3.x under one name.
#pragma once

#if __has_include(<catch2/catch_all.hpp>)
#include <catch2/catch_all.hpp>
using Catch::Approx;
#else
#include <catch2/catch.hpp>
#endif

#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <string>

/// Ends a test case as skipped: ctest sees the line and counts it as skipped, never as passed.
#define SLICELENS_SKIP(reason)                                                                               \
  do {                                                                                                       \
    std::cout << "SKIPPED: " << (reason) << std::endl;                                                       \
    return;                                                                                                  \
  } while (false)

/// The folder of real volumes for tests ($SLICELENS_VOLUMES, else ../shared/volumes beside the checkout), or
/// an empty path where there is none: the test then skips and says so.
inline std::filesystem::path real_volumes() {
  const char* named = std::getenv("SLICELENS_VOLUMES");
  const std::filesystem::path folder =
      named != nullptr ? std::filesystem::path(named)
                       : std::filesystem::path(SLICELENS_SOURCE_DIR) / ".." / "shared" / "volumes";
  std::error_code error;
  return std::filesystem::is_directory(folder, error) ? folder : std::filesystem::path();
}
