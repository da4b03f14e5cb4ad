// The program `slicelens`: parses the command line, runs one command, turns errors into one line and an exit
// status (0 done, 1 the work failed, 2 wrong usage or scene).

#include "commands.h"
#include "console.h"
#include "core/errors.h"
#include "core/text.h"
#include "memory.h"
#include "options.h"

#include <CLI/CLI.hpp>
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <functional>
#include <iostream>
#include <new>

namespace slicelens::cli {

namespace {

/// An error's text as one line on stderr.
int fail(const std::string& message, int status) {
  end_progress();
  std::string line = message;
  for (char& c : line) {
    if (c == '\n' || c == '\r')
      c = ' ';
  }
  std::fprintf(stderr, "slicelens: %s\n", line.c_str());
  return status;
}

/// What was printed must have arrived: a full disk or a closed stdout is a failure.
int end_output(bool good) {
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0 || !good)
    return fail("stdout: cannot be written", 1);
  return 0;
}

/// Where a standard stream is closed its number would go to the next file opened, and a warning would end up
/// in a picture. Opened for reading, so that writing to a closed stdout still fails.
void fill_closed_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(stream, F_GETFD) == -1 && ::open("/dev/null", O_RDONLY) != stream)
      std::_Exit(1);
  }
}

/// CLI11 would only say that a command is missing.
void refuse_unknown_command(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-')
    return;
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(command->get_name());
  const std::string word = argv[1];
  if (std::find(names.begin(), names.end(), word) != names.end())
    return;
  const auto nearest = nearest_word(word, names);
  throw UsageError("there is no command '" + word + "'; " +
                   (nearest ? "did you mean " + *nearest + "?" : "give one of " + join(names)));
}

int run_program(int argc, char** argv) {
  CLI::App app("Slicelens renders volumes by texture slicing and by ray casting, and measures how far the "
               "two are apart.",
               "slicelens");
  app.set_version_flag("--version", std::string("slicelens ") + SLICELENS_VERSION);
  app.require_subcommand(1);
  app.footer("Exit status: 0 done, 1 the work failed, 2 wrong usage or scene. Help for one command: "
             "slicelens render --help");
  std::function<void()> run;
  AllOptions options;
  add_drawing_commands(app, options, run);
  add_data_commands(app, options, run);
  try {
    refuse_unknown_command(app, argc, argv);
    app.parse(argc, argv);
    run();
  } catch (const CLI::Success& e) { // --help or --version
    app.exit(e);
    std::cout.flush();
    return end_output(std::cout.good());
  } catch (const CLI::ParseError& e) {
    const auto commands = app.get_subcommands();
    const std::string command = commands.empty() ? "slicelens" : "slicelens " + commands.front()->get_name();
    return fail(std::string(e.what()) + "; see " + command + " --help", 2);
  }
  return end_output(true);
}

} // namespace

} // namespace slicelens::cli

int main(int argc, char** argv) {
  using namespace slicelens;
  cli::fill_closed_streams();
  keep_freed_memory();
  std::signal(SIGXFSZ,
              SIG_IGN); // a file that the user's limit cuts short is an error of writing, not the end
  try {
    return cli::run_program(argc, argv);
  } catch (const UsageError& error) {
    return cli::fail(error.what(), 2);
  } catch (const Error& error) {
    return cli::fail(error.what(), 1);
  } catch (const std::bad_alloc&) {
    return cli::fail("out of memory; use a smaller volume or picture", 1);
  } catch (const std::exception& error) {
    return cli::fail(std::string("unexpected error: ") + error.what(), 1);
  }
}
