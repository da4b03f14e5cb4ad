#include "volume_files.h"

#include <algorithm>
#include <cmath>

using namespace slicelens;
namespace fs = std::filesystem;

namespace {

std::vector<double> counting(std::size_t count) {
  std::vector<double> numbers;
  for (std::size_t i = 0; i < count; ++i)
    numbers.push_back(static_cast<double>(i));
  return numbers;
}

std::vector<std::int16_t> shorts(std::size_t count) {
  std::vector<std::int16_t> numbers;
  for (std::size_t i = 0; i < count; ++i)
    numbers.push_back(static_cast<std::int16_t>(i));
  return numbers;
}

} // namespace

TEST_CASE("a NRRD's space, directions and byte order are honoured") {
  const TemporaryFolder folder;
  write_bytes(folder / "a.nrrd", "NRRD0004\n# a comment\ntype: int16\ndimension: 3\n"
                                 "space: right-anterior-superior\nsizes: 2 3 4\n"
                                 "space directions: (0,2,0) (-3,0,0) (0,0,4)\nspace origin: (10,20,30)\n"
                                 "endian: big\nencoding: raw\nkey:=value\n\n" +
                                     bytes_of(shorts(24), true));
  const Volume v = read_file(folder / "a.nrrd");
  CHECK(v.dims == std::array<std::size_t, 3>{2, 3, 4});
  CHECK(v.spacing == glm::dvec3(2, 3, 4));
  // LPS = (−R, −A, S): axis i ran to anterior, axis j to the left.
  CHECK(glm::length(v.direction[0] - glm::dvec3(0, -1, 0)) < 1e-15);
  CHECK(glm::length(v.direction[1] - glm::dvec3(1, 0, 0)) < 1e-15);
  CHECK(glm::length(v.direction[2] - glm::dvec3(0, 0, 1)) < 1e-15);
  CHECK(v.origin == glm::dvec3(-10, -20, 30));
  CHECK(scalars_of(v) == counting(24));
}

TEST_CASE("NRRD text, hex, gzip, skips, lists and patterns of data files give the same voxels") {
  const TemporaryFolder folder;
  const std::string head = "NRRD0004\ntype: short\ndimension: 3\nsizes: 2 2 2\nendian: little\n";
  const std::string bytes = bytes_of(shorts(8));
  write_bytes(folder / "text.nrrd", head + "encoding: ascii\n\n0 1 2 3\n4 5 6 7\n");
  write_bytes(folder / "hex.nrrd", head + "encoding: hex\n\n00000100020003000400050006000700\n");
  write_bytes(folder / "gzip.nrrd", head + "encoding: gzip\n\n" + deflated(bytes, true));
  write_bytes(folder / "skipped.raw", "one line\ntwo" + bytes);
  write_bytes(folder / "skip.nhdr",
              head + "encoding: raw\nline skip: 1\nbyte skip: 3\ndata file: skipped.raw\n");
  write_bytes(folder / "end.nhdr", head + "encoding: raw\nbyte skip: -1\ndata file: skipped.raw\n");
  write_bytes(folder / "s.1", bytes.substr(0, 8));
  write_bytes(folder / "s.2", bytes.substr(8));
  write_bytes(folder / "pattern.nhdr", head + "encoding: raw\ndata file: s.%d 1 2 1\n");
  write_bytes(folder / "list.nhdr", head + "encoding: raw\ndata file: LIST\ns.1\ns.2\n");
  // A space without directions is what ITK refuses and Slicelens reads itself.
  write_bytes(folder / "space.nhdr",
              head +
                  "space: left-posterior-superior\nspacings: 1 2 3\nencoding: raw\ndata file: s.%d 1 2 1\n");
  for (const char* name : {"text.nrrd", "hex.nrrd", "gzip.nrrd", "skip.nhdr", "end.nhdr", "pattern.nhdr",
                           "list.nhdr", "space.nhdr"}) {
    CAPTURE(name);
    CHECK(scalars_of(read_file(folder / name)) == counting(8));
  }
  CHECK(read_file(folder / "space.nhdr").spacing == glm::dvec3(1, 2, 3));
  VolumeSource source;
  source.file = folder / "list.nhdr";
  CHECK(files_of(source) == std::vector<fs::path>{folder / "list.nhdr", folder / "s.1", folder / "s.2"});
}

TEST_CASE("frames of a 4D NRRD are counted and chosen, last or first axis") {
  const TemporaryFolder folder;
  const std::string bytes = bytes_of(shorts(16));
  const std::string head = "NRRD0004\ntype: short\ndimension: 4\nendian: little\nencoding: ";
  const std::string last = "\nsizes: 2 2 2 2\nspace: left-posterior-superior\n"
                           "space directions: (1,0,0) (0,1,0) (0,0,2) none\nspace origin: (1,2,3)\n";
  write_bytes(folder / "raw.nrrd", head + "raw" + last + "\n" + bytes);
  write_bytes(folder / "gzip.nrrd", head + "gzip" + last + "\n" + deflated(bytes, true));
  write_bytes(folder / "first.nrrd",
              head + "raw\nsizes: 2 2 2 2\nkinds: list domain domain domain\n\n" + bytes);
  for (const char* name : {"raw.nrrd", "gzip.nrrd"}) {
    CAPTURE(name);
    const Volume v = read_file(folder / name, 1);
    CHECK(v.frames == 2);
    CHECK(v.components == 1);
    CHECK(v.spacing == glm::dvec3(1, 1, 2));
    CHECK(v.origin == glm::dvec3(1, 2, 3));
    CHECK(scalars_of(v) == std::vector<double>{8, 9, 10, 11, 12, 13, 14, 15});
  }
  const Volume v = read_file(folder / "first.nrrd", 1);
  CHECK(v.frames == 2);
  CHECK(scalars_of(v) == std::vector<double>{1, 3, 5, 7, 9, 11, 13, 15});
  CHECK_THROWS_AS(read_file(folder / "raw.nrrd", 2), UsageError);
  CHECK_THROWS_AS(read_file(folder / "first.nrrd", 2), UsageError);
}

TEST_CASE("a component is kept alone when it is asked for") {
  const TemporaryFolder folder;
  write_bytes(folder / "rgb.nrrd", "NRRD0004\ntype: uint8\ndimension: 4\nsizes: 3 2 1 1\nencoding: raw\n"
                                   "kinds: RGB-color domain domain domain\n\n" +
                                       std::string("\1\2\3\4\5\6"));
  CHECK(read_file(folder / "rgb.nrrd").components == 3);
  VolumeSource source;
  source.file = folder / "rgb.nrrd";
  source.component = 1;
  const Volume v = read_volume(source);
  CHECK(v.components == 1);
  CHECK(scalars_of(v) == std::vector<double>{2, 5});
  CHECK(v.max == 5);
  source.component = 3;
  CHECK_THROWS_AS(read_volume(source), UsageError);
}

TEST_CASE("MetaImage local, detached, compressed and listed data give the same voxels") {
  const TemporaryFolder folder;
  const std::string bytes = bytes_of(shorts(8));
  const std::string head = "ObjectType = Image\nNDims = 3\nDimSize = 2 2 2\nElementType = MET_SHORT\n"
                           "ElementSpacing = 1 2 3\nOffset = 4 5 6\nTransformMatrix = 0 1 0 -1 0 0 0 0 1\n";
  const std::string packed = deflated(bytes, false);
  write_bytes(folder / "local.mha", head + "ElementByteOrderMSB = False\nElementDataFile = LOCAL\n" + bytes);
  write_bytes(folder / "big.mha",
              head + "BinaryData = True\nElementByteOrderMSB = True\nElementDataFile = LOCAL\n" +
                  bytes_of(shorts(8), true));
  write_bytes(folder / "packed.mha",
              head + "BinaryData = True\nCompressedData = True\nCompressedDataSize = " +
                  std::to_string(packed.size()) + "\nElementDataFile = LOCAL\n" + packed);
  write_bytes(folder / "a.raw", bytes);
  write_bytes(folder / "a.mhd", head + "ElementDataFile = a.raw\n");
  write_bytes(folder / "s1.raw", bytes.substr(0, 8));
  write_bytes(folder / "s2.raw", bytes.substr(8));
  write_bytes(folder / "list.mhd", head + "ElementDataFile = LIST\ns1.raw\ns2.raw\n");
  write_bytes(folder / "pattern.mhd", head + "ElementDataFile = s%d.raw 1 2 1\n");
  for (const char* name : {"local.mha", "big.mha", "packed.mha", "a.mhd", "list.mhd", "pattern.mhd"}) {
    CAPTURE(name);
    const Volume v = read_file(folder / name);
    CHECK(scalars_of(v) == counting(8));
    CHECK(v.spacing == glm::dvec3(1, 2, 3));
    CHECK(v.origin == glm::dvec3(4, 5, 6));
    // TransformMatrix lists one axis' direction after the other.
    CHECK(glm::length(v.direction[0] - glm::dvec3(0, 1, 0)) < 1e-15);
    CHECK(glm::length(v.direction[1] - glm::dvec3(-1, 0, 0)) < 1e-15);
  }
  VolumeSource source;
  source.file = folder / "a.mhd";
  CHECK(files_of(source) == std::vector<fs::path>{folder / "a.mhd", folder / "a.raw"});
}

TEST_CASE("legacy VTK structured points are read, text and big-endian binary") {
  const TemporaryFolder folder;
  const std::string rest = "DATASET STRUCTURED_POINTS\nDIMENSIONS 2 2 2\nSPACING 1 2 3\nORIGIN 4 5 6\n"
                           "POINT_DATA 8\nSCALARS values short 1\nLOOKUP_TABLE default\n";
  write_bytes(folder / "a.vtk", "# vtk DataFile Version 3.0\nx\nASCII\n" + rest + "0 1 2 3 4 5 6 7\n");
  write_bytes(folder / "b.vtk", "# vtk DataFile Version 3.0\nx\nBINARY\n" + rest + bytes_of(shorts(8), true));
  for (const char* name : {"a.vtk", "b.vtk"}) {
    CAPTURE(name);
    const Volume v = read_file(folder / name);
    CHECK(v.format == "VTK");
    CHECK(scalars_of(v) == counting(8));
    CHECK(v.spacing == glm::dvec3(1, 2, 3));
    CHECK(v.origin == glm::dvec3(4, 5, 6));
  }
}

TEST_CASE("headerless raw takes size, type and byte order from keys or from the name") {
  const TemporaryFolder folder;
  const std::string bytes = bytes_of(shorts(24));
  for (const char* name :
       {"foot_2x3x4_int16.raw", "foot-2x3x4-short.raw", "foot_2_3_4_i16.raw", "foot_2x3x4_int16.bin"}) {
    CAPTURE(name);
    write_bytes(folder / name, bytes);
    const Volume v = read_file(folder / name);
    CHECK(v.dims == std::array<std::size_t, 3>{2, 3, 4});
    CHECK(v.format == "raw");
    CHECK(scalars_of(v) == counting(24));
  }
  write_bytes(folder / "plain.raw", bytes_of(shorts(24), true));
  CHECK(contains(refusal(folder / "plain.raw"), "volume.size"));
  VolumeSource source;
  source.file = folder / "plain.raw";
  source.size = {{4, 3, 2}};
  source.type = ScalarType::i16;
  source.big_endian = true;
  source.spacing = glm::dvec3(1, 2, 3);
  const Volume v = read_volume(source);
  CHECK(v.dims == std::array<std::size_t, 3>{4, 3, 2});
  CHECK(v.spacing == glm::dvec3(1, 2, 3));
  CHECK(scalars_of(v) == counting(24));
  source.size = {{4, 3, 3}};
  try {
    read_volume(source);
    FAIL("a size that does not fit was taken");
  } catch (const FileError& error) {
    // 4·3·3 voxels of 2 bytes
    CHECK(contains(error.what(), "72 bytes"));
    CHECK(contains(error.what(), "48"));
  }
  // Keys for raw on a file that says it itself would be ignored: refused.
  write_bytes(folder / "a.nrrd", "NRRD0004\ntype: uint8\ndimension: 1\nsizes: 1\nencoding: raw\n\nA");
  source.file = folder / "a.nrrd";
  CHECK_THROWS_AS(read_volume(source), UsageError);
}

TEST_CASE("an image stack is read in natural order from a folder, a printf pattern and a shell pattern") {
  const TemporaryFolder folder;
  // An uncompressed 2 × 1 TIFF by hand: 8 header bytes, 8 tags, 2 pixels.
  const auto tiff = [](unsigned char value) {
    const auto tag = [](std::uint16_t id, std::uint16_t type, std::uint32_t number) {
      return bytes_of(std::vector<std::uint16_t>{id, type}) + bytes_of(std::vector<std::uint32_t>{1, number});
    };
    std::string bytes = std::string("II*\0", 4) + bytes_of(std::vector<std::uint32_t>{8}) +
                        bytes_of(std::vector<std::uint16_t>{9}) + tag(256, 4, 2) + tag(257, 4, 1) +
                        tag(258, 3, 8) + tag(259, 3, 1) + tag(262, 3, 1) + tag(273, 4, 8 + 2 + 9 * 12 + 4) +
                        tag(277, 3, 1) + tag(278, 4, 1) + tag(279, 4, 2) +
                        bytes_of(std::vector<std::uint32_t>{0});
    return bytes + std::string(1, static_cast<char>(value)) + std::string(1, static_cast<char>(value + 100));
  };
  for (const int k : {1, 2, 10, 11})
    write_bytes(folder / ("s" + std::to_string(k) + ".tif"), tiff(static_cast<unsigned char>(k)));
  write_bytes(folder / "notes.txt", "not an image");
  const std::vector<double> expected = {1, 101, 2, 102, 10, 110, 11, 111};
  for (const fs::path& path : {folder.path(), folder / "s%d.tif", folder / "s*.tif"}) {
    CAPTURE(path);
    const Volume v = read_file(path);
    CHECK(v.dims == std::array<std::size_t, 3>{2, 1, 4});
    CHECK(v.format == "TIFF stack");
    CHECK(scalars_of(v) == expected);
  }
  VolumeSource source;
  source.file = folder / "s?.tif";
  CHECK(files_of(source) == std::vector<fs::path>{folder / "s1.tif", folder / "s2.tif"});
  CHECK(contains(refusal(folder / "t%d.tif"), "no file fits"));
  write_bytes(folder / "s12.tif", tiff(12).substr(0, 60));
  CHECK(contains(refusal(folder.path()), "s12.tif"));
}

TEST_CASE("the pages of one TIFF are slices") {
  const TemporaryFolder folder;
  // Two pages of 2 x 2 pixels of 16 bits by hand: header, directory and pixels of each page in turn.
  std::string bytes = std::string("II*\0", 4) + bytes_of(std::vector<std::uint32_t>{8});
  constexpr std::uint32_t directory = 2 + 9 * 12 + 4;
  for (const std::uint32_t page : {0u, 1u}) {
    const std::uint32_t start = 8 + page * (directory + 8);
    const auto tag = [](std::uint16_t id, std::uint16_t type, std::uint32_t number) {
      return bytes_of(std::vector<std::uint16_t>{id, type}) + bytes_of(std::vector<std::uint32_t>{1, number});
    };
    bytes += bytes_of(std::vector<std::uint16_t>{9}) + tag(256, 4, 2) + tag(257, 4, 2) + tag(258, 3, 16) +
             tag(259, 3, 1) + tag(262, 3, 1) + tag(273, 4, start + directory) + tag(277, 3, 1) +
             tag(278, 4, 2) + tag(279, 4, 8) +
             bytes_of(std::vector<std::uint32_t>{page == 0 ? start + directory + 8 : 0}) +
             bytes_of(std::vector<std::uint16_t>{static_cast<std::uint16_t>(1000 * page + 1), 2, 3, 60000});
  }
  write_bytes(folder / "pages.tif", bytes);
  const Volume v = read_file(folder / "pages.tif");
  CHECK(v.dims == std::array<std::size_t, 3>{2, 2, 2});
  CHECK(v.type == ScalarType::u16);
  CHECK(scalars_of(v) == std::vector<double>{1, 2, 3, 60000, 1001, 2, 3, 60000});
  write_bytes(folder / "other.tif", bytes);
  CHECK(contains(refusal(folder / "*.tif"), "has 2 pages"));
}

TEST_CASE("the hash of one file is its SHA-256, of several that of their digests") {
  const TemporaryFolder folder;
  write_bytes(folder / "abc", "abc");
  write_bytes(folder / "empty_line", "\n");
  // FIPS 180-4's example for "abc"; the others by coreutils' sha256sum.
  const std::string abc = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
  CHECK(sha256_of({folder / "abc"}) == abc);
  CHECK(sha256_of({folder / "abc", folder / "empty_line"}) ==
        "5adf09499ec5f9461599464b5e2b63e5354d303d17fb6853379874c5b8917c4f");
  CHECK(sha256_of({folder / "empty_line", folder / "abc"}) ==
        "c4a75c99b92e39dd1f96e01546118b78e1a02ca56f276ae3e0f2d0418ef5c00d");
  CHECK_THROWS_AS(sha256_of({folder / "missing"}), FileError);
}
