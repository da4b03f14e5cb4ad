// The GLSL of a list of warps: each warp's own functions, its numbers as a uniform, and their chain.
#pragma once

#include "core/embedded.h"
#include "gl/program.h"
#include "warp/warp.h"

#include <string>
#include <vector>

namespace slicelens {

/// The file "generated/warps.glsl" that shaders/gpu/warp.glsl includes: chain_texture_from_object and
/// chain_jacobian in box space, u = u_1 ∘ … ∘ u_n, and chain_magnification where all warps are LaMar's lens.
EmbeddedFile warp_chain(const std::vector<WarpMap>& maps);

/// Its parts: the files that declare the maps, each once, and the uniforms and functions, where an empty list
/// is the identity.
std::string warp_includes(const std::vector<WarpMap>& maps);
std::string warp_chain_functions(const std::vector<WarpMap>& maps);

/// Grids that a list of warps may hold: units of every driver.
inline constexpr std::size_t max_grids = 4;

/// Texture units of the grids of displacements among the maps (render/grid_textures.h), in their order: those
/// of Cohen's tables, which are never read beside a grid.
inline const std::vector<GLenum> grid_units = {12, 13, 14, 15};

/// Sets the uniforms that warp_chain declares, and `box_size`. The program must be in use.
void set_warp_maps(const gl::Functions& gl, const gl::Uniforms& program, const std::vector<WarpMap>& maps,
                   const BoxSpace& space, const std::vector<GLenum>& units = grid_units);

/// Sets the fields of the uniform struct `name`.
template <class Map>
void set_struct(const gl::Functions& gl, const gl::Uniforms& program, const std::string& name,
                const Map& map) {
  visit_fields(map, [&](const char* field, const auto& value) {
    using Value = std::remove_cvref_t<decltype(value)>;
    const std::string full = name + "." + field;
    if constexpr (std::is_same_v<Value, glm::dvec3>)
      set_uniform(gl, program, full.c_str(), glm::vec3(value));
    else if constexpr (std::is_same_v<Value, double>)
      set_uniform(gl, program, full.c_str(), static_cast<float>(value));
    else
      set_uniform(gl, program, full.c_str(), static_cast<int>(value));
  });
}

} // namespace slicelens
