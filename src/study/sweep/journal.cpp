#include "study/sweep/journal.h"

#include "core/files.h"
#include "study/sweep/study_json.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>

namespace slicelens {

using study_json::Json;

namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_bytes = std::size_t{1} << 30;

Json header_json(const JournalHeader& header) {
  return {{"kind", "study"}, {"format", 1}, {"study", header.study}, {"machine", header.machine}};
}

Json quality_json(const Quality& quality) {
  Json values = Json::object();
  for (const auto& [name, value] : quality.values)
    values[name] = value ? Json(*value) : Json(nullptr);
  return {{"kind", "quality"},
          {"id", quality.id},
          {"of", quality.of},
          {"values", values},
          {"texts", quality.texts}};
}

Json visit_json(const TimedVisit& visit) {
  Json seconds = Json::object();
  for (const auto& [phase, value] : visit.seconds)
    seconds[phase] = value;
  return {{"kind", "visit"},
          {"id", visit.id},
          {"shard", visit.shard},
          {"round", visit.round},
          {"seconds", seconds}};
}

void take(const Json& json, JournalContents& contents) {
  const std::string kind = json.at("kind").get<std::string>();
  if (kind == "study") {
    contents.header = {json.at("study").get<std::string>(), json.at("machine").get<std::string>()};
  } else if (kind == "quality") {
    Quality quality{json.at("id").get<std::string>(), json.at("of").get<std::string>(), {}, {}};
    for (const auto& [name, value] : json.at("values").items())
      quality.values.emplace_back(name, value.is_null() ? std::nullopt
                                                        : std::optional<double>(value.get<double>()));
    quality.texts = json.at("texts").get<std::map<std::string, std::string>>();
    contents.qualities.push_back(std::move(quality));
  } else {
    TimedVisit visit{json.at("id").get<std::string>(),
                     json.at("shard").get<std::size_t>(),
                     json.at("round").get<std::size_t>(),
                     {}};
    for (const auto& [phase, value] : json.at("seconds").items())
      visit.seconds.emplace_back(phase, value.get<double>());
    contents.visits.push_back(std::move(visit));
  }
}

JournalContents parsed(const std::string& text, const std::string& file) {
  JournalContents contents;
  std::size_t line = 1;
  for (std::size_t begin = 0; begin < text.size(); ++line) {
    const std::size_t end = text.find('\n', begin);
    if (end == std::string::npos)
      break; // an entry that was cut off
    try {
      take(Json::parse(text.substr(begin, end - begin)), contents);
    } catch (const nlohmann::json::exception&) {
      throw FileError(file,
                      "line " + std::to_string(line) +
                          " is no entry of a study's journal; remove the line, or the file to start anew");
    }
    begin = end + 1;
  }
  return contents;
}

std::string line_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

} // namespace

JournalContents read_journal(const fs::path& file) {
  std::error_code error;
  if (!fs::exists(file, error))
    return {};
  return parsed(read_text(file, most_bytes), file.string());
}

Journal::Journal(const fs::path& file, const JournalHeader& header) : file_(file) {
  descriptor_ = ::open(file.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (descriptor_ < 0)
    throw FileError(file.string(), std::string("cannot be written: ") + std::strerror(errno));
  try {
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0)
      throw FileError(file.string(),
                      "another slicelens study writes there; wait for it or choose another folder");
    const std::string text = read_text(file, most_bytes);
    const std::size_t whole = text.rfind('\n') == std::string::npos ? 0 : text.rfind('\n') + 1;
    contents_ = parsed(text.substr(0, whole), file.string());
    if (whole < text.size() && ::ftruncate(descriptor_, static_cast<off_t>(whole)) != 0)
      throw FileError(file.string(), std::string("cannot be written: ") + std::strerror(errno));
    if (whole == 0) {
      contents_.header = header;
      add_line(line_of(header_json(header)));
    } else if (contents_.header.study != header.study) {
      throw FileError(file.string(),
                      "holds the results of another study, or of this one before it was edited; "
                      "choose another folder with -o, or --fresh to put them aside");
    } else if (contents_.header.machine != header.machine) {
      throw FileError(file.string(),
                      "was measured by '" + contents_.header.machine + "', this is '" + header.machine +
                          "': times of both do not go together; choose another folder with -o, "
                          "or --fresh to put them aside");
    }
  } catch (...) {
    ::close(descriptor_);
    throw;
  }
}

Journal::~Journal() { ::close(descriptor_); }

void Journal::add(const Quality& quality) { add_line(line_of(quality_json(quality))); }
void Journal::add(const TimedVisit& visit) { add_line(line_of(visit_json(visit))); }

void Journal::add_line(const std::string& line) {
  const off_t before = ::lseek(descriptor_, 0, SEEK_END);
  std::size_t written = 0;
  while (written < line.size()) {
    const ssize_t count = ::write(descriptor_, line.data() + written, line.size() - written);
    if (count < 0 && errno == EINTR)
      continue;
    if (count < 0) {
      const int reason = errno;
      // Half a line is cut off again; where even that fails the next reader leaves it out.
      [[maybe_unused]] const int cut = ::ftruncate(descriptor_, before);
      throw FileError(file_.string(), std::string("cannot be written: ") + std::strerror(reason) +
                                          "; what was measured before is kept, run the study again to go on");
    }
    written += static_cast<std::size_t>(count);
  }
  if (::fdatasync(descriptor_) != 0 && errno != EINVAL && errno != EROFS)
    throw FileError(file_.string(), std::string("cannot be written: ") + std::strerror(errno) +
                                        "; what was measured before is kept, run the study again to go on");
}

void join_journals(const std::vector<fs::path>& files, const fs::path& joined) {
  std::string text;
  JournalHeader header;
  for (const fs::path& file : files) {
    const JournalContents part = read_journal(file);
    if (part.header.study.empty())
      throw FileError(file.string(), "is no journal of a study; name folders that slicelens study wrote");
    if (text.empty()) {
      header = part.header;
      text = line_of(header_json(header));
    } else if (part.header.study != header.study) {
      throw FileError(file.string(), "belongs to another study than " + files.front().string());
    }
    for (const Quality& quality : part.qualities)
      text += line_of(quality_json(quality));
    for (const TimedVisit& visit : part.visits)
      text += line_of(visit_json(visit));
  }
  write_text_atomically(joined, text);
}

} // namespace slicelens
