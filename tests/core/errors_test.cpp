// Messages are one line whatever a file's name holds.
#include "catch.h"
#include "core/errors.h"

using namespace slicelens;

TEST_CASE("control characters in a message become question marks") {
  CHECK(std::string(FileError("a\nb\t\x7f.raw", "is empty").what()) == "a?b??.raw: is empty");
  CHECK(std::string(UsageError("2 \xc3\x97 3").what()) == "2 \xc3\x97 3"); // UTF-8 stays
}
