// A volume file of one extension (SLICELENS_FUZZ_NAME), read in full. Two data files lie beside it for
// detached headers.
#include "fuzz.h"
#include "volume/read.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace slicelens;
  static const bool beside = [] {
    fuzz::write("data.raw", std::string(96, 'v'));
    fuzz::write("slice1.raw", std::string(24, 'a'));
    fuzz::write("slice2.raw", std::string(24, 'b'));
    return true;
  }();
  static_cast<void>(beside);
  VolumeSource source;
  source.file = fuzz::write(SLICELENS_FUZZ_NAME, fuzz::text_of(data, size));
  return fuzz::one_line_or_value([&] { read_volume(source); });
}
