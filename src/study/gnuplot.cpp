#include "study/gnuplot.h"

#include "core/errors.h"
#include "core/files.h"
#include "study/process.h"

#include <sys/wait.h>

#include <filesystem>
#include <sstream>

namespace slicelens {

namespace {

namespace fs = std::filesystem;

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
  const ScratchFolder folder;
  const fs::path file = folder / "plot.gp";
  write_text_atomically(file, script);
  const auto ended = run_program({"gnuplot", "-d", file.string()}, folder / "out", folder / "err");
  if (!ended)
    throw FileError("gnuplot", "is not installed, and it draws the plots; apt-get install gnuplot-nox");
  const int status = *ended;
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
