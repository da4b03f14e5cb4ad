#include "catch.h"
#include "core/errors.h"
#include "mesh_checks.h"

using namespace mesh_checks;

namespace {

/// Largest |tessellated − exact| texture radius, by this file's own formulas, over `samples` radii.
double error_of(const LensCase& c, int samples) {
  double largest = 0;
  for (int i = 1; i < samples; ++i) {
    const double r = c.lens.inner + (c.lens.outer - c.lens.inner) * i / samples;
    largest =
        std::max(largest, std::abs(segmented_profile(c, c.lens.zoom, r) - profile(c.lens, c.lens.zoom, r)));
  }
  return largest;
}

LensCase case_with(LensBorder border, std::size_t segments) {
  LensCase c;
  c.lens.border = border;
  c.lens.zoom = 4;
  c.lens.inner = 0.5;
  c.lens.outer = 1;
  c.lens.radial_segments = segments;
  return c;
}

/// Largest shift in the picture: from where the tessellation shows a texture radius to where the exact
/// profile does.
double shown_shift(const LamarLens& lens, std::size_t segments) {
  LensCase c;
  c.lens = lens;
  c.lens.radial_segments = segments;
  double largest = 0;
  for (int i = 1; i < 4000; ++i) {
    const double r = lens.inner + (lens.outer - lens.inner) * i / 4000;
    const double target = segmented_profile(c, lens.zoom, r);
    double low = 0;
    double high = lens.outer;
    for (int k = 0; k < 50; ++k) {
      const double middle = (low + high) / 2;
      (profile(lens, lens.zoom, middle) < target ? low : high) = middle;
    }
    largest = std::max(largest, std::abs(low - r));
  }
  return largest;
}

} // namespace

TEST_CASE("LaMar's Table 1, corner by corner") {
  // A square lens with Q = 4 whose zoom region reaches from 0 to 1 along s, on the data's plane t = 1, with
  // the lower corners looking at r = .125 − .5/4 = 0.
  LamarLens lens;
  lens.shape = LensShape::square;
  lens.zoom = 4;
  lens.center = {0.5, 1, 0.125};
  lens.inner = 0.5;
  lens.outer = 0.6;
  const LensCase c = make_case(lens, Box{}, front_view());
  const auto mesh = [&](double t) {
    const Polygon polygon = {{0, t, 0}, {1, t, 0}, {1, t, 1}, {0, t, 1}};
    return tessellate_slice(polygon, {prepare(c)}, c.space, {});
  };
  const auto has = [](const LensMesh& m, const glm::dvec4& texture) {
    return std::any_of(m.vertices.begin(), m.vertices.end(),
                       [&](const LensVertex& v) { return glm::length(v.texture - texture) < 1e-12; });
  };
  CHECK(has(mesh(1), {1.5, 4, 0, 4})); // upper left: (.375, 1, 0) with weight 4
  CHECK(has(mesh(1), {2.5, 4, 0, 4})); // upper right: (.625, 1, 0)
  CHECK(has(mesh(0),
            {0, 0, 0, 1})); // lower left and right, in the normal region: t = 0 is 1 away, depth_outer .6
  CHECK(has(mesh(0), {1, 0, 0, 1}));
}

TEST_CASE(
    "no crease: both triangles of every border quad are one projective map, which affine ones are not") {
  for (const LensShape shape : {LensShape::circle, LensShape::square}) {
    for (const LensBorder border : {LensBorder::simple, LensBorder::linear, LensBorder::cubic}) {
      for (const bool homogeneous : {true, false}) {
        LamarLens lens;
        lens.shape = shape;
        lens.border = border;
        lens.homogeneous = homogeneous;
        const LensCase c = make_case(lens, Box{}, front_view());
        const LensMesh mesh = mesh_at(c, 0.03);
        double crease = 0;
        int quads = 0;
        for (std::size_t i = 0; i + 1 < mesh.regions.size(); ++i) {
          if (mesh.regions[i] != LensRegion::border || mesh.triangles[3 * i + 2] != mesh.triangles[3 * i + 4])
            continue; // not the two halves of a quad
          ++quads;
          const auto first = corners_of(mesh, i);
          const auto second = corners_of(mesh, i + 1);
          for (const glm::dvec3& weights : {glm::dvec3(0.2, 0.3, 0.5), glm::dvec3(0.05, 0.05, 0.9),
                                            glm::dvec3(1 / 3.0, 1 / 3.0, 1 / 3.0)}) {
            const glm::dvec3 p = weights.x * second[0].position + weights.y * second[1].position +
                                 weights.z * second[2].position;
            // The first triangle's map, continued beyond its edge.
            const glm::dvec3 continued = looked_at(first, *barycentric(first, p));
            crease = std::max(crease, glm::length(continued - looked_at(second, weights)));
          }
        }
        const int segments = border == LensBorder::simple ? 1 : 8;
        CHECK(quads == (shape == LensShape::square ? 4 : 32) * segments);
        if (homogeneous)
          CHECK(crease < 1e-12);
        else
          CHECK(crease > 1e-4);
      }
    }
  }
}

TEST_CASE("the radial errors computed beforehand, to two digits") {
  struct Row {
    std::size_t segments;
    double linear;
    double cubic;
  };
  for (const Row& row : {Row{1, .29, .30}, Row{2, .117, .088}, Row{4, .043, .0246}, Row{8, .0139, .0064},
                         Row{16, .0041, .0016}, Row{32, .00114, .00043}}) {
    // The table's numbers are rounded to two digits or three: half a unit of the second digit is 5 % at most.
    for (const auto& [border, expected] :
         {std::pair(LensBorder::linear, row.linear), std::pair(LensBorder::cubic, row.cubic)}) {
      const double error = radial_error(border, 0.25, 0.5, 1, row.segments);
      const double unit = std::pow(10, std::floor(std::log10(expected)) - 1);
      CHECK(std::abs(error - expected) <= 0.5 * unit);
      CHECK(error == Approx(error_of(case_with(border, row.segments), 100'000)).epsilon(0.01));
    }
  }
  CHECK(radial_error(LensBorder::simple, 0.25, 0.5, 1, 1) < 1e-15); // its profile is what one segment gives
}

TEST_CASE("second order in the segments") {
  for (const LensBorder border : {LensBorder::linear, LensBorder::cubic}) {
    for (const std::size_t n : {std::size_t(64), std::size_t(128), std::size_t(256)}) {
      const double order =
          std::log2(radial_error(border, 0.25, 0.5, 1, n) / radial_error(border, 0.25, 0.5, 1, 2 * n));
      INFO("border " << int(border) << ", from " << n << ": order " << order);
      CHECK(order > 1.9);
      CHECK(order < 2.1);
    }
  }
}

TEST_CASE("the program's tessellated radius is numerator over weight, both linear between rings") {
  CHECK(rc::check([] {
    LensCase c;
    c.lens = random_lens(0.5);
    if (c.lens.border == LensBorder::simple)
      c.lens.radial_segments = 1;
    const double r = random_in(c.lens.inner, c.lens.outer);
    const double got = tessellated_radius(c.lens.border, 1 / c.lens.zoom, c.lens.inner, c.lens.outer,
                                          *c.lens.radial_segments, r);
    RC_ASSERT(std::abs(got - segmented_profile(c, c.lens.zoom, r)) < 1e-12);
  }));
}

TEST_CASE("every corner of the mesh looks where the exact map looks") {
  CHECK(rc::check([] {
    LensCase c = random_case(0.12);
    c.lens.center = {0.5, 0.5, 0.5};
    c.lens.shape = random_bool() ? LensShape::circle : LensShape::square;
    c.box = make_box({20, 20, 20}, {1, 1, 1}, {0, 0, 0}, glm::dmat3(1)); // the lens stays clear of the faces
    c.view = random_view(c.box);
    c = make_case(c.lens, c.box, c.view);
    for (const LensVertex& vertex : mesh_at(c, random_in(-0.2, 0.2)).vertices) {
      const glm::dvec3 exact =
          texture_from_box(c.space, texture_from_object(c.map, box_from_texture(c.space, vertex.position)));
      RC_ASSERT(glm::length(glm::dvec3(vertex.texture) / vertex.texture.w - exact) < 1e-12);
    }
  }));
}

TEST_CASE("adaptive segments: the fewest under half a pixel") {
  int several = 0;
  for (const LensBorder border : {LensBorder::linear, LensBorder::cubic}) {
    for (const double zoom : {1.0, 1.5, 4.0, 8.0}) {
      for (const double pixels : {100.0, 500.0, 2000.0}) {
        LamarLens lens;
        lens.border = border;
        lens.zoom = zoom;
        lens.radial_segments = std::nullopt;
        const LensCase c = make_case(lens, Box{}, front_view());
        const std::size_t n = prepare(c, pixels).radial_segments;
        INFO("border " << int(border) << ", zoom " << zoom << ", " << pixels << " pixels: " << n);
        CHECK(shown_shift(lens, n) * pixels <=
              0.5 * 1.01); // 1 %: the program divides by the slope at one end
        if (n > 1)
          CHECK(shown_shift(lens, n - 1) * pixels > 0.5 * 0.99);
        several += n > 2;
        if (zoom == 1)
          CHECK(n == 1);
      }
    }
  }
  CHECK(several > 8);
}

TEST_CASE("adaptive segments beyond the maximum are refused, simple borders always have one") {
  LamarLens lens;
  lens.radial_segments = std::nullopt;
  LensCase c = make_case(lens, Box{}, front_view());
  CHECK_THROWS_WITH(prepare(c, 1e9), Catch::Contains("radial_segments"));
  c.lens.border = LensBorder::simple;
  CHECK(prepare(c, 1e9).radial_segments == 1);
  c.lens.radial_segments = 8;
  CHECK(prepare(c).radial_segments == 1);
}

TEST_CASE("wrong lenses are refused before anything is made of them") {
  LensCase c = make_case(LamarLens{}, Box{}, front_view());
  c.lens.radial_segments = 1'000'000;
  CHECK_THROWS_AS(prepare(c), UsageError);
  c.lens = LamarLens{};
  c.lens.center = {50, 0, 0};
  CHECK_THROWS_AS(prepare(c), UsageError);
}
