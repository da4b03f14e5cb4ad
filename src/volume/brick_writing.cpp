#include "core/errors.h"
#include "core/files.h"
#include "volume/brick_parts.h"
#include "volume/file_stamp.h"
#include "volume/pyramid.h"
#include "volume/scan_record.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <mutex>

namespace slicelens {

namespace fs = std::filesystem;

namespace {

/// Bytes of voxels that all threads together hold on their way from the source to the bricks, if one band of
/// bricks is not larger.
constexpr std::size_t band_bytes = std::size_t{256} << 20;

/// A file that is being written. Errors name the file that it becomes.
class NewFile {
public:
  NewFile(const fs::path& temporary, fs::path path)
      : path_(std::move(path)),
        file_(::open(temporary.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0644)) {
    if (file_.number() < 0)
      refuse(errno);
  }

  /// Refuses what the disk or the process's limit has no room for before anything is written.
  void reserve(std::uint64_t bytes) {
    struct rlimit limit {};
    if (::getrlimit(RLIMIT_FSIZE, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY && bytes > limit.rlim_cur)
      refuse(EFBIG, bytes); // writing on would end the process by a signal
    const int error = ::posix_fallocate(file_.number(), 0, static_cast<off_t>(bytes));
    if (error == ENOSPC || error == EFBIG || error == EDQUOT)
      refuse(error, bytes);
  }

  void write(std::uint64_t at, const std::vector<std::byte>& bytes) {
    std::size_t done = 0;
    while (done < bytes.size()) {
      const ssize_t put =
          ::pwrite(file_.number(), bytes.data() + done, bytes.size() - done, static_cast<off_t>(at + done));
      if (put < 0 && errno == EINTR)
        continue;
      if (put <= 0)
        refuse(put < 0 ? errno : ENOSPC);
      done += static_cast<std::size_t>(put);
    }
  }

  void finish() {
    if (::fsync(file_.number()) != 0)
      refuse(errno);
  }

private:
  [[noreturn]] void refuse(int error, std::uint64_t bytes = 0) const {
    throw FileError(path_.string(),
                    std::string("the copy in bricks cannot be written: ") + std::strerror(error) +
                        (bytes > 0 ? " (" + std::to_string(bytes) + " bytes are needed)" : "") +
                        "; make room there or name another place with volume.cache");
  }

  fs::path path_;
  Descriptor file_;
};

/// Bands of bricks: all on the x axis, and on the others as many as are read together.
struct Bands {
  std::array<std::size_t, 2> bricks; ///< of one band, on y and z
  std::array<std::size_t, 2> count;
  int threads = 1;
};

/// Sources that give planes are read plane by plane, those that give rows in bands one brick high.
Bands bands_of(const Volume& volume, const BrickGrid& grid) {
  constexpr std::size_t edge = file_brick + 2 * file_brick_overlap;
  const std::size_t scalar = size_of(grid.type);
  const std::size_t plane = grid.dims[0] * grid.dims[1] * scalar * edge;
  const bool planes =
      is_streamed(volume) && volume.streamed->stream->grain()[1] >= grid.dims[1] && plane <= 2 * band_bytes;
  Bands bands;
  bands.bricks = {planes ? grid.bricks[1] : 1, 1};
  bands.count = {planes ? 1 : grid.bricks[1], grid.bricks[2]};
  const std::size_t band = planes ? plane : grid.dims[0] * edge * edge * scalar;
  const auto cores = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
  bands.threads = planes ? 1 : static_cast<int>(std::clamp<std::size_t>(band_bytes / band, 1, cores));
  return bands;
}

/// `work(i)` for every i below `count`, in order, on so many threads.
template <class Work>
void in_order(std::size_t count, int threads, const Work& work) {
  std::atomic<std::size_t> next{0};
  const auto take = [&] {
    try {
      for (std::size_t i = next++; i < count; i = next++)
        work(i);
    } catch (...) {
      next = count; // the others need not go on
      throw;
    }
  };
  if (threads <= 1)
    take();
  else
    tbb::parallel_for(0, threads, [&](int) { take(); });
}

Volume without_voxels(const Volume& volume) {
  Volume outline;
  outline.dims = volume.dims;
  outline.spacing = volume.spacing;
  outline.origin = volume.origin;
  outline.direction = volume.direction;
  outline.type = volume.type;
  outline.min = volume.min;
  outline.max = volume.max;
  outline.mean = volume.mean;
  outline.non_finite = volume.non_finite;
  outline.frames = volume.frames;
  outline.format = volume.format;
  return outline;
}

class BrickWriter {
public:
  BrickWriter(NewFile& file, const fs::path& temporary, BrickHeader& header, const Progress& progress)
      : file_(file), temporary_(temporary), header_(header), progress_(progress) {
    for (const BrickGrid& grid : header.levels)
      total_ += grid.count();
  }

  void write_finest(const Volume& volume) {
    BrickGrid& grid = header_.levels[0];
    const Bands bands = bands_of(volume, grid);
    in_order(bands.count[0] * bands.count[1], bands.threads, [&](std::size_t band) {
      const std::size_t j = band % bands.count[0] * bands.bricks[0];
      const std::size_t k = band / bands.count[0];
      const VoxelBox low = grid.box(grid.index(0, j, k));
      const VoxelBox high = grid.box(grid.index(0, j + bands.bricks[0] - 1, k));
      VoxelBox box = low;
      box.size[0] = grid.dims[0];
      box.size[1] = high.first[1] + high.size[1] - low.first[1];
      const Volume part = crop(volume, box.first, box.size);
      for (std::size_t y = 0; y < bands.bricks[0]; ++y) {
        for (std::size_t x = 0; x < grid.bricks[0]; ++x) {
          const std::size_t index = grid.index(x, j + y, k);
          VoxelBox own = grid.box(index);
          for (std::size_t axis = 0; axis < 3; ++axis)
            own.first[axis] -= box.first[axis];
          put(grid, index, crop(part, own.first, own.size).voxels);
        }
      }
    });
  }

  /// Level `level` from the one below, brick by brick.
  void write_coarser(std::size_t level) {
    const BrickGrid& fine = header_.levels[level - 1];
    Volume below = header_.volume; // min is what half_size puts where there is no number
    below.dims = fine.dims;
    below.type = fine.type;
    auto voxels = std::make_shared<StreamedVoxels>();
    voxels->stream = unfinished_level(temporary_, fine);
    below.streamed = std::move(voxels);
    BrickGrid& grid = header_.levels[level];
    in_order(grid.count(), tbb::this_task_arena::max_concurrency(), [&](std::size_t index) {
      const VoxelBox box = grid.box(index);
      VoxelBox from;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        from.first[axis] = 2 * box.first[axis];
        from.size[axis] =
            std::min(2 * (box.first[axis] + box.size[axis]), fine.dims[axis]) - from.first[axis];
      }
      put(grid, index, half_size(crop(below, from.first, from.size)).voxels);
    });
  }

private:
  void put(BrickGrid& grid, std::size_t index, const std::vector<std::byte>& bytes) {
    grid.checksum[index] = crc_of(bytes);
    file_.write(grid.offsets[index], bytes);
    const std::lock_guard lock(said_);
    report_progress(progress_, "bricks", static_cast<double>(++done_) / static_cast<double>(total_));
  }

  NewFile& file_;
  fs::path temporary_;
  BrickHeader& header_;
  const Progress& progress_;
  std::mutex said_;
  std::size_t total_ = 0;
  std::size_t done_ = 0;
};

} // namespace

void write_bricks(const fs::path& path, const Volume& volume, const BrickSource& source, std::size_t levels,
                  const Progress& progress) {
  BrickHeader header;
  header.volume = without_voxels(volume);
  header.source = source;
  header.scan = scan_of(volume);
  std::uint64_t start = prologue_bytes;
  for (std::size_t level = 0; level < levels; ++level) {
    header.levels.push_back(brick_grid(level_dims(volume.dims, level),
                                       level == 0 ? volume.type : coarser_type(volume.type), start));
    header.levels.back().checksum.resize(header.levels.back().count());
    start = header.levels.back().offsets.back();
  }
  write_atomically(path, [&](const fs::path& temporary) {
    NewFile file(temporary, path);
    BrickPrologue prologue;
    prologue.header_at = start;
    prologue.header_bytes = bytes_of(header).size();
    prologue.file_bytes = prologue.header_at + prologue.header_bytes;
    file.reserve(prologue.file_bytes);
    BrickWriter writer(file, temporary, header, progress);
    writer.write_finest(volume);
    for (std::size_t level = 1; level < levels; ++level)
      writer.write_coarser(level);
    const std::vector<std::byte> head = bytes_of(header);
    prologue.header_checksum = crc_of(head);
    file.write(prologue.header_at, head);
    file.write(0, bytes_of(prologue));
    file.finish();
  });
}

} // namespace slicelens
