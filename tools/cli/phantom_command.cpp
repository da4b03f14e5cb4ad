#include "console.h"
#include "core/errors.h"
#include "options.h"
#include "volume/phantom.h"
#include "volume/write.h"

#include <cstdio>

namespace slicelens::cli {

void run_phantom(const PhantomOptions& options) {
  std::array<std::size_t, 3> size = phantom_info(options.name).size;
  if (options.size.size() == 1)
    size = {options.size[0], options.size[0], options.size[0]};
  if (options.size.size() == 3)
    size = {options.size[0], options.size[1], options.size[2]};
  if (options.size.size() == 2)
    throw UsageError("--size takes one number for a cube, or three");
  const PhantomSource source = phantom_source(options.name, size);
  write_rows(source.volume, source.rows, options.output, console_progress());
  end_progress();
  std::printf("%s\n", options.output.c_str());
}

} // namespace slicelens::cli
