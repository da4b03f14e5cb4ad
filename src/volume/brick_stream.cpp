#include "core/errors.h"
#include "volume/brick_parts.h"
#include "volume/file_stamp.h"
#include "volume/pyramid.h"
#include "volume/scan_record.h"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <unordered_map>

namespace slicelens {

namespace fs = std::filesystem;

namespace {

/// Bytes of bricks that all levels of a file keep together.
constexpr std::size_t kept_bytes = std::size_t{64} << 20;

using Bytes = std::shared_ptr<const std::vector<std::byte>>;

/// An open file and the bricks of it that were used last.
class OpenBricks {
public:
  /// `finished`: whether the file stays as it is from now on.
  OpenBricks(const fs::path& path, bool finished) : path_(path), file_(open_to_read(path)) {
    if (finished)
      stamp_ = stamp_of(file_.number(), path);
  }

  /// Reads it where it is not kept; `taken` counts the bytes.
  Bytes brick(const BrickGrid& grid, std::size_t index, std::atomic<std::uint64_t>& taken) {
    const std::uint64_t place = grid.offsets[index];
    if (Bytes kept = find(place))
      return kept;
    const std::size_t count = static_cast<std::size_t>(grid.offsets[index + 1] - place);
    auto bytes = std::make_shared<std::vector<std::byte>>(count);
    const std::size_t got = read_at(file_.number(), path_, place, bytes->data(), count);
    taken += got;
    if (stamp_)
      require_unchanged(path_, *stamp_, stamp_of(file_.number(), path_));
    if (got < count || crc_of(*bytes) != grid.checksum[index]) {
      throw FileError(path_.string(), "brick " + std::to_string(index) + " of " +
                                          std::to_string(grid.count()) +
                                          " is damaged (checksum); delete the file, it is made again");
    }
    keep(place, bytes);
    return bytes;
  }

private:
  struct Kept {
    std::uint64_t place;
    Bytes bytes;
  };

  Bytes find(std::uint64_t place) {
    const std::lock_guard lock(mutex_);
    const auto found = where_.find(place);
    if (found == where_.end())
      return nullptr;
    kept_.splice(kept_.begin(), kept_, found->second);
    return found->second->bytes;
  }

  void keep(std::uint64_t place, const Bytes& bytes) {
    const std::lock_guard lock(mutex_);
    if (where_.count(place) != 0) // another thread read it too
      return;
    kept_.push_front({place, bytes});
    where_[place] = kept_.begin();
    size_ += bytes->size();
    while (size_ > kept_bytes && kept_.size() > 1) {
      size_ -= kept_.back().bytes->size();
      where_.erase(kept_.back().place);
      kept_.pop_back();
    }
  }

  fs::path path_;
  Descriptor file_;
  std::optional<FileStamp> stamp_;
  std::mutex mutex_;
  std::list<Kept> kept_; ///< the last used first
  std::unordered_map<std::uint64_t, std::list<Kept>::iterator> where_;
  std::size_t size_ = 0;
};

/// Voxels [first, end) of an axis, in one brick.
struct Run {
  std::size_t brick;
  std::size_t first;
  std::size_t end;
};

/// As few bricks as hold [first, end), thanks to their overlap.
std::vector<Run> runs_of(std::size_t first, std::size_t end, std::size_t bricks) {
  std::vector<Run> runs;
  while (first < end) {
    const std::size_t brick = std::min((first + file_brick_overlap) / file_brick, bricks - 1);
    const std::size_t stop = std::min(end, (brick + 1) * file_brick + file_brick_overlap);
    runs.push_back({brick, first, stop});
    first = stop;
  }
  return runs;
}

class BrickStream : public VoxelStream {
public:
  BrickStream(std::shared_ptr<OpenBricks> file, BrickGrid grid)
      : file_(std::move(file)), grid_(std::move(grid)), scalar_(size_of(grid_.type)) {}

  void read(const VoxelBox& box, std::span<std::byte> out) const override {
    std::array<std::vector<Run>, 3> runs;
    for (std::size_t axis = 0; axis < 3; ++axis)
      runs[axis] = runs_of(box.first[axis], box.first[axis] + box.size[axis], grid_.bricks[axis]);
    for (const Run& z : runs[2]) {
      for (const Run& y : runs[1]) {
        for (const Run& x : runs[0])
          copy(box, {x, y, z}, out.data());
      }
    }
  }

  std::array<std::size_t, 3> grain() const override { return {file_brick, file_brick, file_brick}; }
  std::uint64_t bytes_read() const override { return bytes_read_; }

private:
  void copy(const VoxelBox& box, const std::array<Run, 3>& runs, std::byte* out) const {
    const std::size_t index = grid_.index(runs[0].brick, runs[1].brick, runs[2].brick);
    const Bytes bytes = file_->brick(grid_, index, bytes_read_);
    const VoxelBox held = grid_.box(index);
    const std::size_t row = (runs[0].end - runs[0].first) * scalar_;
    for (std::size_t k = runs[2].first; k < runs[2].end; ++k) {
      for (std::size_t j = runs[1].first; j < runs[1].end; ++j) {
        const std::size_t from = ((k - held.first[2]) * held.size[1] + j - held.first[1]) * held.size[0] +
                                 runs[0].first - held.first[0];
        const std::size_t to = ((k - box.first[2]) * box.size[1] + j - box.first[1]) * box.size[0] +
                               runs[0].first - box.first[0];
        std::memcpy(out + to * scalar_, bytes->data() + from * scalar_, row);
      }
    }
  }

  std::shared_ptr<OpenBricks> file_;
  BrickGrid grid_;
  std::size_t scalar_;
  mutable std::atomic<std::uint64_t> bytes_read_{0};
};

} // namespace

std::unique_ptr<const VoxelStream> unfinished_level(const fs::path& path, const BrickGrid& grid) {
  return std::make_unique<BrickStream>(std::make_shared<OpenBricks>(path, false), grid);
}

Volume open_bricks(const fs::path& path, BrickHeader header) {
  const auto file = std::make_shared<OpenBricks>(path, true);
  Volume volume = std::move(header.volume);
  auto streamed = std::make_shared<StreamedVoxels>();
  streamed->where = "cache: " + path.string();
  Volume finer = volume;
  for (std::size_t level = 1; level < header.levels.size(); ++level) {
    Volume coarser = coarser_outline(finer);
    auto voxels = std::make_shared<StreamedVoxels>();
    voxels->stream = std::make_unique<BrickStream>(file, std::move(header.levels[level]));
    voxels->where = streamed->where;
    coarser.streamed = std::move(voxels);
    finer = coarser;
    streamed->coarser.push_back(std::move(coarser));
  }
  streamed->stream = std::make_unique<BrickStream>(file, std::move(header.levels[0]));
  streamed->cells = std::move(header.scan.cells);
  streamed->samples = std::move(header.scan.samples);
  volume.streamed = std::move(streamed);
  return volume;
}

} // namespace slicelens
