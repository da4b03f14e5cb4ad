#include "study/gnuplot.h"

#include "core/errors.h"
#include "core/files.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <sstream>
#include <system_error>

namespace slicelens {

namespace {

namespace fs = std::filesystem;

/// A private folder that is removed at the end.
class TemporaryFolder {
public:
  TemporaryFolder() {
    std::error_code error;
    const fs::path base = fs::temp_directory_path(error);
    if (error)
      throw FileError("TMPDIR", "names no folder for temporary files: " + error.message());
    std::string name = (base / "slicelens-plot-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr)
      throw FileError(base.string(), std::string("no temporary folder can be made there: ") +
                                         std::strerror(errno) + "; name another one with TMPDIR");
    path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code error;
    fs::remove_all(path_, error);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  fs::path operator/(const char* name) const { return path_ / name; }

private:
  fs::path path_;
};

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

/// Runs `gnuplot -d script` and returns its wait status.
int run(const std::string& script, const Streams& streams) {
  std::string words[] = {"gnuplot", "-d", script};
  char* const arguments[] = {words[0].data(), words[1].data(), words[2].data(), nullptr};
  pid_t child = 0;
  const int refused = ::posix_spawnp(&child, arguments[0], streams.actions(), nullptr, arguments, ::environ);
  if (refused == ENOENT)
    throw FileError("gnuplot", "is not installed, and it draws the plots; apt-get install gnuplot-nox");
  if (refused != 0)
    throw FileError("gnuplot", std::string("cannot be started: ") + std::strerror(refused));
  int status = 0;
  while (::waitpid(child, &status, 0) < 0) {
    if (errno != EINTR)
      throw FileError("gnuplot", std::string("its end was not seen: ") + std::strerror(errno));
  }
  return status;
}

/// gnuplot repeats the command with a mark under it and then says `"script" line 3: what is wrong`.
std::string first_error(const std::string& errors, const std::string& script) {
  const std::string place = "\"" + script + "\" ";
  std::istringstream lines(errors);
  std::string first;
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind(place, 0) == 0)
      return line.substr(place.size());
    if (first.empty() && line.find_first_not_of(" \t^") != std::string::npos)
      first = line;
  }
  return first.empty() ? "no reason given" : first;
}

} // namespace

std::string run_gnuplot(const std::string& script) {
  const TemporaryFolder folder;
  const fs::path file = folder / "plot.gp";
  write_text_atomically(file, script);
  const Streams streams(folder / "out", folder / "err");
  const int status = run(file.string(), streams);
  const std::string errors = first_error(read_text(folder / "err"), file.string());
  if (WIFSIGNALED(status))
    throw FileError("gnuplot", "was ended by signal " + std::to_string(WTERMSIG(status)) + ": " + errors);
  if (WEXITSTATUS(status) != 0)
    throw FileError("gnuplot", "failed: " + errors);
  std::string bytes = read_text(folder / "out", std::size_t{1} << 30);
  if (bytes.empty())
    throw FileError("gnuplot", "wrote nothing: " + errors);
  return bytes;
}

} // namespace slicelens
