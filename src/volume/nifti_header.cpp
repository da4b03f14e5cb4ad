#include "volume/nifti_header.h"

#include "core/errors.h"
#include "core/text.h"
#include "volume/file_checks.h"

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>

namespace slicelens {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t nifti1_bytes = 348;
constexpr std::size_t nifti2_bytes = 540;

/// Up to `limit` leading bytes of a file, decompressed when it is gzip.
std::string inflated_head(const fs::path& path, std::size_t limit) {
  const gzFile file = ::gzopen(path.c_str(), "rb");
  if (file == nullptr)
    throw FileError(path.string(), "cannot be opened");
  std::string head(limit, '\0');
  const int count = ::gzread(file, head.data(), static_cast<unsigned>(limit));
  ::gzclose(file);
  head.resize(count > 0 ? static_cast<std::size_t>(count) : 0);
  return head;
}

template <class T>
T field_at(const std::string& head, std::size_t offset, bool swapped) {
  std::array<char, sizeof(T)> bytes{};
  std::memcpy(bytes.data(), head.data() + offset, sizeof(T));
  if (swapped)
    std::reverse(bytes.begin(), bytes.end());
  T value;
  std::memcpy(&value, bytes.data(), sizeof(T));
  return value;
}

/// The fields of both versions under one set of names.
struct Fields {
  std::array<long long, 8> dim{};
  std::array<double, 8> pixdim{};
  int datatype = 0;
  int intent = 0;
  double vox_offset = 0;
  double slope = 0;
  double intercept = 0;
  int units = 0;
  int qform_code = 0;
  int sform_code = 0;
  std::array<double, 3> quaternion{};
  std::array<double, 3> offset{};
  std::array<double, 12> srow{};
};

Fields fields1(const std::string& head, bool swapped) {
  Fields f;
  for (std::size_t i = 0; i < 8; ++i) {
    f.dim[i] = field_at<std::int16_t>(head, 40 + 2 * i, swapped);
    f.pixdim[i] = static_cast<double>(field_at<float>(head, 76 + 4 * i, swapped));
  }
  const auto real = [&](std::size_t at) { return static_cast<double>(field_at<float>(head, at, swapped)); };
  f.datatype = field_at<std::int16_t>(head, 70, swapped);
  f.intent = field_at<std::int16_t>(head, 68, swapped);
  f.vox_offset = real(108);
  f.slope = real(112);
  f.intercept = real(116);
  f.units = head[123];
  f.qform_code = field_at<std::int16_t>(head, 252, swapped);
  f.sform_code = field_at<std::int16_t>(head, 254, swapped);
  for (std::size_t i = 0; i < 3; ++i) {
    f.quaternion[i] = real(256 + 4 * i);
    f.offset[i] = real(268 + 4 * i);
  }
  for (std::size_t i = 0; i < 12; ++i)
    f.srow[i] = real(280 + 4 * i);
  return f;
}

Fields fields2(const std::string& head, bool swapped) {
  Fields f;
  const auto real = [&](std::size_t at) { return field_at<double>(head, at, swapped); };
  for (std::size_t i = 0; i < 8; ++i) {
    f.dim[i] = field_at<std::int64_t>(head, 16 + 8 * i, swapped);
    f.pixdim[i] = real(104 + 8 * i);
  }
  f.datatype = field_at<std::int16_t>(head, 12, swapped);
  f.intent = field_at<std::int32_t>(head, 504, swapped);
  f.vox_offset = static_cast<double>(field_at<std::int64_t>(head, 168, swapped));
  f.slope = real(176);
  f.intercept = real(184);
  f.qform_code = field_at<std::int32_t>(head, 344, swapped);
  f.sform_code = field_at<std::int32_t>(head, 348, swapped);
  for (std::size_t i = 0; i < 3; ++i) {
    f.quaternion[i] = real(352 + 8 * i);
    f.offset[i] = real(376 + 8 * i);
  }
  for (std::size_t i = 0; i < 12; ++i)
    f.srow[i] = real(400 + 8 * i);
  f.units = field_at<std::int32_t>(head, 500, swapped);
  return f;
}

void set_type(const fs::path& path, int datatype, NiftiHeader& header) {
  header.components_in_voxel = datatype == 128 ? 3 : datatype == 2304 ? 4 : 1;
  switch (datatype) {
  case 2:
  case 128:
  case 2304:
    header.stored_type = ScalarType::u8;
    return;
  case 4:
    header.stored_type = ScalarType::i16;
    return;
  case 8:
    header.stored_type = ScalarType::i32;
    return;
  case 16:
    header.stored_type = ScalarType::f32;
    return;
  case 64:
    header.stored_type = ScalarType::f64;
    return;
  case 256:
    header.stored_type = ScalarType::i8;
    return;
  case 512:
    header.stored_type = ScalarType::u16;
    return;
  case 768:
    header.stored_type = ScalarType::u32;
    return;
  case 1024:
    header.stored_type = ScalarType::i64;
    return;
  case 1280:
    header.stored_type = ScalarType::u64;
    return;
  case 32:
  case 1792:
  case 2048:
    throw FileError(path.string(), "'datatype' " + std::to_string(datatype) +
                                       " is complex numbers; write magnitude or one part as scalars");
  default:
    throw FileError(path.string(), "'datatype' " + std::to_string(datatype) +
                                       " is not supported; integers of 8 to 64 bits, float, double, RGB are");
  }
}

/// RAS from voxel index: the method 2 (qform) and method 3 (sform) of nifti1.h, else the voxel sizes alone.
glm::dmat4 ras_from_index(const Fields& f) {
  glm::dmat4 m(1);
  if (f.sform_code > 0) {
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 4; ++column)
        m[column][row] = f.srow[static_cast<std::size_t>(4 * row + column)];
    }
    return m;
  }
  const glm::dvec3 size(f.pixdim[1], f.pixdim[2], f.pixdim[3]);
  if (f.qform_code > 0) {
    const double b = f.quaternion[0];
    const double c = f.quaternion[1];
    const double d = f.quaternion[2];
    const double a = std::sqrt(std::max(0.0, 1 - (b * b + c * c + d * d)));
    const double qfac = f.pixdim[0] < 0 ? -1 : 1;
    m[0] = glm::dvec4(a * a + b * b - c * c - d * d, 2 * (b * c + a * d), 2 * (b * d - a * c), 0) * size.x;
    m[1] = glm::dvec4(2 * (b * c - a * d), a * a + c * c - b * b - d * d, 2 * (c * d + a * b), 0) * size.y;
    m[2] = glm::dvec4(2 * (b * d + a * c), 2 * (c * d - a * b), a * a + d * d - b * b - c * c, 0) *
           (size.z * qfac);
    m[3] = glm::dvec4(f.offset[0], f.offset[1], f.offset[2], 1);
    return m;
  }
  for (int axis = 0; axis < 3; ++axis)
    m[axis][axis] = size[axis];
  return m;
}

void set_affine(const fs::path& path, const Fields& f, NiftiHeader& header) {
  for (std::size_t axis = 1; axis <= 3 && axis <= static_cast<std::size_t>(f.dim[0]); ++axis) {
    if (!std::isfinite(f.pixdim[axis]))
      throw FileError(path.string(), "'pixdim[" + std::to_string(axis) + "]' is " +
                                         number_text(f.pixdim[axis]) + "; a finite number is needed");
  }
  const double unit = (f.units & 7) == 1 ? 1000 : (f.units & 7) == 3 ? 0.001 : 1; // to mm
  // ITK's decomposition of the axes does not end for numbers whose squares overflow a float.
  const auto refuse_wild = [&](const std::string& field, const auto& numbers) {
    for (const double number : numbers) {
      if (!(std::abs(number) < 1e9))
        throw FileError(path.string(),
                        "the " + field + " holds " + number_text(number) + "; the header is damaged");
    }
  };
  if (f.sform_code > 0)
    refuse_wild("sform", f.srow);
  if (f.qform_code > 0) {
    refuse_wild("qform", f.quaternion);
    refuse_wild("qform", f.offset);
  }
  refuse_wild("pixdim", std::array<double, 3>{f.pixdim[1], f.pixdim[2], f.pixdim[3]});
  header.affine = ras_from_index(f);
  std::array<glm::dvec3, 3> axes;
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 3; ++row) {
      // LPS = (−R, −A, S)
      header.affine[column][row] *= row < 2 ? -unit : unit;
      if (!std::isfinite(header.affine[column][row]))
        throw FileError(path.string(), std::string("the ") + (f.sform_code > 0 ? "sform" : "qform") +
                                           " holds " + number_text(header.affine[column][row]) +
                                           "; finite numbers are needed");
    }
    if (column < 3)
      axes[static_cast<std::size_t>(column)] = glm::dvec3(header.affine[column]);
  }
  for (std::size_t a = 0; a < 3; ++a) {
    const glm::dvec3 u = axes[a];
    const glm::dvec3 v = axes[(a + 1) % 3];
    // 1e-3 in the cosine (0.06°) is above what float rounding of rotated axes gives.
    if (std::abs(glm::dot(u, v)) > 1e-3 * glm::length(u) * glm::length(v))
      header.sheared = true;
  }
}

fs::path image_of_pair(const fs::path& header) {
  const std::string text = header.string();
  const bool packed = header.extension() == ".gz";
  const std::string stem = packed ? text.substr(0, text.size() - 7) : text.substr(0, text.size() - 4);
  std::error_code error;
  for (const char* extension : {".img", ".img.gz", ".IMG"}) {
    if (fs::exists(stem + extension, error))
      return stem + extension;
  }
  throw FileError(text, "its data file '" + fs::path(stem).filename().string() +
                            ".img' is missing; put it beside the header");
}

} // namespace

fs::path nifti_header_file(const fs::path& path) {
  const std::string text = path.string();
  const std::string name = lower(text);
  const auto ends = [&](const std::string& end) {
    return name.size() >= end.size() && name.compare(name.size() - end.size(), end.size(), end) == 0;
  };
  std::error_code error;
  for (const char* image : {".img", ".img.gz"}) {
    if (!ends(image))
      continue;
    const std::string stem = text.substr(0, text.size() - std::strlen(image));
    for (const char* extension : {".hdr", ".hdr.gz", ".HDR"}) {
      if (fs::exists(stem + extension, error))
        return stem + extension;
    }
    throw FileError(text, "its header '" + fs::path(stem).filename().string() + ".hdr' is missing");
  }
  return path;
}

NiftiHeader scan_nifti(const fs::path& given) {
  require_file(given);
  const fs::path path = nifti_header_file(given);
  require_file(path);
  const std::string head = inflated_head(path, nifti2_bytes);
  if (head.size() < nifti1_bytes)
    throw FileError(path.string(), "is shorter than a NIfTI header of 348 bytes; the file is truncated");
  NiftiHeader header;
  bool known = false;
  for (const bool swapped : {false, true}) {
    const auto size = field_at<std::int32_t>(head, 0, swapped);
    if (size == 348 || (size == 540 && head.size() >= nifti2_bytes)) {
      header.swapped = swapped;
      header.version = size == 540 ? 2 : 1;
      known = true;
    }
  }
  if (!known)
    throw FileError(path.string(), "'sizeof_hdr' is neither 348 nor 540; it is no NIfTI file or damaged");
  const std::string magic = header.version == 2 ? head.substr(4, 3) : head.substr(344, 3);
  const Fields f = header.version == 2 ? fields2(head, header.swapped) : fields1(head, header.swapped);
  header.pair = magic != "n+1" && magic != "n+2";
  if (header.pair && magic != "ni1" && magic != "ni2")
    header.version = 0;

  if (f.dim[0] < 1 || f.dim[0] > 7)
    throw FileError(path.string(),
                    "'dim[0]' is " + std::to_string(f.dim[0]) + "; 1 to 7 dimensions are possible");
  for (std::size_t axis = 1; axis <= static_cast<std::size_t>(f.dim[0]); ++axis)
    header.dims[axis - 1] = f.dim[axis];
  if (f.intent >= 3000 && f.intent < 3100)
    throw FileError(path.string(), "'intent_code' " + std::to_string(f.intent) +
                                       " is CIFTI (values on brain surfaces), which is no volume");
  header.intent = f.intent;
  set_type(path, f.datatype, header);
  const std::uintmax_t unit =
      size_of(header.stored_type) * static_cast<std::uintmax_t>(header.components_in_voxel);
  const std::uintmax_t claimed =
      claimed_bytes(path, "dim", std::vector<long long>(header.dims.begin(), header.dims.end()), unit);
  if (!std::isfinite(f.vox_offset) || f.vox_offset < 0 || f.vox_offset > 1e15)
    throw FileError(path.string(),
                    "'vox_offset' is " + number_text(f.vox_offset) + "; the header is damaged");
  header.data_offset = static_cast<std::uintmax_t>(f.vox_offset);
  if (!header.pair && header.data_offset < (header.version == 2 ? nifti2_bytes : nifti1_bytes))
    header.data_offset = header.version == 2 ? 544 : 352;
  if (header.version > 0 && std::isfinite(f.slope) && f.slope != 0) {
    header.slope = f.slope;
    header.intercept = std::isfinite(f.intercept) ? f.intercept : 0;
  }
  set_affine(path, f, header);

  header.data_file = header.pair ? image_of_pair(path) : path;
  const std::uintmax_t bytes = require_file(header.data_file);
  const std::string start = head_of(header.data_file, 2);
  if (start == "\x1f\x8b")
    check_claim(path, "dim", claimed, bytes, Encoding::deflate);
  else
    check_claim(path, "dim", claimed, bytes - std::min(bytes, header.data_offset), Encoding::raw);
  return header;
}

} // namespace slicelens
