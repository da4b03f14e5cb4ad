// Legend, scale bar and orientation labels of a volume's picture.
#include "catch.h"
#include "core/errors.h"
#include "image/lettering.h"
#include "render/annotations.h"
#include "render/scene_overlay.h"
#include "render_fixture.h"

#include <algorithm>

using namespace slicelens;

namespace {

constexpr int size = 128;

PreparedScene scene_with(const std::string& overlay, const std::string& camera, TransferFunction transfer) {
  return prepare_phantom(
      R"({"volume":{"phantom":"box","size":[8,8,8]},"render":{"size":[128,128]},"camera":{)" + camera +
          R"(},"overlay":{)" + overlay + "}}",
      std::move(transfer));
}

Image annotated(const PreparedScene& scene, float background = 0) {
  Image image = make_image(size, size);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = i % 4 == 3 ? 1 : background;
  draw_overlays(image, scene);
  return image;
}

/// White dots of a part of the picture, cut to their bounds: one text for each row.
std::vector<std::string> white_dots(const Image& image, const PixelBox& part) {
  int left = image.width;
  int right = -1;
  int top = image.height;
  int bottom = -1;
  const auto white = [&](int x, int y) {
    return channel(image, x, y, 0) == 1 && channel(image, x, y, 1) == 1;
  };
  for (int y = part.top; y < part.top + part.height; ++y) {
    for (int x = part.left; x < part.left + part.width; ++x) {
      if (!white(x, y))
        continue;
      left = std::min(left, x);
      right = std::max(right, x);
      top = std::min(top, y);
      bottom = std::max(bottom, y);
    }
  }
  std::vector<std::string> rows;
  for (int y = top; y <= bottom; ++y) {
    rows.emplace_back();
    for (int x = left; x <= right; ++x)
      rows.back() += white(x, y) ? '#' : '.';
  }
  return rows;
}

/// The letters that a part of the picture shows: one or two of R L A P S I, or "?".
std::string letters_in(const Image& image, const PixelBox& part) {
  const std::vector<std::string> seen = white_dots(image, part);
  const std::string all = "RLAPSI";
  for (const char first : all) {
    for (const char second : all + " ") {
      std::string text(1, first);
      if (second != ' ')
        text += second;
      Image sample = make_image(20, 10);
      draw_text(sample, 1, 1, text, glm::vec3(1));
      if (white_dots(sample, {0, 0, 20, 10}) == seen)
        return text;
    }
  }
  return seen.empty() ? "" : "?";
}

/// Letters at the left, right, upper and lower edge.
std::array<std::string, 4> edges(const Image& image) {
  constexpr int reach = 24;
  constexpr int middle = (size - reach) / 2;
  return {
      letters_in(image, {0, middle, reach, reach}), letters_in(image, {size - reach, middle, reach, reach}),
      letters_in(image, {middle, 0, reach, reach}), letters_in(image, {middle, size - reach, reach, reach})};
}

std::string seen_from(const glm::dvec3& from, const glm::dvec3& up) {
  const auto list = [](const glm::dvec3& v) {
    return "[" + std::to_string(v.x) + "," + std::to_string(v.y) + "," + std::to_string(v.z) + "]";
  };
  return R"("focal_point":[0,0,0],"position":)" + list(from * 100.0) + R"(,"view_up":)" + list(up);
}

using Letters = std::array<std::string, 4>;

} // namespace

TEST_CASE("labels stand at the right sides of the six views along the axes") {
  const glm::dvec3 x(1, 0, 0);
  const glm::dvec3 y(0, 1, 0);
  const glm::dvec3 z(0, 0, 1);
  // From the front the patient's left is at the viewer's right; from the feet with the front up (as axial
  // slices are shown) too; from behind and from above the head it is at the left.
  const auto& [from, up, expected] =
      GENERATE_REF(table<glm::dvec3, glm::dvec3, Letters>({{-y, z, Letters{"R", "L", "S", "I"}},
                                                           {y, z, Letters{"L", "R", "S", "I"}},
                                                           {x, z, Letters{"A", "P", "S", "I"}},
                                                           {-x, z, Letters{"P", "A", "S", "I"}},
                                                           {z, -y, Letters{"L", "R", "A", "P"}},
                                                           {-z, -y, Letters{"R", "L", "A", "P"}}}));
  for (const float background : {0.0F, 0.5F}) {
    const Image image = annotated(scene_with(R"("labels":true)", seen_from(from, up), grey(0)), background);
    CHECK(edges(image) == expected);
  }
}

TEST_CASE("oblique views name two axes, the nearer one first, from 15 degrees on") {
  // From the front, the eye gone by an angle towards the patient's left: right is (cos, sin, 0) in LPS.
  const auto right_at = [](double degrees) {
    const double a = degrees * 3.14159265358979 / 180;
    return edges(annotated(
        scene_with(R"("labels":true)", seen_from({std::sin(a), -std::cos(a), 0}, {0, 0, 1}), grey(0))));
  };
  CHECK(right_at(10) == Letters{"R", "L", "S", "I"});
  CHECK(right_at(30) == Letters{"RA", "LP", "S", "I"});
  CHECK(right_at(60) == Letters{"AR", "PL", "S", "I"});
  CHECK(right_at(-30) == Letters{"RP", "LA", "S", "I"});
  CHECK(orientation_letters({1, 1, 0}) == "LP"); // equally near: in the order of the axes
  CHECK(orientation_letters({-0.6, -0.5, 0.62}) == "SR");
}

TEST_CASE("the default camera looks from the front, its elevation shows the head from above") {
  CHECK(edges(annotated(scene_with(R"("labels":true)", "", grey(0)))) == Letters{"R", "L", "S", "I"});
  const Letters above = edges(annotated(scene_with(R"("labels":true)", R"("elevation":40)", grey(0))));
  CHECK(above == Letters{"R", "L", "SP", "IA"}); // up leans to the back
}

TEST_CASE("the scale bar is its length over a pixel's size, orthographic") {
  // A quarter of 128 pixels: at .83 units a pixel 26.6 units, so 20 of them, 24.1 pixels.
  const auto& [parallel_scale, length] =
      GENERATE(table<double, double>({{64 * 0.83, 20}, {64, 20}, {64 * 1.6, 50}, {64 * 3.125e-4, 0.01}}));
  const PreparedScene scene =
      scene_with(R"("scale_bar":true)", R"("parallel_scale":)" + std::to_string(parallel_scale), grey(0));
  const Image image = annotated(scene, 0.5F);
  int run = 0;
  for (int x = 0; x < size; ++x)
    run += channel(image, x, size - 5, 0) == 1 ? 1 : 0; // the bar's two rows end 4 above the edge
  CHECK(std::abs(run - length / (2 * parallel_scale / size)) <= 1);
  // The same by the view: two points that far apart.
  const glm::dvec2 a = pixel_from_world(scene.view, center(scene.box));
  const glm::dvec2 b = pixel_from_world(scene.view, center(scene.box) + length * scene.view.right);
  CHECK(std::abs(run - glm::length(b - a)) <= 1);
}

TEST_CASE("under perspective the scale bar measures the plane through the focal point and says so") {
  // 300 from the focal point, tan 20° each way: a pixel is 2·300·.36397/128 = 1.7061 units, a quarter of the
  // picture 54.6 of them: 50, 29.3 pixels.
  const PreparedScene scene = scene_with(
      R"("scale_bar":true)",
      R"("projection":"perspective","view_angle":40,"position":[10,-300,20],"focal_point":[10,0,20])",
      grey(0));
  CHECK(pixel_size(scene) == Approx(1.70612).epsilon(1e-5));
  const Image image = annotated(scene, 0.5F);
  int run = 0;
  for (int x = 0; x < size; ++x)
    run += channel(image, x, size - 5, 0) == 1 ? 1 : 0;
  CHECK(std::abs(run - 29.3) <= 1);
  const glm::dvec2 a = pixel_from_world(scene.view, {10, 0, 20});
  const glm::dvec2 b = pixel_from_world(scene.view, glm::dvec3(10, 0, 20) + 50.0 * scene.view.right);
  CHECK(std::abs(run - glm::length(b - a)) <= 1);
  // The words take a line that the orthographic picture has not.
  const auto lines = [](const Image& picture) { return white_dots(picture, {0, 60, 90, 68}).size(); };
  CHECK(lines(image) > lines(annotated(scene_with(R"("scale_bar":true)", "", grey(0)), 0.5F)) + 6);
  // Without a focal point: the box centre, from the default camera's distance, wherever the eye is zoomed to.
  const PreparedScene plain =
      scene_with(R"("scale_bar":true)", R"("projection":"perspective","zoom":2)", grey(0));
  CHECK(pixel_size(plain) ==
        Approx(2 * plain.view.half_height / size * glm::length(plain.view.eye - center(plain.box))));
}

TEST_CASE("the legend's colours are the transfer function's at the values of its rows") {
  const TransferFunction transfer{
      {{-300, 0.2, 0.1, 0, 0}, {100, 1, 0.9, 0.7, 0.25}, {100, 0, 0.2, 0.9, 0.5}, {700, 0.3, 0.4, 1, 1}},
      {},
      ""};
  const PreparedScene scene = scene_with(R"("legend":true)", "", transfer);
  const Image image = annotated(scene);
  Image where = make_image(size, size);
  const LegendPlace place = draw_legends(where, legends_of(scene)).at(0);
  const int column = place.colors.left + place.colors.width / 2;
  for (const double f : {0.02, 0.3, 0.45, 0.7, 0.97}) {
    const int row = static_cast<int>(f * place.colors.height);
    const double value = 700 - (row + 0.5) / place.colors.height * 1000;
    const glm::dvec4 rgba = evaluate(transfer, value);
    for (int c = 0; c < 3; ++c)
      CHECK(channel(image, column, place.colors.top + row, c) == Approx(rgba[c]).margin(1e-6));
    int lit = 0;
    for (int x = 0; x < place.opacities.width; ++x)
      lit += channel(image, place.opacities.left + x, place.colors.top + row, 0) > 0.5F ? 1 : 0;
    CHECK(std::abs(lit - rgba.a * place.opacities.width) <= 0.5 + 1e-9);
  }
}

TEST_CASE("the legend of a function of one value spans the data") {
  const PreparedScene scene = scene_with(R"("legend":true)", "", grey(0.5));
  const Legend legend = legends_of(scene).at(0);
  CHECK(legend.low == std::min(0.0, scene.volume.min));
  CHECK(legend.high == std::max(0.0, scene.volume.max));
}

TEST_CASE("annotations are off by default and stay above the bar of magnifications") {
  const Image nothing = annotated(scene_with("", "", grey(0)), 0.25F);
  CHECK(std::all_of(nothing.pixels.begin(), nothing.pixels.end(),
                    [](float value) { return value == 0.25F || value == 1; }));
  CHECK(std::count(nothing.pixels.begin(), nothing.pixels.end(), 1.0F) == size * size); // alpha only
  const PreparedScene both = prepare_phantom(
      R"({"volume":{"phantom":"box","size":[8,8,8]},"render":{"pipeline":"fragment","size":[128,128]},
          "warp":{"kind":"fisheye"},"overlay":{"magnification":0.5,"labels":true}})",
      grey(0));
  const Image image = annotated(both);
  CHECK(image.height > size);
  CHECK(edges(image) == Letters{"R", "L", "S", "I"});
}

TEST_CASE("labels leave room for the legend") {
  const PreparedScene scene = scene_with(R"("legend":true,"labels":true)", "", rising(0, 1, 1));
  const Image image = annotated(scene);
  const int taken = legends_width(image, legends_of(scene));
  CHECK(letters_in(image, {size - taken - 14, 52, 13, 24}) == "L");
}

TEST_CASE("annotations that would be wrong are refused by name") {
  const auto message = [](const std::string& json) -> std::string {
    try {
      (void)scene_from_json(json, "s");
    } catch (const UsageError& error) {
      return error.what();
    }
    return "";
  };
  const auto has = [](const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  };
  CHECK(has(message(R"({"overlay":{"legend":true},"render":{"mode":"xray"}})"), "overlay.legend"));
  CHECK(has(message(R"({"overlay":{"labels":true,"stack":30}})"), "overlay.stack"));
  CHECK(has(message(R"({"overlay":{"scale_bar":true},"render":{"size":[63,100]}})"), "render.size"));
  CHECK(has(message(R"({"overlay":{"unit":"micrometres"}})"), "overlay.unit"));
  CHECK(has(message(R"({"overlay":{"legend":true},"render":{"size":[100,100]},
                        "volumes":[{"phantom":"ball"},{"phantom":"box"}]})"),
            "2 volume"));
  const std::string shapes = R"("shapes":[{"value":[0,1,2,3],"gradient":[0,1,2,3]}])";
  CHECK(has(message(R"({"overlay":{"legend":true},"transfer":{)" + shapes + "}}"), "overlay.legend"));
  CHECK(has(message(R"({"transfer":{"window":5,)" + shapes + "}}"), "transfer.window"));
  CHECK(message(R"({"transfer":{)" + shapes + "}}").empty());
  CHECK(message(R"({"overlay":{"scale_bar":true,"labels":true},"render":{"mode":"xray"}})").empty());
}
