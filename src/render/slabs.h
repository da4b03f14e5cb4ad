// Slices drawn by slabs: several neighbouring planes of the stack sampled in one fragment, front to back, and
// blended once (render.planes_per_pass), where anything shows (render.skip). docs/skipping.md.
#pragma once

#include "gl/program.h"
#include "render/stack_geometry.h"

namespace slicelens {

/// Whether the stack is drawn by slabs: more than one plane a pass, or something to leave out.
bool draws_slabs(const PreparedScene& prepared);

/// Whether marks between passes can hide anything: the stack may become opaque before its end.
bool marks_hidden(const PreparedScene& prepared);

/// What each pass covers, in drawing order, one index end a pass. A vertex has its place in the picture,
/// [−1, 1]² with y up, in position.xy, and the numbers k of its pass' first and last plane in texture.xy. The
/// planes are those of make_stack_geometry; fragments find where each ends in the volume. Without skipping a
/// pass covers the convex hull of its polygons, a pixel and a half wider. Throws UsageError for a spacing
/// that is too fine.
StackGeometry make_slab_geometry(const PreparedScene& prepared);

/// Sets what shaders/slabs.frag declares beside the common and the rays' uniforms. The program must be in
/// use.
void set_slab_uniforms(const gl::Functions& gl, const gl::Program& program, const PreparedScene& prepared);

} // namespace slicelens
