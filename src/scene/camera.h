// From a scene's camera keys to the view that renderers use.
#pragma once

#include "core/view.h"
#include "scene/scene.h"

namespace slicelens {

/// The view of `camera` on `box` for a picture of width × height pixels (docs/spaces.md).
/// Default: looks along +y at the box centre with +z up, orthographic with parallel scale = half the box
/// diagonal; azimuth, elevation and roll turn the whole frame about the focal point as VTK's calls of the
/// same name do, in this order. Perspective: the eye stands at bounding radius / sin(view_angle/2) from the
/// focal point; zoom divides the view angle or the parallel scale. Throws UsageError when position, focal
/// point and view up span no frame.
View make_view(const CameraSettings& camera, const Box& box, int width, int height);

} // namespace slicelens
