#include "volume/decoding.h"

#include "core/errors.h"

#include <bzlib.h>
#include <zlib.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

namespace slicelens {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t buffer_bytes = std::size_t{1} << 18;

class PlainStream : public ByteStream {
public:
  PlainStream(const fs::path& path, std::uintmax_t offset) : in_(path, std::ios::binary) {
    in_.seekg(static_cast<std::streamoff>(offset));
    if (!in_)
      throw FileError(path.string(), "cannot be read");
  }
  std::size_t read(std::byte* out, std::size_t count) override {
    in_.read(reinterpret_cast<char*>(out), static_cast<std::streamsize>(count));
    return static_cast<std::size_t>(in_.gcount());
  }

private:
  std::ifstream in_;
};

/// What zlib's and libbz2's streams have in common: a buffer of input, streams one behind the other.
class PackedStream : public ByteStream {
public:
  PackedStream(const fs::path& path, std::uintmax_t offset)
      : path_(path), in_(path, offset), buffer_(buffer_bytes) {}

  std::size_t read(std::byte* out, std::size_t count) override {
    std::size_t done = 0;
    while (done < count && !ended_) {
      if (available_ == 0) {
        available_ = in_.read(buffer_.data(), buffer_.size());
        next_ = buffer_.data();
      }
      if (between_ && (available_ == 0 || (streams_ > 0 && !begins_stream()))) {
        ended_ = true; // what follows the last stream is padding
        break;
      }
      const std::size_t input = available_;
      const std::size_t room = std::min<std::size_t>(count - done, std::size_t{1} << 30);
      const std::size_t got = step(out + done, room);
      done += got;
      if (got == 0 && input == 0 && !between_)
        fail("end too early");
    }
    return done;
  }

protected:
  [[noreturn]] void fail(const std::string& what) const {
    throw FileError(path_.string(), "its compressed data " + what + "; the file is truncated or damaged");
  }
  /// Whether the next input may be one more stream.
  virtual bool begins_stream() const = 0;
  /// Decodes from next_ into `out`, at most `room` bytes; moves next_ and available_, counts streams_ and
  /// sets between_ at a stream's end.
  virtual std::size_t step(std::byte* out, std::size_t room) = 0;

  std::byte* next_ = nullptr;
  std::size_t available_ = 0;
  bool between_ = true;
  std::size_t streams_ = 0;

private:
  fs::path path_;
  PlainStream in_;
  std::vector<std::byte> buffer_;
  bool ended_ = false;
};

class DeflateStream final : public PackedStream {
public:
  DeflateStream(const fs::path& path, std::uintmax_t offset) : PackedStream(path, offset) {
    if (::inflateInit2(&z_, 15 + 32) != Z_OK) // 32: zlib's or gzip's header
      fail("cannot be inflated");
  }
  ~DeflateStream() override { ::inflateEnd(&z_); }

protected:
  bool begins_stream() const override { return next_[0] == std::byte{0x1f}; }
  std::size_t step(std::byte* out, std::size_t room) override {
    if (between_)
      ::inflateReset(&z_);
    between_ = false;
    z_.next_in = reinterpret_cast<Bytef*>(next_);
    z_.avail_in = static_cast<uInt>(available_);
    z_.next_out = reinterpret_cast<Bytef*>(out);
    z_.avail_out = static_cast<uInt>(room);
    const int status = ::inflate(&z_, Z_NO_FLUSH);
    if (status != Z_OK && status != Z_STREAM_END && status != Z_BUF_ERROR)
      fail("are no zlib or gzip data or damaged");
    next_ += available_ - z_.avail_in;
    available_ = z_.avail_in;
    if (status == Z_STREAM_END) {
      between_ = true;
      ++streams_;
    }
    return room - z_.avail_out;
  }

private:
  z_stream z_{};
};

class Bzip2Stream final : public PackedStream {
public:
  Bzip2Stream(const fs::path& path, std::uintmax_t offset) : PackedStream(path, offset) {}
  ~Bzip2Stream() override { close(); }

protected:
  bool begins_stream() const override { return next_[0] == std::byte{'B'}; }
  std::size_t step(std::byte* out, std::size_t room) override {
    if (between_) {
      close();
      if (BZ2_bzDecompressInit(&z_, 0, 0) != BZ_OK)
        fail("cannot be decompressed");
      open_ = true;
    }
    between_ = false;
    z_.next_in = reinterpret_cast<char*>(next_);
    z_.avail_in = static_cast<unsigned>(available_);
    z_.next_out = reinterpret_cast<char*>(out);
    z_.avail_out = static_cast<unsigned>(room);
    const int status = BZ2_bzDecompress(&z_);
    if (status != BZ_OK && status != BZ_STREAM_END)
      fail("are no bzip2 data or damaged");
    next_ += available_ - z_.avail_in;
    available_ = z_.avail_in;
    if (status == BZ_STREAM_END) {
      between_ = true;
      ++streams_;
    }
    return room - z_.avail_out;
  }

private:
  void close() {
    if (open_)
      BZ2_bzDecompressEnd(&z_);
    open_ = false;
    z_ = {};
  }
  bz_stream z_{};
  bool open_ = false;
};

} // namespace

std::unique_ptr<ByteStream> open_stream(const fs::path& path, std::uintmax_t offset, Encoding encoding) {
  if (encoding == Encoding::deflate)
    return std::make_unique<DeflateStream>(path, offset);
  if (encoding == Encoding::bzip2)
    return std::make_unique<Bzip2Stream>(path, offset);
  return std::make_unique<PlainStream>(path, offset);
}

} // namespace slicelens
