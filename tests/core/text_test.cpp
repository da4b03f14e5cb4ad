#include "catch.h"
#include "core/text.h"

using namespace slicelens;

TEST_CASE("nearest_word proposes a near key and nothing far-fetched") {
  const std::vector<std::string> keys = {"spacing", "shading", "size"};
  CHECK(nearest_word("spaceing", keys) == "spacing");
  CHECK(nearest_word("SIZE", keys) == "size");
  CHECK_FALSE(nearest_word("quaternion", keys).has_value());
}

TEST_CASE("natural_less compares digit runs as numbers") {
  CHECK(natural_less("slice2.png", "slice10.png"));
  CHECK_FALSE(natural_less("slice10.png", "slice2.png"));
  CHECK(natural_less("a1", "a01")); // equal numbers: a total order all the same
  CHECK_FALSE(natural_less("a01", "a1"));
  CHECK_FALSE(natural_less("x", "x"));
  CHECK(natural_less("s99999999999999999999", "s100000000000000000000")); // beyond 64 bits
}

TEST_CASE("number_text is the shortest text that reads back") {
  CHECK(number_text(0.1) == "0.1");
  CHECK(number_text(-1000) == "-1000");
}
