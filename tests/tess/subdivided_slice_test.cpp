// Slices in regular cells that carry a map at their corners.
#include "catch.h"
#include "lens_cases.h"
#include "slicing/slice_stack.h"
#include "tess/subdivided_slice.h"

#include <algorithm>
#include <map>

using namespace slicelens;

namespace {

const Polygon square = {{0, 0.5, 0}, {1, 0.5, 0}, {1, 0.5, 1}, {0, 0.5, 1}};

double triangle_area(const LensMesh& mesh, std::size_t i) {
  const auto at = [&](std::size_t k) { return mesh.vertices[mesh.triangles[3 * i + k]].position; };
  return glm::length(glm::cross(at(1) - at(0), at(2) - at(0))) / 2;
}

double mesh_area(const LensMesh& mesh) {
  double sum = 0;
  for (std::size_t i = 0; i < mesh.triangles.size() / 3; ++i)
    sum += triangle_area(mesh, i);
  return sum;
}

/// Mean distance between the map and what is interpolated, at the middles of triangles. The largest one would
/// be of first order where a map has a crease: in few triangles, fewer and fewer.
double mean_error(const LensMesh& mesh, const std::vector<WarpMap>& maps, const BoxSpace& space) {
  double sum = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
    glm::dvec3 position(0);
    glm::dvec3 texture(0);
    for (std::size_t k = 0; k < 3; ++k) {
      position += mesh.vertices[mesh.triangles[i + k]].position / 3.0;
      texture += glm::dvec3(mesh.vertices[mesh.triangles[i + k]].texture) / 3.0;
    }
    const glm::dvec3 exact =
        texture_from_box(space, texture_from_object(maps, box_from_texture(space, position)));
    sum += glm::length(texture - exact) * triangle_area(mesh, i / 3);
  }
  return sum / mesh_area(mesh);
}

/// The first vertex in the place of each: corners 1e-9 apart count as one, far below a pixel's sub-pixels.
std::vector<std::size_t> places_of(const LensMesh& mesh) {
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    std::size_t first = 0;
    while (first < i && glm::distance(mesh.vertices[first].position, mesh.vertices[i].position) > 1e-9)
      ++first;
    places.push_back(first);
  }
  return places;
}

} // namespace

TEST_CASE("a square slice in n cells along its edge: n² squares of two triangles with shared corners") {
  const WarpView view; // along +y, x to the right, z up
  for (const std::size_t n : {1, 2, 7, 32}) {
    const LensMesh mesh = subdivide_slice(square, {}, {}, view, n);
    CHECK(mesh.triangles.size() == 6 * n * n);
    CHECK(mesh.vertices.size() == (n + 1) * (n + 1));
    CHECK(mesh.regions.size() == 2 * n * n);
    CHECK(mesh_area(mesh) == Approx(1));
    for (const LensVertex& vertex : mesh.vertices)
      CHECK(vertex.texture == glm::dvec4(vertex.position, 1)); // without a map a corner looks at itself
  }
}

TEST_CASE("any slice is covered once, by corners that look where the map says, and without cracks") {
  CHECK(rc::check([] {
    const Box box = lens_cases::random_box();
    const View view = lens_cases::random_view(box);
    const BoxSpace space = box_space(box);
    const WarpView seen = warp_view(view, box);
    SliceRequest request;
    request.box = box;
    request.view = view;
    request.spacing = 2 * bounding_radius(box) / 4.5;
    const SliceStack stack = make_slice_stack(request);
    const std::vector<WarpMap> maps = {map_of(Twist{}, space, seen)};
    const auto cells = static_cast<std::size_t>(*rc::gen::inRange(1, 12));
    for (const Slice& slice : stack.slices) {
      const Polygon polygon(stack.corners.begin() + slice.first,
                            stack.corners.begin() + slice.first + slice.count);
      const LensMesh mesh = subdivide_slice(polygon, maps, space, seen, cells);
      RC_ASSERT(std::abs(mesh_area(mesh) - area(polygon)) <= 1e-8 * area(polygon));
      // An edge belongs to two triangles, or lies on the outline.
      std::map<std::pair<std::size_t, std::size_t>, int> edges;
      const std::vector<std::size_t> place = places_of(mesh);
      for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
        const auto at = [&](std::size_t k) { return place[mesh.triangles[i + k]]; };
        if (at(0) == at(1) || at(1) == at(2) || at(2) == at(0))
          continue; // a sliver between two corners in one place
        for (std::size_t k = 0; k < 3; ++k) {
          const std::size_t p = place[mesh.triangles[i + k]];
          const std::size_t q = place[mesh.triangles[i + (k + 1) % 3]];
          ++edges[std::minmax(p, q)];
        }
      }
      double outline = 0;
      for (const auto& [edge, count] : edges) {
        RC_ASSERT(count <= 2);
        if (count == 1)
          outline += glm::distance(mesh.vertices[edge.first].position, mesh.vertices[edge.second].position);
      }
      double expected = 0;
      for (std::size_t i = 0; i < polygon.size(); ++i)
        expected += glm::distance(polygon[i], polygon[(i + 1) % polygon.size()]);
      // A crack would be an edge of a cell or a good part of one; parts of cells below 1e-10 of their area
      // are left out.
      RC_ASSERT(std::abs(outline - expected) <= 1e-4 * expected);
      for (const LensVertex& vertex : mesh.vertices) {
        const glm::dvec3 u = texture_from_object(maps, box_from_texture(space, vertex.position));
        RC_ASSERT(vertex.texture == glm::dvec4(texture_from_box(space, u), 1));
      }
    }
  }));
}

TEST_CASE("what is interpolated comes to the map by the square of the subdivision") {
  const WarpView view;
  const BoxSpace space;
  for (const Warp& warp :
       std::vector<Warp>{Sine{Axis::x, Axis::z, 0.1, 0.5, 20}, Twist{Axis::y, glm::dvec3(0.4), 120},
                         Bend{Axis::x, Direction::z, glm::dvec3(0.5), 80}, Pulse{}}) {
    const std::vector<WarpMap> maps = {map_of(warp, space, view)};
    // Beside the middle plane of the twist, which does not turn.
    Polygon polygon = square;
    for (glm::dvec3& corner : polygon)
      corner.y = 0.6;
    const double coarse = mean_error(subdivide_slice(polygon, maps, space, view, 32), maps, space);
    const double fine = mean_error(subdivide_slice(polygon, maps, space, view, 128), maps, space);
    INFO(kind_of(warp) << ": " << coarse << ", " << fine);
    if (std::holds_alternative<Twist>(warp)) {
      CHECK(coarse < 1e-12); // across its axis a twist is a turn, which is linear
      continue;
    }
    CHECK(coarse / fine > 13); // 16 in the limit; creases a little less
    CHECK(coarse / fine < 19);
  }
}
