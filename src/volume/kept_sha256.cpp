#include "volume/kept_sha256.h"

#include "core/errors.h"
#include "core/files.h"
#include "volume/file_checks.h"
#include "volume/file_stamp.h"
#include "volume/read.h"
#include "volume/scan_record.h"

#include <cstdint>
#include <system_error>

namespace slicelens {

namespace fs = std::filesystem;

std::string kept_sha256_of(const std::vector<fs::path>& files, const std::string& stamps) {
  const fs::path folder = user_cache();
  const fs::path kept = folder.empty() ? folder : folder / (sha256_of_text(stamps).substr(0, 40) + ".sha256");
  constexpr std::size_t digits = 64;
  std::error_code error;
  if (!kept.empty() && fs::is_regular_file(kept, error)) {
    const std::string text = head_of(kept, 2 * digits + 1);
    if (text.size() == 2 * digits && text.substr(digits) == sha256_of_text(stamps + text.substr(0, digits)))
      return text.substr(0, digits);
  }
  const std::string digest = sha256_of(files);
  if (kept.empty() || stamps_text(files) != stamps)
    return digest;
  try {
    fs::create_directories(folder, error);
    write_text_atomically(kept, digest + sha256_of_text(stamps + digest));
  } catch (const FileError&) {
    // It is worked out again next time; what cannot be written there otherwise says so.
  }
  return digest;
}

std::string sha256_of_volume(const std::vector<fs::path>& files) {
  constexpr std::uintmax_t large = std::uintmax_t{1} << 30;
  std::uintmax_t bytes = 0;
  for (const fs::path& file : files)
    bytes += require_file(file);
  return bytes > large ? kept_sha256_of(files, stamps_text(files)) : sha256_of(files);
}

} // namespace slicelens
