// The report's list of every row's scene and of the command that renders it alone.
#include "scene/image_scene.h"
#include "study/sweep/report_parts.h"
#include "study/sweep/study_json.h"

#include <algorithm>

namespace slicelens::report {

namespace {

using study_json::Json;

constexpr std::size_t most_bytes = std::size_t{5} << 20; ///< of scenes
constexpr std::size_t line_length = 100;
constexpr std::size_t shown_rows = 2000;

/// Indented, but what fits a line stands in one.
std::string readable(const Json& json, std::size_t indent = 0) {
  const std::string line = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  if ((!json.is_object() && !json.is_array()) || json.empty() ||
      (indent > 0 && line.size() + 2 * indent <= line_length))
    return line;
  const std::string space(2 * (indent + 1), ' ');
  std::string text;
  for (const auto& [key, value] : json.items())
    text += (text.empty() ? "" : ",\n") + space +
            (json.is_object() ? Json(key).dump(-1, ' ', false, Json::error_handler_t::replace) + ": " : "") +
            readable(value, indent + 1);
  const std::string end(2 * indent, ' ');
  return (json.is_object() ? "{\n" : "[\n") + text + "\n" + end + (json.is_object() ? "}" : "]");
}

/// What draws the scene in a file, up to its name.
std::string command_of(const Row& row) {
  if (row.combination.peer)
    return "tools/render_with_vtk --mapper " + *row.combination.peer;
  return is_image_scene(row.scene) ? "slicelens lens" : "slicelens render";
}

std::string row_html(const Row& row, bool with_scene) {
  const std::string index = std::to_string(row.combination.index);
  const std::string command = command_of(row);
  const std::string output = " -o row-" + index + ".png</pre>\n";
  std::string inner = "<pre class=\"command\">" + escaped(command) + " scene.json" + output;
  const auto picture = row.texts.find("picture");
  if (picture != row.texts.end() && !row.combination.peer)
    inner += "<p>or, from this folder, of the picture itself:</p>\n<pre class=\"command\">" +
             escaped(command) + " " + escaped(picture->second) + output;
  if (row.scene.empty())
    inner = element("p", "There is no such scene" +
                             std::string(row.error.empty() ? "." : ": " + escaped(row.error)));
  else if (with_scene) {
    const Json json = Json::parse(row.scene, nullptr, false);
    inner += "<p><code>scene.json</code>:</p>\n<pre>" +
             escaped(json.is_discarded() ? row.scene : readable(json)) + "</pre>\n";
  } else {
    inner += "<p>The scene is in <code>results.json</code>.</p>\n";
  }
  return "<details id=\"row-" + index + "\"><summary>" + index + " <code>" + escaped(labels_text(row)) +
         "</code></summary>\n" + inner + "</details>\n";
}

/// Folders that relative file names in the scenes count from.
std::string folders_html(const StudyResults& results) {
  std::vector<std::string> folders;
  for (const BaseScene& scene : results.study.scenes) {
    const std::string folder = scene.folder.empty() ? "." : scene.folder.string();
    if (std::find(folders.begin(), folders.end(), folder) == folders.end())
      folders.push_back(folder);
  }
  std::string html;
  for (const std::string& folder : folders)
    html += (html.empty() ? "" : ", ") + (folder == "." ? "the folder it was run in" : code(folder));
  return html.empty()
             ? ""
             : " Relative file names in a scene count from the folder of its file; in this study from " +
                   html + ".";
}

} // namespace

std::string scenes_html(const StudyResults& results) {
  std::string html =
      "<p>" +
      std::string(results.command.empty() ? ""
                                          : "All of it: <code>" + escaped(results.command) + "</code>. ") +
      "One row alone: store its scene as <code>scene.json</code> and render it, or render its picture "
      "again, which carries the scene." +
      folders_html(results) + "</p>\n<div class=\"scenes\">\n";
  std::size_t bytes = 0;
  for (std::size_t i = 0; i < std::min(results.rows.size(), shown_rows); ++i) {
    bytes += results.rows[i].scene.size();
    html += row_html(results.rows[i], bytes <= most_bytes);
  }
  html += "</div>\n";
  if (results.rows.size() > shown_rows)
    html += "<p>The first " + std::to_string(shown_rows) + " of " + std::to_string(results.rows.size()) +
            " rows; <code>results.json</code> has all.</p>\n";
  return html;
}

} // namespace slicelens::report
