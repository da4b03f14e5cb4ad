#include "gl/library.h"

#include <dlfcn.h>

namespace slicelens::gl {

Library::Library(const std::vector<std::string>& names) {
  std::string reason;
  for (const std::string& name : names) {
    library_ = dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (library_ != nullptr) {
      name_ = name;
      return;
    }
    const char* error = dlerror();
    if (reason.empty())
      reason = error != nullptr ? error : name + " cannot be opened";
  }
  throw GraphicsError(reason);
}

void* Library::find(const char* symbol) const { return dlsym(library_, symbol); }

} // namespace slicelens::gl
