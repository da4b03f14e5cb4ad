// A scene written out for other renderers: what there is to draw as numbers, and the voxels.
#pragma once

#include "render/prepare.h"

#include <filesystem>
#include <string>

namespace slicelens {

/// Throws UsageError naming the first key that asks for what only Slicelens draws: warps, several volumes,
/// labels, clipping, highlight and attenuation, planes and overlays, two-dimensional transfer functions and
/// the like. Modes, shadings and filters are written as words; whoever reads them refuses what it lacks.
void require_exportable(const Scene& scene);

/// Writes `folder`/volume.raw (the voxels, i fastest, then j, then k, in the machine's byte order, which
/// scene.json names) and `folder`/scene.json (docs/vtk.md lists its keys). The folder is made where there is
/// none; its own parent must exist. Both files appear together when they are complete; on failure old ones
/// stay as they were. Throws UsageError as require_exportable does, and for a volume of colours; FileError
/// where something cannot be written in full.
void write_export(const PreparedScene& prepared, const std::filesystem::path& folder);

/// The section `camera` of scene.json, as one line: VTK's terms, world space, degrees.
std::string exported_camera(const PreparedScene& prepared);

} // namespace slicelens
