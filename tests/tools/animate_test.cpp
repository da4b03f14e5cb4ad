// slicelens animate: frames, resuming, videos and refusals.

#include "catch.h"
#include "program.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace {

using Words = std::vector<std::string>;
using Json = nlohmann::json;
using Catch::Matchers::Contains;

Words operator+(Words a, const Words& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

const Words turn = {"animate", "s.json", "--vary", "camera.azimuth=0:90", "--frames", "4"};
const Words four = {"frame_00000.png", "frame_00001.png", "frame_00002.png", "frame_00003.png"};

Outcome done(const Workplace& place, const Words& call) {
  Outcome outcome = place.run(call);
  CAPTURE(outcome.err);
  REQUIRE(outcome.status == 0);
  return outcome;
}

Words names_in(const fs::path& folder) {
  Words names;
  for (const auto& entry : fs::directory_iterator(folder))
    names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

Json scene_of(const Workplace& place, const std::string& picture) {
  return Json::parse(done(place, {"render", picture, "--print-scene"}).out);
}

/// One line on stderr with all of `named`, and nothing written.
void check_refused(const Workplace& place, const Words& call, const Words& named, int status = 2) {
  const Words before = place.entries();
  const Outcome outcome = place.run(call);
  std::string shown;
  for (const std::string& word : call)
    shown += word + " ";
  CAPTURE(shown, outcome.err);
  CHECK(outcome.status == status);
  CHECK(outcome.out.empty());
  CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
  for (const std::string& text : named)
    CHECK_THAT(outcome.err, Contains(text));
  CHECK(place.entries() == before);
}

/// The call without any program but slicelens.
Outcome without_programs(const Workplace& place, const Words& call) {
  const char* const old = std::getenv("PATH");
  const std::string path = old != nullptr ? old : "/usr/bin:/bin";
  ::setenv("PATH", (place.folder() / "none").c_str(), 1);
  Outcome outcome = place.run(call);
  ::setenv("PATH", path.c_str(), 1);
  return outcome;
}

bool has_ffmpeg() { return std::system("ffmpeg -version > /dev/null 2>&1") == 0; }

/// The video's first stream: "width,height,frames,rate" as ffprobe, which comes with ffmpeg, reads them.
std::string probe(const fs::path& video) {
  const fs::path out = video.string() + ".probe";
  const std::string call = "ffprobe -v error -count_frames -select_streams v:0 -show_entries "
                           "stream=width,height,pix_fmt,r_frame_rate,nb_read_frames -of csv=p=0 '" +
                           video.string() + "' > '" + out.string() + "'";
  REQUIRE(std::system(call.c_str()) == 0);
  std::string text = contents(out);
  fs::remove(out);
  return text;
}

} // namespace

TEST_CASE("animate: each frame is the picture that render makes of its scene") {
  const Workplace place;
  put(place / "s.json", small_scene);
  const Outcome outcome = done(place, turn + Words{"-o", "turn/"});
  CHECK(outcome.out == "turn/\n");
  CHECK(outcome.err.empty());
  CHECK(names_in(place / "turn") == four);
  for (int i = 0; i < 4; ++i) {
    const std::string azimuth = std::to_string(30 * i); // from 0 to 90 in three steps
    done(place, {"render", "s.json", "--set", "camera.azimuth=" + azimuth, "-o", "one.png"});
    CHECK(contents(place / "one.png") == contents(place / "turn" / four[static_cast<std::size_t>(i)]));
  }
  done(place, turn + Words{"--loop", "-o", "loop/"});
  CHECK(scene_of(place, "loop/frame_00003.png")["camera"]["azimuth"] == 67.5); // 3/4 of the way
}

TEST_CASE("animate: lists, whole numbers, several keys, and other volumes") {
  const Workplace place;
  put(place / "s.json", small_scene);
  done(place, {"animate", "s.json", "--frames", "3", "-o", "many/", "--set", "warp.kind=leafer", "--vary",
               "render.background=[0,0,0,1]:[1,0.5,0,1]", "--vary", "warp.leaves=2:5", "--vary",
               "volume.size=[8,8,8]:[12,12,12]"});
  const Json scene = scene_of(place, "many/frame_00001.png");
  CHECK(scene["render"]["background"] == Json({0.5, 0.25, 0.0, 1.0}));
  CHECK(scene["warp"]["leaves"] == 4); // 3.5 rounded
  CHECK(scene["volume"]["size"] == Json({10, 10, 10}));
  done(place, {"render", "many/frame_00001.png", "-o", "again.png"});
  CHECK(contents(place / "again.png") == contents(place / "many/frame_00001.png"));
}

TEST_CASE("animate: a run goes on where it was interrupted") {
  const Workplace place;
  put(place / "s.json", small_scene);
  const Words call = turn + Words{"-o", "turn/"};
  done(place, call);
  std::vector<std::string> first;
  for (const std::string& name : four)
    first.push_back(contents(place / "turn" / name));

  fs::remove(place / "turn" / four[1]);
  put(place / "turn" / four[2], first[2].substr(0, 60)); // damaged
  // Of another scene: the first frame in the last one's place.
  put(place / "turn" / four[3], first[0]);
  const auto untouched = fs::last_write_time(place / "turn" / four[0]);
  CHECK(done(place, call).err == "1 of 4 frames are there already\n");
  for (std::size_t i = 0; i < 4; ++i)
    CHECK(contents(place / "turn" / four[i]) == first[i]);
  CHECK(fs::last_write_time(place / "turn" / four[0]) == untouched);
  CHECK(done(place, call).err == "4 of 4 frames are there already\n");
  CHECK(done(place, call + Words{"--set", "camera.zoom=2"}).err.empty()); // none is of that scene
  CHECK(names_in(place / "turn") == four);
}

TEST_CASE("animate: frames of a volume that has changed are rendered anew") {
  const Workplace place;
  done(place, {"phantom", "ball", "--size", "8", "-o", "v.nrrd"});
  const Words call = {
      "animate", "v.nrrd", "--set", "render.size=[16,16]", "--vary", "camera.zoom=1:2", "--frames",
      "2",       "-o",     "f/"};
  done(place, call);
  CHECK(done(place, call).err == "2 of 2 frames are there already\n");
  done(place, {"phantom", "box", "--size", "8", "-o", "v.nrrd"});
  CHECK(done(place, call).err.empty());
}

TEST_CASE("animate: frames of landmarks that have changed are rendered anew") {
  const Workplace place;
  put(place / "s.json", small_scene);
  const auto put_target = [&](const std::string& x) {
    put(place / "p.csv", "0.5,0.5,0.5," + x +
                             ",0.5,0.5\n0,0,0,0,0,0\n1,0,0,1,0,0\n0,1,0,0,1,0\n"
                             "0,0,1,0,0,1\n1,1,1,1,1,1\n");
  };
  put_target("0.55");
  const Words call = turn + Words{"--set", "warp.kind=landmarks", "--set", "warp.file=p.csv",
                                  "--set", "warp.space=texture",  "-o",    "f/"};
  done(place, call);
  CHECK(done(place, call).err == "4 of 4 frames are there already\n");
  const std::string last = contents(place / "f" / four[3]);
  done(place, {"render", "f/frame_00003.png", "-o", "one.png"}); // later frames read the landmarks too
  CHECK(contents(place / "one.png") == last);
  put_target("0.6");
  CHECK(done(place, call).err.empty());
  CHECK(contents(place / "f" / four[3]) != last);
}

TEST_CASE("animate: without ffmpeg the frames stay and a word says what is missing") {
  const Workplace place;
  put(place / "s.json", small_scene);
  const Outcome missing = without_programs(place, turn + Words{"-o", "t.mp4"});
  CHECK(missing.status == 1);
  CHECK(missing.out.empty());
  CHECK(std::count(missing.err.begin(), missing.err.end(), '\n') == 1);
  CHECK_THAT(missing.err,
             Contains("ffmpeg") && Contains("apt-get install ffmpeg") && Contains("kept in t.mp4.frames"));
  CHECK(place.entries() == Words{"s.json", "t.mp4.frames"});
  CHECK(names_in(place / "t.mp4.frames") == four);
  CHECK(without_programs(place, turn + Words{"-o", "turn/"}).status == 0); // pictures need no ffmpeg
}

TEST_CASE("animate: mp4 and gif hold all frames") {
  if (!has_ffmpeg())
    SLICELENS_SKIP("ffmpeg is not installed");
  const Workplace place;
  put(place / "s.json", small_scene);
  // A folder's name that ffmpeg could take for a number's place, an option or a pattern.
  fs::create_directories(place / "100%d *'x");
  const std::string mp4 = "100%d *'x/-t.mp4";
  CHECK(done(place, turn + Words{"-o", mp4, "--fps", "12.5"}).out == mp4 + "\n");
  CHECK(names_in(place / "100%d *'x") == Words{"-t.mp4", "-t.mp4.frames"});
  fs::rename(place / mp4, place / "t.mp4");
  CHECK(probe(place / "t.mp4") == "24,20,yuv420p,25/2,4\n");
  // Frames beyond the number asked for are from an earlier, longer run.
  fs::rename(place / (mp4 + ".frames"), place / "t.gif.frames");
  fs::copy(place / "t.gif.frames" / four[3], place / "t.gif.frames" / "frame_00004.png");
  const Outcome gif = done(place, turn + Words{"-o", "t.gif", "--fps", "10"});
  CHECK(gif.err == "4 of 4 frames are there already\n");
  CHECK_THAT(probe(place / "t.gif"), Contains("24,20,") && Contains(",10/1,4\n"));
  CHECK(place.entries() == Words{"100%d *'x", "s.json", "t.gif", "t.gif.frames", "t.mp4"});
}

TEST_CASE("animate: wrong calls are refused before any work") {
  const Workplace place;
  put(place / "s.json", small_scene);
  put(place / "file", "");
  const auto vary = [](const std::string& text) {
    return Words{"animate", "s.json", "--frames", "3", "-o", "f/", "--vary", text};
  };
  check_refused(place, vary("camera.azimuth=0"), {"camera.azimuth=0", "KEY=FROM:TO"});
  check_refused(place, vary("camera.azimuth"), {"camera.azimuth", "KEY=FROM:TO"});
  check_refused(place, vary("camera.azimut=0:1"), {"--vary camera.azimut=0:1", "camera.azimuth"});
  check_refused(place, vary("camera.azimuth=a:b"), {"'a'", "not a number"});
  check_refused(place, vary("render.mode=0:1"), {"--vary render.mode=0:1", "render.mode"});
  check_refused(place, vary("render.mode=dvr:mip"), {"'dvr'", "not a number"});
  check_refused(place, vary("title=0:1"), {"--vary title=0:1"});
  check_refused(place, vary("light.direction=[0,1]:[1,0]"), {"light.direction"});
  check_refused(place, vary("light.direction=[0,1,0]:[1,0]"), {"same length"});
  check_refused(place, vary("camera.zoom=1:-1"), {"--vary camera.zoom=1:-1", "camera.zoom"});
  check_refused(place, vary("render.levels=1.5:2"), {"render.levels"});
  check_refused(place, vary("camera.zoom=1:2") + Words{"--vary", "camera.zoom=2:3"}, {"once"});
  check_refused(place, {"animate", "s.json", "--frames", "3", "-o", "f/"}, {"--vary"});
  const Words zoom = {"animate", "s.json", "--vary", "camera.zoom=1:2"};
  check_refused(place, zoom + Words{"-o", "f/"}, {"--frames"});
  for (const char* frames : {"0", "100001", "-1", "2.5", "x"})
    check_refused(place, zoom + Words{"-o", "f/", "--frames", frames}, {"--frames"});
  const Words three = zoom + Words{"--frames", "3"};
  check_refused(place, three + Words{"-o", "f/", "--fps", "0"}, {"--fps"});
  check_refused(place, three + Words{"-o", "f.avi"}, {"f.avi", ".mp4 or .gif"});
  check_refused(place, three + Words{"-o", ""}, {"-o", ".mp4"});
  check_refused(place, three + Words{"-o", "f.gif", "--fps", "60"}, {"--fps 60", "50"});
  check_refused(place, three + Words{"-o", "f.mp4", "--set", "render.size=[25,20]"},
                {"[25,20]", "even", "[26,20]"});
  check_refused(place, three + Words{"-o", "f.mp4", "--set", "render.background=[0,0,0,0]"},
                {"render.background", "transparency"});
  check_refused(place, vary("render.size=[20,20]:[24,24]") + Words{"-o", "f.gif"}, {"-o"});
  check_refused(
      place, {"animate", "s.json", "--vary", "render.size=[20,20]:[24,24]", "--frames", "3", "-o", "f.gif"},
      {"one size"});
  check_refused(place, three + Words{"-o", "none/f.mp4"}, {"none", "does not exist"}, 1);
  check_refused(place, three + Words{"-o", "file/"}, {"file"}, 1);
  check_refused(place, {"animate", "no.json", "--vary", "camera.zoom=1:2", "--frames", "3", "-o", "f/"},
                {"no.json"}, 1);
}

TEST_CASE("animate: other people's pictures are not replaced") {
  const Workplace place;
  put(place / "s.json", small_scene);
  // The smallest PNG: one grey pixel (PNG specification, chunks IHDR, IDAT, IEND).
  const unsigned char bytes[] = {
      0x89, 'P',  'N',  'G',  13,  10,  26,  10,   0,    0,    0,    13,  'I',  'H',  'D',  'R',  0,
      0,    0,    1,    0,    0,   0,   1,   8,    0,    0,    0,    0,   0x3a, 0x7e, 0x9b, 0x55, 0,
      0,    0,    10,   'I',  'D', 'A', 'T', 0x78, 0x9c, 0x63, 0x60, 0,   0,    0,    2,    0,    1,
      0x48, 0xaf, 0xa4, 0x71, 0,   0,   0,   0,    'I',  'E',  'N',  'D', 0xae, 0x42, 0x60, 0x82};
  const std::string png(reinterpret_cast<const char*>(bytes), sizeof bytes);
  fs::create_directories(place / "f");
  put(place / "f" / "frame_00002.png", png);
  check_refused(place, turn + Words{"-o", "f"}, {"f/frame_00002.png", "not a picture by slicelens"}, 1);
  CHECK(names_in(place / "f") == Words{"frame_00002.png"});
  CHECK(contents(place / "f" / "frame_00002.png") == png);
}
