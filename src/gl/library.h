// A shared library opened at run time, so that the program needs none of them to start.
#pragma once

#include "core/errors.h"

#include <string>
#include <vector>

namespace slicelens::gl {

/// Opened with local symbols, and never closed: GL drivers leave threads and exit handlers behind that crash
/// once their code is unmapped. Opening the same library again gives the same one.
class Library {
public:
  /// Tries the names in turn ("libOSMesa.so.8"). Throws GraphicsError with the loader's reason for the first.
  explicit Library(const std::vector<std::string>& names);

  /// Address of a symbol, or null.
  void* find(const char* symbol) const;

  /// The function of that name. Throws GraphicsError naming library and function.
  template <class Function>
  Function function(const char* symbol) const {
    void* address = find(symbol);
    if (address == nullptr)
      throw GraphicsError(name_ + " lacks " + symbol);
    return reinterpret_cast<Function>(address);
  }

private:
  void* library_ = nullptr;
  std::string name_;
};

} // namespace slicelens::gl
