// A page of pictures with their scenes and metrics.
#pragma once

#include "study/metrics.h"

#include <string>
#include <vector>

namespace slicelens {

/// One scene, rendered by slices and by rays. File names are relative to the page.
struct GalleryEntry {
  std::string title;
  std::string name; ///< short, used in file names
  std::string slices_picture;
  std::string rays_picture;
  std::string heat_map;
  std::string scene_json;    ///< shown folded
  std::string command;       ///< that renders the picture again
  Metrics metrics;           ///< slices against rays
  double slices_seconds = 0; ///< drawing
  double rays_seconds = 0;
  std::size_t slice_count = 0;
  std::string volume; ///< "256x256x256 int16"
};

/// Self-contained HTML beside the pictures, readable without a network. Texts are escaped.
/// `driver` names the renderer, `seconds` what the whole gallery took.
std::string gallery_page(const std::vector<GalleryEntry>& entries, const std::string& driver, double seconds);

/// Text as HTML: &, <, > and quotes escaped.
std::string html_text(const std::string& text);

} // namespace slicelens
