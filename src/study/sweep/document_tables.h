// Tables and numbers of documents, made anew from measured results: nobody copies figures by hand.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace slicelens {

/// Replaces what stands between marks in a Markdown text. Marks are comments, so that readers do not see
/// them:
///
///     <!-- study lamar-table3: lens; rate:2 [] "fraction"; LaMar 2001, Table 3:2 | volume=head -->
///     …
///     <!-- end -->
///
/// A table of `results`/lamar-table3/results.csv: after the colon its columns, separated by semicolons; ":2"
/// is the number of decimals (":e" three digits with an exponent), "[]" adds the quartiles, a text in quotes
/// heads the column. After "|" conditions COLUMN=VALUE, separated by semicolons, choose rows. Rows that
/// failed say so in place of numbers.
///
///     about <!-- study scaling: draw_s:3 | part=image; render.size=[512,512] -->0.123<!-- end --> s
///
/// On one line: the single value.
///
///     <!-- output accuracy/modes.md -->
///     …
///     <!-- end -->
///
/// The text of that file under `results`.
///
/// Blocks whose results are not there stay as they are; their names go to `missing`. Throws UsageError naming
/// `source` and line for a mark that is none, has no end, names no column of the results, or asks for one
/// value where the results have none or several; FileError for results that cannot be read.
std::string with_results(const std::string& document, const std::string& source,
                         const std::filesystem::path& results, std::vector<std::string>& missing);

/// The cells of a CSV text (RFC 4180), row by row. Throws UsageError for a quote without its end.
std::vector<std::vector<std::string>> csv_cells(const std::string& text);

} // namespace slicelens
