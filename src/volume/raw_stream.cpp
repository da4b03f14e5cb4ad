#include "volume/raw_stream.h"

#include "core/errors.h"
#include "volume/file_stamp.h"
#include "volume/readers.h"

#include <algorithm>
#include <atomic>
#include <cstring>

namespace slicelens {

namespace {

/// Files that stay open; of more, each is opened when it is read (a process may have 1024 open ones).
constexpr std::size_t most_open = 64;

/// Bytes that rows are read in at most where what lies between them is read as well.
constexpr std::size_t rows_bytes = std::size_t{1} << 20;

struct OpenFile {
  RawLayout::Piece piece;
  FileStamp stamp;
  Descriptor descriptor; ///< -1: opened when it is read
};

/// One read's way through the files; what it leaves is checked for changes.
class Visit {
public:
  explicit Visit(const std::vector<OpenFile>& files) : files_(files) {}

  /// `count` bytes from byte `at` of all pieces.
  void read(std::uintmax_t at, std::byte* out, std::size_t count) {
    const std::uintmax_t piece_bytes = files_.front().piece.bytes;
    while (count > 0) {
      const auto index =
          static_cast<std::size_t>(std::min<std::uintmax_t>(at / piece_bytes, files_.size() - 1));
      const std::uintmax_t inside = at - index * piece_bytes;
      const RawLayout::Piece& piece = files_[index].piece;
      enter(index);
      const auto part = static_cast<std::size_t>(std::min<std::uintmax_t>(count, piece.bytes - inside));
      const std::size_t got = read_at(descriptor(), piece.file, piece.offset + inside, out, part);
      taken_ += got;
      if (got < part) {
        leave();
        throw FileError(piece.file.string(), "ends before its voxels do; the file is truncated");
      }
      at += part;
      out += part;
      count -= part;
    }
  }

  /// Checks the last file.
  void leave() const {
    if (file_ != nullptr)
      require_unchanged(file_->piece.file, file_->stamp, stamp_of(descriptor(), file_->piece.file));
  }

  std::uint64_t taken() const { return taken_; }

private:
  void enter(std::size_t index) {
    if (file_ == &files_[index])
      return;
    leave();
    file_ = &files_[index];
    own_ = file_->descriptor.number() < 0 ? open_to_read(file_->piece.file) : Descriptor();
  }
  int descriptor() const { return own_.number() >= 0 ? own_.number() : file_->descriptor.number(); }

  const std::vector<OpenFile>& files_;
  const OpenFile* file_ = nullptr;
  Descriptor own_;
  std::uint64_t taken_ = 0;
};

class RawStream : public VoxelStream {
public:
  RawStream(const OpenedVolume& opened, int component)
      : layout_(*opened.layout), dims_(opened.volume.dims), scalar_(size_of(opened.volume.type)) {
    layout_.first += static_cast<std::uintmax_t>(component) * layout_.component_step;
    for (const RawLayout::Piece& piece : layout_.pieces) {
      OpenFile file{piece, {}, open_to_read(piece.file)};
      file.stamp = stamp_of(file.descriptor.number(), piece.file);
      if (file.stamp.size < piece.offset || file.stamp.size - piece.offset < piece.bytes)
        throw FileError(piece.file.string(), "ends before its voxels do; the file is truncated");
      if (layout_.pieces.size() > most_open)
        file.descriptor = Descriptor();
      files_.push_back(std::move(file));
    }
  }

  void read(const VoxelBox& box, std::span<std::byte> out) const override {
    Visit visit(files_);
    if (layout_.step[0] != 1)
      read_spread_rows(box, visit, out.data());
    else
      read_rows(box, visit, out.data());
    visit.leave();
    bytes_read_ += visit.taken();
    if (layout_.swapped)
      swap_bytes(out, scalar_);
  }

  std::array<std::size_t, 3> grain() const override { return {dims_[0], 1, 1}; }
  std::uint64_t bytes_read() const override { return bytes_read_; }

private:
  /// Byte of voxel (i,j,k).
  std::uintmax_t place(std::size_t i, std::size_t j, std::size_t k) const {
    return (layout_.first + i * layout_.step[0] + j * layout_.step[1] + k * layout_.step[2]) * scalar_;
  }

  /// Other scalars lie between those of a row.
  void read_spread_rows(const VoxelBox& box, Visit& visit, std::byte* out) const {
    const auto step = static_cast<std::size_t>(layout_.step[0]);
    std::vector<std::byte> row(((box.size[0] - 1) * step + 1) * scalar_);
    for (std::size_t k = 0; k < box.size[2]; ++k) {
      for (std::size_t j = 0; j < box.size[1]; ++j) {
        visit.read(place(box.first[0], box.first[1] + j, box.first[2] + k), row.data(), row.size());
        for (std::size_t i = 0; i < box.size[0]; ++i, out += scalar_)
          std::memcpy(out, row.data() + i * step * scalar_, scalar_);
      }
    }
  }

  void read_rows(const VoxelBox& box, Visit& visit, std::byte* out) const {
    const std::size_t row = box.size[0] * scalar_;
    const bool whole_rows = box.size[0] == layout_.step[1] || box.size[1] == 1;
    const std::size_t plane = row * box.size[1];
    const bool whole_planes = whole_rows && (plane == layout_.step[2] * scalar_ || box.size[2] == 1);
    if (whole_planes) {
      visit.read(place(box.first[0], box.first[1], box.first[2]), out, plane * box.size[2]);
      return;
    }
    for (std::size_t k = 0; k < box.size[2]; ++k, out += plane) {
      const std::uintmax_t at = place(box.first[0], box.first[1], box.first[2] + k);
      if (whole_rows)
        visit.read(at, out, plane);
      else
        read_part_of_plane(box, visit, at, out);
    }
  }

  /// Rows that are a good part of the plane's are read with what lies between them: fewer calls.
  void read_part_of_plane(const VoxelBox& box, Visit& visit, std::uintmax_t at, std::byte* out) const {
    const std::size_t row = box.size[0] * scalar_;
    const std::uintmax_t pitch = layout_.step[1] * scalar_;
    const bool dense = row <= pitch && 4 * row >= pitch;
    const std::size_t together =
        dense ? std::clamp<std::size_t>(rows_bytes / static_cast<std::size_t>(pitch), 1, box.size[1]) : 1;
    std::vector<std::byte> rows(together > 1 ? (together - 1) * static_cast<std::size_t>(pitch) + row : 0);
    for (std::size_t j = 0; j < box.size[1]; j += together) {
      const std::size_t count = std::min(together, box.size[1] - j);
      if (count == 1) {
        visit.read(at + j * pitch, out + j * row, row);
        continue;
      }
      visit.read(at + j * pitch, rows.data(), (count - 1) * static_cast<std::size_t>(pitch) + row);
      for (std::size_t r = 0; r < count; ++r)
        std::memcpy(out + (j + r) * row, rows.data() + r * static_cast<std::size_t>(pitch), row);
    }
  }

  RawLayout layout_;
  std::array<std::size_t, 3> dims_;
  std::size_t scalar_;
  std::vector<OpenFile> files_;
  mutable std::atomic<std::uint64_t> bytes_read_{0};
};

} // namespace

std::unique_ptr<const VoxelStream> raw_stream(const OpenedVolume& opened, int component) {
  if (opened.layout->step[0] > most_row_step)
    return nullptr;
  return std::make_unique<RawStream>(opened, component);
}

} // namespace slicelens
