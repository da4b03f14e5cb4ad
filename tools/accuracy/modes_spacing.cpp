// Every mode by slices and rays against the reference, and the reference against finer samples.

#include "modes.h"
#include "scene/names.h"
#include "volume/phantom.h"

#include <array>
#include <iostream>

namespace slicelens::accuracy {

namespace {

constexpr int kPixels = 128;
constexpr std::array<double, 4> kSpacings = {2, 1, 0.5, 0.25};
constexpr double kFinest = 1.0 / 32;

/// A subject under a mode.
struct Case {
  std::string name;
  Subject subject;
};

/// White, its opacity from 0 at `low` to 1 at `high`.
TransferFunction white_between(double low, double high) {
  return {{{low, 1, 1, 1, 0}, {high, 1, 1, 1, 1}}, std::nullopt, ""};
}

Case phantom_case(const std::string& phantom, const std::string& what, TransferFunction transfer, Mode mode,
                  std::optional<double> isovalue = std::nullopt) {
  Subject subject = phantom_subject(phantom, 64, std::move(transfer), kPixels);
  Scene& scene = subject.prepared.scene;
  scene.render.mode = mode;
  scene.render.isovalue = isovalue;
  if (mode == Mode::iso)
    scene.render.shading = Shading::diffuse;
  if (phantom == "head" && mode == Mode::minip) // the air around it would be all that is seen
    scene.crop = CropSettings{glm::dvec3(0.3), glm::dvec3(0.7), ClipSpace::texture};
  prepare_again(subject.prepared);
  return {subject.name + ", " + what, std::move(subject)};
}

/// Four organs in a translucent skin.
Case frog_case() {
  Scene scene = oblique_scene(kPixels);
  scene.volume.phantom = "organs";
  scene.volume.size = {96, 96, 48};
  scene.volume.labels = "organs-labels";
  scene.camera.elevation = -60;
  scene.camera.zoom = 1.6;
  scene.render.mode = Mode::two_level;
  std::vector<std::optional<TransferFunction>> transfers;
  const auto add = [&](std::size_t label, const glm::dvec4& rgba) {
    scene.labels.push_back({label, "", LabelMode::dvr, std::nullopt, true});
    transfers.emplace_back(constant_transfer(rgba));
  };
  add(1, {0.55, 0.75, 0.45, 0.03});
  add(3, {0.95, 0.92, 0.82, 0.5});
  add(11, {0.5, 0.22, 0.12, 0.2});
  add(13, {0.9, 0.6, 0.35, 0.2});
  Volume volume = make_phantom("organs", *scene.volume.size);
  Volume labels = make_phantom("organs-labels", *scene.volume.size);
  return {"organs 96×96×48, two-level",
          {"organs",
           prepare(std::move(scene), std::move(volume), constant_transfer({0, 0, 0, 0}), {},
                   LoadedLabels{std::move(labels), std::move(transfers)}),
           true}};
}

std::vector<Case> cases() {
  std::vector<Case> list;
  list.push_back(phantom_case("head", "minip of its middle", white_between(-1000, 1250), Mode::minip));
  list.push_back(phantom_case("head", "average", white_between(-1000, 1000), Mode::average));
  list.push_back(phantom_case("head", "iso −300", constant_transfer({1, 0.9, 0.8, 1}), Mode::iso, -300));
  list.push_back(phantom_case("marschner-lobb", "minip", white_between(0, 1), Mode::minip));
  list.push_back(phantom_case("marschner-lobb", "average", white_between(0, 1), Mode::average));
  list.push_back(
      phantom_case("marschner-lobb", "iso 0.5", constant_transfer({1, 0.9, 0.8, 1}), Mode::iso, 0.5));
  list.push_back(frog_case());
  return list;
}

/// Who draws; proxy `shells` for perspective slices only.
struct Way {
  const char* name;
  Pipeline pipeline;
  Proxy proxy;
};

Image picture(const Bench& bench, Subject& subject, const Way& way, bool perspective, double spacing) {
  return draw(bench, subject, [&](Scene& scene) {
    scene.camera.projection = perspective ? ProjectionName::perspective : ProjectionName::orthographic;
    scene.render.pipeline = way.pipeline;
    scene.render.proxy = way.proxy;
    scene.render.spacing = spacing;
  });
}

std::string cell(const Image& a, const Image& b) {
  const Difference apart = difference(a, b);
  return decibel(apart.psnr) + ", " + scientific(apart.largest);
}

void rows_of_case(const Bench& bench, Case& what, bool perspective, Table& table) {
  const Way reference = {"reference", Pipeline::reference, Proxy::planes};
  std::vector<Way> ways = {{"slices", Pipeline::slices, Proxy::planes}};
  if (perspective) {
    ways.front().name = "slices (planes)";
    if (what.subject.prepared.scene.render.mode != Mode::iso)
      ways.push_back({"slices (shells)", Pipeline::slices, Proxy::shells});
  }
  ways.push_back({"rays", Pipeline::rays, Proxy::planes});
  const char* projection = perspective ? "perspective" : "orthographic";
  std::vector<Image> truths;
  for (const double spacing : kSpacings)
    truths.push_back(picture(bench, what.subject, reference, perspective, spacing));
  for (const Way& way : ways) {
    std::vector<std::string> cells = {what.name, projection, way.name};
    for (std::size_t i = 0; i < kSpacings.size(); ++i)
      cells.push_back(cell(picture(bench, what.subject, way, perspective, kSpacings[i]), truths[i]));
    table.row(cells);
  }
  const Image finest = picture(bench, what.subject, reference, perspective, kFinest);
  std::vector<std::string> cells = {what.name, projection, "*reference, against 1/32*"};
  for (const Image& truth : truths)
    cells.push_back(cell(truth, finest));
  table.row(cells);
}

} // namespace

void mode_spacing_table(const Bench& bench) {
  std::cout
      << "### Every mode against the reference and the spacing\n\n"
      << kPixels
      << "² pixels, view angle 30° under perspective. PSNR in dB and largest difference. Slices and "
         "rays: against `reference` at the same spacing; `reference` itself: against its own picture at "
         "spacing 1/32. `iso` is lit (diffuse, central differences); `two-level` composites four "
         "labelled organs.\n\n";
  Table table({"volume, mode", "projection", "drawn by", "2", "1", "0.5", "0.25"});
  for (Case& what : cases()) {
    for (const bool perspective : {false, true}) {
      say("modes: " + what.name);
      rows_of_case(bench, what, perspective, table);
    }
  }
}

} // namespace slicelens::accuracy
