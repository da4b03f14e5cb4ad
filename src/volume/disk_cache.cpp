// Which copy in bricks stands for a volume, and when it is made.
#include "core/errors.h"
#include "core/files.h"
#include "core/text.h"
#include "volume/brick_file.h"
#include "volume/file_checks.h"
#include "volume/file_stamp.h"
#include "volume/on_disk.h"
#include "volume/scan_record.h"

#include <algorithm>
#include <system_error>
#include <utility>

namespace slicelens {

namespace fs = std::filesystem;

namespace {

/// A source, its copy's place, and what that must have been made of.
struct Place {
  fs::path path;
  bool chosen = false; ///< by volume.cache, so that nothing there is replaced unasked
  BrickSource source;
  std::vector<fs::path> files;
  std::string stamps; ///< of the files before they were hashed
};

/// sha256_of files that have these stamps. It is kept beside the copies, as hashing a large file takes as
/// long as reading it: behind it the hash of both, by which damage shows.
std::string digest_of(const std::vector<fs::path>& files, const std::string& stamps) {
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

/// A copy holds its volume's place in the world as it was given.
std::string spacing_text(const VolumeSource& source) {
  if (!source.spacing)
    return {};
  const glm::dvec3& s = *source.spacing;
  return "spacing " + number_text(s.x) + " " + number_text(s.y) + " " + number_text(s.z) + "\n";
}

Place place_of(const VolumeSource& source, const CacheRequest& request) {
  Place place;
  place.files = files_of(source);
  place.stamps = stamps_text(place.files);
  place.source = {source.file.string(), digest_of(place.files, place.stamps),
                  choice_text(source) + spacing_text(source)};
  if (request.file) {
    place.path = *request.file;
    place.chosen = true;
    return place;
  }
  const fs::path folder = user_cache();
  if (folder.empty()) {
    throw FileError(source.file.string(), "there is no folder for its copy in bricks (neither "
                                          "XDG_CACHE_HOME nor HOME is set); name a file with volume.cache");
  }
  place.path = folder / (place.source.sha256.substr(0, 40) + "-" +
                         sha256_of_text(place.source.choice).substr(0, 8) + ".bricks");
  return place;
}

void require_source(const Place& place, const BrickHeader& header) {
  if (header.source == place.source)
    return;
  const bool same_name = header.source.name == place.source.name;
  throw FileError(place.path.string(),
                  !same_name ? "is a copy of another volume (" + header.source.name + ")"
                  : header.source.choice == place.source.choice
                      ? "is a copy of what " + header.source.name + " held before it was changed"
                      : "is a copy of other voxels of " + header.source.name +
                            " (volume.frame, "
                            "volume.component, volume.series, volume.spacing …)");
}

/// The copy's header; nothing where there is no copy, or a damaged one that may be made again.
std::optional<BrickHeader> header_at(const Place& place, const Progress& progress) {
  std::error_code error;
  if (!fs::exists(place.path, error))
    return std::nullopt;
  try {
    BrickHeader header = read_brick_header(place.path);
    require_source(place, header);
    return header;
  } catch (const FileError& problem) {
    const std::string what = problem.what();
    if (place.chosen) {
      const std::string remedy = "; delete it, or name another file with volume.cache";
      const std::size_t told = what.find("; delete");
      throw Error(what.substr(0, told) + remedy);
    }
    report_warning(progress, what + "; it is made again");
    return std::nullopt;
  }
}

/// The voxels to be copied, from the files.
Volume read_source(const VolumeSource& source, const Progress& progress) {
  if (std::optional<Volume> streamed =
          stream_volume(source, progress, ScanKeeping::drop)) // the copy keeps it
    return std::move(*streamed);
  return read_volume(source, progress);
}

/// As many levels as were asked for and as the volume has voxels for.
std::size_t level_count(const Volume& volume, std::size_t levels) {
  const std::size_t longest = std::max({volume.dims[0], volume.dims[1], volume.dims[2]});
  std::size_t count = 1;
  while (count < levels && (longest >> count) > 0)
    ++count;
  return count;
}

} // namespace

std::optional<Volume> cached_already(const VolumeSource& source, const CacheRequest& request,
                                     const Progress& progress) {
  const Place place = place_of(source, request);
  std::optional<BrickHeader> header = header_at(place, progress);
  if (!header || header->levels.size() < level_count(header->volume, request.levels))
    return std::nullopt;
  return open_bricks(place.path, std::move(*header));
}

Volume cached_volume(const VolumeSource& source, const CacheRequest& request, const Progress& progress,
                     std::optional<Volume> known) {
  const Place place = place_of(source, request);
  std::optional<BrickHeader> header = header_at(place, progress);
  if (header) {
    const bool enough = header->levels.size() >= level_count(header->volume, request.levels);
    Volume copy = open_bricks(place.path, std::move(*header));
    if (enough)
      return copy;
    known = std::move(copy); // its finest level is the source of the new one
  } else if (!known) {
    known = read_source(source, progress);
  }
  if (known->components != 1)
    return std::move(*known);
  if (stamps_text(place.files) != place.stamps)
    throw FileError(source.file.string(), "was changed while it was read; start again once it is whole");
  if (!place.chosen) {
    std::error_code error;
    fs::create_directories(place.path.parent_path(), error); // what fails is said by the writing
  }
  write_bricks(place.path, *known, place.source, level_count(*known, request.levels), progress);
  known.reset();
  return open_bricks(place.path, read_brick_header(place.path));
}

} // namespace slicelens
