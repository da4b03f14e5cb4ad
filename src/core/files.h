// Writing without half-written files, and finding what belongs to the program.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace slicelens {

/// Calls `write` with a temporary path beside `path` (same folder, same extension) and renames the result
/// onto `path`. When `write` throws, the temporary file is removed, an old file at `path` is untouched, and
/// the exception goes on. Throws FileError when the folder does not exist or is not writable.
void write_atomically(const std::filesystem::path& path,
                      const std::function<void(const std::filesystem::path& temporary)>& write);

/// The same for a text. Throws FileError when it cannot be written in full (a full disk, for instance).
void write_text_atomically(const std::filesystem::path& path, const std::string& text);

/// The whole file as text. Throws FileError when it cannot be read or is larger than `limit` bytes.
std::string read_text(const std::filesystem::path& path, std::size_t limit = std::size_t{64} << 20);

/// A loadable module of the program (for instance "slicelens_codec"): beside the executable, in the installed
/// library folder next to it, or in the build tree. Throws FileError naming the places looked at.
std::filesystem::path find_module(const std::string& name);

} // namespace slicelens
