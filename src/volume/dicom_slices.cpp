#include "volume/dicom_slices.h"

#include "core/errors.h"
#include "volume/file_checks.h"
#include "volume/file_stamp.h"
#include "volume/itk_reading.h"

#include <itkGDCMImageIO.h>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <limits>
#include <list>
#include <mutex>
#include <set>
#include <utility>

namespace slicelens {

namespace fs = std::filesystem;

namespace {

/// GDCM gives 32-bit integers to what 16 stored bits could become by the rescale (a CT whose 16 bits are not
/// used in full); when the values fit 16 bits they are kept in 16.
void narrow(Volume& image) {
  if (image.type != ScalarType::i32)
    return;
  const auto* const values = reinterpret_cast<const std::int32_t*>(image.voxels.data());
  const auto [low, high] = std::minmax_element(values, values + image.voxels.size() / sizeof(std::int32_t));
  if (*low < std::numeric_limits<std::int16_t>::min() || *high > std::numeric_limits<std::int16_t>::max())
    return;
  image.voxels = converted(image.voxels, ScalarType::i32, ScalarType::i16);
  image.type = ScalarType::i16;
}

/// Lines of GDCM that say nothing a user could act on: what it tried before it found the decoder, and that a
/// file has no place in the world, which is said once below.
bool is_noise(const std::string& message) {
  for (const char* text :
       {"Unsupported JPEG data precision", "DICOM header said it was", "more bits actually stored on disk",
        "Could not find Spacing", "Could not find Origin", "Image Orientation (Patient) was not found"}) {
    if (message.find(text) != std::string::npos)
      return true;
  }
  return false;
}

/// What GDCM says of one file, and its voxels where they are wanted.
Volume picture_of(const DicomFile& slice, bool voxels, const Progress& progress) {
  Volume image;
  with_libraries(slice.file, progress, [&] {
    const auto io = itk::GDCMImageIO::New();
    io->SetFileName(slice.file.string());
    io->ReadImageInformation();
    image = header_of(*io, slice.file);
    if (image.dims[0] != slice.columns || image.dims[1] != slice.rows)
      throw FileError(slice.file.string(),
                      "its Rows and Columns do not fit its pixel data; the file is damaged");
    if (voxels)
      read_frame(*io, slice.file, 0, image);
  });
  return image;
}

/// Bytes of decoded slices that a stream keeps.
constexpr std::size_t kept_bytes = std::size_t{128} << 20;

class DicomStream : public VoxelStream {
public:
  DicomStream(const DicomStack& stack, ScalarType type) : slices_(stack.slices), type_(type) {
    for (const DicomFile& slice : slices_)
      stamps_.push_back(stamp_of(slice.file));
  }

  void read(const VoxelBox& box, std::span<std::byte> out) const override {
    const std::lock_guard lock(mutex_);
    const std::size_t scalar = size_of(type_);
    const std::size_t nx = slices_.front().columns;
    std::byte* to = out.data();
    for (std::size_t k = 0; k < box.size[2]; ++k) {
      const std::vector<std::byte>& slice = decoded(box.first[2] + k);
      for (std::size_t j = 0; j < box.size[1]; ++j, to += box.size[0] * scalar) {
        const std::size_t from = (box.first[1] + j) * nx + box.first[0];
        std::memcpy(to, slice.data() + from * scalar, box.size[0] * scalar);
      }
    }
  }

  std::array<std::size_t, 3> grain() const override {
    return {slices_.front().columns, slices_.front().rows, 1};
  }
  std::uint64_t bytes_read() const override { return bytes_read_; }

private:
  struct Kept {
    std::size_t slice;
    std::vector<std::byte> voxels;
  };

  const std::vector<std::byte>& decoded(std::size_t k) const {
    const auto found =
        std::find_if(kept_.begin(), kept_.end(), [&](const Kept& one) { return one.slice == k; });
    if (found != kept_.end()) {
      kept_.splice(kept_.begin(), kept_, found);
      return kept_.front().voxels;
    }
    std::vector<std::byte> voxels = decode(k);
    const std::size_t most = std::max<std::size_t>(1, kept_bytes / voxels.size());
    while (kept_.size() >= most)
      kept_.pop_back();
    kept_.push_front({k, std::move(voxels)});
    return kept_.front().voxels;
  }

  std::vector<std::byte> decode(std::size_t k) const {
    const fs::path& file = slices_[k].file;
    const auto require_same = [&] { require_unchanged(file, stamps_[k], stamp_of(file)); };
    Volume slice;
    try {
      slice = read_one(slices_[k], {}); // what there is to warn of was said when it was opened
    } catch (const FileError&) {
      require_same(); // says more than what the decoder stumbled over
      throw;
    }
    require_same();
    bytes_read_ += stamps_[k].size;
    // The types were found on the same files.
    return slice.type == type_ ? std::move(slice.voxels) : converted(slice.voxels, slice.type, type_);
  }

  std::vector<DicomFile> slices_;
  std::vector<FileStamp> stamps_;
  ScalarType type_;
  mutable std::mutex mutex_;
  mutable std::list<Kept> kept_; ///< the last used first
  mutable std::atomic<std::uint64_t> bytes_read_{0};
};

} // namespace

ScalarType type_for_both(ScalarType a, ScalarType b) {
  const auto range = [](ScalarType type) {
    return visit_scalar_type(type, [](auto* tag) {
      using T = std::remove_pointer_t<decltype(tag)>;
      return std::pair(static_cast<double>(std::numeric_limits<T>::lowest()),
                       static_cast<double>(std::numeric_limits<T>::max()));
    });
  };
  const bool real =
      a == ScalarType::f32 || a == ScalarType::f64 || b == ScalarType::f32 || b == ScalarType::f64;
  const auto [a_low, a_high] = range(a);
  const auto [b_low, b_high] = range(b);
  if (!real) {
    for (const ScalarType type : {ScalarType::u8, ScalarType::i8, ScalarType::u16, ScalarType::i16,
                                  ScalarType::u32, ScalarType::i32}) {
      const auto [low, high] = range(type);
      if (low <= std::min(a_low, b_low) && high >= std::max(a_high, b_high))
        return type;
    }
    return ScalarType::f64;
  }
  const bool wide = size_of(a) > 4 || size_of(b) > 4 || a == ScalarType::i32 || b == ScalarType::i32 ||
                    a == ScalarType::u32 || b == ScalarType::u32;
  return wide ? ScalarType::f64 : ScalarType::f32;
}

std::vector<std::byte> converted(const std::vector<std::byte>& scalars, ScalarType from, ScalarType to) {
  std::vector<std::byte> result(checked_product(scalars.size() / size_of(from), size_of(to), "volume"));
  visit_scalar_type(from, [&](auto* from_tag) {
    using From = std::remove_pointer_t<decltype(from_tag)>;
    const From* in = reinterpret_cast<const From*>(scalars.data());
    visit_scalar_type(to, [&](auto* to_tag) {
      using To = std::remove_pointer_t<decltype(to_tag)>;
      To* out = reinterpret_cast<To*>(result.data());
      for (std::size_t i = 0; i < scalars.size() / sizeof(From); ++i)
        out[i] = static_cast<To>(in[i]);
    });
  });
  return result;
}

Progress saying_once(const Progress& progress) {
  Progress once = progress;
  once.warn = [progress, said = std::set<std::string>()](const std::string& message) mutable {
    if (!is_noise(message) &&
        said.insert(message.substr(std::min(message.size(), message.find(": ")))).second)
      report_warning(progress, message);
  };
  return once;
}

Volume read_one(const DicomFile& slice, const Progress& progress) {
  Volume image = picture_of(slice, true, progress);
  narrow(image);
  return image;
}

void require_components(const Volume& slice, int components, const fs::path& file) {
  if (slice.components != components)
    throw FileError(file.string(), "has " + std::to_string(slice.components) +
                                       " components but the slices before have " +
                                       std::to_string(components));
}

void place_stack(Volume& volume, const DicomStack& stack) {
  volume.format = "DICOM";
  volume.frames = stack.frames;
  if (stack.slices.size() == 1)
    return;
  volume.dims[2] = stack.slices.size();
  volume.spacing.z = stack.spacing.value_or(1);
  if (stack.spacing) {
    volume.direction[2] = *stack.axis;
    volume.origin = *stack.slices.front().position;
  }
}

bool is_sliced(const DicomStack& stack) { return !stack.one_file && stack.slices.size() > 1; }

Volume dicom_outline(const DicomStack& stack, const Progress& progress) {
  Volume volume = picture_of(stack.slices.front(), false, progress);
  place_stack(volume, stack);
  return volume;
}

ScalarType dicom_type(const DicomStack& stack, int components, const Progress& progress) {
  std::optional<ScalarType> type;
  for (const DicomFile& slice : stack.slices) {
    Volume image = picture_of(slice, false, progress);
    require_components(image, components, slice.file);
    if (image.type == ScalarType::i32) // which may become 16 bits
      image = read_one(slice, progress);
    type = type ? type_for_both(*type, image.type) : image.type;
    report_progress(progress, "load",
                    static_cast<double>(&slice - stack.slices.data() + 1) /
                        static_cast<double>(stack.slices.size()));
  }
  return *type;
}

std::unique_ptr<const VoxelStream> dicom_stream(const DicomStack& stack, ScalarType type) {
  return std::make_unique<DicomStream>(stack, type);
}

} // namespace slicelens
