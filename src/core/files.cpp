#include "core/files.h"

#include "core/errors.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>
#include <system_error>

namespace slicelens {

namespace fs = std::filesystem;

void write_atomically(const fs::path& path, const std::function<void(const fs::path&)>& write) {
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  std::error_code error;
  if (!fs::is_directory(folder, error)) {
    throw FileError(path.string(), "the folder " + folder.string() + " does not exist; create it first");
  }
  if (fs::is_directory(path, error))
    throw FileError(path.string(), "is a folder; give a file name to write");
  if (::access(folder.c_str(), W_OK) != 0) {
    throw FileError(path.string(), "the folder " + folder.string() + " is not writable");
  }
  const fs::path temporary = folder / ("." + path.stem().string() + "." + std::to_string(::getpid()) +
                                       ".part" + path.extension().string());
  // Made empty first: writers of other libraries say less clearly that they cannot.
  if (std::ofstream probe(temporary, std::ios::binary); !probe) {
    throw FileError(path.string(), "cannot be written in " + folder.string() + ": " + std::strerror(errno));
  }
  try {
    write(temporary);
    fs::rename(temporary, path, error);
    if (error)
      throw FileError(path.string(), "cannot be put in place: " + error.message());
  } catch (...) {
    fs::remove(temporary, error);
    throw;
  }
}

void write_text_atomically(const fs::path& path, const std::string& text) {
  write_atomically(path, [&](const fs::path& temporary) {
    std::ofstream out(temporary, std::ios::binary);
    out << text;
    out.close();
    if (!out)
      throw FileError(path.string(), std::string("cannot be written: ") + std::strerror(errno));
  });
}

std::string read_text(const fs::path& path, std::size_t limit) {
  std::error_code error;
  if (fs::is_directory(path, error))
    throw FileError(path.string(), "is a folder; a file is needed here");
  std::ifstream in(path, std::ios::binary);
  if (!in)
    throw FileError(path.string(), std::string("cannot be opened: ") + std::strerror(errno));
  std::string text;
  char buffer[1 << 16];
  while (in.read(buffer, sizeof buffer) || in.gcount() > 0) {
    text.append(buffer, static_cast<std::size_t>(in.gcount()));
    if (text.size() > limit) {
      throw FileError(path.string(),
                      "is larger than " + std::to_string(limit) + " bytes, too large for this kind of file");
    }
  }
  if (in.bad())
    throw FileError(path.string(), std::string("cannot be read: ") + std::strerror(errno));
  return text;
}

fs::path find_module(const std::string& name) {
  const std::string file = "lib" + name + ".so";
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error).parent_path();
  const fs::path places[] = {program, program / SLICELENS_MODULES_FROM_PROGRAM,
                             fs::path(SLICELENS_BUILD_DIR)};
  std::string looked;
  for (const fs::path& place : places) {
    if (fs::exists(place / file, error))
      return place / file;
    looked += (looked.empty() ? "" : ", ") + place.string();
  }
  throw FileError(file, "not found in " + looked + "; install Slicelens again");
}

} // namespace slicelens
