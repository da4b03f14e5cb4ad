#include "volume/streamed.h"

#include "core/errors.h"

namespace slicelens {

std::size_t voxel_count(const VoxelBox& box) {
  return checked_product(checked_product(box.size[0], box.size[1], "part of a volume"), box.size[2],
                         "part of a volume");
}

void require_voxels(const Volume& volume, const std::string& what) {
  if (is_streamed(volume)) {
    throw UsageError(what + " needs all voxels at once, and these stay in their file (" +
                     volume.streamed->where + "); set volume.access to memory");
  }
}

} // namespace slicelens
