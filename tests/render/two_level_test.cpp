// Mode two-level: a transfer function and a mode for each label, and labels that are never interpolated.
#include "catch.h"
#include "core/errors.h"
#include "core/text.h"
#include "render_fixture.h"
#include "scene/load_labels.h"

#include <cstring>
#include <set>

using namespace slicelens;

namespace {

using LabelAt = std::function<std::uint32_t(std::size_t, std::size_t, std::size_t)>;
using ValueAt = std::function<float(std::size_t, std::size_t, std::size_t)>;

template <class T>
Volume make_volume(std::array<std::size_t, 3> dims, ScalarType type,
                   const std::function<T(std::size_t, std::size_t, std::size_t)>& at) {
  Volume volume;
  volume.dims = dims;
  volume.type = type;
  volume.origin =
      -0.5 * glm::dvec3(dims[0] - 1, dims[1] - 1, dims[2] - 1); // the middle at the world's origin
  volume.voxels.resize(voxel_bytes(volume));
  std::size_t n = 0;
  for (std::size_t k = 0; k < dims[2]; ++k) {
    for (std::size_t j = 0; j < dims[1]; ++j) {
      for (std::size_t i = 0; i < dims[0]; ++i, ++n) {
        const T value = at(i, j, k);
        std::memcpy(volume.voxels.data() + n * sizeof(T), &value, sizeof(T));
      }
    }
  }
  update_statistics(volume);
  return volume;
}

Volume labels_of(std::array<std::size_t, 3> dims, const LabelAt& at) {
  return make_volume<std::uint32_t>(dims, ScalarType::u32, at);
}

/// A scene of hand-made values and labels.
PreparedScene prepare_labelled(const std::string& json, Volume volume, Volume labels) {
  Scene scene = scene_from_json(json, "test");
  TransferFunction transfer = transfer_of(scene, volume);
  std::optional<LoadedLabels> loaded;
  if (scene.render.mode == Mode::two_level)
    loaded = LoadedLabels{std::move(labels), load_label_transfers(scene, volume, {}, {})};
  return prepare(std::move(scene), std::move(volume), std::move(transfer), {}, std::move(loaded));
}

/// A scene of phantoms.
PreparedScene prepare_phantoms(const std::string& json) {
  Scene scene = scene_from_json(json, "test");
  Volume volume = load_volume(scene.volume, {}, {});
  TransferFunction transfer = transfer_of(scene, volume);
  std::optional<LoadedLabels> labels = load_labels(scene, volume, {}, {});
  return prepare(std::move(scene), std::move(volume), std::move(transfer), {}, std::move(labels));
}

glm::dvec4 middle(const Image& image) {
  glm::dvec4 color;
  for (int c = 0; c < 4; ++c)
    color[c] = static_cast<double>(channel(image, image.width / 2, image.height / 2, c));
  return color;
}

glm::dvec4 under(glm::dvec4 front, glm::dvec4 behind) { return front + (1 - front.w) * behind; }

/// Of a homogeneous slab: associated colour; opacity `a` for each voxel of `length`.
glm::dvec4 slab(glm::dvec3 color, double a, double length) {
  const double alpha = 1 - std::pow(1 - a, length);
  return {color * alpha, alpha};
}

const std::vector<std::string> kGpuAndReference = {"slices", "fragment", "tessellated", "rays", "reference"};

/// Seen along y: labels 7 for the front half, 100000 behind it.
std::string two_slabs(const std::string& front, const std::string& behind) {
  return R"({"volume": {"phantom": "box", "labels": "given by hand"}, "transfer": {"points": [[0, 1, 1, 1, 1]]},
    "render": {"mode": "two-level", "pipeline": "rays", "size": [9, 9], "background": [0, 0, 0, 0]},
    "labels": [{"label": 7, )" +
         front + R"(}, {"label": 100000, )" + behind + "}]}";
}

std::uint32_t front_or_behind(std::size_t, std::size_t j, std::size_t) { return j < 8 ? 7 : 100000; }

constexpr std::array<std::size_t, 3> kSixteen = {16, 16, 16};

void check_color(const glm::dvec4& a, const glm::dvec4& b, double tolerance) {
  INFO(a.x << " " << a.y << " " << a.z << " " << a.w << " should be " << b.x << " " << b.y << " " << b.z
           << " " << b.w);
  CHECK(glm::length(a - b) < tolerance);
}

} // namespace

TEST_CASE("two slabs of labels have the colours that their transfer functions give in closed form") {
  gl::Context context = test_context();
  // The second one's opacity is for two voxels, so for one it is 1 − sqrt(1 − 0.19) = 0.1.
  const std::string json = two_slabs(R"("transfer": {"points": [[0, 1, 0, 0, 0.05]]})",
                                     R"("transfer": {"points": [[0, 0, 1, 0.5, 0.19]], "unit_distance": 2})");
  const PreparedScene scene = prepare_labelled(
      json, make_volume<float>(kSixteen, ScalarType::f32, [](auto, auto, auto) { return 1.0F; }),
      labels_of(kSixteen, front_or_behind));
  const glm::dvec4 expected = under(slab({1, 0, 0}, 0.05, 8), slab({0, 1, 0.5}, 0.1, 8));
  for (const std::string& pipeline : kGpuAndReference) {
    for (const char* spacing : {"1", "0.25"}) {
      INFO(pipeline << " at spacing " << spacing);
      // Both slabs hold whole samples, so only arithmetic in float is left.
      check_color(middle(picture(changed(scene, {"render.pipeline=" + pipeline,
                                                 std::string("render.spacing=") + spacing}),
                                 context)),
                  expected, 2e-6);
    }
  }
  check_color(middle(picture(changed(scene, {"labels[0].visible=false"}), context)),
              slab({0, 1, 0.5}, 0.1, 8), 2e-6);
  // Without an entry a label is shown by the scene's own transfer function.
  Scene fewer = scene.scene;
  fewer.labels.erase(fewer.labels.begin());
  PreparedScene own =
      prepare_labelled(scene_to_json(fewer), scene.volume, labels_of(kSixteen, front_or_behind));
  check_color(middle(picture(own, context)), {1, 1, 1, 1}, 1e-6);
}

TEST_CASE("labels are never interpolated") {
  gl::Context context = test_context();
  // A checkerboard of three labels one voxel wide that is seen along y at eight pixels a voxel and turned, so
  // that samples lie everywhere between voxels: each is opaque and must have one of three colours.
  const auto label = [](std::size_t i, std::size_t j, std::size_t k) {
    return static_cast<std::uint32_t>(10 * ((i + j + k) % 3));
  };
  const PreparedScene scene = prepare_labelled(
      R"({"volume": {"phantom": "box", "labels": "given by hand"}, "transfer": {"points": [[0, 1, 0, 0, 1]]},
      "camera": {"azimuth": 17, "elevation": 9}, "render": {"size": [64, 64], "background": [0, 0, 0, 0]},
      "labels": [{"label": 10, "transfer": {"points": [[0, 0, 1, 0, 1]]}},
                 {"label": 20, "transfer": {"points": [[0, 0, 0, 1, 1]]}}]})",
      make_volume<float>({8, 8, 8}, ScalarType::f32,
                         [](auto i, auto, auto) { return static_cast<float>(i); }),
      labels_of({8, 8, 8}, label));
  CHECK(scene.scene.render.mode == Mode::two_level); // volume.labels alone asks for it
  for (const std::string& pipeline : kGpuAndReference) {
    INFO(pipeline);
    const Image image = picture(changed(scene, {"render.pipeline=" + pipeline}), context);
    std::set<std::array<float, 4>> colors;
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x)
        colors.insert({channel(image, x, y, 0), channel(image, x, y, 1), channel(image, x, y, 2),
                       channel(image, x, y, 3)});
    }
    CHECK(colors == std::set<std::array<float, 4>>{{0, 0, 0, 0}, {1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1}});
  }
}

TEST_CASE("a sample on the face between two labels belongs to the upper one in every pipeline") {
  gl::Context context = test_context();
  // Seventeen voxels along the ray: samples that count from the middle lie on the faces between voxels.
  // The outermost would lie on faces of the box, which is another question: they are cropped.
  const PreparedScene scene = prepare_labelled(
      R"({"volume": {"phantom": "box", "labels": "given by hand"}, "transfer": {"points": [[0, 1, 0, 0, 0.2]]},
      "crop": {"low": [0, 0.03, 0], "high": [1, 0.97, 1]}, "render": {"size": [16, 16], "background": [0, 0, 0, 0]},
      "labels": [{"label": 1, "transfer": {"points": [[0, 0, 1, 0, 0.3]]}}]})",
      make_volume<float>({16, 17, 16}, ScalarType::f32, [](auto, auto, auto) { return 1.0F; }),
      labels_of({16, 17, 16}, [](auto, std::size_t j, auto) { return static_cast<std::uint32_t>(j % 2); }));
  const Image truth = picture(changed(scene, {"render.pipeline=reference"}), context);
  for (const char* pipeline : {"slices", "fragment", "rays"})
    CHECK(max_difference(picture(changed(scene, {std::string("render.pipeline=") + pipeline}), context),
                         truth) < 1e-5);
}

TEST_CASE("a run's largest value or line integral is composited where the run ends") {
  gl::Context context = test_context();
  // Values rise along the ray from 0.5 to 15.5; opacity and green are value/20. The front run ends at
  // voxel 7.
  const auto values = make_volume<float>(kSixteen, ScalarType::f32,
                                         [](auto, auto j, auto) { return static_cast<float>(j) + 0.5F; });
  const std::string ramp = R"("transfer": {"points": [[0, 0, 0, 0, 0], [20, 0, 1, 0, 1]]})";
  const std::string fog = R"("transfer": {"points": [[0, 1, 0, 0, 0.1]]})";
  const auto shown = [&](const std::string& json, const std::string& pipeline, const std::string& more) {
    const PreparedScene scene = prepare_labelled(json, values, labels_of(kSixteen, front_or_behind));
    return middle(picture(changed(scene, {"render.pipeline=" + pipeline, more}), context));
  };
  for (const std::string& pipeline : kGpuAndReference) {
    INFO(pipeline);
    // mip in front: value 7.5, opacity 0.375 of green 0.375, then eight voxels of fog.
    const double a = 7.5 / 20;
    const std::string mip = two_slabs(R"("mode": "mip", )" + ramp, fog);
    check_color(shown(mip, pipeline, "render.spacing=1"), under({0, a * a, 0, a}, slab({1, 0, 0}, 0.1, 8)),
                2e-6);
    // Its opacity has no length: at half the spacing the largest value is 7.75 − ½ + ½, that is 7.75.
    const double half = 7.75 / 20;
    check_color(shown(mip, pipeline, "render.spacing=0.5"),
                under({0, half * half, 0, half}, slab({1, 0, 0}, 0.1, 8)), 2e-6);
    // fog in front, mip behind: the last voxel.
    const double b = 15.5 / 20;
    check_color(shown(two_slabs(fog, R"("mode": "mip", )" + ramp), pipeline, "render.spacing=1"),
                under(slab({1, 0, 0}, 0.1, 8), {0, b * b, 0, b}), 2e-6);
    // xray behind: S = 8 · 0.1 of red, at scale 0.25 an opacity of 0.2.
    check_color(shown(two_slabs(R"("visible": false)", R"("mode": "xray", )" + fog), pipeline,
                      "render.xray_scale=0.25"),
                {0.2, 0, 0, 0.2}, 2e-6);
    // and never above 1.
    check_color(
        shown(two_slabs(R"("visible": false)", R"("mode": "xray", )" + fog), pipeline, "render.xray_scale=9"),
        {1, 0, 0, 1}, 2e-6);
  }
  // Three runs of two labels: the middle one of eight voxels parts the other into two maxima.
  const auto parted = [](auto, std::size_t j, auto) {
    return static_cast<std::uint32_t>(j < 4 || j >= 12 ? 7 : 9);
  };
  const PreparedScene three = prepare_labelled(two_slabs(R"("mode": "mip", )" + ramp, R"("visible": true)"),
                                               values, labels_of(kSixteen, parted));
  PreparedScene clear = changed(three, {"transfer.points=[[0,0,0,0,0]]"});
  clear.transfer = constant_transfer({0, 0, 0, 0});
  prepare_again(clear);
  const double c = 3.5 / 20;
  const double d = 15.5 / 20;
  for (const std::string& pipeline : kGpuAndReference)
    check_color(middle(picture(changed(clear, {"render.pipeline=" + pipeline}), context)),
                under({0, c * c, 0, c}, {0, d * d, 0, d}), 2e-6);
}

TEST_CASE("one object of mode mip is the picture of mode mip") {
  gl::Context context = test_context();
  const PreparedScene mip = prepare_phantoms(
      R"({"volume": {"phantom": "head", "size": [32, 32, 32]}, "camera": {"azimuth": 30, "elevation": 20},
      "render": {"mode": "mip", "size": [48, 48], "pipeline": "rays"}})");
  Scene scene = mip.scene;
  scene.volume.labels = "given by hand";
  scene.render.mode = Mode::two_level;
  scene.labels = {{5, "all of it", LabelMode::mip, std::nullopt, true}};
  const PreparedScene labelled = prepare(scene, mip.volume, mip.transfer, {},
                                         LoadedLabels{[&] {
                                                        Volume five = mip.volume;
                                                        five.type = ScalarType::u8;
                                                        five.voxels.assign(voxel_count(five), std::byte{5});
                                                        return five;
                                                      }(),
                                                      {std::nullopt}});
  for (const char* pipeline : {"slices", "rays", "reference"}) {
    const std::vector<std::string> keys = {std::string("render.pipeline=") + pipeline};
    CHECK(max_difference(picture(changed(labelled, keys), context), picture(changed(mip, keys), context)) <
          1e-5);
  }
}

namespace {

constexpr const char* kFrog =
    R"({"volume": {"phantom": "organs", "size": [48, 48, 24], "labels": "organs-labels"},
  "camera": {"azimuth": 35, "elevation": -40, "zoom": 1.5}, "render": {"size": [64, 64]},
  "labels": [{"label": 0, "visible": false},
    {"label": 1, "name": "skin", "transfer": {"points": [[-1000, 0.4, 0.8, 0.3, 0], [200, 0.5, 0.9, 0.4, 0.08]]}},
    {"label": 2, "visible": false},
    {"label": 3, "name": "skeleton", "transfer": {"points": [[-1000, 1, 0.9, 0.7, 0.5]]}},
    {"label": 11, "name": "liver", "transfer": {"points": [[-1000, 0.6, 0.2, 0.1, 0.4]]}}]})";

} // namespace

TEST_CASE("two-level pictures are the same by slices, rays and the reference") {
  gl::Context context = test_context();
  const PreparedScene frog = prepare_phantoms(kFrog);
  const auto check = [&](std::vector<std::string> keys, const std::string& slices) {
    const auto by = [&](const std::string& pipeline) {
      std::vector<std::string> all = keys;
      all.push_back("render.pipeline=" + pipeline);
      return picture(changed(frog, all), context);
    };
    const Image rays = by("rays");
    INFO(slices << ": " << join(keys));
    // Light of unlike rounding and a filter of the driver's own keep the usual distances.
    CHECK(psnr(by(slices), rays) > 60);
    CHECK(psnr(rays, by("reference")) > 55);
  };
  check({}, "slices");
  check({"render.filter=linear-exact", "render.shading=phong"}, "slices");
  check({R"(warp={"kind": "twist", "angle": 40})"}, "fragment");
  check({R"(warp={"kind": "bifocal", "focus": [[0.3, 0.6], [0.3, 0.6], [0.3, 0.6]]})"}, "fragment");
  // Cohen's tables are the map to a part of a texel only: with many, few samples change their voxel.
  check({R"(warp={"kind": "bifocal", "focus": [[0.3, 0.6], [0.3, 0.6], [0.3, 0.6]]})",
         "render.axis_texels=4096"},
        "axis");
  // Opacities by the gradient amplify the difference of a driver's own filter (softpipe: 53 dB).
  check({"render.modulate_by_gradient=20", "render.filter=linear-exact"}, "slices");
}

TEST_CASE("local modes are the same by slices, rays and the reference") {
  gl::Context context = test_context();
  const PreparedScene frog = prepare_phantoms(kFrog);
  const auto by = [&](const std::string& pipeline, std::vector<std::string> keys) {
    keys.insert(keys.end(), {"render.pipeline=" + pipeline, "labels[4].mode=mip", "labels[1].mode=xray",
                             "labels[3].mode=mip"});
    return picture(changed(frog, keys), context);
  };
  const auto check = [&](const std::vector<std::string>& keys, const std::string& slices,
                         const std::vector<std::string>& of_slices = {}) {
    INFO(slices << ": " << join(keys) << " " << join(of_slices));
    const Image rays = by("rays", keys);
    std::vector<std::string> all = keys;
    all.insert(all.end(), of_slices.begin(), of_slices.end());
    CHECK(psnr(by(slices, all), rays) > 60);
    CHECK(psnr(rays, by("reference", keys)) > 55);
  };
  check({}, "slices");
  check({}, "slices", {"render.order=front-to-back"});
  check({"render.shading=diffuse", "render.filter=linear-exact"}, "slices");
  check({R"(warp={"kind": "twist", "angle": 40})"}, "fragment");
  check({"render.modulate_by_gradient=20", "render.filter=linear-exact"}, "slices");
  check({"render.jitter=1"}, "slices");
  // Planes and shells sample elsewhere; shells are where the rays' samples are.
  check({"camera.projection=perspective"}, "slices", {"render.proxy=shells"});
}

TEST_CASE("a run ends where a ray leaves the data, also when it comes back into the same object") {
  gl::Context context = test_context();
  // Two waves along the ray lift the top of one object out of the box twice: near it rays have up to three
  // runs, and values that rise along y give each its own largest one.
  const PreparedScene scene = prepare_labelled(
      R"({"volume": {"phantom": "box", "labels": "given by hand"}, "transfer": {"points": [[0, 0, 0, 0, 0]]},
      "warp": {"kind": "sine", "axis": "z", "along": "y", "amplitude": 0.1, "wavelength": 0.5},
      "render": {"size": [32, 32], "background": [0, 0, 0, 0]},
      "labels": [{"label": 7, "mode": "mip", "transfer": {"points": [[0, 0, 0, 0, 0], [20, 0, 1, 0, 1]]}}]})",
      make_volume<float>(kSixteen, ScalarType::f32, [](auto, auto j, auto) { return float(j) + 0.5F; }),
      labels_of(kSixteen, [](auto, auto, auto) { return 7U; }));
  const auto by = [&](const std::string& pipeline) {
    return picture(changed(scene, {"render.pipeline=" + pipeline}), context);
  };
  const Image truth = by("reference");
  CHECK(share_over(by("rays"), truth, 1e-3) <= 1e-3);
  CHECK(share_over(by("fragment"), truth, 1e-3) <= 1e-3);
  // In the upper part some pixels show more than one run could: one run has at most the last voxel's opacity.
  double most = 0;
  for (int y = 0; y < 32; ++y)
    most = std::max(most, static_cast<double>(channel(truth, 16, y, 3)));
  CHECK(most > 15.5 / 20 + 0.05);
}

TEST_CASE("two-level perspective planes are as near the truth as rays, and shells are the rays") {
  // Labels end at the faces of voxels, so a sample is in an object or not: the place where a ray enters it is
  // known to a step, and errors fall as the step does, 6 dB a halving, for planes and shells alike. Their
  // errors are not the same ones, so between them lies the sum of the two squares, 3 dB.
  gl::Context context = test_context();
  const PreparedScene frog =
      changed(prepare_phantoms(kFrog), {"camera.projection=perspective", "render.filter=linear-exact"});
  const auto by = [&](const std::string& pipeline, const std::string& spacing, const std::string& proxy) {
    return picture(
        changed(frog, {"render.pipeline=" + pipeline, "render.spacing=" + spacing, "render.proxy=" + proxy}),
        context);
  };
  const Image truth = by("rays", "0.03125", "planes");
  const Image rays = by("rays", "0.5", "planes");
  const Image planes = by("slices", "0.5", "planes");
  const double of_rays = psnr(rays, truth);
  const double of_planes = psnr(planes, truth);
  INFO(of_rays << " and " << of_planes << " dB");
  CHECK(std::abs(of_rays - of_planes) < 1.5);
  CHECK(std::abs(psnr(planes, rays) - (of_rays + of_planes) / 2 + 3) < 1.5);
  CHECK(std::abs(psnr(by("slices", "0.25", "planes"), truth) - of_planes - 6) < 2);
  CHECK(share_over(by("slices", "0.5", "shells"), rays, 1e-3) <= 1e-3);
}

TEST_CASE("an empty table of labels is the picture of mode dvr") {
  gl::Context context = test_context();
  const PreparedScene frog = prepare_phantoms(
      R"({"volume": {"phantom": "organs", "size": [32, 32, 16], "labels": "organs-labels"},
      "render": {"size": [48, 48], "pipeline": "rays"}})");
  CHECK(max_difference(picture(frog, context), picture(changed(frog, {"render.mode=dvr"}), context)) < 1e-5);
}

TEST_CASE("what two-level rendering cannot do is refused by name") {
  const auto refused = [](const std::string& json, const std::string& words) {
    CHECK_THROWS_WITH(scene_from_json(json, "test"), Catch::Contains(words));
  };
  const std::string volume = R"({"volume": {"phantom": "organs", "labels": "organs-labels"}, )";
  refused(R"({"render": {"mode": "two-level"}})", "volume.labels");
  refused(R"({"labels": [{"label": 1}]})", "volume.labels, which is not given");
  refused(volume + R"("labels": [{"label": 3}, {"label": 3}]})", "labels[1].label: 3 has an entry already");
  refused(volume + R"("labels": [{"label": 3, "transfer": {"preset": "fog", "points": [[0, 1, 1, 1, 1]]}}]})",
          "labels[0].transfer.preset and transfer.points");
  refused(volume + R"("render": {"classification": "pre"}})", "classification 'pre'");
  refused(volume + R"("render": {"classification": "preintegrated"}})", "classification 'preintegrated'");
  refused(volume + R"("render": {"tiles": [2, 1, 1]}})", "render.tiles");
  refused(volume + R"("render": {"footprint": "mip"}})", "render.footprint");
  refused(volume + R"("render": {"pipeline": "fixed-function"}})", "draws mode 'dvr' only");
  refused(volume + R"("overlay": {"legend": true}})", "overlay.legend to false");
  refused(volume + R"("transfer": {"shapes": [{}]}})", "transfer.points for transfer.shapes");
  refused(volume + R"("labels": [{"label": 3, "transfer": {"shapes": [{}]}}]})", "labels[0].transfer.shapes");
  refused(volume + R"("planes": [{}]})", "set render.mode to dvr");
  refused(R"({"volumes": [{"phantom": "head"}, {"phantom": "head"}], "render": {"mode": "two-level"}})",
          "have no labels in common");
  std::string many = volume + R"("labels": [{"label": 0})";
  for (int i = 1; i < 256; ++i)
    many += ", {\"label\": " + std::to_string(i) + "}";
  refused(many + "]}", "labels has 256 entries; take at most 255");
}

TEST_CASE("label volumes of another grid or without whole numbers are refused") {
  const Volume values = make_volume<float>({4, 4, 4}, ScalarType::f32, [](auto, auto, auto) { return 1.0F; });
  const auto refused = [&](Volume labels, const std::string& words) {
    CHECK_THROWS_WITH(
        prepare_labelled(two_slabs(R"("visible": true)", R"("visible": true)"), values, std::move(labels)),
        Catch::Contains(words));
  };
  const LabelAt none = [](auto, auto, auto) { return 0U; };
  refused(labels_of({4, 4, 5}, none), "has 4 x 4 x 5 voxels, the volume 4 x 4 x 4");
  Volume moved = labels_of({4, 4, 4}, none);
  moved.origin.x += 0.5;
  refused(moved, "lies 0.5 of its voxels away");
  refused(make_volume<float>({4, 4, 4}, ScalarType::f32, [](auto i, auto, auto) { return 0.5F * float(i); }),
          "not whole");
  // Whole numbers held as floats are labels; so are negative ones, which no entry names.
  CHECK_NOTHROW(prepare_labelled(
      two_slabs(R"("visible": true)", R"("visible": true)"), values,
      make_volume<float>({4, 4, 4}, ScalarType::f32, [](auto i, auto, auto) { return float(i) - 1; })));
}

TEST_CASE("labels keep their numbers in every integer type") {
  const Volume values = make_volume<float>({2, 2, 2}, ScalarType::f32, [](auto, auto, auto) { return 1.0F; });
  const auto rows = [&](const Volume& labels, const std::string& number) {
    const std::string json =
        R"({"volume": {"phantom": "box", "labels": "given by hand"}, "labels": [{"label": 1},
      {"label": )" +
        number + "}]}";
    return prepare_labelled(json, values, labels).labels.rows;
  };
  const std::vector<std::uint8_t> expected = {0, 2, 0, 2, 0, 2, 0, 2};
  // Above 2^24 floats are not exact, above 2^53 doubles are not.
  CHECK(rows(make_volume<std::uint32_t>({2, 2, 2}, ScalarType::u32,
                                        [](auto i, auto, auto) { return std::uint32_t(4294967294 + i); }),
             "4294967295") == expected);
  CHECK(rows(make_volume<std::uint64_t>(
                 {2, 2, 2}, ScalarType::u64,
                 [](auto i, auto, auto) { return (std::uint64_t{1} << 60) + std::uint64_t(i); }),
             "1152921504606846977") == expected);
  CHECK(rows(make_volume<std::int16_t>({2, 2, 2}, ScalarType::i16,
                                       [](auto i, auto, auto) { return std::int16_t(i == 0 ? -1 : 1000); }),
             "1000") == expected);
}

TEST_CASE("a label volume may store the volume's voxels along other axes or from the other end") {
  const Volume values = make_volume<float>({2, 3, 4}, ScalarType::f32, [](auto, auto, auto) { return 1.0F; });
  const auto rows = [&](const Volume& labels) {
    return prepare_labelled(
               R"({"volume": {"phantom": "box", "labels": "given by hand"}, "labels": [{"label": 3}]})",
               values, labels)
        .labels.rows;
  };
  // One voxel of label 3, at (1, 2, 0).
  std::vector<std::uint8_t> expected(24, 0);
  expected[5] = 1;
  const auto at = [](std::size_t x, std::size_t y, std::size_t z) {
    return [=](auto i, auto j, auto k) { return i == x && j == y && k == z ? 3U : 0U; };
  };
  CHECK(rows(labels_of({2, 3, 4}, at(1, 2, 0))) == expected);
  Volume backwards = labels_of({2, 3, 4}, at(0, 0, 0)); // x and y from their other ends
  backwards.direction = {{-1, 0, 0}, {0, -1, 0}, {0, 0, 1}};
  backwards.origin = {0.5, 1, -1.5};
  CHECK(rows(backwards) == expected);
  Volume turned = labels_of({4, 2, 3}, at(0, 1, 2)); // z first, then x, then y
  turned.direction = {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}};
  turned.origin = {-0.5, -1, -1.5};
  CHECK(rows(turned) == expected);
}
