// Two tables of an 8-texel axis worked out by hand, as bit patterns of floats.
//
// Texel j sits at x = (2j + 1)/16: 1/16, 3/16, 5/16, 7/16, and mirrored. Highlight about 1/2, linear: 1 −
// 2|1/2 − x| = 1/8, 3/8, 5/8, 7/8.
#pragma once

#include "catch.h"
#include "warp/axis_tables.h"

#include <cstdint>
#include <cstring>

namespace axis_table_bytes {

using namespace slicelens;

/// R, G, B, A.
struct TexelBits {
  std::uint32_t offset;
  std::uint32_t mask;
  std::uint32_t attenuation;
  std::uint32_t highlight;
};

inline constexpr std::uint32_t one = 0x3F800000;
inline constexpr std::uint32_t minus = 0x80000000;

inline void check_bits(const std::vector<glm::vec4>& texels, const std::vector<TexelBits>& expected) {
  REQUIRE(texels.size() == expected.size());
  for (std::size_t j = 0; j < texels.size(); ++j) {
    TexelBits bits{};
    static_assert(sizeof bits == sizeof texels[j]);
    std::memcpy(&bits, &texels[j], sizeof bits);
    // A zero offset may have either sign.
    bits.offset = bits.offset == minus ? 0 : bits.offset;
    INFO("texel " << j << std::hex << ": " << bits.offset << " " << bits.mask << " " << bits.attenuation
                  << " " << bits.highlight);
    CHECK(bits.offset == expected[j].offset);
    CHECK(bits.mask == expected[j].mask);
    CHECK(bits.attenuation == expected[j].attenuation);
    CHECK(bits.highlight == expected[j].highlight);
  }
}

/// Data [3/8, 5/8] shown in [1/4, 3/4]: slopes 3/2, 1/2, 3/2.
inline Warp bifocal_example() {
  return Bifocal{ranges_of(glm::dvec3(0.375), glm::dvec3(0.625)),
                 ranges_of(glm::dvec3(0.25), glm::dvec3(0.75))};
}

/// u(1/16) = 3/32, u(3/16) = 9/32, u(5/16) = 3/8 + 1/32 = 13/32, u(7/16) = 3/8 + 3/32 = 15/32: offsets 1/32,
/// 3/32, 3/32, 1/32. Attenuation, linear: x/(1/4) = 1/4, 3/4, then 1.
inline std::vector<TexelBits> bifocal_bits() {
  return {
      {0x3D000000, one, 0x3E800000, 0x3E000000},         // 1/32, 1, 1/4, 1/8
      {0x3DC00000, one, 0x3F400000, 0x3EC00000},         // 3/32, 1, 3/4, 3/8
      {0x3DC00000, one, one, 0x3F200000},                // 3/32, 1, 1, 5/8
      {0x3D000000, one, one, 0x3F600000},                // 1/32, 1, 1, 7/8
      {minus | 0x3D000000, one, one, 0x3F600000},        // and mirrored
      {minus | 0x3DC00000, one, one, 0x3F200000},        //
      {minus | 0x3DC00000, one, 0x3F400000, 0x3EC00000}, //
      {minus | 0x3D000000, one, 0x3E800000, 0x3E000000}, //
  };
}

/// c = 1/2, i = 1/8, o = 3/8, m = 2: focus region [3/8, 5/8] on display.
inline Warp lens_example() { return VolumeLens{{glm::dvec3(0.5), glm::dvec3(0.125), glm::dvec3(0.375), 2}}; }

/// δ = |x − 1/2| = 7/16 ≥ o: offset and mask 0. δ = 5/16: s = 3/16, bend (3/8)(1/2)/(1/16) = 3, so 1/16 +
/// 3/32 + 3·9/256 = 67/256: 13/256 less. δ = 3/16: s = 1/16: 1/16 + 1/32 + 3/256 = 27/256: 21/256 less. δ =
/// 1/16: 1/32: 1/32 less. Attenuation, linear: x/(3/8) = 1/6, 1/2, 5/6, then 1; 1/6 and 5/6 are the floats
/// next to them.
inline std::vector<TexelBits> lens_bits() {
  return {
      {0, 0, 0x3E2AAAAB, 0x3E000000},             // 0, 0, 1/6, 1/8
      {0x3D500000, one, 0x3F000000, 0x3EC00000},  // 13/256 = 1.625/32, 1, 1/2, 3/8
      {0x3DA80000, one, 0x3F555555, 0x3F200000},  // 21/256 = 1.3125/16, 1, 5/6, 5/8
      {0x3D000000, one, one, 0x3F600000},         // 1/32, 1, 1, 7/8
      {minus | 0x3D000000, one, one, 0x3F600000}, // and mirrored
      {minus | 0x3DA80000, one, 0x3F555555, 0x3F200000},
      {minus | 0x3D500000, one, 0x3F000000, 0x3EC00000},
      {0, 0, 0x3E2AAAAB, 0x3E000000},
  };
}

} // namespace axis_table_bytes
