// VTK XML image data (.vti).
#include "core/errors.h"
#include "core/text.h"
#include "volume/file_checks.h"
#include "volume/readers.h"
#include "volume/vti_data.h"

#include <pugixml.hpp>

#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>

namespace slicelens {

namespace fs = std::filesystem;

namespace {

/// The XML of a file, and where its appended data start.
struct VtiFile {
  std::string xml;              ///< without the appended data
  std::uintmax_t appended = 0;  ///< offset of the byte after the '_', 0 without appended data
  bool appended_base64 = false; ///< else raw
  std::uintmax_t bytes = 0;     ///< length of the file
};

/// Raw appended data make the file invalid XML, so they are cut off before parsing.
VtiFile split(const fs::path& path) {
  VtiFile file;
  file.bytes = require_file(path);
  std::ifstream in(path, std::ios::binary);
  std::string& xml = file.xml;
  std::vector<char> buffer(std::size_t{1} << 16);
  const std::string mark = "<AppendedData";
  std::size_t found = std::string::npos;
  while (found == std::string::npos &&
         (in.read(buffer.data(), static_cast<std::streamsize>(buffer.size())) || in.gcount() > 0)) {
    const std::size_t from = xml.size() > mark.size() ? xml.size() - mark.size() : 0;
    xml.append(buffer.data(), static_cast<std::size_t>(in.gcount()));
    found = xml.find(mark, from);
  }
  if (found == std::string::npos)
    return file;
  while (xml.find('_', found) == std::string::npos &&
         (in.read(buffer.data(), static_cast<std::streamsize>(buffer.size())) || in.gcount() > 0))
    xml.append(buffer.data(), static_cast<std::size_t>(in.gcount()));
  const std::size_t close = xml.find('>', found);
  const std::size_t start = xml.find('_', found);
  if (close == std::string::npos || start == std::string::npos || start < close)
    throw FileError(path.string(), "its 'AppendedData' have no '_' before the data; the file is truncated");
  const std::string tag = xml.substr(found, close - found);
  file.appended_base64 = tag.find("base64") != std::string::npos;
  file.appended = start + 1;
  xml.resize(found);
  xml += "</VTKFile>";
  return file;
}

ScalarType type_of(const fs::path& path, const std::string& name) {
  static const std::map<std::string, ScalarType> types = {
      {"UInt8", ScalarType::u8},   {"Int8", ScalarType::i8},    {"UInt16", ScalarType::u16},
      {"Int16", ScalarType::i16},  {"UInt32", ScalarType::u32}, {"Int32", ScalarType::i32},
      {"UInt64", ScalarType::u64}, {"Int64", ScalarType::i64},  {"Float32", ScalarType::f32},
      {"Float64", ScalarType::f64}};
  const auto found = types.find(name);
  if (found == types.end())
    throw FileError(path.string(), "the array's type '" + one_line(name) +
                                       "' is not supported; UInt8 to Int64, Float32 and Float64 are");
  return found->second;
}

std::vector<double> triple(const fs::path& path, const pugi::xml_node& node, const char* name,
                           std::size_t count, const std::vector<double>& other) {
  const pugi::xml_attribute attribute = node.attribute(name);
  if (attribute.empty())
    return other;
  const std::vector<double> values = numbers_of(path, name, attribute.value());
  bool good = values.size() == count;
  for (const double value : values)
    good = good && std::isfinite(value);
  if (!good)
    throw FileError(path.string(),
                    "'" + std::string(name) + "' needs " + std::to_string(count) + " finite numbers");
  return values;
}

/// Dims, spacing, origin and direction. Cell values sit at the cells' centres.
void place(const fs::path& path, const pugi::xml_node& image, bool cells, Volume& volume) {
  const std::vector<long long> extent =
      integers_of(path, "WholeExtent", image.attribute("WholeExtent").value());
  if (extent.size() != 6)
    throw FileError(path.string(), "'WholeExtent' needs six integers");
  const pugi::xml_node piece = image.child("Piece");
  const std::string piece_extent = piece.attribute("Extent").value();
  if (image.select_nodes("Piece").size() != 1 ||
      (!piece_extent.empty() && integers_of(path, "Extent", piece_extent) != extent))
    throw FileError(path.string(), "has no single 'Piece' that covers 'WholeExtent'; write it in one piece");
  const auto origin = triple(path, image, "Origin", 3, {0, 0, 0});
  const auto spacing = triple(path, image, "Spacing", 3, {1, 1, 1});
  const auto direction = triple(path, image, "Direction", 9, {1, 0, 0, 0, 1, 0, 0, 0, 1});
  std::vector<long long> size;
  glm::dvec3 first(0);
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const long long low = extent[2 * a];
    const long long high = extent[2 * a + 1];
    constexpr long long most = 1LL << 40;
    if (low < -most || high > most || high < low)
      throw FileError(path.string(), "'WholeExtent' runs from " + std::to_string(low) + " to " +
                                         std::to_string(high) + "; it must hold at least one point an axis");
    if (!(spacing[a] > 0))
      throw FileError(path.string(),
                      "'Spacing' holds " + number_text(spacing[a]) + "; numbers above 0 are needed");
    size.push_back(high - low + (cells ? 0 : 1));
    volume.spacing[axis] = spacing[a];
    first[axis] = (static_cast<double>(low) + (cells ? 0.5 : 0.0)) * spacing[a];
    for (int row = 0; row < 3; ++row) // row-major in the file
      volume.direction[axis][row] = direction[static_cast<std::size_t>(3 * row + axis)];
    const double length = glm::length(volume.direction[axis]);
    if (!(length > 1e-9))
      throw FileError(path.string(), "'Direction' has an axis without length");
    volume.direction[axis] /= length;
  }
  if (std::abs(glm::determinant(volume.direction)) < 1e-6)
    throw FileError(path.string(), "'Direction' has axes in one plane");
  volume.origin = glm::dvec3(origin[0], origin[1], origin[2]) + volume.direction * first;
  claimed_bytes(path, "WholeExtent", size, 32); // 4 components of 8 bytes at most: refuses overflow
  for (std::size_t axis = 0; axis < 3; ++axis)
    volume.dims[axis] = static_cast<std::size_t>(size[axis]);
}

/// The array that a renderer shows: the one that is marked as Scalars, else the first.
pugi::xml_node array_of(const pugi::xml_node& data) {
  const char* const scalars = data.attribute("Scalars").value();
  for (const pugi::xml_node& array : data.children("DataArray")) {
    if (scalars[0] != '\0' && std::strcmp(array.attribute("Name").value(), scalars) == 0)
      return array;
  }
  return data.child("DataArray");
}

VtiStorage storage_of(const fs::path& path, const pugi::xml_node& root) {
  VtiStorage storage;
  storage.big_endian = std::strcmp(root.attribute("byte_order").value(), "BigEndian") == 0;
  const std::string header = root.attribute("header_type").as_string("UInt32");
  if (header != "UInt32" && header != "UInt64")
    throw FileError(path.string(), "'header_type' is '" + one_line(header) + "'; UInt32 or UInt64 is needed");
  storage.header_bytes = header == "UInt64" ? 8 : 4;
  const std::string compressor = root.attribute("compressor").value();
  if (!compressor.empty() && compressor != "vtkZLibDataCompressor")
    throw FileError(path.string(),
                    "'compressor' is '" + one_line(compressor) +
                        "', which is not supported; write it with vtkZLibDataCompressor or none");
  storage.zlib = !compressor.empty();
  return storage;
}

void read_appended(const fs::path& path, const VtiFile& file, const VtiStorage& storage,
                   const pugi::xml_node& array, Volume& volume) {
  const auto offset = integers_of(path, "offset", array.attribute("offset").value());
  if (file.appended == 0 || offset.size() != 1 || offset[0] < 0 ||
      static_cast<std::uintmax_t>(offset[0]) >= file.bytes - file.appended)
    throw FileError(path.string(),
                    "'offset' of the array points behind the end of the appended data; the file "
                    "is truncated");
  const std::uintmax_t start = file.appended + static_cast<std::uintmax_t>(offset[0]);
  auto in = std::make_shared<std::ifstream>(path, std::ios::binary);
  in->seekg(static_cast<std::streamoff>(start));
  if (file.appended_base64) {
    read_array(path, storage, base64_source(path, [in] { return in->get(); }), file.bytes - start, volume);
    return;
  }
  const ByteSource source = [&](std::byte* out, std::size_t count) {
    if (!in->read(reinterpret_cast<char*>(out), static_cast<std::streamsize>(count)))
      throw FileError(path.string(), "ends before its data do; the file is truncated");
  };
  read_array(path, storage, source, file.bytes - start, volume);
}

} // namespace

Volume read_vti(const fs::path& path, const Progress&) {
  VtiFile file = split(path);
  pugi::xml_document document;
  // In place: inline data stay in `file.xml`, one copy.
  const pugi::xml_parse_result parsed = document.load_buffer_inplace(file.xml.data(), file.xml.size());
  if (!parsed)
    throw FileError(path.string(), std::string("is no valid XML: ") + parsed.description() + " at byte " +
                                       std::to_string(parsed.offset));
  const pugi::xml_node root = document.child("VTKFile");
  const pugi::xml_node image = root.child("ImageData");
  if (image.empty())
    throw FileError(path.string(), "holds '" + one_line(root.attribute("type").value()) +
                                       "'; a VTKFile with ImageData is needed");
  const VtiStorage storage = storage_of(path, root);
  const pugi::xml_node piece = image.child("Piece");
  const bool cells = array_of(piece.child("PointData")).empty();
  const pugi::xml_node array = array_of(piece.child(cells ? "CellData" : "PointData"));
  if (array.empty())
    throw FileError(path.string(), "has no 'DataArray' in PointData or CellData");

  Volume volume;
  volume.format = "VTI";
  place(path, image, cells, volume);
  volume.type = type_of(path, array.attribute("type").value());
  const long long components = array.attribute("NumberOfComponents").as_llong(1);
  if (components < 1 || components > 4)
    throw FileError(path.string(),
                    "'NumberOfComponents' is " + std::to_string(components) + "; 1 to 4 are supported");
  volume.components = static_cast<int>(components);
  const std::string format = array.attribute("format").as_string("ascii");
  const std::size_t bytes = voxel_bytes(volume);
  const Encoding encoding = format == "ascii" ? Encoding::text
                            : storage.zlib    ? Encoding::deflate
                                              : Encoding::raw;
  check_claim(path, "WholeExtent", bytes, file.bytes, encoding, size_of(volume.type));
  check_memory(path, bytes);
  volume.voxels.resize(bytes);
  if (format == "ascii") {
    read_ascii_array(path, array.child_value(), volume);
  } else if (format == "binary") {
    const char* text = array.child_value();
    read_array(
        path, storage,
        base64_source(path, [text]() mutable { return *text == '\0' ? -1 : static_cast<int>(*text++); }),
        file.bytes, volume);
  } else if (format == "appended") {
    read_appended(path, file, storage, array, volume);
  } else {
    throw FileError(path.string(),
                    "the array's format is '" + one_line(format) + "'; ascii, binary or appended is needed");
  }
  return volume;
}

} // namespace slicelens
