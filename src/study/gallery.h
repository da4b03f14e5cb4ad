// A page of pictures with their scenes and metrics.
#pragma once

#include "study/metrics.h"

#include <string>
#include <vector>

namespace slicelens {

/// A picture beside the page and what is said under it.
struct GalleryPicture {
  std::string file; ///< relative to the page
  std::string caption;
};

/// What two of the pictures have in common.
struct GalleryComparison {
  std::string what; ///< "slices against rays"
  Metrics metrics;
};

/// One scene and its pictures.
struct GalleryEntry {
  std::string title;
  std::string name; ///< short, used in file names and links
  std::vector<GalleryPicture> pictures;
  std::string data;                           ///< what is shown: "256×256×256 int16, phantom"
  std::vector<GalleryComparison> comparisons; ///< none where there is one picture only
  std::string command;                        ///< that renders the picture again
  std::string scene_json;                     ///< shown folded
};

/// Self-contained HTML beside the pictures, readable without a network. Texts are escaped.
/// `lead` is the sentence under the title. `driver` names the renderer, `seconds` what the whole gallery
/// took.
std::string gallery_page(const std::string& title, const std::string& lead,
                         const std::vector<GalleryEntry>& entries, const std::string& driver, double seconds);

/// Text as HTML: &, <, > and quotes escaped.
std::string html_text(const std::string& text);

} // namespace slicelens
