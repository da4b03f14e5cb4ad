#include "volume/dicom_header.h"

#include "core/errors.h"
#include "volume/file_checks.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <string_view>
#include <vector>

namespace slicelens {

namespace fs = std::filesystem;

namespace {

constexpr std::uint32_t undefined = 0xffffffff;
constexpr std::uint32_t item_tag = 0xfffee000;
constexpr std::uint32_t item_end = 0xfffee00d;
constexpr std::uint32_t sequence_end = 0xfffee0dd;
constexpr std::uint32_t pixel_data = 0x7fe00010;

/// A file's bytes in memory while one lives.
class MappedFile {
public:
  MappedFile(const fs::path& path, std::uintmax_t size) : size_(static_cast<std::size_t>(size)) {
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0)
      throw FileError(path.string(), "cannot be opened");
    bytes_ = ::mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, descriptor, 0);
    ::close(descriptor);
    if (bytes_ == MAP_FAILED)
      throw FileError(path.string(), "cannot be read");
  }
  ~MappedFile() { ::munmap(bytes_, size_); }
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;
  std::string_view view() const { return {static_cast<const char*>(bytes_), size_}; }

private:
  std::size_t size_;
  void* bytes_ = nullptr;
};

struct Encoded {
  bool explicit_vr = true;
  bool big = false;
};

struct Element {
  std::uint32_t tag = 0;
  std::string vr;
  std::uint32_t length = 0;
};

/// The value representation (PS3.6) of the elements that GDCM's image reader takes, whose other types it
/// asserts against.
const char* vr_of(std::uint32_t tag) {
  static const std::map<std::uint32_t, const char*> known = {
      {0x00020002, "UI"}, {0x00020003, "UI"}, {0x00020010, "UI"}, {0x00080008, "CS"}, {0x00080016, "UI"},
      {0x00080018, "UI"}, {0x00080060, "CS"}, {0x00180050, "DS"}, {0x00180088, "DS"}, {0x00181164, "DS"},
      {0x00182010, "DS"}, {0x0020000d, "UI"}, {0x0020000e, "UI"}, {0x00200032, "DS"}, {0x00200037, "DS"},
      {0x00280002, "US"}, {0x00280004, "CS"}, {0x00280006, "US"}, {0x00280008, "IS"}, {0x00280009, "AT"},
      {0x00280010, "US"}, {0x00280011, "US"}, {0x00280030, "DS"}, {0x00280034, "IS"}, {0x00280100, "US"},
      {0x00280101, "US"}, {0x00280102, "US"}, {0x00280103, "US"}, {0x00281050, "DS"}, {0x00281051, "DS"},
      {0x00281052, "DS"}, {0x00281053, "DS"}, {0x00281054, "LO"}, {0x00282110, "CS"}, {0x3002000e, "DS"},
      {0x3004000c, "DS"}, {0x00540081, "US"}, {0x30020011, "DS"}, {0x00280014, "US"}, {0x00280005, "US"}};
  const auto found = known.find(tag);
  return found == known.end() ? nullptr : found->second;
}

std::string tag_text(std::uint32_t tag) {
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), "(%04x,%04x)", tag >> 16, tag & 0xffff);
  return text.data();
}

class Walker {
public:
  Walker(const fs::path& path, std::string_view bytes, DicomHeader& header)
      : path_(path), bytes_(bytes), header_(header) {}

  /// The elements from `at` to `end`; with `delimited` an item's end mark closes them. Returns where they
  /// end.
  std::size_t dataset(std::size_t at, std::size_t end, Encoded encoded, int depth, bool delimited) {
    if (depth > 32)
      damaged("its sequences are nested too deeply");
    while (at < end) {
      if (end - at < 8) {
        if (delimited || bytes_.substr(at, end - at).find_first_not_of('\0') != std::string_view::npos)
          damaged("ends in the middle of an element; the file is truncated");
        return end;
      }
      if (delimited && tag_at(at, encoded) == item_end)
        return at + 8;
      const Element element = next(at, end, encoded);
      at = contents(element, at, end, encoded, depth);
    }
    if (delimited)
      damaged("ends before a sequence does; the file is truncated");
    return at;
  }

  /// The file meta group: explicit VR, little endian. Returns where the data set begins.
  std::size_t meta(std::size_t at) {
    const Encoded encoded;
    while (bytes_.size() - at >= 8 && tag_at(at, encoded) >> 16 == 2) {
      const Element element = next(at, bytes_.size(), encoded);
      at = contents(element, at, bytes_.size(), encoded, 0);
    }
    return at;
  }

  std::uint16_t u16(std::size_t at, bool big) const {
    const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(bytes_[at + k]); };
    return static_cast<std::uint16_t>(big ? byte(0) << 8 | byte(1) : byte(1) << 8 | byte(0));
  }
  std::uint32_t u32(std::size_t at, bool big) const {
    const std::uint32_t a = u16(at, big);
    const std::uint32_t b = u16(at + 2, big);
    return big ? a << 16 | b : b << 16 | a;
  }
  std::uint32_t tag_at(std::size_t at, Encoded encoded) const {
    return static_cast<std::uint32_t>(u16(at, encoded.big)) << 16 | u16(at + 2, encoded.big);
  }

private:
  [[noreturn]] void damaged(const std::string& what) const { throw FileError(path_.string(), what); }

  /// Tag, VR and length of the element at `at`, which moves to its value.
  Element next(std::size_t& at, std::size_t end, Encoded encoded) const {
    Element element;
    element.tag = tag_at(at, encoded);
    const bool mark = element.tag >> 16 == 0xfffe; // items have neither VR nor short lengths
    if (!encoded.explicit_vr || mark) {
      element.length = u32(at + 4, encoded.big);
      at += 8;
    } else {
      element.vr = std::string(bytes_.substr(at + 4, 2));
      static const std::vector<std::string> wide = {"OB", "OW", "OF", "OD", "OL", "OV", "SQ",
                                                    "UC", "UR", "UT", "UN", "SV", "UV"};
      static const std::vector<std::string> narrow = {"AE", "AS", "AT", "CS", "DA", "DS", "DT",
                                                      "FL", "FD", "IS", "LO", "LT", "PN", "SH",
                                                      "SL", "SS", "ST", "TM", "UI", "UL", "US"};
      if (std::find(wide.begin(), wide.end(), element.vr) == wide.end() &&
          std::find(narrow.begin(), narrow.end(), element.vr) == narrow.end())
        damaged("element " + tag_text(element.tag) + " has no value representation; the file is damaged");
      if (std::find(wide.begin(), wide.end(), element.vr) == wide.end()) {
        element.length = u16(at + 6, encoded.big);
        at += 8;
      } else {
        if (end - at < 12)
          damaged("ends in the middle of an element; the file is truncated");
        element.length = u32(at + 8, encoded.big);
        at += 12;
      }
    }
    if (element.length != undefined && element.length > end - at)
      damaged("element " + tag_text(element.tag) + " claims " + std::to_string(element.length) +
              " bytes but " + std::to_string(end - at) + " are left; the file is truncated or damaged");
    return element;
  }

  /// Steps over the value at `at` (into it for sequences), keeping what the header needs.
  std::size_t contents(const Element& element, std::size_t at, std::size_t end, Encoded encoded, int depth) {
    if (element.tag >> 16 == 0xfffe)
      damaged("has an item " + tag_text(element.tag) + " outside a sequence; the file is damaged");
    const char* const vr = vr_of(element.tag);
    if (vr != nullptr && ((!element.vr.empty() && element.vr != vr) ||
                          (std::string(vr) == "US" && element.length != 2 && element.length != 0)))
      damaged("element " + tag_text(element.tag) + " is of type '" + element.vr + "' with " +
              std::to_string(element.length) + " bytes where '" + vr + "' belongs; the file is damaged");
    if (element.tag == pixel_data && !element.vr.empty() && element.vr != "OB" && element.vr != "OW")
      damaged("its pixel data are of type '" + element.vr + "'; OB or OW belongs there");
    if (element.tag == pixel_data && depth == 0) {
      header_.has_pixels = true;
      if (element.length == undefined)
        return fragments(at, end, encoded);
      header_.pixel_bytes = element.length;
      return at + element.length;
    }
    if (element.length == undefined) {
      // UN of undefined length is implicit VR inside (PS3.5 §6.2.2, note 7).
      const Encoded inner = element.vr == "UN" ? Encoded{false, false} : encoded;
      groups_ += is_groups(element.tag) ? 1 : 0;
      at = sequence(at, end, inner, depth, true);
      groups_ -= is_groups(element.tag) ? 1 : 0;
      return at;
    }
    if (element.vr == "SQ" || (element.vr.empty() && is_known_sequence(element.tag))) {
      groups_ += is_groups(element.tag) ? 1 : 0;
      sequence(at, at + element.length, encoded, depth, false);
      groups_ -= is_groups(element.tag) ? 1 : 0;
    } else if (groups_ > 0 && is_frame_value(element.tag))
      header_.frame_values[element.tag].emplace_back(bytes_.substr(at, element.length));
    else if (depth == 0 && element.length <= 1u << 16)
      header_.values[element.tag] = std::string(bytes_.substr(at, element.length));
    return at + element.length;
  }

  std::size_t sequence(std::size_t at, std::size_t end, Encoded encoded, int depth, bool delimited) {
    while (at < end) {
      if (end - at < 8)
        damaged("ends in the middle of a sequence; the file is truncated");
      const Element item = next(at, end, encoded);
      if (delimited && item.tag == sequence_end)
        return at;
      if (item.tag != item_tag)
        damaged("has " + tag_text(item.tag) + " where a sequence's item should be; the file is damaged");
      if (item.length == undefined)
        at = dataset(at, end, encoded, depth + 1, true);
      else
        at = dataset(at, at + item.length, encoded, depth + 1, false);
    }
    if (delimited)
      damaged("ends before a sequence does; the file is truncated");
    return at;
  }

  /// Compressed pixel data: items up to the sequence's end.
  std::size_t fragments(std::size_t at, std::size_t end, Encoded encoded) {
    header_.encapsulated = true;
    while (end - at >= 8) {
      const Element item = next(at, end, encoded);
      if (item.tag == sequence_end)
        return at;
      if (item.tag != item_tag || item.length == undefined)
        damaged("its compressed pixel data are damaged");
      header_.pixel_bytes += item.length;
      check_jpeg2000(at, item.length);
      at += item.length;
    }
    damaged("ends before its compressed pixel data do; the file is truncated");
  }

  /// GDCM decodes a JPEG 2000 picture into a buffer of Rows and Columns whatever the picture's own size is
  /// (SIZ marker: ISO/IEC 15444-1 A.5.1), so the two must agree.
  void check_jpeg2000(std::size_t at, std::size_t length) const {
    if (length < 42 || u32(at, true) != 0xff4fff51)
      return;
    const std::size_t columns = header_.number(0x00280011, 0);
    const std::size_t rows = header_.number(0x00280010, 0);
    const std::size_t samples = header_.number(0x00280002, 1);
    bool agrees = u32(at + 8, true) == columns && u32(at + 12, true) == rows && u32(at + 16, true) == 0 &&
                  u32(at + 20, true) == 0 && u16(at + 40, true) == samples && length >= 42 + 3 * samples;
    for (std::size_t sample = 0; agrees && sample < samples; ++sample)
      agrees = bytes_[at + 43 + 3 * sample] == 1 && bytes_[at + 44 + 3 * sample] == 1; // no subsampling
    if (!agrees)
      damaged("a JPEG 2000 picture in it is not of Rows x Columns x Samples; the file is damaged");
  }

  /// Shared and Per-frame Functional Groups Sequence.
  static bool is_groups(std::uint32_t tag) { return tag == 0x52009229 || tag == 0x52009230; }
  /// In implicit VR a sequence is known by its tag alone: those that hold what is_frame_value names.
  static bool is_known_sequence(std::uint32_t tag) {
    return is_groups(tag) || tag == 0x00209113 || tag == 0x00209116 || tag == 0x00289110;
  }
  static bool is_frame_value(std::uint32_t tag) {
    return tag == 0x00200032 || tag == 0x00200037 || tag == 0x00280030;
  }

  int groups_ = 0; ///< functional groups that the walk is inside of
  const fs::path& path_;
  std::string_view bytes_;
  DicomHeader& header_;
};

/// The data set of the deflated transfer syntax (PS3.5 A.5: raw deflate without a zlib header).
std::string inflated(const fs::path& path, std::string_view bytes) {
  constexpr std::size_t limit = std::size_t{1} << 31;
  std::string out;
  z_stream stream{};
  if (::inflateInit2(&stream, -MAX_WBITS) != Z_OK)
    throw FileError(path.string(), "cannot be inflated");
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(std::min<std::size_t>(bytes.size(), limit));
  std::vector<char> buffer(std::size_t{1} << 16);
  int status = Z_OK;
  while (status == Z_OK && out.size() < limit) {
    stream.next_out = reinterpret_cast<Bytef*>(buffer.data());
    stream.avail_out = static_cast<uInt>(buffer.size());
    status = ::inflate(&stream, Z_NO_FLUSH);
    out.append(buffer.data(), buffer.size() - stream.avail_out);
  }
  ::inflateEnd(&stream);
  if (status != Z_STREAM_END)
    throw FileError(path.string(), "its deflated data set is truncated or damaged");
  return out;
}

} // namespace

std::string DicomHeader::text(std::uint32_t tag) const {
  const auto found = values.find(tag);
  if (found == values.end())
    return {};
  std::string text = found->second;
  text.erase(std::remove(text.begin(), text.end(), '\0'), text.end());
  return trimmed(text);
}

std::size_t DicomHeader::number(std::uint32_t tag, std::size_t other) const {
  const auto found = values.find(tag);
  if (found == values.end() || found->second.size() < 2)
    return other;
  const auto a = static_cast<unsigned char>(found->second[0]);
  const auto b = static_cast<unsigned char>(found->second[1]);
  return static_cast<std::size_t>(big_endian ? a << 8 | b : b << 8 | a);
}

DicomHeader scan_dicom_structure(const fs::path& path) {
  const MappedFile file(path, require_file(path));
  const std::string_view bytes = file.view();
  DicomHeader header;
  const bool preamble = bytes.size() >= 132 && bytes.substr(128, 4) == "DICM";
  Walker walker(path, bytes, header);
  const std::size_t start = walker.meta(preamble ? 132 : 0);
  header.transfer_syntax = header.text(0x00020010);
  if (bytes.size() - start < 8)
    throw FileError(path.string(), "ends after its header group; the file is truncated");
  if (header.transfer_syntax == "1.2.840.10008.1.2.1.99") {
    const std::string inner = inflated(path, bytes.substr(start));
    Walker(path, inner, header).dataset(0, inner.size(), {true, false}, 0, false);
    return header;
  }
  Encoded encoded;
  encoded.big = header.big_endian = header.transfer_syntax == "1.2.840.10008.1.2.2";
  encoded.explicit_vr = header.transfer_syntax != "1.2.840.10008.1.2";
  if (header.transfer_syntax.empty()) {
    const auto letter = [&](std::size_t k) { return bytes[start + k] >= 'A' && bytes[start + k] <= 'Z'; };
    encoded.explicit_vr = letter(4) && letter(5);
  }
  walker.dataset(start, bytes.size(), encoded, 0, false);
  return header;
}

} // namespace slicelens
