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

namespace {

/// Face on as above, by the tables.
PreparedScene face_on_axis(const std::string& overlay, const std::string& sections) {
  return prepare_phantom(
      R"({"volume":{"phantom":"box","size":[8,8,8]},"render":{"pipeline":"axis","size":[200,200]},)" +
          sections + R"(,"overlay":{)" + overlay + "}}",
      grey(0));
}

const std::string bifocal =
    R"("warp":{"kind":"bifocal","focus":[[0.4,0.6],[0.4,0.6],[0.4,0.6]],"shown":[[0.25,0.75],[0.25,0.75],[0.25,0.75]]})";
const std::string box_lens = R"("warp":{"kind":"volume-lens","inner":0.1,"outer":0.3,"magnification":2})";
const glm::vec3 orange(1.0F, 0.65F, 0.0F);
const glm::vec3 red(1.0F, 0.1F, 0.1F);
const glm::vec3 green(0.0F, 0.75F, 0.2F);

} // namespace

TEST_CASE("the outline shows the focus region on display red and the box of a lens green") {
  const auto& [sections, inner, outer] = GENERATE(table<std::string, double, double>(
      {{bifocal, 0.25, 0},
       {box_lens, 0.1, 0.3},
       {R"("warp":{"kind":"connected-lens","inner":0.1,"outer":0.3,"magnification":2})", 0.1, 0.3},
       {R"("warp":[],"attenuation":{"function":"distance","focus":[[0.3,0.7],[0.3,0.7],[0.3,0.7]]})", 0.2, 0},
       {R"("warp":[],"highlight":{"function":"focus","focus":[[0.3,0.7],[0.3,0.7],[0.3,0.7]]})", 0.2, 0}}));
  const PreparedScene scene = face_on_axis(R"("outline":true,"line_width":3)", sections);
  Image image = make_image(size, size);
  draw_overlays(image, scene);
  const double u = unit(scene);
  CHECK(is_color(image, 100 + inner * u, 100 + 0.03 * u, red));
  CHECK(is_color(image, 100 - 0.03 * u, 100 - inner * u, red));
  CHECK(is_color(image, 100, 100, {0, 0, 0}));
  if (outer > 0) {
    CHECK(is_color(image, 100 - outer * u, 100 + 0.03 * u, green));
    CHECK(is_color(image, 100 + 0.03 * u, 100 + outer * u, green));
  }
}

TEST_CASE("a focal point is shown as a red cross") {
  const PreparedScene scene =
      face_on_axis(R"("outline":true,"line_width":3)", R"("warp":{"kind":"fisheye","center":[0.6,0.5,0.7]})");
  Image image = make_image(size, size);
  draw_overlays(image, scene);
  const double u = unit(scene);
  CHECK(is_color(image, 100 + 0.1 * u, 100 - 0.2 * u, red));
  CHECK(is_color(image, 100 + 0.12 * u, 100 - 0.2 * u, red));
  CHECK(is_color(image, 100 + 0.16 * u, 100 - 0.2 * u, {0, 0, 0}));
}

TEST_CASE("the lattice of the data is carried by the tables' maps") {
  // Lines of the data at multiples of .04 from the centre; the focus shows .2 in .5, so the first is at .1,
  // the second at .2. Beyond the focus .4 is shown in .25: the line at .28 is at .25 + .18·.25/.4 = .3625.
  const PreparedScene scene = face_on_axis(R"("lattice":25,"line_width":2)", bifocal);
  Image image = make_image(size, size);
  draw_overlays(image, scene);
  const double u = unit(scene);
  CHECK(is_color(image, 100 + 0.1 * u, 100 - 0.05 * u, orange));
  CHECK(is_color(image, 100 - 0.05 * u, 100 + 0.2 * u, orange));
  CHECK(is_color(image, 100 + 0.3625 * u, 100 - 0.05 * u, orange));
  CHECK(is_color(image, 100 + 0.05 * u, 100 - 0.15 * u, {0, 0, 0}));
}

TEST_CASE("the lattice goes through a chain of warps in forward order") {
  // The data's line at .04 is shown at .1 by the bifocal map. The lens about the middle with m = 2 shows .1
  // at δ with .05 + (δ − .1)/2 + .15·((δ − .1)/.2)² = .1: δ − .1 = (−.5 + √(.25 + .75))/7.5 = .0667.
  const PreparedScene scene = prepare_phantom(
      R"({"volume":{"phantom":"box","size":[8,8,8]},"render":{"pipeline":"fragment","size":[200,200]},
          "warp":[{"kind":"bifocal","focus":[[0.4,0.6],[0.4,0.6],[0.4,0.6]],"shown":[[0.25,0.75],[0.25,0.75],[0.25,0.75]]},
                  {"kind":"volume-lens","inner":0.1,"outer":0.3,"magnification":2}],"overlay":{"lattice":25,"line_width":2}})",
      grey(0));
  Image image = make_image(size, size);
  draw_overlays(image, scene);
  const double u = unit(scene);
  CHECK(is_color(image, 100 + 0.1667 * u, 100 - 0.05 * u, orange));
  CHECK(is_color(image, 100 + 0.1 * u, 100 - 0.05 * u, {0, 0, 0}));
}

TEST_CASE("lattice lines end where the box lens cuts, and the connected lens joins them") {
  // The line of the data at .2 from the middle is shown at δ with .05 + (δ − .1)/2 + .15·((δ − .1)/.2)² = .2,
  // δ = .1 + (−.5 + √2.5)/7.5 = .2442, as far as the box reaches, and at .2 beyond: a jump at .3, some 5
  // pixels.
  const auto step_at_face = [](const std::string& kind) {
    const PreparedScene scene =
        face_on_axis(R"("lattice":5,"line_width":1.5)",
                     R"("warp":{"kind":")" + kind + R"(","inner":0.1,"outer":0.3,"magnification":2})");
    Image image = make_image(size, size);
    draw_overlays(image, scene);
    const double u = unit(scene);
    int first = -1;
    int step = 0; // from the box's inside to its outside
    for (int row = static_cast<int>(100 - 0.38 * u); row <= static_cast<int>(100 - 0.27 * u); ++row) {
      int count = 0;
      int sum = 0;
      for (int column = static_cast<int>(100 + 0.15 * u); column <= static_cast<int>(100 + 0.29 * u);
           ++column) {
        if (channel(image, column, row, 0) > 0.4F) {
          sum += column;
          ++count;
        }
      }
      CHECK(count > 0);
      CHECK(count <= 5); // nothing drawn across the jump: both ends, not the 7 pixels of a line between them
      const int middle = sum / std::max(count, 1);
      if (first < 0)
        first = middle;
      step = std::abs(middle - first);
    }
    return step;
  };
  CHECK(step_at_face("volume-lens") >= 4);
  CHECK(step_at_face("connected-lens") <= 1);
}

TEST_CASE("false colours show the magnification of separable warps: 2.5 in the focus, 0.625 in the corners") {
  const PreparedScene scene = face_on_axis(R"("magnification":1)", bifocal);
  Image image = make_image(size, size);
  draw_overlays(image, scene);
  CHECK(image.height > size); // the bar
  const double u = unit(scene);
  // Slopes .2/.5 in the focus and .4/.25 in the corners; beside the focus one of each: 1/√(.4·1.6) = 1.25.
  const double octaves = std::log2(2.5 / 0.625);
  CHECK(is_color(image, 100, 100, heat_color(1)));
  CHECK(is_color(image, 100 + 0.4 * u, 100 - 0.4 * u, heat_color(0)));
  CHECK(is_color(image, 100 + 0.4 * u, 100, heat_color(std::log2(1.25 / 0.625) / octaves)));
  CHECK(is_color(image, 2, 2, heat_color(std::log2(1 / 0.625) / octaves))); // outside the volume
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

TEST_CASE("the wireframe of a subdivided slice shows its cells, and their diagonals as triangles") {
  // A shift by nothing: 4 x 4 cells on the unit square, whose middle is a node.
  for (const bool triangles : {false, true}) {
    const PreparedScene scene = face_on(std::string(R"("line_width":3,"wireframe":)") +
                                            (triangles ? R"("triangles")" : R"("segments")"),
                                        R"({"kind":"shift","offset":[0,0,0]})");
    PreparedScene four = scene;
    four.scene.render.subdivision = 4;
    Image image = make_image(size, size);
    draw_overlays(image, four);
    const double cell = unit(scene) / 4;
    const auto lit = [&](double column, double row) {
      return !is_color(image, 100 + cell * column, 100 - cell * row, {0, 0, 0});
    };
    CHECK(lit(0, 0.4));
    CHECK(lit(0.4, 1));
    CHECK(lit(-2, 0.7)); // the outline
    CHECK_FALSE(lit(0.3, 0.7));
    CHECK(lit(0.5, 0.5) == triangles); // from corner to corner of a cell
    CHECK_FALSE(lit(2.5, 0));
  }
}

TEST_CASE("circles lie around the sources and the targets of landmarks") {
  // Texture (.5, .5, .5) is the picture's middle; face on, x goes right, and 0.2 of the edge are 0.2 units.
  const PreparedScene scene = face_on(
      R"("landmarks":6,"line_width":3)",
      R"({"kind":"landmarks","method":"bspline","space":"texture","pairs":[[[0.5,0.5,0.5],[0.7,0.5,0.5]]]})");
  Image image = make_image(size, size);
  draw_overlays(image, scene);
  const double target = 100 + 0.2 * unit(scene);
  for (const double angle : {0.3, 1.2, 2.9, 4.4}) {
    const double x = 6 * std::cos(angle);
    const double y = 6 * std::sin(angle);
    CHECK(is_color(image, 100 + x, 100 + y, {1.0F, 0.1F, 0.1F}));
    CHECK(is_color(image, target + x, 100 + y, {0.15F, 0.4F, 1.0F}));
  }
  CHECK(is_color(image, 100, 100, {0, 0, 0}));
}
