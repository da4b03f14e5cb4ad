// Volumes that scenes of a study share, kept as long as memory allows.
#pragma once

#include "study/inputs.h"

#include <list>
#include <map>
#include <string>

namespace slicelens {

/// Prepared scenes by their volumes.
class SceneStore {
public:
  /// Keeps volumes of at most `bytes` in all, and one in any case.
  explicit SceneStore(std::size_t bytes) : bytes_(bytes) {}

  /// The scene with its data, read only where no scene before had the same volumes. Valid until the next
  /// call. Throws as load does.
  const PreparedScene& get(const SceneInput& input, const Progress& progress);

  /// The SHA-256 of the scene's volume files, worked out once for each; empty for phantoms. Throws FileError.
  std::string sha256(const SceneInput& input);

private:
  struct Entry {
    std::string key;
    PreparedScene prepared;
  };
  void make_room();

  std::size_t bytes_;
  std::list<Entry> entries_; ///< the one used last comes first
  std::map<std::string, std::string> hashes_;
};

} // namespace slicelens
