// Splines through landmarks: against hand calculation, against ITK's, and their refusals.
#include "catch.h"
#include "core/errors.h"
#include "warp/landmarks.h"
#include "warp/multilevel_bspline.h"
#include "warp/thin_plate_spline.h"
#include "warp_cases.h"

#include <itkBSplineScatteredDataPointSetToImageFilter.h>
#include <itkPointSet.h>
#include <itkThinPlateSplineKernelTransform.h>

#include <random>

using namespace slicelens;

namespace {

std::mt19937& engine() {
  static std::mt19937 e(11);
  return e;
}

std::vector<glm::dvec3> random_points(std::size_t count) {
  std::uniform_real_distribution<double> unit(0.05, 0.95);
  std::vector<glm::dvec3> points;
  for (std::size_t i = 0; i < count; ++i)
    points.emplace_back(unit(engine()), unit(engine()), unit(engine()));
  return points;
}

/// The corners of the unit cube in place and a few points inside it moved by up to a tenth.
Landmarks moved_inside(std::size_t count) {
  Landmarks landmarks;
  landmarks.space = LandmarkSpace::texture;
  landmarks.pairs.emplace();
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 c(corner & 1, corner >> 1 & 1, corner >> 2);
    landmarks.pairs->push_back({c, c});
  }
  const std::vector<glm::dvec3> steps = random_points(count);
  for (const glm::dvec3& p : random_points(count))
    landmarks.pairs->push_back({p, p + 0.1 * (steps[landmarks.pairs->size() - 8] - 0.5)});
  return landmarks;
}

} // namespace

TEST_CASE("a thin-plate spline hits its values, and an affine map is its own") {
  for (const std::size_t count : {4, 5, 30, 200}) {
    const std::vector<glm::dvec3> at = random_points(count);
    const std::vector<glm::dvec3> values = random_points(count);
    const ThinPlateSpline spline = fit_thin_plate_spline(at, values, 0);
    glm::dvec3 sum(0);
    for (std::size_t i = 0; i < count; ++i) {
      CHECK(glm::length(evaluate(spline, at[i]) - values[i]) < 1e-9); // asked for: 1e-5
      sum += spline.weights[i];
    }
    CHECK(glm::length(sum) < 1e-9);
  }
  const std::vector<glm::dvec3> at = random_points(20);
  const glm::dmat3 linear({1, 0.2, 0}, {0.1, 0.9, 0.3}, {0, -0.2, 1.1});
  std::vector<glm::dvec3> values;
  for (const glm::dvec3& p : at)
    values.push_back(linear * p + glm::dvec3(1, 2, 3));
  const ThinPlateSpline affine = fit_thin_plate_spline(at, values, 0);
  const glm::dvec3 far(5, -7, 2);
  CHECK(glm::length(evaluate(affine, far) - (linear * far + glm::dvec3(1, 2, 3))) < 1e-10);
}

TEST_CASE("a thin-plate spline worked by hand") {
  // Six points ±1 on the axes held at 0, the origin at (1, 0, 0). By symmetry linear = 0, f = w·r(0) − w/6·Σ
  // r(±e) + c with the ring's weights −w/6: at the origin −w/6·6 + c = 1; at e_x: w − w/6·(0 + 2 + 4√2) + c =
  // 0.
  std::vector<glm::dvec3> at = {glm::dvec3(0)};
  std::vector<glm::dvec3> values = {glm::dvec3(1, 0, 0)};
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {-1.0, 1.0}) {
      at.emplace_back(0);
      at.back()[axis] = sign;
      values.emplace_back(0);
    }
  }
  const ThinPlateSpline spline = fit_thin_plate_spline(at, values, 0);
  const double w = -1 / (2 - (2 + 4 * std::sqrt(2.0)) / 6);
  CHECK(std::abs(spline.weights[0].x - w) < 1e-12);
  CHECK(std::abs(spline.weights[1].x + w / 6) < 1e-12);
  CHECK(std::abs(spline.constant.x - (1 + w)) < 1e-12);
  const glm::dvec3 p(0.5, 0.5, 0);
  const double ring = 2 * std::sqrt(0.5) + 2 * std::sqrt(2.5) + 2 * std::sqrt(1.5);
  CHECK(std::abs(evaluate(spline, p).x - (w * std::sqrt(0.5) - w / 6 * ring + 1 + w)) < 1e-12);
}

TEST_CASE("a thin-plate spline is ITK's ThinPlateSplineKernelTransform") {
  using Transform = itk::ThinPlateSplineKernelTransform<double, 3>;
  const std::vector<glm::dvec3> at = random_points(25);
  const std::vector<glm::dvec3> values = random_points(25);
  const auto transform = Transform::New();
  const auto source = Transform::PointSetType::New();
  const auto target = Transform::PointSetType::New();
  for (std::size_t i = 0; i < at.size(); ++i) {
    source->SetPoint(i, itk::Point<double, 3>(&at[i].x));
    target->SetPoint(i, itk::Point<double, 3>(&values[i].x));
  }
  transform->SetSourceLandmarks(source);
  transform->SetTargetLandmarks(target);
  transform->ComputeWMatrix();
  const ThinPlateSpline spline = fit_thin_plate_spline(at, values, 0);
  for (const glm::dvec3& p : random_points(200)) {
    const auto expected = transform->TransformPoint(itk::Point<double, 3>(&p.x));
    CHECK(glm::length(evaluate(spline, p) - glm::dvec3(expected[0], expected[1], expected[2])) < 1e-9);
  }
}

TEST_CASE("stiffness bends a thin-plate spline less, down to the least-squares affine map") {
  const std::vector<glm::dvec3> at = random_points(40);
  const std::vector<glm::dvec3> values = random_points(40);
  double before = -1;
  for (const double stiffness : {0.0, 0.01, 0.1, 1.0, 100.0, 1e6}) {
    const ThinPlateSpline spline = fit_thin_plate_spline(at, values, stiffness);
    double squares = 0;
    glm::dvec3 sum(0);
    glm::dmat3 moments(0);
    for (std::size_t i = 0; i < at.size(); ++i) {
      const glm::dvec3 miss = evaluate(spline, at[i]) - values[i];
      squares += glm::dot(miss, miss);
      sum += miss;
      moments += glm::outerProduct(miss, at[i]);
    }
    CHECK(squares > before); // more stiffness never comes nearer
    before = squares;
    // What is left is orthogonal to every affine map, at the end as in least squares (and always: Σw = 0).
    CHECK(glm::length(sum) < 1e-8);
    CHECK(glm::length(moments[0]) + glm::length(moments[1]) + glm::length(moments[2]) < 1e-8);
  }
  const ThinPlateSpline stiff = fit_thin_plate_spline(at, values, 1e6);
  for (const glm::dvec3& weight : stiff.weights)
    CHECK(glm::length(weight) < 1e-5);
}

TEST_CASE("a multilevel B-spline of one point, by hand, and of many, near their values") {
  // One level has one span: at its middle the weights are 1/48, 23/48, 23/48, 1/48 on each axis. The point
  // alone sets each control to w·v/Σw², so the spline there is v, and at a corner of the span by the weights
  // 1/6, 4/6, 1/6, 0.
  const std::vector<glm::dvec3> at = {glm::dvec3(0.5)};
  const std::vector<glm::dvec3> values = {glm::dvec3(1, -2, 3)};
  const MultilevelBSpline one = fit_multilevel_bspline(at, values, glm::dvec3(0), glm::dvec3(1), 1);
  CHECK(glm::length(evaluate(one, at[0]) - values[0]) < 1e-14);
  const double squares = 2 * (1 + 23 * 23) / 48.0 / 48;
  const double corner = (1.0 / 48 + 4 * 23.0 / 48 + 23.0 / 48) / 6 / squares;
  CHECK(std::abs(evaluate(one, glm::dvec3(0)).x - corner * corner * corner) < 1e-14);
  CHECK(evaluate(one, glm::dvec3(-5)) == evaluate(one, glm::dvec3(0)));

  std::vector<glm::dvec3> points;
  for (int i = 0; i < 27; ++i) // at least .2 apart
    points.push_back(glm::dvec3(0.2) + 0.3 * glm::dvec3(i % 3, i / 3 % 3, i / 9) +
                     0.1 * (random_points(1)[0] - 0.5));
  const std::vector<glm::dvec3> moves = random_points(27);
  double before = HUGE_VAL;
  for (const std::size_t levels : {1, 2, 3, 7}) {
    const MultilevelBSpline spline =
        fit_multilevel_bspline(points, moves, glm::dvec3(0), glm::dvec3(1), levels);
    double largest = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
      largest = std::max(largest, glm::length(evaluate(spline, points[i]) - moves[i]));
    CHECK(largest < before);
    before = largest;
  }
  CHECK(before < 1e-12); // 64 spans: no two of the points share a control
}

TEST_CASE("a multilevel B-spline on a grid is what it is point by point") {
  const std::vector<glm::dvec3> at = random_points(30);
  const MultilevelBSpline spline =
      fit_multilevel_bspline(at, random_points(30), glm::dvec3(-2), glm::dvec3(2), 6);
  // Beyond the spline's box as well, where it is that of the nearest point.
  const glm::dvec3 low(-2.5, -1, -0.3);
  const glm::dvec3 high(1.7, 2.4, 0.9);
  const std::array<std::size_t, 3> size = {9, 7, 12};
  const std::vector<glm::dvec3> sums = evaluate_on_grid(spline, size, low, high);
  REQUIRE(sums.size() == 9 * 7 * 12);
  for (std::size_t index = 0; index < sums.size(); ++index) {
    const glm::dvec3 node(static_cast<double>(index % 9) / 8, static_cast<double>(index / 9 % 7) / 6,
                          static_cast<double>(index / 63) / 11);
    // Sums of 64 products in another order, in double precision.
    CHECK(glm::length(sums[index] - evaluate(spline, low + node * (high - low))) < 1e-13);
  }
}

TEST_CASE("a multilevel B-spline is ITK's BSplineScatteredDataPointSetToImageFilter") {
  using Vector = itk::Vector<double, 3>;
  using Image = itk::Image<Vector, 3>;
  using Points = itk::PointSet<Vector, 3>;
  using Filter = itk::BSplineScatteredDataPointSetToImageFilter<Points, Image>;
  const std::vector<glm::dvec3> at = random_points(20);
  const std::vector<glm::dvec3> values = random_points(20);
  const auto points = Points::New();
  for (std::size_t i = 0; i < at.size(); ++i) {
    points->SetPoint(i, itk::Point<double, 3>(&at[i].x));
    points->SetPointData(i, Vector(&values[i].x));
  }
  constexpr int n = 9;
  const auto filter = Filter::New();
  filter->SetInput(points);
  Image::SizeType size;
  size.Fill(n);
  Image::SpacingType spacing;
  spacing.Fill(1.0 / (n - 1));
  filter->SetSize(size);
  filter->SetSpacing(spacing);
  filter->SetSplineOrder(3);
  Filter::ArrayType controls;
  controls.Fill(4); // one span
  filter->SetNumberOfControlPoints(controls);
  constexpr std::size_t levels = 4;
  filter->SetNumberOfLevels(levels);
  filter->Update();
  const MultilevelBSpline spline = fit_multilevel_bspline(at, values, glm::dvec3(0), glm::dvec3(1), levels);
  double largest = 0;
  itk::ImageRegionConstIteratorWithIndex<Image> pixel(filter->GetOutput(),
                                                      filter->GetOutput()->GetBufferedRegion());
  for (; !pixel.IsAtEnd(); ++pixel) {
    const auto i = pixel.GetIndex();
    if (i[0] + 1 == n || i[1] + 1 == n || i[2] + 1 == n)
      continue; // ITK takes points on the far faces a thousandth of a span inside
    const glm::dvec3 p = glm::dvec3(i[0], i[1], i[2]) / (n - 1.0);
    const Vector v = pixel.Get();
    largest = std::max(largest, glm::length(evaluate(spline, p) - glm::dvec3(v[0], v[1], v[2])));
  }
  INFO("largest difference " << largest);
  CHECK(largest < 2e-4); // ITK computes in float, and its errors add up over the levels
}

TEST_CASE("landmarks: the map carries targets to sources, by both methods and in both spaces") {
  const Box box = make_box({20, 40, 10}, {2, 0.5, 3}, {10, -20, 30},
                           glm::dmat3(glm::rotate(glm::dmat4(1), 0.7, glm::normalize(glm::dvec3(1, 2, 3)))));
  const BoxSpace space = box_space(box);
  Landmarks landmarks = moved_inside(6);
  Landmarks in_world = landmarks;
  in_world.space = LandmarkSpace::world;
  for (LandmarkPair& pair : *in_world.pairs) {
    for (glm::dvec3& p : pair)
      p = world_from_texture(box, p);
  }
  for (const LandmarkMethod method : {LandmarkMethod::tps, LandmarkMethod::bspline}) {
    landmarks.method = in_world.method = method;
    landmarks.levels = in_world.levels = 7;
    validate(landmarks);
    const LandmarkReport report = landmark_report(in_world, space);
    CHECK(report.count == 14);
    CHECK(report.largest < 1e-5);
    CHECK(report.rms <= report.largest);
    CHECK(report.grid_largest < 0.02 * space.longest); // a grid of 64 nodes rounds the tips of U(r) = r
    const GridMap map = landmark_map(landmarks, space);
    const GridMap from_world = landmark_map(in_world, space);
    for (int i = 0; i < 200; ++i) {
      const glm::dvec3 p = box_from_texture(space, random_points(1)[0]);
      CHECK(glm::length(texture_from_object(map, p) - texture_from_object(from_world, p)) < 1e-6);
    }
    CHECK(glm::all(glm::lessThanEqual(map.grid->low, glm::dvec3(1e-9))));
    CHECK(glm::all(glm::greaterThanEqual(map.grid->high, space.size - 1e-9)));
  }
}

TEST_CASE("landmarks that move the volume as a whole show it where they say") {
  Landmarks landmarks = moved_inside(0);
  for (LandmarkPair& pair : *landmarks.pairs)
    pair[1] += glm::dvec3(0.4, 0, -0.3);
  const GridMap map = landmark_map(landmarks, BoxSpace{});
  CHECK(glm::length(texture_from_object(map, glm::dvec3(1.2, 0.5, 0)) - glm::dvec3(0.8, 0.5, 0.3)) < 1e-6);
  CHECK(map.grid->high.x >= 1.4);
  CHECK(map.grid->low.z <= -0.3);
  CHECK(map.grid->low.x > 0.2); // and no farther than needed
}

TEST_CASE("landmarks: contradictions, lines and planes are named") {
  const auto with = [](const std::vector<LandmarkPair>& pairs) {
    Landmarks landmarks;
    landmarks.pairs = pairs;
    return landmarks;
  };
  const glm::dvec3 o(0);
  const glm::dvec3 x(1, 0, 0);
  const glm::dvec3 y(0, 1, 0);
  const glm::dvec3 z(0, 0, 1);
  CHECK_THROWS_WITH(validate(with({})), Catch::Contains("not a single"));
  CHECK_THROWS_WITH(validate(with({{o, o}})), Catch::Contains("at least 4") && Catch::Contains("one point"));
  CHECK_THROWS_WITH(validate(with({{o, o}, {x, x}, {2.0 * x, 2.0 * x}, {3.0 * x, 3.0 * x}})),
                    Catch::Contains("one line"));
  CHECK_THROWS_WITH(validate(with({{o, o}, {x, x}, {y, y}, {x + y, x + y}})), Catch::Contains("one plane"));
  CHECK_THROWS_WITH(validate(with({{o, o}, {x, x}, {y, y}, {x + y, z}})), Catch::Contains("sources"));
  CHECK_THROWS_WITH(validate(with({{o, o}, {x, x}, {y, y}, {z, z}, {o, x + y}})),
                    Catch::Contains("1 and 5") && Catch::Contains("two targets"));
  CHECK_THROWS_WITH(validate(with({{o, o}, {x, x}, {y, y}, {z, z}, {x + y, z}})),
                    Catch::Contains("4 and 5") && Catch::Contains("two sources"));
  Landmarks twice = with({{o, o}, {x, x}, {y, y}, {z, z}, {y, y}});
  CHECK_NOTHROW(validate(twice));
  CHECK(landmark_report(twice, BoxSpace{}).duplicates == 1);
  Landmarks flat = with({{o, o}, {x, x + 0.1 * y}, {y, y}});
  flat.method = LandmarkMethod::bspline;
  CHECK_NOTHROW(validate(flat));
  CHECK_THROWS_AS(validate(Landmarks{}), UsageError);
  Landmarks both = flat;
  both.file = "a.csv";
  CHECK_THROWS_WITH(validate(both), Catch::Contains("one of file"));
  Landmarks half;
  half.source = "a.csv";
  CHECK_THROWS_AS(validate(half), UsageError);
  flat.stiffness = 1;
  CHECK_THROWS_WITH(validate(flat), Catch::Contains("stiffness"));
  flat.stiffness = 0;
  flat.levels = 9;
  CHECK_THROWS_WITH(validate(flat), Catch::Contains("1 to 8"));
  flat.levels = 3;
  flat.resolution = 200;
  CHECK_THROWS_WITH(validate(flat), Catch::Contains("8 to 128"));
  CHECK_THROWS_WITH(validate(with(std::vector<LandmarkPair>(2001, {o, o}))), Catch::Contains("2000"));
}
