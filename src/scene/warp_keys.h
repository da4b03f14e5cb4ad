// The keys of each kind of warp: the part of the one table of scene keys (scene/keys.h) that grows with a
// warp.
#pragma once

#include "warp/warp.h"

#include <type_traits>
#include <variant>

namespace slicelens {

/// What a number must satisfy.
enum class Range { any, positive, non_negative, unit };

template <class Visitor, class Settings>
void lamar_keys(Visitor& visit, Settings& s) {
  visit.key("shape", s.shape, "circle or square");
  visit.key("border", s.border, "simple, linear or cubic");
  visit.key("zoom", s.zoom, "magnification inside the inner radius", Range::positive);
  visit.key("center", s.center, "lens centre, texture coordinates");
  visit.key("inner", s.inner, "radius of the zoomed region, as a fraction of the box's longest edge",
            Range::positive);
  visit.key("outer", s.outer, "radius at which the volume is undisturbed again, likewise", Range::positive);
  visit.key("depth_inner", s.depth_inner, "half depth of the zoomed region along the view (none: inner)",
            Range::non_negative);
  visit.key("depth_outer", s.depth_outer, "half depth at which planes are undisturbed again (none: outer)",
            Range::positive);
  visit.key("angular_segments", s.angular_segments, "corners of a tessellated circle");
  visit.segments(
      "radial_segments", s.radial_segments,
      "rings of the tessellated border, or \"adaptive\": the fewest with less than half a pixel of error");
  visit.key("homogeneous", s.homogeneous,
            "false: affine texture coordinates, the wrong picture of LaMar's Figure 2(a)");
  visit.key("bounded", s.bounded, "tessellate inside the bounding square of a circle only");
}

template <class Visitor, class Settings>
void bifocal_keys(Visitor& visit, Settings& s) {
  visit.key("focus", s.focus, "[[min,max],[min,max],[min,max]] of the data, texture coordinates");
  visit.key("shown", s.shown, "[[min,max],[min,max],[min,max]] that it fills on display");
}

template <class Visitor, class Settings>
void fisheye_keys(Visitor& visit, Settings& s) {
  visit.key("center", s.center, "focal point, texture coordinates");
  visit.per_axis("distortion", s.distortion,
                 "magnification at the focal point less one; one number or one for each axis",
                 Range::non_negative);
}

template <class Visitor, class Settings>
void lens_box_keys(Visitor& visit, Settings& s) {
  visit.key("center", s.center, "lens centre, texture coordinates");
  visit.per_axis("inner", s.inner,
                 "half-width of the magnified region, texture coordinates; one number or one for each axis",
                 Range::positive);
  visit.per_axis("outer", s.outer, "half-width at which the volume is undisturbed again, likewise",
                 Range::positive);
  visit.key("magnification", s.magnification, "within the inner half-width", Range::positive);
}

template <class Visitor, class Settings>
void shift_keys(Visitor& visit, Settings& s) {
  visit.key("offset", s.offset, "of the displayed volume, fractions of the box's longest edge");
}

template <class Visitor, class Settings>
void sine_keys(Visitor& visit, Settings& s) {
  visit.key("axis", s.axis, "x, y or z: points move along it");
  visit.key("along", s.along, "x, y or z: by a sine of their place along this one");
  visit.key("amplitude", s.amplitude, "as a fraction of the box's longest edge");
  visit.key("wavelength", s.wavelength, "likewise", Range::positive);
  visit.key("phase", s.phase, "degrees");
}

template <class Visitor, class Settings>
void twist_keys(Visitor& visit, Settings& s) {
  visit.key("axis", s.axis, "x, y or z: turned about it");
  visit.key("center", s.center, "a point of the axis where nothing turns, texture coordinates");
  visit.key("angle", s.angle, "degrees over the box's length along the axis");
}

template <class Visitor, class Settings>
void bend_keys(Visitor& visit, Settings& s) {
  visit.key("axis", s.axis, "x, y or z: the piece that becomes an arc lies along it");
  visit.key("toward", s.toward, "x, y, z, -x, -y or -z: where its ends go");
  visit.key("center", s.center, "middle of the arc, texture coordinates");
  visit.key("angle", s.angle, "of the arc, degrees; a piece as long as the box; straight on beyond it");
}

template <class Visitor, class Settings>
void pulse_keys(Visitor& visit, Settings& s) {
  visit.key("center", s.center, "texture coordinates");
  visit.key("radius", s.radius, "of the sphere of influence, as a fraction of the box's longest edge",
            Range::positive);
  visit.key("magnification", s.magnification, "at the centre, at the height of the pulse", Range::positive);
  visit.key("phase", s.phase, "of the pulse: 0 and 1 none, 1/2 its height", Range::unit);
}

template <class Visitor, class Settings>
void spreader_keys(Visitor& visit, Settings& s) {
  visit.key("axis", s.axis, "x, y or z: across the cut");
  visit.key("toward", s.toward, "x, y, z, -x, -y or -z: from the hinge out of the cut");
  visit.key("center", s.center, "a point of the hinge, texture coordinates");
  visit.key("angle", s.angle, "of the opened wedge, degrees");
  visit.key("gap", s.gap, "by which both sides are pushed apart, as a fraction of the box's longest edge",
            Range::non_negative);
}

template <class Visitor, class Settings>
void leafer_keys(Visitor& visit, Settings& s) {
  visit.key("axis", s.axis, "x, y, z, -x, -y or -z: through the stack of leaves; the first one stays");
  visit.key("toward", s.toward,
            "x, y, z, -x, -y or -z: from the spine, an edge of the box, across the leaves");
  visit.key("leaves", s.leaves, "how many, 2 to 64");
  visit.key("angle", s.angle, "between the first and the last leaf, degrees");
}

template <class Visitor, class Settings>
void peeler_keys(Visitor& visit, Settings& s) {
  visit.key("axis", s.axis, "x, y, z, -x, -y or -z: along the layer, from the centre on");
  visit.key("toward", s.toward, "x, y, z, -x, -y or -z: out of the layer, from the centre to the surface");
  visit.key("center", s.center, "where the layer begins, texture coordinates");
  visit.key("radius", s.radius,
            "of the roll, as a fraction of the box's longest edge; larger than the layer is thick",
            Range::positive);
  visit.key("angle", s.angle, "of the roll, degrees; straight on after it");
}

template <class Visitor, class Settings>
void expander_keys(Visitor& visit, Settings& s) {
  visit.key("center", s.center, "texture coordinates");
  visit.key("opening", s.opening, "radius of the empty ball, as a fraction of the box's longest edge",
            Range::non_negative);
  visit.key("radius", s.radius, "beyond which nothing moves, likewise", Range::positive);
}

template <class Visitor, class Settings>
void landmark_keys(Visitor& visit, Settings& s) {
  visit.key(
      "file", s.file,
      "pairs of points: .json [[[sx,sy,sz],[tx,ty,tz]], …] or .csv sx,sy,sz,tx,ty,tz; source in the data, "
      "target where it is shown");
  visit.key("source", s.source, "list of source points: .json, .csv, 3D Slicer's .fcsv or .mrk.json");
  visit.key("target", s.target, "list of target points in the same order, likewise; excludes file");
  visit.key("pairs", s.pairs, "[[[sx,sy,sz],[tx,ty,tz]], …] in the scene itself; excludes file");
  visit.key("space", s.space, "of the points: world (LPS, the data's unit) or texture (coordinates)");
  visit.key("method", s.method, "tps (thin-plate spline) or bspline (multilevel B-spline)");
  visit.key("stiffness", s.stiffness,
            "tps: 0 hits every landmark, more bends less; a fraction of the longest edge",
            Range::non_negative);
  visit.key("levels", s.levels, "bspline: levels, 1 to 8; each halves the spans of the one before");
  visit.key("resolution", s.resolution, "nodes on each axis of the grid that holds the map, 8 to 128");
}

template <class Visitor, class Settings>
void field_keys(Visitor& visit, Settings& s) {
  visit.key("file", s.file,
            "NRRD, MetaImage or NIfTI with three components a voxel: displacements in world units (LPS)");
  visit.key(
      "direction", s.direction,
      "inverse (a shown point p looks at p + D(p)) or forward (the data's point x is shown at x + D(x))");
  visit.key(
      "vectors", s.vectors,
      "axes of the file's vectors: auto (ITK's rule: RAS in NIfTI of intent 1006, else LPS), lps or ras");
  visit.key("resolution", s.resolution, "nodes on each axis of the grid that holds the map, 8 to 128");
}

/// Calls the key function of the warp's kind.
template <class Visitor, class AnyWarp>
void warp_keys(Visitor& visit, AnyWarp& warp) {
  std::visit(
      [&](auto& value) {
        using Kind = std::remove_cvref_t<decltype(value)>;
        if constexpr (std::is_same_v<Kind, LamarLens>)
          lamar_keys(visit, value);
        else if constexpr (std::is_same_v<Kind, Bifocal>)
          bifocal_keys(visit, value);
        else if constexpr (std::is_same_v<Kind, Fisheye>)
          fisheye_keys(visit, value);
        else if constexpr (std::is_same_v<Kind, Shift>)
          shift_keys(visit, value);
        else if constexpr (std::is_same_v<Kind, Sine>)
          sine_keys(visit, value);
        else if constexpr (std::is_same_v<Kind, Twist>)
          twist_keys(visit, value);
        else if constexpr (std::is_same_v<Kind, Bend>)
          bend_keys(visit, value);
        else if constexpr (std::is_same_v<Kind, Pulse>)
          pulse_keys(visit, value);
        else if constexpr (std::is_same_v<Kind, Spreader>)
          spreader_keys(visit, value);
        else if constexpr (std::is_same_v<Kind, Leafer>)
          leafer_keys(visit, value);
        else if constexpr (std::is_same_v<Kind, Peeler>)
          peeler_keys(visit, value);
        else if constexpr (std::is_same_v<Kind, Expander>)
          expander_keys(visit, value);
        else if constexpr (std::is_same_v<Kind, Landmarks>)
          landmark_keys(visit, value);
        else if constexpr (std::is_same_v<Kind, Field>)
          field_keys(visit, value);
        else
          lens_box_keys(visit, value.box);
      },
      warp);
}

} // namespace slicelens
