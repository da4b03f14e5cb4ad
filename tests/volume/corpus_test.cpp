// Real volumes against what other readers found (corpus_table_test.cpp has every single file).
#include "volume/readers.h"
#include "volume_files.h"

#include <cmath>
#include <map>

using namespace slicelens;
namespace fs = std::filesystem;

namespace {

/// Dims (i fastest), smallest and largest value and mean that another reader found: PROVENANCE.txt of each
/// folder ("Loaded") and, without statistics, LOAD_REPORT.txt.
struct Known {
  std::array<std::size_t, 3> dims;
  double min;
  double max;
  double mean;
};

const std::map<std::string, Known>& known() {
  static const std::map<std::string, Known> volumes = {
      {"aneurism/aneurism.vti", {{256, 256, 256}, 0, 255, 1.0692102909088135}},
      {"bonsai/bonsai.nii.gz", {{256, 256, 256}, 0, 255, 13.464767456054688}},
      {"ct_chest_large/series", {{512, 512, 128}, -1000, 1872, -619.6633911132812}},
      {"ct_head_nifti/ct.nii.gz", {{208, 256, 225}, 0, 0.9995999932289124, 0.13000546395778656}},
      {"cthead_png16/slices", {{256, 256, 113}, 0, 3272, 361.2177734375}},
      {"digimouse_labels/digimouse_labels.nrrd", {{190, 496, 104}, 0, 21, 1.16344153881073}},
      {"engine/engine.vti", {{256, 256, 128}, 0, 255, 22.348766326904297}},
      {"frog_segmented/frogtissue.mhd", {{500, 470, 136}, 0, 29, 0.38421377539634705}},
      {"headsq_quarter/quarter.nhdr", {{64, 64, 93}, 0, 3926, 507.6872863769531}},
      {"lobster/lobster_301x324x56_uint8.raw", {{301, 324, 56}, 0, 255, 13.052595138549805}},
      {"mouse_mri/mouse_t1_1_norm.nii",
       {{128, 128, 20}, 1.9715001583099365, 32018.330078125, 7411.98974609375}},
      {"mri_head_dicom/series", {{256, 256, 100}, 0, 5888, 240.71200561523438}},
      {"seg3d_brain/MR.nii.gz", {{160, 232, 160}, 0, 512, 111.81326293945312}},
      {"small_raw/fuel_64x64x64_uint8.raw", {{64, 64, 64}, 0, 255, 1.9447898864746094}},
      {"tooth/tooth.nhdr", {{103, 94, 161}, 0, 1300, 526.8709106445312}},
      {"vismale_head/vismale_128x256x256_uint8.raw", {{128, 256, 256}, 1, 254, 35.24966049194336}},
  };
  return volumes;
}

bool plausible(const Volume& v) {
  return voxel_bytes(v) == v.voxels.size() && v.components >= 1 && v.components <= 4 && v.frames >= 1 &&
         v.spacing.x > 0 && v.spacing.y > 0 && v.spacing.z > 0 && std::isfinite(glm::length(v.origin)) &&
         std::abs(glm::determinant(v.direction)) > 1e-6 && v.min <= v.mean && v.mean <= v.max &&
         !v.format.empty();
}

/// Lines "path   ok   (a, b, c) type …" of a report, as path → sizes; other lines are left out. pydicom and
/// the NRRD reader print sizes fastest axis last and first.
std::map<std::string, std::vector<std::size_t>> reported(const fs::path& report) {
  std::map<std::string, std::vector<std::size_t>> sizes;
  std::ifstream in(report);
  for (std::string line; std::getline(in, line);) {
    const std::size_t ok = line.find(" ok ");
    const std::size_t open = line.find('(');
    const std::size_t close = line.find(')');
    if (ok == std::string::npos || open == std::string::npos || close == std::string::npos || open > ok + 8)
      continue;
    std::string text = line.substr(open + 1, close - open - 1);
    std::replace(text.begin(), text.end(), ',', ' ');
    std::istringstream numbers(text);
    std::vector<std::size_t> size;
    for (std::size_t n = 0; numbers >> n;)
      size.push_back(n);
    sizes[line.substr(0, line.find(' '))] = size;
  }
  return sizes;
}

} // namespace

TEST_CASE("the real volumes have the sizes and values that another reader found") {
  const fs::path folder = real_volumes();
  if (folder.empty())
    SLICELENS_SKIP("there is no folder of real volumes");
  for (const auto& [name, expected] : known()) {
    CAPTURE(name);
    const Volume v = read_file(folder / name);
    CHECK(plausible(v));
    CHECK(v.dims == expected.dims);
    // The other reader computed in 32-bit floats.
    CHECK(v.min == Approx(expected.min).epsilon(1e-6));
    CHECK(v.max == Approx(expected.max).epsilon(1e-6));
    CHECK(v.mean == Approx(expected.mean).epsilon(1e-4));
  }
}

TEST_CASE("the tricky files that another reader could read have its sizes here") {
  const fs::path folder = real_volumes();
  if (folder.empty())
    SLICELENS_SKIP("there is no folder of real volumes");
  // Mosaics need their own unpacking.
  const auto skipped = [](const std::string& name) { return contains(name, "siemens_mosaic"); };
  std::size_t compared = 0;
  for (const char* set : {"nrrd_tricky", "nifti_tricky", "metaimage_tricky", "dicom_transfer_syntaxes"}) {
    for (const auto& [name, sizes] : reported(folder / set / "LOAD_REPORT.txt")) {
      if (skipped(name))
        continue;
      CAPTURE(set, name);
      const Volume v = read_file(folder / set / name);
      std::vector<std::size_t> mine = {v.dims[0], v.dims[1], v.dims[2]};
      if (v.components > 1 && std::string(set) == "nrrd_tricky")
        mine.insert(mine.begin(), static_cast<std::size_t>(v.components));
      std::vector<std::size_t> theirs = sizes;
      if (std::string(set) == "dicom_transfer_syntaxes")
        std::reverse(theirs.begin(), theirs.end());
      // Axes of length 1 and axes of frames or components are counted differently: compare the space.
      theirs.resize(std::max<std::size_t>(theirs.size(), 3), 1);
      mine.resize(std::max<std::size_t>(mine.size(), 3), 1);
      for (std::size_t axis = 0; axis < 3; ++axis)
        CHECK(mine[axis] == theirs[axis]);
      ++compared;
    }
  }
  CHECK(compared > 60);
}

TEST_CASE("NIfTI read through ITK and directly are the same volume") {
  const fs::path folder = real_volumes();
  if (folder.empty())
    SLICELENS_SKIP("there is no folder of real volumes");
  std::size_t compared = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder / "nifti_tricky" / "orientations_12")) {
    CAPTURE(entry.path().string());
    const Volume a = read_file(entry.path());
    const Volume b = read_nifti_directly(entry.path(), 0, {});
    CHECK(a.dims == b.dims);
    CHECK(a.type == b.type);
    CHECK(a.voxels == b.voxels);
    // ITK keeps the header's floats; a few 1e-6 of the origin's 100 mm.
    CHECK(glm::length(a.origin - b.origin) < 1e-3);
    for (int axis = 0; axis < 3; ++axis) {
      CHECK(std::abs(a.spacing[axis] - b.spacing[axis]) < 1e-5);
      CHECK(glm::length(a.direction[axis] - b.direction[axis]) < 1e-5);
    }
    ++compared;
  }
  CHECK(compared == 6);
}
