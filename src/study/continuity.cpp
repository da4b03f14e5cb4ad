#include "study/continuity.h"

#include "core/errors.h"
#include "core/text.h"
#include "volume/streamed.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <new>
#include <string>
#include <type_traits>

namespace slicelens {

using glm::dvec3;

namespace {

bool in_unit_cube(const dvec3& t) {
  return t.x >= 0 && t.x <= 1 && t.y >= 0 && t.y <= 1 && t.z >= 0 && t.z <= 1;
}

/// Component 0 of voxel number `index`.
template <class T>
double scalar(const Volume& volume, std::size_t index) {
  T value;
  std::memcpy(&value, volume.voxels.data() + index * static_cast<std::size_t>(volume.components) * sizeof(T),
              sizeof(T));
  return static_cast<double>(value);
}

template <class T>
double trilinear_of(const Volume& volume, const dvec3& t) {
  std::size_t low[3];
  std::size_t high[3];
  double f[3];
  for (int a = 0; a < 3; ++a) {
    const std::size_t n = volume.dims[static_cast<std::size_t>(a)];
    const double x = std::clamp(t[a] * static_cast<double>(n) - 0.5, 0.0, static_cast<double>(n - 1));
    low[a] = static_cast<std::size_t>(x);
    high[a] = std::min(low[a] + 1, n - 1);
    f[a] = x - static_cast<double>(low[a]);
  }
  const auto along_x = [&](std::size_t j, std::size_t k) {
    const std::size_t row = (k * volume.dims[1] + j) * volume.dims[0];
    const double v = scalar<T>(volume, row + low[0]);
    return v + f[0] * (scalar<T>(volume, row + high[0]) - v);
  };
  const double near = along_x(low[1], low[2]) * (1 - f[1]) + along_x(high[1], low[2]) * f[1];
  const double far = along_x(low[1], high[2]) * (1 - f[1]) + along_x(high[1], high[2]) * f[1];
  return near * (1 - f[2]) + far * f[2];
}

template <class T>
bool shows(const Volume& volume, const TextureMap& u, double threshold, const dvec3& p) {
  const dvec3 t = u(p);
  return in_unit_cube(t) && trilinear_of<T>(volume, t) >= threshold;
}

void check_threshold(double threshold) {
  if (!std::isfinite(threshold))
    throw UsageError("threshold must be a finite number");
}

void check_region(const Region& region, std::size_t n) {
  for (int a = 0; a < 3; ++a) {
    if (!(std::isfinite(region.low[a]) && std::isfinite(region.high[a]) && region.low[a] < region.high[a]))
      throw UsageError("region must reach from a lower to a higher finite number on each axis, not from " +
                       number_text(region.low[a]) + " to " + number_text(region.high[a]));
  }
  if (n < 2)
    throw UsageError("a grid needs at least 2 points on each axis, not " + std::to_string(n));
}

void check_step(double step) {
  if (!(std::isfinite(step) && step > 0))
    throw UsageError("step must be a finite number above 0, not " + number_text(step));
}

/// Point number (i, j, k) of n³ with the region's corners among them.
dvec3 grid_point(const Region& region, std::size_t n, std::size_t i, std::size_t j, std::size_t k) {
  const dvec3 f = dvec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)) /
                  static_cast<double>(n - 1);
  return region.low + f * (region.high - region.low);
}

/// From p along an axis over `length`, halved where u changes more.
Jump jump_between(const TextureMap& u, dvec3 p, int axis, double length, double step) {
  const auto at = [&](double offset) {
    dvec3 q = p;
    q[axis] += offset;
    return q;
  };
  double from = 0;
  dvec3 u0 = u(p);
  dvec3 u1 = u(at(length));
  while (length > step) {
    length /= 2;
    const dvec3 middle = u(at(from + length));
    if (glm::length(middle - u0) < glm::length(u1 - middle)) {
      from += length;
      u0 = middle;
    } else {
      u1 = middle;
    }
  }
  return {glm::length(u1 - u0), at(from), axis, length};
}

Jump larger(const Jump& a, const Jump& b) { return b.size > a.size ? b : a; }

Determinant smaller(const Determinant& a, const Determinant& b) {
  return b.value < a.value || std::isnan(b.value) ? b : a;
}

/// SplitMix64 (Steele, Lea and Flood 2014): number `index` of a fixed sequence in [0,1).
double sequence(std::uint64_t index) {
  std::uint64_t z = (index + 1) * 0x9e3779b97f4a7c15ULL;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

} // namespace

TextureMap undeformed() {
  return [](const dvec3& p) { return p; };
}

double trilinear(const Volume& volume, const dvec3& t) {
  return visit_scalar_type(
      volume.type, [&](auto* tag) { return trilinear_of<std::remove_pointer_t<decltype(tag)>>(volume, t); });
}

VoxelMask displayed_mask(const Volume& volume, const TextureMap& u, double threshold,
                         const std::array<std::size_t, 3>& dims) {
  check_threshold(threshold);
  require_voxels(volume, "displayed mask");
  if (*std::min_element(dims.begin(), dims.end()) == 0)
    throw UsageError("displayed mask: every size must be at least 1");
  VoxelMask mask{dims, {}};
  const auto [nx, ny, nz] = dims;
  const std::size_t rows = checked_product(ny, nz, "displayed mask");
  const std::size_t count = checked_product(nx, rows, "displayed mask");
  if (count > max_mask_voxels) {
    throw LimitError("displayed mask of " + std::to_string(nx) + " x " + std::to_string(ny) + " x " +
                     std::to_string(nz) + " voxels is too large; take at most " +
                     std::to_string(max_mask_voxels) + " in all");
  }
  mask.voxels.resize(count);
  const dvec3 n(static_cast<double>(nx), static_cast<double>(ny), static_cast<double>(nz));
  visit_scalar_type(volume.type, [&](auto* tag) {
    using T = std::remove_pointer_t<decltype(tag)>;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, rows, 8), [&](const auto& range) {
      for (std::size_t r = range.begin(); r != range.end(); ++r) {
        for (std::size_t i = 0; i < dims[0]; ++i) {
          const dvec3 voxel(static_cast<double>(i), static_cast<double>(r % dims[1]),
                            static_cast<double>(r / dims[1]));
          mask.voxels[r * dims[0] + i] = shows<T>(volume, u, threshold, (voxel + 0.5) / n) ? 1 : 0;
        }
      }
    });
  });
  return mask;
}

Jump largest_jump(const TextureMap& u, const Region& region, std::size_t n, double step) {
  check_region(region, n);
  check_step(step);
  const dvec3 cell = (region.high - region.low) / static_cast<double>(n - 1);
  const auto rows = tbb::blocked_range<std::size_t>(0, checked_product(n, n, "grid of points"), 8);
  return tbb::parallel_deterministic_reduce(
      rows, Jump{},
      [&](const auto& range, Jump largest) {
        for (std::size_t r = range.begin(); r != range.end(); ++r) {
          for (std::size_t i = 0; i < n; ++i) {
            const std::size_t index[3] = {i, r % n, r / n};
            const dvec3 p = grid_point(region, n, index[0], index[1], index[2]);
            for (int axis = 0; axis < 3; ++axis) {
              if (index[axis] + 1 < n)
                largest = larger(largest, jump_between(u, p, axis, cell[axis], step));
            }
          }
        }
        return largest;
      },
      larger);
}

Determinant smallest_determinant(const JacobianMap& jacobian, const Region& region, std::size_t n,
                                 std::size_t random) {
  check_region(region, n);
  const auto at = [&](const dvec3& p) { return Determinant{glm::determinant(jacobian(p)), p}; };
  const std::size_t grid = checked_product(checked_product(n, n, "grid of points"), n, "grid of points");
  const auto points = tbb::blocked_range<std::size_t>(0, grid + random, 1024);
  return tbb::parallel_deterministic_reduce(
      points, at(region.low),
      [&](const auto& range, Determinant smallest) {
        for (std::size_t q = range.begin(); q != range.end(); ++q) {
          const std::uint64_t s = 3 * (q - std::min(q, grid));
          const dvec3 f(sequence(s), sequence(s + 1), sequence(s + 2));
          smallest = smaller(smallest, at(q < grid ? grid_point(region, n, q % n, q / n % n, q / n / n)
                                                   : region.low + f * (region.high - region.low)));
        }
        return smallest;
      },
      smaller);
}

double Crossing::continued() const {
  const std::size_t either = inside + outside - both;
  return either == 0 ? 1 : static_cast<double>(both) / static_cast<double>(either);
}

Crossing face_crossing(const Volume& volume, const TextureMap& u, double threshold, const Region& box,
                       std::size_t n, double step) {
  check_threshold(threshold);
  check_region(box, n);
  check_step(step);
  Crossing crossing;
  for (int axis = 0; axis < 3; ++axis) {
    for (std::size_t q = 0; q < 2 * n * n; ++q) {
      const bool top = q >= n * n;
      // Points of a face are cell centres, so that edges, where three sides meet, are left out.
      dvec3 f((static_cast<double>(q % n) + 0.5) / static_cast<double>(n));
      f[(axis + 1) % 3] = (static_cast<double>(q / n % n) + 0.5) / static_cast<double>(n);
      f[axis] = top ? 1 : 0;
      dvec3 in = box.low + f * (box.high - box.low);
      dvec3 out = in;
      in[axis] += top ? -step : step;
      out[axis] += top ? step : -step;
      const auto seen = [&](const dvec3& p) {
        const dvec3 t = u(p);
        return in_unit_cube(p) && in_unit_cube(t) && trilinear(volume, t) >= threshold;
      };
      const bool a = seen(in);
      const bool b = seen(out);
      crossing.inside += a ? 1 : 0;
      crossing.outside += b ? 1 : 0;
      crossing.both += a && b ? 1 : 0;
    }
  }
  return crossing;
}

} // namespace slicelens
