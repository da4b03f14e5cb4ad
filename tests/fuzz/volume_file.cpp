// A volume file of one extension (SLICELENS_FUZZ_NAME), read in full, and streamed where it can be. Two data
// files lie beside it for detached headers.
#include "fuzz.h"
#include "volume/on_disk.h"
#include "volume/pyramid.h"
#include "volume/read.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace slicelens;
  static const bool beside = [] {
    fuzz::write("data.raw", std::string(96, 'v'));
    fuzz::write("slice1.raw", std::string(24, 'a'));
    fuzz::write("slice2.raw", std::string(24, 'b'));
    ::unsetenv("XDG_CACHE_HOME"); // no scan is kept of files that never come again
    ::unsetenv("HOME");
    return true;
  }();
  static_cast<void>(beside);
  VolumeSource source;
  source.file = fuzz::write(SLICELENS_FUZZ_NAME, fuzz::text_of(data, size));
  Volume loaded;
  fuzz::one_line_or_value([&] { loaded = read_volume(source); });
  std::optional<Volume> streamed;
  fuzz::one_line_or_value([&] { streamed = stream_volume(source); });
  if (streamed && !loaded.voxels.empty() &&
      crop(*streamed, {0, 0, 0}, streamed->dims).voxels != loaded.voxels) {
    std::fprintf(stderr, "streamed voxels differ from those that are read\n");
    std::abort();
  }
  return 0;
}
