// The report's tables: a few that fit the page in place of one that does not.
#include "core/text.h"
#include "study/sweep/report_parts.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

namespace slicelens::report {

namespace {

constexpr std::size_t shown_rows = 2000;
constexpr std::size_t line_width = 158; ///< characters of a table that fits 1280 pixels

struct TableColumn {
  std::string name; ///< of columns_of
  std::string note; ///< unit and what the numbers are, below the name
  Unit unit;
  bool text = false;
  bool quartiles = false;
};

using Columns = std::vector<TableColumn>;

/// The pictures are equal, of which psnr has no number.
bool is_equal(const Row& row, const std::string& column) {
  return (column == "psnr" || column == "psnr_covered") &&
         std::any_of(row.values.begin(), row.values.end(),
                     [&](const Value& value) { return value.first == column && !value.second; });
}

bool holds_anything(const StudyResults& results, const std::string& column) {
  return std::any_of(results.rows.begin(), results.rows.end(), [&](const Row& row) {
    return !cell(results, row, column).empty() || is_equal(row, column);
  });
}

bool is_paper(const StudyResults& results, const std::string& column) {
  return std::any_of(results.study.paper.begin(), results.study.paper.end(),
                     [&](const PaperValues& paper) { return paper.source == column; });
}

TableColumn table_column(const StudyResults& results, const std::string& name) {
  TableColumn column;
  column.name = name;
  const std::vector<std::string> varied = varied_columns(results);
  const bool label = contains(varied, name);
  column.text = (label && !is_numeric(results, name)) || name == "status" || name == "error";
  column.unit = label ? Unit{} : unit_of(results, name);
  column.note = column.unit.name;
  column.quartiles = name == "draw_s" || name == "rate" || name == "processor_rate";
  if (column.quartiles)
    column.note += std::string(column.note.empty() ? "" : ", ") + "median [q1, q3]";
  if (name == "draw_s_n")
    column.note = "visits";
  if (name == "psnr" || name == "psnr_covered")
    column.note = "dB";
  for (const PaperValues& paper : results.study.paper) {
    if (paper.source != name)
      continue;
    column.unit = unit_of(results, paper.quantity);
    column.note = "paper's " + paper.quantity + (column.unit.name.empty() ? "" : ", " + column.unit.name);
  }
  return column;
}

std::string cell_html(const StudyResults& results, const Row& row, const TableColumn& column) {
  if (column.name == "index")
    return element("a", cell(results, row, "index"),
                   "href=\"#row-" + std::to_string(row.combination.index) + "\"");
  const std::string text = cell(results, row, column.name);
  const std::vector<std::string> varied = varied_columns(results);
  if (column.text || contains(varied, column.name))
    return escaped(text);
  const auto number = number_in(results, row, column.name);
  if (!number)
    return is_equal(row, column.name) ? "equal" : escaped(text);
  const double scale = column.unit.scale;
  if (column.quartiles) {
    const auto first = number_in(results, row, column.name + "_q1");
    const auto third = number_in(results, row, column.name + "_q3");
    if (first && third)
      return spread_html(*number * scale, *first * scale, *third * scale);
  }
  // A paper's number as it was printed.
  if (is_paper(results, column.name) && scale == 1)
    return number_text(*number);
  return number_html(*number * scale);
}

/// What sorting goes by, where it is not the text.
std::string sort_key(const StudyResults& results, const Row& row, const TableColumn& column) {
  if (column.text)
    return "";
  const auto number = number_in(results, row, column.name);
  return number ? " data-v=\"" + number_text(*number) + "\"" : "";
}

/// Characters of the text in HTML.
std::size_t text_length(const std::string& html) {
  std::size_t length = 0;
  bool tag = false;
  bool entity = false;
  for (const char c : html) {
    if (c == '<' || c == '>')
      tag = c == '<';
    else if (entity)
      entity = c != ';';
    else if (!tag && (static_cast<unsigned char>(c) & 0xc0U) != 0x80) {
      ++length;
      entity = c == '&';
    }
  }
  return length;
}

/// The longest piece of a name that does not break.
std::size_t longest_piece(const std::string& name) {
  std::size_t longest = 0;
  std::size_t length = 0;
  for (const char c : name) {
    ++length;
    longest = std::max(longest, length);
    if (c == '_' || c == '.' || c == ' ' || c == '/')
      length = 0;
  }
  return longest;
}

std::size_t width_of(const StudyResults& results, const TableColumn& column) {
  std::size_t width = std::max(longest_piece(column.name) + 2, std::min<std::size_t>(column.note.size(), 10));
  for (std::size_t i = 0; i < std::min(results.rows.size(), shown_rows); ++i)
    width = std::max(width, text_length(cell_html(results, results.rows[i], column)));
  return std::min<std::size_t>(width, 40) + 3;
}

std::string head_html(const TableColumn& column) {
  const std::string what = explanation(column.name);
  const std::string name = column.name == "index" ? "#" : code(column.name);
  return "<th scope=\"col\"" + std::string(column.text ? "" : " class=\"number\"") +
         (what.empty() ? "" : " title=\"" + escaped(what) + "\"") + ">" + name +
         (column.note.empty() ? "" : "<small>" + escaped(column.note) + "</small>") + "</th>";
}

std::string table_html(const StudyResults& results, const Columns& columns) {
  std::string html = "<div class=\"wide\"><table class=\"sortable\"><thead><tr>";
  for (const TableColumn& column : columns)
    html += head_html(column);
  html += "</tr></thead><tbody>\n";
  for (std::size_t i = 0; i < std::min(results.rows.size(), shown_rows); ++i) {
    const Row& row = results.rows[i];
    html += row.status == RowStatus::done ? "<tr>" : "<tr class=\"without\">";
    for (const TableColumn& column : columns)
      html += std::string("<td") + (column.text ? "" : " class=\"number\"") + sort_key(results, row, column) +
              ">" + cell_html(results, row, column) + "</td>";
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

/// Tables of a group, each with the columns that say which row it is.
std::string group_html(const StudyResults& results, const std::string& title, const Columns& lead,
                       const Columns& columns) {
  if (columns.empty())
    return "";
  std::size_t lead_width = 0;
  for (const TableColumn& column : lead)
    lead_width += width_of(results, column);
  std::size_t all = 0;
  for (const TableColumn& column : columns)
    all += width_of(results, column);
  // As many tables as it takes, all about as wide.
  const std::size_t room = line_width > lead_width + 40 ? line_width - lead_width : 40;
  const std::size_t tables = (all + room - 1) / room;
  std::string html = title.empty() ? "" : element("h3", escaped(title)) + "\n";
  Columns part = lead;
  std::size_t width = 0;
  for (const TableColumn& column : columns) {
    const std::size_t needed = width_of(results, column);
    if (part.size() > lead.size() && (width + needed > room || width >= all / tables + 1)) {
      html += table_html(results, part);
      part = lead;
      width = 0;
    }
    part.push_back(column);
    width += needed;
  }
  return html + table_html(results, part);
}

/// The names with those of papers behind the quantities that they compare with.
std::vector<std::string> with_papers(const StudyResults& results, const std::vector<std::string>& names) {
  std::vector<std::string> all;
  const auto add = [&](const std::string& name) {
    if (!contains(all, name))
      all.push_back(name);
  };
  for (const std::string& name : names) {
    if (is_paper(results, name))
      continue;
    add(name);
    for (const PaperValues& paper : results.study.paper) {
      if (paper.quantity == name && holds_anything(results, paper.source))
        add(paper.source);
    }
  }
  for (const std::string& name : names) // of quantities that are not there
    add(name);
  return all;
}

Columns columns_named(const StudyResults& results, const std::vector<std::string>& names) {
  Columns columns;
  for (const std::string& name : names)
    columns.push_back(table_column(results, name));
  return columns;
}

bool all_done(const StudyResults& results) {
  return std::all_of(results.rows.begin(), results.rows.end(),
                     [](const Row& row) { return row.status == RowStatus::done; });
}

std::string chosen_html(const StudyResults& results) {
  std::vector<std::string> names;
  for (const std::string& name : results.study.columns) {
    if (name != "index" && holds_anything(results, name))
      names.push_back(name);
  }
  std::vector<std::string> lead = {"index"};
  if (!all_done(results) && !contains(names, "status"))
    lead.push_back("status");
  return group_html(results, "", columns_named(results, lead),
                    columns_named(results, with_papers(results, names)));
}

/// The columns that hold anything, by what they are about.
struct Groups {
  std::vector<std::string> lead, results, phases, counts;
};

Groups groups_of(const StudyResults& results) {
  Groups groups;
  std::vector<std::string>& lead = groups.lead;
  lead = {"index"};
  for (const std::string& name : varied_columns(results))
    lead.push_back(name);
  if (!all_done(results))
    lead.push_back("status");
  static const std::set<std::string> measured = {"draw_s", "draw_s_n", "rate", "processor_rate", "of_limit"};
  static const std::set<std::string> elsewhere = {"rate_q1",           "rate_q3",   "processor_rate_q1",
                                                  "processor_rate_q3", "draw_s_q1", "draw_s_q3",
                                                  "renderer",          "error",     "status"};
  for (const Column& column : columns_of(results)) {
    const std::string& name = column.name;
    if (contains(lead, name) || elsewhere.count(name) != 0 || !holds_anything(results, name))
      continue;
    const std::vector<std::string>& metrics = results.study.metrics;
    const bool metric = contains(metrics, name);
    if (metric || measured.count(name) != 0 || is_paper(results, name))
      groups.results.push_back(name);
    else if (name.ends_with("_s") || name.find("_s_") != std::string::npos)
      groups.phases.push_back(name);
    else
      groups.counts.push_back(name);
  }
  return groups;
}

std::string all_html(const StudyResults& results) {
  const Groups groups = groups_of(results);
  return group_html(results, "Quality and time", columns_named(results, groups.lead),
                    columns_named(results, with_papers(results, groups.results)));
}

} // namespace

std::string tables_html(const StudyResults& results) {
  std::string html = results.study.columns.empty() ? all_html(results) : chosen_html(results);
  if (html.empty())
    return "<p>No combination has a number to show.</p>\n";
  std::string above = "<p class=\"screen\">A click on a heading sorts; numbers in the first column lead to "
                      "the row's scene.</p>\n";
  if (!results.study.columns.empty())
    above += "<p>The columns that the study names; <code>results.csv</code> has all.</p>\n";
  if (results.rows.size() > shown_rows)
    above += "<p>The first " + std::to_string(shown_rows) + " of " + std::to_string(results.rows.size()) +
             " rows; <code>results.csv</code> has all.</p>\n";
  return above + html;
}

std::string more_tables_html(const StudyResults& results) {
  if (!results.study.columns.empty())
    return "";
  const Groups groups = groups_of(results);
  const Columns lead = columns_named(results, groups.lead);
  return group_html(results, "Where the time goes", lead, columns_named(results, groups.phases)) +
         group_html(results, "What was drawn", lead, columns_named(results, groups.counts));
}

} // namespace slicelens::report
