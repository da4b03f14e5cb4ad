// Documents whose tables come from results, by hand.
#include "catch.h"
#include "refusal.h"
#include "study/sweep/document_tables.h"
#include "temporary_folder.h"

using namespace slicelens;

namespace {

const char* const csv = "index,lens,status,rate,rate_q1,rate_q3\n"
                        "0,plain,done,1,1,1\n"
                        "1,\"circle, cubic\",done,0.61449,0.6,0.625\n"
                        "2,bad,failed,,,\n";

struct Results {
  TemporaryFolder folder;
  std::vector<std::string> missing;

  Results() {
    std::filesystem::create_directories(folder / "three");
    folder.put("three/results.csv", csv);
    folder.put("part.md", "# of a program\n");
  }
  std::string apply(const std::string& document) {
    return with_results(document, "doc.md", folder.path(), missing);
  }
};

} // namespace

TEST_CASE("a table is made anew between its marks and nowhere else") {
  Results results;
  const std::string document =
      "Before <!-- a comment -->\n<!-- study three: lens; rate:2 [] \"fraction\" -->\n"
      "old\n<!-- end -->\nafter\n";
  const std::string expected =
      "Before <!-- a comment -->\n<!-- study three: lens; rate:2 [] \"fraction\" -->\n\n"
      "| lens | fraction |\n| --- | ---: |\n| plain | 1.00 [1.00, 1.00] |\n"
      "| circle, cubic | 0.61 [0.60, 0.62] |\n| bad | failed |\n\n<!-- end -->\nafter\n";
  REQUIRE(results.apply(document) == expected);
  REQUIRE(results.apply(expected) == expected);
  REQUIRE(results.missing.empty());
}

TEST_CASE("a number in a line is the one that its conditions choose") {
  Results results;
  REQUIRE(results.apply("is <!-- study three: rate:3 | lens=circle, cubic -->0<!-- end --> of it") ==
          "is <!-- study three: rate:3 | lens=circle, cubic -->0.614<!-- end --> of it");
}

TEST_CASE("a program's output stands where its mark says") {
  Results results;
  REQUIRE(results.apply("<!-- output part.md -->\nold\n<!-- end -->") ==
          "<!-- output part.md -->\n\n# of a program\n\n<!-- end -->");
}

TEST_CASE("blocks without results stay and are named") {
  Results results;
  const std::string document =
      "<!-- study none: rate -->\nold\n<!-- end -->\n<!-- output none.md -->\nold\n<!-- end -->";
  REQUIRE(results.apply(document) == document);
  REQUIRE(results.missing == std::vector<std::string>{"none/results.csv", "none.md"});
}

TEST_CASE("marks that cannot be meant are refused with their line") {
  Results results;
  struct Case {
    std::string document;
    std::string says;
  };
  const std::vector<Case> cases = {
      {"\n<!-- study three: rate -->\nold", "doc.md: line 2: the mark has no end"},
      {"<!-- study three -->\n<!-- end -->", "needs columns"},
      {"<!-- study three: rat -->\n<!-- end -->", "did you mean rate?"},
      {"<!-- study three: rate | lens -->\n<!-- end -->", "no condition"},
      {"<!-- study three: rate | lens=none -->\n<!-- end -->", "no row"},
      {"<!-- study three: rate -->1<!-- end -->", "3 rows fit"},
  };
  for (const Case& one : cases) {
    INFO(one.document);
    REQUIRE(refusal([&] { (void)results.apply(one.document); }).find(one.says) != std::string::npos);
  }
}
