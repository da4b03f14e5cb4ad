// Every listed warp as the driver computes it, against double precision.
#include "catch.h"
#include "gl/check.h"
#include "gl/target.h"
#include "gl/texture.h"
#include "gl_fixture.h"
#include "render/grid_textures.h"
#include "render/shaders.h"
#include "render/warp_glsl.h"
#include "warp/warp_grid.h"
#include "warp_cases.h"

#include <random>

using namespace slicelens;

namespace {

constexpr int kEdge = 32; ///< kEdge² points a case

/// Row 0 of the target reads row 0 of the points; `column` −1: the point of the data, else a column of the
/// Jacobian.
constexpr const char* kFragment = "#include \"generated/warps.glsl\"\n"
                                  "uniform vec3 box_size;\n"
                                  "uniform sampler2D points;\n"
                                  "uniform int column;\n"
                                  "out vec4 result;\n"
                                  "void main() {\n"
                                  "  vec3 p = texelFetch(points, ivec2(gl_FragCoord.xy), 0).xyz;\n"
                                  "  vec3 value = chain_texture_from_object(p);\n"
                                  "  if (column >= 0) value = chain_jacobian(p)[column];\n"
                                  "  result = vec4(value, box_size.x);\n"
                                  "}\n";
constexpr const char* kVertex =
    "#version 330 core\n"
    "void main() {\n"
    "  vec2 p = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);\n"
    "  gl_Position = vec4(p, 0.0, 1.0);\n"
    "}\n";

/// What the driver makes of the maps at the points: [0] the points of the data, [1…3] the Jacobian's columns.
std::array<std::vector<glm::dvec3>, 4> computed(const gl::Functions& gl, const std::vector<WarpMap>& maps,
                                                const BoxSpace& space, const std::vector<glm::vec4>& points) {
  std::vector<gl::ShaderSource> stages = {{GL_VERTEX_SHADER, "points.vert", kVertex}};
  const auto fragment =
      shader_stage(GL_FRAGMENT_SHADER, "points.frag", {}, {warp_chain(maps), {"points.frag", kFragment}});
  stages.insert(stages.end(), fragment.begin(), fragment.end());
  const gl::Program program = gl::make_program(gl, stages);
  gl::TextureSpec spec;
  spec.format = GL_RGBA32F;
  spec.filter = GL_NEAREST;
  const gl::Texture texture = gl::make_texture_2d(gl, spec, {kEdge, kEdge}, std::as_bytes(std::span(points)));
  const gl::Target target = gl::make_target(gl, kEdge, kEdge, GL_RGBA32F);
  const gl::VertexArray array = gl::make_vertex_array(gl);
  gl::bind_target(gl, target);
  gl.UseProgram(program.name());
  gl.BindVertexArray(array.name());
  gl.ActiveTexture(GL_TEXTURE0);
  gl.BindTexture(GL_TEXTURE_2D, texture.name());
  set_uniform(gl, program, "points", 0);
  set_warp_maps(gl, program, maps, space);
  const std::vector<gl::Texture> grids = upload_grids(gl, maps);
  bind_grids(gl, grids);
  std::array<std::vector<glm::dvec3>, 4> results;
  for (int column = -1; column < 3; ++column) {
    set_uniform(gl, program, "column", column);
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
    const std::vector<float> pixels = gl::read_pixels(gl, target);
    std::vector<glm::dvec3>& result = results[static_cast<std::size_t>(column + 1)];
    for (int y = kEdge; y-- > 0;) { // read_pixels starts at the top, points at the bottom
      for (int x = 0; x < kEdge; ++x) {
        const float* pixel = pixels.data() + 4 * (y * kEdge + x);
        result.emplace_back(pixel[0], pixel[1], pixel[2]);
      }
    }
  }
  gl::check_errors(gl, "computing warps");
  return results;
}

double largest_entry(const glm::dmat3& m) {
  double largest = 0;
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row)
      largest = std::max(largest, std::abs(m[column][row]));
  }
  return largest;
}

/// Whether the derivative changes suddenly within 2e-4: at a crease or a jump rounding decides the side.
bool near_crease(const std::vector<WarpMap>& maps, const glm::dvec3& p) {
  const glm::dmat3 here = jacobian(maps, p);
  for (int axis = 0; axis < 3; ++axis) {
    for (const double h : {-2e-4, -2e-5, -2e-6, 2e-6, 2e-5, 2e-4}) {
      glm::dvec3 beside = p;
      beside[axis] += h;
      if (largest_entry(jacobian(maps, beside) - here) > 0.03 * largest_entry(here))
        return true;
    }
  }
  return false;
}

struct Largest {
  double map = 0;
  double jacobian = 0; ///< relative to the largest entry
  int checked = 0;
  int moved = 0;
};

/// Shaders of maps that `draw` makes, at random points each.
Largest compare(int shaders, const std::function<std::vector<WarpMap>(BoxSpace&)>& draw) {
  const gl::Context context = test_context();
  Largest largest;
  std::mt19937 engine(7);
  std::uniform_real_distribution<float> along(-0.1F, 1.1F);
  int cases = 0;
  CHECK(rc::check([&] {
    // rapidcheck draws a hundred cases of growing variety; a shader is compiled for some of them.
    const int every = 100 / shaders;
    if (++cases % every != 0)
      return;
    BoxSpace space;
    const std::vector<WarpMap> maps = draw(space);
    std::vector<glm::vec4> points;
    for (int i = 0; i < kEdge * kEdge; ++i)
      points.emplace_back(glm::vec3(space.size) * glm::vec3(along(engine), along(engine), along(engine)), 0);
    const auto results = computed(context.functions(), maps, space, points);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const glm::dvec3 p(points[i]);
      const glm::dvec3 u = texture_from_object(maps, p);
      if (near_crease(maps, p) || near_cut(maps, p, 1e-5) || warp_cases::is_nowhere(u))
        continue;
      const glm::dmat3 exact = jacobian(maps, p);
      const glm::dmat3 single(results[1][i], results[2][i], results[3][i]);
      largest.map = std::max(largest.map, glm::length(results[0][i] - u));
      largest.jacobian = std::max(largest.jacobian, largest_entry(single - exact) / largest_entry(exact));
      ++largest.checked;
      largest.moved += glm::length(u - p) > 1e-3;
    }
  }));
  return largest;
}

} // namespace

TEST_CASE("every listed warp on the GPU is the CPU's within 1e-5") {
  for (const WarpInfo& info : warp_infos()) {
    const Largest largest = compare(8, [&](BoxSpace& space) {
      const warp_cases::WarpCase c = warp_cases::random_case(info.kind);
      space = c.space;
      return std::vector<WarpMap>{c.map};
    });
    INFO(info.kind << ": map " << largest.map << ", Jacobian " << largest.jacobian << ", " << largest.checked
                   << " points, " << largest.moved << " of them moved");
    CHECK(largest.map <= 1e-5);
    // Floats: 1e-7 of a coordinate times second derivatives of some hundred.
    CHECK(largest.jacobian <= 1e-3);
    CHECK(largest.checked > 4000);
    CHECK(largest.moved > 20);
  }
}

TEST_CASE("grids of warps on the GPU are the CPU's within 1e-5, two of them in a chain as well") {
  for (const int count : {1, 2}) {
    const Largest largest = compare(8, [&](BoxSpace& space) {
      std::vector<WarpMap> maps;
      for (int i = 0; i < count; ++i) {
        space = box_space(Box{});
        // Slopes of at most 3: the second map carries the first one's rounding on.
        const double strength = lens_cases::random_in(0.5, 2);
        const WarpMap fisheye = map_of(Warp(Fisheye{glm::dvec3(0.5), glm::dvec3(strength)}), space, {});
        // At most 32 nodes along x and y: softpipe's filter reads wrong texels where a cell of a larger 3D
        // texture crosses the border of two of its 32-texel tiles (the tile beside and the next layer share a
        // cache entry).
        const std::array<std::size_t, 3> size = {static_cast<std::size_t>(*rc::gen::inRange(2, 33)), 17, 33};
        maps.emplace_back(GridMap{
            std::make_shared<const MapGrid>(make_map_grid({fisheye}, size, glm::dvec3(0), space.size))});
      }
      return maps;
    });
    INFO("map " << largest.map << ", Jacobian " << largest.jacobian << ", " << largest.checked << " points");
    CHECK(largest.map <= 1e-5);
    // Where rounding puts a point into the next cell the derivative is that cell's: near_crease lets 3 %
    // pass.
    CHECK(largest.jacobian <= 0.03);
    CHECK(largest.checked > 2000);
    CHECK(largest.moved > 20);
  }
}

TEST_CASE("a chain of all warps on the GPU is the CPU's within 1e-5") {
  const Largest largest = compare(4, [](BoxSpace& space) {
    const Box box = lens_cases::random_box();
    space = box_space(box);
    std::vector<WarpMap> maps;
    for (const WarpInfo& info : warp_infos()) {
      const bool folds = info.kind == "bend" || info.kind == "twist"; // a flat box, with the defaults
      const Warp warp =
          folds ? warp_cases::random_warp(info.kind, space) : warp_cases::default_warp(info.kind, space);
      if (has_cuts(map_of(warp, space, {})) && info.kind != "volume-lens" && info.kind != "bend")
        continue; // of a chain with all of them little would be left to compare; below they are one by one
      maps.push_back(map_of(warp, space, warp_view(lens_cases::random_view(box), box)));
    }
    return maps;
  });
  INFO("map " << largest.map << ", Jacobian " << largest.jacobian << ", " << largest.checked << " points");
  // The slopes of the maps after it, at most 4 each here, carry a map's rounding on.
  CHECK(largest.map <= 1e-5);
  CHECK(largest.jacobian <= 1e-3);
  CHECK(largest.checked > 1000);
}
