// NRRD beyond the usual: every encoding, order of axes, unit and way to skip.
#include "volume_files.h"

#include <bzlib.h>

#include <cmath>
#include <map>

using namespace slicelens;
namespace fs = std::filesystem;

namespace {

std::vector<double> counting(std::size_t count) {
  std::vector<double> numbers;
  for (std::size_t i = 0; i < count; ++i)
    numbers.push_back(static_cast<double>(i));
  return numbers;
}

std::string shorts(std::size_t count, bool reversed = false) {
  std::vector<std::int16_t> numbers;
  for (std::size_t i = 0; i < count; ++i)
    numbers.push_back(static_cast<std::int16_t>(i));
  return bytes_of(numbers, reversed);
}

std::string bzip2(std::string bytes) {
  std::string out(bytes.size() + 1024, '\0');
  auto length = static_cast<unsigned>(out.size());
  BZ2_bzBuffToBuffCompress(out.data(), &length, bytes.data(), static_cast<unsigned>(bytes.size()), 9, 0, 0);
  out.resize(length);
  return out;
}

std::string header(const std::string& dimension, const std::string& fields) {
  return "NRRD0005\ntype: short\nendian: little\ndimension: " + dimension + "\n" + fields;
}

Volume read_warned(const fs::path& path, std::string& warnings, std::size_t frame = 0) {
  VolumeSource source;
  source.file = path;
  source.frame = frame;
  Progress progress;
  progress.warn = [&](const std::string& message) { warnings += message + "\n"; };
  return read_volume(source, progress);
}

} // namespace

TEST_CASE("a NRRD in any encoding and byte order gives the same frames") {
  const TemporaryFolder folder;
  const std::string fields = "sizes: 2 2 2 2\nkinds: space space space time\nencoding: ";
  const std::string big = "NRRD0005\ntype: short\nendian: big\ndimension: 4\n" + fields;
  const std::string hex = "00000100020003000400050006000700"
                          "08 00 09 00 0a 00 0B 00\n0c000d000E000f00";
  const std::map<std::string, std::string> files = {
      {"raw", header("4", fields) + "raw\n\n" + shorts(16)},
      {"raw_big", big + "raw\n\n" + shorts(16, true)},
      {"gzip", header("4", fields) + "gzip\n\n" + deflated(shorts(16), true)},
      {"gzip_big", big + "gz\n\n" + deflated(shorts(16, true), true)},
      {"bzip2", header("4", fields) + "bzip2\n\n" + bzip2(shorts(16))},
      {"bzip2_big", big + "bz2\n\n" + bzip2(shorts(16, true))},
      {"two_streams",
       header("4", fields) + "bzip2\n\n" + bzip2(shorts(16).substr(0, 10)) + bzip2(shorts(16).substr(10))},
      {"ascii", header("4", fields) + "ASCII\n\n0 1 2 3 4 5 6 7\n8, 9, 10, 11\t12 13 14 15\n"},
      {"hex", header("4", fields) + "hex\n\n" + hex},
  };
  for (const auto& [name, bytes] : files) {
    CAPTURE(name);
    write_bytes(folder / (name + ".nrrd"), bytes);
    CHECK(read_file(folder / (name + ".nrrd")).frames == 2);
    CHECK(scalars_of(read_file(folder / (name + ".nrrd"), 0)) == counting(8));
    CHECK(scalars_of(read_file(folder / (name + ".nrrd"), 1)) ==
          std::vector<double>{8, 9, 10, 11, 12, 13, 14, 15});
  }
}

TEST_CASE("bytes of a NRRD are skipped behind what is decoded, lines before it") {
  const TemporaryFolder folder;
  const std::string fields = "sizes: 2 2 2\ndata file: data\n";
  const std::string bytes = "header" + shorts(8);
  for (const char* encoding : {"raw", "gzip", "bzip2"}) {
    CAPTURE(encoding);
    const std::string packed = encoding[0] == 'r'   ? bytes
                               : encoding[0] == 'g' ? deflated(bytes, true)
                                                    : bzip2(bytes);
    write_bytes(folder / "data", "a line\nanother\n" + packed);
    for (const char* skip : {"6", "-1"}) {
      CAPTURE(skip);
      write_bytes(folder / "a.nhdr", header("3", fields) + "encoding: " + encoding +
                                         "\nline skip: 2\nbyte skip: " + skip + "\n");
      CHECK(scalars_of(read_file(folder / "a.nhdr")) == counting(8));
    }
    write_bytes(folder / "a.nhdr", header("3", fields) + "encoding: " + encoding + "\nline skip: 9\n");
    CHECK(contains(refusal(folder / "a.nhdr"), "fewer lines"));
  }
}

TEST_CASE("a NRRD's data that are longer than its header says are warned of, shorter ones refused") {
  const TemporaryFolder folder;
  std::string warnings;
  const std::string fields = "sizes: 2 2 2\nencoding: ";
  write_bytes(folder / "long.nrrd", header("3", fields) + "bzip2\n\n" + bzip2(shorts(10)));
  CHECK(scalars_of(read_warned(folder / "long.nrrd", warnings)) == counting(8));
  CHECK(contains(warnings, "longer than 'sizes' says"));
  warnings.clear();
  write_bytes(folder / "line.nrrd",
              header("3", fields) + "raw\n\n" + shorts(8) + "\r\n"); // as some editors end files
  CHECK(scalars_of(read_warned(folder / "line.nrrd", warnings)) == counting(8));
  CHECK(warnings.empty());
  write_bytes(folder / "short.nrrd", header("3", fields) + "bzip2\n\n" + bzip2(shorts(7)));
  CHECK(contains(refusal(folder / "short.nrrd"), "end 2 bytes before 'sizes' says"));
  const std::string packed = bzip2(shorts(8));
  write_bytes(folder / "cut.nrrd", header("3", fields) + "bzip2\n\n" + packed.substr(0, packed.size() - 6));
  CHECK(contains(refusal(folder / "cut.nrrd"), "truncated or damaged"));
  write_bytes(folder / "none.nrrd", header("3", fields) + "bzip2\n\nno bzip2 at all");
  CHECK(contains(refusal(folder / "none.nrrd"), "no bzip2 data"));
  write_bytes(folder / "hex.nrrd", header("3", fields) + "hex\n\n0000010002000300040005000600070x");
  CHECK(contains(refusal(folder / "hex.nrrd"), "hexadecimal"));
}

TEST_CASE("components and frames of a NRRD may be on any axis") {
  const TemporaryFolder folder;
  // Axis order x, colour, y, z: scalar x + 2 (c + 3 (y + 1 z)).
  write_bytes(folder / "colour.nrrd",
              header("4", "sizes: 2 3 1 2\nkinds: domain RGB-color domain domain\nencoding: raw\n\n") +
                  shorts(12));
  const Volume v = read_file(folder / "colour.nrrd");
  CHECK(v.components == 3);
  CHECK(v.dims == std::array<std::size_t, 3>{2, 1, 2});
  CHECK(scalars_of(v) == std::vector<double>{0, 2, 4, 1, 3, 5, 6, 8, 10, 7, 9, 11});
  // Colour last, as planes.
  write_bytes(folder / "planes.nrrd",
              header("3", "sizes: 2 2 3\nkinds: space space RGB-color\nencoding: raw\n\n") + shorts(12));
  CHECK(scalars_of(read_file(folder / "planes.nrrd")) ==
        std::vector<double>{0, 4, 8, 1, 5, 9, 2, 6, 10, 3, 7, 11});
  // Time between the axes of space.
  write_bytes(folder / "time.nrrd",
              header("4", "sizes: 2 1 3 2\nkinds: space space time space\nencoding: raw\n\n") + shorts(12));
  CHECK(read_file(folder / "time.nrrd").frames == 3);
  CHECK(scalars_of(read_file(folder / "time.nrrd", 1)) == std::vector<double>{2, 3, 8, 9});
}

TEST_CASE("a NRRD's place follows its units, its axes' minima, and its space without directions") {
  const TemporaryFolder folder;
  std::string warnings;
  const auto read = [&](const std::string& name, const std::string& dimension, const std::string& fields) {
    write_bytes(folder / name, header(dimension, fields + "encoding: raw\n\n") + shorts(8));
    return read_warned(folder / name, warnings);
  };
  // One unit is the data's own and stays; several are turned to the first one's.
  CHECK(
      read("one.nrrd", "3", "sizes: 2 2 2\nspacings: 400 400 2000\nunits: \"um\" \"um\" \"um\"\n").spacing ==
      glm::dvec3(400, 400, 2000));
  CHECK(warnings.empty());
  const Volume mixed =
      read("mixed.nrrd", "3", "sizes: 2 2 2\nspacings: 0.5 400 0.2\nunits: \"mm\" \"microns\" \"cm\"\n");
  CHECK(glm::length(mixed.spacing - glm::dvec3(0.5, 0.4, 2)) < 1e-12);
  CHECK(contains(warnings, "different units (mm, microns, cm)"));
  const Volume space = read("space.nrrd", "3",
                            "sizes: 2 2 2\nspace dimension: 3\nspace directions: (1,0,0) (0,500,0) (0,0,2)\n"
                            "space origin: (1,1000,3)\nspace units: \"mm\" \"um\" \"mm\"\n");
  CHECK(glm::length(space.spacing - glm::dvec3(1, 0.5, 2)) < 1e-12);
  CHECK(glm::length(space.origin - glm::dvec3(1, 1, 3)) < 1e-12);
  // Cells: the first voxel's centre is half a spacing behind the axis' minimum; nodes: on it.
  const Volume mins = read("mins.nrrd", "3",
                           "sizes: 2 2 2\nspacings: 1 2 -4\naxis mins: 10 20 30\ncenters: cell node cell\n");
  CHECK(mins.origin == glm::dvec3(10.5, 20, 28));
  CHECK(mins.spacing == glm::dvec3(1, 2, 4));
  CHECK(mins.direction[2] == glm::dvec3(0, 0, -1));
  const Volume ras = read("ras.nrrd", "3",
                          "sizes: 2 2 2\nspace: RAS\nspacings: 2 2 5\nspace directions: none none none\n"
                          "kinds: space space space\nspace origin: (10,12,100)\n");
  CHECK(ras.spacing == glm::dvec3(2, 2, 5));
  CHECK(ras.origin == glm::dvec3(-10, -12, 100));
  CHECK(ras.direction[0] == glm::dvec3(-1, 0, 0));
  CHECK(ras.direction[1] == glm::dvec3(0, -1, 0));
  // A picture in space: the third direction is perpendicular to its two.
  const Volume flat =
      read("flat.nrrd", "2", "sizes: 4 2\nspace dimension: 3\nspace directions: (0,2,0) (0,0,3)\n");
  CHECK(flat.direction[2] == glm::dvec3(1, 0, 0));
  CHECK(flat.spacing == glm::dvec3(2, 3, 1));
}
