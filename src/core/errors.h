// The named errors of Slicelens. Code below tools/ throws one of these and never prints or exits; tools/
// catches them once and turns them into one line on stderr and an exit status.
#pragma once

#include <stdexcept>
#include <string>

namespace slicelens {

/// Base of all errors that the program reports as one line. The message names the file, key or value at fault
/// and says what would be right. It is one line: control characters (of a file's name or contents) become
/// '?'.
class Error : public std::runtime_error {
public:
  explicit Error(const std::string& message);
};

/// The caller asked for something that is not valid: a wrong option, scene key, value or combination. Exit
/// status 2.
class UsageError : public Error {
public:
  using Error::Error;
};

/// A file cannot be read or written, or does not hold what it claims. Exit status 1.
class FileError : public Error {
public:
  /// `path` as the user gave it; `what` names the field at fault and the remedy.
  FileError(const std::string& path, const std::string& what) : Error(path + ": " + what) {}
};

/// No OpenGL context could be opened, or the driver refused a program or an object. Exit status 1.
class GraphicsError : public Error {
public:
  using Error::Error;
};

/// The work needs more memory or a larger object than the machine or the driver allows. Exit status 1.
class LimitError : public Error {
public:
  using Error::Error;
};

/// `a·b`, or a LimitError naming `what` when the product does not fit.
std::size_t checked_product(std::size_t a, std::size_t b, const std::string& what);

} // namespace slicelens
