#include "catch.h"
#include "core/view.h"

using namespace slicelens;

TEST_CASE("a volume's box reaches half a voxel beyond the outer centres") {
  // 4×2×1 voxels of 1×2×3 mm, first centre at (10,20,30): faces at 9.5, 19 and 28.5.
  const Box box = make_box({4, 2, 1}, {1, 2, 3}, {10, 20, 30}, glm::dmat3(1));
  const glm::dvec3 low = world_from_texture(box, glm::dvec3(0));
  const glm::dvec3 high = world_from_texture(box, glm::dvec3(1));
  CHECK(low.x == Approx(9.5));
  CHECK(low.y == Approx(19));
  CHECK(low.z == Approx(28.5));
  CHECK(high.x == Approx(13.5));
  CHECK(high.y == Approx(23));
  CHECK(high.z == Approx(31.5));
  CHECK(extent(box).y == Approx(4));
  CHECK(bounding_radius(box) == Approx(std::sqrt(16.0 + 16.0 + 9.0) / 2));
}

TEST_CASE("a ray meets the unit cube where hand calculation says") {
  const auto hit = intersect_unit_cube({{-1, 0.5, 0.5}, {2, 0, 0}});
  REQUIRE(hit);
  CHECK(hit->near == Approx(0.5));
  CHECK(hit->far == Approx(1.0));
  CHECK_FALSE(intersect_unit_cube({{-1, 1.5, 0.5}, {1, 0, 0}}));
  CHECK_FALSE(intersect_unit_cube({{-1, 0.9, 0.5}, {1, 0.2, 0}}));
}

TEST_CASE("pixel, ray and clip space agree in both projections") {
  View view;
  view.eye = {1, -5, 2};
  view.width = 80;
  view.height = 40;
  view.half_height = 0.5;
  for (const Projection projection : {Projection::orthographic, Projection::perspective}) {
    view.projection = projection;
    const Ray ray = ray_from_pixel(view, 70.5, 3.5);
    const glm::dvec3 point = ray.origin + 4.0 * ray.direction;
    const glm::dvec2 pixel = pixel_from_world(view, point);
    CHECK(pixel.x == Approx(70.5));
    CHECK(pixel.y == Approx(3.5));
    const glm::dvec4 clip = clip_from_world(view, 1, 10) * glm::dvec4(point, 1);
    CHECK((clip.x / clip.w + 1) / 2 * 80 == Approx(70.5));
    CHECK((1 - clip.y / clip.w) / 2 * 40 == Approx(3.5));
  }
  // The picture's top left corner is left of and above the centre.
  const Ray corner = ray_from_pixel(view, 0, 0);
  CHECK(glm::dot(corner.direction, view.right) < 0);
  CHECK(glm::dot(corner.direction, view.up) > 0);
}

TEST_CASE("near and far planes map to -1 and 1") {
  View view;
  for (const Projection projection : {Projection::orthographic, Projection::perspective}) {
    view.projection = projection;
    const glm::dmat4 m = clip_from_world(view, 2, 8);
    for (const auto& [z, expected] : {std::pair{2.0, -1.0}, std::pair{8.0, 1.0}}) {
      const glm::dvec4 clip = m * glm::dvec4(view.eye + z * view.forward, 1);
      CHECK(clip.z / clip.w == Approx(expected));
    }
  }
}
