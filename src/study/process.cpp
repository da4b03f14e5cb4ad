#include "study/process.h"

#include "core/errors.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <system_error>

namespace slicelens {

namespace fs = std::filesystem;

ScratchFolder::ScratchFolder() {
  std::error_code error;
  const fs::path base = fs::temp_directory_path(error);
  if (error)
    throw FileError("TMPDIR", "names no folder for temporary files: " + error.message());
  std::string name = (base / "slicelens-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr)
    throw FileError(base.string(), std::string("no temporary folder can be made there: ") +
                                       std::strerror(errno) + "; name another one with TMPDIR");
  path_ = name;
}

ScratchFolder::~ScratchFolder() {
  std::error_code error;
  fs::remove_all(path_, error);
}

namespace {

/// What the child's standard streams are: nothing to read, and a file for each of the other two. Files
/// rather than pipes, because nobody has to read both at once then.
class Streams {
public:
  Streams(const fs::path& out, const fs::path& err) {
    const int write = O_WRONLY | O_CREAT | O_TRUNC;
    ::posix_spawn_file_actions_init(&actions_);
    ::posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    ::posix_spawn_file_actions_addopen(&actions_, STDOUT_FILENO, out.c_str(), write, 0600);
    ::posix_spawn_file_actions_addopen(&actions_, STDERR_FILENO, err.c_str(), write, 0600);
  }
  ~Streams() { ::posix_spawn_file_actions_destroy(&actions_); }
  Streams(const Streams&) = delete;
  Streams& operator=(const Streams&) = delete;

  const posix_spawn_file_actions_t* actions() const { return &actions_; }

private:
  posix_spawn_file_actions_t actions_;
};

} // namespace

std::optional<int> run_program(const std::vector<std::string>& words, const fs::path& out,
                               const fs::path& err) {
  const Streams streams(out, err);
  std::vector<std::string> copies = words;
  std::vector<char*> arguments;
  for (std::string& word : copies)
    arguments.push_back(word.data());
  arguments.push_back(nullptr);
  pid_t child = 0;
  const int refused =
      ::posix_spawnp(&child, arguments[0], streams.actions(), nullptr, arguments.data(), ::environ);
  if (refused == ENOENT)
    return {};
  if (refused != 0)
    throw FileError(words[0], std::string("cannot be started: ") + std::strerror(refused));
  int status = 0;
  while (::waitpid(child, &status, 0) < 0) {
    if (errno != EINTR)
      throw FileError(words[0], std::string("its end was not seen: ") + std::strerror(errno));
  }
  return status;
}

} // namespace slicelens
