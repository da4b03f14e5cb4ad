// What both programs ask of the C library's allocator.
#pragma once

#include <malloc.h>

namespace slicelens {

/// Keeps freed memory for the next use. Readers allocate and free the same half megabytes for every slice of
/// a series; by default each such block is mapped, faulted in and given back anew, which was half of the time
/// that a DICOM series took to load. Blocks of 16 MiB and more (whole volumes) still go back to the system.
/// Nothing outside glibc, which has other ways.
inline void keep_freed_memory() {
#ifdef __GLIBC__
  ::mallopt(M_MMAP_THRESHOLD, 16 << 20);
  ::mallopt(M_TRIM_THRESHOLD, 64 << 20);
#endif
}

} // namespace slicelens
