// SHA-256 of large files, kept in the user's cache folder: hashing takes as long as reading them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace slicelens {

/// sha256_of (volume/read.h) files that have these stamps (volume/file_stamp.h: path, size, time of change):
/// as it was when files of the same stamps were hashed before. Behind the hash that is kept stands one of
/// both, by which damage shows. Throws FileError when a file cannot be read.
std::string kept_sha256_of(const std::vector<std::filesystem::path>& files, const std::string& stamps);

/// The same where the files are above 1 GiB together, else sha256_of.
std::string sha256_of_volume(const std::vector<std::filesystem::path>& files);

} // namespace slicelens
