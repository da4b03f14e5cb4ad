// The structure of a DICOM file, walked element by element (PS3.5 §7, PS3.10 §7). GDCM asserts on files whose
// lengths lie, which ends the program, so no file reaches it that this walk has not found whole. Private to
// src/volume.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace slicelens {

struct DicomHeader {
  std::string transfer_syntax; ///< UID
  bool encapsulated = false;   ///< pixel data in compressed fragments
  bool big_endian = false;     ///< byte order of binary values
  std::map<std::uint32_t, std::string>
      values; ///< group << 16 | element → bytes; top level, up to 64 KiB each
  /// Of the functional groups of an enhanced multi-frame file (PS3.3 C.7.6.16): the values of Image Position,
  /// Image Orientation and Pixel Spacing, one for each frame in order or one for all.
  std::map<std::uint32_t, std::vector<std::string>> frame_values;
  bool has_pixels = false;
  std::uintmax_t pixel_bytes = 0; ///< stored bytes of the pixel data

  /// Text without padding; "" when the element is missing.
  std::string text(std::uint32_t tag) const;
  /// An unsigned 16-bit value; `other` when the element is missing.
  std::size_t number(std::uint32_t tag, std::size_t other) const;
};

/// Walks the whole file. Throws FileError when it is truncated, an element reaches beyond what holds it, or
/// its structure is not DICOM's.
DicomHeader scan_dicom_structure(const std::filesystem::path& path);

} // namespace slicelens
