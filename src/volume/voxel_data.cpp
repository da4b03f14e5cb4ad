#include "core/errors.h"
#include "volume/header_scan.h"
#include "volume/readers.h"
#include "volume/vti_data.h"

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <fstream>
#include <memory>

namespace slicelens {

namespace fs = std::filesystem;

namespace {

struct InflateEnd {
  void operator()(z_stream* stream) const {
    ::inflateEnd(stream);
    delete stream;
  }
};

/// zlib or gzip data of exactly `out.size()` bytes.
void inflate_into(const fs::path& path, std::ifstream& in, std::uintmax_t stored,
                  std::vector<std::byte>& out) {
  const std::unique_ptr<z_stream, InflateEnd> stream(new z_stream{});
  if (::inflateInit2(stream.get(), 15 + 32) != Z_OK) // 32: either header
    throw FileError(path.string(), "cannot be inflated");
  std::vector<char> buffer(std::size_t{1} << 18);
  std::size_t done = 0;
  int status = Z_OK;
  std::byte beyond{}; // where a byte too many goes
  while (status == Z_OK) {
    if (stream->avail_in == 0 && stored > 0) {
      const auto piece = static_cast<std::streamsize>(std::min<std::uintmax_t>(stored, buffer.size()));
      in.read(buffer.data(), piece);
      stream->next_in = reinterpret_cast<Bytef*>(buffer.data());
      stream->avail_in = static_cast<uInt>(in.gcount());
      stored = in.gcount() == piece ? stored - static_cast<std::uintmax_t>(piece) : 0;
    }
    const std::size_t left = out.size() - done;
    const auto room = static_cast<uInt>(std::min<std::size_t>(left, std::size_t{1} << 30));
    stream->next_out = reinterpret_cast<Bytef*>(left > 0 ? out.data() + done : &beyond);
    stream->avail_out = left > 0 ? room : 1;
    status = ::inflate(stream.get(), Z_NO_FLUSH);
    if (left == 0 && stream->avail_out == 0)
      throw FileError(path.string(), "its compressed data hold more than its sizes say; the header is wrong");
    done += left > 0 ? room - stream->avail_out : 0;
  }
  if (status != Z_STREAM_END || done != out.size())
    throw FileError(path.string(), "its compressed data are truncated or damaged after " +
                                       std::to_string(done) + " of " + std::to_string(out.size()) + " bytes");
}

} // namespace

void read_voxels(const fs::path& path, const HeaderScan& scan, Volume& volume) {
  const fs::path file = scan.data_files.empty() ? path : scan.data_files.front();
  std::ifstream in(file, std::ios::binary);
  in.seekg(static_cast<std::streamoff>(scan.offset));
  if (!in)
    throw FileError(file.string(), "cannot be read");
  if (scan.encoding == Encoding::text) {
    std::string text(static_cast<std::size_t>(scan.stored), '\0');
    in.read(text.data(), static_cast<std::streamsize>(text.size()));
    read_ascii_array(file, text.c_str(), volume);
    return;
  }
  if (scan.encoding == Encoding::deflate)
    inflate_into(file, in, scan.stored, volume.voxels);
  else if (!in.read(reinterpret_cast<char*>(volume.voxels.data()),
                    static_cast<std::streamsize>(volume.voxels.size())))
    throw FileError(file.string(), "ends before its voxels do; the file is truncated");
  if (scan.big_endian != (std::endian::native == std::endian::big))
    swap_bytes(volume.voxels, size_of(volume.type));
}

} // namespace slicelens
