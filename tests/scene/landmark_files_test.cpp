// Files of landmarks: what each format means, and what is refused.
#include "catch.h"
#include "core/errors.h"
#include "scene/landmark_files.h"
#include "scene/load_warps.h"
#include "scene/scene_json.h"
#include "temporary_folder.h"

#include <filesystem>
#include <fstream>

using namespace slicelens;
namespace fs = std::filesystem;

namespace {

const std::string fcsv_columns =
    "# columns = id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,desc,associatedNodeID\n";

} // namespace

TEST_CASE("pairs of landmarks from JSON and CSV") {
  const TemporaryFolder folder;
  const std::vector<LandmarkPair> expected = {{glm::dvec3(1, 2, 3), glm::dvec3(4, 5, 6)},
                                              {glm::dvec3(-1, 0.5, 1e2), glm::dvec3(0, 0, 0)}};
  CHECK(read_landmark_pairs(folder.put("a.json", "[[[1,2,3],[4,5,6]], // moved\n [[-1,0.5,1e2],[0,0,0]]]")) ==
        expected);
  CHECK(read_landmark_pairs(folder.put("a.csv", "1,2,3,4,5,6\n-1, 0.5, 1e2, 0,0,0\n")) == expected);
  CHECK(read_landmark_pairs(folder.put(
            "b.CSV", "sx,sy,sz,tx,ty,tz\r\n# a comment\r\n1,2,3,4,5,6\r\n\r\n-1,.5,100,0,0,0")) == expected);
}

TEST_CASE("points from JSON, CSV, and 3D Slicer's lists, turned to LPS") {
  const TemporaryFolder folder;
  const std::vector<glm::dvec3> lps = {glm::dvec3(1, 2, 3), glm::dvec3(-4, 5, 6)};
  CHECK(read_points(folder.put("p.json", "[[1,2,3],[-4,5,6]]"), false) == lps);
  CHECK(read_points(folder.put("p.csv", "x,y,z\n1,2,3\n-4,5,6\n"), true) == lps);
  const std::string version = "# Markups fiducial file version = 4.11\n";
  const std::string rest_lps =
      fcsv_columns + "1,1,2,3,0,0,0,1,1,1,0,F-1,,\n2,-4,5,6,0,0,0,1,1,1,0,F-2,,vtk1\n";
  const std::string rest_ras =
      fcsv_columns +
      "vtkMRMLMarkupsFiducialNode_0,-1,-2,3,0,0,0,1,1,1,0,F-1,,\nn1,4,-5,6,0,0,0,1,1,1,0,F-2,,\n";
  CHECK(read_points(folder.put("l.fcsv", version + "# CoordinateSystem = LPS\n" + rest_lps), false) == lps);
  CHECK(read_points(folder.put("1.fcsv", version + "# CoordinateSystem = 1\n" + rest_lps), false) == lps);
  CHECK(read_points(folder.put("0.fcsv", version + "# CoordinateSystem = 0\n" + rest_ras), false) == lps);
  CHECK(read_points(folder.put("r.fcsv", version + "# CoordinateSystem = RAS\n" + rest_ras), false) == lps);
  CHECK(read_points(folder.put("n.fcsv", version + rest_ras), false) == lps);
  const auto markups = [](const std::string& system, const std::string& a, const std::string& b) {
    return R"({"@schema":"markups","markups":[{"type":"Fiducial",)" + system + R"("controlPoints":[
      {"id":"1","label":"F-1","position":)" +
           a + R"(,"positionStatus":"defined"},{"id":"2","position":)" + b + "}]}]}";
  };
  CHECK(read_points(folder.put("l.mrk.json", markups(R"("coordinateSystem":"LPS",)", "[1,2,3]", "[-4,5,6]")),
                    false) == lps);
  CHECK(
      read_points(folder.put("r.mrk.json", markups(R"("coordinateSystem":"RAS",)", "[-1,-2,3]", "[4,-5,6]")),
                  false) == lps);
  CHECK(read_points(folder.put("n.mrk.json", markups("", "[1,2,3]", "[-4,5,6]")), false) == lps);
  CHECK_THROWS_WITH(
      read_points(folder.put("i.mrk.json", markups(R"("coordinateSystem":"IJK",)", "[1,2,3]", "[-4,5,6]")),
                  false),
      Catch::Contains("IJK"));
  CHECK_THROWS_WITH(read_points(folder.put("u.mrk.json", markups("", "[1,2,3]", "null")), false),
                    Catch::Contains("control point 2"));
  CHECK_THROWS_WITH(read_points(folder.path() / "l.fcsv", true), Catch::Contains("world"));
}

TEST_CASE("broken files of landmarks are refused with the place") {
  const TemporaryFolder folder;
  const auto pairs = [&](const char* name, const char* text) {
    return read_landmark_pairs(folder.put(name, text));
  };
  CHECK_THROWS_WITH(pairs("a.csv", "1,2,3,4,5,6\n1,2,3,4,5\n"), Catch::Contains("line 2"));
  CHECK_THROWS_WITH(pairs("a.csv", "1,2,3,4,5,6,7\n"), Catch::Contains("line 1"));
  CHECK_THROWS_WITH(pairs("a.csv", "1,2,3,4,5,six\n"), Catch::Contains("line 1"));
  CHECK_THROWS_WITH(pairs("a.csv", "1,2,3,4,5,nan\n"), Catch::Contains("line 1"));
  CHECK_THROWS_WITH(pairs("a.csv", "1,2,3,4,5,6\nx,y,z,x,y,z\n"), Catch::Contains("line 2"));
  CHECK_THROWS_AS(pairs("a.json", "[[[1,2,3],[4,5,6]]"), FileError);
  CHECK_THROWS_AS(pairs("a.json", "[[[1,2,3],[4,5,1e999]]]"), FileError); // beyond doubles
  CHECK_THROWS_WITH(pairs("a.json", "{}"), Catch::Contains("no list"));
  CHECK_THROWS_WITH(pairs("a.json", "[[[1,2,3]]]"), Catch::Contains("pair 1"));
  CHECK_THROWS_WITH(pairs("a.json", "[[[1,2,3],[4,5]]]"), Catch::Contains("pair 1's target"));
  CHECK_THROWS_WITH(pairs("a.json", "[[[1,2,3],[4,5,\"6\"]]]"), Catch::Contains("pair 1's target"));
  CHECK_THROWS_WITH(pairs("a.fcsv", ""), Catch::Contains("warp.source"));
  CHECK_THROWS_WITH(pairs("a.xyz", ""), Catch::Contains(".csv"));
  CHECK_THROWS_AS(read_landmark_pairs(folder.path() / "none.csv"), FileError);
  CHECK_THROWS_AS(read_points(folder.put("b.mrk.json", "[1]"), false), FileError);
  CHECK_THROWS_AS(read_points(folder.put("b.mrk.json", R"({"markups":[{}]})"), false), FileError);
  CHECK_THROWS_WITH(read_points(folder.put("b.fcsv", "# CoordinateSystem = LPS\n1,2,3\n"), false),
                    Catch::Contains("line 2"));
}

TEST_CASE("a scene's landmarks are read from its folder; lists must be as long as one another") {
  const TemporaryFolder folder;
  folder.put("s.csv", "0,0,0\n1,0,0\n0,1,0\n0,0,1\n");
  folder.put("t.csv", "0,0,0\n1,0,0\n0,1,0\n0,0,2\n");
  folder.put("short.csv", "0,0,0\n");
  Scene scene = scene_from_json(R"({"warp":{"kind":"landmarks","source":"s.csv","target":"t.csv"}})", "test");
  load_warp_files(scene, {folder.path()}, {});
  const auto& pairs = *std::get<Landmarks>(scene.warp[0]).loaded;
  REQUIRE(pairs.size() == 4);
  CHECK(pairs[3] == LandmarkPair{glm::dvec3(0, 0, 1), glm::dvec3(0, 0, 2)});
  scene = scene_from_json(R"({"warp":{"kind":"landmarks","source":"s.csv","target":"short.csv"}})", "test");
  CHECK_THROWS_WITH(load_warp_files(scene, {folder.path()}, {}),
                    Catch::Contains("4 points") && Catch::Contains("1;"));
  scene = scene_from_json(R"({"warp":{"kind":"landmarks","file":"none.csv"}})", "test");
  CHECK_THROWS_AS(load_warp_files(scene, {folder.path()}, {}), FileError);
  const std::string text =
      R"({"warp":{"kind":"landmarks","pairs":[[[0,0,0],[0,0,0]],[[1,0,0],[1,0,0]],[[0,1,0],[0,1,0]],[[0,0,1],[0,0,2.5]]]}})";
  const Scene inline_pairs = scene_from_json(scene_to_json(scene_from_json(text, "test")), "again");
  CHECK((*std::get<Landmarks>(inline_pairs.warp[0]).pairs)[3][1] == glm::dvec3(0, 0, 2.5));
}
