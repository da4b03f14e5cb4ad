// Another volume renderer that runs beside this one, for comparisons frame by frame: VTK, through the script
// tools/render_with_vtk (docs/vtk.md).
#pragma once

#include "render/prepare.h"
#include "study/line_process.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace slicelens {

/// What a peer draws with.
struct PeerDriver {
  std::string renderer; ///< GL_RENDERER
  std::string version;  ///< GL_VERSION
  std::string program;  ///< version of the peer itself, "9.1.0"
};

/// A running peer. Every call waits for its answer. An answer that refuses (a scene that the peer cannot
/// draw, a folder that is not there) is a FileError with the peer's own words, and the peer goes on; one
/// that breaks the protocol, a missing answer and the peer's death are FileErrors after which it is gone.
/// Move-only; the process ends with the object.
class Peer {
public:
  /// Starts `script --serve` and waits until it is ready. `limit`: seconds for each answer, for each frame of
  /// draw. Throws FileError where the script, Python, VTK or Xvfb is missing.
  explicit Peer(const std::filesystem::path& script, double limit = 300);

  /// Takes a folder that write_export has written, draws one frame and says by what. `mapper`: "gpu" or
  /// "cpu".
  PeerDriver load(const std::filesystem::path& folder, const std::string& mapper);

  /// Looks through the camera of `prepared`, whose data and other settings are those of what was loaded.
  void look(const PreparedScene& prepared);

  /// Draws `frames` ≥ 1 frames and gives the seconds of wall clock of each, from an idle driver until the
  /// frame is complete.
  std::vector<double> draw(std::size_t frames = 1);

  /// Writes the last frame as an 8-bit RGB picture, .png.
  void write(const std::filesystem::path& picture);

private:
  LineProcess process_;
  double limit_;
};

/// Where the script is: the environment's SLICELENS_VTK; else beside what is installed
/// (share/slicelens/render_with_vtk as seen from the program); else tools/ of the source that the program
/// was built from. Throws FileError naming the places.
std::filesystem::path find_peer();

} // namespace slicelens
