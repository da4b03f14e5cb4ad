// Runs the program slicelens as its users do: a process of its own, in a folder of its own.
#pragma once

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace fs = std::filesystem;

inline std::string contents(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

inline void put(const fs::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

/// What a run left behind.
struct Outcome {
  int status = -1; ///< exit status, or 1000 + the signal that ended it
  std::string out;
  std::string err;
};

/// A folder that the program runs in, removed at the end.
class Workplace {
public:
  Workplace() {
    std::string name =
        (fs::temp_directory_path() / "slicelens tools XXXXXX").string(); // with spaces: users have
    if (::mkdtemp(name.data()) == nullptr)
      throw std::runtime_error("no temporary folder");
    base_ = name;
    folder_ = base_ / "work";
    fs::create_directories(folder_);
  }
  ~Workplace() {
    std::error_code error;
    fs::permissions(folder_, fs::perms::owner_all, fs::perm_options::add, error);
    fs::remove_all(base_, error);
  }
  Workplace(const Workplace&) = delete;
  Workplace& operator=(const Workplace&) = delete;

  const fs::path& folder() const { return folder_; }
  fs::path operator/(const std::string& name) const { return folder_ / name; }

  /// Runs `slicelens arguments…` in folder(). Its stdout goes to `out_device` where one is named ("-" closes
  /// it).
  Outcome run(const std::vector<std::string>& arguments, const std::string& out_device = "") const {
    const fs::path out = base_ / "out";
    const fs::path err = base_ / "err";
    const pid_t child = ::fork();
    if (child < 0)
      throw std::runtime_error("fork failed");
    if (child == 0)
      start(arguments, out_device.empty() ? out.string() : out_device, err.string());
    int status = 0;
    ::waitpid(child, &status, 0);
    Outcome outcome;
    outcome.status = WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
    if (out_device.empty())
      outcome.out = contents(out);
    outcome.err = contents(err);
    return outcome;
  }

  /// Names of everything in folder(), hidden files as well, sorted.
  std::vector<std::string> entries() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_))
      names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
  }

private:
  [[noreturn]] void start(const std::vector<std::string>& arguments, const std::string& out,
                          const std::string& err) const {
    const auto redirect = [](const std::string& path, int stream) {
      const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
      if (file < 0 || ::dup2(file, stream) < 0)
        ::_exit(126);
    };
    redirect(err, STDERR_FILENO);
    if (out == "-")
      ::close(STDOUT_FILENO);
    else
      redirect(out, STDOUT_FILENO);
    std::vector<char*> words;
    std::string program = SLICELENS_PROGRAM;
    words.push_back(program.data());
    std::vector<std::string> copies = arguments;
    for (std::string& argument : copies)
      words.push_back(argument.data());
    words.push_back(nullptr);
    if (::chdir(folder_.c_str()) == 0)
      ::execv(program.c_str(), words.data());
    ::_exit(127);
  }

  fs::path base_;
  fs::path folder_;
};

/// A scene small enough that a picture of it takes no time.
inline const char* const small_scene =
    R"({"title": "small", "volume": {"phantom": "blob", "size": [12, 12, 12]}, "render": {"size": [24, 20]}})";
