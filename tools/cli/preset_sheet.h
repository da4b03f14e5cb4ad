// The contact sheet of the gallery: what every preset makes of the head phantom.
#pragma once

#include "core/progress.h"
#include "image/image.h"
#include "study/inputs.h"

namespace slicelens::cli {

/// A labelled tile for each preset but those of single phantoms: those in HU on `head`, those relative to the
/// data's range on `head-mr`; CT-MIP, MR-MIP and CT-X-ray in the mode that they are made for. `context` may
/// be open or not.
Image preset_sheet(OpenContext& context, const Progress& progress);

/// The scene of one tile, as one line of JSON.
std::string preset_scene(const PresetInfo& preset);

} // namespace slicelens::cli
