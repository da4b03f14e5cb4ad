// How far it is from each cell of a grid to the nearest one that holds something: what a ray may leap over.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace slicelens {

/// The largest distance that is told from larger ones: leaps that long are so few that their cost does not
/// show.
inline constexpr std::uint8_t farthest_distance = 15;

/// For each cell, x fastest, the chessboard distance in cells to the nearest with holds[i] ≠ 0: the largest
/// of the three differences of their numbers. 0 where it holds something itself, at most farthest_distance,
/// which also stands where nothing does. All cells whose distance from a cell is less than its number are
/// empty. All cores.
std::vector<std::uint8_t> empty_distances(const std::array<std::size_t, 3>& size,
                                          std::span<const std::uint8_t> holds);

} // namespace slicelens
