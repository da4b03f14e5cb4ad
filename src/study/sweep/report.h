// What a study found as one page that a browser opens without a network.
#pragma once

#include "study/sweep/results.h"

#include <filesystem>
#include <string>

namespace slicelens {

/// HTML with everything in it: style, script, charts and pictures, none of which is loaded from anywhere. The
/// same results and pictures give the same bytes.
///
/// Pictures are read from `folder` (paths of Row::texts). What does not fit into about 20 MB is embedded
/// reduced, then not at all, and the page says so and links to the files beside it; a picture that cannot be
/// read is named. Charts are drawn by gnuplot; without it the page says why it has none. Throws nothing of
/// its own: a report must not cost a study its results.
std::string report_html(const StudyResults& results, const std::filesystem::path& folder);

} // namespace slicelens
