// Random warps of every kind, for laws that all of them keep.
#pragma once

#include "lens_cases.h"
#include "warp/warp.h"

namespace warp_cases {

using namespace slicelens;
using lens_cases::random_in;

/// A region at least .1 wide and .05 from the faces: slopes stay below 20.
inline AxisRanges random_region() {
  AxisRanges ranges;
  for (glm::dvec2& range : ranges) {
    range.x = random_in(0.05, 0.8);
    range.y = random_in(range.x + 0.1, 0.95);
  }
  return ranges;
}

/// `weakest`, `strongest`: magnification. Borders are at least a quarter of the half-width.
inline LensBox random_lens_box(double weakest, double strongest) {
  LensBox box;
  for (int a = 0; a < 3; ++a) {
    box.center[a] = random_in(0.2, 0.8);
    box.outer[a] = random_in(0.1, 1) * std::min(box.center[a], 1 - box.center[a]);
    box.inner[a] = box.outer[a] * random_in(0.05, 0.75);
  }
  box.magnification = random_in(weakest, strongest);
  return box;
}

/// Any valid warp of the kind; its defaults for a kind that is not known here.
inline Warp random_warp(const std::string& kind) {
  if (kind == "lamar")
    return lens_cases::random_lens(0.4);
  if (kind == "bifocal")
    return Bifocal{random_region(), random_region()};
  if (kind == "fisheye") {
    return Fisheye{{random_in(0.05, 0.95), random_in(0.05, 0.95), random_in(0.05, 0.95)},
                   {random_in(0, 8), random_in(0, 8), random_in(0, 8)}};
  }
  if (kind == "volume-lens")
    return VolumeLens{random_lens_box(1, 8)};
  if (kind == "connected-lens")
    return ConnectedLens{random_lens_box(1, 8)};
  return make_warp(kind).value();
}

/// A warp seen in a box from a view.
struct WarpCase {
  Warp warp;
  BoxSpace space;
  WarpMap map;
};

/// The default warp of the kind in the unit box half of the times, a random one in a random box otherwise.
inline WarpCase random_case(const std::string& kind) {
  const bool plain = lens_cases::random_bool();
  const Box box = plain ? Box{} : lens_cases::random_box();
  WarpCase c{plain ? make_warp(kind).value() : random_warp(kind), box_space(box), {}};
  validate(c.warp);
  c.map = map_of(c.warp, c.space,
                 warp_view(plain ? lens_cases::front_view() : lens_cases::random_view(box), box));
  return c;
}

/// In the box or up to a tenth of it beside it.
inline glm::dvec3 random_point(const BoxSpace& space) {
  return space.size * glm::dvec3(random_in(-0.1, 1.1), random_in(-0.1, 1.1), random_in(-0.1, 1.1));
}

} // namespace warp_cases
