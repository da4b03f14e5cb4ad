#include "study/sweep/output_folder.h"

#include "core/errors.h"
#include "core/files.h"
#include "study/sweep/report.h"

#include <system_error>

namespace slicelens {

namespace fs = std::filesystem;

void make_folders(const fs::path& folder) {
  for (const fs::path& path : {folder, folder / "pictures", folder / "references"}) {
    std::error_code error;
    fs::create_directories(path, error);
    if (error)
      throw FileError(path.string(),
                      "cannot be made: " + error.message() + "; choose another folder with -o");
  }
}

void put_aside(const fs::path& journal) {
  if (!fs::exists(journal))
    return;
  for (int i = 1;; ++i) {
    const fs::path aside = journal.parent_path() / ("journal-" + std::to_string(i) + ".jsonl");
    if (fs::exists(aside))
      continue;
    fs::rename(journal, aside);
    return;
  }
}

void write_results(const StudyResults& results, const fs::path& folder) {
  write_text_atomically(folder / "study.json", results.study.json + "\n");
  write_text_atomically(folder / "results.csv", results_csv(results));
  write_text_atomically(folder / "results.json", results_json(results));
  write_text_atomically(folder / "report.html", report_html(results, folder));
}

void copy_pictures(const fs::path& from, const fs::path& to) {
  for (const char* part : {"pictures", "references"}) {
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(from / part, error)) {
      std::error_code failed;
      fs::copy_file(entry.path(), to / part / entry.path().filename(), fs::copy_options::overwrite_existing,
                    failed);
      if (failed)
        throw FileError((to / part).string(), "a picture cannot be copied there: " + failed.message());
    }
  }
}

} // namespace slicelens
