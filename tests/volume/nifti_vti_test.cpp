#include "volume_files.h"

#include <cmath>
#include <functional>

using namespace slicelens;
namespace fs = std::filesystem;

namespace {

template <class T>
void put(std::string& bytes, std::size_t offset, T value) {
  std::memcpy(bytes.data() + offset, &value, sizeof value);
}

/// A NIfTI-1 header (nifti1.h) for int16 voxels with a diagonal qform; the caller changes fields.
std::string nifti1(const std::vector<std::int16_t>& dims) {
  std::string h(352, '\0');
  put<std::int32_t>(h, 0, 348);
  put<std::int16_t>(h, 40, static_cast<std::int16_t>(dims.size()));
  for (std::size_t i = 0; i < 7; ++i)
    put<std::int16_t>(h, 42 + 2 * i, i < dims.size() ? dims[i] : std::int16_t{1});
  put<std::int16_t>(h, 70, 4);
  put<std::int16_t>(h, 72, 16);
  for (std::size_t i = 0; i < 8; ++i)
    put<float>(h, 76 + 4 * i, 1.0f);
  put<float>(h, 108, 352.0f);
  h[123] = 2; // millimetres
  put<std::int16_t>(h, 252, 1);
  std::memcpy(h.data() + 344, "n+1", 4);
  return h;
}

std::string shorts(std::size_t count) {
  std::vector<std::int16_t> numbers;
  for (std::size_t i = 0; i < count; ++i)
    numbers.push_back(static_cast<std::int16_t>(i));
  return bytes_of(numbers);
}

void set_sform(std::string& h, const std::vector<float>& rows) {
  put<std::int16_t>(h, 252, 0);
  put<std::int16_t>(h, 254, 1);
  for (std::size_t i = 0; i < 12; ++i)
    put<float>(h, 280 + 4 * i, rows[i]);
}

std::string base64(const std::string& bytes) {
  const char* const digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned word = 0;
    for (std::size_t k = 0; k < 3; ++k)
      word = word << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k > bytes.size() ? '=' : digits[word >> (18 - 6 * k) & 63];
  }
  return text;
}

/// A .vti of 3 × 2 × 2 points; `attributes` of VTKFile and DataArray, `inside` of the array, `after` the
/// image.
std::string vti(const std::string& file_attributes, const std::string& array_attributes,
                const std::string& inside, const std::string& after = "") {
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"ImageData\" version=\"1.0\" " + file_attributes +
         ">\n<ImageData WholeExtent=\"1 3 0 1 0 1\" Origin=\"10 20 30\" Spacing=\"2 3 4\" "
         "Direction=\"0 -1 0 1 0 0 0 0 1\">\n<Piece Extent=\"1 3 0 1 0 1\"><PointData Scalars=\"wanted\">\n"
         "<DataArray type=\"UInt8\" Name=\"other\" format=\"ascii\">9 9 9 9 9 9 9 9 9 9 9 9</DataArray>\n"
         "<DataArray type=\"Int16\" Name=\"wanted\" " +
         array_attributes + ">" + inside + "</DataArray></PointData></Piece></ImageData>\n" + after +
         "</VTKFile>\n";
}

template <class Word>
std::string zlib_blocks(const std::string& bytes, std::size_t block, bool big) {
  std::vector<Word> header = {static_cast<Word>((bytes.size() + block - 1) / block), static_cast<Word>(block),
                              static_cast<Word>(bytes.size() % block)};
  std::string blocks;
  for (std::size_t at = 0; at < bytes.size(); at += block) {
    const std::string packed = deflated(bytes.substr(at, block), false);
    header.push_back(static_cast<Word>(packed.size()));
    blocks += packed;
  }
  return bytes_of(header, big) + "|" + blocks;
}

std::string joined(std::string text) { return text.erase(text.find('|'), 1); }

} // namespace

TEST_CASE("NIfTI's RAS becomes LPS and scl_slope gives the values that are meant") {
  const TemporaryFolder folder;
  std::string h = nifti1({2, 3, 4});
  put<float>(h, 112, 0.5f);
  put<float>(h, 116, -10.0f);
  set_sform(h, {0, -3, 0, 10, 2, 0, 0, 20, 0, 0, 4, 30});
  // Voxel sizes that the sform contradicts: the sform counts.
  write_bytes(folder / "ones.nii", h + shorts(24));
  for (std::size_t axis = 0; axis < 3; ++axis)
    put<float>(h, 80 + 4 * axis, static_cast<float>(axis + 2));
  write_bytes(folder / "a.nii", h + shorts(24));
  write_bytes(folder / "a.nii.gz", deflated(h + shorts(24), true));
  std::string pair = h;
  put<float>(pair, 108, 0.0f);
  std::memcpy(pair.data() + 344, "ni1", 4);
  write_bytes(folder / "p.hdr", pair);
  write_bytes(folder / "p.img", shorts(24));
  for (const char* name : {"ones.nii", "a.nii", "a.nii.gz", "p.hdr", "p.img"}) {
    CAPTURE(name);
    const Volume v = read_file(folder / name);
    CHECK(v.format == "NIfTI");
    CHECK(v.type == ScalarType::f32);
    CHECK(v.dims == std::array<std::size_t, 3>{2, 3, 4});
    for (int axis = 0; axis < 3; ++axis)
      CHECK(v.spacing[axis] == Approx(axis + 2.0).epsilon(1e-6)); // the file holds floats
    // Axis i points to anterior (R,A,S) = (0,2,0), which is −y in LPS; j to (−3,0,0), +x.
    CHECK(glm::length(v.direction[0] - glm::dvec3(0, -1, 0)) < 1e-6);
    CHECK(glm::length(v.direction[1] - glm::dvec3(1, 0, 0)) < 1e-6);
    CHECK(glm::length(v.direction[2] - glm::dvec3(0, 0, 1)) < 1e-6);
    CHECK(glm::length(v.origin - glm::dvec3(-10, -20, 30)) < 1e-5);
    for (std::size_t i = 0; i < 24; ++i)
      CHECK(scalar_at(v, i) == 0.5 * static_cast<double>(i) - 10);
  }
  VolumeSource source;
  source.file = folder / "p.img";
  CHECK(files_of(source) == std::vector<fs::path>{folder / "p.hdr", folder / "p.img"});
}

TEST_CASE("a sheared NIfTI keeps its axes and says so") {
  const TemporaryFolder folder;
  std::string h = nifti1({2, 3, 4});
  set_sform(h, {-2, 0, -3, 10, 0, -2, 0, 20, 0, 0, 4, 30});
  write_bytes(folder / "a.nii", h + shorts(24));
  VolumeSource source;
  source.file = folder / "a.nii";
  std::string warning;
  Progress progress;
  progress.warn = [&](const std::string& message) { warning += message; };
  const Volume v = read_volume(source, progress);
  CHECK(contains(warning, "sheared"));
  // LPS: axis k is (3, 0, 4), length 5.
  CHECK(v.spacing == glm::dvec3(2, 2, 5));
  CHECK(glm::length(v.direction[2] - glm::dvec3(0.6, 0, 0.8)) < 1e-15);
  CHECK(glm::length(v.direction[0] - glm::dvec3(1, 0, 0)) < 1e-15);
  CHECK(v.type == ScalarType::i16);
  CHECK(scalar_at(v, 23) == 23);
}

TEST_CASE("NIfTI frames, vectors, RGB and the other byte order are read") {
  const TemporaryFolder folder;
  write_bytes(folder / "4d.nii", nifti1({2, 2, 2, 3}) + shorts(24));
  const Volume frame = read_file(folder / "4d.nii", 2);
  CHECK(frame.frames == 3);
  CHECK(scalars_of(frame) == std::vector<double>{16, 17, 18, 19, 20, 21, 22, 23});
  CHECK_THROWS_AS(read_file(folder / "4d.nii", 3), UsageError);

  write_bytes(folder / "vector.nii", nifti1({2, 1, 1, 1, 3}) + shorts(6));
  const Volume vector = read_file(folder / "vector.nii");
  CHECK(vector.components == 3);
  CHECK(scalars_of(vector) == std::vector<double>{0, 2, 4, 1, 3, 5}); // planes become interleaved

  std::string rgb = nifti1({2, 1, 1});
  put<std::int16_t>(rgb, 70, 128);
  put<std::int16_t>(rgb, 72, 24);
  write_bytes(folder / "rgb.nii", rgb + std::string("\1\2\3\4\5\6"));
  CHECK(read_file(folder / "rgb.nii").components == 3);
  CHECK(scalars_of(read_file(folder / "rgb.nii")) == std::vector<double>{1, 2, 3, 4, 5, 6});

  // Every multi-byte field turned around: 2-byte dim, datatype, bitpix and codes, 4-byte others.
  std::string swapped = nifti1({2, 2, 2});
  const auto turn = [&](std::size_t offset, std::size_t size) {
    std::reverse(swapped.begin() + static_cast<std::ptrdiff_t>(offset),
                 swapped.begin() + static_cast<std::ptrdiff_t>(offset + size));
  };
  turn(0, 4);
  for (std::size_t at = 40; at < 56; at += 2)
    turn(at, 2);
  turn(70, 2);
  turn(72, 2);
  turn(252, 2);
  for (std::size_t at = 76; at < 120; at += 4)
    turn(at, 4);
  write_bytes(folder / "big.nii",
              swapped + bytes_of(std::vector<std::int16_t>{0, 1, 2, 3, 4, 5, 6, 7}, true));
  CHECK(scalars_of(read_file(folder / "big.nii")) == std::vector<double>{0, 1, 2, 3, 4, 5, 6, 7});
}

TEST_CASE("NIfTI that holds no volume or lies is refused by its field") {
  const TemporaryFolder folder;
  const auto refused = [&](const std::function<void(std::string&)>& change, const std::string& field) {
    std::string h = nifti1({2, 3, 4});
    change(h);
    write_bytes(folder / "a.nii", h + shorts(24));
    const std::string text = refusal(folder / "a.nii");
    CAPTURE(text, field);
    CHECK(contains(text, "a.nii"));
    CHECK(contains(text, field));
    CHECK_FALSE(contains(text, "\n"));
  };
  refused([](std::string& h) { put<std::int16_t>(h, 70, 32); }, "complex");
  refused([](std::string& h) { put<std::int16_t>(h, 70, 1536); }, "datatype");
  refused([](std::string& h) { put<std::int16_t>(h, 70, 77); }, "datatype");
  refused([](std::string& h) { put<std::int16_t>(h, 42, 0); }, "dim");
  refused([](std::string& h) { put<std::int16_t>(h, 42, -2); }, "dim");
  refused([](std::string& h) { put<std::int16_t>(h, 40, 9); }, "dim[0]");
  refused([](std::string& h) { put<std::int16_t>(h, 42, 32767); }, "dim");
  refused([](std::string& h) { put<std::int32_t>(h, 0, 349); }, "sizeof_hdr");
  refused([](std::string& h) { put<float>(h, 80, std::nanf("")); }, "pixdim[1]");
  refused([](std::string& h) { set_sform(h, {-1.7e38f, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0}); }, "sform");
  refused([](std::string& h) { put<float>(h, 108, 1e9f); }, "dim");
  refused([](std::string& h) { put<float>(h, 108, std::nanf("")); }, "vox_offset");
  refused([](std::string& h) { put<std::int16_t>(h, 68, 3001); }, "CIFTI");
  refused([](std::string& h) { set_sform(h, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}); }, "");
}

TEST_CASE("every way a .vti stores its array gives the same voxels") {
  const TemporaryFolder folder;
  const std::string raw = shorts(12);
  std::string big;
  for (std::size_t i = 0; i < raw.size(); i += 2)
    big += std::string{raw[i + 1], raw[i]};
  const std::string little = "byte_order=\"LittleEndian\"";
  const std::string zlib = little + " compressor=\"vtkZLibDataCompressor\"";
  const auto word32 = [](std::uint32_t n) { return bytes_of(std::vector<std::uint32_t>{n}); };
  const std::string packed = zlib_blocks<std::uint32_t>(raw, 10, false);  // 24 bytes: blocks of 10, 10 and 4
  const std::string packed64 = zlib_blocks<std::uint64_t>(raw, 8, false); // three full blocks
  const std::string head32 = packed.substr(0, packed.find('|'));
  const std::string data32 = packed.substr(packed.find('|') + 1);
  const auto appended = [](const std::string& encoding, const std::string& data) {
    return "<AppendedData encoding=\"" + encoding + "\">\n  _" + data + "\n</AppendedData>\n";
  };
  write_bytes(folder / "ascii.vti", vti(little, "format=\"ascii\"", "0 1 2 3 4 5\n6 7 8 9 10 11"));
  write_bytes(folder / "inline.vti",
              vti(little, "format=\"binary\"", "\n  " + base64(word32(24) + raw) + "\n"));
  write_bytes(folder / "inline2.vti", vti(little, "format=\"binary\"", base64(word32(24)) + base64(raw)));
  write_bytes(folder / "big.vti", vti("byte_order=\"BigEndian\" header_type=\"UInt64\"", "format=\"binary\"",
                                      base64(bytes_of(std::vector<std::uint64_t>{24}, true) + big)));
  write_bytes(folder / "zlib.vti", vti(zlib, "format=\"binary\"", base64(head32) + base64(data32)));
  write_bytes(folder / "zlib64.vti", vti(zlib + " header_type=\"UInt64\"", "format=\"appended\" offset=\"5\"",
                                         "", appended("raw", "junk!" + joined(packed64))));
  write_bytes(folder / "raw.vti",
              vti(little, "format=\"appended\" offset=\"0\"", "", appended("raw", word32(24) + raw)));
  write_bytes(folder / "base64.vti", vti(zlib, "format=\"appended\" offset=\"0\"", "",
                                         appended("base64", base64(head32) + base64(data32))));
  for (const char* name : {"ascii.vti", "inline.vti", "inline2.vti", "big.vti", "zlib.vti", "zlib64.vti",
                           "raw.vti", "base64.vti"}) {
    CAPTURE(name, refusal(folder / name));
    const Volume v = read_file(folder / name);
    CHECK(v.format == "VTI");
    CHECK(v.dims == std::array<std::size_t, 3>{3, 2, 2});
    CHECK(v.type == ScalarType::i16);
    CHECK(scalars_of(v) == std::vector<double>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11});
    CHECK(v.spacing == glm::dvec3(2, 3, 4));
    // Direction is row-major: its columns are (0,1,0) and (−1,0,0). The first point has index (1,0,0).
    CHECK(glm::length(v.direction[0] - glm::dvec3(0, 1, 0)) < 1e-15);
    CHECK(glm::length(v.direction[1] - glm::dvec3(-1, 0, 0)) < 1e-15);
    CHECK(glm::length(v.origin - glm::dvec3(10, 22, 30)) < 1e-12);
  }
}

TEST_CASE("cell data of a .vti become voxels at the cells' centres") {
  const TemporaryFolder folder;
  write_bytes(folder / "a.vti",
              "<VTKFile type=\"ImageData\"><ImageData WholeExtent=\"0 2 0 1 0 1\" Origin=\"0 0 0\" "
              "Spacing=\"2 4 6\"><Piece Extent=\"0 2 0 1 0 1\"><CellData><DataArray "
              "type=\"Float32\" format=\"ascii\">1.5 -2e3</DataArray></CellData></Piece></ImageData>"
              "</VTKFile>");
  const Volume v = read_file(folder / "a.vti");
  CHECK(v.dims == std::array<std::size_t, 3>{2, 1, 1});
  CHECK(v.origin == glm::dvec3(1, 2, 3));
  CHECK(scalars_of(v) == std::vector<double>{1.5, -2000});
}

TEST_CASE("a damaged .vti is refused by its field") {
  const TemporaryFolder folder;
  const std::string little = "byte_order=\"LittleEndian\"";
  const auto refused = [&](const std::string& bytes, const std::string& what) {
    write_bytes(folder / "a.vti", bytes);
    const std::string text = refusal(folder / "a.vti");
    CAPTURE(text, what);
    CHECK(contains(text, "a.vti"));
    CHECK(contains(text, what));
    CHECK_FALSE(contains(text, "\n"));
  };
  const std::string good = vti(little, "format=\"ascii\"", "0 1 2 3 4 5 6 7 8 9 10 11");
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    while (text.find(from) != std::string::npos)
      text.replace(text.find(from), from.size(), to);
    return text;
  };
  refused(changed("0 1 2 3 4 5 6 7", "0 1"), "ascii data end");
  refused(changed("0 1 2 3 4 5 6 7", "0 1 two 3 4 5 6 7"), "number 2");
  refused(changed("1 3 0 1 0 1", "1 100000 1 100000 1 100000"), "WholeExtent");
  refused(changed("1 3 0 1 0 1", "1 900000000000 1 900000000000 1 900000000000"), "WholeExtent");
  refused(changed("1 3 0 1 0 1", "3 1 0 1 0 1"), "WholeExtent");
  refused(changed("Extent=\"1 3 0 1 0 1\"><PointData", "Extent=\"1 2 0 1 0 1\"><PointData"), "Piece");
  refused(changed("\"2 3 4\"", "\"2 nan 4\""), "Spacing");
  refused(changed("\"2 3 4\"", "\"2 0 4\""), "Spacing");
  refused(changed("Int16\" Name=\"wanted", "String\" Name=\"wanted"), "String");
  refused(changed("ImageData", "PolyData"), "ImageData");
  refused(good.substr(0, 300), "XML");
  refused(vti(little + " compressor=\"vtkLZ4DataCompressor\"", "format=\"binary\"", "AAAA"),
          "vtkLZ4DataCompressor");
  refused(vti(little, "format=\"appended\" offset=\"99999\"", "",
              "<AppendedData encoding=\"raw\">_abc</AppendedData>"),
          "offset");
  refused(vti(little, "format=\"binary\"", base64(shorts(2))), "bytes");
  const std::string packed = zlib_blocks<std::uint32_t>(shorts(12), 10, false);
  std::string broken = joined(packed);
  broken[broken.size() - 3] = static_cast<char>(broken[broken.size() - 3] ^ 0x55);
  refused(vti(little + " compressor=\"vtkZLibDataCompressor\"", "format=\"appended\" offset=\"0\"", "",
              "<AppendedData encoding=\"raw\">_" + broken + "</AppendedData>"),
          "block");
}
