// Running other programs without a shell.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace slicelens {

/// A private folder under the system's one for temporary files (TMPDIR), removed at the end.
class ScratchFolder {
public:
  /// Throws FileError when it cannot be made.
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  std::filesystem::path operator/(const char* name) const { return path_ / name; }

private:
  std::filesystem::path path_;
};

/// Runs `words[0]`, found through PATH, with the other words as its arguments and waits for its end. It has
/// nothing to read; what it prints goes to the files `out` and `err`. Returns its wait status, or nothing
/// when it is not installed. Throws FileError when it cannot be started.
std::optional<int> run_program(const std::vector<std::string>& words, const std::filesystem::path& out,
                               const std::filesystem::path& err);

} // namespace slicelens
