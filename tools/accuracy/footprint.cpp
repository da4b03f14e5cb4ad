// render.footprint: point samples and levels of a mip pyramid against supersampled pictures, and their times.

#include "bench.h"

#include <algorithm>
#include <cmath>
#include <iostream>

namespace slicelens::accuracy {

namespace {

constexpr int kVoxels = 128;
constexpr int kFactor = 6; ///< rays a pixel on each axis, and samples for one, of the truth
constexpr int kRounds = 7;

struct Display {
  std::string name;
  std::vector<Warp> warps;
  std::size_t pixels = 0;
};

/// Pictures as small as a deformation that squeezes makes them need it, and one without a deformation.
std::vector<Display> displays() {
  Bifocal bifocal;
  bifocal.focus = ranges_of(glm::dvec3(0.06, 0.25, 0.25), glm::dvec3(0.94, 0.75, 0.75));
  bifocal.shown = ranges_of(glm::dvec3(0.445, 0.25, 0.25), glm::dvec3(0.555, 0.75, 0.75));
  Sine sine;
  sine.axis = Axis::x;
  sine.along = Axis::z;
  sine.amplitude = 0.1;
  sine.wavelength = 0.2;
  Fisheye fisheye;
  fisheye.distortion = glm::dvec3(3);
  return {{"none", {}, 32},
          {"bifocal, x squeezed 8 times", {bifocal}, 96},
          {"sine, sheared by 3.1", {sine}, 96},
          {"fisheye, distortion 3", {fisheye}, 96}};
}

/// What a picture of the view would show if every pixel were the mean of kFactor² rays.
struct Truth {
  Image image;
  std::vector<bool> inner; ///< of each pixel: every one of its rays meets something
};

Truth averaged(const Image& fine) {
  Truth truth;
  truth.image = make_image(fine.width / kFactor, fine.height / kFactor);
  truth.inner.assign(
      static_cast<std::size_t>(truth.image.width) * static_cast<std::size_t>(truth.image.height), true);
  for (int y = 0; y < fine.height; ++y) {
    for (int x = 0; x < fine.width; ++x) {
      const int pixel = y / kFactor * truth.image.width + x / kFactor;
      if (channel(fine, x, y, 3) <= 0)
        truth.inner[static_cast<std::size_t>(pixel)] = false;
      for (int c = 0; c < 4; ++c)
        channel(truth.image, x / kFactor, y / kFactor, c) +=
            channel(fine, x, y, c) / static_cast<float>(kFactor * kFactor);
    }
  }
  return truth;
}

/// PSNR over RGB of the inner pixels.
double inner_psnr(const Image& image, const Truth& truth) {
  double sum = 0;
  double count = 0;
  for (std::size_t i = 0; i < truth.inner.size(); ++i) {
    for (std::size_t c = 0; c < 3 && truth.inner[i]; ++c, ++count) {
      const double d =
          static_cast<double>(image.pixels[4 * i + c]) - static_cast<double>(truth.image.pixels[4 * i + c]);
      sum += d * d;
    }
  }
  return 10 * std::log10(count / sum);
}

/// "point, mip" over all covered pixels and over inner ones, and the time of levels by that of points.
std::vector<std::string> cells(const Bench& bench, Subject& subject, const Display& display,
                               Shading shading) {
  const auto common = [&](Scene& scene) {
    scene.warp = display.warps;
    scene.render.size = {display.pixels, display.pixels};
    scene.render.pipeline = display.warps.empty() ? Pipeline::slices : Pipeline::fragment;
    scene.render.shading = shading;
    scene.render.gradient_space = GradientSpace::data;
  };
  const Truth truth = averaged(draw(bench, subject, [&](Scene& scene) {
    common(scene);
    scene.render.pipeline = Pipeline::rays;
    for (std::size_t& edge : scene.render.size)
      edge *= kFactor;
    scene.render.spacing /= kFactor;
  }));
  Image picture[2];
  std::vector<double> seconds[2];
  for (int round = 0; round < kRounds; ++round) {
    for (const Footprint footprint : {Footprint::point, Footprint::mip}) {
      RenderResult result = render_changed(bench, subject, [&](Scene& scene) {
        common(scene);
        scene.render.footprint = footprint;
      });
      const std::size_t i = footprint == Footprint::mip ? 1 : 0;
      picture[i] = std::move(result.image);
      if (round > 0) // the first does not count
        seconds[i].push_back(result.times.draw);
    }
  }
  for (std::vector<double>& times : seconds)
    std::sort(times.begin(), times.end());
  const auto covered = [&](const Image& image) {
    return decibel(difference(image, truth.image).psnr_covered);
  };
  return {covered(picture[0]) + ", " + covered(picture[1]),
          decibel(inner_psnr(picture[0], truth)) + ", " + decibel(inner_psnr(picture[1], truth)),
          fixed(seconds[1][kRounds / 2] / seconds[0][kRounds / 2], 2)};
}

std::string level_count(Subject& subject, const Display& display) {
  const Scene before = subject.prepared.scene;
  subject.prepared.scene.warp = display.warps;
  subject.prepared.scene.render.pipeline = display.warps.empty() ? Pipeline::slices : Pipeline::fragment;
  subject.prepared.scene.render.size = {display.pixels, display.pixels};
  subject.prepared.scene.render.footprint = Footprint::mip;
  prepare_again(subject.prepared);
  const std::string text = std::to_string(subject.prepared.levels);
  subject.prepared.scene = before;
  prepare_again(subject.prepared);
  return text;
}

} // namespace

void footprint_section(const Bench& bench) {
  std::cout
      << "## Point samples and levels\n\nPSNR in dB of point samples, of levels (`point, mip`) against the "
         "same view with "
      << kFactor << "² rays for each pixel and " << kFactor
      << " samples for one, averaged. `covered`: over pixels that show anything; `inner`: over those all of "
         "whose rays do, without the outline, which no filter of the volume smooths; target rgba32f, filter "
         "linear, slices, oblique. `time`: to draw, "
         "levels by points, median of "
      << kRounds - 1
      << " taken in turn. marschner-lobb and checkerboard: white, opacity linear in the value up to 0.05; "
         "head: "
         "brown to ivory, opacity from 0 to 0.3. Shaded: diffuse, central differences in the data.\n\n";
  Table table({"volume", "deformation", "pixels", "levels", "covered", "inner", "time", "covered, shaded",
               "inner, shaded", "time, shaded"});
  for (const std::string name : {"marschner-lobb", "checkerboard", "head"}) {
    Subject subject = phantom_subject(name, kVoxels, {}, 96);
    subject.prepared.transfer = name == "head"
                                    ? rising(subject.prepared.volume, 0.3, 0.9, 0.3)
                                    : TransferFunction{{{0, 1, 1, 1, 0}, {1, 1, 1, 1, 0.05}}, {}, ""};
    subject.prepared.scene.render.filter = Filter::linear;
    for (const Display& display : displays()) {
      say("footprint: " + subject.name + ", " + display.name);
      std::vector<std::string> row = {subject.name, display.name, std::to_string(display.pixels) + "²",
                                      level_count(subject, display)};
      for (const Shading shading : {Shading::none, Shading::diffuse}) {
        for (std::string& cell : cells(bench, subject, display, shading))
          row.push_back(std::move(cell));
      }
      table.row(row);
    }
  }
}

} // namespace slicelens::accuracy
