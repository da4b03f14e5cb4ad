#include "volume_files.h"

#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <sys/wait.h>

#include <random>

using namespace slicelens;
namespace fs = std::filesystem;

namespace {

const std::string nrrd =
    "NRRD0004\ntype: short\ndimension: 3\nsizes: 2 2 2\nspacings: 1 1 1\nendian: little\n"
    "encoding: raw\n\n0123456789abcdef";
const std::string meta =
    "ObjectType = Image\nNDims = 3\nDimSize = 2 2 2\nElementSpacing = 1 1 1\nOffset = 0 0 0\n"
    "ElementType = MET_SHORT\nElementDataFile = LOCAL\n0123456789abcdef";
const std::string vtk = "# vtk DataFile Version 3.0\nx\nBINARY\nDATASET STRUCTURED_POINTS\nDIMENSIONS 2 2 2\n"
                        "SPACING 1 1 1\nORIGIN 0 0 0\nPOINT_DATA 8\nSCALARS v short 1\nLOOKUP_TABLE default\n"
                        "0123456789abcdef";

struct Damage {
  std::string from;
  std::string to;
  std::string named; ///< what the message must name
};

void check_refused(const fs::path& path, const std::string& named) {
  const std::string text = refusal(path);
  CAPTURE(path, named, text);
  CHECK_FALSE(text.empty());
  CHECK(contains(text, path.filename().string()));
  CHECK(contains(text, named));
  CHECK_FALSE(contains(text, "\n"));
  CHECK(text.size() < 500);
}

void check_damages(const TemporaryFolder& folder, const std::string& name, const std::string& good,
                   const std::vector<Damage>& damages) {
  write_bytes(folder / name, good);
  REQUIRE(refusal(folder / name).empty());
  for (const Damage& damage : damages) {
    std::string bytes = good;
    REQUIRE(contains(bytes, damage.from));
    bytes.replace(bytes.find(damage.from), damage.from.size(), damage.to);
    write_bytes(folder / name, bytes);
    CAPTURE(damage.from, damage.to);
    check_refused(folder / name, damage.named);
  }
  write_bytes(folder / name, good.substr(0, good.size() - 1));
  check_refused(folder / name, "truncated");
  write_bytes(folder / name, good.substr(0, good.size() / 3));
  check_refused(folder / name, "");
}

} // namespace

TEST_CASE("a NRRD header that is wrong is refused by its field") {
  const TemporaryFolder folder;
  check_damages(
      folder, "a.nrrd", nrrd,
      {{"sizes: 2 2 2", "sizes: 100000 100000 100000", "sizes"},
       {"sizes: 2 2 2", "sizes: 9000000000 9000000000 9000000000", "sizes"},
       {"sizes: 2 2 2", "sizes: 99999999999999999999 2 2", "sizes"},
       {"sizes: 2 2 2", "sizes: 2 0 2", "sizes"},
       {"sizes: 2 2 2", "sizes: 2 -2 2", "sizes"},
       {"sizes: 2 2 2", "sizes: 2 2", "sizes"},
       {"sizes: 2 2 2", "sizes: 2 two 2", "sizes"},
       {"sizes: 2 2 2\n", "", "sizes"},
       {"dimension: 3", "dimension: 1000000000", "dimension"},
       {"dimension: 3", "dimension: -3", "dimension"},
       {"type: short", "type: block", "block"},
       {"type: short", "type: quaternion", "quaternion"},
       {"type: short\n", "", "type"},
       {"endian: little\n", "", "endian"},
       {"encoding: raw", "encoding: bzip2", "bzip2"},
       {"encoding: raw", "encoding: gzip", "gzip"},
       {"spacings: 1 1 1", "spacings: 1 nan 1", "spacings"},
       {"spacings: 1 1 1", "spacings: 1 inf 1", "spacings"},
       {"spacings: 1 1 1", "spacings: 0 1 1", "spacings"},
       {"spacings: 1 1 1", "kinds: complex domain domain", "complex"},
       {"spacings: 1 1 1", "kinds: 3D-symmetric-matrix domain domain", "matrix"},
       {"spacings: 1 1 1", "byte skip: -7", "byte skip"},
       {"spacings: 1 1 1", "byte skip: 4000000000000", "sizes"},
       {"spacings: 1 1 1", "data file: missing.raw", "missing.raw"},
       {"spacings: 1 1 1", "data file: s%s%n.raw 1 9 1", "pattern"},
       {"spacings: 1 1 1", "data file: s%d.raw 1 999999999 1", "pattern"},
       {"spacings: 1 1 1", "data file: LIST", ""},
       {"spacings: 1 1 1", "space: left-posterior-superior\nspace directions: (1,0,0) (2,0,0) (0,0,1)", ""},
       {"spacings: 1 1 1", "space: left-posterior-superior\nspace directions: (nan,0,0) (0,1,0) (0,0,1)", ""},
       {"NRRD0004", "NRXD0004", "NRRD"}});
}

TEST_CASE("a MetaImage header that is wrong is refused by its field") {
  const TemporaryFolder folder;
  check_damages(
      folder, "a.mha", meta,
      {{"DimSize = 2 2 2", "DimSize = 100000 100000 100000", "DimSize"},
       {"DimSize = 2 2 2", "DimSize = 9000000000 9000000000 9000000000", "DimSize"},
       {"DimSize = 2 2 2", "DimSize = 2 0 2", "DimSize"},
       {"DimSize = 2 2 2", "DimSize = 2 -2 2", "DimSize"},
       {"DimSize = 2 2 2", "DimSize = 2 2", "DimSize"},
       {"DimSize = 2 2 2\n", "", "DimSize"},
       {"NDims = 3", "NDims = 100000000", "NDims"},
       {"NDims = 3", "NDims = -1", "NDims"},
       {"MET_SHORT", "MET_STRING", "MET_STRING"},
       {"MET_SHORT", "MET_SHORT\nElementNumberOfChannels = 9", "ElementNumberOfChannels"},
       {"ElementSpacing = 1 1 1", "ElementSpacing = 1 nan 1", "ElementSpacing"},
       {"ElementSpacing = 1 1 1", "ElementSpacing = 1 0 1", "ElementSpacing"},
       {"ElementSpacing = 1 1 1", "ElementSpacing = 1 -1 1", "ElementSpacing"},
       {"Offset = 0 0 0", "Offset = 0 inf 0", "Offset"},
       {"Offset = 0 0 0", "TransformMatrix = 1 0 0 1 0 0 0 0 1", ""},
       {"Offset = 0 0 0", "CompressedData = True\nCompressedDataSize = 4000000000", "CompressedDataSize"},
       {"Offset = 0 0 0", "CompressedData = True", ""},
       {"Offset = 0 0 0", "HeaderSize = 999999999999", "DimSize"},
       {"= LOCAL", "= missing.raw", "missing.raw"},
       {"ElementDataFile = LOCAL", "Comment = none", ""}});
}

TEST_CASE("a legacy VTK header that is wrong is refused by its field") {
  const TemporaryFolder folder;
  check_damages(folder, "a.vtk", vtk,
                {{"DIMENSIONS 2 2 2", "DIMENSIONS 100000 100000 100000", "DIMENSIONS"},
                 {"DIMENSIONS 2 2 2", "DIMENSIONS 2 0 2", "DIMENSIONS"},
                 {"DIMENSIONS 2 2 2", "DIMENSIONS 2 -2 2", "DIMENSIONS"},
                 {"DIMENSIONS 2 2 2", "DIMENSIONS 2 x 2", "DIMENSIONS"},
                 {"SPACING 1 1 1", "SPACING 1 nan 1", "SPACING"},
                 {"SPACING 1 1 1", "SPACING 1 0 1", "SPACING"},
                 {"STRUCTURED_POINTS", "POLYDATA", "POLYDATA"},
                 {"SCALARS v short 1", "VECTORS v short", "VECTORS"},
                 {"SCALARS v short 1", "SCALARS v bit 1", "bit"},
                 {"SCALARS v short 1", "SCALARS v short 7", "components"},
                 {"BINARY", "MAYBE", "MAYBE"}});
  // Found by fuzzing: ITK took the sizes from the first of these lines and asked for 22 GB.
  std::string twice = vtk;
  twice.replace(twice.find("DIMENSIONS 2 2 2"), 16, "DIMENSIONS[3 2 2\nDIMENSIONS 2 2 2");
  write_bytes(folder / "twice.vtk", twice);
  CHECK(read_file(folder / "twice.vtk").dims == std::array<std::size_t, 3>{2, 2, 2});
}

TEST_CASE("what is no regular file with contents is refused at once") {
  const TemporaryFolder folder;
  check_refused(folder / "missing.nrrd", "no such file");
  write_bytes(folder / "empty.nrrd", "");
  check_refused(folder / "empty.nrrd", "empty");
  REQUIRE(::mkfifo((folder / "pipe.nrrd").c_str(), 0600) == 0);
  check_refused(folder / "pipe.nrrd", "regular file");
  check_refused("/dev/zero", "regular file");
  fs::create_directory(folder / "folder.nrrd");
  check_refused(folder / "folder.nrrd", "no images");
  fs::create_symlink(folder / "nowhere", folder / "dangling.nrrd");
  check_refused(folder / "dangling.nrrd", "no such file");
  write_bytes(folder / "text.txt", "hello");
  check_refused(folder / "text.txt", "no volume");
  // A data file that is a pipe would block the reader for ever.
  write_bytes(folder / "a.nhdr",
              "NRRD0004\ntype: uint8\ndimension: 1\nsizes: 1\nencoding: raw\ndata file: pipe.nrrd\n");
  CHECK(contains(refusal(folder / "a.nhdr"), "regular file"));
  if (::geteuid() != 0) {
    write_bytes(folder / "secret.nrrd", nrrd);
    fs::permissions(folder / "secret.nrrd", fs::perms::none);
    check_refused(folder / "secret.nrrd", "denied");
  }
  CHECK_THROWS_AS(read_volume(VolumeSource()), UsageError);
}

TEST_CASE("headers that claim 100000 cubed voxels allocate nothing") {
#ifdef __SANITIZE_ADDRESS__
  SLICELENS_SKIP("the address sanitizer needs the address space that this test limits");
#endif
  const TemporaryFolder folder;
  const auto with = [](std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
  };
  const std::string big = "100000 100000 100000";
  write_bytes(folder / "a.nrrd", with(nrrd, "2 2 2", big));
  write_bytes(folder / "gz.nrrd", with(with(nrrd, "2 2 2", big), "raw", "gzip"));
  write_bytes(folder / "text.nrrd", with(with(nrrd, "2 2 2", big), "raw", "ascii"));
  write_bytes(folder / "a.mha", with(meta, "2 2 2", big));
  write_bytes(folder / "z.mha", with(with(meta, "2 2 2", big), "Offset", "CompressedData = True\nOffset"));
  write_bytes(folder / "a.vtk", with(vtk, "2 2 2", big));
  write_bytes(folder / "a_100000x100000x100000_uint8.raw", "x");
  write_bytes(folder / "a.vti",
              "<VTKFile type=\"ImageData\"><ImageData WholeExtent=\"0 99999 0 99999 0 99999\"><Piece>"
              "<PointData><DataArray type=\"UInt8\" format=\"ascii\">1</DataArray></PointData>"
              "</Piece></ImageData></VTKFile>");
  std::string png = std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16) +
                    std::string("\0\1\x86\xa0\0\1\x86\xa0\x8\0\0\0\0", 13);
  png += bytes_of(std::vector<std::uint32_t>{static_cast<std::uint32_t>(
                      ::crc32(0, reinterpret_cast<const Bytef*>(png.data() + 12), 17))},
                  true);
  write_bytes(folder / "a.png", png + std::string("\0\0\0\0IEND\xae\x42\x60\x82", 12));
  for (const char* name : {"a.nrrd", "gz.nrrd", "text.nrrd", "a.mha", "z.mha", "a.vtk", "a.vti", "a.png",
                           "a_100000x100000x100000_uint8.raw"}) {
    const pid_t child = ::fork();
    REQUIRE(child >= 0);
    if (child == 0) {
      long pages = 0;
      std::ifstream("/proc/self/statm") >> pages;
      // Room for the libraries' own work, far below what the headers claim.
      const auto bytes =
          static_cast<rlim_t>(pages) * static_cast<rlim_t>(::sysconf(_SC_PAGE_SIZE)) + (64u << 20);
      const rlimit limit{bytes, bytes};
      ::setrlimit(RLIMIT_AS, &limit);
      const std::string text = refusal(folder / name);
      ::_exit(!text.empty() && !contains(text, "memory") ? 0 : 1);
    }
    int status = -1;
    ::waitpid(child, &status, 0);
    CAPTURE(name, refusal(folder / name));
    REQUIRE(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == 0);
  }
}

TEST_CASE("bytes changed at random are read or refused, never worse") {
  // 3 headers × 400 variants with a fixed seed; a crash, a hang or another exception fails the test.
  const TemporaryFolder folder;
  std::mt19937 random(7);
  const std::vector<std::pair<std::string, std::string>> files = {
      {"a.nrrd", nrrd}, {"a.mha", meta}, {"a.vtk", vtk}};
  for (const auto& [name, good] : files) {
    for (int variant = 0; variant < 400; ++variant) {
      std::string bytes = good;
      for (int change = 0; change < 1 + variant % 4; ++change)
        bytes[random() % (good.size() - 16)] = static_cast<char>("0123456789-. \n:=xN\xff"[random() % 19]);
      write_bytes(folder / name, bytes);
      const std::string text = refusal(folder / name);
      CAPTURE(name, bytes, text);
      REQUIRE_FALSE(contains(text, "\n"));
    }
  }
}
