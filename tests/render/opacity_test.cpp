// shaders/lib/opacity.glsl compiled as C++, in float and in double, against the standard library in long
// double.
#include "catch.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace opacity_f {
using real = float;
using std::exp;
using std::log;
using std::max;
#include "lib/opacity.glsl"
} // namespace opacity_f

namespace opacity_d {
using real = double;
using std::exp;
using std::log;
using std::max;
#include "lib/opacity.glsl"
} // namespace opacity_d

namespace {

long double truth(long double alpha, long double ratio) { return -std::expm1(ratio * std::log1p(-alpha)); }

/// Opacities from 1e-8 to just below 1, dense around the switch of the series at .3.
std::vector<double> alphas() {
  std::vector<double> list;
  for (double decade = -8; decade < 0; decade += 0.0625)
    list.push_back(std::pow(10.0, decade));
  for (double a = 0.29; a < 0.31; a += 0.0005)
    list.push_back(a);
  for (double a = 0.01; a < 1; a += 0.01)
    list.push_back(a);
  for (double rest = 0.01; rest > 1e-6; rest /= 3)
    list.push_back(1 - rest);
  return list;
}

const std::vector<double> ratios = {1e-4, 1e-3, 0.01, 0.1, 0.25, 0.5, 0.9, 1, 1.1547, 2, 4, 16, 100};

/// Largest relative error over all pairs.
template <class Real, class Function>
double largest_error(const Function& corrected) {
  double largest = 0;
  for (const double a : alphas()) {
    for (const double r : ratios) {
      const Real alpha = static_cast<Real>(a);
      const Real ratio = static_cast<Real>(r);
      const long double expected = truth(alpha, ratio);
      const long double error = std::abs(static_cast<long double>(corrected(alpha, ratio)) - expected);
      largest = std::max(largest, static_cast<double>(error / expected));
    }
  }
  return largest;
}

} // namespace

TEST_CASE("corrected opacity in double precision") {
  // The logarithm's series ends at z¹³ with z ≤ .3/1.7: what is left out is z¹⁴/15 = 2e-12.
  CHECK(largest_error<double>(opacity_d::corrected_opacity) < 5e-12);
}

TEST_CASE("corrected opacity in float") {
  // A dozen roundings of 6e-8 each, and log(1 − α) just above .3, where 1 − α is rounded: 3e-8/.36.
  CHECK(largest_error<float>(opacity_f::corrected_opacity) < 1e-6);
}

TEST_CASE("nothing stays nothing and opaque stays opaque") {
  for (const double r : ratios) {
    CHECK(opacity_d::corrected_opacity(0, r) == 0);
    CHECK(opacity_d::corrected_opacity(1, r) == 1);
    CHECK(opacity_f::corrected_opacity(0, static_cast<float>(r)) == 0);
    CHECK(opacity_f::corrected_opacity(1, static_cast<float>(r)) == 1);
  }
}

TEST_CASE("tiny and huge ratios") {
  // To first order α' = r·log1p(−α)/−1 for tiny r.
  CHECK(opacity_d::corrected_opacity(0.5, 1e-12) == Approx(1e-12 * std::log(2.0)).epsilon(1e-10));
  CHECK(opacity_f::corrected_opacity(0.5F, 1e-12F) == Approx(1e-12 * std::log(2.0)).epsilon(1e-5));
  CHECK(opacity_f::corrected_opacity(1e-7F, 1e-3F) == Approx(1e-10).epsilon(1e-5));
  // Nothing exceeds 1 or turns into NaN at the other end.
  for (const float alpha : {1e-7F, 0.1F, 0.5F, 0.999999F}) {
    const float huge = opacity_f::corrected_opacity(alpha, 1e9F);
    CHECK(huge <= 1);
    CHECK(huge > 0.99F);
  }
}

TEST_CASE("correcting for two halves is correcting for the whole") {
  for (const double alpha : {1e-6, 0.01, 0.29, 0.31, 0.8, 0.999}) {
    const double half = opacity_d::corrected_opacity(alpha, 0.5);
    CHECK(half + (1 - half) * half == Approx(alpha).epsilon(1e-11));
    CHECK(opacity_d::corrected_opacity(alpha, 1) == Approx(alpha).epsilon(1e-11));
  }
}

TEST_CASE("more opacity and longer steps never hide less") {
  for (const double r : ratios) {
    double before = -1;
    std::vector<double> sorted = alphas();
    std::sort(sorted.begin(), sorted.end());
    for (const double alpha : sorted) {
      const double now = opacity_d::corrected_opacity(alpha, r);
      CHECK(now >= before * (1 - 1e-11)); // the two forms meet at α = .3 to 2e-12
      before = now;
    }
  }
}
