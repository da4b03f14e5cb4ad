// Files of landmarks and of points. The first byte chooses the extension.
#include "fuzz.h"
#include "scene/landmark_files.h"

#include <array>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace slicelens;
  if (size == 0)
    return 0;
  static const std::array<const char*, 4> names = {"points.json", "points.csv", "points.fcsv",
                                                   "points.mrk.json"};
  const auto file = fuzz::write(names[data[0] % names.size()], fuzz::text_of(data + 1, size - 1));
  fuzz::one_line_or_value([&] { read_landmark_pairs(file); });
  fuzz::one_line_or_value([&] { read_points(file, true); });
  return fuzz::one_line_or_value([&] { read_points(file, false); });
}
