#include "study/ffmpeg.h"

#include "core/errors.h"
#include "core/files.h"
#include "core/text.h"
#include "study/process.h"

#include <sys/wait.h>

#include <cstdio>
#include <sstream>
#include <vector>

namespace slicelens {

namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

/// Any path as a word that is neither an option nor a protocol.
std::string file_word(const fs::path& path) { return "file:" + fs::absolute(path).string(); }

/// ffmpeg reads % in the name of a sequence as the start of the number.
std::string sequence_word(const fs::path& folder) {
  std::string word;
  for (const char c : file_word(folder))
    word += c == '%' ? "%%" : std::string(1, c);
  return word + "/frame_%05d.png";
}

void run_ffmpeg(const Words& arguments, const ScratchFolder& folder, const VideoFrames& frames) {
  Words words = {"ffmpeg", "-nostdin", "-hide_banner", "-loglevel", "error", "-y"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  const auto status = run_program(words, folder / "out", folder / "err");
  const std::string kept = "; the frames are kept in " + frames.folder.string();
  if (!status)
    throw FileError("ffmpeg", "is not installed, and it makes the video; apt-get install ffmpeg" + kept);
  if (*status == 0)
    return;
  std::istringstream errors(read_text(folder / "err"));
  std::string first;
  while (first.empty() && std::getline(errors, first)) {
  }
  if (WIFSIGNALED(*status))
    first = "ended by signal " + std::to_string(WTERMSIG(*status)) + " " + first;
  throw FileError("ffmpeg", "failed: " + (first.empty() ? "no reason given" : first) + kept);
}

Words input_words(const VideoFrames& frames) {
  return {"-f",
          "image2",
          "-pattern_type",
          "sequence",
          "-framerate",
          number_text(frames.rate),
          "-start_number",
          "0",
          "-i",
          sequence_word(frames.folder)};
}

Words operator+(Words a, const Words& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// Without the colour tags players guess by the size of the picture.
void write_mp4(const fs::path& path, const ScratchFolder& folder, const VideoFrames& frames) {
  run_ffmpeg(input_words(frames) + Words{"-frames:v", std::to_string(frames.count), "-vf",
                                         "scale=out_color_matrix=bt709:out_range=tv,format=yuv420p", "-c:v",
                                         "libx264", "-crf", "18", "-colorspace", "bt709", "-color_primaries",
                                         "bt709", "-color_trc", "iec61966-2-1", "-movflags", "+faststart",
                                         "-f", "mp4", file_word(path)},
             folder, frames);
}

/// In two passes, since one would hold all frames in memory until the colours are chosen.
void write_gif(const fs::path& path, const ScratchFolder& folder, const VideoFrames& frames) {
  const std::string count = std::to_string(frames.count);
  const std::string palette = file_word(folder / "palette.png");
  const std::string chosen = "trim=end_frame=" + count;
  run_ffmpeg(input_words(frames) + Words{"-vf", chosen + ",format=rgb24,palettegen=reserve_transparent=0",
                                         "-frames:v", "1", "-update", "1", palette},
             folder, frames);
  run_ffmpeg(input_words(frames) + Words{"-i", palette, "-lavfi",
                                         "[0:v]" + chosen + ",format=rgb24[a];[a][1:v]paletteuse", "-loop",
                                         "0", "-f", "gif", file_word(path)},
             folder, frames);
}

} // namespace

std::string frame_name(std::size_t index) {
  char name[40];
  std::snprintf(name, sizeof name, "frame_%05zu.png", index);
  return name;
}

void check_video(const fs::path& path, const std::array<std::size_t, 2>& size, double rate) {
  const std::string extension = lower(path.extension().string());
  const auto shape = [](std::size_t w, std::size_t h) {
    return "[" + std::to_string(w) + "," + std::to_string(h) + "]";
  };
  if (extension == ".mp4") {
    if (size[0] % 2 != 0 || size[1] % 2 != 0) {
      throw UsageError("render.size " + shape(size[0], size[1]) +
                       ": an .mp4 needs an even width and height; --set render.size=" +
                       shape(size[0] + size[0] % 2, size[1] + size[1] % 2));
    }
  } else if (extension == ".gif") {
    if (rate > fastest_gif)
      throw UsageError("--fps " + number_text(rate) + ": a .gif shows at most " + number_text(fastest_gif) +
                       " frames a second");
    if (size[0] > 65535 || size[1] > 65535)
      throw UsageError("render.size " + shape(size[0], size[1]) + ": a .gif has at most 65535 on a side");
  } else {
    throw UsageError(path.string() + ": give a name that ends in .mp4 or .gif, or a folder with / at its end "
                                     "for the frames as .png");
  }
}

void write_video(const fs::path& path, const VideoFrames& frames) {
  const ScratchFolder folder;
  write_atomically(path, [&](const fs::path& temporary) {
    if (lower(path.extension().string()) == ".gif")
      write_gif(temporary, folder, frames);
    else
      write_mp4(temporary, folder, frames);
  });
}

} // namespace slicelens
