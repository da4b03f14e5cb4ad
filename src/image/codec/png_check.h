// A look at a PNG's frame before the library reads it: libpng prints its complaints to stderr itself, and
// believes the header's size.
#pragma once

#include <cstdint>
#include <string>

namespace slicelens {

/// Throws FileError when the file at `path` starts as a PNG does but its chunks are cut short or damaged, its
/// header is not valid, or it has too few bytes for the pixels that the header claims. A file that does not
/// start as a PNG passes. Reads the file once, in small pieces. (ISO 15948 §5.)
void check_png(const std::string& path);

} // namespace slicelens
