// Numbered pictures as a video, by ffmpeg as a program of its own.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <string>

namespace slicelens {

/// The pictures folder/frame_00000.png, frame_00001.png … of a video.
struct VideoFrames {
  std::filesystem::path folder;
  std::size_t count = 0; ///< 1 to 100000
  double rate = 25;      ///< frames a second
};

inline constexpr double fastest_gif = 50; ///< frames a second; viewers slow down what is faster

/// "frame_00012.png"
std::string frame_name(std::size_t index);

/// Throws UsageError when a video of this name cannot hold frames of this size (pixels) and rate: .mp4 needs
/// an even width and height because each 2×2 pixels share a colour (yuv420p); .gif at most 50 frames a second
/// and 65535 pixels on a side. Other extensions are refused.
void check_video(const std::filesystem::path& path, const std::array<std::size_t, 2>& size, double rate);

/// Writes `path`: .mp4 (H.264, yuv420p, BT.709) or .gif (256 colours chosen from all frames, repeats for
/// ever). ffmpeg is found through PATH and started without a shell. The frames' alpha is ignored. An old file
/// stays until the new one is complete. Throws FileError when ffmpeg is not installed or fails (with its
/// first error).
void write_video(const std::filesystem::path& path, const VideoFrames& frames);

} // namespace slicelens
