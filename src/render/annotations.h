// What a picture needs to be read: a legend of the transfer function, a scale bar and orientation labels.
#pragma once

#include "image/annotations.h"
#include "image/image.h"
#include "render/prepare.h"

#include <string>
#include <vector>

namespace slicelens {

/// The letters of a direction in world space (LPS): L and R for ±x to the patient's left and right, P and A
/// for ±y to the back and the front, S and I for ±z to the head and the feet; the axis it is nearest to
/// first, then the second nearest where the direction is at least 15° off the plane across that axis. (DICOM
/// PS3.3 C.7.6.1.1.1 orders them so; its F and H for the feet and the head are I and S here.)
std::string orientation_letters(const glm::dvec3& direction);

/// World units across one pixel: everywhere under an orthographic view, under perspective on the plane across
/// the view through the focal point (camera.focal_point, else the centre of the box of all volumes).
double pixel_size(const PreparedScene& prepared);

/// The legends of the scene's volumes: each transfer function from its first point to its last; one whose
/// points have a single value, over the data's range.
std::vector<Legend> legends_of(const PreparedScene& prepared);

/// Draws what overlay.legend, scale_bar and labels ask for. The scale bar is the longest of 1, 2 and 5·10ⁿ
/// world units that takes at most a quarter of the picture's width.
void draw_annotations(Image& image, const PreparedScene& prepared);

} // namespace slicelens
