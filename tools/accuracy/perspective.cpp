// Perspective slices against rays, and what the per-fragment opacity correction is worth.

#include "bench.h"
#include "study/statistics.h"

#include <algorithm>
#include <array>
#include <iostream>

namespace slicelens::accuracy {

namespace {

constexpr int kPixels = 192;

Image perspective_picture(const Bench& bench, Subject& subject, double angle, double spacing,
                          Pipeline pipeline, OpacityCorrection correction = OpacityCorrection::fragment,
                          Proxy proxy = Proxy::planes) {
  return draw(bench, subject, [&](Scene& scene) {
    scene.camera.projection = ProjectionName::perspective;
    scene.camera.view_angle = angle;
    scene.render.pipeline = pipeline;
    scene.render.spacing = spacing;
    scene.render.opacity_correction = correction;
    scene.render.proxy = proxy;
  });
}

Subject head(TransferFunction (*transfer)(const Volume&)) {
  Subject subject = phantom_subject("head", 128, constant_transfer({1, 1, 1, 1}), kPixels);
  subject.prepared.transfer = transfer(subject.prepared.volume);
  return subject;
}

TransferFunction dense(const Volume& v) { return rising(v, 0.25, 0.75, 0.6); }
TransferFunction steep(const Volume& v) { return rising(v, 0.27, 0.37, 1); }
TransferFunction thin(const Volume& v) { return rising(v, 0.2, 0.7, 0.002); }

struct Function {
  const char* name;
  TransferFunction (*transfer)(const Volume&);
  double needed; ///< dB at spacing ¼
};

std::vector<Subject> subjects_for(const Bench& bench) {
  std::vector<Subject> subjects;
  subjects.push_back(head(dense));
  for (Subject& real : real_subjects(bench, kPixels)) {
    if (real.name.rfind("CT", 0) == 0)
      subjects.push_back(std::move(real));
  }
  return subjects;
}

void spacing_table(const Bench& bench) {
  const std::array<double, 4> spacings = {2, 1, 0.5, 0.25};
  const std::vector<Function> functions = {{"dense: 0 to .6 over the middle half of the range", dense, 60},
                                           {"dense, from the lowest value: 0 to .6 over the lower half",
                                            [](const Volume& v) { return rising(v, 0, 0.5, 0.6); }, 60},
                                           {"steep: 0 to 1 over a tenth of the range", steep, 35},
                                           {"thin: 0 to .002 over half the range", thin, 80}};
  std::cout << "### Against the spacing: view angle 30°, correction per fragment\n\n";
  std::vector<std::pair<std::string, std::pair<double, double>>> found;
  {
    Table table({"volume", "transfer function", "2", "1", "0.5", "0.25", "covered, 0.25",
                 "reference at .25 against .0625"});
    for (Subject& subject : subjects_for(bench)) {
      for (const Function& function : functions) {
        say("perspective: " + subject.name + ", " + function.name);
        subject.prepared.transfer = function.transfer(subject.prepared.volume);
        std::vector<std::string> cells = {subject.name, function.name};
        Difference last;
        for (const double spacing : spacings) {
          last = difference(perspective_picture(bench, subject, 30, spacing, Pipeline::slices),
                            perspective_picture(bench, subject, 30, spacing, Pipeline::rays));
          cells.push_back(decibel(last.psnr));
        }
        cells.push_back(decibel(last.psnr_covered));
        const Difference own =
            difference(perspective_picture(bench, subject, 30, 0.25, Pipeline::reference),
                       perspective_picture(bench, subject, 30, 0.0625, Pipeline::reference));
        cells.push_back(decibel(own.psnr));
        table.row(cells);
        found.push_back({subject.name + ", " + function.name, {last.psnr, function.needed}});
      }
      subject.prepared = {};
    }
  }
  for (const auto& [name, values] : found)
    bar(name, decibel(values.first) + " dB", "≥ " + fixed(values.second, 0) + " dB",
        values.first >= values.second);
  std::cout << std::endl;
}

/// A way to turn opacities per reference length into those of slices.
struct Way {
  const char* name;
  OpacityCorrection correction;
  Proxy proxy;
};

/// Planes under every correction, and shells, over the view angle.
void correction_table(const Bench& bench) {
  const std::vector<Way> ways = {
      {"uncorrected", OpacityCorrection::none, Proxy::planes},
      {"constant", OpacityCorrection::frame, Proxy::planes},
      {"per fragment", OpacityCorrection::fragment, Proxy::planes},
      {"shells", OpacityCorrection::fragment, Proxy::shells},
  };
  const std::vector<Function> functions = {{"thin", thin, 0}, {"dense", dense, 0}, {"steep", steep, 0}};
  std::cout
      << "### Over the view angle: head 128³, spacing 0.25, PSNR against rays\n\n"
         "Planes without correction of opacities for their distance (`none`: four slices for each one that "
         "the opacities are meant for), with a constant one (`frame`) and with one for every fragment; "
         "shells; last, rays against the reference, the worst of the three functions. The eye is where "
         "the box's bounding sphere fills the picture.\n\n";
  double fragment_at_60 = 0;
  double frame_at_60 = 0;
  double shells_worst = 1e9;
  {
    std::vector<std::string> heads = {"view angle"};
    for (const Function& function : functions) {
      for (const Way& way : ways)
        heads.push_back(std::string(function.name) + ": " + way.name);
    }
    heads.emplace_back("rays / reference");
    Table table(heads);
    Subject subject = head(thin);
    for (const double angle : {2.0, 10.0, 20.0, 30.0, 45.0, 60.0, 75.0, 90.0, 105.0, 120.0, 150.0}) {
      say("correction: view angle " + fixed(angle, 0));
      std::vector<std::string> cells = {fixed(angle, 0) + "°"};
      double rays_worst = 1e9;
      for (const Function& function : functions) {
        subject.prepared.transfer = function.transfer(subject.prepared.volume);
        const Image rays = perspective_picture(bench, subject, angle, 0.25, Pipeline::rays);
        rays_worst = std::min(
            rays_worst,
            difference(rays, perspective_picture(bench, subject, angle, 0.25, Pipeline::reference)).psnr);
        for (const Way& way : ways) {
          const double psnr = difference(perspective_picture(bench, subject, angle, 0.25, Pipeline::slices,
                                                             way.correction, way.proxy),
                                         rays)
                                  .psnr;
          cells.push_back(decibel(psnr));
          if (way.proxy == Proxy::shells)
            shells_worst = std::min(shells_worst, psnr);
          else if (angle == 60 && function.transfer == thin && way.correction != OpacityCorrection::none)
            (way.correction == OpacityCorrection::frame ? frame_at_60 : fragment_at_60) = psnr;
        }
      }
      cells.push_back(decibel(rays_worst));
      table.row(cells);
    }
  }
  bar("thin at 60°, per fragment", decibel(fragment_at_60) + " dB", "≥ 80 dB", fragment_at_60 >= 80);
  bar("thin at 60°, gain over constant", decibel(fragment_at_60 - frame_at_60) + " dB", "≥ 20 dB",
      fragment_at_60 - frame_at_60 >= 20);
  bar("shells, smallest PSNR", decibel(shells_worst) + " dB", "≥ 100 dB", shells_worst >= 100);
  std::cout << std::endl;
}

/// Shells take the rays' own samples.
void shells_table(const Bench& bench) {
  std::cout << "### Shells: head 128³, spacing 1, against rays\n\n"
               "`render.proxy`: what slices are. The eye is where the box's bounding sphere fills the "
               "picture. Share of the picture's values that differ by more than 1e-3, and "
               "PSNR.\n\n";
  double worst = 0;
  {
    Table table({"view angle", "planes: share", "planes: dB", "shells: share", "shells: dB",
                 "shells, shaded: share", "shells, MIP: share", "shells, X-ray: share"});
    Subject subject = head(dense);
    for (const double angle : {2.0, 10.0, 30.0, 60.0, 90.0, 120.0, 150.0}) {
      say("shells: view angle " + fixed(angle, 0));
      const auto against_rays = [&](Proxy proxy, Mode mode, Shading shading) {
        const auto picture = [&](Pipeline pipeline) {
          return draw(bench, subject, [&](Scene& scene) {
            scene.camera.projection = ProjectionName::perspective;
            scene.camera.view_angle = angle;
            scene.render.pipeline = pipeline;
            scene.render.mode = mode;
            scene.render.shading = shading;
            scene.render.proxy = pipeline == Pipeline::rays ? Proxy::planes : proxy;
          });
        };
        return difference(picture(Pipeline::slices), picture(Pipeline::rays));
      };
      const Difference planes = against_rays(Proxy::planes, Mode::dvr, Shading::none);
      const Difference shells = against_rays(Proxy::shells, Mode::dvr, Shading::none);
      const Difference shaded = against_rays(Proxy::shells, Mode::dvr, Shading::diffuse);
      const Difference mip = against_rays(Proxy::shells, Mode::mip, Shading::none);
      const Difference xray = against_rays(Proxy::shells, Mode::xray, Shading::none);
      worst = std::max({worst, shells.share, shaded.share, mip.share, xray.share});
      table.row({fixed(angle, 0) + "°", percent(planes.share), decibel(planes.psnr), percent(shells.share),
                 decibel(shells.psnr), percent(shaded.share), percent(mip.share), percent(xray.share)});
    }
  }
  bar("largest share of shells", percent(worst), "≤ 0.1 %", worst <= 1e-3);
  std::cout << std::endl;
}

/// How thin a function must be for these numbers.
void thinness_table(const Bench& bench) {
  std::cout << "### How the gain depends on the opacity: head 128³, view angle 60°, spacing 0.25\n\n";
  Table table({"top opacity", "constant", "per fragment", "gain"});
  Subject subject = head(thin);
  for (const double top : {0.0005, 0.002, 0.01, 0.05, 0.2, 0.6}) {
    subject.prepared.transfer = rising(subject.prepared.volume, 0.2, 0.7, top);
    const Image rays = perspective_picture(bench, subject, 60, 0.25, Pipeline::rays);
    const double frame =
        difference(perspective_picture(bench, subject, 60, 0.25, Pipeline::slices, OpacityCorrection::frame),
                   rays)
            .psnr;
    const double fragment =
        difference(perspective_picture(bench, subject, 60, 0.25, Pipeline::slices), rays).psnr;
    table.row({fixed(top, 4), decibel(frame), decibel(fragment), decibel(fragment - frame)});
  }
}

} // namespace

void perspective_section(const Bench& bench) {
  std::cout
      << "## Perspective: planes against shells\n\n"
         "Slices sample planes, rays sample shells around the eye, so no sample is shared; what is "
         "compared is two midpoint rules for one integral. PSNR in dB, slices against rays, "
      << kPixels
      << "² pixels, rgba32f, linear-exact. The last column of the first table is the rays' own error at "
         "spacing 0.25, which the difference of two such rules can hardly undercut.\n\n";
  spacing_table(bench);
  correction_table(bench);
  shells_table(bench);
  thinness_table(bench);
}

} // namespace slicelens::accuracy
