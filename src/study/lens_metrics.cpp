#include "study/lens_metrics.h"

#include "core/errors.h"
#include "core/text.h"
#include "study/continuity.h"
#include "warp/warp.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace slicelens {

using glm::dmat3;
using glm::dvec3;

namespace {

constexpr double cut_distance = 1e-6;
constexpr double jump_step = 1e-7;
constexpr int share_rays = 256;          // on each side of the picture, at most
constexpr double share_step = 1.0 / 256; // along a ray, box space
constexpr double magnified = 1 + 1e-6;   // above rounding in J

/// The maps, and what else is asked of them at every point.
struct Display {
  const PreparedScene* prepared;
  std::vector<WarpMap> maps;
  dvec3 low; ///< of the displayed bounds, box space
  dvec3 high;
};

Display display_of(const PreparedScene& prepared) {
  return {&prepared, drawn_maps(prepared), box_from_texture(prepared.space, prepared.object_low),
          box_from_texture(prepared.space, prepared.object_high)};
}

bool in_data(const Display& display, const dvec3& u) {
  const dvec3& size = display.prepared->space.size;
  return glm::all(glm::greaterThanEqual(u, dvec3(0))) && glm::all(glm::lessThanEqual(u, size));
}

LocalMagnification magnification_of(const dmat3& j, const WarpView& view) {
  const double area = glm::length(glm::cross(j * view.right, j * view.up));
  return {1 / std::sqrt(area), 1 / std::cbrt(std::abs(glm::determinant(j)))};
}

LocalMagnification larger(const LocalMagnification& a, const LocalMagnification& b) {
  return {std::max(a.in_view, b.in_view), std::max(a.in_volume, b.in_volume)};
}

FoldOver joined(const FoldOver& a, const FoldOver& b) {
  return {a.points + b.points, a.near_cuts + b.near_cuts, a.folded + b.folded,
          std::min(a.jacobian_min, b.jacobian_min), larger(a.largest, b.largest)};
}

/// Adds a point, if it is displayed.
void look_at(const Display& display, const dvec3& p, FoldOver& sum) {
  if (!in_data(display, texture_from_object(display.maps, p)))
    return;
  if (near_cut(display.maps, p, cut_distance)) {
    ++sum.near_cuts;
    return;
  }
  const dmat3 j = jacobian(display.maps, p);
  const double determinant = glm::determinant(j);
  ++sum.points;
  sum.folded += determinant > 0 ? 0 : 1;
  sum.jacobian_min = std::min(sum.jacobian_min, determinant);
  sum.largest = larger(sum.largest, magnification_of(j, display.prepared->warp_view));
}

/// The warp's focus as displayed by it alone: a middle, and whether a point of its display is inside.
struct Focus {
  dvec3 middle{0.5};
  std::function<bool(const dvec3&)> holds;
};

Focus focus_in(const AxisRanges& ranges, const BoxSpace& space) {
  const dvec3 low = box_from_texture(space, low_of(ranges));
  const dvec3 high = box_from_texture(space, high_of(ranges));
  return {(low + high) / 2.0, [low, high](const dvec3& p) {
            return glm::all(glm::greaterThanEqual(p, low)) && glm::all(glm::lessThanEqual(p, high));
          }};
}

/// Nothing for warps without a focus. The fisheye's is a point, so its region is what it magnifies.
std::optional<Focus> focus_of_warp(const Warp& warp, const WarpMap& map, const BoxSpace& space) {
  if (const auto* lens = std::get_if<LamarMap>(&map)) {
    return Focus{lens->center, [lens = *lens](const dvec3& p) {
                   const double depth = glm::dot(p - lens.center, lens.forward);
                   if (std::abs(depth) > lens.depth_inner)
                     return false;
                   const LensPlane plane = lens_plane(lens, depth);
                   const dvec3 offset = p - plane.axis_point;
                   const double x = std::abs(glm::dot(offset, lens.right));
                   const double y = std::abs(glm::dot(offset, lens.up));
                   const double distance = lens.square ? std::max(x, y) : std::hypot(x, y);
                   return distance <= lens.inner * plane.scale;
                 }};
  }
  if (const auto* pulse = std::get_if<PulseMap>(&map)) {
    return Focus{pulse->center,
                 [c = pulse->center, r = pulse->radius](const dvec3& p) { return glm::distance(p, c) <= r; }};
  }
  const auto ranges = focus_region(warp);
  if (!ranges)
    return std::nullopt;
  Focus focus = focus_in(*ranges, space);
  if (std::holds_alternative<FisheyeMap>(map))
    focus.holds = nullptr;
  return focus;
}

/// The focus of the last warp that has one, and the maps that come after it.
struct DisplayedFocus {
  Focus focus;
  std::vector<WarpMap> after;
};

DisplayedFocus focus_on_display(const PreparedScene& prepared) {
  const std::vector<Warp>& warps = prepared.scene.warp;
  for (std::size_t k = std::min(warps.size(), prepared.maps.size()); k-- > 0;) {
    if (const auto focus = focus_of_warp(warps[k], prepared.maps[k], prepared.space)) {
      const auto next = prepared.maps.begin() + static_cast<std::ptrdiff_t>(k) + 1;
      return {*focus, {next, prepared.maps.end()}};
    }
  }
  return {{box_from_texture(prepared.space, dvec3(0.5)), nullptr}, {}};
}

/// In box space, with unit direction.
Ray box_ray(const PreparedScene& prepared, const Ray& world) {
  const dvec3 origin(prepared.space.box_from_world * glm::dvec4(world.origin, 1));
  const dvec3 direction(prepared.space.box_from_world * glm::dvec4(world.direction, 0));
  return {origin, glm::normalize(direction)};
}

bool meets_focus(const Display& display, const DisplayedFocus& focus, const Ray& ray) {
  const dvec3 extent = display.high - display.low;
  const auto hit = intersect_unit_cube({(ray.origin - display.low) / extent, ray.direction / extent});
  if (!hit || hit->far <= 0)
    return false;
  for (double s = std::max(hit->near, 0.0) + share_step / 2; s < hit->far; s += share_step) {
    const dvec3 p = ray.origin + s * ray.direction;
    if (focus.focus.holds) {
      if (focus.focus.holds(texture_from_object(focus.after, p)) &&
          in_data(display, texture_from_object(display.maps, p)))
        return true;
    } else if (in_data(display, texture_from_object(display.maps, p)) &&
               magnification_of(jacobian(display.maps, p), display.prepared->warp_view).in_view > magnified) {
      return true;
    }
  }
  return false;
}

} // namespace

LocalMagnification local_magnification(const PreparedScene& prepared, const dvec3& p) {
  return magnification_of(jacobian(drawn_maps(prepared), p), prepared.warp_view);
}

dvec3 displayed_focus(const PreparedScene& prepared) {
  const DisplayedFocus focus = focus_on_display(prepared);
  return object_from_texture(focus.after, focus.focus.middle);
}

double FoldOver::fraction() const {
  return points == 0 ? 0 : static_cast<double>(folded) / static_cast<double>(points);
}

FoldOver fold_over(const PreparedScene& prepared, std::size_t n) {
  const Display display = display_of(prepared);
  const dvec3 cell = (display.high - display.low) / static_cast<double>(n);
  FoldOver none;
  none.jacobian_min = std::numeric_limits<double>::infinity();
  none.largest = {0, 0};
  FoldOver all = tbb::parallel_deterministic_reduce(
      tbb::blocked_range<std::size_t>(0, n * n, 16), none,
      [&](const auto& range, FoldOver sum) {
        for (std::size_t q = range.begin() * n; q != range.end() * n; ++q) {
          const dvec3 index(static_cast<double>(q % n), static_cast<double>(q / n % n),
                            static_cast<double>(q / n / n));
          look_at(display, display.low + (index + 0.5) * cell, sum);
        }
        return sum;
      },
      joined);
  look_at(display, displayed_focus(prepared), all);
  if (all.points == 0) {
    all.jacobian_min = 1;
    all.largest = {};
  }
  return all;
}

double largest_border_jump(const PreparedScene& prepared, std::size_t n) {
  const Display display = display_of(prepared);
  const TextureMap u = [&](const dvec3& p) {
    return glm::clamp(texture_from_object(display.maps, p), dvec3(0), prepared.space.size);
  };
  return largest_jump(u, {display.low, display.high}, n, jump_step).size;
}

double samples_per_voxel(const PreparedScene& prepared) {
  const dvec3 p = displayed_focus(prepared);
  const WarpView& view = prepared.warp_view;
  const dvec3 direction = view.perspective ? glm::normalize(p - view.eye) : view.forward;
  const dvec3 step =
      jacobian(drawn_maps(prepared), p) * direction * (prepared.spacing / prepared.space.longest);
  const auto& dims = prepared.volume.dims;
  const dvec3 voxels(static_cast<double>(dims[0]), static_cast<double>(dims[1]),
                     static_cast<double>(dims[2]));
  return 1 / glm::length(texture_from_box(prepared.space, step) * voxels);
}

double focus_share(const PreparedScene& prepared) {
  const Display display = display_of(prepared);
  const DisplayedFocus focus = focus_on_display(prepared);
  const View& view = prepared.view;
  const int columns = std::min(view.width, share_rays);
  const int rows = std::min(view.height, share_rays);
  const auto pixel = [](int k, int count, int pixels) {
    return std::floor((k + 0.5) * pixels / count) + 0.5; // a pixel's middle
  };
  const std::size_t met = tbb::parallel_deterministic_reduce(
      tbb::blocked_range<int>(0, rows, 4), std::size_t{0},
      [&](const auto& range, std::size_t sum) {
        for (int y = range.begin(); y != range.end(); ++y) {
          for (int x = 0; x < columns; ++x) {
            const Ray ray = ray_from_pixel(view, pixel(x, columns, view.width), pixel(y, rows, view.height));
            sum += meets_focus(display, focus, box_ray(prepared, ray)) ? 1 : 0;
          }
        }
        return sum;
      },
      std::plus<>());
  return static_cast<double>(met) / (static_cast<double>(columns) * rows);
}

const std::vector<std::string>& lens_metric_names() {
  static const std::vector<std::string> names = {"magnification",
                                                 "magnification_max",
                                                 "magnification_volume",
                                                 "magnification_volume_max",
                                                 "fold_over",
                                                 "jacobian_min",
                                                 "jump",
                                                 "samples_per_voxel",
                                                 "focus_share"};
  return names;
}

void validate_lens_metric(const std::string& name) {
  const std::vector<std::string>& known = lens_metric_names();
  if (std::find(known.begin(), known.end(), name) != known.end())
    return;
  const auto nearest = nearest_word(name, known);
  throw UsageError("there is no lens metric '" + name + "'; " +
                   (nearest ? "did you mean " + *nearest + "?" : "known: " + join(known)));
}

std::vector<std::pair<std::string, std::optional<double>>> measure_lens(const std::vector<std::string>& names,
                                                                        const PreparedScene& prepared) {
  std::for_each(names.begin(), names.end(), validate_lens_metric);
  std::optional<FoldOver> grid; // four of the metrics share it
  const auto over_grid = [&]() -> const FoldOver& {
    if (!grid)
      grid = fold_over(prepared);
    return *grid;
  };
  const auto at_focus = [&] { return local_magnification(prepared, displayed_focus(prepared)); };
  const std::vector<std::pair<std::string, std::function<double()>>> metrics = {
      {"magnification", [&] { return at_focus().in_view; }},
      {"magnification_max", [&] { return over_grid().largest.in_view; }},
      {"magnification_volume", [&] { return at_focus().in_volume; }},
      {"magnification_volume_max", [&] { return over_grid().largest.in_volume; }},
      {"fold_over", [&] { return over_grid().fraction(); }},
      {"jacobian_min", [&] { return over_grid().jacobian_min; }},
      {"jump", [&] { return largest_border_jump(prepared); }},
      {"samples_per_voxel", [&] { return samples_per_voxel(prepared); }},
      {"focus_share", [&] { return focus_share(prepared); }}};
  std::vector<std::pair<std::string, std::optional<double>>> measured;
  for (const std::string& name : names) {
    const auto metric =
        std::find_if(metrics.begin(), metrics.end(), [&](const auto& entry) { return entry.first == name; });
    const double value = metric->second();
    measured.emplace_back(name, std::isfinite(value) ? std::optional(value) : std::nullopt);
  }
  return measured;
}

} // namespace slicelens
