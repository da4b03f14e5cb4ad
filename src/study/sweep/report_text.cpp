// Texts, numbers and units of the report.
#include "core/text.h"
#include "study/sweep/report_parts.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>

namespace slicelens::report {

namespace {

/// Bytes of the UTF-8 sequence that starts at `at`, 0 where none does.
std::size_t sequence_length(const std::string& text, std::size_t at) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned first = byte(at);
  const std::size_t length = first < 0x80 ? 1 : first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if ((first >= 0x80 && first < 0xc2) || first > 0xf4 || at + length > text.size())
    return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(at + i) & 0xc0U) != 0x80)
      return 0;
  }
  return length;
}

std::string fixed(double value, int decimals) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", std::clamp(decimals, 0, 17), value);
  return text;
}

/// Decimals that show `digits` significant digits of a value that is not 0.
int decimals_for(double value, int digits) {
  return std::max(0, digits - 1 - static_cast<int>(std::floor(std::log10(std::abs(value)))));
}

std::string grouped(double whole) {
  const std::string digits = fixed(std::abs(whole), 0);
  std::string text = whole < 0 ? "−" : "";
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && (digits.size() - i) % 3 == 0 && digits.size() > 4)
      text += "\u202f";
    text += digits[i];
  }
  return text;
}

/// "4.12×10<sup>−6</sup>"
std::string scientific(double value) {
  int exponent = static_cast<int>(std::floor(std::log10(std::abs(value))));
  double mantissa = value / std::pow(10.0, exponent);
  if (fixed(std::abs(mantissa), 2) == "10.00") {
    mantissa /= 10;
    ++exponent;
  }
  return fixed(mantissa, 2) + "×10<sup>" + (exponent < 0 ? "−" : "") + std::to_string(std::abs(exponent)) +
         "</sup>";
}

const std::map<std::string, std::string>& explanations() {
  static const std::map<std::string, std::string> all = {
      {"psnr",
       "peak signal-to-noise ratio, −10 log10 of the mean squared difference, in dB; higher is better"},
      {"psnr_covered", "the same over the pixels that either picture covers, in dB; higher is better"},
      {"ssim", "structural similarity of the luma, mean of the picture; 1 is equal"},
      {"ms_ssim", "structural similarity over five scales; 1 is equal, nothing below 176 pixels"},
      {"flip", "mean FLIP error, what a viewer who flips between the pictures notices; 0 is equal"},
      {"rmse", "root of the mean squared difference of display values in [0,1]; 0 is equal"},
      {"mean_abs", "mean absolute difference of display values in [0,1]; 0 is equal"},
      {"max_abs", "largest absolute difference of display values in [0,1]; 0 is equal"},
      {"magnification", "of the deformation at its focus, in the picture"},
      {"magnification_max", "largest magnification in the picture, of the displayed points"},
      {"magnification_volume", "of lengths in all three directions at the focus, |det J|^(−1/3)"},
      {"magnification_volume_max", "largest magnification of lengths, of the displayed points"},
      {"fold_over",
       "fraction of the displayed points with det J ≤ 0, where the picture is turned inside out"},
      {"jacobian_min", "smallest det J of the inverse map; at or below 0 it folds"},
      {"jump", "largest jump of the map between points 10⁻⁷ apart, in longest edges of the box"},
      {"samples_per_voxel", "samples that one voxel at the focus gets along the ray"},
      {"focus_share", "fraction of the picture's pixels whose ray meets the focus"},
      {"draw_s", "wall clock of one frame, with a full finish"},
      {"draw_gpu_s", "the driver's own timer of the same drawing"},
      {"draw_processor_s", "processor time of the same drawing, of all threads"},
      {"upload_s", "volume and tables to the driver"},
      {"compile_s", "shader programs"},
      {"slice_s", "planes against the box"},
      {"tessellate_s", "slices into triangles"},
      {"read_s", "the picture back from the driver"},
      {"rate", "the baseline's time by the row's own, round by round: above 1 is faster than the baseline"},
      {"processor_rate", "the same of processor time"},
      {"fragments_per_s", "fragments drawn, by the median time of drawing"},
      {"samples_per_s", "samples taken, by the median time of drawing"},
      {"of_limit", "fragments a second, as a fraction of this machine's classified fill"},
      {"peak_bytes", "largest memory of the process while it drew the picture"},
      {"texture_bytes", "memory of the textures"},
      {"brick_parts", "times that bricks were asked for in one picture"},
      {"bricks_loaded", "bricks brought into the pool for one picture"},
      {"read_bytes", "bytes taken from the volume's file for one picture"}};
  return all;
}

} // namespace

std::string escaped(const std::string& text) {
  std::string html;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = sequence_length(text, i);
    const char c = text[i];
    const auto byte = static_cast<unsigned char>(c);
    if (length == 0 || byte == 0x7f || (byte < 0x20 && c != '\n' && c != '\t'))
      html += "\ufffd";
    else if (c == '<')
      html += "&lt;";
    else if (c == '>')
      html += "&gt;";
    else if (c == '&')
      html += "&amp;";
    else if (c == '"')
      html += "&quot;";
    else if (c == '\'')
      html += "&#39;";
    else
      html += text.substr(i, length);
    i += std::max<std::size_t>(length, 1);
  }
  return html;
}

std::string code(const std::string& text) {
  std::string html;
  std::string piece;
  for (const char c : text) {
    piece += c;
    if (c == '_' || c == '.' || c == '/') {
      html += escaped(piece) + "<wbr>";
      piece.clear();
    }
  }
  return "<code>" + html + escaped(piece) + "</code>";
}

std::string element(const std::string& tag, const std::string& html, const std::string& attributes) {
  return "<" + tag + (attributes.empty() ? "" : " ") + attributes + ">" + html + "</" + tag + ">";
}

std::string section(const std::string& id, const std::string& title, const std::string& html) {
  if (html.empty())
    return "";
  return "<section id=\"" + id + "\">\n" + element("h2", escaped(title)) + "\n" + html + "</section>\n";
}

std::string paragraphs(const std::string& text) {
  std::string html;
  for (std::size_t start = 0; start < text.size();) {
    const std::size_t end = std::min(text.find("\n\n", start), text.size());
    const std::string part = text.substr(start, end - start);
    if (part.find_first_not_of(" \n\t") != std::string::npos)
      html += element("p", escaped(part)) + "\n";
    start = end + 2;
  }
  return html;
}

std::string number_html(double value) {
  if (std::isnan(value))
    return "not a number";
  if (std::isinf(value))
    return value < 0 ? "−∞" : "∞";
  if (value == 0)
    return "0";
  const double size = std::abs(value);
  if (value == std::floor(value) && size < 1e12)
    return grouped(value);
  if (size < 1e-4 || size >= 1e9)
    return scientific(value);
  if (size >= 1e4)
    return grouped(std::round(value));
  int decimals = decimals_for(value, 4);
  if (size < 1) { // .99998 is no 1
    while (decimals < 6 && fixed(size, decimals) == fixed(1, decimals))
      ++decimals;
    if (fixed(size, decimals) == fixed(1, decimals))
      return value < 0 ? "&lt; −0.999999" : "&gt; 0.999999";
  }
  return (value < 0 ? "−" : "") + fixed(size, decimals);
}

std::string spread_html(double median, double first, double third) {
  const double range = third - first;
  int decimals = median == 0 ? 2 : decimals_for(median, 3);
  if (range > 0 && range < std::pow(10.0, -decimals))
    decimals = std::min({decimals_for(range, 1), decimals + 2, 12});
  return "<b>" + fixed(median, decimals) + "</b> <span class=\"quartiles\">[" + fixed(first, decimals) +
         ", " + fixed(third, decimals) + "]</span>";
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::string labels_text(const Row& row) {
  std::string text;
  for (const Label& label : row.combination.labels)
    text += (text.empty() ? "" : ", ") + label.first + " " + label.second;
  return text.empty() ? "the scene as it is" : text;
}

std::string explanation(const std::string& column) {
  const auto found = explanations().find(column);
  if (found != explanations().end())
    return found->second;
  int k = 0;
  int used = 0;
  if (std::sscanf(column.c_str(), "over_%d_255%n", &k, &used) == 1 && used == static_cast<int>(column.size()))
    return "fraction of the display values that differ by more than " + std::to_string(k) + "/255";
  return "";
}

Unit unit_of(const StudyResults& results, const std::string& column) {
  const bool seconds = column.ends_with("_s") || column.find("_s_") != std::string::npos;
  const bool rate = column.ends_with("_per_s");
  const bool bytes = column.ends_with("_bytes");
  if ((!seconds && !bytes && !rate) || column.ends_with("_n"))
    return {};
  // Quartiles and the like are shown in the unit of their median.
  const std::size_t middle = column.find("_s_");
  const std::string base = rate || middle == std::string::npos ? column : column.substr(0, middle + 2);
  double largest = 0;
  for (const Row& row : results.rows)
    largest = std::max(largest, number_in(results, row, base).value_or(0));
  if (rate)
    return largest >= 1e6 ? Unit{1e-6, "million a second"} : Unit{1, "a second"};
  if (bytes)
    return {1.0 / (1 << 20), "MiB"};
  return largest < 1 ? Unit{1000, "ms"} : Unit{1, "s"};
}

std::vector<std::string> varied_columns(const StudyResults& results) {
  std::vector<std::string> columns;
  for (const SweepAxis& axis : results.study.axes) {
    for (const Label& label : axis.values.front().labels) {
      if (!contains(columns, label.first))
        columns.push_back(label.first);
    }
  }
  return columns;
}

bool is_numeric(const StudyResults& results, const std::string& column) {
  return !results.rows.empty() && std::all_of(results.rows.begin(), results.rows.end(), [&](const Row& row) {
    return number_in(results, row, column).has_value();
  });
}

} // namespace slicelens::report
