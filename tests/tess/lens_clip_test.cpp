#include "catch.h"
#include "mesh_checks.h"
#include "tess/homogeneous.h"

using namespace mesh_checks;

namespace {

double random_depth(const LensCase& c) { return random_in(-1, 1) * depth_outer(c.lens); }

Plane random_plane() {
  const glm::dvec3 normal = random_direction();
  return {normal,
          glm::dot(normal, glm::dvec3(random_in(0.2, 0.8), random_in(0.2, 0.8), random_in(0.2, 0.8)))};
}

Plane opposite(const Plane& plane) { return {-plane.normal, -plane.offset}; }

double polygon_area(const LensPolygon& polygon) {
  Polygon positions;
  for (const LensVertex& vertex : polygon)
    positions.push_back(vertex.position);
  return area(positions);
}

LensPolygon in_tile(LensPolygon polygon, const glm::dvec3& low, const glm::dvec3& high) {
  for (const TextureHalfSpace& face : faces_of(low, high))
    polygon = clip(polygon, face);
  return polygon;
}

} // namespace

TEST_CASE("clipping in homogeneous coordinates, by hand") {
  // s runs from 0 with weight 1 to 1 with weight 4 over x from 0 to 1: s(x) = 4x/(1 + 3x), which is 1/2 at x
  // = 1/5.
  const LensPolygon quad = {{{0, 0, 0}, {0, 0, 0, 1}},
                            {{1, 0, 0}, {4, 0, 0, 4}},
                            {{1, 1, 0}, {4, 4, 0, 4}},
                            {{0, 1, 0}, {0, 1, 0, 1}}};
  const LensPolygon left = clip(quad, homogeneous({{-1, 0, 0}, -0.5}));
  const LensPolygon right = clip(quad, homogeneous({{1, 0, 0}, 0.5}));
  REQUIRE(left.size() == 4);
  CHECK(polygon_area(left) == Approx(0.2).epsilon(1e-14));
  CHECK(polygon_area(right) == Approx(0.8).epsilon(1e-14));
  CHECK(clip(quad, homogeneous({{1, 0, 0}, 1.5})).empty());
  CHECK(clip(quad, homogeneous({{1, 0, 0}, -1})).size() == 4);
  // A plane that only touches leaves nothing, and none of the corners twice.
  CHECK(clip(quad, homogeneous({{-1, 0, 0}, 0})).empty());
  CHECK(clip(quad, homogeneous({{1, 0, 0}, 0})).size() == 4);
  CHECK(clip_position(quad, {{1, 1, 0}, 2}).empty());        // the corner (1, 1)
  CHECK(clip_position(quad, {{-1, -1, 0}, -1}).size() == 3); // the diagonal through two corners
}

TEST_CASE("faces of a tile: a·q ≤ S ≤ b·q on each axis") {
  const auto faces = faces_of({0.1, 0.2, 0.3}, {0.5, 0.6, 0.7});
  REQUIRE(faces.size() == 6);
  const auto inside = [&](const glm::dvec3& t, double q) {
    return std::all_of(faces.begin(), faces.end(), [&](const TextureHalfSpace& face) {
      return glm::dot(face.coefficients, glm::dvec4(t * q, q)) >= 0;
    });
  };
  for (const double q : {0.5, 1.0, 4.0}) {
    CHECK(inside({0.3, 0.4, 0.5}, q));
    for (int axis = 0; axis < 3; ++axis) {
      glm::dvec3 t(0.3, 0.4, 0.5);
      t[axis] += 0.21;
      CHECK_FALSE(inside(t, q));
      t[axis] -= 0.42;
      CHECK_FALSE(inside(t, q));
    }
  }
}

TEST_CASE("a cut edge gives the same corner, to the last bit, from both sides") {
  CHECK(rc::check([] {
    const auto random_vertex = [] {
      const double q = random_in(0.5, 8);
      return LensVertex{{random_in(0, 1), random_in(0, 1), random_in(0, 1)},
                        glm::dvec4(random_in(0, 1), random_in(0, 1), random_in(0, 1), 1) * q};
    };
    const LensVertex a = random_vertex();
    const LensVertex b = random_vertex();
    const TextureHalfSpace face = homogeneous(random_plane());
    const LensPolygon one = clip(LensPolygon{a, b, random_vertex()}, face);
    const LensPolygon other = clip(LensPolygon{b, a, random_vertex()}, face);
    const bool cut =
        (glm::dot(face.coefficients, a.texture) >= 0) != (glm::dot(face.coefficients, b.texture) >= 0);
    if (!cut)
      return;
    const auto shared = [&](const LensVertex& v) {
      return std::any_of(other.begin(), other.end(), [&](const LensVertex& w) {
        return w.position == v.position && w.texture == v.texture;
      });
    };
    RC_ASSERT(std::count_if(one.begin(), one.end(), shared) == 2); // the kept end and the new corner
  }));
}

TEST_CASE("clipping planes: every corner kept satisfies them, and both halves make the whole") {
  CHECK(rc::check([] {
    const LensCase c = random_case(0.5);
    const double z = random_depth(c);
    const double whole = total_area(mesh_at(c, z));
    const Plane plane = random_plane();
    const LensMesh in_texture = mesh_at(c, z, {{plane}, {}});
    for (const LensVertex& v : in_texture.vertices)
      RC_ASSERT(signed_value(plane, glm::dvec3(v.texture) / v.texture.w) >= -1e-12);
    const double other_texture = total_area(mesh_at(c, z, {{opposite(plane)}, {}}));
    RC_ASSERT(std::abs(total_area(in_texture) + other_texture - whole) < 1e-9);
    const LensMesh in_object = mesh_at(c, z, {{}, {plane}});
    for (const LensVertex& v : in_object.vertices)
      RC_ASSERT(signed_value(plane, v.position) >= -1e-12);
    const double other_object = total_area(mesh_at(c, z, {{}, {opposite(plane)}}));
    RC_ASSERT(std::abs(total_area(in_object) + other_object - whole) < 1e-9);
    for (const LensMesh& mesh : {in_texture, in_object}) {
      const std::string wrong = wrong_corners(mesh);
      if (!wrong.empty())
        RC_FAIL(wrong);
    }
  }));
}

TEST_CASE("texture planes cut the data, object planes the picture") {
  // On the axis' plane, Q = 4: the data's plane s = .52 is shown at .5 + 4·.02 = .58.
  LamarLens lens;
  lens.shape = LensShape::square;
  const LensCase c = make_case(lens, Box{}, front_view());
  const auto zoom_edge = [&](const LensClip& clip) {
    const LensMesh mesh = mesh_at(c, 0, clip);
    double least = 1;
    for (std::size_t i = 0; i < mesh.regions.size(); ++i) {
      for (const LensVertex& v : corners_of(mesh, i)) {
        if (mesh.regions[i] == LensRegion::zoom)
          least = std::min(least, v.position.x);
      }
    }
    return least;
  };
  CHECK(zoom_edge({{{{1, 0, 0}, 0.52}}, {}}) == Approx(0.58).epsilon(1e-12));
  CHECK(zoom_edge({{}, {{{1, 0, 0}, 0.52}}}) == Approx(0.52).epsilon(1e-12));
}

TEST_CASE("2 × 2 × 2 tiles conserve the area, and each holds only its own data") {
  CHECK(rc::check([] {
    const LensCase c = random_case(0.5);
    const LensMesh mesh = mesh_at(c, random_depth(c));
    double sum = 0;
    for (std::size_t i = 0; i < mesh.regions.size(); ++i) {
      const auto t = corners_of(mesh, i);
      for (int tile = 0; tile < 8; ++tile) {
        const glm::dvec3 low = 0.5 * glm::dvec3(tile & 1, (tile >> 1) & 1, (tile >> 2) & 1);
        const LensPolygon part = in_tile({t.begin(), t.end()}, low, low + 0.5);
        sum += polygon_area(part);
        for (const LensVertex& v : part) {
          const glm::dvec3 at = glm::dvec3(v.texture) / v.texture.w;
          for (int axis = 0; axis < 3; ++axis)
            RC_ASSERT(at[axis] >= low[axis] - 1e-12 && at[axis] <= low[axis] + 0.5 + 1e-12);
        }
      }
    }
    RC_ASSERT(std::abs(sum - total_area(mesh)) < 1e-9);
  }));
}
