#include "study/sweep/document_tables.h"

#include "core/errors.h"
#include "core/files.h"
#include "core/text.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <optional>

namespace slicelens {

namespace {

namespace fs = std::filesystem;
using Cells = std::vector<std::vector<std::string>>;

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t\n");
  if (first == std::string::npos)
    return "";
  return text.substr(first, text.find_last_not_of(" \t\n") - first + 1);
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  for (std::size_t i = 0; i <= text.size(); ++i) {
    if (i < text.size() && text[i] != separator)
      continue;
    const std::string part = trimmed(text.substr(begin, i - begin));
    if (!part.empty())
      parts.push_back(part);
    begin = i + 1;
  }
  return parts;
}

/// A column as a mark asks for it.
struct AskedColumn {
  std::string name;
  std::string heading;
  int decimals = -1; ///< negative: as it stands
  bool exponent = false;
  bool quartiles = false;
};

struct Mark {
  std::string study;
  std::vector<AskedColumn> columns;
  std::vector<std::pair<std::string, std::string>> where;
};

AskedColumn asked_column(std::string text) {
  AskedColumn column;
  const std::size_t quote = text.find('"');
  if (quote != std::string::npos && text.back() == '"') {
    column.heading = text.substr(quote + 1, text.size() - quote - 2);
    text = trimmed(text.substr(0, quote));
  }
  if (text.ends_with("[]")) {
    column.quartiles = true;
    text = trimmed(text.substr(0, text.size() - 2));
  }
  const std::size_t colon = text.rfind(':');
  if (colon != std::string::npos && colon + 2 == text.size()) {
    const char format = text.back();
    column.exponent = format == 'e';
    if (format >= '0' && format <= '9')
      column.decimals = format - '0';
    text = trimmed(text.substr(0, colon));
  }
  column.name = text;
  if (column.heading.empty())
    column.heading = text;
  return column;
}

/// What follows "study ".
Mark parsed_mark(const std::string& text, const std::string& at) {
  Mark mark;
  const std::size_t colon = text.find(": ");
  const std::size_t bar = text.find(" | ");
  if (colon == std::string::npos)
    throw UsageError(at + ": a mark needs columns: <!-- study NAME: COLUMN; COLUMN -->");
  mark.study = trimmed(text.substr(0, colon));
  const std::size_t columns_end = bar == std::string::npos ? text.size() : bar;
  for (const std::string& part : split(text.substr(colon + 2, columns_end - colon - 2), ';'))
    mark.columns.push_back(asked_column(part));
  if (bar != std::string::npos) {
    for (const std::string& part : split(text.substr(bar + 3), ';')) {
      const std::size_t equals = part.find('=');
      if (equals == std::string::npos)
        throw UsageError(at + ": '" + part + "' is no condition COLUMN=VALUE");
      mark.where.emplace_back(trimmed(part.substr(0, equals)), trimmed(part.substr(equals + 1)));
    }
  }
  if (mark.columns.empty())
    throw UsageError(at + ": a mark needs at least one column");
  return mark;
}

std::string formatted(const std::string& cell, const AskedColumn& column) {
  char* end = nullptr;
  const double value = std::strtod(cell.c_str(), &end);
  if (cell.empty() || *end != '\0' || (column.decimals < 0 && !column.exponent))
    return cell;
  char text[64];
  if (column.exponent)
    std::snprintf(text, sizeof text, "%.2e", value);
  else
    std::snprintf(text, sizeof text, "%.*f", column.decimals, value);
  return text;
}

/// Results with their heading looked up.
class Table {
public:
  Table(Cells cells, std::string at) : cells_(std::move(cells)), at_(std::move(at)) {
    for (std::size_t i = 0; i < cells_.at(0).size(); ++i)
      index_[cells_[0][i]] = i;
  }

  std::size_t column(const std::string& name) const {
    const auto found = index_.find(name);
    if (found != index_.end())
      return found->second;
    const auto nearest = nearest_word(name, cells_[0]);
    throw UsageError(at_ + ": the results have no column '" + name + "'" +
                     (nearest ? "; did you mean " + *nearest + "?" : "; known: " + join(cells_[0])));
  }

  std::vector<const std::vector<std::string>*>
  rows(const std::vector<std::pair<std::string, std::string>>& where) const {
    std::vector<const std::vector<std::string>*> chosen;
    for (std::size_t i = 1; i < cells_.size(); ++i) {
      const bool fits = std::all_of(where.begin(), where.end(), [&](const auto& condition) {
        return cells_[i][column(condition.first)] == condition.second;
      });
      if (fits)
        chosen.push_back(&cells_[i]);
    }
    return chosen;
  }

  std::string value(const std::vector<std::string>& row, const AskedColumn& asked) const {
    if (row[column("status")] != "done" && row[column(asked.name)].empty())
      return row[column("status")];
    std::string text = formatted(row[column(asked.name)], asked);
    if (asked.quartiles && !text.empty())
      text += " [" + formatted(row[column(asked.name + "_q1")], asked) + ", " +
              formatted(row[column(asked.name + "_q3")], asked) + "]";
    return text;
  }

  bool is_number(const AskedColumn& asked) const {
    const std::size_t at = column(asked.name);
    return std::all_of(cells_.begin() + 1, cells_.end(), [&](const auto& row) {
      char* end = nullptr;
      (void)std::strtod(row[at].c_str(), &end);
      return *end == '\0';
    });
  }

private:
  Cells cells_;
  std::string at_;
  std::map<std::string, std::size_t> index_;
};

std::string markdown(const Table& table, const Mark& mark, const std::string& at) {
  std::string heading = "|";
  std::string line = "|";
  for (const AskedColumn& column : mark.columns) {
    heading += " " + column.heading + " |";
    line += table.is_number(column) ? " ---: |" : " --- |";
  }
  std::string text = heading + "\n" + line + "\n";
  const auto rows = table.rows(mark.where);
  if (rows.empty())
    throw UsageError(at + ": no row of the results fits the conditions");
  for (const auto* row : rows) {
    text += "|";
    for (const AskedColumn& column : mark.columns)
      text += " " + table.value(*row, column) + " |";
    text += "\n";
  }
  return text;
}

std::string single(const Table& table, const Mark& mark, const std::string& at) {
  const auto rows = table.rows(mark.where);
  if (rows.size() != 1 || mark.columns.size() != 1)
    throw UsageError(at + ": a number in a line needs one column and conditions that one row fits; " +
                     std::to_string(rows.size()) + " rows fit");
  return table.value(*rows.front(), mark.columns.front());
}

/// What belongs into a block; nothing where its results are not there.
std::optional<std::string> block_text(const std::string& mark_text, bool in_line, const std::string& at,
                                      const fs::path& results, std::vector<std::string>& missing) {
  const bool is_output = mark_text.rfind("output ", 0) == 0;
  const Mark mark = is_output ? Mark{} : parsed_mark(mark_text.substr(6), at);
  const std::string name = is_output ? trimmed(mark_text.substr(7)) : mark.study + "/results.csv";
  if (!fs::exists(results / name)) {
    missing.push_back(name);
    return std::nullopt;
  }
  const std::string text = read_text(results / name);
  if (is_output)
    return text;
  const Table table(csv_cells(text), at);
  return in_line ? single(table, mark, at) : markdown(table, mark, at);
}

} // namespace

std::vector<std::vector<std::string>> csv_cells(const std::string& text) {
  Cells cells;
  bool quoted = false;
  bool fresh = true; // a row begins
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (fresh)
      cells.push_back({""});
    fresh = false;
    std::string& cell = cells.back().back();
    const char c = text[i];
    if (quoted && c == '"' && i + 1 < text.size() && text[i + 1] == '"') {
      cell += '"';
      ++i;
    } else if (c == '"') {
      quoted = !quoted;
    } else if (!quoted && c == ',') {
      cells.back().emplace_back();
    } else if (!quoted && c == '\n') {
      fresh = true;
    } else {
      cell += c;
    }
  }
  if (quoted)
    throw UsageError("a quote in the CSV has no end");
  return cells;
}

std::string with_results(const std::string& document, const std::string& source, const fs::path& results,
                         std::vector<std::string>& missing) {
  const std::string open = "<!-- ";
  const std::string close = " -->";
  const std::string end_mark = "<!-- end -->";
  std::string text;
  std::size_t begin = 0;
  while (true) {
    std::size_t mark = document.find(open, begin);
    while (mark != std::string::npos && document.compare(mark + open.size(), 6, "study ") != 0 &&
           document.compare(mark + open.size(), 7, "output ") != 0)
      mark = document.find(open, mark + 1);
    if (mark == std::string::npos)
      break;
    const auto line =
        1 + std::count(document.begin(), document.begin() + static_cast<std::ptrdiff_t>(mark), '\n');
    const std::string at = source + ": line " + std::to_string(line);
    const std::size_t mark_end = document.find(close, mark);
    const std::size_t end = document.find(end_mark, mark);
    if (mark_end == std::string::npos || end == std::string::npos || end < mark_end)
      throw UsageError(at + ": the mark has no end; write <!-- end --> after what it stands for");
    const std::size_t content = mark_end + close.size();
    const std::string old = document.substr(content, end - content);
    const bool in_line = old.find('\n') == std::string::npos;
    const std::string mark_text = document.substr(mark + open.size(), mark_end - mark - open.size());
    const auto fresh = block_text(mark_text, in_line, at, results, missing);
    text += document.substr(begin, content - begin) +
            (fresh ? (in_line ? *fresh : "\n\n" + trimmed(*fresh) + "\n\n") : old) + end_mark;
    begin = end + end_mark.size();
  }
  return text + document.substr(begin);
}

} // namespace slicelens
