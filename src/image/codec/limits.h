// What size of picture is believed, before memory is spent on it.
#pragma once

#include <cstdint>
#include <string>

namespace slicelens {

/// Throws FileError naming `path` when a side is below 1 or above 65536 pixels, or the picture with
/// `channels` floats for a pixel would need more than 1 GiB.
void check_size(const std::string& path, std::int64_t width, std::int64_t height, std::int64_t channels);

} // namespace slicelens
