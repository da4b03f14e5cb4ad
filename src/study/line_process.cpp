#include "study/line_process.h"

#include "core/errors.h"
#include "core/text.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <sstream>
#include <thread>
#include <utility>

namespace slicelens {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr std::size_t longest_answer = std::size_t{1} << 20;
constexpr double grace = 2; ///< seconds between one way of ending a child and the next

/// How the child is started: its streams, and a process group of its own.
class SpawnSettings {
public:
  SpawnSettings(int socket, int errors) {
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawn_file_actions_adddup2(&actions, socket, STDIN_FILENO);
    ::posix_spawn_file_actions_adddup2(&actions, socket, STDOUT_FILENO);
    ::posix_spawn_file_actions_adddup2(&actions, errors, STDERR_FILENO);
    ::posix_spawnattr_init(&attributes);
    ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    ::posix_spawnattr_setpgroup(&attributes, 0);
  }
  ~SpawnSettings() {
    ::posix_spawn_file_actions_destroy(&actions);
    ::posix_spawnattr_destroy(&attributes);
  }
  SpawnSettings(const SpawnSettings&) = delete;
  SpawnSettings& operator=(const SpawnSettings&) = delete;

  posix_spawn_file_actions_t actions;
  posix_spawnattr_t attributes;
};

/// A file without a name, or −1.
int open_nameless_file() {
  std::FILE* file = std::tmpfile();
  if (file == nullptr)
    return -1;
  const int number = ::fcntl(::fileno(file), F_DUPFD_CLOEXEC, 3);
  std::fclose(file);
  return number;
}

/// Without the sequences that colour a terminal's text (ECMA-48 §8.3.117: ESC [ … m).
std::string without_colors(const std::string& line) {
  std::string plain;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const std::size_t end = line.compare(i, 2, "\x1b[") == 0 ? line.find('m', i) : std::string::npos;
    if (end != std::string::npos)
      i = end;
    else
      plain += line[i];
  }
  return plain;
}

/// The last line with anything on it, of the last 8 KiB.
std::string last_line(int file) {
  char buffer[8192];
  const off_t size = ::lseek(file, 0, SEEK_END);
  const ssize_t count = ::pread(file, buffer, sizeof buffer, std::max<off_t>(0, size - 8192));
  std::istringstream in(std::string(buffer, static_cast<std::size_t>(std::max<ssize_t>(0, count))));
  std::string last;
  for (std::string line; std::getline(in, line);) {
    const std::string plain = without_colors(line);
    if (plain.find_first_not_of(" \t\r") != std::string::npos)
      last = plain;
  }
  return last;
}

std::string why_not_started(int error, const fs::path& program) {
  std::error_code ignored;
  if (error == ENOENT && fs::exists(program, ignored))
    return "cannot be started: the program that its first line names is not installed";
  return std::string("cannot be started: ") + std::strerror(error);
}

} // namespace

LineProcess::LineProcess(const fs::path& program, const std::vector<std::string>& arguments)
    : name_(program.string()), errors_(open_nameless_file()) {
  int ends[2] = {-1, -1};
  if (errors_ < 0 || ::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) {
    const std::string why = std::strerror(errno);
    close_files();
    throw FileError(name_, "cannot be started: no file or socket for it: " + why);
  }
  socket_ = ends[0];
  const SpawnSettings settings(ends[1], errors_);
  std::vector<std::string> words = {name_};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& text : words)
    pointers.push_back(text.data());
  pointers.push_back(nullptr);
  const int refused = ::posix_spawn(&child_, name_.c_str(), &settings.actions, &settings.attributes,
                                    pointers.data(), ::environ);
  ::close(ends[1]);
  if (refused != 0) {
    child_ = -1;
    close_files();
    throw FileError(name_, why_not_started(refused, program));
  }
}

LineProcess::~LineProcess() { stop(Patience::for_its_end); }

LineProcess::LineProcess(LineProcess&& other) noexcept
    : name_(other.name_), child_(std::exchange(other.child_, -1)), socket_(std::exchange(other.socket_, -1)),
      errors_(std::exchange(other.errors_, -1)) {}

LineProcess& LineProcess::operator=(LineProcess&& other) noexcept {
  if (this != &other) {
    stop(Patience::for_its_end);
    name_ = other.name_; // which goes on saying what has ended
    child_ = std::exchange(other.child_, -1);
    socket_ = std::exchange(other.socket_, -1);
    errors_ = std::exchange(other.errors_, -1);
  }
  return *this;
}

/// Leaves the child to be waited for, so that its number, which is also its group's, stays its own.
bool LineProcess::ends_within(double seconds) const {
  const auto deadline = Clock::now() + std::chrono::duration<double>(seconds);
  for (;;) {
    siginfo_t info{};
    const int waited = ::waitid(P_PID, static_cast<id_t>(child_), &info, WEXITED | WNOHANG | WNOWAIT);
    if ((waited == 0 && info.si_pid == child_) || (waited != 0 && errno != EINTR))
      return true;
    if (Clock::now() >= deadline)
      return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

void LineProcess::close_files() {
  for (int* file : {&socket_, &errors_}) {
    if (*file >= 0)
      ::close(std::exchange(*file, -1));
  }
}

void LineProcess::stop(Patience patience) {
  close_files(); // the end of its input
  if (child_ < 0)
    return;
  bool ended = ends_within(patience == Patience::none ? 0 : grace);
  ::kill(-child_, SIGTERM); // also what it has started itself
  if (!ended)
    ended = ends_within(grace);
  if (!ended)
    ::kill(-child_, SIGKILL);
  while (::waitpid(child_, nullptr, 0) < 0 && errno == EINTR) {
  }
  child_ = -1;
}

void LineProcess::fail(const std::string& reason) {
  stop(Patience::none);
  throw FileError(name_, reason);
}

void LineProcess::report_end() {
  if (!ends_within(grace))
    fail("has closed its output without an answer");
  siginfo_t info{};
  ::waitid(P_PID, static_cast<id_t>(child_), &info, WEXITED | WNOHANG | WNOWAIT);
  const bool exited = info.si_code == CLD_EXITED;
  const std::string said = last_line(errors_);
  fail((exited ? "ended with status " : "was ended by signal ") + std::to_string(info.si_status) +
       (said.empty() ? "" : ": " + said));
}

std::string LineProcess::ask(const std::string& line, double limit) {
  if (child_ < 0)
    throw FileError(name_, "has ended before");
  const std::string sent = line + "\n";
  const ssize_t written = ::send(socket_, sent.data(), sent.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
  if (written < 0 && (errno == EPIPE || errno == ECONNRESET))
    report_end();
  if (written != static_cast<ssize_t>(sent.size()))
    fail("takes no requests");
  const auto deadline = Clock::now() + std::chrono::duration<double>(limit);
  std::string answer;
  char buffer[4096];
  while (answer.find('\n') == std::string::npos) {
    const double left = std::chrono::duration<double>(deadline - Clock::now()).count();
    pollfd waiting{socket_, POLLIN, 0};
    const int ready = left <= 0 ? 0 : ::poll(&waiting, 1, static_cast<int>(std::min(left * 1000 + 1, 1e9)));
    if (ready < 0 && errno == EINTR)
      continue;
    if (ready <= 0)
      fail("gave no answer within " + number_text(limit) + " s");
    const ssize_t count = ::recv(socket_, buffer, sizeof buffer, MSG_DONTWAIT);
    if (count < 0 && (errno == EINTR || errno == EAGAIN))
      continue;
    if (count <= 0)
      report_end();
    answer.append(buffer, static_cast<std::size_t>(count));
    if (answer.size() > longest_answer)
      fail("answered with more than " + std::to_string(longest_answer) + " bytes");
  }
  if (answer.find('\n') + 1 != answer.size())
    fail("answered one request with more than one line");
  answer.pop_back();
  return answer;
}

} // namespace slicelens
