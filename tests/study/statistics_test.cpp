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

TEST_CASE("the median's interval by order statistics") {
  // n = 6: P(B = 0) = 1/64, so [x_1, x_6] holds the median with 62/64 = .96875; P(B ≤ 1) = 7/64: .78125.
  const std::vector<double> six = {3, 1, 6, 2, 5, 4};
  const auto whole = median_interval(six, 0.95);
  REQUIRE(whole);
  CHECK(whole->low == 1);
  CHECK(whole->high == 6);
  CHECK(whole->confidence == 0.96875);
  const auto inner = median_interval(six, 0.78);
  REQUIRE(inner);
  CHECK(inner->low == 2);
  CHECK(inner->high == 5);
  CHECK(inner->confidence == 0.78125);
  CHECK(median_interval(six, 0.78125)->low == 2); // just reached
  CHECK(median_interval(six, 0.7813)->low == 1);
  // n = 10, tables of order statistics: k = 2 gives 1 − 2·11/1024 = .978516, k = 3: 1 − 2·56/1024 = .890625
  std::vector<double> ten;
  for (int i = 10; i > 0; --i)
    ten.push_back(i);
  const auto of_ten = median_interval(ten, 0.95);
  REQUIRE(of_ten);
  CHECK(of_ten->low == 2);
  CHECK(of_ten->high == 9);
  CHECK(of_ten->confidence == Approx(0.978515625).epsilon(1e-14));
  // five values reach 1 − 2/32 = .9375 at most
  CHECK_FALSE(median_interval({1, 2, 3, 4, 5}, 0.95));
  CHECK_FALSE(median_interval({1}, 0.5));
  // Of 1000 the normal approximation gives k ≈ 500 − 1.96·√1000/2 + 1/2 = 469.5: x_469, x_532.
  std::vector<double> many;
  for (int i = 1; i <= 1000; ++i)
    many.push_back(i);
  CHECK(median_interval(many, 0.95)->low == 469);
  CHECK(median_interval(many, 0.95)->high == 532);
  // and of 10000, whose 2^-10000 is no double: 5000 − 98 + 1/2 = 4902.5
  while (many.size() < 10000)
    many.push_back(static_cast<double>(many.size() + 1));
  CHECK(median_interval(many, 0.95)->low == 4902);
  CHECK_THROWS_AS(median_interval(six, 1), UsageError);
  CHECK_THROWS_AS(median_interval({}, 0.9), UsageError);
}

TEST_CASE("how many repetitions a confidence needs") {
  CHECK(smallest_repetitions(0.95) == 6); // 1 − 2^-5 = .96875
  CHECK(smallest_repetitions(0.99) == 8); // 1 − 2^-7 = .9921875
  CHECK(smallest_repetitions(0.5) == 2);
  CHECK_THROWS_AS(smallest_repetitions(0), UsageError);
  CHECK(repetitions_needed({10, 10, 10}, 0.01) == 6);
  // interval [9, 11] about 10: half-width a tenth
  const std::vector<double> six = {9, 9.5, 10, 10, 10.5, 11};
  CHECK(repetitions_needed(six, 0.125) == 6);
  CHECK(repetitions_needed(six, 0.05) == 24); // a half: four times as many
  CHECK_THROWS_AS(repetitions_needed(six, 0), UsageError);
  CHECK_THROWS_AS(repetitions_needed({0, 0, 0, 0, 0, 0}, 0.1), UsageError);
}

TEST_CASE("ratios are taken pair by pair, and a drift that both share leaves them") {
  CHECK(minimum({3, 1, 2}) == 1);
  CHECK_THROWS_AS(minimum({}), UsageError);
  const PairedRatios drift = paired_ratios({2, 4, 8, 16}, {1, 2, 4, 8});
  CHECK(drift.ratios == std::vector<double>{2, 2, 2, 2});
  CHECK(drift.quartiles.first == 2);
  CHECK(drift.quartiles.third == 2);
  // 1, 2, 3, 3, 5 in order; the ratio of the medians would be 5/2
  const PairedRatios mixed = paired_ratios({5, 2, 6, 4, 15}, {1, 1, 2, 4, 5});
  CHECK(mixed.ratios == std::vector<double>{5, 2, 3, 1, 3});
  CHECK(mixed.quartiles.first == 2);
  CHECK(mixed.quartiles.median == 3);
  CHECK(mixed.quartiles.third == 3);
  CHECK_THROWS_AS(paired_ratios({1}, {1, 2}), UsageError);
  CHECK_THROWS_AS(paired_ratios({1}, {0}), UsageError);
  CHECK_THROWS_AS(paired_ratios({}, {}), UsageError);
}

TEST_CASE("a fitted exponent with its standard error and R squared") {
  // In log₂: x = 0, 1, 2 and y = 0, 0, 3. Slope 3/2, intercept −1/2, residuals 1/2, −1, 1/2: Σr² = 3/2. Σ(x −
  // 1)² = 2, so the error is √(3/2 / 1 / 2) = √(3/4); Σ(y − 1)² = 6, so R² = 1 − 1/4. The base does not
  // matter.
  const PowerFit fit = fitted_power({1, 2, 4}, {1, 1, 8});
  CHECK(fit.exponent == Approx(1.5));
  CHECK(fit.factor == Approx(std::pow(2.0, -0.5)));
  REQUIRE(fit.standard_error);
  CHECK(*fit.standard_error == Approx(std::sqrt(0.75)));
  REQUIRE(fit.r_squared);
  CHECK(*fit.r_squared == Approx(0.75));
  const PowerFit exact = fitted_power({1, 2, 4, 8}, {3, 12, 48, 192}); // 3·x²
  CHECK(exact.exponent == Approx(2));
  CHECK(exact.factor == Approx(3));
  CHECK(*exact.standard_error == Approx(0).margin(1e-12));
  CHECK(*exact.r_squared == Approx(1));
  const PowerFit two = fitted_power({1, 4}, {1, 2});
  CHECK(two.exponent == Approx(0.5));
  CHECK_FALSE(two.standard_error);
  CHECK(*two.r_squared == Approx(1));
  const PowerFit flat = fitted_power({1, 2, 4}, {7, 7, 7});
  CHECK(flat.exponent == Approx(0).margin(1e-12));
  CHECK_FALSE(flat.r_squared);
  CHECK_THROWS_AS(fitted_power({1, 1}, {1, 2}), UsageError);
}
