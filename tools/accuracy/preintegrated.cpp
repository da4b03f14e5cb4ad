// Classification of segments against classification of points, under transfer functions that have thin peaks.

#include "bench.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>

namespace slicelens::accuracy {

namespace {

constexpr int kPixels = 128;
constexpr std::array<double, 4> kSpacings = {2, 1, 0.5, 0.25};

struct Way {
  const char* name;
  ProjectionName projection;
  Pipeline pipeline;
  Proxy proxy;
};

const std::vector<Way>& ways() {
  static const std::vector<Way> list = {
      {"orthographic, slices", ProjectionName::orthographic, Pipeline::slices, Proxy::planes},
      {"orthographic, rays", ProjectionName::orthographic, Pipeline::rays, Proxy::planes},
      {"perspective, slices (planes)", ProjectionName::perspective, Pipeline::slices, Proxy::planes},
      {"perspective, slices (shells)", ProjectionName::perspective, Pipeline::slices, Proxy::shells},
      {"perspective, rays", ProjectionName::perspective, Pipeline::rays, Proxy::planes}};
  return list;
}

Image picture(const Bench& bench, Subject& subject, const Way& way, Classification classification,
              double spacing, Shading shading = Shading::none) {
  return draw(bench, subject, [&](Scene& scene) {
    scene.camera.projection = way.projection;
    scene.render.pipeline = way.pipeline;
    scene.render.proxy = way.proxy;
    scene.render.classification = classification;
    scene.render.spacing = spacing;
    scene.render.shading = shading;
  });
}

/// Opacity `top` at `middle`, none from `half` away: fractions of the data's range. Colours go from red to
/// blue.
TransferFunction peak(const Volume& volume, double middle, double half, double top) {
  const double range = volume.max - volume.min;
  const auto at = [&](double f) { return volume.min + f * range; };
  return {{{at(middle - half), 1, 0.3, 0.2, 0},
           {at(middle), 1, 1, 0.6, top},
           {at(middle + half), 0.2, 0.3, 1, 0}},
          std::nullopt,
          ""};
}

/// Mean error of the opacity on the ramp. Along each ray the value rises linearly: 1 − exp(−∫τ dv/(dv/ds)).
double ramp_error(const Image& image, const PreparedScene& prepared, double depth) {
  const glm::dmat3 turn(texture_from_world(prepared.box));
  double sum = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const glm::dvec3 direction = turn * ray_from_pixel(prepared.view, x + 0.5, y + 0.5).direction;
      const double expected = 1 - std::exp(-depth / std::abs(direction.x));
      sum += std::abs(static_cast<double>(channel(image, x, y, 3)) - expected);
    }
  }
  return sum / (image.width * image.height);
}

void ramp_table(const Bench& bench) {
  constexpr double half = 0.004;
  constexpr double top = 0.9;
  std::cout
      << "### A ramp, in closed form\n\n"
         "`ramp` 64³ seen obliquely, all pixels through its middle. Opacity 0.9 at one half, none from 0.004 "
         "of the "
         "range away: a quarter of a voxel. Mean error of the opacity against 1 − exp(−∫τ dv/(dv/ds)).\n\n";
  Subject subject = phantom_subject("ramp", 64, constant_transfer({1, 1, 1, 1}), 64);
  // The ramp's values are texture coordinates.
  subject.prepared.transfer = {
      {{0.5 - half, 1, 1, 1, 0}, {0.5, 1, 1, 1, top}, {0.5 + half, 1, 1, 1, 0}}, std::nullopt, ""};
  CameraSettings& camera = subject.prepared.scene.camera;
  camera.azimuth = 70;
  camera.elevation = 15;
  camera.zoom = 4;
  const double depth = 2 * half * (top + (1 - top) * std::log(1 - top)) / top;
  double worst = 0;
  {
    Table table({"drawn by", "classification", "2", "1", "0.5", "0.25"});
    for (const Way& way : ways()) {
      std::array<double, 4> post{};
      for (const Classification classification : {Classification::post, Classification::preintegrated}) {
        const bool points = classification == Classification::post;
        std::vector<std::string> cells = {way.name, points ? "post" : "preintegrated"};
        for (std::size_t i = 0; i < kSpacings.size(); ++i) {
          // The view of the picture: draw() puts the scene back afterwards.
          PreparedScene seen = subject.prepared;
          seen.scene.camera.projection = way.projection;
          prepare_again(seen);
          const double error =
              ramp_error(picture(bench, subject, way, classification, kSpacings[i]), seen, depth);
          cells.push_back(scientific(error));
          if (points)
            post[i] = error;
          else if (kSpacings[i] >= 0.5)
            worst = std::max(worst, error / post[i]);
        }
        table.row(cells);
      }
    }
  }
  bar("largest error by that of post, spacing 0.5 to 2", fixed(worst, 3), "≤ 0.05", worst <= 0.05);
  std::cout << std::endl;
}

void head_table(const Bench& bench) {
  std::cout
      << "### A head\n\n"
         "`head` 96³, "
      << kPixels
      << "² pixels, values from −1000 to 2300 HU, a peak of opacity 0.9 within ±`half` of that range about "
         "0.3 of it (−10 HU: in the border of skin and air) or 0.6 (980 HU: in that of teeth and of the "
         "densest bone). PSNR in dB against the reference by points at spacing 1/32.\n\n";
  Subject subject = phantom_subject("head", 96, constant_transfer({1, 1, 1, 1}), kPixels);
  const Way reference = {"", ProjectionName::orthographic, Pipeline::reference, Proxy::planes};
  Table table({"about", "half", "classification", "2", "1", "0.5", "0.25"});
  for (const double middle : {0.3, 0.6}) {
    for (const double half : {0.05, 0.01, 0.003}) {
      say("preintegrated: head, " + fixed(middle, 1) + " ± " + fixed(half, 3));
      subject.prepared.transfer = peak(subject.prepared.volume, middle, half, 0.9);
      const Image truth = picture(bench, subject, reference, Classification::post, 1.0 / 32);
      for (const Classification classification : {Classification::post, Classification::preintegrated}) {
        std::vector<std::string> cells = {fixed(middle, 1), fixed(half, 3),
                                          classification == Classification::post ? "post" : "preintegrated"};
        for (const double spacing : kSpacings)
          cells.push_back(
              decibel(difference(picture(bench, subject, ways()[0], classification, spacing), truth).psnr));
        table.row(cells);
      }
    }
  }
}

void parity_table(const Bench& bench) {
  std::cout
      << "### One picture by every pipeline\n\n"
         "`head` 96³, spacing 1, PSNR in dB of pre-integrated pictures. Slices are planes in orthographic "
         "views, shells in perspective.\n\n";
  Subject subject = phantom_subject("head", 96, constant_transfer({1, 1, 1, 1}), kPixels);
  double slices_worst = 1e9;
  double reference_worst = 1e9;
  {
    Table table(
        {"transfer function", "projection", "shading", "slices against rays", "rays against the reference"});
    const std::vector<std::pair<const char*, TransferFunction>> functions = {
        {"0 to .6 over the middle half", rising(subject.prepared.volume, 0.25, 0.75, 0.6)},
        {"peak 0.6 ± 0.05", peak(subject.prepared.volume, 0.6, 0.05, 0.9)},
        {"peak 0.6 ± 0.01", peak(subject.prepared.volume, 0.6, 0.01, 0.9)},
        {"peak 0.6 ± 0.003", peak(subject.prepared.volume, 0.6, 0.003, 0.9)}};
    for (const auto& [name, transfer] : functions) {
      subject.prepared.transfer = transfer;
      for (const bool perspective : {false, true}) {
        for (const Shading shading : {Shading::none, Shading::diffuse}) {
          const auto by = [&](Pipeline pipeline) {
            const bool shells = perspective && pipeline == Pipeline::slices;
            return picture(bench, subject,
                           {"", perspective ? ProjectionName::perspective : ProjectionName::orthographic,
                            pipeline, shells ? Proxy::shells : Proxy::planes},
                           Classification::preintegrated, 1, shading);
          };
          const Image rays = by(Pipeline::rays);
          const double slices = difference(by(Pipeline::slices), rays).psnr;
          const double reference = difference(rays, by(Pipeline::reference)).psnr;
          slices_worst = std::min(slices_worst, slices);
          reference_worst = std::min(reference_worst, reference);
          table.row({name, perspective ? "perspective" : "orthographic",
                     shading == Shading::none ? "none" : "diffuse", decibel(slices), decibel(reference)});
        }
      }
    }
  }
  bar("slices against rays", decibel(slices_worst) + " dB", "≥ 60 dB", slices_worst >= 60);
  bar("rays against the reference", decibel(reference_worst) + " dB", "≥ 55 dB", reference_worst >= 55);
  std::cout << std::endl;
}

} // namespace

void preintegrated_section(const Bench& bench) {
  say("pre-integrated classification");
  std::cout << "## Pre-integrated classification\n\n"
               "`render.classification: \"preintegrated\"` against `post`: rgba32f, linear-exact, spacings "
               "in voxels; the "
               "table of segments has 512² texels.\n\n";
  ramp_table(bench);
  head_table(bench);
  parity_table(bench);
}

} // namespace slicelens::accuracy
