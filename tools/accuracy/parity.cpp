// The same orthographic scene by slices, by rays and by the reference, sample for sample.

#include "bench.h"
#include "scene/names.h"

#include <algorithm>
#include <iostream>
#include <limits>

namespace slicelens::accuracy {

namespace {

struct Case {
  std::string name;
  Change change;
  bool for_real_volumes = true; ///< real volumes take the shorter list
};

std::vector<Case> cases() {
  const auto shaded = [](Scene& s, Gradient gradient) {
    s.render.shading = Shading::diffuse;
    s.render.gradient = gradient;
  };
  const auto clipped = [](Scene& s) {
    s.clip = {{{0.5, 0.5, 0.5}, {-1, 0.3, 0.2}, ClipSpace::texture},
              {{0.4, 0.3, 0.6}, {0.2, 1, 0.1}, ClipSpace::texture}};
  };
  return {
      {"dvr", [](Scene&) {}, true},
      {"dvr, front to back", [](Scene& s) { s.render.order = Order::front_to_back; }, false},
      {"dvr, spacing 0.4", [](Scene& s) { s.render.spacing = 0.4; }, false},
      {"mip", [](Scene& s) { s.render.mode = Mode::mip; }, true},
      {"xray", [](Scene& s) { s.render.mode = Mode::xray; }, true},
      {"diffuse, forward", [=](Scene& s) { shaded(s, Gradient::forward); }, false},
      {"diffuse, central", [=](Scene& s) { shaded(s, Gradient::central); }, true},
      {"dvr, two clipping planes", [=](Scene& s) { clipped(s); }, true},
      {"diffuse, central, front to back, clipped",
       [=](Scene& s) {
         shaded(s, Gradient::central);
         clipped(s);
         s.render.order = Order::front_to_back;
       },
       false},
  };
}

/// The worst that a group of subjects shows.
struct Worst {
  double share = 0;
  double psnr = std::numeric_limits<double>::infinity();
};

void measure(const Bench& bench, Subject& subject, const Case& test, Table& table, Worst& worst) {
  const auto picture = [&](Pipeline pipeline) {
    return draw(bench, subject, [&](Scene& scene) {
      test.change(scene);
      scene.render.pipeline = pipeline;
      if (pipeline != Pipeline::slices)
        scene.render.order = Order::back_to_front;
    });
  };
  const Image slices = picture(Pipeline::slices);
  const Image rays = picture(Pipeline::rays);
  const Image truth = picture(Pipeline::reference);
  const Difference pair = difference(slices, rays);
  const Difference s = difference(slices, truth);
  const Difference r = difference(rays, truth);
  table.row({subject.name, test.name, percent(pair.share), percent(pair.share_covered),
             std::to_string(pair.pixels), scientific(pair.largest), decibel(pair.psnr), decibel(s.psnr),
             decibel(r.psnr), decibel(s.psnr_covered), decibel(r.psnr_covered)});
  worst.share = std::max(worst.share, pair.share);
  worst.psnr = std::min({worst.psnr, s.psnr, r.psnr});
}

/// Phantoms with a transparent border, then those that touch the box.
std::vector<Subject> phantom_subjects() {
  std::vector<Subject> list;
  const auto add = [&](const char* name, double low, double high, double top, bool transparent_border) {
    Subject subject = phantom_subject(name, 128, constant_transfer({1, 1, 1, 1}), 192);
    subject.prepared.transfer = rising(subject.prepared.volume, low, high, top);
    subject.transparent_border = transparent_border;
    list.push_back(std::move(subject));
  };
  add("head", 0.27, 0.6, 0.5, true);
  add("engine", 0.2, 0.9, 0.3, true);
  add("blob", 0.05, 1, 0.2, true);
  add("brick", 0.2, 0.9, 0.4, true);
  add("checkerboard", 0.1, 0.9, 0.05, false);
  Subject box = phantom_subject("box", 128, constant_transfer({1, 0.8, 0.6, 0.02}), 192);
  box.transparent_border = false;
  list.push_back(std::move(box));
  return list;
}

} // namespace

void parity_section(const Bench& bench) {
  std::cout << "## Slices, rays and the reference: the same orthographic scene\n\n"
               "Target rgba32f, filter linear-exact, spacing 1 unless stated, oblique view. `share`: of all "
               "values, those in which slices and rays differ by more than 1e-3; `covered`: the same among "
               "covered pixels only; `pixels`: pixels with such a value; `largest`: largest difference. Then "
               "PSNR in dB: slices against rays, each against `reference`, and each against it over covered "
               "pixels only.\n\n";
  for (const bool transparent : {true, false}) {
    std::cout << (transparent ? "### Volumes with a transparent border\n\n"
                              : "### Volumes that touch their box: flips on the outline\n\n");
    Worst worst;
    {
      Table table({"volume", "case", "share", "covered", "pixels", "largest", "slices/rays", "slices", "rays",
                   "slices, covered", "rays, covered"});
      std::vector<Subject> subjects = phantom_subjects();
      for (Subject& real : real_subjects(bench, 192))
        subjects.push_back(std::move(real));
      for (Subject& subject : subjects) {
        if (subject.transparent_border != transparent)
          continue;
        say("parity: " + subject.name);
        for (const Case& test : cases()) {
          if (test.for_real_volumes || subject.prepared.scene.volume.phantom)
            measure(bench, subject, test, table, worst);
        }
        subject.prepared = {}; // large volumes are not kept
      }
    }
    if (transparent) {
      bar("slices against rays, largest share of values over 1e-3", percent(worst.share), "≤ 0.1 %",
          worst.share <= 1e-3);
      bar("each against the reference, smallest PSNR", decibel(worst.psnr) + " dB", "≥ 60 dB",
          worst.psnr >= 60);
    } else {
      std::cout << "Largest share here " << percent(worst.share) << ", smallest PSNR against the reference "
                << decibel(worst.psnr) << " dB.\n";
    }
    std::cout << std::endl;
  }
}

} // namespace slicelens::accuracy
