// Cameras of ParaView (.pvcc): position, focal point, view up, view angle, parallel scale and projection,
// with VTK's meanings, which are also those of the scene's keys.
#pragma once

#include "core/box.h"
#include "core/view.h"
#include "scene/scene.h"

#include <filesystem>
#include <string>

namespace slicelens {

/// A camera file's camera.
struct ReadCamera {
  CameraSettings camera; ///< position, focal point, view up, view angle, parallel scale, projection
  std::string ignored;   ///< names of properties that change the view and are not taken, or empty
};

/// Throws FileError for a file that cannot be read, is no camera of ParaView, lacks a property, or holds
/// numbers that make no view.
ReadCamera read_camera_file(const std::filesystem::path& path);

/// The camera with position, focal point, view up, view angle, parallel scale and projection as numbers and
/// without angles or zoom: the same view of `box`. Numbers that the camera gives itself stay exactly as they
/// are.
CameraSettings explicit_camera(const CameraSettings& camera, const Box& box);

/// Writes a camera that explicit_camera made. Throws FileError, and UsageError for a name that does not end
/// in .pvcc.
void write_camera_file(const std::filesystem::path& path, const CameraSettings& camera);

} // namespace slicelens
