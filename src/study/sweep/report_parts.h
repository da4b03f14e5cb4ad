// The parts of the report as HTML, and how texts and numbers stand in it. For the report's files only.
#pragma once

#include "study/sweep/results.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace slicelens::report {

/// For texts and for attributes in double quotes; bytes that are not UTF-8 and control characters become �.
std::string escaped(const std::string& text);

/// <code>…</code> with places where long names may break.
std::string code(const std::string& text);

/// <tag class="…">…</tag>; `html` is taken as it is.
std::string element(const std::string& tag, const std::string& html, const std::string& attributes = "");

/// <section> with a heading, or nothing when there is nothing in it.
std::string section(const std::string& id, const std::string& title, const std::string& html);

/// Plain paragraphs: an empty line ends one.
std::string paragraphs(const std::string& text);

/// In four significant digits: "31.62", "0.00123", "12 345 678" (whole numbers in full, with narrow spaces),
/// "4.120×10⁻⁶" as HTML; up to six where four would round to 1 what is not 1, and "&gt; 0.999999" beyond.
std::string number_html(double value);

/// "12.3 [12.1, 12.9]" with as many decimals as tell the quartiles apart, at least three significant digits
/// of the median.
std::string spread_html(double median, double first, double third);

/// "a = 1, b = 2" of a row's labels.
std::string labels_text(const Row& row);

bool contains(const std::vector<std::string>& names, const std::string& name);

/// What a metric or another column of the results is, in one line of text; empty for what is not known.
std::string explanation(const std::string& column);

/// A unit that numbers of a column are shown in: shown value = value · scale.
struct Unit {
  double scale = 1;
  std::string name; ///< empty: none
};

/// Seconds and bytes in the unit that fits the largest of the column's values.
Unit unit_of(const StudyResults& results, const std::string& column);

/// Whether every label of the column is a number.
bool is_numeric(const StudyResults& results, const std::string& column);

/// Columns of all axes, in their order.
std::vector<std::string> varied_columns(const StudyResults& results);

std::string setup_html(const StudyResults& results);
std::string machine_html(const StudyResults& results);
std::string failures_html(const StudyResults& results);
std::string tables_html(const StudyResults& results);
std::string more_tables_html(const StudyResults& results); ///< phases and counts
std::string charts_html(const StudyResults& results);
std::string pictures_html(const StudyResults& results, const std::filesystem::path& folder);
std::string scenes_html(const StudyResults& results);

} // namespace slicelens::report
