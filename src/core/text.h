// Small text helpers shared by readers, scene parsing and error messages.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace slicelens {

/// The entry of `candidates` with the smallest edit distance to `word` (ties: the first), or nothing when
/// none is near enough (distance above half the longer length) to be worth proposing.
std::optional<std::string> nearest_word(std::string_view word, const std::vector<std::string>& candidates);

/// "a, b, c"
std::string join(const std::vector<std::string>& words, std::string_view separator = ", ");

/// Orders file names as people do: digit runs compare as numbers, so slice2 comes before slice10. Total
/// order.
bool natural_less(std::string_view a, std::string_view b);

/// ASCII lower case.
std::string lower(std::string_view text);

/// The shortest text that reads back as the same double ("0.1", "1e-05", "nan").
std::string number_text(double value);

} // namespace slicelens
