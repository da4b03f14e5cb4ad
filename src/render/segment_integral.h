// A segment of a ray without a table: what the reference sums up, and what tables are tested against.
#pragma once

#include "volume/transfer.h"

namespace slicelens {

/// Associated colour and opacity of a segment of `ratio` reference lengths whose value goes linearly from
/// `front` to `back` (Engel, Kraus and Ertl 2001): the piecewise linear function itself, in `steps` equal
/// steps of every linear piece, each of the colour and extinction in its middle. An opacity of 1 counts as 1
/// − 1e-30.
glm::dvec4 segment_integral(const TransferFunction& transfer, double front, double back, double ratio,
                            int steps = 32);

} // namespace slicelens
