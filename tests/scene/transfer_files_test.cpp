// Transfer functions and cameras in the files of ParaView, 3D Slicer and ImageVis3D: what each format means,
// exact round trips, what is said to be lost, and what is refused.
#include "catch.h"
#include "core/errors.h"
#include "scene/camera.h"
#include "scene/camera_files.h"
#include "scene/load.h"
#include "scene/scene_json.h"
#include "scene/transfer_files.h"
#include "temporary_folder.h"
#include "volume/phantom.h"

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <sstream>

using namespace slicelens;
namespace fs = std::filesystem;

namespace {

ReadTransfer read(const fs::path& path, const std::string& map = "") {
  return transfer_of(read_transfer_file(path, map), path);
}

std::string text_of(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

/// The one line of a FileError, without the folder; empty when nothing is thrown.
std::string problem(const fs::path& path, const std::string& map = "") {
  try {
    (void)read(path, map);
  } catch (const FileError& error) {
    const std::string text = error.what();
    CHECK(text.find('\n') == std::string::npos);
    CHECK(text.find(path.string()) == 0);
    return text.substr(path.string().size() + 2);
  }
  return {};
}

void check_same(const TransferFunction& a, const TransferFunction& b) {
  REQUIRE(a.points.size() == b.points.size());
  for (std::size_t i = 0; i < a.points.size(); ++i) {
    INFO("point " << i);
    CHECK(a.points[i].value == b.points[i].value); // exactly: numbers are written with all their digits
    CHECK(a.points[i].r == b.points[i].r);
    CHECK(a.points[i].g == b.points[i].g);
    CHECK(a.points[i].b == b.points[i].b);
    CHECK(a.points[i].opacity == b.points[i].opacity);
  }
}

// The example of 3D Slicer's documentation, "Format of Volume Property (.vp) file".
const std::string slicer_example =
    "1\n1\n0.9\n0.1\n0.2\n10\n"
    "14 -3024 0 -86.9767 0 45.3791 0.169643 139.919 0.589286 347.907 0.607143 1224.16 0.607143 3071 "
    "0.616071\n"
    "4 0 1 255 1\n"
    "28 -3024 0 0 0 -86.9767 0 0.25098 1 45.3791 1 0 0 139.919 1 0.894893 0.894893 347.907 1 1 0.25098 "
    "1224.16 1 1 1 3071 0.827451 0.658824 1\n";

const std::string paraview_example = R"([{ "ColorSpace": "Diverging", "Name": "Cool to Warm",
  "NanColor": [1, 1, 0], "DefaultMap": true,
  "RGBPoints": [0, 0.23137254902, 0.298039215686, 0.752941176471, 0.5, 0.865, 0.865, 0.865,
                1, 0.705882352941, 0.0156862745098, 0.149019607843] },
 { "ColorSpace": "RGB", "Name": "Two", "Points": [0, 0.25, 0.5, 0, 10, 0.75, 0.5, 0],
   "RGBPoints": [0, 0, 0, 0, 10, 1, 0.5, 0.25] }])";

std::string vp_json(const std::string& component) {
  return R"({"@schema": "x", "volumeProperties": [{"components": [)" + component + "]}]}";
}

const std::string plain_functions =
    R"("scalarOpacity": {"type": "piecewiseLinearFunction", "points": [{"x": 0, "y": 0}, {"x": 4, "y": 1}]},
       "rgbTransferFunction": {"type": "colorTransferFunction", "points": [{"x": 0, "color": [1, 0.5, 0]}]})";

} // namespace

TEST_CASE("every preset survives every format that holds points, exactly") {
  const TemporaryFolder folder;
  for (const PresetInfo& info : presets()) {
    INFO(info.name);
    const TransferFunction original = preset(info.name, -17.3, 1001.7);
    for (const char* name : {"a.json", "a.vp", "a.vp.json"}) {
      INFO(name);
      CHECK(write_transfer_file(folder.path() / name, {original}).empty());
      check_same(read(folder.path() / name).transfer, original);
    }
  }
}

TEST_CASE("files that were written are written again as the same bytes") {
  const TemporaryFolder folder;
  TransferToWrite what{preset("CT-Muscle")};
  what.transfer.unit_distance = 0.75;
  what.display = SlicerDisplay{2, true, .11, .62, .33, 44, {{0, .5}, {90, 1}}};
  CHECK(write_transfer_file(folder.path() / "a.vp.json", what).empty());
  const TransferFile again = read_transfer_file(folder.path() / "a.vp.json");
  const ReadTransfer function = transfer_of(again, "a.vp.json");
  CHECK(function.transfer.unit_distance == 0.75);
  CHECK(again.display->power == 44);
  CHECK(function.note ==
        "not taken: gradient opacity, interpolation (render.filter cubic), shading "
        "(render.shading phong, light.ambient 0.11, light.diffuse 0.62, light.specular 0.33, "
        "light.power 44)");
  CHECK(write_transfer_file(folder.path() / "b.vp.json", {function.transfer, again.display}).empty());
  CHECK(text_of(folder.path() / "a.vp.json") == text_of(folder.path() / "b.vp.json"));
  CHECK(write_transfer_file(folder.path() / "a.vp", what) ==
        "the format does not hold the unit distance 0.75");
  const TransferFile text = read_transfer_file(folder.path() / "a.vp");
  (void)write_transfer_file(folder.path() / "b.vp", {transfer_of(text, "a.vp").transfer, text.display});
  CHECK(text_of(folder.path() / "a.vp") == text_of(folder.path() / "b.vp"));
  CHECK(write_transfer_file(folder.path() / "a.json", what) ==
        "the format does not hold the unit distance 0.75, light, shading and gradient opacity");
}

TEST_CASE("3D Slicer's own example") {
  const TemporaryFolder folder;
  const fs::path path = folder.put("CT-Bone.vp", slicer_example);
  const TransferFile file = read_transfer_file(path);
  CHECK(file.name == "CT-Bone");
  CHECK(file.display->shade);
  CHECK(file.display->diffuse == 0.9);
  CHECK(file.display->ambient == 0.1);
  const ReadTransfer function = transfer_of(file, path);
  REQUIRE(function.transfer.points.size() == 7);
  CHECK(function.transfer.points[2].value == 45.3791);
  CHECK(function.transfer.points[2].opacity == 0.169643);
  CHECK(function.transfer.points[3].g == 0.894893);
  CHECK(function.note.find(
            "not taken: shading (render.shading phong, light.ambient 0.1, light.diffuse 0.9") == 0);
  // The same with gradients that count.
  std::string steep = slicer_example;
  steep.replace(steep.find("4 0 1 255 1"), 11, "4 0 0 255 1");
  CHECK(read(folder.put("b.vp", steep)).note.find("gradient opacity") != std::string::npos);
}

TEST_CASE("ParaView's maps: by name, in other spaces, without opacity") {
  const TemporaryFolder folder;
  const fs::path path = folder.put("maps.json", paraview_example);
  const ReadTransfer two = read(path, "Two");
  CHECK(two.note.empty());
  check_same(two.transfer, {{{0, 0, 0, 0, .25}, {10, 1, .5, .25, .75}}, {}, ""});
  const ReadTransfer cool = read(path, "Cool to Warm");
  CHECK(cool.note.find("colours interpolated in Diverging are resampled to ") == 0);
  CHECK(cool.note.find("; no opacity is given, so it rises from 0 to 1; not taken: NanColor") !=
        std::string::npos);
  // vtkColorTransferFunction.GetColor(0.25) of VTK 9.1 with SetColorSpaceToDiverging; the tolerance is twice
  // what resampling aims at.
  const glm::dvec4 rgba = evaluate(cool.transfer, 0.25);
  CHECK(std::abs(rgba.r - 0.553524281) < 2 * kResamplingTolerance);
  CHECK(std::abs(rgba.g - 0.688407392) < 2 * kResamplingTolerance);
  CHECK(std::abs(rgba.b - 0.994915114) < 2 * kResamplingTolerance);
  CHECK(rgba.a == Approx(0.25));
  CHECK_THROWS_AS(read(path), UsageError);
  CHECK_THROWS_AS(read(path, "Cool to Wram"), UsageError);
  const ReadTransfer stretched = transfer_of(read_transfer_file(path, "Two"), path, ValueRange(-100, 300));
  CHECK(stretched.transfer.points[0].value == -100);
  CHECK(stretched.transfer.points[1].value == 300);
}

TEST_CASE("ParaView's XML") {
  const TemporaryFolder folder;
  const fs::path path = folder.put(
      "maps.xml",
      "<ColorMaps><ColorMap name=\"Consistency\" space=\"RGB\">"
      "<Point x=\"-1\" o=\"0.5\" r=\"0\" g=\"0\" b=\"0\"/><Point x=\"1\" o=\"1\" r=\"1\" g=\"0\" "
      "b=\"0\"/><NaN r=\"1\" g=\"1\" b=\"0\"/></ColorMap><ColorMap name=\"B\" space=\"Lab\"><Point "
      "x=\"2\" o=\"1\" r=\"0\" g=\"1\" b=\"0\"/></ColorMap></ColorMaps>");
  const ReadTransfer map = read(path, "Consistency");
  CHECK(map.note == "not taken: NaN");
  check_same(map.transfer, {{{-1, 0, 0, 0, .5}, {1, 1, 0, 0, 1}}, {}, ""});
  CHECK(read(path, "B").note.find("no opacity is given") ==
        0); // ParaView writes o="1" and means nothing by it
  CHECK(problem(folder.put("a.xml", "<ColorMap><Point x=\"0\" r=\"0\" g=\"0\" b=\"nan\"/></ColorMap>")) ==
        "<Point> 1: attribute 'b' must be a number");
  CHECK(problem(folder.put("b.xml", "<Other/>")).find("has no <ColorMap>") == 0);
  CHECK(problem(folder.put("c.xml", "<ColorMap><Point")).find("is no XML: ") == 0);
  CHECK(problem(folder.put("d.xml", "<ColorMap indexedLookup=\"1\"/>")).find("holds indexed colours") == 0);
}

TEST_CASE("tables: rows over the data's range, and what is lost between them") {
  const TemporaryFolder folder;
  // Rows on which every point lies lose nothing but the values.
  TransferToWrite exact{{{{0, 0, 0, 0, 0}, {2, 1, .5, .25, 1}, {4, 0, 1, 0, .5}}, {}, ""}};
  exact.rows_range = {0, 4};
  exact.rows = 5;
  CHECK(write_transfer_file(folder.path() / "a.1dt", exact) ==
        "the format does not hold the values of its 5 rows, from 0 to 4");
  CHECK(text_of(folder.path() / "a.1dt") ==
        "5\n0 0 0 0\n0.5 0.25 0.125 0.5\n1 0.5 0.25 1\n0.5 0.75 0.125 0.75\n0 1 0 0.5\n");
  const TransferFile file = read_transfer_file(folder.path() / "a.1dt");
  CHECK(file.rows);
  const ReadTransfer function = transfer_of(file, "a.1dt", exact.rows_range);
  for (const double value : {-1.0, 0.0, 0.7, 2.0, 3.3, 9.0})
    CHECK(evaluate(function.transfer, value) == evaluate(exact.transfer, value));
  // Four rows miss the peak: at value 2 the table has the mean of rows 4/3 and 8/3, (2/3, …), one third low.
  exact.rows = 4;
  CHECK(write_transfer_file(folder.path() / "b.1dt", exact).find("(off by at most 0.33333") !=
        std::string::npos);
  // Over data: 256 rows of 8-bit data are its values.
  Volume volume = make_phantom("engine", {8, 8, 4});
  CHECK(table_range(volume, 256) == glm::dvec2(0, 255));
  CHECK(table_range(volume, 64) == glm::dvec2(volume.min, volume.max));
}

TEST_CASE("damaged transfer functions get one line") {
  const TemporaryFolder folder;
  const auto json = [&](const std::string& text) { return problem(folder.put("x.json", text)); };
  CHECK(json("[{").find("not valid JSON at line 1") == 0);
  CHECK(json("[{\"RGBPoints\": [0, 0, 0]}]") ==
        "'RGBPoints' must be a list of 4 numbers for each point, not 3");
  CHECK(json("[{\"RGBPoints\": [0, 0, 0, null]}]") == "'RGBPoints': entry 3 is no number");
  CHECK(json("[{\"RGBPoints\": [0, 0, 0, 1e999]}]") == "holds a number beyond the range of doubles");
  CHECK(
      json("[{\"RGBPoints\": [3, 0, 0, 0, 2, 0, 0, 0]}]").find("colour point 2 (value 2): values must not") ==
      0);
  CHECK(json("[{\"RGBPoints\": [3, 0, 7, 0]}]").find("green is 7") != std::string::npos);
  CHECK(json("[{\"RGBPoints\": [1, 0, 0, 0], \"ColorSpace\": \"CMYK\"}]").find("the colour space 'CMYK'") ==
        0);
  CHECK(json("[{\"RGBPoints\": [-1, 0, 0, 0], \"UseLogScale\": true}]").find("logarithmic") !=
        std::string::npos);
  CHECK(json("[{\"Name\": \"a\"}]").find("its colour map has no 'RGBPoints'") == 0);
  CHECK(json("[{\"IndexedColors\": [1, 0, 0]}]").find("holds indexed colours") == 0);
  CHECK(json("[3]").find("is no list of colour maps") == 0);
  CHECK(json("[]") == "holds no colour map");

  const auto vp = [&](const std::string& text) { return problem(folder.put("x.vp", text)); };
  CHECK(vp("") == "line 1 (interpolation) is missing; a .vp file has nine lines");
  CHECK(vp("1\n1\n0.9\n0.1\n0.2\n10\n4 0 1 255\n") ==
        "line 7 (scalar opacity) must begin with how many numbers follow, 2 for each point; it says 4 and 3 "
        "follow");
  CHECK(vp("1\n1\n0.9\n0.1\n0.2\n10\n1e300 0 1\n").find("line 7") == 0);
  CHECK(vp("1\n1\n0.9\nnan\n") == "line 4 (ambient) has 'nan', which is no number");
  CHECK(vp("7\n") == "line 1 (interpolation) must be one number from 0 to 2");
  CHECK(vp(slicer_example + "3\n") == "has more than the nine lines of a .vp file");

  const auto property = [&](const std::string& text) { return problem(folder.put("x.vp.json", text)); };
  CHECK(property("[]").find("holds no list 'volumeProperties'") == 0);
  CHECK(property("{\"volumeProperties\": [{}]}").find("holds no list 'components'") == 0);
  CHECK(property(vp_json("{}")) == "its component needs both 'scalarOpacity' and 'rgbTransferFunction'");
  CHECK(property(vp_json("{\"scalarOpacity\": {\"points\": [{\"x\": 1}]}, " +
                         plain_functions.substr(plain_functions.find("\"rgb")) + "}")) ==
        "'scalarOpacity': point 1 has no number 'y'");
  CHECK(property(vp_json("{" + plain_functions + ", \"scalarOpacityUnitDistance\": 0}")) ==
        "'scalarOpacityUnitDistance' must be a number above 0");
  CHECK(property(vp_json("{" + plain_functions + "}")).empty());

  const auto table = [&](const std::string& text) { return problem(folder.put("x.1dt", text)); };
  CHECK(table("") == "ends before the number of rows");
  CHECK(table("4000000000\n0 0 0 0\n").find("begins with '4000000000'; the number of rows must be") == 0);
  CHECK(table("2\n0 0 0 0\n0 0 0\n") == "ends before row 2 of 2");
  CHECK(table("2\n0 0 0 0\n0 0 0 inf\n") == "row 2 of 2 is 'inf', which is no number");
  CHECK(table("2\n0 0 0 0\n0 0 0 0\n1").find("has more than the 2 rows") == 0);
  CHECK(table("2\n0 0 0 0\n0 0 0 2\n").find("opacity is 2") != std::string::npos);
  CHECK(problem(folder.put("x.txt", "")).find("is no transfer function by its name") == 0);
}

TEST_CASE("files with any bytes changed are read or refused, never worse") {
  const TemporaryFolder folder;
  const TransferToWrite what{preset("CT-Muscle")};
  std::vector<std::pair<std::string, std::string>> samples = {
      {"x.vp", slicer_example},
      {"x.json", paraview_example},
      {"x.xml", "<ColorMap space=\"HSV\"><Point x=\"-1\" o=\"0.5\" r=\"0\" g=\"0\" b=\"0\"/><Point x=\"1\" "
                "o=\"1\" r=\"1\" g=\"0\" b=\"0\"/></ColorMap>"},
      {"x.1dt", "3\n0 0 0 0\n0.5 0.25 0.125 0.5\n1 0.5 0.25 1\n"}};
  (void)write_transfer_file(folder.path() / "m.vp.json", what);
  samples.emplace_back("x.vp.json", text_of(folder.path() / "m.vp.json"));
  std::uint32_t state = 12345; // Numerical Recipes' generator: the same bytes on every machine
  const auto next = [&](std::size_t below) {
    state = state * 1664525U + 1013904223U;
    return static_cast<std::size_t>(state >> 8) % below;
  };
  std::size_t read_well = 0;
  std::size_t refused = 0;
  const std::string alphabet = "0123456789.-+eE,[]{}\"<>/ \n\0nif";
  for (const auto& [name, text] : samples) {
    for (int round = 0; round < 300; ++round) {
      std::string damaged = text;
      for (std::size_t k = 0; k < 1 + next(3); ++k)
        damaged[next(damaged.size())] = alphabet[next(alphabet.size())];
      if (next(8) == 0)
        damaged.resize(next(damaged.size()));
      const fs::path path = folder.put(name, damaged);
      try {
        const ReadTransfer function = read(path, name == "x.json" ? "Two" : "");
        validate(function.transfer);
        ++read_well;
      } catch (const Error&) {
        ++refused;
      }
    }
  }
  CHECK(read_well > 100);
  CHECK(refused > 100);
}

TEST_CASE("a scene takes its transfer function from a file, and then stands alone") {
  const TemporaryFolder folder;
  (void)folder.put("two.json", paraview_example);
  const Volume volume = make_phantom("engine", {8, 8, 4});
  std::vector<std::string> warnings;
  Progress progress;
  progress.warn = [&](const std::string& text) { warnings.push_back(text); };
  Scene scene =
      scene_from_json(R"({"transfer": {"file": "two.json", "map": "Two", "range": [8, 208]}})", "scene");
  CHECK_THROWS_AS(transfer_of(scene, volume), UsageError); // not read yet
  load_transfer_file(scene.transfer, volume, {folder.path()}, progress);
  CHECK(warnings.empty());
  CHECK_FALSE(scene.transfer.file);
  check_same(transfer_of(scene, volume), {{{8, 0, 0, 0, .25}, {208, 1, .5, .25, .75}}, {}, ""});
  check_same(transfer_of(scene_from_json(scene_to_json(scene), "again"), volume), transfer_of(scene, volume));
  // Data that lie beside all points are told how to be met.
  scene =
      scene_from_json(R"({"transfer": {"file": "two.json", "map": "Two", "range": [300, 400]}})", "scene");
  load_transfer_file(scene.transfer, volume, {folder.path()}, progress);
  REQUIRE(warnings.size() == 1);
  CHECK(warnings[0].find("two.json: its points lie from 300 to 400, the data from 8 to") == 0);
  // A file's unit distance, unless the scene has its own.
  (void)folder.put("u.vp.json", vp_json("{\"shade\": false, \"scalarOpacityUnitDistance\": 2.5, " +
                                        plain_functions + "}"));
  scene = scene_from_json(R"({"transfer": {"file": "u.vp.json"}})", "scene");
  load_transfer_file(scene.transfer, volume, {folder.path()}, {});
  CHECK(transfer_of(scene, volume).unit_distance == 2.5);
}

TEST_CASE("keys of files exclude those of what the files hold") {
  CHECK_THROWS_AS(scene_from_json(R"({"transfer": {"file": "a.vp", "preset": "fog"}})", "s"), UsageError);
  CHECK_THROWS_AS(scene_from_json(R"({"transfer": {"file": "a.vp", "points": []}})", "s"), UsageError);
  CHECK_THROWS_AS(scene_from_json(R"({"transfer": {"range": [0, 1]}})", "s"), UsageError);
  CHECK_THROWS_AS(scene_from_json(R"({"transfer": {"file": "a.vp", "range": [1, 1]}})", "s"), UsageError);
  CHECK_THROWS_AS(scene_from_json(R"({"camera": {"file": "a.pvcc", "azimuth": 3}})", "s"), UsageError);
  CHECK_THROWS_AS(scene_from_json(R"({"camera": {"file": "a.pvcc", "view_angle": 3}})", "s"), UsageError);
  const Scene scene = scene_from_json(
      R"({"transfer": {"preset": "fog"}, "camera": {"azimuth": 3, "view_angle": 20, "zoom": 2}})", "s",
      {{"transfer.file", "a.vp"}, {"camera.file", "a.pvcc"}});
  CHECK_FALSE(scene.transfer.preset);
  CHECK(scene.camera.file == "a.pvcc");
  CHECK(scene.camera.zoom == 2);
  CHECK_FALSE(
      scene_from_json(R"({"camera": {"file": "a.pvcc"}})", "s", {{"camera.azimuth", "3"}}).camera.file);
}

namespace {

// As ParaView writes them, with other numbers.
const std::string camera_example =
    "<?xml version=\"1.0\"?>\n<PVCameraConfiguration description=\"ParaView camera configuration\" "
    "version=\"1.0\">\n<Proxy group=\"views\" type=\"RenderView\" id=\"2076\" servers=\"21\">\n"
    "<Property name=\"CameraPosition\" id=\"2076.CameraPosition\" number_of_elements=\"3\"><Element "
    "index=\"0\" "
    "value=\"7.25\"/><Element index=\"1\" value=\"-56.5\"/><Element index=\"2\" "
    "value=\"6.125\"/></Property>\n"
    "<Property name=\"CameraFocalPoint\" id=\"2076.CameraFocalPoint\" number_of_elements=\"3\"><Element "
    "index=\"0\" value=\"-0.5\"/><Element index=\"1\" value=\"0.1\"/><Element index=\"2\" "
    "value=\"-0.44\"/></Property>\n"
    "<Property name=\"CameraViewUp\" id=\"2076.CameraViewUp\" number_of_elements=\"3\"><Element index=\"0\" "
    "value=\"-0.05\"/><Element index=\"1\" value=\"0.1\"/><Element index=\"2\" value=\"0.99\"/></Property>\n"
    "<Property name=\"RotationFactor\" id=\"2076.RotationFactor\" number_of_elements=\"1\"><Element "
    "index=\"0\" "
    "value=\"1\"/></Property>\n"
    "<Property name=\"CameraViewAngle\" id=\"2076.CameraViewAngle\" number_of_elements=\"1\"><Element "
    "index=\"0\" value=\"25\"/></Property>\n"
    "<Property name=\"CameraParallelScale\" id=\"2076.CameraParallelScale\" "
    "number_of_elements=\"1\"><Element "
    "index=\"0\" value=\"108.426242211007\"/></Property>\n"
    "<Property name=\"CameraParallelProjection\" id=\"2076.CameraParallelProjection\" "
    "number_of_elements=\"1\"><Element index=\"0\" value=\"0\"/></Property>\n</Proxy>\n"
    "</PVCameraConfiguration>\n";

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  REQUIRE(at != std::string::npos);
  return text.replace(at, what.size(), by);
}

std::string camera_problem(const fs::path& path) {
  try {
    (void)read_camera_file(path);
  } catch (const FileError& error) {
    return std::string(error.what()).substr(path.string().size() + 2);
  }
  return {};
}

} // namespace

TEST_CASE("cameras of ParaView come back exactly") {
  const TemporaryFolder folder;
  const ReadCamera read = read_camera_file(folder.put("a.pvcc", camera_example));
  CHECK(read.ignored.empty());
  CHECK(*read.camera.position == glm::dvec3(7.25, -56.5, 6.125));
  CHECK(*read.camera.view_up == glm::dvec3(-.05, .1, .99));
  CHECK(read.camera.projection == ProjectionName::perspective);
  CHECK(read.camera.view_angle == 25);
  const Box box = box_of(make_phantom("ball", {8, 8, 8}));
  const CameraSettings same = explicit_camera(read.camera, box);
  CHECK(same.position == read.camera.position);
  CHECK(same.view_up == read.camera.view_up);
  CHECK(same.parallel_scale == read.camera.parallel_scale);
  write_camera_file(folder.path() / "b.pvcc", same);
  const CameraSettings again = read_camera_file(folder.path() / "b.pvcc").camera;
  CHECK(again.position == read.camera.position);
  CHECK(again.focal_point == read.camera.focal_point);
  CHECK(again.view_up == read.camera.view_up);
  CHECK(again.view_angle == read.camera.view_angle);
  CHECK(again.parallel_scale == read.camera.parallel_scale);
  CHECK(again.projection == read.camera.projection);
  CHECK_THROWS_AS(write_camera_file(folder.path() / "b.xml", same), UsageError);
}

TEST_CASE("a camera of angles and its explicit form show the same view") {
  const Box box = box_of(make_phantom("engine", {16, 16, 8}));
  for (const ProjectionName projection : {ProjectionName::orthographic, ProjectionName::perspective}) {
    CameraSettings camera;
    camera.azimuth = 40;
    camera.elevation = 90; // view up turns with it
    camera.roll = -20;
    camera.zoom = 1.5;
    camera.projection = projection;
    const View view = make_view(camera, box, 64, 48);
    const View same = make_view(explicit_camera(camera, box), box, 64, 48);
    // Lengths are some tens of units: rounding of a few sums.
    CHECK(glm::length(view.eye - same.eye) < 1e-12);
    CHECK(glm::length(view.up - same.up) < 1e-14);
    CHECK(glm::length(view.forward - same.forward) < 1e-14);
    CHECK(view.half_height == Approx(same.half_height).epsilon(1e-14));
  }
}

TEST_CASE("damaged cameras get one line") {
  const TemporaryFolder folder;
  const auto camera = [&](const std::string& text) { return camera_problem(folder.put("x.pvcc", text)); };
  CHECK(camera("<PVCamera").find("is no XML: ") == 0);
  CHECK(camera("<ColorMap/>").find("has no <PVCameraConfiguration>") == 0);
  CHECK(camera(replaced(camera_example, "\"CameraViewUp\" id", "\"CameraViewDown\" id"))
            .find("has no 'CameraViewUp'") == 0);
  CHECK(camera(replaced(camera_example, "value=\"7.25\"", "value=\"nan\""))
            .find("'CameraPosition' has an element") == 0);
  CHECK(camera(replaced(camera_example, "value=\"7.25\"", "")).find("'CameraPosition' has an element") == 0);
  CHECK(camera(replaced(camera_example, "<Element index=\"0\" value=\"7.25\"/>", "")) ==
        "'CameraPosition' needs 3 elements");
  CHECK(camera(replaced(camera_example, "index=\"2\" value=\"6.125\"", "index=\"77\" value=\"6.125\""))
            .find("'CameraPosition' needs 3 elements, numbered from 0") == 0);
  CHECK(camera(replaced(camera_example, "value=\"25\"", "value=\"180\"")).find("'CameraViewAngle' must be") ==
        0);
  CHECK(camera(replaced(replaced(replaced(camera_example, "-0.05", "0"),
                                 "0.1\"/><Element index=\"2\" value=\"0.99",
                                 "0\"/><Element index=\"2\" value=\"0"),
                        "x", "x"))
            .find("its position, focal point and view up make no view") == 0);
  const ReadCamera other = read_camera_file(
      folder.put("y.pvcc", replaced(camera_example, "\"RotationFactor\" id", "\"EyeAngle\" id")));
  CHECK(other.ignored == "EyeAngle");
}

TEST_CASE("a map's name that is no UTF-8 is written with replacement characters") {
  // Found by the fuzzer: the JSON library threw an exception of its own.
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "a.xml")
      << "<ColorMap name=\"a\xed\"><Point x=\"0\" r=\"1\" g=\"0\" b=\"0\"/>"
         "<Point x=\"1\" r=\"0\" g=\"0\" b=\"1\"/></ColorMap>";
  const ReadTransfer map = read(folder.path() / "a.xml");
  CHECK(map.transfer.name == "a\xed");
  CHECK(write_transfer_file(folder.path() / "a.json", {map.transfer}).empty());
  check_same(read(folder.path() / "a.json").transfer, map.transfer);
  CHECK(read_transfer_file(folder.path() / "a.json").name == "a\xef\xbf\xbd"); // U+FFFD
}
