// Telling whether a file is the one that it was. Private to src/volume.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace slicelens {

/// What changes when a file is written to.
struct FileStamp {
  std::uintmax_t size = 0;
  std::int64_t modified = 0; ///< ns since 1970
  friend bool operator==(const FileStamp&, const FileStamp&) = default;
};

/// Throws FileError naming `path` where it cannot be asked.
FileStamp stamp_of(const std::filesystem::path& path);
FileStamp stamp_of(int descriptor, const std::filesystem::path& path);

/// Throws FileError unless `now` is `before`: the file became shorter or was changed while it was read.
void require_unchanged(const std::filesystem::path& path, const FileStamp& before, const FileStamp& now);

/// Path, size and time of each file as lines of text: equal as long as nobody writes to any of them.
std::string stamps_text(const std::vector<std::filesystem::path>& files);

/// A file descriptor that is closed at the end; -1: none.
class Descriptor {
public:
  Descriptor() = default;
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor();
  Descriptor(Descriptor&& other) noexcept : number_(other.number_) { other.number_ = -1; }
  Descriptor& operator=(Descriptor&& other) noexcept;
  int number() const { return number_; }

private:
  int number_ = -1;
};

/// Opened for reading. Throws FileError.
Descriptor open_to_read(const std::filesystem::path& path);

/// Fills `out` from `offset`. Returns how many bytes there were, fewer than `count` only at the file's end.
/// Throws FileError for an error of the device.
std::size_t read_at(int descriptor, const std::filesystem::path& path, std::uintmax_t offset, std::byte* out,
                    std::size_t count);

} // namespace slicelens
