// Overlays of a volume's picture: the lens as lines and false colours, and the slice stack from the side
// (LaMar 2001, Figure 7).
#pragma once

#include "image/image.h"
#include "render/prepare.h"

namespace slicelens {

/// Draws what the scene's section `overlay` asks for over the finished picture. Outline, wireframe, lattice
/// and magnification of LaMar's lenses are those of the plane through each lens' centre, across the view.
/// Other warps: see render/warp_overlay.h; with both, lattice and magnification are the lenses'. With a
/// magnification the picture grows by a colour bar. Legend, scale bar and labels lie over all else
/// (render/annotations.h). Does nothing by default.
void draw_overlays(Image& image, const PreparedScene& prepared);

/// The slices' polygons seen by a camera that went `overlay.stack` degrees aside: planes that meet no lens
/// green, those that meet its border region in depth blue, those in its zoom region red; the volume's box
/// grey, on the scene's background.
Image draw_stack_from_the_side(const PreparedScene& prepared);

} // namespace slicelens
