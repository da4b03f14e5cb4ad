// The report's words on what was varied, how it was measured, on what machine, and what has no result.
#include "core/text.h"
#include "study/sweep/report_parts.h"
#include "study/sweep/study_json.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <set>

namespace slicelens::report {

namespace {

constexpr std::size_t shown_values = 12; ///< of an axis
constexpr std::size_t shown_rows = 2000;

std::string definition(const std::string& term, const std::string& html) {
  return html.empty() ? "" : element("dt", escaped(term)) + element("dd", html) + "\n";
}

std::string change_text(const KeyValue& change) { return change.key + " = " + change.value; }

std::string changes_html(const std::vector<KeyValue>& changes) {
  std::string html;
  for (const KeyValue& change : changes)
    html += (html.empty() ? "" : ", ") + code(change_text(change));
  return html;
}

std::vector<std::string> values_in(const SweepAxis& axis, const std::string& column) {
  std::vector<std::string> values;
  for (const SweepValue& value : axis.values) {
    for (const Label& label : value.labels) {
      if (label.first == column && std::find(values.begin(), values.end(), label.second) == values.end())
        values.push_back(label.second);
    }
  }
  return values;
}

std::string values_html(const std::vector<std::string>& values) {
  std::string html;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const bool hidden = values.size() > shown_values && i >= shown_values - 1 && i + 1 < values.size();
    if (hidden && i != shown_values - 1)
      continue;
    html += (html.empty() ? "" : ", ") + (hidden ? std::string("…") : code(values[i]));
  }
  return html;
}

/// A case is its name; what it changes stands below the table.
bool is_case(const SweepValue& value) {
  return value.labels.size() == 1 && (value.scene || value.changes.size() != 1 ||
                                      value.changes.front().key != value.labels.front().first);
}

std::string cases_html(const Study& study) {
  std::string html;
  for (const SweepAxis& axis : study.axes) {
    if (!std::any_of(axis.values.begin(), axis.values.end(), is_case))
      continue;
    std::string items;
    for (const SweepValue& value : axis.values) {
      std::string what = changes_html(value.changes);
      if (value.scene && *value.scene < study.scenes.size())
        what = "scene " + code(study.scenes[*value.scene].name) + (what.empty() ? "" : ", ") + what;
      items +=
          element("li", code(value.labels.front().second) + ": " + (what.empty() ? "as it is" : what)) + "\n";
    }
    html += element("p", "Cases of " + code(axis.values.front().labels.front().first) + ":") +
            element("ul", items, "class=\"plain\"") + "\n";
  }
  return html;
}

std::string axes_html(const Study& study) {
  std::string rows;
  for (const SweepAxis& axis : study.axes) {
    const std::size_t columns = axis.values.front().labels.size();
    for (const Label& label : axis.values.front().labels) {
      const std::vector<std::string> values = values_in(axis, label.first);
      rows += "<tr>" + element("td", code(label.first)) +
              element("td", std::to_string(values.size()), "class=\"number\"") +
              element("td", values_html(values) + (columns > 1 ? " (keys that go together)" : "")) +
              "</tr>\n";
    }
  }
  if (rows.empty())
    return "<p>Nothing was varied: the scene as it is.</p>\n";
  std::string html =
      "<table class=\"list\"><thead><tr><th>varied</th><th class=\"number\">values</th><th>which</th>"
      "</tr></thead><tbody>\n" +
      rows + "</tbody></table>\n" + cases_html(study);
  if (!study.except.empty())
    html += "<p>Some combinations of these are left out by the study's <code>except</code>.</p>\n";
  return html;
}

std::string scenes_named(const Study& study) {
  std::string html;
  for (const BaseScene& scene : study.scenes) {
    html += (html.empty() ? "" : ", ") + code(scene.name.empty() ? scene.source : scene.name);
    if (!scene.name.empty() && scene.source != scene.name)
      html += " (" + code(scene.source) + ")";
  }
  return html;
}

std::string reference_text(const Study& study) {
  if (!study.reference)
    return study.metrics.empty() ? "" : "none: the metrics are of the deformation alone";
  std::string html;
  if (study.reference->scene) {
    const BaseScene& scene = *study.reference->scene;
    html = "the scene " + code(scene.name.empty() ? scene.source : scene.name);
  } else {
    html = "the combination's own scene";
  }
  const std::string changes = changes_html(study.reference->changes);
  return html + (changes.empty() ? "" : " with " + changes);
}

std::string metrics_html(const StudyResults& results) {
  std::string items;
  for (const std::string& metric : results.study.metrics) {
    const std::string what = explanation(metric);
    items += element("li", code(metric) + (what.empty() ? "" : ": " + escaped(what))) + "\n";
  }
  return items.empty() ? "" : element("ul", items, "class=\"plain\"");
}

std::string percent(double fraction) { return number_html(100 * fraction) + " %"; }

std::string baseline_html(const TimingProtocol& timing) {
  std::string html;
  for (const Label& label : timing.baseline)
    html += (html.empty() ? "" : ", ") + code(label.first + " = " + label.second);
  return html.empty()
             ? ""
             : " <code>rate</code> is the time of the baseline (" + html + ") by the row's own" +
                   (timing.beside ? ", drawn just before it at every visit" : ", of the same round") +
                   "; median and quartiles of these ratios.";
}

std::string times(std::size_t count, const std::string& one, const std::string& many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

std::string timing_text(const StudyResults& results) {
  const TimingProtocol& timing = results.study.timing;
  if (!timing.measure)
    return "no frame was timed";
  std::string html = times(timing.rounds, "round", "rounds");
  if (timing.precision > 0 && timing.most_rounds > timing.rounds)
    html += ", up to " + std::to_string(timing.most_rounds) + " until half the " +
            percent(timing.confidence) + " interval of every median is at most " + percent(timing.precision) +
            " of it";
  html += ". A round visits every combination once" +
          std::string(timing.limits ? ", and the machine's fill rates," : ",") +
          " in an order of its own, drawn with seed " + std::to_string(timing.seed) +
          ", so that a machine that drifts hurts all alike. A visit draws " +
          times(timing.warm_up, "frame", "frames") + " that " + (timing.warm_up == 1 ? "does" : "do") +
          " not count and " + times(timing.frames, "that does", "that do") +
          (timing.frames > 1 ? "; its time is their median" : "") +
          (timing.batch > 1 ? "; each is " + std::to_string(timing.batch) +
                                  " pictures in a row, and its time theirs by that number"
                            : "") +
          ". Tables give the median of the visits, first and third quartile in brackets, and their number "
          "<i>n</i>.";
  const std::size_t fewest = smallest_repetitions(timing.confidence);
  if (timing.most_rounds < fewest || (timing.precision <= 0 && timing.rounds < fewest))
    html += " An interval of the median at " + percent(timing.confidence) + " would take " +
            std::to_string(fewest) + " rounds; with these there is none.";
  else
    html += " The rounds are enough for an interval of the median at " + percent(timing.confidence) +
            " confidence.";
  html += baseline_html(timing);
  if (!timing.skip.empty())
    html += " Some combinations are not timed (the study's <code>skip</code>).";
  return html;
}

/// The distinct texts of the rows under a key, with how many rows have each where they differ.
std::string texts_html(const StudyResults& results, const std::string& key) {
  std::vector<std::pair<std::string, std::size_t>> texts;
  for (const Row& row : results.rows) {
    const auto text = row.texts.find(key);
    if (text == row.texts.end() || text->second.empty())
      continue;
    const auto found = std::find_if(texts.begin(), texts.end(),
                                    [&](const auto& entry) { return entry.first == text->second; });
    if (found == texts.end())
      texts.emplace_back(text->second, 1);
    else
      ++found->second;
  }
  std::string html;
  for (const auto& [text, count] : texts)
    html += (html.empty() ? "" : "<br>") + escaped(text) +
            (texts.size() > 1 ? " (" + times(count, "row", "rows") + ")" : "");
  return html;
}

std::string load_text(double load) {
  char text[64];
  std::snprintf(text, sizeof text, "%.2f", load);
  return load < 0 ? "not known" : text;
}

std::string limits_html(const StudyResults& results) {
  if (results.limits.empty())
    return "";
  static const std::map<std::string, std::string> what = {
      {"untextured", "a constant colour"},
      {"textured", "a trilinear fetch"},
      {"classified", "a trilinear fetch and its colour from a table"}};
  std::string rows;
  for (const auto& [name, rate] : results.limits) {
    const auto text = what.find(name);
    rows += "<tr>" + element("td", code(name)) +
            element("td", text == what.end() ? "" : escaped(text->second)) +
            element("td",
                    spread_html(rate.quartiles.median / 1e6, rate.quartiles.first / 1e6,
                                rate.quartiles.third / 1e6),
                    "class=\"number\"") +
            element("td", std::to_string(rate.values.size()), "class=\"number\"") + "</tr>\n";
  }
  return "<p>What this driver can do at best here: squares blended over a whole picture, in the same rounds. "
         "<code>of_limit</code> is a row's fragments a second by the classified rate.</p>\n"
         "<table class=\"list\"><thead><tr><th>fill</th><th>each fragment</th><th class=\"number\">million "
         "fragments a second</th><th class=\"number\">n</th></tr></thead><tbody>\n" +
         rows + "</tbody></table>\n";
}

} // namespace

std::string setup_html(const StudyResults& results) {
  const Study& study = results.study;
  std::string papers;
  for (const PaperValues& paper : study.paper)
    papers += (papers.empty() ? "" : "<br>") + escaped(paper.source) + ", beside " + code(paper.quantity);
  return axes_html(study) + "<dl>\n" + definition("scene", scenes_named(study)) +
         definition("set for all", changes_html(study.set)) + definition("reference", reference_text(study)) +
         definition("metrics", metrics_html(results)) + definition("timing", timing_text(results)) +
         definition("from papers", papers) +
         definition("command",
                    results.command.empty() ? "" : "<code>" + escaped(results.command) + "</code>") +
         "</dl>\n";
}

std::string machine_html(const StudyResults& results) {
  const Machine& machine = results.machine;
  char memory[64] = "";
  if (machine.memory > 0)
    std::snprintf(memory, sizeof memory, "%.1f GB", static_cast<double>(machine.memory) / 1e9);
  return "<dl>\n" + definition("processor", escaped(machine.processor)) +
         definition("threads", machine.threads == 0 ? "" : std::to_string(machine.threads)) +
         definition("memory", memory) + definition("system", escaped(machine.system)) +
         definition("GL_RENDERER", texts_html(results, "renderer")) +
         definition("GL_VERSION", texts_html(results, "gl_version")) +
         definition("context", texts_html(results, "context")) +
         definition("volume texture", texts_html(results, "texture")) +
         definition("slicelens",
                    escaped(machine.version + " " + machine.commit) +
                        (machine.compiler.empty() ? "" : ", built with " + escaped(machine.compiler))) +
         definition("load average", load_text(results.load_at_start) + " at the start, " +
                                        load_text(results.load_at_end) + " at the end") +
         "</dl>\n" + limits_html(results);
}

std::string failures_html(const StudyResults& results) {
  std::string rows;
  std::size_t count = 0;
  for (const Row& row : results.rows) {
    if (row.status == RowStatus::done || ++count > shown_rows)
      continue;
    const bool failed = row.status == RowStatus::failed;
    rows +=
        "<tr>" + element("td", std::to_string(row.combination.index), "class=\"number\"") +
        element("td", "<code>" + escaped(labels_text(row)) + "</code>") +
        element("td", failed ? "failed" : "missing", failed ? "class=\"failed\"" : "") +
        element("td", failed ? escaped(row.error)
                             : "not measured in full: another shard's, or the study was stopped; the same "
                               "command goes on") +
        "</tr>\n";
  }
  if (rows.empty())
    return "";
  std::string html = "<table class=\"list\"><thead><tr><th class=\"number\">#</th><th>combination</th>"
                     "<th>status</th><th>reason</th></tr></thead><tbody>\n" +
                     rows + "</tbody></table>\n";
  if (count > shown_rows)
    html += "<p>These are the first " + std::to_string(shown_rows) + " of " + std::to_string(count) +
            "; <code>results.csv</code> has all.</p>\n";
  return html;
}

} // namespace slicelens::report
