// One visit to one combination: a picture with its counts, or a timed frame.
#pragma once

#include "study/sweep/combinations.h"
#include "study/sweep/quality.h"
#include "study/sweep/scene_store.h"

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace slicelens {

/// A picture as a combination's pipeline draws it.
struct DrawnPicture {
  Image image;               ///< on the scene's background, with the scene in its metadata
  std::vector<Value> counts; ///< slices, triangles, draw_calls, fragments, samples, texture_bytes, peak_bytes
  std::map<std::string, std::string> texts; ///< renderer, gl_version, context, texture
};

/// By phase.
using Seconds = std::vector<std::pair<std::string, double>>;

/// Draws and times the combinations of one study; holds the context, the volumes and the peers.
class Visitor {
public:
  Visitor();
  ~Visitor();

  /// Of the files that are shown, worked out once for each; empty for phantoms and patterns. Throws
  /// FileError.
  std::string sha256(const StudyInput& input);

  /// The scene with its data, valid until the next call of any function; null for a picture's.
  const PreparedScene* prepared(const StudyInput& input, const Progress& progress);

  /// Draws once. Throws as load and render do.
  DrawnPicture draw(const StudyInput& input, const std::optional<std::string>& peer,
                    const Progress& progress);

  /// Seconds of the phases: deform (a changed warp: deform_time.h), upload, compile, slice, tessellate, draw,
  /// draw_gpu (where the driver has a timer), draw_processor (of all threads), read. Each is the median of
  /// the protocol's frames, after its warm-up.
  Seconds time(const StudyInput& input, const std::optional<std::string>& peer,
               const TimingProtocol& protocol, const Progress& progress);

  /// The machine's fill rates in fragments a second: untextured, textured, classified. Opens a context of the
  /// kind that `like` asks for.
  Seconds time_limits(const StudyInput& like);

private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Samples that rays of the scene take: the length of every pixel's ray in the displayed box by the spacing.
/// Early termination is not in it.
double samples_along_rays(const PreparedScene& prepared);

} // namespace slicelens
