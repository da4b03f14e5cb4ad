#include "bench.h"

#include "study/metrics.h"
#include "volume/phantom.h"
#include "volume/read.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <limits>

namespace slicelens::accuracy {

Scene oblique_scene(int size) {
  Scene scene;
  scene.camera.azimuth = 33;
  scene.camera.elevation = 21;
  scene.camera.roll = 10;
  scene.render.size = {static_cast<std::size_t>(size), static_cast<std::size_t>(size)};
  scene.render.target = Target::rgba32f;
  scene.render.filter = Filter::linear_exact;
  scene.render.background = {0, 0, 0, 0};
  return scene;
}

Subject phantom_subject(const std::string& name, int n, TransferFunction transfer, int size) {
  const auto edge = static_cast<std::size_t>(n);
  Scene scene = oblique_scene(size);
  scene.volume.phantom = name;
  scene.volume.size = {edge, edge, name == "engine" ? edge / 2 : edge};
  Volume volume = make_phantom(name, *scene.volume.size);
  const std::string label = name + " " + std::to_string(n) + "³";
  return {label, prepare(std::move(scene), std::move(volume), std::move(transfer)), true};
}

TransferFunction rising(const Volume& volume, double low, double high, double top) {
  const double range = volume.max - volume.min;
  return {{{volume.min + low * range, 0.35, 0.2, 0.1, 0}, {volume.min + high * range, 1, 0.95, 0.85, top}},
          std::nullopt,
          ""};
}

std::vector<Subject> real_subjects(const Bench& bench, int size) {
  struct Entry {
    const char* name;
    const char* file;
    bool transparent_border;
    std::optional<glm::dvec3> spacing;
  };
  // The PNG stack does not hold its spacing; 1:1:2 is what its source states.
  const std::vector<Entry> entries = {
      {"CT chest 512×512×128", "ct_chest_large/series", false, std::nullopt},
      {"CT head 256×256×113", "cthead_png16/slices", false, glm::dvec3(1, 1, 2)},
      {"engine 256×256×128", "engine/engine.vti", false, std::nullopt},
      {"bonsai 256³", "bonsai/bonsai.nii.gz", false, std::nullopt}};
  std::vector<Subject> subjects;
  for (const Entry& entry : entries) {
    const std::filesystem::path file = bench.volumes / entry.file;
    if (bench.volumes.empty() || !std::filesystem::exists(file))
      continue;
    say(std::string("reading ") + entry.name);
    VolumeSource source;
    source.file = file;
    source.spacing = entry.spacing;
    Volume volume = read_volume(source);
    TransferFunction transfer = automatic_transfer(volume);
    Scene scene = oblique_scene(size);
    scene.volume.file = entry.file;
    subjects.push_back({entry.name, prepare(std::move(scene), std::move(volume), std::move(transfer)),
                        entry.transparent_border});
  }
  return subjects;
}

RenderResult render_changed(const Bench& bench, Subject& subject, const Change& change) {
  const Scene before = subject.prepared.scene;
  change(subject.prepared.scene);
  prepare_again(subject.prepared);
  RenderResult result = render(subject.prepared, &bench.context, {});
  subject.prepared.scene = before;
  prepare_again(subject.prepared);
  return result;
}

Image draw(const Bench& bench, Subject& subject, const Change& change) {
  return render_changed(bench, subject, change).image;
}

Difference difference(const Image& a, const Image& b, double limit) {
  Difference result;
  const Metrics metrics = compare_images(a, b);
  const double infinite = std::numeric_limits<double>::infinity();
  result.psnr = metrics.psnr.value_or(infinite);
  result.psnr_covered = metrics.psnr_covered.value_or(infinite);
  std::size_t values = 0;
  for (std::size_t i = 0; i + 3 < a.pixels.size(); i += 4) {
    std::size_t here = 0;
    for (std::size_t c = 0; c < 4; ++c) {
      const double d = std::abs(static_cast<double>(a.pixels[i + c]) - static_cast<double>(b.pixels[i + c]));
      result.largest = std::max(result.largest, d);
      here += d > limit ? 1 : 0;
    }
    values += here;
    result.pixels += here > 0 ? 1 : 0;
  }
  const auto all = static_cast<double>(a.pixels.size());
  result.share = static_cast<double>(values) / all;
  if (metrics.covered_pixels > 0)
    result.share_covered = static_cast<double>(values) / (4 * static_cast<double>(metrics.covered_pixels));
  return result;
}

namespace {
std::string formatted(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}
} // namespace

std::string scientific(double value) { return formatted("%.1e", value); }
std::string decibel(double value) { return std::isinf(value) ? "equal" : formatted("%.1f", value); }
std::string percent(double share) { return share == 0 ? "0" : formatted("%.3f %%", 100 * share); }
std::string fixed(double value, int digits) {
  return formatted(("%." + std::to_string(digits) + "f").c_str(), value);
}

Table::Table(const std::vector<std::string>& heads) {
  row(heads);
  std::cout << "|";
  for (std::size_t i = 0; i < heads.size(); ++i)
    std::cout << (i == 0 ? "---|" : "---:|");
  std::cout << "\n";
}

void Table::row(const std::vector<std::string>& cells) {
  std::cout << "|";
  for (const std::string& cell : cells)
    std::cout << " " << cell << " |";
  std::cout << std::endl;
}

Table::~Table() { std::cout << std::endl; }

void bar(const std::string& text, const std::string& measured, const std::string& limit, bool met) {
  std::cout << "- " << text << ": " << measured << " (bar: " << limit << "): " << (met ? "met" : "**missed**")
            << std::endl;
}

void say(const std::string& text) { std::cerr << "slicelens_accuracy: " << text << std::endl; }

} // namespace slicelens::accuracy
