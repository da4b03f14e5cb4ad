#include "study/gallery.h"

#include <cstdio>
#include <optional>

namespace slicelens {

namespace {

const char* const style = R"(
body { font: 15px/1.5 system-ui, sans-serif; margin: 2rem auto; max-width: 1240px; padding: 0 1rem; color: #222; background: #fafafa; }
h1 { margin-bottom: 0; } .lead { color: #555; margin-top: .2rem; }
article { background: #fff; border: 1px solid #ddd; border-radius: 6px; padding: 1rem; margin: 1.2rem 0; }
article h2 { margin: 0 0 .6rem; font-size: 1.1rem; }
.pictures { display: flex; flex-wrap: wrap; gap: .8rem; }
figure { margin: 0; flex: 1 1 300px; max-width: 400px; } figure img { width: 100%; background: #000; display: block; }
figcaption { font-size: .85rem; color: #555; }
table { border-collapse: collapse; margin: .8rem 0; } td, th { padding: .15rem .8rem .15rem 0; text-align: left; font-variant-numeric: tabular-nums; }
pre { background: #f4f4f4; padding: .6rem; overflow: auto; font-size: .8rem; } summary { cursor: pointer; color: #555; }
@media print { article { break-inside: avoid; } }
)";

std::string formatted(const char* format, double value) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, format, value);
  return buffer;
}

std::string decibels(const std::optional<double>& value) {
  return value ? formatted("%.1f dB", *value) : std::string("equal");
}

std::string figure(const std::string& file, const std::string& caption) {
  return "<figure><a href=\"" + html_text(file) + "\"><img src=\"" + html_text(file) + "\" alt=\"" +
         html_text(caption) + "\"></a><figcaption>" + html_text(caption) + "</figcaption></figure>\n";
}

std::string row(const std::string& name, const std::string& value) {
  return "<tr><th>" + html_text(name) + "</th><td>" + html_text(value) + "</td></tr>\n";
}

std::string metrics_text(const Metrics& m) {
  return "PSNR " + decibels(m.psnr) + " (covered pixels " + decibels(m.psnr_covered) + "), SSIM " +
         formatted("%.5f", m.ssim) + ", largest difference " + formatted("%.2g", m.max_abs) + ", " +
         formatted("%.3g %%", 100 * m.over_1_255) + " of the values differ by more than 1/255";
}

std::string article(const GalleryEntry& entry) {
  std::string text = "<article id=\"" + html_text(entry.name) + "\">\n<h2>" + html_text(entry.title) +
                     "</h2>\n<div class=\"pictures\">\n";
  for (const GalleryPicture& picture : entry.pictures)
    text += figure(picture.file, picture.caption);
  text += "</div>\n<table>\n" + row("data", entry.data);
  for (const GalleryComparison& comparison : entry.comparisons)
    text += row(comparison.what, metrics_text(comparison.metrics));
  text += "</table>\n<details><summary>scene, and the command that renders it</summary>\n<pre>" +
          html_text(entry.command) + "</pre>\n<pre>" + html_text(entry.scene_json) +
          "</pre></details>\n</article>\n";
  return text;
}

} // namespace

std::string html_text(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
    case '&':
      result += "&amp;";
      break;
    case '<':
      result += "&lt;";
      break;
    case '>':
      result += "&gt;";
      break;
    case '"':
      result += "&quot;";
      break;
    default:
      result += c;
    }
  }
  return result;
}

std::string gallery_page(const std::string& title, const std::string& lead,
                         const std::vector<GalleryEntry>& entries, const std::string& driver,
                         double seconds) {
  std::string page =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" "
      "content=\"width=device-width\">\n<title>" +
      html_text(title) + "</title>\n<style>" + std::string(style) + "</style>\n</head>\n<body>\n<h1>" +
      html_text(title) + "</h1>\n<p class=\"lead\">" + html_text(lead) + " Drawn by " + html_text(driver) +
      " in " + formatted("%.1f s", seconds) + ".</p>\n";
  for (const GalleryEntry& entry : entries)
    page += article(entry);
  return page + "</body>\n</html>\n";
}

} // namespace slicelens
