// The context that tests draw in.
#pragma once

#include "core/errors.h"
#include "gl/context.h"

#include <cstdlib>
#include <string>

/// Opens the kind that $SLICELENS_TEST_CONTEXT names, else OSMesa, and makes it current. A kind that cannot
/// be opened is an error, not a skip: tests of the renderer need a context.
inline slicelens::gl::Context test_context(slicelens::gl::Profile profile = slicelens::gl::Profile::core) {
  const char* named = std::getenv("SLICELENS_TEST_CONTEXT");
  const std::string name = named != nullptr ? named : "osmesa";
  const auto kind = slicelens::gl::context_kind(name);
  if (!kind)
    throw slicelens::UsageError("SLICELENS_TEST_CONTEXT is '" + name + "'; osmesa, egl and window are known");
  return slicelens::gl::open_context(*kind, profile);
}

/// Whether the environment asks for Mesa's softpipe, for tests whose expectation depends on the driver.
inline bool softpipe_requested() {
  const char* driver = std::getenv("GALLIUM_DRIVER");
  return driver != nullptr && std::string(driver) == "softpipe";
}
