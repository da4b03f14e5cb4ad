// What a study has measured so far, one JSON object a line, each on the disk before the next is begun: an
// interrupted study loses the line it was at and nothing else.
#pragma once

#include "study/sweep/quality.h"

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace slicelens {

/// One picture and what was measured of it.
struct Quality {
  std::string id;                           ///< of the combination, see CombinationState
  std::string of;                           ///< content_name of what it was compared with and by what
  std::vector<Value> values;                ///< metrics and counts, by column
  std::map<std::string, std::string> texts; ///< renderer, GL version, texture, names of pictures
};

/// One visit of a timing round.
struct TimedVisit {
  std::string id;        ///< of the combination; "limits" for the machine's fill rates
  std::size_t shard = 1; ///< that measured it: ratios pair visits of one shard and round
  std::size_t round = 0;
  std::vector<std::pair<std::string, double>> seconds; ///< by phase; of "limits" fragments a second
};

/// What does not change while a study is measured.
struct JournalHeader {
  std::string study;   ///< content_name of Study::json
  std::string machine; ///< processor, system and program, one line
};

struct JournalContents {
  JournalHeader header;
  std::vector<Quality> qualities; ///< the last line of an id counts
  std::vector<TimedVisit> visits;
};

/// Reads a journal. A last line without its end is left out; nothing where there is no file. Throws FileError
/// for a line that is no entry.
JournalContents read_journal(const std::filesystem::path& file);

/// A journal open for writing. Only one program at a time may hold it.
class Journal {
public:
  /// Opens or makes the file, cuts off a last line without its end, and writes `header` into a new one.
  /// Throws FileError when it cannot be written, when another program has it open, and when its header is
  /// another one: the message names the difference and `--fresh`.
  Journal(const std::filesystem::path& file, const JournalHeader& header);
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  /// What stood there before.
  const JournalContents& contents() const { return contents_; }

  /// Writes the line and waits until the disk has it. Throws FileError (a full disk): what was written before
  /// is unharmed.
  void add(const Quality& quality);
  void add(const TimedVisit& visit);

private:
  void add_line(const std::string& line);

  std::filesystem::path file_;
  int descriptor_ = -1;
  JournalContents contents_;
};

/// One file that holds the lines of all. Throws FileError where two headers name different studies.
void join_journals(const std::vector<std::filesystem::path>& files, const std::filesystem::path& joined);

} // namespace slicelens
