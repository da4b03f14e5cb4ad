// The bridge from ITK's image readers to Volume. Private to src/volume: the only header here that names ITK.
#pragma once

#include "core/progress.h"
#include "volume/volume.h"

#include <itkImageIOBase.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

namespace slicelens {

/// While one lives, what ITK and GDCM would print (their output window, trace and stderr) is collected
/// instead; when it ends the lines go to progress.warn, each once. One at a time: readers nest none.
class LibraryMessages {
public:
  /// `label` (the file's name) begins each warning.
  LibraryMessages(const std::string& label, const Progress& progress);
  ~LibraryMessages();
  LibraryMessages(const LibraryMessages&) = delete;
  LibraryMessages& operator=(const LibraryMessages&) = delete;
  /// Forgets what is collected: an error says it already.
  void discard();

private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Runs `work` with library messages collected; what ITK or the standard library throws becomes one FileError
/// for `path`.
void with_libraries(const std::filesystem::path& path, const Progress& progress,
                    const std::function<void()>& work);

/// Dims (of one frame), frames, spacing, origin, direction, type and components of a header that `io` has
/// read (ReadImageInformation); no voxels. Throws FileError naming what a Volume cannot be: more than 4
/// components, complex numbers, unknown scalar types, more than four dimensions, a spacing that is not a
/// positive number, a degenerate direction. `components_are_frames`: the components that ITK sees are a list
/// of frames.
Volume header_of(itk::ImageIOBase& io, const std::filesystem::path& path, bool components_are_frames = false);

/// Reads `frame` into `volume.voxels` (all of the file's frames are read when the format cannot be read in
/// parts). `volume` is header_of's; throws UsageError when it has no such frame.
void read_frame(itk::ImageIOBase& io, const std::filesystem::path& path, std::size_t frame, Volume& volume,
                bool components_are_frames = false);

} // namespace slicelens
