#include "core/errors.h"
#include "core/text.h"
#include "volume/itk_reading.h"
#include "volume/nrrd_header.h"
#include "volume/readers.h"

#include <fcntl.h>
#include <itkNrrdImageIO.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <memory>

namespace slicelens {

namespace fs = std::filesystem;

namespace {

using Axis = NrrdHeader::Axis;

struct GzClose {
  void operator()(gzFile_s* file) const { ::gzclose(file); }
};

/// The decoded bytes of raw or gzip data, over all data files in turn.
class NrrdStream {
public:
  NrrdStream(const fs::path& path, const NrrdHeader& header, std::uintmax_t total)
      : path_(path), header_(header),
        files_(header.data_files.empty() ? std::vector<fs::path>{path} : header.data_files),
        per_file_(total / files_.size()) {}

  void skip(std::uintmax_t count) {
    std::vector<std::byte> ignored(std::size_t{1} << 20);
    while (count > 0) {
      const auto piece = static_cast<std::size_t>(std::min<std::uintmax_t>(count, ignored.size()));
      read(ignored.data(), piece);
      count -= piece;
    }
  }

  void read(std::byte* out, std::size_t count) {
    while (count > 0) {
      if (left_ == 0)
        open_next();
      const auto piece = static_cast<unsigned>(std::min<std::uintmax_t>({count, left_, 1u << 24}));
      const int got = ::gzread(file_.get(), out, piece);
      if (got <= 0)
        throw FileError(path_.string(), "its data end " + std::to_string(count) +
                                            " bytes too early; the file is truncated or damaged");
      out += got;
      count -= static_cast<std::size_t>(got);
      left_ -= static_cast<std::uintmax_t>(got);
    }
  }

  /// Compares the checksum behind the last byte of gzip data.
  void finish() {
    std::byte beyond{};
    if (header_.encoding == Encoding::deflate && ::gzread(file_.get(), &beyond, 1) < 0)
      throw FileError(path_.string(), "its compressed data are truncated or damaged (checksum)");
  }

private:
  /// Opens the next data file behind its header and skipped lines and bytes.
  void open_next() {
    if (next_ == files_.size())
      throw FileError(path_.string(), "its data files hold less than 'sizes' says");
    const fs::path& file = files_[next_++];
    const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0)
      throw FileError(file.string(), "cannot be opened");
    off_t start = header_.data_files.empty() ? static_cast<off_t>(header_.bytes) : 0;
    start = after_lines(descriptor, start);
    if (header_.encoding == Encoding::raw && header_.byte_skip > 0)
      start += static_cast<off_t>(header_.byte_skip);
    if (header_.encoding == Encoding::raw && header_.byte_skip == -1)
      start = std::max(start, ::lseek(descriptor, 0, SEEK_END) - static_cast<off_t>(per_file_));
    ::lseek(descriptor, start, SEEK_SET);
    // gzread passes bytes without gzip's mark through, and would unpack raw voxels that happen to begin with
    // it; raw data of that kind are refused by the size check of what comes out.
    file_.reset(::gzdopen(descriptor, "rb"));
    if (!file_) {
      ::close(descriptor);
      throw FileError(file.string(), "cannot be opened");
    }
    left_ = per_file_;
  }

  off_t after_lines(int descriptor, off_t start) const {
    for (long long line = 0; line < header_.line_skip; ++line) {
      char c = 0;
      do {
        if (::pread(descriptor, &c, 1, start) != 1)
          throw FileError(path_.string(), "has fewer lines than 'line skip' says");
        ++start;
      } while (c != '\n');
    }
    return start;
  }

  const fs::path& path_;
  const NrrdHeader& header_;
  std::vector<fs::path> files_;
  std::uintmax_t per_file_;
  std::size_t next_ = 0;
  std::uintmax_t left_ = 0;
  std::unique_ptr<gzFile_s, GzClose> file_;
};

ScalarType type_of(const NrrdHeader& header) {
  const std::string name = lower(header.fields.at("type"));
  if (name == "float")
    return ScalarType::f32;
  if (name == "double")
    return ScalarType::f64;
  const bool is_unsigned = name[0] == 'u';
  switch (header.scalar_bytes) {
  case 1:
    return is_unsigned ? ScalarType::u8 : ScalarType::i8;
  case 2:
    return is_unsigned ? ScalarType::u16 : ScalarType::i16;
  case 4:
    return is_unsigned ? ScalarType::u32 : ScalarType::i32;
  default:
    return is_unsigned ? ScalarType::u64 : ScalarType::i64;
  }
}

std::vector<double> vector_of(const fs::path& path, const std::string& field, std::string text) {
  for (char& c : text) {
    if (c == '(' || c == ')' || c == ',')
      c = ' ';
  }
  return numbers_of(path, field, text);
}

/// Turns a vector of the header's space into LPS.
glm::dvec3 lps_of(const std::string& space, glm::dvec3 v) {
  if (space.rfind("right", 0) == 0 || space == "ras" || space == "rast")
    v.x = -v.x;
  if (space.find("anterior") != std::string::npos || space == "ras" || space == "rast" || space == "las" ||
      space == "last")
    v.y = -v.y;
  return v;
}

void place(const fs::path& path, const NrrdHeader& header, Volume& volume) {
  const auto text = [&](const char* name) {
    const auto found = header.fields.find(name);
    return found == header.fields.end() ? std::string() : found->second;
  };
  const std::string space = lower(text("space"));
  const std::string directions = text("space directions");
  const std::string spacings = text("spacings");
  std::vector<double> numbers =
      directions.find('(') != std::string::npos
          ? vector_of(path, "space directions", directions.substr(0, directions.rfind(')') + 1))
          : std::vector<double>();
  if (numbers.size() == 9) {
    for (int axis = 0; axis < 3; ++axis) {
      const glm::dvec3 column = lps_of(space, {numbers[static_cast<std::size_t>(3 * axis)],
                                               numbers[static_cast<std::size_t>(3 * axis + 1)],
                                               numbers[static_cast<std::size_t>(3 * axis + 2)]});
      volume.spacing[axis] = glm::length(column);
      volume.direction[axis] = column / volume.spacing[axis];
    }
    const std::vector<double> origin = vector_of(path, "space origin", text("space origin"));
    if (origin.size() == 3)
      volume.origin = lps_of(space, {origin[0], origin[1], origin[2]});
  } else if (!spacings.empty()) {
    const std::vector<double> values = numbers_of(path, "spacings", spacings);
    int axis = 0;
    for (std::size_t k = 0; k < values.size() && k < header.axes.size(); ++k) {
      if (header.axes[k] == Axis::space)
        volume.spacing[axis++] = std::abs(values[k]);
    }
  }
  const double determinant = glm::determinant(volume.direction);
  if (!(std::abs(determinant) > 1e-6) || !std::isfinite(glm::length(volume.origin)))
    throw FileError(path.string(),
                    "'space directions' or 'space origin' hold no three independent directions");
}

/// Components first, space next, frames last: read here, because ITK knows neither frames beside a 3D space
/// nor a space without directions. Only the frame that is asked for is kept.
Volume read_directly(const fs::path& path, const NrrdHeader& header, std::size_t frame) {
  if (header.encoding != Encoding::raw && header.encoding != Encoding::deflate)
    throw FileError(path.string(), "frames in 'encoding: " + header.fields.at("encoding") +
                                       "' are not supported; write it as raw or gzip");
  Volume volume;
  volume.format = "NRRD";
  volume.type = type_of(header);
  std::size_t space_axis = 0;
  for (std::size_t axis = 0; axis < header.axes.size(); ++axis) {
    const auto size = static_cast<std::size_t>(header.sizes[axis]);
    if (header.axes[axis] == Axis::space)
      volume.dims[space_axis++] = size;
    else if (header.axes[axis] == Axis::frame)
      volume.frames = size;
    else if (axis == 0)
      volume.components = static_cast<int>(size);
    else
      throw FileError(path.string(), "has its components on axis " + std::to_string(axis) +
                                         "; beside frames they must be the first axis");
  }
  if (frame >= volume.frames)
    throw UsageError("volume.frame is " + std::to_string(frame) + " but " + path.string() + " has " +
                     std::to_string(volume.frames) + " frame(s), counted from 0");
  place(path, header, volume);
  const std::size_t bytes = voxel_bytes(volume);
  check_memory(path, bytes);
  NrrdStream stream(path, header, checked_product(bytes, volume.frames, path.string()));
  stream.skip(static_cast<std::uintmax_t>(frame) * bytes);
  volume.voxels.resize(bytes);
  stream.read(volume.voxels.data(), bytes);
  if (frame + 1 == volume.frames)
    stream.finish();
  const bool big = lower(header.fields.count("endian") > 0 ? header.fields.at("endian") : "") == "big";
  if (header.scalar_bytes > 1 && big != (std::endian::native == std::endian::big))
    swap_bytes(volume.voxels, size_of(volume.type));
  return volume;
}

} // namespace

Volume read_nrrd(const fs::path& path, std::size_t frame, const Progress& progress) {
  const NrrdHeader header = parse_nrrd(path);
  const bool list_first = header.axes.front() == Axis::frame && header.axes.size() > 1;
  const bool has_frames = header.axes.back() == Axis::frame;
  const bool space_only = header.fields.count("space") > 0 && header.fields.count("space directions") == 0;
  if (has_frames || (space_only && !list_first))
    return read_directly(path, header, frame);
  Volume volume;
  with_libraries(path, progress, [&] {
    const auto io = itk::NrrdImageIO::New();
    io->SetFileName(path.string());
    io->ReadImageInformation();
    volume = header_of(*io, path, list_first);
    volume.format = "NRRD";
    read_frame(*io, path, frame, volume, list_first);
  });
  return volume;
}

} // namespace slicelens
