// Several volumes in one program (Brunet, Nowak and Gleicher 2006 §4.3): each has the declarations of a
// single one under names of its own, and their samples are combined where they are taken.
#pragma once

#include "core/embedded.h"
#include "gl/program.h"
#include "render/gpu_scene.h"

#include <string>
#include <vector>

namespace slicelens {

/// The files that the shaders include and the host writes: "generated/warps.glsl", the chain of the scene's
/// warps, and with several volumes "generated/volumes.glsl", which has all_samples (a sample of all volumes,
/// from the first one's texture coordinates), all_units and color_of_units (MIP: a channel for each volume).
std::vector<EmbeddedFile> generated_files(const PreparedScene& prepared);

/// "VOLUMES n" and "COMBINE k" for several volumes, nothing for one.
std::vector<std::string> volume_macros(const PreparedScene& prepared);

/// Sets what "generated/volumes.glsl" declares and binds the textures. The program must be in use. Throws
/// LimitError where the driver has too few texture units.
void set_volumes(const gl::Functions& gl, const gl::Program& program, const PreparedScene& prepared,
                 const GpuScene& scene);

/// Length that the opacities of volume `index` are for, as a share of the first one's: opacities are brought
/// to the first one's before they are combined. 1 without opacity correction.
double length_ratio(const PreparedScene& prepared, std::size_t index);

/// MIP: unit = x · value + y, from 1/255 at the smallest value to 1 at the largest; 0 stands for no value.
/// For `minip` the other way round.
glm::dvec2 several_unit_from_value(const PreparedScene& prepared);

} // namespace slicelens
