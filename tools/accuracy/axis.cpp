// Cohen's tables against the exact maps: by length, by filter, and every pipeline against the reference.

#include "bench.h"
#include "scene/names.h"
#include "volume/read.h"

#include <algorithm>
#include <cmath>
#include <iostream>

namespace slicelens::accuracy {

namespace {

constexpr int kPixels = 192;

struct Display {
  std::string name;
  Warp warp;
};

/// Lens boxes end on multiples of 1/16: on texel borders of every table here, so that masks end where they
/// should. So does the first bifocal's region, and its map has its creases between two texels, where tables
/// are worst at them; the second's are on the middle of texels of tables with one texel for each of `dims`.
std::vector<Display> displays(const std::array<std::size_t, 3>& dims) {
  Bifocal bifocal;
  bifocal.focus = ranges_of({0.4, 0.35, 0.4}, {0.6, 0.5, 0.6});
  bifocal.shown = ranges_of({0.25, 0.1875, 0.25}, {0.75, 0.6875, 0.75});
  Bifocal on_texels = bifocal;
  for (std::size_t axis = 0; axis < 3; ++axis)
    on_texels.shown[axis] += 0.5 / static_cast<double>(dims[axis]);
  Fisheye fisheye;
  fisheye.center = {0.5, 0.4375, 0.5};
  const LensBox box = {{0.5, 0.4375, 0.5}, glm::dvec3(0.15), glm::dvec3(0.3125), 2};
  return {{"bifocal", bifocal},
          {"bifocal, creases on texels", on_texels},
          {"fisheye", fisheye},
          {"volume-lens", VolumeLens{box}},
          {"connected-lens", ConnectedLens{box}}};
}

void show(Scene& scene, const Warp& warp) {
  scene.warp = {warp};
  scene.highlight.function = HighlightFunction::distance;
  scene.highlight.power = 2;
  scene.attenuation.function = AttenuationFunction::distance;
}

std::vector<Subject> subjects(const Bench& bench) {
  std::vector<Subject> list;
  list.push_back(phantom_subject("head", 128, constant_transfer({1, 1, 1, 1}), kPixels));
  list.back().prepared.transfer = rising(list.back().prepared.volume, 0.27, 0.6, 0.5);
  for (const auto& [name, file] : {std::pair("aneurism 256³", "aneurism/aneurism.vti"),
                                   std::pair("engine 256×256×128", "engine/engine.vti")}) {
    if (bench.volumes.empty() || !std::filesystem::exists(bench.volumes / file))
      continue;
    VolumeSource source;
    source.file = bench.volumes / file;
    Volume volume = read_volume(source);
    TransferFunction transfer = rising(volume, 0.25, 0.75, 0.5);
    Scene scene = oblique_scene(kPixels);
    scene.volume.file = file;
    list.push_back({name, prepare(std::move(scene), std::move(volume), std::move(transfer)), true});
  }
  return list;
}

Image shown(
    const Bench& bench, Subject& subject, const Warp& warp, Pipeline pipeline,
    const Change& change = [](Scene&) {}) {
  return draw(bench, subject, [&](Scene& scene) {
    show(scene, warp);
    scene.render.pipeline = pipeline;
    change(scene);
  });
}

void pipelines_table(const Bench& bench) {
  std::cout << "### One texel for each voxel\n\n";
  double worst_linear = 1e9;
  double worst_crease = 1e9;
  double worst_reference = 1e9;
  {
    Table table({"volume", "warp", "linear/fragment", "nearest/fragment", "axis", "fragment", "rays"});
    for (Subject& subject : subjects(bench)) {
      for (const Display& display : displays(subject.prepared.volume.dims)) {
        say("axis: " + subject.name + ", " + display.name);
        const auto picture = [&](Pipeline pipeline) { return shown(bench, subject, display.warp, pipeline); };
        const Image linear = picture(Pipeline::axis);
        const Image nearest = shown(bench, subject, display.warp, Pipeline::axis,
                                    [](Scene& s) { s.render.axis_filter = AxisFilter::nearest; });
        const Image fragment = picture(Pipeline::fragment);
        const Image truth = picture(Pipeline::reference);
        const double gained = difference(linear, fragment).psnr;
        const double exact = difference(fragment, truth).psnr;
        const double rays = difference(picture(Pipeline::rays), truth).psnr;
        table.row({subject.name, display.name, decibel(gained), decibel(difference(nearest, fragment).psnr),
                   decibel(difference(linear, truth).psnr), decibel(exact), decibel(rays)});
        (display.name == "bifocal" ? worst_crease : worst_linear) =
            std::min(display.name == "bifocal" ? worst_crease : worst_linear, gained);
        worst_reference = std::min({worst_reference, exact, rays});
      }
    }
  }
  bar("axis with linear tables against fragment, smallest PSNR but for bifocal",
      decibel(worst_linear) + " dB", "≥ 60 dB", worst_linear >= 60);
  bar("the same, bifocal with its creases between texels", decibel(worst_crease) + " dB", "≥ 60 dB",
      worst_crease >= 60);
  bar("fragment and rays against reference, smallest PSNR", decibel(worst_reference) + " dB", "≥ 60 dB",
      worst_reference >= 60);
  std::cout << std::endl;
}

/// The largest |x + offset − u(x)| where the mask is not 0, in voxels of its axis; table read linearly and
/// clamped at its ends as the driver does.
double coordinate_error(const Warp& warp, std::size_t texels, const std::array<std::size_t, 3>& dims) {
  constexpr int kPoints = 1 << 16;
  const AxisTables tables = make_axis_tables({warp}, {}, {texels, texels, texels});
  const auto count = static_cast<double>(texels);
  double largest = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::vector<glm::vec4>& table = tables.texels[axis];
    for (int i = 0; i < kPoints; ++i) {
      const double x = (i + 0.5) / kPoints;
      const double at = std::clamp(x * count - 0.5, 0.0, count - 1);
      const auto j = std::min(static_cast<std::size_t>(at), texels - 2);
      const double f = at - static_cast<double>(j);
      const double offset =
          (1 - f) * static_cast<double>(table[j].r) + f * static_cast<double>(table[j + 1].r);
      const AxisSample exact = sample_axis(warp, static_cast<int>(axis), x);
      if (exact.mask > 0)
        largest = std::max(largest, std::abs(x + offset - exact.texture) * static_cast<double>(dims[axis]));
    }
  }
  return largest;
}

/// "dB linear, dB nearest; voxels".
std::string length_cell(const Bench& bench, Subject& subject, const Warp& warp, std::size_t length,
                        const Image& exact) {
  const auto against = [&](AxisFilter filter) {
    const Image image = shown(bench, subject, warp, Pipeline::axis, [&](Scene& s) {
      s.render.axis_texels = length;
      s.render.axis_filter = filter;
    });
    return decibel(difference(image, exact).psnr);
  };
  return against(AxisFilter::linear) + ", " + against(AxisFilter::nearest) + "; " +
         fixed(coordinate_error(warp, length, subject.prepared.volume.dims), 4);
}

void length_tables(const Bench& bench) {
  for (Subject& subject : subjects(bench)) {
    std::cout
        << "### The length of the tables: " << subject.name
        << "\n\nCells: PSNR against fragment in dB with linear tables, with nearest ones; largest error of "
           "a coordinate with linear ones in voxels.\n\n";
    std::vector<Display> list = displays(subject.prepared.volume.dims);
    list.erase(list.begin() + 1); // its creases are on texels of one length only
    std::vector<std::string> heads = {"texels"};
    std::vector<Image> exact;
    for (const Display& display : list) {
      heads.push_back(display.name);
      exact.push_back(shown(bench, subject, display.warp, Pipeline::fragment));
    }
    Table table(heads);
    for (std::size_t length = min_axis_texels; length <= max_axis_texels; length *= 2) {
      say("axis: " + subject.name + ", " + std::to_string(length) + " texels");
      std::vector<std::string> cells = {std::to_string(length)};
      for (std::size_t i = 0; i < list.size(); ++i)
        cells.push_back(length_cell(bench, subject, list[i].warp, length, exact[i]));
      table.row(cells);
    }
  }
}

} // namespace

void axis_section(const Bench& bench) {
  std::cout << "## Cohen's tables\n\n"
               "Highlight (distance, power 2) and attenuation (distance) are on; target rgba32f, filter "
               "linear-exact, "
            << kPixels
            << "² pixels, orthographic, oblique view. Bifocal shows about [0.4, 0.6] in a region of 0.5 by "
               "0.5 by 0.5, "
               "the fisheye has d = 3, the lenses inner 0.15, outer 0.3125 and magnification 2. The lenses' "
               "boxes end on "
               "borders of texels. PSNR in dB: axis with linear and with nearest tables against fragment, "
               "then axis "
               "(linear), fragment and rays against reference.\n\n";
  pipelines_table(bench);
  length_tables(bench);
}

} // namespace slicelens::accuracy
