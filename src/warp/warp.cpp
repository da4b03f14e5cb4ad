#include "warp/warp.h"

#include "core/errors.h"

#include <algorithm>

namespace slicelens {

namespace {

/// A visitor of several lambdas.
template <class... F>
struct Overloaded : F... {
  using F::operator()...;
};
template <class... F>
Overloaded(F...) -> Overloaded<F...>;

} // namespace

std::string kind_of(const Warp& warp) {
  return std::visit(Overloaded{
                        [](const LamarLens&) { return "lamar"; },
                        [](const Bifocal&) { return "bifocal"; },
                        [](const Fisheye&) { return "fisheye"; },
                        [](const VolumeLens&) { return "volume-lens"; },
                        [](const ConnectedLens&) { return "connected-lens"; },
                        [](const Shift&) { return "shift"; },
                        [](const Sine&) { return "sine"; },
                        [](const Twist&) { return "twist"; },
                        [](const Bend&) { return "bend"; },
                        [](const Pulse&) { return "pulse"; },
                        [](const Spreader&) { return "spreader"; },
                        [](const Leafer&) { return "leafer"; },
                        [](const Peeler&) { return "peeler"; },
                        [](const Expander&) { return "expander"; },
                        [](const Landmarks&) { return "landmarks"; },
                        [](const Field&) { return "field"; },
                    },
                    warp);
}

const std::vector<WarpInfo>& warp_infos() {
  static const std::vector<std::string> deformed = {"fragment", "tessellated", "grid", "rays", "reference"};
  static const std::vector<WarpInfo> infos = {
      {"lamar",
       "magnification lens with tessellated borders (LaMar, Hamann and Joy 2001)",
       {"tessellated", "fragment", "grid", "fixed-function", "rays", "reference"}},
      {"bifocal",
       "shows one box of the data in another, squeezes the rest (Cohen, Brodlie and Phillips 2008)",
       {"axis", "fragment", "tessellated", "grid", "rays", "reference"}},
      {"fisheye",
       "magnifies about a focal point, less and less towards the faces (Cohen, Brodlie and Phillips 2008)",
       {"axis", "fragment", "tessellated", "grid", "rays", "reference"}},
      {"volume-lens",
       "magnifies within a box fixed in the volume, and cuts at its faces (Cohen, Brodlie and Phillips 2008)",
       {"axis", "fragment", "tessellated", "grid", "rays", "reference"}},
      {"connected-lens",
       "the volume lens without the cut: continuous everywhere",
       {"axis", "fragment", "tessellated", "grid", "rays", "reference"}},
      {"shift", "a translation (Brunet, Nowak and Gleicher 2006)", deformed},
      {"sine", "a sine wave along one axis by another (Brunet, Nowak and Gleicher 2006)", deformed},
      {"twist", "turns the volume about an axis, more and more along it (Brunet, Nowak and Gleicher 2006)",
       deformed},
      {"bend", "bends the volume into an arc (Brunet, Nowak and Gleicher 2006)", deformed},
      {"pulse", "a fisheye in a sphere that comes and goes (Brunet, Nowak and Gleicher 2006)", deformed},
      {"spreader", "cuts the volume and opens the cut like a book (after McGuffin et al. 2003)", deformed},
      {"leafer", "cuts the volume into leaves and fans them out (after McGuffin et al. 2003)", deformed},
      {"peeler", "cuts a layer off the volume and rolls it up (after McGuffin et al. 2003)", deformed},
      {"expander", "pushes the volume open into an empty ball (after McGuffin et al. 2003)", deformed},
      {"landmarks",
       "carries points of the data to given ones, by a spline between (Brunet, Nowak and Gleicher 2006)",
       {"fragment", "grid", "rays", "reference"}},
      {"field",
       "a displacement field read from a file, either way round (Brunet, Nowak and Gleicher 2006)",
       {"fragment", "grid", "rays", "reference"}},
  };
  return infos;
}

const WarpInfo& info_of(const Warp& warp) {
  for (const WarpInfo& info : warp_infos()) {
    if (info.kind == kind_of(warp))
      return info;
  }
  throw Error("warp '" + kind_of(warp) + "' is missing in the list of warps");
}

std::optional<Warp> make_warp(const std::string& kind) {
  for (const Warp& warp : std::vector<Warp>{LamarLens{}, Bifocal{}, Fisheye{}, VolumeLens{}, ConnectedLens{},
                                            Shift{}, Sine{}, Twist{}, Bend{}, Pulse{}, Spreader{}, Leafer{},
                                            Peeler{}, Expander{}, Landmarks{}, Field{}}) {
    if (kind_of(warp) == kind)
      return warp;
  }
  return std::nullopt;
}

void validate(const Warp& warp) {
  std::visit([](const auto& value) { validate(value); }, warp);
}

bool is_separable(const Warp& warp) {
  return std::holds_alternative<Bifocal>(warp) || std::holds_alternative<Fisheye>(warp) ||
         std::holds_alternative<VolumeLens>(warp) || std::holds_alternative<ConnectedLens>(warp);
}

bool has_bounded_support(const Warp& warp) {
  return is_separable(warp) || std::holds_alternative<LamarLens>(warp) ||
         std::holds_alternative<Pulse>(warp) || std::holds_alternative<Expander>(warp);
}

std::optional<AxisRanges> focus_region(const Warp& warp) {
  using Result = std::optional<AxisRanges>;
  return std::visit(
      Overloaded{
          [](const Bifocal& bifocal) { return Result(bifocal.shown); },
          [](const Fisheye& fisheye) { return Result(ranges_of(fisheye.center, fisheye.center)); },
          [](const VolumeLens& lens) { return Result(focus_of(lens.box)); },
          [](const ConnectedLens& lens) { return Result(focus_of(lens.box)); },
          [](const auto&) { return Result(); },
      },
      warp);
}

std::optional<AxisRanges> focus_region(const std::vector<Warp>& warps) {
  std::optional<AxisRanges> region;
  for (const Warp& warp : warps) {
    if (const auto own = focus_region(warp))
      region = own;
  }
  return region;
}

WarpMap map_of(const Warp& warp, const BoxSpace& space, const WarpView& view) {
  return std::visit(
      Overloaded{
          [&](const LamarLens& lens) -> WarpMap { return lamar_map(lens, space, view); },
          [&](const Bifocal& bifocal) -> WarpMap { return bifocal_map(bifocal, space); },
          [&](const Fisheye& fisheye) -> WarpMap { return fisheye_map(fisheye, space); },
          [&](const VolumeLens& lens) -> WarpMap { return volume_lens_map(lens.box, space); },
          [&](const ConnectedLens& lens) -> WarpMap { return connected_lens_map(lens.box, space); },
          [&](const Shift& shift) -> WarpMap { return shift_map(shift); },
          [&](const Sine& sine) -> WarpMap { return sine_map(sine); },
          [&](const Twist& twist) -> WarpMap { return twist_map(twist, space); },
          [&](const Bend& bend) -> WarpMap { return bend_map(bend, space); },
          [&](const Pulse& pulse) -> WarpMap { return pulse_map(pulse, space); },
          [&](const Spreader& spreader) -> WarpMap { return spreader_map(spreader, space); },
          [&](const Leafer& leafer) -> WarpMap { return leafer_map(leafer, space); },
          [&](const Peeler& peeler) -> WarpMap { return peeler_map(peeler, space); },
          [&](const Expander& expander) -> WarpMap { return expander_map(expander, space); },
          [&](const Landmarks& landmarks) -> WarpMap { return landmark_map(landmarks, space); },
          [&](const Field& field) -> WarpMap { return field_map(field, space); },
      },
      warp);
}

glm::dvec3 texture_from_object(const WarpMap& map, const glm::dvec3& p) {
  return std::visit([&](const auto& value) { return texture_from_object(value, p); }, map);
}
glm::dmat3 jacobian(const WarpMap& map, const glm::dvec3& p) {
  return std::visit([&](const auto& value) { return jacobian(value, p); }, map);
}
glm::dvec3 object_from_texture(const WarpMap& map, const glm::dvec3& u) {
  return std::visit([&](const auto& value) { return object_from_texture(value, u); }, map);
}

bool has_cuts(const WarpMap& map) {
  return std::visit(
      [](const auto& value) {
        return requires { piece_of(value, glm::dvec3(0)); };
      },
      map);
}

bool near_cut(const WarpMap& map, const glm::dvec3& p, double distance) {
  return std::visit(
      [&](const auto& value) {
        if constexpr (requires { piece_of(value, p); }) {
          // A plane, or a sphere that is large beside it, within the distance has one of 26 neighbours
          // beyond.
          const int here = piece_of(value, p);
          for (int k = 0; k < 27; ++k) {
            const glm::dvec3 step(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
            if (piece_of(value, p + (1.01 * distance) * step) != here)
              return true;
          }
        }
        return false;
      },
      map);
}

bool near_cut(const std::vector<WarpMap>& maps, const glm::dvec3& p, double distance) {
  glm::dvec3 u = p;
  for (auto map = maps.rbegin(); map != maps.rend(); ++map) {
    if (near_cut(*map, u, distance))
      return true;
    // What is `distance` away here is farther away in the next map's space where this one minifies.
    const glm::dmat3 j = jacobian(*map, u);
    distance *= std::max({1.0, glm::length(j[0]) + glm::length(j[1]) + glm::length(j[2])});
    u = texture_from_object(*map, u);
  }
  return false;
}

glm::dvec3 texture_from_object(const std::vector<WarpMap>& maps, const glm::dvec3& p) {
  glm::dvec3 u = p;
  for (auto map = maps.rbegin(); map != maps.rend(); ++map)
    u = texture_from_object(*map, u);
  return u;
}

glm::dmat3 jacobian(const std::vector<WarpMap>& maps, const glm::dvec3& p) {
  glm::dmat3 total(1);
  glm::dvec3 u = p;
  for (auto map = maps.rbegin(); map != maps.rend(); ++map) {
    total = jacobian(*map, u) * total;
    u = texture_from_object(*map, u);
  }
  return total;
}

glm::dvec3 object_from_texture(const std::vector<WarpMap>& maps, const glm::dvec3& u) {
  glm::dvec3 p = u;
  for (const WarpMap& map : maps)
    p = object_from_texture(map, p);
  return p;
}

WarpGlsl glsl_of(const WarpMap& map) {
  static const std::string axis_library = "lib/axis_maps.glsl";
  static const std::string plane_library = "lib/plane_maps.glsl";
  return std::visit(
      Overloaded{
          [](const LamarMap&) -> WarpGlsl {
            return {"", "warp/lamar.glsl", "LamarMap", "lamar"};
          },
          [](const BifocalMap&) -> WarpGlsl {
            return {axis_library, "warp/bifocal.glsl", "BifocalMap", "bifocal"};
          },
          [](const FisheyeMap&) -> WarpGlsl {
            return {axis_library, "warp/fisheye.glsl", "FisheyeMap", "fisheye"};
          },
          [](const VolumeLensMap&) -> WarpGlsl {
            return {axis_library, "warp/volume_lens.glsl", "VolumeLensMap", "volume_lens"};
          },
          [](const ConnectedLensMap&) -> WarpGlsl {
            return {axis_library, "warp/connected_lens.glsl", "ConnectedLensMap", "connected_lens"};
          },
          [](const ShiftMap&) -> WarpGlsl {
            return {"", "warp/shift.glsl", "ShiftMap", "shift"};
          },
          [](const SineMap&) -> WarpGlsl {
            return {"", "warp/sine.glsl", "SineMap", "sine"};
          },
          [](const TwistMap&) -> WarpGlsl {
            return {"", "warp/twist.glsl", "TwistMap", "twist"};
          },
          [](const BendMap&) -> WarpGlsl {
            return {plane_library, "warp/bend.glsl", "BendMap", "bend"};
          },
          [](const PulseMap&) -> WarpGlsl {
            return {"", "warp/pulse.glsl", "PulseMap", "pulse"};
          },
          [](const SpreaderMap&) -> WarpGlsl {
            return {plane_library, "warp/spreader.glsl", "SpreaderMap", "spreader"};
          },
          [](const LeaferMap&) -> WarpGlsl {
            return {plane_library, "warp/leafer.glsl", "LeaferMap", "leafer"};
          },
          [](const PeelerMap&) -> WarpGlsl {
            return {plane_library, "warp/peeler.glsl", "PeelerMap", "peeler"};
          },
          [](const ExpanderMap&) -> WarpGlsl {
            return {plane_library, "warp/expander.glsl", "ExpanderMap", "expander"};
          },
          [](const GridMap&) -> WarpGlsl {
            return {"gpu/map_grid.glsl", "warp/grid.glsl", "GridMap", "grid"};
          },
      },
      map);
}

} // namespace slicelens
