#include "render/warp_glsl.h"

#include <algorithm>
#include <set>

namespace slicelens {

namespace {

std::string uniform_name(std::size_t i) { return "warp_" + std::to_string(i); }

/// A function of box space that goes through the maps from the last to the first and gathers `result`, of
/// `type`, from `function` of each map, before the point moves on.
std::string gathering_function(const std::vector<WarpMap>& maps, const std::string& type,
                               const std::string& name, const std::string& function,
                               const std::string& joined_by) {
  std::string text = type + " chain_" + name + "(vec3 b) {\n";
  if (maps.empty())
    return text + "  return " + type + "(1.0);\n}\n";
  for (std::size_t i = maps.size(); i-- > 0;) {
    const std::string prefix = glsl_of(maps[i]).prefix;
    const std::string own = prefix + function + "(" + uniform_name(i) + ", b)";
    text += i + 1 == maps.size() ? "  " + type + " result = " + own + ";\n"
                                 : "  result = " + own + joined_by + "result;\n";
    text += "  b = " + prefix + "_texture_from_object(" + uniform_name(i) + ", b);\n";
  }
  return text + "  return result;\n}\n";
}

std::string point_function(const std::vector<WarpMap>& maps) {
  std::string text = "vec3 chain_texture_from_object(vec3 b) {\n";
  for (std::size_t i = maps.size(); i-- > 0;) {
    text += "  b = " + glsl_of(maps[i]).prefix + "_texture_from_object(" + uniform_name(i) + ", b);\n";
  }
  return text + "  return b;\n}\n";
}

} // namespace

EmbeddedFile warp_chain(const std::vector<WarpMap>& maps) {
  return {"generated/warps.glsl", maps.empty() ? "" : warp_includes(maps) + warp_chain_functions(maps)};
}

std::string warp_includes(const std::vector<WarpMap>& maps) {
  std::string text;
  std::set<std::string> included;
  for (const WarpMap& map : maps) {
    const WarpGlsl glsl = glsl_of(map);
    for (const std::string& file : {glsl.library, glsl.file}) {
      if (!file.empty() && included.insert(file).second)
        text += "#include \"" + file + "\"\n";
    }
  }
  return text;
}

std::string warp_chain_functions(const std::vector<WarpMap>& maps) {
  std::string text;
  for (std::size_t i = 0; i < maps.size(); ++i)
    text += "uniform " + glsl_of(maps[i]).type + " " + uniform_name(i) + ";\n";
  text += point_function(maps);
  text += gathering_function(maps, "mat3", "jacobian", "_jacobian", " * ");
  const bool lenses = std::all_of(maps.begin(), maps.end(),
                                  [](const WarpMap& map) { return std::holds_alternative<LamarMap>(map); });
  if (lenses && !maps.empty())
    text += gathering_function(maps, "float", "magnification", "_magnification", " * ");
  return text;
}

void set_warp_maps(const gl::Functions& gl, const gl::Uniforms& program, const std::vector<WarpMap>& maps,
                   const BoxSpace& space, const std::vector<GLenum>& units) {
  set_uniform(gl, program, "box_size", glm::vec3(space.size));
  set_uniform(gl, program, "texture_from_box", glm::vec3(1.0 / space.size));
  std::size_t grid = 0;
  for (std::size_t i = 0; i < maps.size(); ++i) {
    std::visit([&](const auto& map) { set_struct(gl, program, uniform_name(i), map); }, maps[i]);
    if (std::holds_alternative<GridMap>(maps[i]))
      set_uniform(gl, program, (uniform_name(i) + ".grid").c_str(), static_cast<int>(units.at(grid++)));
  }
}

} // namespace slicelens
