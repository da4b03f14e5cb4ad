#include "catch.h"
#include "core/errors.h"
#include "mesh_checks.h"

using namespace mesh_checks;

namespace {

std::string overlap(const std::vector<LensTessellation>& lenses) {
  try {
    refuse_overlap(lenses);
  } catch (const UsageError& error) {
    return error.what();
  }
  return {};
}

std::vector<LensTessellation> prepared(const std::vector<LensCase>& cases) {
  std::vector<LensTessellation> lenses;
  for (const LensCase& c : cases)
    lenses.push_back(prepare(c));
  return lenses;
}

/// Lenses in the unit box from the front that do not overlap: found by trying, so depths and kinds are free.
std::vector<LensCase> random_lenses() {
  const Box box = make_box({20, 20, 20}, {1, 1, 1}, {0, 0, 0}, glm::dmat3(1));
  const View view = random_view(box);
  std::vector<LensCase> cases;
  for (int tries = 0; tries < 30 && cases.size() < 4; ++tries) {
    std::vector<LensCase> more = cases;
    more.push_back(make_case(random_lens(0.3), box, view));
    if (overlap(prepared(more)).empty())
      cases = more;
  }
  return cases;
}

LensCase at(double x, double z, double depth, double outer, bool bounded,
            LensShape shape = LensShape::circle) {
  LamarLens lens;
  lens.center = {x, depth, z};
  lens.outer = outer;
  lens.inner = outer / 2;
  lens.bounded = bounded;
  lens.shape = shape;
  return make_case(lens, Box{}, front_view());
}

} // namespace

TEST_CASE("several lenses: the slice is covered once, each lens shows its own map, corners are shared") {
  int most = 0;
  CHECK(rc::check([&] {
    const std::vector<LensCase> cases = random_lenses();
    const LensCase& c = cases.front();
    const double z = random_in(-0.3, 0.3);
    const LensMesh mesh = tessellate_slice(slice_at(c, z), prepared(cases), c.space, {});
    const std::string wrong = wrong_corners(mesh);
    if (!wrong.empty())
      RC_FAIL(wrong);
    int touched = 0;
    for (const LensCase& lens : cases) {
      const double depth = across_of(lens, point_at(c, z, 0, 0)).depth;
      touched += std::abs(depth) < depth_outer(lens.lens);
      for (int i = 0; i < 20; ++i) {
        const double reach = i % 2 == 0 ? 1.3 * lens.lens.outer : 1;
        const glm::dvec3 p = point_at(lens, depth, random_in(-reach, reach), random_in(-reach, reach));
        glm::dvec3 expected = p;
        for (const LensCase& other : cases) {
          const glm::dvec3 moved = tessellated_texture(other, p);
          if (moved != p)
            expected = moved;
        }
        const std::string beside =
            wrong_at(mesh, texture_from_box(c.space, p), texture_from_box(c.space, expected));
        if (!beside.empty())
          RC_FAIL(beside);
      }
    }
    most = std::max(most, touched);
  }));
  CHECK(most >= 3);
}

TEST_CASE("lenses that overlap are refused, naming both; the order does not matter") {
  const auto first = at(0.3, 0.5, 0.5, 0.2, true);
  for (const auto& second : {at(0.5, 0.5, 0.5, 0.2, true), at(0.3, 0.5, 0.5, 0.1, false),
                             at(0.65, 0.85, 0.5, 0.2, true), at(0.5, 0.5, 0.8, 0.2, true)}) {
    const std::string message = overlap(prepared({first, second}));
    CHECK(message.find("lenses 0 and 1") != std::string::npos);
    CHECK(message.find("overlap") != std::string::npos);
    CHECK_FALSE(overlap(prepared({second, first})).empty());
  }
  CHECK(overlap(prepared({first, at(0.8, 0.5, 0.5, 0.1, true), at(0.75, 0.5, 0.5, 0.1, true)}))
            .find("lenses 1 and 2") != std::string::npos);
}

TEST_CASE("lenses that stand apart across the view or along it are taken") {
  const auto first = at(0.3, 0.5, 0.3, 0.2, true);
  CHECK(overlap(prepared({first})).empty());
  CHECK(overlap(prepared({first, at(0.701, 0.5, 0.3, 0.2, true)})).empty());
  CHECK(overlap(prepared({first, at(0.3, 0.5, 0.701, 0.2, true)})).empty()); // behind: depth_outer is outer
  CHECK_FALSE(overlap(prepared({first, at(0.3, 0.5, 0.699, 0.2, true)})).empty());
}

TEST_CASE("circles without a bounding square may stand closer along the diagonal, squares may not") {
  // Centres .3 apart on both axes: .424 as the crow flies, .3 as a square counts; outer radii sum to .4.
  const auto pair = [](bool bounded, LensShape shape) {
    return prepared({at(0.3, 0.3, 0.5, 0.2, bounded, shape), at(0.6, 0.6, 0.5, 0.2, bounded, shape)});
  };
  CHECK(overlap(pair(false, LensShape::circle)).empty());
  CHECK_FALSE(overlap(pair(true, LensShape::circle)).empty());
  CHECK_FALSE(overlap(pair(false, LensShape::square)).empty());
  CHECK_FALSE(overlap(pair(true, LensShape::square)).empty());
}

TEST_CASE("under perspective lenses that hide each other overlap where their depths do") {
  View view = front_view();
  view.projection = Projection::perspective;
  view.eye = {0.5, -1, 0.5};
  LamarLens near;
  near.center = {0.65, 0.3, 0.5}; // seen at .15/1.3
  near.inner = 0.03;
  near.outer = 0.05;
  near.depth_outer = 0.3;
  LamarLens far = near;
  far.center = {0.5 + 0.15 / 1.3 * 1.8, 0.8, 0.5}; // on the same line of sight
  const Box box;
  const auto lenses = [&] { return prepared({make_case(near, box, view), make_case(far, box, view)}); };
  CHECK_FALSE(overlap(lenses()).empty()); // depths .3 + .3 overlap over .5
  far.center.x = 0.65;                    // right behind it in the box, but beside it in the picture
  far.center.z = 0.5;
  // In the picture at .15/1.8 = .083 against .115: .032 apart, radii .05/1.3 + .05/1.8 = .066: overlap.
  CHECK_FALSE(overlap(lenses()).empty());
  // At .1/1.8 = .0556: .0598 apart. In the box the axes are .108 apart there, more than .05 + .05: radii grow
  // with depth.
  far.center.x = 0.6;
  CHECK_FALSE(overlap(lenses()).empty());
  far.center.x = 0.53; // at .0167: .0987 apart
  CHECK(overlap(lenses()).empty());
}
