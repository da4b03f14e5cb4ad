// A program that runs beside this one and answers every line with a line.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace slicelens {

/// A child process without a shell, in a process group of its own. Its standard input and output are one
/// socket (so that writing to a dead child is an error and no signal), its standard error is a file. At the
/// end of this object, and after any failure, it and its own children are gone: it sees the end of its input,
/// after two seconds SIGTERM, after two more SIGKILL. Move-only.
class LineProcess {
public:
  /// Starts `program` (a path, not looked for in PATH). Throws FileError when it does not exist, is not
  /// executable, or its interpreter is missing.
  LineProcess(const std::filesystem::path& program, const std::vector<std::string>& arguments);
  ~LineProcess();
  LineProcess(LineProcess&& other) noexcept;
  LineProcess& operator=(LineProcess&& other) noexcept;
  LineProcess(const LineProcess&) = delete;
  LineProcess& operator=(const LineProcess&) = delete;

  /// Sends one line (`line` without its end, at most 64 KiB) and returns the line that answers it. Throws
  /// FileError when the child has ended (with its status and the last line of its standard error), gives no
  /// whole line within `limit` seconds, or answers more than one line or more than 1 MiB; the child is then
  /// ended, and every further call throws.
  std::string ask(const std::string& line, double limit);

  /// Ends the child because of what it answered, and throws FileError with `reason`.
  [[noreturn]] void fail(const std::string& reason);

  const std::string& name() const { return name_; } ///< the program, for messages

private:
  enum class Patience { for_its_end, none };
  void close_files();
  void stop(Patience patience);
  bool ends_within(double seconds) const;
  [[noreturn]] void report_end();

  std::string name_;
  pid_t child_ = -1; ///< −1: ended
  int socket_ = -1;
  int errors_ = -1; ///< its standard error: a file without a name, which nobody has to remove
};

} // namespace slicelens
