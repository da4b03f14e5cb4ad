// Voxels without a value (NaN, infinite): what is drawn in their place.
#pragma once

#include "volume/transfer.h"
#include "volume/volume.h"

#include <optional>

namespace slicelens {

/// A value (data units) whose opacity is 0 under `transfer`: the smallest one of [low, high] that is a knot,
/// an end or a middle between knots; else the nearest beyond; nothing where the function is nowhere empty.
std::optional<double> empty_value(const TransferFunction& transfer, double low, double high);

/// Puts `value` where the volume has no finite one, widens min and max to hold it and sets non_finite to 0.
/// The mean stays that of the finite values. Only float volumes have such voxels.
void fill_non_finite(Volume& volume, double value);

} // namespace slicelens
