// What 8 and 16 bits cost: in the target, in the transfer function's table, in the volume's texture and in
// the driver's filter.

#include "bench.h"
#include "scene/names.h"
#include "study/statistics.h"

#include <array>
#include <iostream>

namespace slicelens::accuracy {

namespace {

constexpr int kPixels = 192;

/// Everything in floats and exact.
void exact(Scene& scene) {
  scene.render.target = Target::rgba32f;
  scene.render.transfer_texture = TransferTexture::rgba32f;
  scene.render.volume_texture = VolumeTexture::r32f;
  scene.render.filter = Filter::linear_exact;
}

/// The scene in which one thing is changed: `common` in every picture, `change` only in the one judged.
/// Returns "dB against exact floats / dB against the reference".
std::string cost(const Bench& bench, Subject& subject, const Change& common, const Change& change) {
  const auto picture = [&](const Change& last) {
    return draw(bench, subject, [&](Scene& scene) {
      exact(scene);
      common(scene);
      last(scene);
    });
  };
  const Image judged = picture(change);
  const Image floats = picture([](Scene&) {});
  const Image truth = picture([](Scene& scene) { scene.render.pipeline = Pipeline::reference; });
  return decibel(difference(judged, floats).psnr) + " / " + decibel(difference(judged, truth).psnr);
}

TransferFunction thin(const Volume& v) { return rising(v, 0.25, 0.75, 0.01); }
TransferFunction dense(const Volume& v) { return rising(v, 0.25, 0.75, 0.6); }
TransferFunction steep(const Volume& v) { return rising(v, 0.3, 0.35, 1); }

std::vector<Subject> subjects() {
  std::vector<Subject> list;
  for (const char* name : {"engine", "head"}) {
    list.push_back(phantom_subject(name, 128, constant_transfer({1, 1, 1, 1}), kPixels));
    list.back().name += name == std::string("engine") ? ", 8 bit" : ", 16 bit";
  }
  return list;
}

struct Variant {
  std::string name;
  Change change;
};

/// Rows of variants, columns of thin and dense functions at spacings 1 and ¼.
void spacing_table(const Bench& bench, const std::string& title, const std::vector<Variant>& variants) {
  std::cout << "### " << title << "\n\n";
  Table table({"volume", title, "thin, spacing 1", "thin, 0.25", "dense, spacing 1", "dense, 0.25"});
  for (Subject& subject : subjects()) {
    say("precision: " + title + ", " + subject.name);
    for (const Variant& variant : variants) {
      std::vector<std::string> cells = {subject.name, variant.name};
      for (TransferFunction (*transfer)(const Volume&) : {thin, dense}) {
        subject.prepared.transfer = transfer(subject.prepared.volume);
        for (const double spacing : {1.0, 0.25}) {
          cells.push_back(cost(
              bench, subject, [&](Scene& s) { s.render.spacing = spacing; }, variant.change));
        }
      }
      table.row(cells);
    }
  }
}

void texture_table(const Bench& bench) {
  std::cout << "### Volume texture and filter\n\nSpacing 0.5; zoom 8 shows 16 voxels across the picture.\n\n";
  Table table(
      {"volume", "texture", "filter", "dense, zoom 1", "dense, zoom 8", "steep, zoom 1", "steep, zoom 8"});
  for (Subject& subject : subjects()) {
    say("precision: texture and filter, " + subject.name);
    for (const VolumeTexture texture : {VolumeTexture::r8, VolumeTexture::r16, VolumeTexture::r32f}) {
      for (const Filter filter : {Filter::nearest, Filter::linear, Filter::linear_exact}) {
        if (filter == Filter::nearest && texture != VolumeTexture::r16)
          continue;
        std::vector<std::string> cells = {subject.name, word(texture), word(filter)};
        for (TransferFunction (*transfer)(const Volume&) : {dense, steep}) {
          subject.prepared.transfer = transfer(subject.prepared.volume);
          for (const double zoom : {1.0, 8.0}) {
            cells.push_back(cost(
                bench, subject,
                [&](Scene& s) {
                  s.camera.zoom = zoom;
                  s.render.spacing = 0.5;
                },
                [&](Scene& s) {
                  s.render.volume_texture = texture;
                  s.render.filter = filter;
                }));
          }
        }
        table.row(cells);
      }
    }
  }
}

/// Medians of the draw times of all variants, taken in turn after a round that does not count, so that a
/// machine's other work falls on all of them alike.
std::vector<double> draw_seconds(const Bench& bench, Subject& subject, const std::vector<Variant>& variants,
                                 const Change& common) {
  constexpr int rounds = 7;
  std::vector<std::vector<double>> seconds(variants.size());
  for (int round = 0; round <= rounds; ++round) {
    say("precision: times, round " + std::to_string(round));
    for (std::size_t i = 0; i < variants.size(); ++i) {
      const RenderResult result = render_changed(bench, subject, [&](Scene& scene) {
        variants[i].change(scene);
        common(scene);
      });
      if (round > 0)
        seconds[i].push_back(result.times.draw);
    }
  }
  std::vector<double> medians;
  for (const std::vector<double>& values : seconds)
    medians.push_back(median(values));
  return medians;
}

/// The default, the papers' precision and single changes, with their times.
void choice_table(const Bench& bench) {
  std::cout
      << "### Which default: quality against time\n\nHead 128³ (16 bit) with the dense function, spacing "
         "1, slices. Quality over the same scene in exact floats / against the reference, dB. Time: draw, "
         "median of 7, as a multiple of the default's, without and with diffuse shading (central "
         "differences). Ratios are this driver's; `volume r16` is what the default becomes for this volume, "
         "so that its ratio shows the noise.\n\n";
  const auto defaults = [](Scene& s) {
    const RenderSettings standard;
    s.render.target = standard.target;
    s.render.transfer_texture = standard.transfer_texture;
    s.render.volume_texture = standard.volume_texture;
    s.render.filter = standard.filter;
  };
  const auto with = [=](Change change) {
    return [=](Scene& s) {
      defaults(s);
      change(s);
    };
  };
  const std::vector<Variant> variants = {
      {"default", defaults},
      {"target rgba16f", with([](Scene& s) { s.render.target = Target::rgba16f; })},
      {"target rgba8", with([](Scene& s) { s.render.target = Target::rgba8; })},
      {"transfer rgba8", with([](Scene& s) { s.render.transfer_texture = TransferTexture::rgba8; })},
      {"volume r8", with([](Scene& s) { s.render.volume_texture = VolumeTexture::r8; })},
      {"volume r16", with([](Scene& s) { s.render.volume_texture = VolumeTexture::r16; })},
      {"volume r32f", with([](Scene& s) { s.render.volume_texture = VolumeTexture::r32f; })},
      {"filter nearest", with([](Scene& s) { s.render.filter = Filter::nearest; })},
      {"filter linear-exact", with([](Scene& s) { s.render.filter = Filter::linear_exact; })},
      {"the papers' own: target, transfer and volume of 8 bits", with([](Scene& s) {
         s.render.target = Target::rgba8;
         s.render.transfer_texture = TransferTexture::rgba8;
         s.render.volume_texture = VolumeTexture::r8;
       })}};
  Subject subject = std::move(subjects().back());
  subject.prepared.transfer = dense(subject.prepared.volume);
  const std::vector<double> plain = draw_seconds(bench, subject, variants, [](Scene& s) {
    s.render.size = {384, 384};
  });
  const std::vector<double> shaded = draw_seconds(bench, subject, variants, [](Scene& s) {
    s.render.size = {384, 384};
    s.render.shading = Shading::diffuse;
  });
  Table table({"variant", "quality", "time", "time, shaded"});
  for (std::size_t i = 0; i < variants.size(); ++i) {
    table.row({variants[i].name,
               cost(
                   bench, subject, [](Scene&) {}, variants[i].change),
               fixed(plain[i] / plain[0], 2), fixed(shaded[i] / shaded[0], 2)});
  }
}

} // namespace

void precision_section(const Bench& bench) {
  std::cout << "## What precision costs\n\n"
               "One thing at a time is made coarser; everything else is exact floats (target, transfer table "
               "and volume in 32-bit floats, filter weights in floats). Opacity rises linearly: `thin` to "
               ".01 and `dense` "
               "to .6 over the middle half of the data's range, `steep` to 1 over a twentieth of it. Cells: "
               "PSNR in dB against the picture "
               "in exact floats / against `reference` in double precision.\n\n";
  spacing_table(bench, "target",
                {{"rgba8", [](Scene& s) { s.render.target = Target::rgba8; }},
                 {"rgba16f", [](Scene& s) { s.render.target = Target::rgba16f; }},
                 {"rgba32f", [](Scene&) {}}});
  spacing_table(bench, "transfer table",
                {{"rgba8", [](Scene& s) { s.render.transfer_texture = TransferTexture::rgba8; }},
                 {"rgba32f", [](Scene&) {}}});
  texture_table(bench);
  choice_table(bench);
}

} // namespace slicelens::accuracy
