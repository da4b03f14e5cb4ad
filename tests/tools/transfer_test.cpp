// The commands transfer and camera, and scenes that read their files, as users run them.
#include "catch.h"
#include "program.h"

TEST_CASE("a preset goes through three programs' formats and comes back the same") {
  const Workplace place;
  CHECK(place.run({"transfer", "opaque", "--range", "-5,9.5", "-o", "a.json"}).status == 0);
  CHECK(place.run({"transfer", "a.json", "-o", "a.vp"}).status == 0);
  CHECK(place.run({"transfer", "a.vp", "-o", "a.vp.json"}).status == 0);
  const Outcome first = place.run({"transfer", "opaque", "--range", "-5,9.5"});
  const Outcome last = place.run({"transfer", "a.vp.json"});
  CHECK(first.status == 0);
  CHECK(first.err.empty());
  CHECK(first.out.find("{\"transfer\":{\"points\":[[2.25,0.8,0.45,0.3,0.0],[2.25,0.8,0.45,0.3,1.0],") == 0);
  CHECK(last.out == first.out);
  const Outcome table = place.run({"transfer", "a.vp", "-o", "a.1dt", "--rows", "16"});
  CHECK(table.status == 0);
  CHECK(table.err.find("a.1dt: the format does not hold the values of its 16 rows") != std::string::npos);
}

TEST_CASE("scenes with files render as those with the same points and angles, and hold them") {
  const Workplace place;
  const std::string common =
      R"("volume": {"phantom": "ball", "size": [16, 16, 16]}, "render": {"size": [24, 24]})";
  put(place / "plain.json",
      "{" + common + R"(, "transfer": {"preset": "opaque"}, "camera": {"azimuth": 30, "zoom": 1.5}})");
  put(place / "files.json",
      "{" + common + R"(, "transfer": {"file": "t.vp"}, "camera": {"file": "c.pvcc"}})");
  CHECK(place.run({"transfer", "plain.json", "-o", "t.vp"}).status == 0);
  CHECK(place.run({"camera", "plain.json", "-o", "c.pvcc"}).status == 0);
  CHECK(place.run({"render", "plain.json", "-o", "plain.png"}).status == 0);
  const Outcome files = place.run({"render", "files.json", "-o", "files.png"});
  INFO(files.err);
  CHECK(files.status == 0);
  fs::remove(place / "t.vp");
  fs::remove(place / "c.pvcc");
  CHECK(place.run({"render", "files.png", "-o", "again.png"}).status == 0);
  for (const char* picture : {"files.png", "again.png"}) {
    const Outcome same = place.run({"compare", "plain.png", picture});
    INFO(same.out);
    CHECK(same.out.find("\"max_abs\": 0.0,") != std::string::npos);
  }
}

TEST_CASE("of a scene of several volumes, --volume says whose transfer function is written") {
  const Workplace place;
  put(place / "two.json",
      R"({"volumes": [{"phantom": "ball", "size": [8, 8, 8], "transfer": {"points": [[1, 1, 0, 0, 0.25]]}},
      {"phantom": "box", "size": [4, 4, 4], "transfer": {"points": [[2, 0, 1, 0, 0.5]], "unit_distance": 3}}]})");
  const std::string first = "{\"transfer\":{\"points\":[[1.0,1.0,0.0,0.0,0.25]]}}\n";
  CHECK(place.run({"transfer", "two.json"}).out == first);
  CHECK(place.run({"transfer", "two.json", "--volume", "0"}).out == first);
  CHECK(place.run({"transfer", "two.json", "--volume", "1"}).out ==
        "{\"transfer\":{\"points\":[[2.0,0.0,1.0,0.0,0.5]],\"unit_distance\":3.0}}\n");
  const Outcome third = place.run({"transfer", "two.json", "--volume", "2"});
  CHECK(third.status == 2);
  CHECK(third.err.find("--volume 2: the scene has 2 volume(s), counted from 0") != std::string::npos);
  const Outcome preset = place.run({"transfer", "CT-Bone", "--volume", "1"});
  CHECK(preset.status == 2);
  CHECK(preset.err.find("--volume chooses among a scene's volumes, and CT-Bone is none") !=
        std::string::npos);
}

TEST_CASE("what cannot be converted is refused in one line") {
  const Workplace place;
  const auto refused = [&](const std::vector<std::string>& arguments, int status, const std::string& text) {
    const Outcome outcome = place.run(arguments);
    INFO(outcome.err);
    CHECK(outcome.status == status);
    CHECK(outcome.err.find(text) != std::string::npos);
    CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
  };
  put(place / "broken.vp", "1\n1\n");
  put(place / "broken.json", "[{\"RGBPoints\": [1]}]");
  refused({"transfer", "broken.vp"}, 1, "broken.vp: line 3 (diffuse) is missing");
  refused({"transfer", "broken.json"}, 1, "'RGBPoints' must be a list of 4 numbers");
  refused({"transfer", "CT-Bone", "-o", "a.xml"}, 2, "a.xml: cannot be written");
  refused({"transfer", "CT-Bone", "-o", "a.1dt", "--range", "3,3"}, 2, "--range takes LOW,HIGH");
  refused({"transfer", "CT-Bone", "--map", "x"}, 2, "--map names a colour map");
  refused({"transfer", "missing.vp"}, 1, "missing.vp");
  refused({"render", "broken.json"}, 2, "a scene is a JSON object");
  CHECK(place.run({"list", "labels"}).out.find("   11              110  liver\n") != std::string::npos);
}
