// The walk through a DICOM file's structure and what is taken from it, without GDCM.
#include "fuzz.h"
#include "volume/dicom_series.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace slicelens;
  const auto file = fuzz::write("image.dcm", fuzz::text_of(data, size));
  return fuzz::one_line_or_value([&] { stack_of({scan_dicom(file)}, file, file.string(), "", 0, {}); });
}
