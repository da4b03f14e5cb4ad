// Running gnuplot as a program of its own.
#pragma once

#include <string>

namespace slicelens {

/// What `script` writes to gnuplot's standard output, with gnuplot's own defaults (no ~/.gnuplot). gnuplot is
/// found through PATH and started without a shell; script and answers lie in a temporary folder that is
/// removed. Throws FileError when gnuplot is not installed, when it fails (with its first error), when it
/// writes nothing, or when the temporary folder cannot be written.
std::string run_gnuplot(const std::string& script);

} // namespace slicelens
