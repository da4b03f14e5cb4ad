#include "volume/file_stamp.h"

#include "core/errors.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

namespace slicelens {

namespace fs = std::filesystem;

namespace {

FileStamp stamp_of(const struct stat& status) {
  return {static_cast<std::uintmax_t>(status.st_size),
          std::int64_t{status.st_mtim.tv_sec} * 1000000000 + status.st_mtim.tv_nsec};
}

[[noreturn]] void refuse(const fs::path& path) {
  throw FileError(path.string(), std::string("cannot be read: ") + std::strerror(errno));
}

} // namespace

FileStamp stamp_of(const fs::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0)
    refuse(path);
  return stamp_of(status);
}

FileStamp stamp_of(int descriptor, const fs::path& path) {
  struct stat status {};
  if (::fstat(descriptor, &status) != 0)
    refuse(path);
  return stamp_of(status);
}

void require_unchanged(const fs::path& path, const FileStamp& before, const FileStamp& now) {
  if (now == before)
    return;
  if (now.size < before.size) {
    throw FileError(path.string(), "became shorter while its voxels were read from it (" +
                                       std::to_string(now.size) + " bytes, " + std::to_string(before.size) +
                                       " when it was opened); start again once it is whole");
  }
  throw FileError(path.string(),
                  "was changed while its voxels were read from it; start again once it is whole");
}

std::string stamps_text(const std::vector<fs::path>& files) {
  std::string text;
  for (const fs::path& file : files) {
    const FileStamp stamp = stamp_of(file);
    std::error_code error;
    const fs::path whole = fs::weakly_canonical(file, error);
    text += (error ? file : whole).string() + '\n' + std::to_string(stamp.size) + ' ' +
            std::to_string(stamp.modified) + '\n';
  }
  return text;
}

Descriptor::~Descriptor() {
  if (number_ >= 0)
    ::close(number_);
}

Descriptor& Descriptor::operator=(Descriptor&& other) noexcept {
  std::swap(number_, other.number_);
  return *this;
}

Descriptor open_to_read(const fs::path& path) {
  Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.number() < 0)
    throw FileError(path.string(), std::string("cannot be opened: ") + std::strerror(errno));
  return file;
}

std::size_t read_at(int descriptor, const fs::path& path, std::uintmax_t offset, std::byte* out,
                    std::size_t count) {
  std::size_t done = 0;
  while (done < count) {
    const ssize_t got = ::pread(descriptor, out + done, count - done, static_cast<off_t>(offset + done));
    if (got < 0 && errno == EINTR)
      continue;
    if (got < 0)
      refuse(path);
    if (got == 0)
      break;
    done += static_cast<std::size_t>(got);
  }
  return done;
}

} // namespace slicelens
