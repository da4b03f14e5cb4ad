// A copy of a volume in bricks: the file as it is (first byte even), or only its header, behind a prologue
// whose checksums fit, so that changes reach what lies behind them.
#include "fuzz.h"
#include "volume/brick_parts.h"
#include "volume/pyramid.h"
#include "volume/scan_record.h"

#include <cstring>

namespace {

/// A whole file around a header that begins with the place where it is to be, below 65536.
std::string with_prologue(const std::string& text) {
  using namespace slicelens;
  std::uint64_t at = 0;
  std::memcpy(&at, text.data(), sizeof at);
  at = std::max<std::uint64_t>(prologue_bytes, at % 65536);
  const std::string header = text.substr(sizeof at);
  BrickPrologue prologue;
  prologue.header_at = at;
  prologue.header_bytes = header.size();
  prologue.file_bytes = at + header.size();
  prologue.header_checksum = crc_of(std::as_bytes(std::span(header)));
  const std::vector<std::byte> bytes = bytes_of(prologue);
  std::string file(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  file.resize(at);
  return file + header;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace slicelens;
  if (size < 16)
    return 0;
  const std::string text = fuzz::text_of(data + 1, size - 1);
  const std::filesystem::path path =
      fuzz::write("volume.bricks", data[0] % 2 == 0 ? text : with_prologue(text));
  return fuzz::one_line_or_value([&] {
    const Volume volume = open_bricks(path, read_brick_header(path));
    if (voxel_count(volume) < (std::size_t{1} << 20)) {
      crop(volume, {0, 0, 0}, volume.dims);
      for (const Volume& level : volume.streamed->coarser)
        crop(level, {0, 0, 0}, level.dims);
    }
  });
}
