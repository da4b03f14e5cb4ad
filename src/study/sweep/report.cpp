#include "study/sweep/report.h"

#include "core/embedded.h"
#include "core/text.h"
#include "study/sweep/report_parts.h"

#include <algorithm>

namespace slicelens {

const std::vector<EmbeddedFile>& report_files(); // report.css and report.js, compiled into the program

namespace {

using namespace report;

std::string embedded(const std::string& name) {
  for (const EmbeddedFile& file : report_files()) {
    if (file.name == name)
      return file.text;
  }
  return "";
}

std::size_t count_of(const StudyResults& results, RowStatus status) {
  return static_cast<std::size_t>(std::count_if(results.rows.begin(), results.rows.end(),
                                                [&](const Row& row) { return row.status == status; }));
}

std::string counted(std::size_t count, const std::string& one, const std::string& many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

std::string header_html(const StudyResults& results) {
  const Study& study = results.study;
  const std::size_t failed = count_of(results, RowStatus::failed);
  const std::size_t missing = count_of(results, RowStatus::missing);
  std::string html =
      element("h1", escaped(study.title.empty() ? study.name : study.title)) + "\n" + paragraphs(study.text);
  std::string line = "Study " + code(study.name) + ", " +
                     counted(results.rows.size(), "combination", "combinations") + ", " +
                     std::to_string(count_of(results, RowStatus::done)) + " measured.";
  line += " The same results as files: <a href=\"results.csv\"><code>results.csv</code></a>, "
          "<a href=\"results.json\"><code>results.json</code></a> (every sample), "
          "<a href=\"study.json\"><code>study.json</code></a>.";
  html += element("p", line, "class=\"summary\"") + "\n";
  if (failed + missing > 0) {
    std::string text;
    if (failed > 0)
      text += counted(failed, "combination failed", "combinations failed");
    if (missing > 0)
      text += (text.empty() ? "" : ", ") + counted(missing, "was not measured", "were not measured");
    html += element("p", text + "; <a href=\"#failures\">which and why</a>.", "class=\"notice\"") + "\n";
  }
  return element("header", html) + "\n";
}

/// Links to the sections that are there.
std::string navigation(const std::string& body) {
  static const std::pair<const char*, const char*> all[] = {
      {"setup", "What was varied"},   {"machine", "Machine"},
      {"failures", "Without result"}, {"tables", "Results"},
      {"charts", "Charts"},           {"pictures", "Pictures"},
      {"more", "More tables"},        {"scenes", "Scenes and commands"}};
  std::string html;
  for (const auto& [id, name] : all) {
    if (body.find("<section id=\"" + std::string(id) + "\">") != std::string::npos)
      html += "<a href=\"#" + std::string(id) + "\">" + name + "</a> ";
  }
  return element("nav", html) + "\n";
}

} // namespace

std::string report_html(const StudyResults& results, const std::filesystem::path& folder) {
  const std::string body = section("setup", "What was varied and how it was measured", setup_html(results)) +
                           section("machine", "The machine", machine_html(results)) +
                           section("failures", "Without result", failures_html(results)) +
                           section("tables", "Results", tables_html(results)) +
                           section("charts", "Charts", charts_html(results)) +
                           section("pictures", "Pictures", pictures_html(results, folder)) +
                           section("more", "More tables", more_tables_html(results)) +
                           section("scenes", "Scenes and commands", scenes_html(results));
  const std::string title = results.study.title.empty() ? results.study.name : results.study.title;
  // The policy forbids every load, so that nothing in the results can bring one in.
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; "
         "style-src 'unsafe-inline'; script-src 'unsafe-inline'\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n" +
         element("title", escaped(title)) + "\n<style>\n" + embedded("report.css") +
         "</style>\n</head>\n<body>\n" + header_html(results) + navigation(body) + body + "<script>\n" +
         embedded("report.js") + "</script>\n</body>\n</html>\n";
}

} // namespace slicelens
