#include "streamed_files.h"
#include "volume_files.h"

#include <cmath>
#include <random>

using namespace slicelens;
namespace fs = std::filesystem;

namespace {

std::string element(std::uint16_t group, std::uint16_t number, const std::string& vr, std::string value) {
  if (value.size() % 2 == 1)
    value += vr == "UI" || vr == "OW" ? '\0' : ' ';
  std::string bytes = bytes_of(std::vector<std::uint16_t>{group, number}) + vr;
  if (vr == "OB" || vr == "OW" || vr == "SQ")
    bytes +=
        std::string(2, '\0') + bytes_of(std::vector<std::uint32_t>{static_cast<std::uint32_t>(value.size())});
  else
    bytes += bytes_of(std::vector<std::uint16_t>{static_cast<std::uint16_t>(value.size())});
  return bytes + value;
}

std::string us(std::uint16_t group, std::uint16_t number, std::uint16_t value) {
  return element(group, number, "US", bytes_of(std::vector<std::uint16_t>{value}));
}

struct Slice {
  std::string series = "1.2.3.1";
  std::string description = "axial";
  std::string instance = "1.2.3.1.1";
  std::string position = "0\\0\\0";
  std::string axes = "1\\0\\0\\0\\1\\0";
  std::string slope = "2";
  std::string intercept = "-10";
  int number = 1;
  std::uint16_t columns = 3;
  std::vector<std::int16_t> pixels = {0, 1, 2, 3, 4, 5}; ///< 3 columns, 2 rows
};

/// An Explicit VR Little Endian file (PS3.5, PS3.10) with 2 rows of signed 16-bit pixels.
std::string dicom(const Slice& s) {
  const std::string meta = element(2, 2, "UI", "1.2.840.10008.5.1.4.1.1.2") +
                           element(2, 3, "UI", s.instance) + element(2, 0x10, "UI", "1.2.840.10008.1.2.1") +
                           element(2, 0x12, "UI", "1.2.3");
  const auto length = bytes_of(std::vector<std::uint32_t>{static_cast<std::uint32_t>(meta.size())});
  return std::string(128, '\0') + "DICM" + element(2, 0, "UL", length) + meta +
         element(8, 0x16, "UI", "1.2.840.10008.5.1.4.1.1.2") + element(8, 0x18, "UI", s.instance) +
         element(8, 0x60, "CS", "CT") + element(8, 0x103e, "LO", s.description) +
         element(0x20, 0x0d, "UI", "1.2.3") + element(0x20, 0x0e, "UI", s.series) +
         element(0x20, 0x13, "IS", std::to_string(s.number)) + element(0x20, 0x32, "DS", s.position) +
         element(0x20, 0x37, "DS", s.axes) + us(0x28, 2, 1) + element(0x28, 4, "CS", "MONOCHROME2") +
         us(0x28, 0x10, 2) + us(0x28, 0x11, s.columns) + element(0x28, 0x30, "DS", "0.75\\0.5") +
         us(0x28, 0x100, 16) + us(0x28, 0x101, 16) + us(0x28, 0x102, 15) + us(0x28, 0x103, 1) +
         element(0x28, 0x1052, "DS", s.intercept) + element(0x28, 0x1053, "DS", s.slope) +
         element(0x7fe0, 0x10, "OW", bytes_of(s.pixels));
}

std::string item(const std::string& inside) {
  return bytes_of(std::vector<std::uint16_t>{0xfffe, 0xe000}) +
         bytes_of(std::vector<std::uint32_t>{static_cast<std::uint32_t>(inside.size())}) + inside;
}

/// An enhanced MR file (PS3.3 C.7.6.16) whose frame k holds 100 k + pixel: pixel spacing for all, a position
/// and orientation for each frame.
std::string enhanced(const std::vector<std::string>& positions, const std::vector<std::string>& axes) {
  std::vector<std::int16_t> pixels;
  std::string frames;
  for (std::size_t k = 0; k < positions.size(); ++k) {
    for (int pixel = 0; pixel < 6; ++pixel)
      pixels.push_back(static_cast<std::int16_t>(100 * static_cast<int>(k) + pixel));
    frames += item(element(0x20, 0x9113, "SQ", item(element(0x20, 0x32, "DS", positions[k]))) +
                   element(0x20, 0x9116, "SQ", item(element(0x20, 0x37, "DS", axes[k % axes.size()]))));
  }
  const std::string shared = item(element(
      0x28, 0x9110, "SQ", item(element(0x18, 0x50, "DS", "2") + element(0x28, 0x30, "DS", "0.75\\0.5"))));
  const std::string uid = "1.2.840.10008.5.1.4.1.1.4.1";
  const std::string meta = element(2, 2, "UI", uid) + element(2, 3, "UI", "1.2.9") +
                           element(2, 0x10, "UI", "1.2.840.10008.1.2.1") + element(2, 0x12, "UI", "1.2.3");
  const auto length = bytes_of(std::vector<std::uint32_t>{static_cast<std::uint32_t>(meta.size())});
  return std::string(128, '\0') + "DICM" + element(2, 0, "UL", length) + meta + element(8, 0x16, "UI", uid) +
         element(8, 0x18, "UI", "1.2.9") + element(8, 0x60, "CS", "MR") + element(0x20, 0x0d, "UI", "1.2.3") +
         element(0x20, 0x0e, "UI", "1.2.3.9") + us(0x28, 2, 1) + element(0x28, 4, "CS", "MONOCHROME2") +
         element(0x28, 8, "IS", std::to_string(positions.size())) + us(0x28, 0x10, 2) + us(0x28, 0x11, 3) +
         us(0x28, 0x100, 16) + us(0x28, 0x101, 16) + us(0x28, 0x102, 15) + us(0x28, 0x103, 1) +
         element(0x5200, 0x9229, "SQ", shared) + element(0x5200, 0x9230, "SQ", frames) +
         element(0x7fe0, 0x10, "OW", bytes_of(pixels));
}

/// `count` slices at the given distance; slice k holds 100·k + pixel. File names run against the positions.
void write_series(const TemporaryFolder& folder, int count, double distance,
                  const std::string& series = "1.2.3.1", double shear = 0) {
  for (int k = 0; k < count; ++k) {
    Slice s;
    s.series = series;
    s.instance = series + "." + std::to_string(k + 1);
    s.number = count - k;
    s.position = "5\\" + std::to_string(6 + shear * k) + "\\" + std::to_string(-7 + distance * k);
    for (std::int16_t& pixel : s.pixels)
      pixel = static_cast<std::int16_t>(pixel + 100 * k);
    write_bytes(folder / (series + "_" + std::to_string(count - k) + ".dcm"), dicom(s));
  }
}

Volume read_warned(const fs::path& path, std::string& warnings, const std::string& series = "") {
  VolumeSource source;
  source.file = path;
  source.series = series;
  Progress progress;
  progress.warn = [&](const std::string& message) { warnings += message + "\n"; };
  return read_volume(source, progress);
}

} // namespace

TEST_CASE("a DICOM series is sorted by position, rescaled and placed") {
  const TemporaryFolder folder;
  write_series(folder, 12, 1.25);
  for (const fs::path& path : {folder.path(), folder / "1.2.3.1_7.dcm", folder / "*.dcm"}) {
    CAPTURE(path);
    const Volume v = read_file(path);
    CHECK(v.format == "DICOM");
    CHECK(v.dims == std::array<std::size_t, 3>{3, 2, 12});
    // Pixel Spacing is the distance of rows, then of columns.
    CHECK(glm::length(v.spacing - glm::dvec3(0.5, 0.75, 1.25)) < 1e-9);
    CHECK(v.origin == glm::dvec3(5, 6, -7));
    CHECK(v.direction == glm::dmat3(1));
    for (std::size_t k = 0; k < 12; ++k) {
      for (std::size_t i = 0; i < 6; ++i)
        CHECK(scalar_at(v, 6 * k + i) == 2.0 * static_cast<double>(100 * k + i) - 10);
    }
  }
  VolumeSource source;
  source.file = folder.path();
  const auto files = files_of(source);
  REQUIRE(files.size() == 12);
  CHECK(files.front() == folder / "1.2.3.1_12.dcm");
  CHECK(files.back() == folder / "1.2.3.1_1.dcm");
}

TEST_CASE("several DICOM series in a folder are listed and chosen by UID, a part of it or a file") {
  const TemporaryFolder folder;
  write_series(folder, 3, 1, "1.2.3.1");
  write_series(folder, 4, 2, "1.2.3.22");
  const std::string text = refusal(folder.path());
  CHECK(contains(text, "1.2.3.1 ('axial', 3 files)"));
  CHECK(contains(text, "1.2.3.22 ('axial', 4 files)"));
  CHECK(contains(text, "volume.series"));
  CHECK_FALSE(contains(text, "\n"));
  std::string warnings;
  CHECK(read_warned(folder.path(), warnings, "1.2.3.1").dims[2] == 3);
  CHECK(read_warned(folder.path(), warnings, ".22").dims[2] == 4);
  CHECK(read_file(folder / "1.2.3.22_2.dcm").dims[2] == 4);
  CHECK_THROWS_AS(read_warned(folder.path(), warnings, "axial"), UsageError); // fits both
  CHECK_THROWS_AS(read_warned(folder.path(), warnings, "9.9"), UsageError);
}

TEST_CASE("a missing DICOM slice is refused, a small unevenness warned of, a tilt kept") {
  std::string warnings;
  {
    const TemporaryFolder folder;
    write_series(folder, 6, 1);
    fs::remove(folder / "1.2.3.1_3.dcm");
    CHECK(contains(refusal(folder.path()), "uneven slice distances from 1 to 2 mm"));
  }
  {
    const TemporaryFolder folder;
    write_series(folder, 3, 1);
    Slice s;
    s.instance = "1.2.3.1.9";
    s.position = "5\\6\\-3.95"; // the fourth of the slices at −7, −6, −5: 5 % too far
    write_bytes(folder / "4.dcm", dicom(s));
    CHECK(read_warned(folder.path(), warnings).dims[2] == 4);
    CHECK(contains(warnings, "slice distances"));
  }
  {
    const TemporaryFolder folder;
    write_series(folder, 4, 4, "1.2.3.1", 3);
    warnings.clear();
    const Volume v = read_warned(folder.path(), warnings);
    // From slice to slice (0, 3, 4): length 5.
    CHECK(v.spacing.z == Approx(5).epsilon(1e-9));
    CHECK(glm::length(v.direction[2] - glm::dvec3(0, 0.6, 0.8)) < 1e-9);
    CHECK(contains(warnings, "36.87 degrees")); // atan(3/4)
  }
}

TEST_CASE("DICOM slices that repeat every position are frames; copies of one image count once") {
  const TemporaryFolder folder;
  for (int frame = 0; frame < 3; ++frame) {
    for (int k = 0; k < 2; ++k) {
      Slice s;
      s.instance = "1.2.3.1." + std::to_string(1 + frame * 2 + k);
      s.number = 1 + frame * 2 + k;
      s.position = "0\\0\\" + std::to_string(k);
      s.slope = "1";
      s.intercept = "0";
      s.pixels.assign(6, static_cast<std::int16_t>(10 * frame + k));
      write_bytes(folder / (std::to_string(s.number) + ".dcm"), dicom(s));
    }
  }
  const Volume v = read_file(folder.path(), 2);
  CHECK(v.frames == 3);
  CHECK(v.dims[2] == 2);
  CHECK(scalar_at(v, 0) == 20);
  CHECK(scalar_at(v, 6) == 21);
  CHECK_THROWS_AS(read_file(folder.path(), 3), UsageError);
  fs::copy_file(folder / "1.dcm", folder / "copy.dcm");
  std::string warnings;
  CHECK(read_warned(folder.path(), warnings).frames == 3);
  CHECK(contains(warnings, "copies"));
  fs::remove(folder / "copy.dcm");
  fs::remove(folder / "6.dcm");
  CHECK(contains(refusal(folder.path()), "at others"));
}

TEST_CASE("a damaged DICOM file is refused in one line") {
  const TemporaryFolder folder;
  Slice s;
  write_bytes(folder / "short.dcm", dicom(s).substr(0, dicom(s).size() - 5));
  s.columns = 60000;
  write_bytes(folder / "large.dcm", dicom(s));
  s.columns = 0;
  write_bytes(folder / "none.dcm", dicom(s));
  write_bytes(folder / "head.dcm", dicom(s).substr(0, 140));
  for (const char* name : {"short.dcm", "large.dcm", "none.dcm", "head.dcm"}) {
    const std::string text = refusal(folder / name);
    CAPTURE(name, text);
    CHECK(contains(text, name));
    CHECK_FALSE(contains(text, "\n"));
  }
  CHECK(contains(refusal(folder / "large.dcm"), "Columns"));
}

TEST_CASE("DICOM bytes changed at random are read or refused, never worse") {
  // Debian's GDCM is built with its assertions: what the walk over the structure lets through must satisfy
  // them.
  const TemporaryFolder folder;
  const std::string good = dicom(Slice());
  std::mt19937 random(11);
  for (int variant = 0; variant < 1000; ++variant) {
    std::string bytes = good;
    for (int change = 0; change <= variant % 3; ++change)
      bytes[128 + random() % (good.size() - 128)] = static_cast<char>(random() % 256);
    if (variant % 4 == 0)
      bytes.resize(132 + random() % (good.size() - 132));
    write_bytes(folder / "a.dcm", bytes);
    REQUIRE_FALSE(contains(refusal(folder / "a.dcm"), "\n"));
  }
}

TEST_CASE("frames of an enhanced DICOM file are slices by their own positions") {
  const TemporaryFolder folder;
  const std::string upright = "1\\0\\0\\0\\0\\-1"; // coronal: the normal is +y
  const std::vector<double> frame = {0, 1, 2, 3, 4, 5};
  const auto values = [&](std::vector<double> order) {
    std::vector<double> all;
    for (const double k : order) {
      for (const double pixel : frame)
        all.push_back(100 * k + pixel);
    }
    return all;
  };
  write_bytes(folder / "a.dcm", enhanced({"5\\12\\7", "5\\8\\7", "5\\10\\7"}, {upright}));
  const Volume v = read_file(folder / "a.dcm");
  CHECK(v.dims == std::array<std::size_t, 3>{3, 2, 3});
  CHECK(v.frames == 1);
  CHECK(v.spacing == glm::dvec3(0.5, 0.75, 2));
  CHECK(v.origin == glm::dvec3(5, 8, 7));
  CHECK(v.direction[1] == glm::dvec3(0, 0, -1));
  CHECK(v.direction[2] == glm::dvec3(0, 1, 0));
  CHECK(scalars_of(v) == values({1, 2, 0}));
  VolumeSource source;
  source.file = folder / "a.dcm";
  CHECK(files_of(source) == std::vector<fs::path>{folder / "a.dcm"});

  // Every position twice: two frames in time.
  write_bytes(folder / "a.dcm", enhanced({"5\\8\\7", "5\\10\\7", "5\\8\\7", "5\\10\\7"}, {upright}));
  CHECK(read_file(folder / "a.dcm").frames == 2);
  CHECK(scalars_of(read_file(folder / "a.dcm", 1)) == values({2, 3}));

  write_bytes(folder / "a.dcm", enhanced({"5\\8\\7", "5\\10\\7", "5\\19\\7"}, {upright}));
  CHECK(contains(refusal(folder / "a.dcm"), "uneven slice distances"));
  write_bytes(folder / "a.dcm", enhanced({"5\\8\\7", "5\\10\\7"}, {upright, "1\\0\\0\\0\\1\\0"}));
  CHECK(contains(refusal(folder / "a.dcm"), "different Image Orientations"));
}

TEST_CASE("a DICOM series is streamed slice by slice as it is read") {
  const CacheFolder cache;
  const TemporaryFolder folder;
  write_series(folder, 12, 1.25);
  check_streams(source_for(folder.path()));
  check_streams(source_for(folder / "1.2.3.1_7.dcm"));
  VolumeSource source = source_for(folder.path());
  source.spacing = glm::dvec3(1, 2, 3);
  check_streams(source);
  // The scan is kept: the second time not a slice is read.
  CHECK(stream_volume(source)->streamed->stream->bytes_read() == 0);
}

TEST_CASE("DICOM slices of several types are streamed in the type that holds all") {
  struct Kind {
    const char* slope;
    std::int16_t pixel;
  };
  // Whole numbers of 16 bits, fractions, and whole numbers that need 32 bits.
  const std::vector<std::vector<Kind>> series = {{{"1", 5}, {"0.5", 7}, {"1", 3}},
                                                 {{"1", 5}, {"100", 30000}, {"1", 3}},
                                                 {{"100", 30000}, {"0.25", 9}, {"1", 3}},
                                                 {{"0.5", 5}, {"0.5", 6}}};
  for (const std::vector<Kind>& kinds : series) {
    const CacheFolder cache;
    const TemporaryFolder folder;
    for (std::size_t k = 0; k < kinds.size(); ++k) {
      Slice s;
      s.instance = "1.2.3.1." + std::to_string(k + 1);
      s.position = "0\\0\\" + std::to_string(k);
      s.slope = kinds[k].slope;
      s.intercept = "0";
      s.pixels.assign(6, kinds[k].pixel);
      s.pixels[1] = static_cast<std::int16_t>(k);
      write_bytes(folder / (std::to_string(k) + ".dcm"), dicom(s));
    }
    check_streams(source_for(folder.path()));
    check_streams(source_for(folder.path())); // with the type that was kept
  }
}

TEST_CASE("a DICOM slice that shrinks or vanishes while it is streamed is refused") {
  const CacheFolder cache;
  const TemporaryFolder folder;
  write_series(folder, 5, 1);
  const auto streamed = stream_volume(source_for(folder.path()));
  REQUIRE(streamed);
  const auto again = stream_volume(source_for(folder.path()));
  // The scan left all slices of the first in memory; the second has read none.
  const fs::path file = folder / "1.2.3.1_3.dcm";
  fs::resize_file(file, fs::file_size(file) - 4);
  CHECK(contains(error_of([&] { crop(*again, {0, 0, 2}, {3, 2, 1}); }), "1.2.3.1_3.dcm: became shorter"));
  fs::remove(file);
  CHECK(contains(error_of([&] { crop(*again, {0, 0, 2}, {3, 2, 1}); }), "cannot be read"));
  CHECK(crop(*again, {0, 0, 0}, {3, 2, 2}).voxels.size() == 24);
}

TEST_CASE("the real DICOM series are streamed as they are read") {
  const CacheFolder cache;
  const fs::path real = fs::path(SLICELENS_SOURCE_DIR) / ".." / "shared" / "volumes";
  if (!fs::exists(real)) {
    std::puts("SKIPPED: no real volumes");
    return;
  }
  std::size_t count = 0;
  for (const char* name : {"ct_chest_large", "ct_head_gantry_tilt", "mri_head_dicom"}) {
    const VolumeSource source = source_for(real / name);
    std::optional<VolumeOutline> outline;
    const std::string problem = error_of([&] { outline = outline_of(source); });
    if (!problem.empty() || !outline || !outline->streams)
      continue;
    CAPTURE(name);
    check_streams(source);
    ++count;
  }
  CHECK(count >= 2);
}
