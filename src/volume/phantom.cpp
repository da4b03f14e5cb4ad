#include "volume/phantom.h"

#include "core/errors.h"
#include "core/text.h"
#include "volume/closed_forms.h"
#include "volume/phantom_rows.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>

namespace slicelens {

namespace {

struct Recipe {
  PhantomInfo info;
  ScalarType type = ScalarType::f32;
  glm::dvec3 shape{1};     ///< box edges relative to the longest
  double longest_edge = 0; ///< world units; 0: the largest number of voxels
  PhantomRows (*rows)() = nullptr;
};

PhantomRows box_rows() {
  return rows_of([](const glm::dvec3&) { return 1.0; });
}

PhantomRows ball_rows() {
  return rows_of([](const glm::dvec3& t) {
    return std::clamp(kBallRadius - glm::length(t - 0.5), -kBallClamp, kBallClamp);
  });
}

PhantomRows solid_ball_rows() {
  return rows_of([](const glm::dvec3& t) { return glm::length(t - 0.5) < kBallRadius ? 255.0 : 0.0; });
}

PhantomRows blob_rows() {
  return rows_of([](const glm::dvec3& t) {
    const glm::dvec3 q = t - 0.5;
    return kBlobAmplitude * std::exp(-glm::dot(q, q) / (2 * kBlobSigma * kBlobSigma));
  });
}

PhantomRows ramp_rows() {
  return rows_of([](const glm::dvec3& t) { return t.x; });
}

PhantomRows slab_rows() {
  return rows_of([](const glm::dvec3& t) {
    return t.y < 0.5 ? kSlabFront : t.y > 0.5 ? kSlabBack : (kSlabFront + kSlabBack) / 2;
  });
}

/// The paper's own sampling is 40³, close to the signal's Nyquist rate.
PhantomRows marschner_lobb_rows() { return rows_of(marschner_lobb); }

PhantomRows ct_head_rows() { return head_rows(false); }
PhantomRows mr_head_rows() { return head_rows(true); }

const std::vector<Recipe>& recipes() {
  static const std::vector<Recipe> list = {
      {{"box", "a box of constant extinction, exact at any resolution", "v = 1", {128, 128, 128}, "fog"},
       ScalarType::f32,
       glm::dvec3(1),
       0,
       box_rows},
      {{"ball",
        "a signed distance that a step transfer function cuts into an exact ball",
        "v = clamp(0.4 - |t - 1/2|, -0.1, 0.1)",
        {128, 128, 128},
        "opaque"},
       ScalarType::f32,
       glm::dvec3(1),
       0,
       ball_rows},
      {{"solid-ball",
        "voxels inside or outside a ball, 8 bit: the blocky sphere of Brunet 2006 Figure 4",
        "v = 255 for |t - 1/2| < 0.4, else 0",
        {128, 128, 128},
        "opaque"},
       ScalarType::u8,
       glm::dvec3(1),
       0,
       solid_ball_rows},
      {{"blob",
        "a Gaussian blob with closed forms for X-ray and MIP",
        "v = exp(-|t - 1/2|^2 / (2 sigma^2)), sigma = 1/8",
        {128, 128, 128},
        "grey-ramp"},
       ScalarType::f32,
       glm::dvec3(1),
       0,
       blob_rows},
      {{"ramp", "a linear ramp along x", "v = t_x", {128, 128, 128}, "grey-ramp"},
       ScalarType::f32,
       glm::dvec3(1),
       0,
       ramp_rows},
      {{"slabs",
        "two slabs of different value, front and back: shows the order of compositing",
        "v = 1 for t_y < 1/2, 2 for t_y > 1/2, 1.5 at 1/2",
        {128, 128, 128},
        "halves"},
       ScalarType::f32,
       glm::dvec3(1),
       0,
       slab_rows},
      {{"checkerboard",
        "8 x 8 x 8 cells of alternating value",
        "v = (1 - s(8 t_x) s(8 t_y) s(8 t_z)) / 2, s = 1 on even and -1 on odd cells, each averaged over a "
        "voxel",
        {128, 128, 128},
        "opaque"},
       ScalarType::f32,
       glm::dvec3(1),
       0,
       checkerboard_rows},
      {{"brick",
        "a block of bricks with mortar in a transparent border, to show deformations",
        "0 outside [.12,.88]x[.26,.74]x[.12,.88], mortar 0.35, bricks 0.6 to 1 in running bond",
        {128, 128, 128},
        "opaque"},
       ScalarType::f32,
       glm::dvec3(1),
       0,
       brick_rows},
      {{"marschner-lobb",
        "the standard signal for reconstruction quality (Marschner and Lobb 1994)",
        "v = (1 - sin(pi z/2) + a (1 + cos(2 pi f cos(pi r/2)))) / (2 (1 + a)), f = 6, a = 1/4, (x,y,z) = 2t "
        "- 1, "
        "r^2 = x^2 + y^2",
        {128, 128, 128},
        "opaque"},
       ScalarType::f32,
       glm::dvec3(1),
       0,
       marschner_lobb_rows},
      {{"engine",
        "a machined block with bores, thin sleeves, springs and valves; 8 bit, like the well-known CT",
        "aluminium 120, cast walls 150, steel inserts 225 in air 8; see phantom_engine.cpp",
        {256, 256, 128},
        "cast-and-steel"},
       ScalarType::u8,
       glm::dvec3(1, 1, 0.5),
       0,
       engine_rows},
      {{"head",
        "a CT of a head in HU: skin, skull, brain, and arteries with contrast agent and an aneurysm",
        "air -1000, fat -95, skin 60, muscle 52, brain 28 and 39, fluid 8, blood 330, bone 420 and 1250, "
        "teeth "
        "2300; shapes in phantom_head_shape.cpp",
        {256, 256, 256},
        "CT-Bone"},
       ScalarType::i16,
       glm::dvec3(1),
       256,
       ct_head_rows},
      {{"head-mr",
        "the same head with the contrast of a T1-weighted MR scan, exactly aligned with `head`",
        "air 4, fat 820, skin 420, muscle 340, grey 500, white 690, fluid 130, blood 960, bone 35 and 560, "
        "teeth "
        "20; shapes as in head",
        {256, 256, 256},
        "MR-Default"},
       ScalarType::u16,
       glm::dvec3(1),
       256,
       mr_head_rows},
      {{"head-arteries",
        "the arteries and the aneurysm of `head` alone, as angiography with subtraction shows them",
        "blood 200 in 0; shapes as in head",
        {256, 256, 256},
        "MR-Angio"},
       ScalarType::u8,
       glm::dvec3(1),
       256,
       head_artery_rows},
      {{"organs",
        "a frog with its skeleton and organs, each tissue with a value of its own",
        "air 0, skin 30, muscle 40, organs 12 to 200, skeleton 230 (slicelens list labels); shapes in "
        "phantom_organs_shape.cpp",
        {256, 256, 128},
        "organs"},
       ScalarType::u8,
       glm::dvec3(1, 1, 0.5),
       160,
       organ_rows},
      {{"organs-labels",
        "the same frog as numbers of its organs, exactly aligned with `organs`; show it with render.filter "
        "nearest",
        "0 outside, 1 to 19: slicelens list labels; shapes as in organs, no averaging",
        {256, 256, 128},
        "organs-labels"},
       ScalarType::u8,
       glm::dvec3(1, 1, 0.5),
       160,
       organ_label_rows},
      {{"colon",
        "a winding tube of air with folds and nine polyps, as CT colonography shows it, in HU",
        "air -1000, fat -100, wall 40, polyps 90; shapes in phantom_colon.cpp",
        {256, 128, 256},
        "colon"},
       ScalarType::i16,
       glm::dvec3(1, 0.5, 1),
       320,
       colon_rows},
  };
  return list;
}

const Recipe& recipe(const std::string& name) {
  std::vector<std::string> names;
  for (const Recipe& candidate : recipes()) {
    if (candidate.info.name == name)
      return candidate;
    names.push_back(candidate.info.name);
  }
  const auto nearest = nearest_word(name, names);
  throw UsageError("phantom '" + name + "' is not known" +
                   (nearest ? "; did you mean '" + *nearest + "'?" : "") + " (" + join(names) + ")");
}

std::string size_text(const std::array<std::size_t, 3>& size) {
  return std::to_string(size[0]) + " x " + std::to_string(size[1]) + " x " + std::to_string(size[2]);
}

std::string phantom_text(const std::string& name, const std::array<std::size_t, 3>& size) {
  return "phantom '" + name + "' of " + size_text(size) + " voxels";
}

void check_size(const std::string& name, const std::array<std::size_t, 3>& size) {
  if (*std::min_element(size.begin(), size.end()) == 0)
    throw UsageError(phantom_text(name, size) + ": every size must be at least 1");
  if (*std::max_element(size.begin(), size.end()) > kMaxPhantomEdge) {
    throw LimitError(phantom_text(name, size) + ": at most " + std::to_string(kMaxPhantomEdge) +
                     " voxels on an edge");
  }
}

void check_memory(const std::string& name, const Volume& volume) {
  const std::size_t bytes = voxel_bytes(volume);
  if (bytes > kMaxPhantomBytes) {
    throw LimitError(phantom_text(name, volume.dims) + " needs " +
                     number_text(std::ceil(static_cast<double>(bytes) / (1 << 30))) + " GiB; at most " +
                     std::to_string(kMaxPhantomBytes >> 30) +
                     " GiB are made in memory (1024 x 1024 x 1024 fits); 'slicelens phantom' writes larger "
                     "ones into a file");
  }
}

template <class T>
T scalar_from(double value) {
  if constexpr (std::is_floating_point_v<T>) {
    return static_cast<T>(value);
  } else {
    return static_cast<T>(std::clamp(std::round(value), static_cast<double>(std::numeric_limits<T>::min()),
                                     static_cast<double>(std::numeric_limits<T>::max())));
  }
}

/// Rows first … first + count − 1, where row = j + ny·k.
template <class T>
void evaluate_rows(const PhantomGrid& grid, const PhantomRows& rows, std::size_t first, std::size_t count,
                   T* scalars) {
  const std::size_t nx = grid.dims[0];
  const std::size_t ny = grid.dims[1];
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 8),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      std::vector<double> row(nx);
                      for (std::size_t r = range.begin(); r != range.end(); ++r) {
                        rows(grid, (first + r) % ny, (first + r) / ny, row);
                        std::transform(row.begin(), row.end(), scalars + r * nx, scalar_from<T>);
                      }
                    });
}

} // namespace

const std::vector<PhantomInfo>& phantoms() {
  static const std::vector<PhantomInfo> infos = [] {
    std::vector<PhantomInfo> list;
    for (const Recipe& entry : recipes())
      list.push_back(entry.info);
    return list;
  }();
  return infos;
}

const PhantomInfo& phantom_info(const std::string& name) { return recipe(name).info; }

PhantomSource phantom_source(const std::string& name, const std::array<std::size_t, 3>& size) {
  const Recipe& chosen = recipe(name);
  check_size(name, size);
  PhantomSource source;
  Volume& volume = source.volume;
  volume.dims = size;
  volume.type = chosen.type;
  volume.format = "phantom";
  const double longest = chosen.longest_edge > 0
                             ? chosen.longest_edge
                             : static_cast<double>(*std::max_element(size.begin(), size.end()));
  const PhantomGrid grid{size, longest * chosen.shape};
  volume.spacing = {grid.spacing(0), grid.spacing(1), grid.spacing(2)};
  volume.origin = (volume.spacing - grid.edges) / 2.0;
  source.rows = [grid, rows = chosen.rows(), type = chosen.type](std::size_t first,
                                                                 std::span<std::byte> out) {
    visit_scalar_type(type, [&](auto* tag) {
      using T = std::remove_pointer_t<decltype(tag)>;
      evaluate_rows(grid, rows, first, out.size() / (grid.dims[0] * sizeof(T)),
                    reinterpret_cast<T*>(out.data()));
    });
  };
  return source;
}

Volume make_phantom(const std::string& name, const std::array<std::size_t, 3>& size,
                    const Progress& progress) {
  PhantomSource source = phantom_source(name, size);
  Volume& volume = source.volume;
  check_memory(name, volume);
  try {
    volume.voxels.resize(voxel_bytes(volume));
  } catch (const std::bad_alloc&) {
    throw LimitError(phantom_text(name, size) + ": not enough memory");
  }
  const std::size_t rows = size[1] * size[2];
  const std::size_t row_bytes = volume.voxels.size() / rows;
  const std::size_t chunk = std::max<std::size_t>(1, rows / 16);
  for (std::size_t row = 0; row < rows; row += chunk) {
    report_progress(progress, "phantom", static_cast<double>(row) / static_cast<double>(rows));
    const std::size_t count = std::min(chunk, rows - row);
    source.rows(row, std::span(volume.voxels).subspan(row * row_bytes, count * row_bytes));
  }
  report_progress(progress, "phantom", 1);
  update_statistics(volume);
  return std::move(volume);
}

Volume make_phantom(const std::string& name, const Progress& progress) {
  return make_phantom(name, phantom_info(name).size, progress);
}

} // namespace slicelens
