#include "core/errors.h"
#include "core/files.h"
#include "options.h"
#include "study/sweep/document_tables.h"

#include <cstdio>

namespace slicelens::cli {

void run_tables(const TablesOptions& options) {
  std::size_t stale = 0;
  for (const std::string& name : options.documents) {
    const std::string old = read_text(name);
    std::vector<std::string> missing;
    const std::string fresh = with_results(old, name, options.results, missing);
    for (const std::string& result : missing)
      std::fprintf(stderr, "%s: no %s under %s; what stands there stays\n", name.c_str(), result.c_str(),
                   options.results.c_str());
    if (fresh == old)
      continue;
    ++stale;
    if (!options.check)
      write_text_atomically(name, fresh);
    std::printf("%s\n", name.c_str());
  }
  if (options.check && stale > 0)
    throw FileError(options.documents.front(),
                    "and other documents differ from the results; run without --check");
}

} // namespace slicelens::cli
