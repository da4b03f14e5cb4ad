// Volumes whose voxels stay in raw files, NRRDs and MetaImages, against the same read in full.
#include "streamed_files.h"
#include "volume/write.h"

#include <sys/stat.h>

#include <cmath>
#include <limits>
#include <map>
#include <thread>

using namespace slicelens;
namespace fs = std::filesystem;

namespace {

const std::vector<ScalarType> all_types = {ScalarType::u8,  ScalarType::i8,  ScalarType::u16, ScalarType::i16,
                                           ScalarType::u32, ScalarType::i32, ScalarType::u64, ScalarType::i64,
                                           ScalarType::f32, ScalarType::f64};

std::string text_of(const Volume& volume) {
  return {reinterpret_cast<const char*>(volume.voxels.data()), volume.voxels.size()};
}

std::string swapped_text(const Volume& volume) {
  std::string text = text_of(volume);
  const std::size_t scalar = size_of(volume.type);
  for (std::size_t at = 0; at < text.size(); at += scalar)
    std::reverse(text.begin() + static_cast<std::ptrdiff_t>(at),
                 text.begin() + static_cast<std::ptrdiff_t>(at + scalar));
  return text;
}

} // namespace

TEST_CASE("every scalar type in every raw format is streamed as it is read") {
  const CacheFolder cache;
  const TemporaryFolder folder;
  for (const ScalarType type : all_types) {
    const Volume volume = random_volume(type, {37, 21, 13});
    for (const char* name : {"a.nrrd", "b.nhdr", "c.mha", "d.mhd"}) {
      CAPTURE(name, name_of(type));
      write_volume(volume, folder / name);
      check_streams(source_for(folder / name));
    }
    VolumeSource raw = source_for(folder.put("plain.raw", text_of(volume)));
    raw.size = volume.dims;
    raw.type = type;
    raw.spacing = glm::dvec3(2, 3, 4);
    check_streams(raw);
    raw.file = folder.put("big.raw", swapped_text(volume));
    raw.big_endian = true;
    check_streams(raw);
  }
}

TEST_CASE("a single voxel, row, column and plane are streamed") {
  const CacheFolder cache;
  const TemporaryFolder folder;
  for (const std::array<std::size_t, 3> dims : std::vector<std::array<std::size_t, 3>>{
           {1, 1, 1}, {9, 1, 1}, {1, 17, 1}, {1, 1, 33}, {8, 16, 24}, {100, 3, 2}}) {
    CAPTURE(dims[0], dims[1], dims[2]);
    write_volume(random_volume(ScalarType::i16, dims), folder / "a.nrrd");
    check_streams(source_for(folder / "a.nrrd"));
  }
}

TEST_CASE("planes larger than a piece of the scan are taken in pieces") {
  const CacheFolder cache;
  const TemporaryFolder folder;
  // 1500 × 1000 doubles are 12 MB: three pieces, whose borders lie within cells and their reach.
  write_volume(random_volume(ScalarType::f64, {1500, 1000, 3}), folder / "a.nrrd");
  check_streams(source_for(folder / "a.nrrd"));
}

TEST_CASE("values that are no numbers are scanned as statistics and cells take them") {
  const CacheFolder cache;
  const TemporaryFolder folder;
  Volume volume = random_volume(ScalarType::f32, {40, 30, 20});
  float* const voxels = reinterpret_cast<float*>(volume.voxels.data());
  voxels[0] = std::numeric_limits<float>::quiet_NaN();
  voxels[777] = std::numeric_limits<float>::infinity();
  voxels[12345] = -std::numeric_limits<float>::infinity();
  for (std::size_t k = 0; k < 20; ++k) { // cells without any number
    for (std::size_t j = 0; j < 30; ++j) {
      for (std::size_t i = 20; i < 40; ++i)
        voxels[(k * 30 + j) * 40 + i] = std::numeric_limits<float>::quiet_NaN();
    }
  }
  write_volume(volume, folder / "a.nrrd");
  check_streams(source_for(folder / "a.nrrd"));
  for (std::size_t i = 0; i < 40 * 30 * 20; ++i)
    voxels[i] = std::numeric_limits<float>::quiet_NaN();
  write_volume(volume, folder / "b.nrrd");
  const auto all = stream_volume(source_for(folder / "b.nrrd"));
  REQUIRE(all);
  CHECK(all->non_finite == 24000);
  CHECK(all->min == 0);
  CHECK(all->max == 0);
  CHECK(all->streamed->cells.smallest == cell_ranges(read_file(folder / "b.nrrd"), 2).smallest);
}

TEST_CASE("NRRDs in several files, behind lines and bytes, with frames and components are streamed") {
  const CacheFolder cache;
  const TemporaryFolder folder;
  const Volume volume = random_volume(ScalarType::u16, {6, 5, 4});
  const std::string bytes = text_of(volume);
  const std::string head = "NRRD0005\ntype: ushort\nendian: little\nencoding: raw\ndimension: ";
  const std::string sizes = "3\nsizes: 6 5 4\n";
  for (int k = 0; k < 4; ++k)
    folder.put("plane" + std::to_string(k) + ".raw", bytes.substr(static_cast<std::size_t>(k) * 60, 60));
  folder.put("pattern.nhdr", head + sizes + "data file: plane%d.raw 0 3 1\n");
  folder.put("list.nhdr", head + sizes + "data file: LIST\nplane0.raw\nplane1.raw\nplane2.raw\nplane3.raw\n");
  folder.put("behind.raw", "a line\nanother\nheader" + bytes);
  folder.put("skip.nhdr", head + sizes + "line skip: 2\nbyte skip: 6\ndata file: behind.raw\n");
  folder.put("end.nhdr", head + sizes + "byte skip: -1\ndata file: behind.raw\n");
  for (const char* name : {"pattern.nhdr", "list.nhdr", "skip.nhdr", "end.nhdr"})
    check_streams(source_for(folder / name));
  folder.put("big.nrrd", "NRRD0005\ntype: ushort\nendian: big\nencoding: raw\ndimension: 3\nsizes: 6 5 "
                         "4\n\n" +
                             swapped_text(volume));
  check_streams(source_for(folder / "big.nrrd"));
  // 120 numbers as frames first, between, and last, and as components at every place.
  const std::map<std::string, std::string> axes = {
      {"first", "sizes: 3 5 4 2\nkinds: list domain domain domain\n"},
      {"time", "sizes: 5 4 2 3\nkinds: domain domain domain time\n"},
      {"between", "sizes: 5 4 3 2\nkinds: domain domain time domain\n"},
      {"rgb", "sizes: 3 5 4 2\nkinds: RGB-color domain domain domain\n"},
      {"planes", "sizes: 5 4 2 3\nkinds: domain domain domain RGB-color\n"},
      {"rows", "sizes: 5 3 4 2\nkinds: domain RGB-color domain domain\n"}};
  std::size_t streamed = 0;
  for (const auto& [name, fields] : axes) {
    CAPTURE(name);
    VolumeSource source = source_for(folder.put(name + ".nrrd", head + "4\n" + fields + "\n" + bytes));
    const Volume loaded = read_volume(source);
    for (std::size_t i = 0; i < 3; ++i) {
      if (loaded.frames > 1)
        source.frame = i;
      if (loaded.components > 1)
        source.component = static_cast<int>(i);
      check_streams(source);
      ++streamed;
    }
  }
  CHECK(streamed == 18);
  // Without a choice the components are kept together, in memory.
  CHECK_FALSE(stream_volume(source_for(folder / "rgb.nrrd")));
  CHECK_FALSE(outline_of(source_for(folder / "rgb.nrrd"))->streams);
}

TEST_CASE("MetaImages in several files, behind headers and at the end are streamed") {
  const CacheFolder cache;
  const TemporaryFolder folder;
  const Volume volume = random_volume(ScalarType::i16, {6, 5, 4});
  const std::string bytes = text_of(volume);
  const std::string head = "ObjectType = Image\nNDims = 3\nDimSize = 6 5 4\nElementType = MET_SHORT\n"
                           "ElementSpacing = 0.5 1 2\n";
  for (int k = 1; k <= 4; ++k) {
    folder.put("s" + std::to_string(k) + ".raw", bytes.substr(static_cast<std::size_t>(k - 1) * 60, 60));
    folder.put("h" + std::to_string(k) + ".raw",
               "lead" + bytes.substr(static_cast<std::size_t>(k - 1) * 60, 60));
  }
  folder.put("all.raw", bytes);
  folder.put("end.raw", "some header" + bytes);
  folder.put("big.raw", swapped_text(volume));
  const std::map<std::string, std::string> files = {
      {"one.mhd", head + "ElementDataFile = all.raw\n"},
      {"list.mhd", head + "ElementDataFile = LIST\ns1.raw\ns2.raw\ns3.raw\ns4.raw\n"},
      {"pattern.mhd", head + "ElementDataFile = s%d.raw 1 4 1\n"},
      {"lead.mhd", head + "HeaderSize = 4\nElementDataFile = LIST\nh1.raw\nh2.raw\nh3.raw\nh4.raw\n"},
      {"end.mhd", head + "HeaderSize = -1\nElementDataFile = end.raw\n"},
      {"ends.mhd", head + "HeaderSize = -1\nElementDataFile = h%d.raw 1 4 1\n"},
      {"big.mhd", head + "BinaryDataByteOrderMSB = True\nElementDataFile = big.raw\n"},
      {"local.mha", head + "ElementDataFile = LOCAL\n" + bytes}};
  for (const auto& [name, text] : files)
    check_streams(source_for(folder.put(name, text)));
  // Frames and channels.
  VolumeSource source =
      source_for(folder.put("time.mhd", "ObjectType = Image\nNDims = 4\nDimSize = 5 4 2 3\nElementType = "
                                        "MET_SHORT\nElementDataFile = all.raw\n"));
  for (source.frame = 0; source.frame < 3; ++source.frame)
    check_streams(source);
  source = source_for(folder.put("rgb.mhd", "ObjectType = Image\nNDims = 3\nDimSize = 5 4 2\n"
                                            "ElementNumberOfChannels = 3\nElementType = "
                                            "MET_SHORT\nElementDataFile = all.raw\n"));
  for (const int component : {0, 1, 2}) {
    source.component = component;
    check_streams(source);
  }
}

TEST_CASE("what cannot be streamed says so, and what cannot be read is refused as by reading") {
  const CacheFolder cache;
  const TemporaryFolder folder;
  const Volume volume = random_volume(ScalarType::u8, {6, 5, 4});
  WriteOptions packed;
  packed.compress = true;
  for (const char* name : {"a.nrrd", "a.mha"}) {
    write_volume(volume, folder / name, packed);
    CHECK_FALSE(stream_volume(source_for(folder / name)));
    const auto outline = outline_of(source_for(folder / name));
    REQUIRE(outline);
    CHECK_FALSE(outline->streams);
    CHECK(outline->volume.dims == volume.dims);
    CHECK(outline->volume.type == volume.type);
  }
  const std::string head = "NRRD0005\ntype: uchar\nencoding: raw\ndimension: 3\nsizes: 6 5 4\n\n";
  VolumeSource source = source_for(folder.put("short.nrrd", head + std::string(119, 'x')));
  CHECK(error_of([&] { stream_volume(source); }) == error_of([&] { read_volume(source); }));
  source.file = folder.put("whole.nrrd", head + std::string(120, 'x'));
  source.frame = 1;
  CHECK(error_of([&] { stream_volume(source); }) == error_of([&] { read_volume(source); }));
  source.frame = 0;
  source.component = 2;
  CHECK(error_of([&] { stream_volume(source); }) == error_of([&] { read_volume(source); }));
  source.component.reset();
  source.type = ScalarType::u8;
  CHECK(error_of([&] { stream_volume(source); }) == error_of([&] { read_volume(source); }));
  CHECK(error_of([&] { stream_volume(source_for(folder / "none.nrrd")); }) ==
        error_of([&] { read_volume(source_for(folder / "none.nrrd")); }));
}

TEST_CASE("the real raw NRRDs, MetaImages and raw files are streamed as they are read") {
  const CacheFolder cache;
  const fs::path real = fs::path(SLICELENS_SOURCE_DIR) / ".." / "shared" / "volumes";
  if (!fs::exists(real)) {
    std::puts("SKIPPED: no real volumes");
    return;
  }
  std::size_t count = 0;
  for (const auto& entry : fs::recursive_directory_iterator(real)) {
    const std::string extension = entry.path().extension().string();
    if (extension != ".nrrd" && extension != ".nhdr" && extension != ".mha" && extension != ".mhd" &&
        extension != ".raw")
      continue;
    const VolumeSource source = source_for(entry.path());
    std::optional<VolumeOutline> outline;
    const std::string problem = error_of([&] { outline = outline_of(source); });
    if (!problem.empty()) { // damaged on purpose, or without its header
      CHECK(error_of([&] { read_volume(source); }) == problem);
      continue;
    }
    REQUIRE(outline);
    if (!outline->streams)
      continue;
    check_streams(source);
    ++count;
  }
  CHECK(count >= 10);
}

TEST_CASE("a file that shrinks or is changed while it is streamed is refused in one line") {
  const CacheFolder cache;
  const TemporaryFolder folder;
  const Volume volume = random_volume(ScalarType::u16, {64, 64, 64});
  const fs::path file = folder / "a.nrrd";
  write_volume(volume, file);
  const auto streamed = stream_volume(source_for(file));
  REQUIRE(streamed);
  fs::resize_file(file, fs::file_size(file) / 2);
  const std::string shorter = error_of([&] { crop(*streamed, {0, 0, 60}, {64, 64, 4}); });
  CHECK(contains(shorter, "a.nrrd: became shorter while its voxels were read"));
  // Also where the box is still there: half a volume of the old and half of nothing is no picture.
  CHECK(contains(error_of([&] { crop(*streamed, {0, 0, 0}, {64, 64, 4}); }), "became shorter"));

  write_volume(volume, folder / "b.mhd");
  const auto other = stream_volume(source_for(folder / "b.mhd"));
  REQUIRE(other);
  std::this_thread::sleep_for(std::chrono::milliseconds(20)); // above the file system's clock tick
  std::fstream(folder / "b.raw", std::ios::in | std::ios::out | std::ios::binary) << "x";
  CHECK(contains(error_of([&] { crop(*other, {0, 0, 0}, {64, 64, 64}); }), "was changed while"));
}

TEST_CASE("several threads read one stream") {
  const CacheFolder cache;
  const TemporaryFolder folder;
  const Volume volume = random_volume(ScalarType::i16, {50, 40, 30});
  write_volume(volume, folder / "a.mha");
  const auto streamed = stream_volume(source_for(folder / "a.mha"));
  REQUIRE(streamed);
  std::vector<std::thread> threads;
  std::vector<int> equal(4, 0);
  for (std::size_t t = 0; t < 4; ++t) {
    threads.emplace_back([&, t] {
      for (std::size_t k = 0; k + 5 < 30; ++k)
        equal[t] +=
            crop(*streamed, {t, 1, k}, {45, 30, 5}).voxels == crop(volume, {t, 1, k}, {45, 30, 5}).voxels;
    });
  }
  for (std::thread& thread : threads)
    thread.join();
  CHECK(equal == std::vector<int>(4, 25));
}

TEST_CASE("a scan is kept until the file changes, and made again where it is damaged") {
  const CacheFolder cache;
  const TemporaryFolder folder;
  const fs::path file = folder / "a.nrrd";
  write_volume(random_volume(ScalarType::i16, {50, 40, 30}), file);
  std::string warnings;
  Progress progress;
  progress.warn = [&](const std::string& message) { warnings += message + "\n"; };
  const auto bytes = [&] {
    return stream_volume(source_for(file), progress)->streamed->stream->bytes_read();
  };
  CHECK(bytes() == 120000);
  REQUIRE(cache.files(".scan").size() == 1);
  CHECK(bytes() == 0);
  check_streams(source_for(file));
  // Damaged in every part, and cut: it is made again, and says why.
  const fs::path kept = cache.files(".scan").front();
  const std::uintmax_t size = fs::file_size(kept);
  for (const std::uintmax_t at : {std::uintmax_t{0}, std::uintmax_t{9}, size / 2, size - 1}) {
    CAPTURE(at);
    std::fstream damage(kept, std::ios::in | std::ios::out | std::ios::binary);
    damage.seekg(static_cast<std::streamoff>(at));
    const int old = damage.get();
    damage.seekp(static_cast<std::streamoff>(at));
    damage.put(static_cast<char>(old ^ 1));
    damage.close();
    warnings.clear();
    CHECK(bytes() == 120000);
    CHECK(contains(warnings, "is damaged; it is made again"));
    CHECK(bytes() == 0);
  }
  fs::resize_file(kept, size / 2);
  CHECK(bytes() == 120000);
  fs::resize_file(kept, 3);
  CHECK(bytes() == 120000);
  check_streams(source_for(file));
  // Other voxels of the file are another scan; another file of the same name too.
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  write_volume(random_volume(ScalarType::i16, {50, 40, 30}, 1, 99), file);
  CHECK(bytes() == 120000);
  check_streams(source_for(file));
}

TEST_CASE("without a place for scans streaming warns and goes on") {
  const TemporaryFolder folder;
  folder.put("file", "");
  ::setenv("XDG_CACHE_HOME", (folder / "file").c_str(), 1);
  write_volume(random_volume(ScalarType::i16, {20, 10, 5}), folder / "a.nrrd");
  std::string warnings;
  Progress progress;
  progress.warn = [&](const std::string& message) { warnings += message + "\n"; };
  CHECK(stream_volume(source_for(folder / "a.nrrd"), progress).has_value());
  CHECK(contains(warnings, "reads the whole volume once more"));
  ::unsetenv("XDG_CACHE_HOME");
}
