// Filters on the Marschner-Lobb signal, against the signal itself.

#include "bench.h"
#include "scene/names.h"
#include "study/metrics.h"
#include "study/statistics.h"
#include "volume/closed_forms.h"
#include "volume/phantom.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>

namespace slicelens::accuracy {

namespace {

constexpr int kVoxels = 40; // the paper's own sampling
constexpr int kPixels = 192;
constexpr std::array<double, 5> kZooms = {1, 2, 4, 8, 16};
constexpr std::array<Filter, 4> kFilters = {Filter::nearest, Filter::linear, Filter::linear_exact,
                                            Filter::cubic};
/// Where all zooms look: 0.45 off the signal's axis, where its rings are 3.3 of 40 voxels apart.
const glm::dvec3 kFocus(0.7, 0.6, 0.5);
/// Share of the box that is left out along its faces: two of 40 voxels, the reach of the cubic filter.
constexpr double kMargin = 0.05;
constexpr double kIsovalue = 0.5;

bool is_inner(const glm::dvec3& t) {
  return glm::all(glm::greaterThan(t, glm::dvec3(kMargin))) &&
         glm::all(glm::lessThan(t, glm::dvec3(1 - kMargin)));
}

/// The signal of n³ voxels, seen obliquely with kFocus in the middle; at zoom 1 the picture is as high as the
/// box's edge.
Subject signal(int n, double zoom) {
  Subject subject = phantom_subject("marschner-lobb", n, constant_transfer({1, 1, 1, 0}), kPixels);
  const View view = subject.prepared.view;
  CameraSettings& camera = subject.prepared.scene.camera;
  const glm::dvec3 focus = world_from_texture(subject.prepared.box, kFocus);
  camera = {};
  camera.focal_point = focus;
  camera.position = focus - 4.0 * n * view.forward;
  camera.view_up = view.up;
  camera.parallel_scale = 0.5 * n / zoom;
  prepare_again(subject.prepared);
  return subject;
}

/// Transparent black where `truth` is.
Image masked(Image image, const Image& truth) {
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = truth.pixels[i / 4 * 4 + 3] > 0 ? image.pixels[i] : 0;
  return image;
}

void set_pixel(Image& image, int x, int y, double grey) {
  float* pixel =
      image.pixels.data() + 4 * (static_cast<std::size_t>(y) * kPixels + static_cast<std::size_t>(x));
  std::fill_n(pixel, 3, static_cast<float>(grey));
  pixel[3] = 1;
}

std::string cell(const Image& image, const Image& truth) {
  const Metrics metrics = compare_images(masked(image, truth), truth);
  return decibel(metrics.psnr_covered.value_or(std::numeric_limits<double>::infinity())) + ", " +
         fixed(metrics.ssim, 3);
}

/// A plane through kFocus across the view that shows values as grey.
void show_plane(Subject& subject) {
  PlaneSettings plane;
  plane.point = kFocus;
  plane.normal = -subject.prepared.view.forward;
  plane.range = glm::dvec2(0, 1);
  subject.prepared.scene.planes = {plane};
  prepare_again(subject.prepared);
}

/// What the plane would show of the signal itself.
Image true_plane(const PreparedScene& prepared) {
  Image image = make_image(kPixels, kPixels);
  const glm::dmat4 to_texture = texture_from_world(prepared.box);
  const glm::dvec3 focus = world_from_texture(prepared.box, kFocus);
  for (int y = 0; y < kPixels; ++y) {
    for (int x = 0; x < kPixels; ++x) {
      const Ray ray = ray_from_pixel(prepared.view, x + 0.5, y + 0.5);
      const double s = glm::dot(focus - ray.origin, ray.direction); // the plane is across the rays
      const glm::dvec3 t(to_texture * glm::dvec4(ray.origin + s * ray.direction, 1));
      if (is_inner(t))
        set_pixel(image, x, y, marschner_lobb(t));
    }
  }
  return image;
}

void plane_table(const Bench& bench) {
  std::cout << "### Values on a cut plane, " << kVoxels
            << "³ voxels\n\n"
               "A plane across the view shows the values as grey; the truth is the signal's own formula at "
               "every pixel.\n\n";
  Table table({"filter", "zoom 1", "2", "4", "8", "16"});
  for (const Filter filter : kFilters) {
    std::vector<std::string> cells = {word(filter)};
    for (const double zoom : kZooms) {
      say(std::string("filters: plane, ") + word(filter) + ", zoom " + fixed(zoom, 0));
      Subject subject = signal(kVoxels, zoom);
      show_plane(subject);
      cells.push_back(cell(draw(bench, subject, [&](Scene& scene) { scene.render.filter = filter; }),
                           true_plane(subject.prepared)));
    }
    table.row(cells);
  }
}

/// Where a ray first crosses kIsovalue in the inner box, by steps of a 16th of a voxel and halvings.
std::optional<glm::dvec3> true_surface(const Ray& in_texture, double end) {
  constexpr double step = 1.0 / 16; // world units are voxels
  const auto at = [&](double s) { return in_texture.origin + s * in_texture.direction; };
  const auto below = [&](double s) { return marschner_lobb(at(s)) < kIsovalue; };
  bool had = false;
  bool before = false;
  for (double s = 0; s < end; s += step) {
    const bool has = is_inner(at(s));
    const bool here = has && below(s);
    if (had && has && here != before) {
      double low = s - step;
      double high = s;
      for (int i = 0; i < 40; ++i) {
        const double middle = 0.5 * (low + high);
        (below(middle) == before ? low : high) = middle;
      }
      return at(high);
    }
    had = has;
    before = here;
  }
  return std::nullopt;
}

/// The surface lit by |n·l| with the signal's own normals.
Image true_picture(const PreparedScene& prepared, const glm::dvec3& light) {
  Image image = make_image(kPixels, kPixels);
  const glm::dmat4 to_texture = texture_from_world(prepared.box);
  for (int y = 0; y < kPixels; ++y) {
    for (int x = 0; x < kPixels; ++x) {
      const Ray ray = ray_from_pixel(prepared.view, x + 0.5, y + 0.5);
      const auto hit = true_surface({glm::dvec3(to_texture * glm::dvec4(ray.origin, 1)),
                                     glm::dvec3(to_texture * glm::dvec4(ray.direction, 0))},
                                    8 * extent(prepared.box).x);
      if (hit) // the box is a cube along the world's axes
        set_pixel(image, x, y, std::abs(glm::dot(glm::normalize(marschner_lobb_gradient(*hit)), light)));
    }
  }
  return image;
}

/// Beside the camera.
glm::dvec3 light_of(const View& view) {
  return glm::normalize(-view.forward + 0.5 * view.up - 0.5 * view.right);
}

Image surface_picture(const Bench& bench, Subject& subject, Filter filter) {
  const glm::dvec3 light = light_of(subject.prepared.view);
  return draw(bench, subject, [&](Scene& scene) {
    scene.render.filter = filter;
    scene.render.pipeline = Pipeline::rays;
    scene.render.mode = Mode::iso;
    scene.render.isovalue = kIsovalue;
    scene.render.spacing = 0.25;
    scene.render.shading = Shading::diffuse;
    scene.light.direction = light;
    scene.light.ambient = 0;
    scene.light.diffuse = 1;
    scene.crop = CropSettings{glm::dvec3(kMargin), glm::dvec3(1 - kMargin), ClipSpace::texture};
  });
}

void surface_table(const Bench& bench) {
  std::cout << "### The surface " << fixed(kIsovalue, 1) << ", lit\n\n"
            << "Mode iso by rays, spacing 0.25, diffuse light from beside the camera, gradients by central "
               "differences, cropped to the inner box. The truth is the first surface of the formula (steps "
               "of 1/16 voxel, then halving) under the formula's own normals. "
            << kVoxels << "³ voxels at every zoom, then more voxels at zoom 4.\n\n";
  struct Column {
    std::string head;
    int voxels;
    double zoom;
  };
  std::vector<Column> columns;
  for (const double zoom : kZooms)
    columns.push_back({(zoom == 1 ? "zoom " : "") + fixed(zoom, 0), kVoxels, zoom});
  for (const int n : {80, 160, 320})
    columns.push_back({"4, " + std::to_string(n) + "³", n, 4});
  std::vector<std::string> heads = {"filter"};
  std::vector<std::vector<std::string>> rows;
  for (const Filter filter : kFilters)
    rows.push_back({word(filter)});
  for (const Column& column : columns) {
    say("filters: surface, zoom " + column.head);
    heads.push_back(column.head);
    Subject subject = signal(column.voxels, column.zoom);
    const Image truth = true_picture(subject.prepared, light_of(subject.prepared.view));
    for (std::size_t i = 0; i < kFilters.size(); ++i)
      rows[i].push_back(cell(surface_picture(bench, subject, kFilters[i]), truth));
  }
  Table table(heads);
  for (const std::vector<std::string>& cells : rows)
    table.row(cells);
}

void refinement_table(const Bench& bench) {
  std::cout << "### Values on a cut plane under voxel refinement, zoom 4\n\nMean of |picture − formula|.\n\n";
  Table table({"filter", "40³", "80³", "160³", "320³", "order"});
  for (const Filter filter : {Filter::nearest, Filter::linear_exact, Filter::cubic}) {
    std::vector<double> widths;
    std::vector<double> errors;
    std::vector<std::string> cells = {word(filter)};
    for (const int n : {40, 80, 160, 320}) {
      say(std::string("filters: refinement, ") + word(filter) + ", " + std::to_string(n));
      Subject subject = signal(n, 4);
      show_plane(subject);
      const Image truth = true_plane(subject.prepared);
      const Image image = draw(bench, subject, [&](Scene& scene) { scene.render.filter = filter; });
      widths.push_back(1.0 / n);
      errors.push_back(compare_images(masked(image, truth), truth).mean_abs); // zoom 4: every pixel is inner
      cells.push_back(scientific(errors.back()));
    }
    cells.push_back(fixed(fitted_order(widths, errors), 2));
    table.row(cells);
  }
}

void driver_table(const Bench& bench) {
  std::cout << "### `linear`, the driver's, against `linear-exact`, on the same cut plane\n\n"
               "PSNR in dB, largest difference.\n\n";
  Table table({"texture", "zoom 1", "2", "4", "8", "16"});
  for (const VolumeTexture texture : {VolumeTexture::r8, VolumeTexture::r16, VolumeTexture::r32f}) {
    std::vector<std::string> cells = {word(texture)};
    for (const double zoom : kZooms) {
      say(std::string("filters: driver, ") + word(texture) + ", zoom " + fixed(zoom, 0));
      Subject subject = signal(kVoxels, zoom);
      show_plane(subject);
      const auto by = [&](Filter filter) {
        return draw(bench, subject, [&](Scene& scene) {
          scene.render.filter = filter;
          scene.render.volume_texture = texture;
        });
      };
      const Image exact = by(Filter::linear_exact);
      const Difference apart = difference(by(Filter::linear), exact);
      cells.push_back(decibel(apart.psnr_covered) + ", " + scientific(apart.largest));
    }
    table.row(cells);
  }
}

} // namespace

void filter_section(const Bench& bench) {
  std::cout << "## Filters on the Marschner-Lobb signal\n\n"
            << kPixels
            << "² pixels, orthographic, oblique, target rgba32f, volume texture r32f unless stated. All "
               "zooms look at (0.7, 0.6, 0.5); at zoom 1 the picture is as high as the box's edge, at 16 as "
               "2.5 voxels of 40. A twentieth of the box along its faces is left out. Cells: PSNR in dB over "
               "the pixels that the truth covers, SSIM.\n\n";
  plane_table(bench);
  refinement_table(bench);
  surface_table(bench);
  driver_table(bench);
}

} // namespace slicelens::accuracy
