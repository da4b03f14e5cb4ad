// What becomes of every file in the folder of real volumes.
#include "volume_files.h"

#include <cmath>
#include <map>
#include <set>

using namespace slicelens;
namespace fs = std::filesystem;

namespace {

/// What a reader of another make found in frame 0: a page of Python that unpacks NIfTI and NRRD with nothing
/// but struct, gzip and bz2. `weighted` is the mean of value * (index modulo 7) of component 0, which another
/// order of the voxels changes; `last` the last scalar.
struct Read {
  std::array<std::size_t, 3> dims;
  int components;
  std::size_t frames;
  double weighted;
  double last;
};

const std::map<std::string, Read>& read_files() {
  static const std::map<std::string, Read> files = {
      {"bonsai/bonsai.nii.gz", {{256, 256, 256}, 1, 1, 40.3945764, 0}},
      {"ct_head_nifti/ct.nii.gz", {{208, 256, 225}, 1, 1, 0.390012238, 0}},
      {"digimouse_labels/digimouse_labels.nrrd", {{190, 496, 104}, 1, 1, 3.48934002, 0}},
      {"headsq_quarter/quarter.nhdr", {{64, 64, 93}, 1, 1, 1523.32449, 0}},
      {"lobster/lobster_120x120x34.nhdr", {{120, 120, 34}, 1, 1, 843.876569, 0}},
      {"mouse_mri/mouse_t1_1_mask.nii", {{128, 128, 20}, 1, 1, 0.376834106, 0}},
      {"mouse_mri/mouse_t1_1_norm.nii", {{128, 128, 20}, 1, 1, 22241.341, 377.029419}},
      {"nifti_tricky/bisweb/sag_2mm_defaced.nii.gz", {{128, 128, 88}, 1, 1, 215.474558, 0}},
      {"nifti_tricky/minimal/minimal.hdr.gz", {{64, 64, 10}, 1, 1, 94.4969238, 63}},
      {"nifti_tricky/minimal/minimal.nii.gz", {{64, 64, 10}, 1, 1, 94.4969238, 63}},
      {"nifti_tricky/nibabel/anatomical.nii", {{33, 41, 25}, 1, 1, 25218.1787, 2971}},
      {"nifti_tricky/nibabel/example_nifti2.nii.gz", {{32, 20, 12}, 1, 2, 1351.84089, 484}},
      {"nifti_tricky/nibabel/functional.nii", {{17, 21, 3}, 1, 20, 10866.3019, 3142.83881}},
      {"nifti_tricky/nibabel/reoriented_anat_moved.nii", {{21, 26, 22}, 1, 1, 8276.40396, 0}},
      {"nifti_tricky/nibabel/standard.nii.gz", {{4, 5, 7}, 1, 1, 187.607143, 255}},
      {"nifti_tricky/nifti_clib/ATestReferenceImageForReadingAndWriting.nii.gz",
       {{23, 17, 11}, 1, 21, 1995.82155, 1203}},
      {"nifti_tricky/nifti_reader_js/5D_small.nii", {{1, 2, 3}, 3, 1, 1.34474076, 0.454784324}},
      {"nifti_tricky/nifti_reader_js/5D_zeros.nii.gz", {{256, 256, 170}, 3, 1, 0, 0}},
      {"nifti_tricky/nifti_reader_js/air.hdr.gz", {{79, 67, 64}, 1, 1, 100.945815, 0}},
      {"nifti_tricky/nifti_reader_js/air2.hdr.gz", {{79, 67, 64}, 1, 1, 100.945815, 0}},
      {"nifti_tricky/nifti_reader_js/avg152T1_LR_nifti.nii", {{91, 109, 91}, 1, 1, 248.499403, 4}},
      {"nifti_tricky/nifti_reader_js/avg152T1_LR_nifti2.nii.gz", {{91, 109, 91}, 1, 1, 248.499403, 4}},
      {"nifti_tricky/nifti_reader_js/big.nii.gz", {{64, 64, 21}, 1, 1, 0.404401981, 0}},
      {"nifti_tricky/nifti_reader_js/little.nii.gz", {{64, 64, 21}, 1, 1, 0.404401981, 0}},
      {"nifti_tricky/niivue/CT_pitch.nii.gz", {{175, 248, 58}, 1, 1, 113.807142, 0}},
      {"nifti_tricky/niivue/ct_perfusion.nii.gz", {{256, 286, 15}, 3, 1, 47.0009706, 1}},
      {"nifti_tricky/niivue/spmMotor.nii.gz", {{79, 95, 79}, 1, 1, 0.637720949, 0}},
      {"nifti_tricky/orientations_12/AIR.nii.gz", {{79, 67, 64}, 1, 1, 100.945814, 0}},
      {"nifti_tricky/orientations_12/ASL.nii.gz", {{79, 67, 64}, 1, 1, 100.960104, 0}},
      {"nifti_tricky/orientations_12/LAS.nii.gz", {{64, 79, 67}, 1, 1, 100.960104, 0}},
      {"nifti_tricky/orientations_12/LPS.nii.gz", {{64, 79, 67}, 1, 1, 100.942043, 0}},
      {"nifti_tricky/orientations_12/RAS.nii.gz", {{64, 79, 67}, 1, 1, 100.962877, 0}},
      {"nifti_tricky/orientations_12/RPI.nii.gz", {{64, 79, 67}, 1, 1, 100.929088, 0}},
      {"nrrd_tricky/nrrd_jl/bswap.nrrd", {{2, 2, 1}, 1, 1, 128.75, 2}},
      {"nrrd_tricky/nrrd_jl/eltype_gray_u12.nrrd", {{3, 5, 1}, 1, 1, 2916.8, 1169}},
      {"nrrd_tricky/nrrd_jl/eltype_gray_u16.nrrd", {{3, 5, 1}, 1, 1, 110920.867, 39995}},
      {"nrrd_tricky/nrrd_jl/eltype_gray_u8.nrrd", {{3, 5, 1}, 1, 1, 418.933333, 92}},
      {"nrrd_tricky/nrrd_jl/eltype_rgb_u8.nrrd", {{3, 5, 1}, 3, 1, 387.333333, 190}},
      {"nrrd_tricky/nrrd_jl/eltype_u8.nrrd", {{3, 5, 1}, 1, 1, 344.133333, 42}},
      {"nrrd_tricky/nrrd_jl/eltype_uint8.nrrd", {{3, 5, 1}, 1, 1, 378.066667, 6}},
      {"nrrd_tricky/nrrd_jl/fiji-stack-microns-16bit.nrrd", {{50, 40, 30}, 1, 1, 96335.7792, 64225}},
      {"nrrd_tricky/nrrd_jl/small.nrrd", {{10, 10, 10}, 1, 1, 279.116717, 95.9178696}},
      {"nrrd_tricky/nrrd_jl/small_time.nrrd", {{5, 5, 5}, 1, 5, 145.029831, 17.2034355}},
      {"nrrd_tricky/nrrd_jl/smallgz.nrrd", {{10, 10, 10}, 1, 1, 279.116717, 95.9178696}},
      {"nrrd_tricky/nrrd_jl/units.nhdr", {{10, 10, 10}, 1, 1, 279.116717, 95.9178696}},
      {"nrrd_tricky/pynrrd/BallBinary30x30x30.nhdr", {{30, 30, 30}, 1, 1, 409.572333, 0}},
      {"nrrd_tricky/pynrrd/BallBinary30x30x30.nii.gz", {{30, 30, 30}, 1, 1, 409.572333, 0}},
      {"nrrd_tricky/pynrrd/BallBinary30x30x30.nrrd", {{30, 30, 30}, 1, 1, 409.572333, 0}},
      {"nrrd_tricky/pynrrd/BallBinary30x30x30_byteskip_minus_one.nhdr", {{30, 30, 30}, 1, 1, 409.572333, 0}},
      {"nrrd_tricky/pynrrd/BallBinary30x30x30_byteskip_minus_one_nifti.nhdr",
       {{30, 30, 30}, 1, 1, 409.572333, 0}},
      {"nrrd_tricky/pynrrd/BallBinary30x30x30_bz2.nrrd", {{30, 30, 30}, 1, 1, 409.572333, 0}},
      {"nrrd_tricky/pynrrd/BallBinary30x30x30_gz.nrrd", {{30, 30, 30}, 1, 1, 409.572333, 0}},
      {"nrrd_tricky/pynrrd/BallBinary30x30x30_gz_byteskip_minus_one.nrrd",
       {{30, 30, 30}, 1, 1, 409.572333, 0}},
      {"nrrd_tricky/pynrrd/BallBinary30x30x30_nifti.nhdr", {{30, 30, 30}, 1, 1, 441.585926, 0}},
      {"nrrd_tricky/pynrrd/test1d_ascii.nrrd", {{27, 1, 1}, 1, 1, 43.037037, 27}},
      {"nrrd_tricky/pynrrd/test2d_ascii.nrrd", {{3, 9, 1}, 1, 1, 43.037037, 27}},
      {"nrrd_tricky/pynrrd/test_customFields.nrrd", {{27, 1, 1}, 1, 1, 43.037037, 27}},
      {"nrrd_tricky/pynrrd/test_simple4d_raw.nrrd", {{1, 1, 1}, 1, 1, 0, 0.76903426}},
      {"nrrd_tricky/vtk/beach.ascii.nhdr", {{100, 100, 1}, 1, 1, 2.3763817, 1}},
      {"nrrd_tricky/vtk/beach.nrrd", {{3, 100, 100}, 1, 1, 581.0457, 255}},
      {"seg3d_brain/Brain.nrrd", {{160, 232, 160}, 1, 1, 0.920851798, 0}},
      {"seg3d_brain/BrainSkull.nrrd", {{160, 232, 160}, 1, 1, 1.22697064, 0}},
      {"seg3d_brain/MR.nii.gz", {{160, 232, 160}, 1, 1, 335.415983, 0}},
      {"seg3d_brain/Skull.nrrd", {{160, 232, 160}, 1, 1, 0.269237776, 0}},
      {"tooth/tooth.nhdr", {{103, 94, 161}, 1, 1, 1580.63067, 379}},
  };
  return files;
}

/// Other formats: size, smallest and largest value as pydicom with GDCM and other readers reported them
/// (LOAD_REPORT.txt, PROVENANCE.txt), DICOM's after the rescale that the file gives.
struct Ranged {
  std::array<std::size_t, 3> dims;
  double min;
  double max;
};

const std::map<std::string, Ranged>& ranged_files() {
  const std::string ct = "dicom_transfer_syntaxes/ct_one_slice_16_syntaxes/CTImage.dcm";
  const std::string uid = "TransferSyntax_1.2.840.10008.1.2";
  const std::string enhanced = "dicom_transfer_syntaxes/enhanced_multiframe/emri_small";
  const Ranged lossless{{512, 512, 1}, -3024, 1378};
  const Ranged twelve_bits{{512, 512, 1}, -3052.87638, 1369.66}; // 497 and 2708 stored
  const Ranged small{{64, 64, 10}, 0, 467};
  static const std::map<std::string, Ranged> files = {
      {"aneurism/aneurism.vti", {{256, 256, 256}, 0, 255}},
      {"engine/engine.vti", {{256, 256, 128}, 0, 255}},
      {"engine/engine_small.mhd", {{128, 128, 64}, 0, 255}},
      {"frog_segmented/frogtissue.mhd", {{500, 470, 136}, 0, 29}},
      {"lobster/lobster_301x324x56_uint8.raw", {{301, 324, 56}, 0, 255}},
      {"metaimage_tricky/vtk_2d_float/Gourds.mha", {{640, 480, 1}, 0, 208.89219665527344}},
      {"metaimage_tricky/vtk_2d_foot/foot.mha", {{256, 256, 1}, 0, 218}},
      {"metaimage_tricky/vtk_headmr/HeadMRVolume.mhd", {{48, 62, 42}, 0, 255}},
      {"small_raw/Bucky_32x32x32_uint8.raw", {{32, 32, 32}, 0, 255}},
      {"small_raw/fuel_64x64x64_uint8.raw", {{64, 64, 64}, 0, 255}},
      {"small_raw/neghip_64x64x64_uint8.raw", {{64, 64, 64}, 0, 255}},
      {"small_raw/silicium_98x34x34_uint8.raw", {{98, 34, 34}, 0, 255}},
      {"tooth/tooth_103x94x161_uint8.raw", {{103, 94, 161}, 0, 255}},
      {"vismale_head/vismale_128x256x256_uint8.raw", {{128, 256, 256}, 1, 254}},
      {"ct_chest_large/series", {{512, 512, 128}, -1000, 1872}},
      {"mri_head_dicom/series", {{256, 256, 100}, 0, 5888}},
      {"cthead_png16/slices", {{256, 256, 113}, 0, 3272}},
      {ct, lossless},
      {ct + "_BigEndianExplicit" + uid + ".2.dcm", lossless},
      {ct + "_DeflatedExplicitVRLittleEndian" + uid + ".1.99.dcm", lossless},
      {ct + "_JPEG2000LosslessOnly" + uid + ".4.90.dcm", lossless},
      {ct + "_JPEG2000" + uid + ".4.91.dcm", {{512, 512, 1}, -3027, 1377}},
      {ct + "_JPEGLSLossless" + uid + ".4.80.dcm", lossless},
      {ct + "_JPEGLSLossy" + uid + ".4.81.dcm", {{512, 512, 1}, -3025, 1377}},
      // Two that pydicom could not decode and GDCM can: the same picture in 12 bits.
      {ct + "_JPEGProcess10_12" + uid + ".4.55.dcm", twelve_bits},
      {ct + "_JPEGProcess6_8" + uid + ".4.53.dcm", twelve_bits},
      {ct + "_JPEGProcess2_4" + uid + ".4.51.dcm", twelve_bits},
      {ct + "_JPEGProcess14SV1" + uid + ".4.70.dcm", lossless},
      {ct + "_JPEGProcess14" + uid + ".4.57.dcm", lossless},
      {ct + "_JPEGProcess1" + uid + ".4.50.dcm", {{512, 512, 1}, -3083.35, 1349.43}}, // 30 and 168 stored
      {ct + "_LittleEndianExplicit" + uid + ".1.dcm", lossless},
      {ct + "_LittleEndianImplicit" + uid + ".dcm", lossless},
      {ct + "_RLELossless" + uid + ".5.dcm", lossless},
      {enhanced + ".dcm", small},
      {enhanced + "_big_endian.dcm", small},
      {enhanced + "_jpeg_2k_lossless.dcm", small},
      {enhanced + "_jpeg_ls_lossless.dcm", small},
  };
  return files;
}

/// Endings of names of files that are refused, and the words that say why.
const std::vector<std::pair<std::string, std::string>>& refused_files() {
  static const std::vector<std::pair<std::string, std::string>> endings = {
      {"/README.md", "is no volume that Slicelens knows"},
      {"README.md", "is no volume that Slicelens knows"},
      {"/PROVENANCE.txt", "is no volume that Slicelens knows"},
      {"/LOAD_REPORT.txt", "is no volume that Slicelens knows"},
      {"/SHA256SUMS.txt", "is no volume that Slicelens knows"},
      {"ct_head_gantry_tilt/series", "has uneven slice distances from 1.0811 to 6.9986 mm and is sheared by"},
      {"siemens_mosaic_9_syntaxes/#.dcm", "is a Siemens mosaic"},
      {"engine/engine_small.raw", "is headerless and its size is not known"},
      {"frog_segmented/frogtissue.zraw", "is no volume that Slicelens knows"},
      {"headsq_quarter/quarter.#", "is no volume that Slicelens knows"},
      {"lobster/lobster_120x120x34.dat", "is no volume that Slicelens knows"},
      {"small_raw/fuel_64x64x64_uint8.dat", "is no volume that Slicelens knows"},
      {"vtk_2d_foot/foot.raw", "is headerless and its size is not known"},
      {"vtk_headmr/HeadMRVolume.raw", "is headerless and its size is not known"},
      {"nrrd_jl/small.raw", "is headerless and its size is not known"},
      {"pynrrd/BallBinary30x30x30.raw", "is headerless and its scalar type is not known"},
      {"tooth/tooth.raw", "is headerless and its size is not known; name tooth.nhdr beside it"},
      {"vtk/beach.ascii", "is no volume that Slicelens knows"},
      {"nibabel/analyze.hdr", "its data file 'analyze.img' is missing"},
      {"nibabel/nifti1.hdr", "its data file 'nifti1.img' is missing"},
      {"nibabel/nifti2.hdr", "its data file 'nifti2.img' is missing"},
      {"nibabel/row_major.dconn.nii", "is CIFTI"},
      {"nifti_clib/rand.hdr", "'sizeof_hdr' is neither 348 nor 540"},
      {"nifti_reader_js/not-nifti.nii", "'sizeof_hdr' is neither 348 nor 540"},
      {".nhdr", "dummy.raw' is missing"}, // of nrrd_jl_headers_only; the others are read
  };
  return endings;
}

/// The name with its digits after the last dot or slash turned to '#': quarter.17, 5.dcm.
std::string numbered(const std::string& name) {
  std::string result;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const bool digit = name[i] >= '0' && name[i] <= '9';
    if (!digit)
      result += name[i];
    else if (result.back() == '.' || result.back() == '/')
      result += '#';
    else if (result.back() != '#')
      result += name[i];
  }
  return result;
}

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

/// The images of a pair belong to its header; slices to their folder.
bool belongs_to_another(const fs::path& path) {
  const std::string folder = path.parent_path().filename().string();
  return folder == "series" || folder == "slices" || ends_with(path.string(), ".img.gz");
}

double weighted_mean(const Volume& v) {
  double sum = 0;
  const auto components = static_cast<std::size_t>(v.components);
  for (std::size_t i = 0; i < voxel_count(v); ++i)
    sum += static_cast<double>(i % 7) * scalar_at(v, i * components);
  return sum / static_cast<double>(voxel_count(v));
}

void check_ranged(const fs::path& path, const Ranged& expected) {
  const Volume v = read_file(path);
  CHECK(v.dims == expected.dims);
  CHECK(v.min == Approx(expected.min).epsilon(1e-5)); // printed with six digits
  CHECK(v.max == Approx(expected.max).epsilon(1e-5));
}

} // namespace

TEST_CASE("every real file is read as another reader read it, or refused for its reason in one line") {
  const fs::path folder = real_volumes();
  if (folder.empty())
    SLICELENS_SKIP("there is no folder of real volumes");
  for (const auto& [name, expected] : read_files()) {
    CAPTURE(name);
    const Volume v = read_file(folder / name);
    CHECK(v.dims == expected.dims);
    CHECK(v.components == expected.components);
    CHECK(v.frames == expected.frames);
    // Values that were scaled are kept in floats; sums of 10^7 of them differ by rounding.
    CHECK(weighted_mean(v) == Approx(expected.weighted).epsilon(1e-6).margin(1e-9));
    CHECK(scalar_at(v, v.voxels.size() / size_of(v.type) - 1) == Approx(expected.last).epsilon(1e-6));
  }
  for (const auto& [name, expected] : ranged_files()) {
    CAPTURE(name);
    check_ranged(folder / name, expected);
  }
  std::set<std::string> names = {"ct_head_gantry_tilt/series"};
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file() && !belongs_to_another(entry.path()))
      names.insert(entry.path().lexically_relative(folder).string());
  }
  for (const std::string& name : names) {
    if (read_files().count(name) + ranged_files().count(name) > 0)
      continue;
    CAPTURE(name);
    const std::string text = refusal(folder / name);
    const auto reason =
        std::find_if(refused_files().begin(), refused_files().end(), [&](const auto& refused) {
          return ends_with(name, refused.first) || ends_with(numbered(name), refused.first);
        });
    REQUIRE(reason != refused_files().end()); // a file that no table names
    CHECK(contains(text, reason->second));
    CHECK(contains(text, fs::path(name).filename().string()));
    CHECK_FALSE(contains(text, "\n"));
    CHECK(text.size() < 600);
  }
}
