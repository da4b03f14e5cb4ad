// Overlays of a volume's lens, and LaMar's Figure 7.
#include "catch.h"
#include "core/errors.h"
#include "image/colormap.h"
#include "render/scene_overlay.h"
#include "render_fixture.h"

using namespace slicelens;

namespace {

/// Seen face on: one unit of box space is 200/(2·√3/2)… the parallel scale is half the diagonal, √3/2 edges
/// for 200 pixels' half.
constexpr int size = 200;

PreparedScene
face_on(const std::string& overlay,
        const std::string& warp =
            R"({"kind":"lamar","shape":"circle","border":"linear","zoom":4,"inner":0.2,"outer":0.4})") {
  return prepare_phantom(
      R"({"volume":{"phantom":"box","size":[8,8,8]},"render":{"pipeline":"tessellated","size":[200,200]},"warp":)" +
          warp + R"(,"overlay":{)" + overlay + "}}",
      grey(0));
}

/// Pixels in one unit of box space (the box's edge).
double unit(const PreparedScene& scene) { return size * scene.space.longest / (2 * scene.view.half_height); }

bool is_color(const Image& image, double x, double y, const glm::vec3& color) {
  const int column = static_cast<int>(std::floor(x));
  const int row = static_cast<int>(std::floor(y));
  for (int c = 0; c < 3; ++c) {
    if (std::abs(channel(image, column, row, c) - color[c]) > 0.25F)
      return false;
  }
  return true;
}

} // namespace

TEST_CASE("the outline shows the inner circle red and the outer one green, at their radii") {
  const PreparedScene scene = face_on(R"("outline":true,"line_width":3)");
  Image image = make_image(size, size);
  draw_overlays(image, scene);
  const double u = unit(scene);
  for (const double angle : {0.3, 1.2, 2.9, 4.4}) {
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    CHECK(is_color(image, 100 + 0.2 * u * c, 100 - 0.2 * u * s, {1.0F, 0.1F, 0.1F}));
    CHECK(is_color(image, 100 + 0.4 * u * c, 100 - 0.4 * u * s, {0.0F, 0.75F, 0.2F}));
    CHECK(is_color(image, 100 + 0.3 * u * c, 100 - 0.3 * u * s, {0, 0, 0}));
  }
}

TEST_CASE("a lattice line of the data is shown Q times as far from the centre in the zoom region") {
  // 25 cells on an edge: lines of the data at multiples of .04 from the lens centre; the first is shown at
  // .16.
  const PreparedScene scene = face_on(R"("lattice":25,"line_width":3)");
  Image image = make_image(size, size);
  draw_overlays(image, scene);
  const glm::vec3 orange(1.0F, 0.65F, 0.0F);
  const double u = unit(scene);
  CHECK(is_color(image, 100 + 0.16 * u, 100 - 0.05 * u, orange));
  CHECK(is_color(image, 100 - 0.05 * u, 100 + 0.16 * u, orange));
  CHECK(is_color(image, 100 + 0.08 * u, 100 - 0.05 * u, {0, 0, 0})); // no line of the data at .02
}

TEST_CASE(
    "false colours show the magnification: Q in the zoom region, 1 outside, less than 1 in a linear border") {
  const PreparedScene scene = face_on(R"("magnification":1)");
  Image image = make_image(size, size);
  draw_overlays(image, scene);
  CHECK(image.height > size); // the bar
  const glm::vec3 zoomed = heat_color(1);
  CHECK(is_color(image, 100, 100, zoomed));
  CHECK(is_color(image, 110, 95, zoomed));
  const glm::vec3 outside(channel(image, 2, 2, 0), channel(image, 2, 2, 1), channel(image, 2, 2, 2));
  CHECK(glm::length(outside - zoomed) > 0.3F);
}

TEST_CASE("the stack from the side has green, blue and red planes as the depth says") {
  // Planes at ±1, ±3 … of 16 voxels (1 apart here: spacing 1 of 8 voxels, edge 1): depths (k+½)/8 of the edge
  // from the centre: the zoom region reaches .15, the border .3: |z| = 1/16 is red, 3/16 blue, 5/16 and 7/16
  // green.
  const PreparedScene scene =
      face_on(R"("stack":60)", R"({"kind":"lamar","zoom":2,"inner":0.15,"outer":0.3})");
  const Image image = draw_stack_from_the_side(scene);
  int red = 0;
  int green = 0;
  int blue = 0;
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      red += is_color(image, x, y, {1.0F, 0.2F, 0.15F}) ? 1 : 0;
      green += is_color(image, x, y, {0.1F, 0.8F, 0.2F}) ? 1 : 0;
      blue += is_color(image, x, y, {0.3F, 0.5F, 1.0F}) ? 1 : 0;
    }
  }
  CHECK(red > 100);
  CHECK(blue > 100);
  CHECK(green > 100);
  const PreparedScene away =
      face_on(R"("stack":60)", R"({"kind":"lamar","zoom":2,"inner":0.01,"outer":0.02})");
  const Image plain = draw_stack_from_the_side(away);
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x)
      CHECK_FALSE(is_color(plain, x, y, {1.0F, 0.2F, 0.15F}));
  }
}

TEST_CASE("overlays that cannot be drawn are refused") {
  CHECK_THROWS_AS(face_on(R"("stack":120)"), UsageError);
  CHECK_THROWS_AS(face_on(R"("lattice":100000)"), UsageError);
  CHECK_THROWS_AS(
      scene_from_json(
          R"({"render":{"pipeline":"rays"},"warp":{"kind":"lamar"},"overlay":{"wireframe":"segments"}})",
          "s"),
      UsageError);
  CHECK_THROWS_AS(
      scene_from_json(R"({"render":{"pipeline":"rays"},"warp":{"kind":"lamar","homogeneous":false}})", "s"),
      UsageError);
}
