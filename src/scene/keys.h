// The one table of scene keys. Reading, writing, the list of keys and the proposals in error messages all
// walk it, so a key is added in one place: a field in scene.h and a line here.
#pragma once

#include "scene/scene.h"
#include "scene/warp_keys.h"

namespace slicelens {

// Each function calls `visit.key(name, field, help)` or `visit.key(name, field, help, range)` for every key
// of its section. `visit` decides what happens: see scene_json.cpp.

template <class Visitor, class Settings>
void volume_keys(Visitor& visit, Settings& s) {
  visit.key("file", s.file, "volume file, DICOM folder or image stack; excludes phantom");
  visit.key("phantom", s.phantom, "embedded phantom (slicelens list phantoms); excludes file");
  visit.key("size", s.size, "voxels [x,y,z] of a phantom or of a headerless raw file");
  visit.key("type", s.type, "scalar type of a headerless raw file: uint8 … float64");
  visit.key("spacing", s.spacing, "voxel spacing [x,y,z] of a headerless raw file", Range::positive);
  visit.endian("endian", s.big_endian, "byte order of a headerless raw file: little or big");
  visit.key("component", s.component,
            "which component of a multi-component volume is shown, from 0 (none: RGB and RGBA of uint8 or "
            "uint16 as colours)");
  visit.key("frame", s.frame, "which frame of a 4D file is shown, from 0");
  visit.key("series", s.series, "which DICOM series of a folder (UID, or a part that only one has)");
  visit.key("labels", s.labels,
            "label volume on the same grid, for mode two-level: a file, or a phantom's name");
  visit.key(
      "access", s.access,
      "where the voxels are while they are drawn: memory, stream (read from the file as they are needed: "
      "raw, raw NRRD and MetaImage, DICOM), cache (a copy in bricks, made once) or auto (memory while "
      "render.memory holds them, else stream, else cache)");
  visit.key("cache", s.cache, "file of the copy in bricks (none: one of the user's cache folder)");
}

template <class Visitor, class Settings>
void transfer_keys(Visitor& visit, Settings& s) {
  visit.key("preset", s.preset, "named transfer function (slicelens list presets); excludes points and file");
  visit.key("points", s.points,
            "[[value, r, g, b, opacity], …], value in data units, ascending; excludes preset and file");
  visit.list("shapes", s.shapes,
             "a function of value and gradient instead: shapes whose opacities add up; excludes the others",
             [](auto& v, auto& x) {
               v.key("value", x.value,
                     "[a, b, c, d] in data units: nothing below a, rising to b, whole to c, falling to d");
               v.key("gradient", x.gradient, "the same of the gradient, data units per world unit");
               v.key("color", x.color, "[r, g, b]", Range::unit);
               v.key("opacity", x.opacity, "where the shape is whole", Range::unit);
             });
  visit.key("file", s.file,
            "transfer function of ParaView (.json, .xml), 3D Slicer (.vp, .vp.json) or ImageVis3D (.1dt); "
            "excludes preset and points");
  visit.key("map", s.map, "name of the colour map in a ParaView file that holds several");
  visit.key("range", s.range,
            "[first, last]: data values onto which the points of file are stretched (none: as the file says; "
            ".1dt: the data's range)");
  visit.key("unit_distance", s.unit_distance,
            "reference length of the opacities in world units (none: the smallest voxel spacing)",
            Range::positive);
  visit.key(
      "window", s.window,
      "width of the range of values, in data units, onto which the function is stretched from its first "
      "point to its last (none: its own)",
      Range::positive);
  visit.key("level", s.level, "the middle of that range, in data units (none: its own)");
}

template <class Visitor, class Settings>
void label_keys(Visitor& visit, Settings& s) {
  visit.key("label", s.label, "its number in volume.labels");
  visit.key("name", s.name, "for people");
  visit.key("mode", s.mode,
            "what a ray's run through it becomes: dvr, mip (its largest value) or xray (its line integral)");
  visit.option("transfer", s.transfer, "its own (none: the scene's)",
               [](auto& v, auto& x) { transfer_keys(v, x); });
  visit.key("visible", s.visible, "false: it is left out");
}

template <class Visitor, class Settings>
void placement_keys(Visitor& visit, Settings& s) {
  visit.key("align", s.align,
            "world (where its file puts it) or center (its centre on the first volume's), before the rest");
  visit.key("translate", s.translate, "[x, y, z] in world units");
  visit.key("rotate", s.rotate,
            "degrees about the world's x, then y, then z axis, through the volume's centre");
  visit.per_axis("scale", s.scale,
                 "along the volume's own axes, about its centre; one number or one for each axis",
                 Range::positive);
}

template <class Visitor, class Settings>
void layer_keys(Visitor& visit, Settings& s) {
  volume_keys(visit, s.volume);
  visit.section("transfer", s.transfer, "its own", [](auto& v, auto& x) { transfer_keys(v, x); });
  visit.warps("warp", s.warp);
  visit.section("placement", s.placement, "where it lies", [](auto& v, auto& x) { placement_keys(v, x); });
}

template <class Visitor, class Settings>
void camera_keys(Visitor& visit, Settings& s) {
  visit.key("file", s.file, "camera of ParaView (.pvcc); excludes all other keys but zoom");
  visit.key("azimuth", s.azimuth, "degrees about view up, as VTK's Azimuth");
  visit.key("elevation", s.elevation, "degrees about the horizontal axis, as VTK's Elevation");
  visit.key("roll", s.roll, "degrees about the viewing direction, as VTK's Roll");
  visit.key("zoom", s.zoom, "divides the view angle or the parallel scale", Range::positive);
  visit.key("projection", s.projection, "orthographic or perspective");
  visit.key("view_angle", s.view_angle, "vertical view angle in degrees under perspective, below 180",
            Range::positive);
  visit.key("position", s.position, "eye in world space; excludes azimuth, elevation and roll");
  visit.key("focal_point", s.focal_point, "point looked at, world space (none: the box centre)");
  visit.key("view_up", s.view_up, "direction shown upwards, world space (none: +z)");
  visit.key("parallel_scale", s.parallel_scale,
            "half the picture's height in world units, orthographic (none: half the box diagonal)",
            Range::positive);
}

template <class Visitor, class Settings>
void render_keys(Visitor& visit, Settings& s) {
  visit.key("pipeline", s.pipeline,
            "where the map is evaluated: slices (no warp), tessellated (per vertex), axis (in three 1D "
            "textures), fragment, grid (in a 3D texture), "
            "fixed-function (per vertex, without shaders), rays (GPU), or reference (CPU, double)");
  visit.key(
      "mode", s.mode,
      "dvr (emission and absorption), mip (maximum), minip (minimum), average (mean of the values), xray "
      "(line integral of the opacity), iso (the first surface of render.isovalue) or two-level (by labels; "
      "the "
      "default where volume.labels is given)");
  visit.key("isovalue", s.isovalue,
            "value of the surface of mode iso, data units (none: middle of the data's range)");
  visit.key("modulate_by_gradient", s.modulate_by_gradient,
            "gradient in data units per world unit below which opacities are lowered in proportion, so that "
            "only boundaries stay (none: opacities as they are)",
            Range::positive);
  visit.key(
      "jitter", s.jitter,
      "shifts all samples of a pixel along its ray by a random part of this many slice distances, which "
      "turns rings into noise; 0: off",
      Range::unit);
  visit.key("jitter_seed", s.jitter_seed, "of these random parts");
  visit.key("xray_scale", s.xray_scale,
            "grey shown for a line integral of one (none: one over the box diagonal)", Range::positive);
  visit.key("size", s.size, "picture [width, height] in pixels");
  visit.key("spacing", s.spacing, "slice or step distance in units of the smallest voxel spacing",
            Range::positive);
  visit.key("order", s.order, "back-to-front or front-to-back blending of slices");
  visit.key("proxy", s.proxy,
            "what slices are: planes, or shells about the eye (perspective only), whose samples are those of "
            "rays");
  visit.key("opacity_correction", s.opacity_correction,
            "fragment (for the distance along each ray), frame (for the slice distance only) or none");
  visit.key("shading", s.shading,
            "none, diffuse, phong (with white highlights) or tone (cool to warm: Gooch et al. 1998)");
  visit.key("gradient", s.gradient,
            "for shading: forward or central differences, prefiltered (central differences of a Gaussian "
            "copy) or precomputed (central differences at voxels, interpolated)");
  visit.key("gradient_space", s.gradient_space,
            "where differences are taken under a warp: data (then carried by the Jacobian) or object (of the "
            "displayed volume: Brunet 2006) (none: as the first warp's paper did)");
  visit.key("gradient_resolution", s.gradient_resolution,
            "of the Gaussian copy of gradient prefiltered: full, half or quarter");
  visit.key(
      "gradient_texture", s.gradient_texture,
      "of gradient precomputed: rgb16f, or rgba32f with the value beside it, so that a shaded sample is one "
      "fetch (16 bytes a voxel)");
  visit.key("gradient_sigma", s.gradient_sigma,
            "standard deviation of that Gaussian in voxels of the copy, 0.3 to 8", Range::positive);
  visit.key("classification", s.classification,
            "post (interpolate values, then classify), pre (classify voxels into 8-bit associated colours, "
            "then interpolate those) or preintegrated (each sample stands for a segment of its ray, "
            "classified from its two ends: Engel et al. 2001)");
  visit.key(
      "filter", s.filter,
      "nearest, linear (the driver's), linear-exact (float weights in the shader) or cubic (B-spline, which "
      "smooths; eight linear fetches)");
  visit.key(
      "footprint", s.footprint,
      "point (each sample reads one point: Brunet 2006) or mip (it reads the level of a mip pyramid that "
      "the spacing of samples in the data asks for)");
  visit.key("target", s.target, "what slices blend into: rgba8, rgba16f or rgba32f");
  visit.key("volume_texture", s.volume_texture, "texture the voxels are held in: auto, r8, r16 or r32f");
  visit.key("transfer_texture", s.transfer_texture,
            "texture the transfer function is held in: rgba8 or rgba32f");
  visit.key("tiles", s.tiles,
            "[x, y, z]: hold the volume in so many textures on each axis (slices and tessellated; the "
            "reference has no textures and ignores it)");
  visit.key(
      "levels", s.levels,
      "levels of a mip pyramid, 1 to 8: a lens' zoom region reads the finest, what is outside every lens "
      "the coarsest, a border those between; 1: full resolution everywhere. With footprint mip the most "
      "levels "
      "there may be; 1: as many as the picture needs");
  visit.key(
      "memory", s.memory,
      "MiB of textures that the volume may take; a larger one is drawn through a pool of bricks of this "
      "size (none: 1024)",
      Range::positive);
  visit.key("brick", s.brick, "voxels along the edge of such a brick, 16 to 128 in steps of 8",
            Range::positive);
  visit.key("axis_texels", s.axis_texels,
            "texels of each 1D texture of pipeline axis, 16 to 4096 (none: one for each voxel)");
  visit.key("axis_filter", s.axis_filter, "how pipeline axis reads its 1D textures: linear or nearest");
  visit.key("subdivision", s.subdivision,
            "cells along the longest edge of each slice in pipeline tessellated, 1 to 512; a list of lamar "
            "lenses has "
            "its own mesh");
  visit.per_axis("grid_size", s.grid_size,
                 "nodes of pipeline grid's 3D texture, 8 to 128; one number or one for each axis",
                 Range::positive);
  visit.key(
      "skip", s.skip,
      "samples that are left out because they cannot change the picture: none, empty (where the transfer "
      "function shows nothing) or empty+hidden (also behind opaque ones)");
  visit.key("planes_per_pass", s.planes_per_pass,
            "slices that one fragment samples before it blends, 1 to 4096; 1: one, as the papers draw");
  visit.key("early_termination", s.early_termination, "rays stop at this opacity in (0,1]; 1: never",
            Range::unit);
  visit.key("background", s.background, "[r, g, b, a] in [0,1], not associated", Range::unit);
  visit.key("context", s.context, "auto (osmesa, then egl), osmesa, egl or window");
}

template <class Visitor, class Settings>
void light_keys(Visitor& visit, Settings& s) {
  visit.key("direction", s.direction, "world vector towards the light (none: from the camera)");
  visit.key("ambient", s.ambient, "share of the colour that needs no light", Range::non_negative);
  visit.key("diffuse", s.diffuse, "share of the colour that follows Lambert's law", Range::non_negative);
  visit.key("specular", s.specular, "strength of the white highlights of shading phong", Range::non_negative);
  visit.key("power", s.power, "of those highlights: larger is sharper", Range::positive);
  visit.key("cool", s.cool, "[r, g, b] that shading tone adds to what faces away from the light",
            Range::unit);
  visit.key("warm", s.warm, "[r, g, b] that shading tone adds to what faces the light", Range::unit);
  visit.key("two_sided", s.two_sided, "light both sides of a surface (diffuse and phong)");
}

template <class Visitor, class Settings>
void clip_keys(Visitor& visit, Settings& s) {
  visit.key("point", s.point, "a point of the plane, texture coordinates");
  visit.key("normal", s.normal, "world vector; the side it points to is kept");
  visit.key("space", s.space, "texture (the data) or object (the displayed volume)");
}

template <class Visitor, class Settings>
void plane_keys(Visitor& visit, Settings& s) {
  visit.key("point", s.point, "a point of the plane, texture coordinates of the displayed volume");
  visit.key("normal", s.normal, "world vector");
  visit.key("style", s.style, "values (grey) or transfer (the transfer function's colours, opaque)");
  visit.key("range", s.range,
            "[black, white] of the grey in data units (none: the data's range); what lies below black is not "
            "drawn");
}

template <class Visitor, class Settings>
void highlight_keys(Visitor& visit, Settings& s) {
  visit.key("function", s.function,
            "off, distance (a hat that falls with slope 2 from the middle of the focus region) or focus "
            "(everything in the region)");
  visit.key("power", s.power, "of the hat: 1 linear, 2 quadratic, 3 cubic", Range::non_negative);
  visit.key("color", s.color, "[r, g, b] that is blended in", Range::unit);
  visit.key("focus", s.focus,
            "[[min,max],[min,max],[min,max]] on display, texture coordinates (none: the mapping's)");
}

template <class Visitor, class Settings>
void attenuation_keys(Visitor& visit, Settings& s) {
  visit.key("function", s.function,
            "off, distance (opacity falls to 0 towards all faces) or viewpoint (only in front of the focus "
            "region)");
  visit.key("power", s.power, "1 linear, 2 quadratic, 3 cubic", Range::non_negative);
  visit.key("focus", s.focus,
            "[[min,max],[min,max],[min,max]] on display, texture coordinates (none: the mapping's)");
}

template <class Visitor, class Settings>
void overlay_keys(Visitor& visit, Settings& s) {
  visit.key("wireframe", s.wireframe, "none, segments (of the tessellation) or triangles");
  visit.key("outline", s.outline, "inner (red) and outer (green) edge of each lens or focus region");
  visit.key("lattice", s.lattice,
            "cells along the longer edge of a lattice carried through the lens; 0: none");
  visit.key("magnification", s.magnification, "opacity of false colours of the local magnification",
            Range::unit);
  visit.key("line_width", s.line_width, "pixels", Range::positive);
}

template <class Visitor, class Settings>
void scene_overlay_keys(Visitor& visit, Settings& s) {
  overlay_keys(visit, s);
  visit.key("stack", s.stack,
            "degrees the camera goes aside to show the slices themselves (LaMar's Figure 7); 0: the volume");
  visit.key("landmarks", s.landmarks,
            "radius in pixels of circles around landmarks: red sources, blue targets; 0: none",
            Range::non_negative);
  visit.key("legend", s.legend, "the transfer function's colours and opacities beside their values");
  visit.key("scale_bar", s.scale_bar,
            "a round length; under perspective on the plane through the focal point, and it says so");
  visit.key(
      "labels", s.labels,
      "letters at the edges: where left, posterior, superior (L, P, S: +x, +y, +z) and right, anterior, "
      "inferior (R, A, I) lie");
  visit.key("unit", s.unit, "behind the scale bar's length (none: mm for DICOM and NIfTI, else nothing)");
}

template <class Visitor, class Settings>
void scene_keys(Visitor& visit, Settings& s) {
  visit.key("title", s.title, "shown in galleries and reports");
  visit.section("volume", s.volume, "what is rendered", [](auto& v, auto& x) { volume_keys(v, x); });
  visit.section("transfer", s.transfer, "colour and opacity of each value",
                [](auto& v, auto& x) { transfer_keys(v, x); });
  visit.section("camera", s.camera, "where it is seen from", [](auto& v, auto& x) { camera_keys(v, x); });
  visit.section("render", s.render, "how it is sampled and composited",
                [](auto& v, auto& x) { render_keys(v, x); });
  visit.section("light", s.light, "for shading", [](auto& v, auto& x) { light_keys(v, x); });
  visit.warps("warp", s.warp);
  visit.section("highlight", s.highlight, "colour blended into a focus region (Cohen et al. 2008)",
                [](auto& v, auto& x) { highlight_keys(v, x); });
  visit.section("attenuation", s.attenuation, "opacity lowered outside a focus region (Cohen et al. 2008)",
                [](auto& v, auto& x) { attenuation_keys(v, x); });
  visit.section("pick", s.pick, "what slicelens pick takes for a surface", [](auto& v, auto& x) {
    v.key(
        "gradient", x.gradient,
        "gradient in data units per world unit that counts as large (none: a tenth of the data's range over "
        "the smallest voxel spacing)",
        Range::positive);
  });
  visit.section("overlay", s.overlay, "what is drawn over it",
                [](auto& v, auto& x) { scene_overlay_keys(v, x); });
  visit.list("planes", s.planes, "cutting planes that show the displayed volume, opaque",
             [](auto& v, auto& x) { plane_keys(v, x); });
  visit.list("clip", s.clip, "clipping planes", [](auto& v, auto& x) { clip_keys(v, x); });
  visit.option("crop", s.crop, "a box of the volume that is kept", [](auto& v, auto& x) {
    v.key("low", x.low, "its lowest corner, texture coordinates");
    v.key("high", x.high, "its highest corner");
    v.key("space", x.space, "texture (the data) or object (the displayed volume)");
  });
  visit.volumes(
      "volumes", s,
      "instead of volume, transfer and warp: a list of up to 4 volumes, each with the keys of volume "
      "and a transfer, a warp and a placement of its own",
      [](auto& v, auto& x) { layer_keys(v, x); });
  visit.list("labels", s.labels,
             "how each label of volume.labels is shown; others as the scene's own transfer function says",
             [](auto& v, auto& x) { label_keys(v, x); });
  visit.key(
      "combine", s.combine,
      "how the samples of several volumes become one: mix (side by side in the same place), sum (of the "
      "opacities), max (the most opaque one) or difference (of the first and the others)");
}

} // namespace slicelens
