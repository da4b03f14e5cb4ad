#include "catch.h"
#include "core/errors.h"
#include "study/statistics.h"

#include <cmath>
#include <limits>

using namespace slicelens;

TEST_CASE("medians and quartiles of small sets") {
  CHECK(median({3}) == 3);
  CHECK(median({4, 1, 3, 2}) == 2.5);
  CHECK(median({9, 1, 5}) == 5);
  // positions .25·4 = 1 and .75·4 = 3 of the sorted values
  const Quartiles five = quartiles({5, 3, 1, 9, 7});
  CHECK(five.first == 3);
  CHECK(five.median == 5);
  CHECK(five.third == 7);
  // positions .75, 1.5, 2.25 of 1 2 4 8: 1 + .75·1, 2 + .5·2, 4 + .25·4
  const Quartiles four = quartiles({8, 4, 2, 1});
  CHECK(four.first == Approx(1.75));
  CHECK(four.median == Approx(3));
  CHECK(four.third == Approx(5));
  CHECK_THROWS_AS(median({}), UsageError);
  CHECK_THROWS_AS(quartiles({1, std::numeric_limits<double>::quiet_NaN()}), UsageError);
}

TEST_CASE("the sample standard deviation divides by n − 1") {
  // mean 5, squares 9+1+1+1+0+0+4+16 = 32, over 7
  CHECK(sample_standard_deviation({2, 4, 4, 4, 5, 5, 7, 9}) == Approx(std::sqrt(32.0 / 7)));
  CHECK(sample_standard_deviation({1, 3}) == Approx(std::sqrt(2.0)));
  CHECK(sample_standard_deviation({4, 4, 4}) == 0);
  CHECK_THROWS_AS(sample_standard_deviation({1}), UsageError);
}

TEST_CASE("the fitted order is the slope in logarithms") {
  // error = 7·h^2 exactly
  CHECK(fitted_order({1, 0.5, 0.25}, {7, 1.75, 0.4375}) == Approx(2));
  CHECK(fitted_order({1, 2}, {6, 3}) == Approx(-1));
  // log₂ h = 0, 1, 2 and log₂ e = 0, 0, 3: least squares slope (Σ(x−1)(y−1)) / 2 = (1 + 0 + 2) / 2
  CHECK(fitted_order({1, 2, 4}, {1, 1, 8}) == Approx(1.5));
  CHECK_THROWS_AS(fitted_order({1}, {1}), UsageError);
  CHECK_THROWS_AS(fitted_order({1, 2}, {1}), UsageError);
  CHECK_THROWS_AS(fitted_order({1, 2}, {1, 0}), UsageError);
  CHECK_THROWS_AS(fitted_order({0.1, 0.1, 0.1}, {1, 2, 3}), UsageError);
}
