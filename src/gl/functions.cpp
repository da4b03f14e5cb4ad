#include "gl/functions.h"

#include "core/errors.h"

#include <cstddef>
#include <cstring>

namespace slicelens::gl {
namespace {

struct Entry {
  const char* name;
  std::size_t offset;
  int version;
};

// Offsets instead of thousand assignments: one loop fills the table, and one lists what is missing.
constexpr Entry entries[] = {
#define SLICELENS_GL_FUNCTION(version, name, type) {"gl" #name, offsetof(Functions, name), version},
#include <gl_function_list.inc>
#undef SLICELENS_GL_FUNCTION
};

static_assert(sizeof(AnyFunction) == sizeof(PFNGLCLEARPROC));

constexpr int oldest_version = 33;

int current_version(const GetProcAddress& address) {
  const auto get_string = reinterpret_cast<PFNGLGETSTRINGPROC>(address("glGetString"));
  const auto get_integer = reinterpret_cast<PFNGLGETINTEGERVPROC>(address("glGetIntegerv"));
  if (get_string == nullptr || get_integer == nullptr)
    throw GraphicsError("the OpenGL library lacks glGetString or glGetIntegerv");
  // A missing version string means that no context is current; asking it for numbers could crash.
  const GLubyte* text = get_string(GL_VERSION);
  if (text == nullptr)
    throw GraphicsError("no OpenGL context is current");
  GLint major = 0;
  GLint minor = 0;
  get_integer(GL_MAJOR_VERSION, &major);
  get_integer(GL_MINOR_VERSION, &minor);
  const int version = 10 * major + minor;
  if (version < oldest_version)
    throw GraphicsError("the driver offers OpenGL \"" + std::string(reinterpret_cast<const char*>(text)) +
                        "\"; 3.3 or later is needed");
  return version;
}

} // namespace

Functions load_functions(const GetProcAddress& address) {
  const int version = current_version(address);
  Functions functions;
  auto* table = reinterpret_cast<unsigned char*>(&functions);
  for (const Entry& entry : entries) {
    if (entry.version > version)
      continue;
    const AnyFunction function = address(entry.name);
    if (function == nullptr && entry.version <= oldest_version)
      throw GraphicsError(std::string("the driver lacks ") + entry.name + ", which OpenGL 3.3 requires");
    std::memcpy(table + entry.offset, &function, sizeof function);
  }
  return functions;
}

std::vector<std::string> missing_functions(const Functions& gl, int version) {
  std::vector<std::string> missing;
  const auto* table = reinterpret_cast<const unsigned char*>(&gl);
  for (const Entry& entry : entries) {
    AnyFunction function = nullptr;
    std::memcpy(&function, table + entry.offset, sizeof function);
    if (entry.version == version && function == nullptr)
      missing.emplace_back(entry.name);
  }
  return missing;
}

} // namespace slicelens::gl
