// Section `options`: what each render setting costs against the default.
#include "bench.h"
#include "gl/check.h"
#include "render/rays.h"
#include "render/slices.h"
#include "scene/load.h"

#include <cstdio>
#include <memory>

namespace slicelens::bench {

namespace {

struct Variant {
  std::string name;
  std::function<void(Scene&)> change;
};

std::vector<Variant> variants() {
  using S = Scene;
  const auto perspective = [](S& s) { s.camera.projection = ProjectionName::perspective; };
  const auto shade = [](S& s, Gradient gradient) {
    s.render.shading = Shading::diffuse;
    s.render.gradient = gradient;
  };
  const auto prefilter = [=](S& s, GradientResolution resolution) {
    shade(s, Gradient::prefiltered);
    s.render.gradient_resolution = resolution;
  };
  const auto light = [=](S& s, Shading shading) {
    shade(s, Gradient::central);
    s.render.shading = shading;
  };
  return {
      {"default again", [](S&) {}},
      {"volume texture r8", [](S& s) { s.render.volume_texture = VolumeTexture::r8; }},
      {"volume texture r32f", [](S& s) { s.render.volume_texture = VolumeTexture::r32f; }},
      {"transfer texture rgba8", [](S& s) { s.render.transfer_texture = TransferTexture::rgba8; }},
      {"target rgba8", [](S& s) { s.render.target = Target::rgba8; }},
      {"target rgba16f", [](S& s) { s.render.target = Target::rgba16f; }},
      {"all three of 8 bits",
       [](S& s) {
         s.render.volume_texture = VolumeTexture::r8;
         s.render.transfer_texture = TransferTexture::rgba8;
         s.render.target = Target::rgba8;
       }},
      {"filter nearest", [](S& s) { s.render.filter = Filter::nearest; }},
      {"filter linear-exact", [](S& s) { s.render.filter = Filter::linear_exact; }},
      {"filter cubic", [](S& s) { s.render.filter = Filter::cubic; }},
      {"diffuse, forward gradient", [=](S& s) { shade(s, Gradient::forward); }},
      {"diffuse, central gradient", [=](S& s) { shade(s, Gradient::central); }},
      {"diffuse, prefiltered gradient, full", [=](S& s) { prefilter(s, GradientResolution::full); }},
      {"diffuse, prefiltered gradient, half", [=](S& s) { prefilter(s, GradientResolution::half); }},
      {"diffuse, prefiltered gradient, quarter", [=](S& s) { prefilter(s, GradientResolution::quarter); }},
      {"diffuse, precomputed gradient", [=](S& s) { shade(s, Gradient::precomputed); }},
      {"phong, central gradient", [=](S& s) { light(s, Shading::phong); }},
      {"tone, central gradient", [=](S& s) { light(s, Shading::tone); }},
      {"spacing 0.5, corrected per frame", [](S& s) { s.render.spacing = 0.5; }},
      {"spacing 0.5, not corrected",
       [](S& s) {
         s.render.spacing = 0.5;
         s.render.opacity_correction = OpacityCorrection::none;
       }},
      {"perspective, corrected per fragment", perspective},
      {"perspective, corrected per frame",
       [=](S& s) {
         perspective(s);
         s.render.opacity_correction = OpacityCorrection::frame;
       }},
      {"perspective, shells",
       [=](S& s) {
         perspective(s);
         s.render.proxy = Proxy::shells;
       }},
      {"pre-integrated", [](S& s) { s.render.classification = Classification::preintegrated; }},
      {"MIP", [](S& s) { s.render.mode = Mode::mip; }},
      {"X-ray", [](S& s) { s.render.mode = Mode::xray; }},
      {"rays", [](S& s) { s.render.pipeline = Pipeline::rays; }},
      {"rays, target rgba8",
       [](S& s) {
         s.render.pipeline = Pipeline::rays;
         s.render.target = Target::rgba8;
       }},
      {"rays, stopping at opacity 0.99",
       [](S& s) {
         s.render.pipeline = Pipeline::rays;
         s.render.early_termination = 0.99;
       }},
      {"rays, perspective",
       [=](S& s) {
         s.render.pipeline = Pipeline::rays;
         perspective(s);
       }},
      {"rays, pre-integrated",
       [](S& s) {
         s.render.pipeline = Pipeline::rays;
         s.render.classification = Classification::preintegrated;
       }},
      {"rays, diffuse, central gradient",
       [=](S& s) {
         s.render.pipeline = Pipeline::rays;
         shade(s, Gradient::central);
       }},
  };
}

GLenum format_of(Target target) {
  return target == Target::rgba8 ? GL_RGBA8 : target == Target::rgba16f ? GL_RGBA16F : GL_RGBA32F;
}

/// A scene on the GPU, ready to be drawn again and again.
struct Drawable {
  GpuScene gpu;
  gl::Target target;
  std::unique_ptr<SliceRenderer> slices;
  std::unique_ptr<RayRenderer> rays;
};

Drawable make_drawable(const gl::Functions& gl, const PreparedScene& prepared) {
  Drawable made;
  made.gpu = upload(gl, prepared, {});
  made.target =
      gl::make_target(gl, prepared.view.width, prepared.view.height, format_of(prepared.scene.render.target));
  if (prepared.scene.render.pipeline == Pipeline::rays) {
    made.rays = std::make_unique<RayRenderer>(gl, prepared);
  } else {
    made.slices = std::make_unique<SliceRenderer>(gl, prepared);
    made.slices->slice(prepared);
  }
  return made;
}

void draw(Drawable& drawable, const PreparedScene& prepared) {
  if (drawable.rays)
    drawable.rays->draw(prepared, drawable.gpu, drawable.target, {});
  else
    drawable.slices->draw(prepared, drawable.gpu, drawable.target, {});
}

/// Samples that a scene takes: its fragments, or for rays those of its slice stack, whose points they meet.
double samples_of(const gl::Functions& gl, PreparedScene& prepared) {
  const RenderSettings kept = prepared.scene.render;
  prepared.scene.render.pipeline = Pipeline::slices;
  prepared.scene.render.mode = Mode::dvr; // MIP draws one more triangle
  prepare_again(prepared);
  Drawable drawable = make_drawable(gl, prepared);
  const std::uint64_t count = fragments_of(gl, [&] { draw(drawable, prepared); });
  prepared.scene.render = kept;
  prepare_again(prepared);
  return static_cast<double>(count);
}

} // namespace

void run_options(gl::Context& context, const BenchOptions& options) {
  const gl::Functions& gl = context.functions();
  Scene scene = phantom_scene(options);
  scene.camera.azimuth = 30;
  scene.camera.elevation = 20;
  const Volume volume = load_volume(scene.volume, {}, {});
  const TransferFunction transfer = transfer_of(scene, volume);
  const PreparedScene usual = prepare(scene, volume, transfer);
  PreparedScene changed = usual;
  Drawable usual_drawable = make_drawable(gl, usual);
  std::printf("\n## options: what each setting costs\n\n"
              "`head` of %zu³ voxels in %zu² pixels, azimuth 30°, elevation 20°. Each variant was drawn in "
              "turn with the default (slices, DVR, r16 and rgba32f textures, linear filter, target rgba32f, "
              "unshaded, spacing 1, orthographic), %d runs of each. The ratio is of time, variant to "
              "default: median and quartiles of neighbouring runs.\n",
              options.edge, options.picture, options.runs);
  print_heading(
      {"variant", "time / default's", "processor time / default's", "s", "10⁶ samples", "10⁶ samples/s"});
  for (const Variant& variant : variants()) {
    if (variant.name.find(options.only) == std::string::npos)
      continue;
    changed.scene = scene;
    variant.change(changed.scene);
    prepare_again(changed);
    const double samples = samples_of(gl, changed);
    Drawable drawable = make_drawable(gl, changed);
    const Turns turns = in_turn(
        gl, options.runs, [&] { draw(drawable, changed); }, [&] { draw(usual_drawable, usual); });
    const double seconds = median(turns.a);
    print_row({variant.name, spread_text(ratios(turns.a, turns.b), 2),
               fixed(ratios(turns.a_work, turns.b_work).median, 2), fixed(seconds, 3),
               fixed(samples * 1e-6, 1), fixed(samples / seconds * 1e-6, 0)});
  }
  std::printf("\nRays take the samples of the slice stack; with early termination fewer, so their rate is "
              "then the apparent one.\n");
}

} // namespace slicelens::bench
