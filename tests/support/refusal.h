// What a call refuses.
#pragma once

#include "core/errors.h"

#include <functional>
#include <string>

/// The text of the UsageError that `call` throws, or an empty text.
inline std::string refusal(const std::function<void()>& call) {
  try {
    call();
  } catch (const slicelens::UsageError& error) {
    return error.what();
  }
  return {};
}
