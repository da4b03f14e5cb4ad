// Names of headerless files, from which size and type are taken. The file itself holds 64 bytes.
#include "fuzz.h"
#include "volume/read.h"

#include <algorithm>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace slicelens;
  std::string name = fuzz::text_of(data, std::min<std::size_t>(size, 200));
  std::replace(name.begin(), name.end(), '/', '_');
  std::replace(name.begin(), name.end(), '\0', '_');
  VolumeSource source;
  source.file = fuzz::write(name + ".raw", std::string(64, 'v'));
  fuzz::one_line_or_value([&] { read_volume(source); });
  std::error_code error;
  std::filesystem::remove(source.file, error);
  // The same text as a pattern of slices that are not there.
  source.file = fuzz::folder() / "none" / (name + "%03d");
  return fuzz::one_line_or_value([&] { read_volume(source); });
}
