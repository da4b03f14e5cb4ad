// Pictures from and to files. OpenImageIO does the work inside a module of the program that is loaded on
// first use, because its 261 shared libraries cost a third of a second at every start otherwise.
#pragma once

#include "image/image.h"

#include <filesystem>
#include <map>
#include <string>

namespace slicelens {

/// What is stored for each channel. PNG: unassociated alpha, unsigned integers. EXR: associated alpha,
/// floats.
enum class PixelDepth { png8, png16, exr_half, exr_float };

/// The depth that `name` ("8", "16", "half", "float", or "" for the usual one: 8 for PNG, float for EXR)
/// means for the extension of `path` (case does not matter). Throws UsageError naming .png and .exr for
/// another extension, and the depths that would fit for a name that does not.
PixelDepth pixel_depth(const std::filesystem::path& path, const std::string& name = "");

/// Writes `image` with its metadata; the same image gives the same bytes (no time stamp).
///
/// PNG: colour is divided by alpha (where alpha rounds to 0 it is black: light without opacity is lost),
/// clamped to [0,1] and rounded to the nearest step, NaN becomes 0; the values are display-space and tagged
/// sRGB. EXR: the values as they are, above 1, NaN and infinity included, ZIP compressed (lossless).
///
/// Metadata keys must start with "slicelens:", hold printable ASCII without blanks and at most 79 characters;
/// values may hold anything but NUL, up to 4 MB in all (UTF-8 text is stored as it is).
/// An empty value is the same as none: it is not stored.
///
/// Throws UsageError when the extension is unknown or does not fit `depth`, when a metadata key or value is
/// not valid, or a finite value is beyond 65504 with exr_half; FileError when the file cannot be written in
/// full: an old file at `path` is then unharmed.
void write_image(const Image& image, const std::filesystem::path& path, PixelDepth depth);

/// Reads PNG, EXR, TIFF, JPEG and whatever else OpenImageIO opens: the first picture of the file at full
/// resolution, as associated RGBA floats (integers are divided by their largest value; no gamma or colour
/// conversion). A picture without alpha is opaque, grey becomes R = G = B; an EXR's data window is put in its
/// place in the display window. `metadata` holds the texts under "slicelens:" keys.
///
/// Throws FileError when the file is missing, a folder, not a regular file, no image, damaged or truncated,
/// or larger than 65536 pixels on a side or 1 GiB as floats (checked before anything is allocated).
Image read_image(const std::filesystem::path& path);

/// The "slicelens:" texts of an image without reading its pixels. Throws as read_image does.
std::map<std::string, std::string> read_metadata(const std::filesystem::path& path);

/// Starts loading the codec on a thread of its own, so that it overlaps other work (reading a volume,
/// drawing). May be called any number of times, from any thread; an error is kept for the first read or
/// write, and the thread is joined at the latest when the program ends. Loading holds the dynamic linker's
/// lock, so that other dlopen calls and starts of threads wait for it: call this after the graphics context
/// is open and the threads are running.
void preload_codec();

/// Waits until that loading has ended, well or badly. The first draw of a software driver looks up symbols
/// and would wait for it anyway; waiting here keeps the time out of the measure of drawing.
void await_codec();

} // namespace slicelens
