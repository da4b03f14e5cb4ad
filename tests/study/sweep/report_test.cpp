// The report of hand-made results: what stands in it, what follows from them, and how a browser takes it.
#include "catch.h"
#include "core/errors.h"
#include "core/files.h"
#include "image/image_io.h"
#include "study/gnuplot.h"
#include "study/sweep/report.h"
#include "study/sweep/report_charts.h"
#include "study/sweep/report_parts.h"
#include "temporary_folder.h"

#include <cstdlib>
#include <random>
#include <regex>

using namespace slicelens;
using report::charts_of;
using report::ReportChart;

namespace fs = std::filesystem;

namespace {

const char* const spacing_study = R"({"title": "Slices <against> \"rays\" & more",
  "text": "First & foremost.\n\nSecond <b>paragraph</b>.",
  "vary": [{"render.spacing": [4, 2, 1, 0.5]}, {"name": "what", "cases": {"plain": {}, "<i>\"odd\" & 'so'": {"render.jitter": 1}}}],
  "reference": {"set": {"render.pipeline": "reference"}}, "metrics": ["rmse", "psnr"],
  "timing": {"rounds": 3, "baseline": {"what": "plain"}},
  "paper": [{"source": "Paper 2001, Table 3", "quantity": "rate", "values": [{"when": {"what": "plain", "render.spacing": 2}, "value": 0.515}]}]})";

Spread spread(double low, double middle, double high) { return spread_of({low, middle, high}); }

Study study(const std::string& text) { return study_from_json(text, "test.json", "."); }

/// Every combination with rmse = h² (half of it for the second case), and times of .1/h s.
StudyResults results_of(const std::string& text) {
  StudyResults results;
  results.study = study(text);
  for (const Combination& combination : combinations_of(results.study)) {
    Row row;
    row.combination = combination;
    row.id = "id" + std::to_string(combination.index);
    row.scene = R"({"render": {"note": "</pre><script>bad()</script>"}})";
    row.status = RowStatus::done;
    row.paper.resize(results.study.paper.size());
    results.rows.push_back(std::move(row));
    const double h = number_in(results, results.rows.back(), "render.spacing").value_or(1);
    const double part = combination.index % 2 == 0 ? 1 : 0.5;
    Row& last = results.rows.back();
    last.values = {{"rmse", part * h * h}, {"psnr", std::nullopt}, {"slices", 12345678.0}};
    last.seconds = {{"draw", spread(0.09 / h, 0.1 / h, 0.12 / h)}};
    last.rate = spread(0.4, 0.5, 0.75);
  }
  return results;
}

StudyResults with_failures() {
  StudyResults results = results_of(spacing_study);
  results.rows[2].paper = {0.515};
  results.rows[5].status = RowStatus::failed;
  results.rows[5].error = "volume.file: no such <file> & nothing else";
  results.rows[6].status = RowStatus::missing;
  results.machine.processor = "Processor <9>";
  results.limits = {{"classified", spread(1e8, 2e8, 3e8)}};
  results.load_at_start = 0.25;
  return results;
}

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t found = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1))
    ++found;
  return found;
}

bool has(const std::string& text, const std::string& what) { return text.find(what) != std::string::npos; }

bool gnuplot_is_installed() {
  try {
    run_gnuplot("set print '-'\nprint 1\n");
    return true;
  } catch (const FileError&) {
    return false;
  }
}

const ReportChart& chart_named(const std::vector<ReportChart>& charts, const std::string& title) {
  for (const ReportChart& chart : charts) {
    if (chart.title == title)
      return chart;
  }
  throw std::runtime_error("no chart " + title);
}

std::string decoded(const std::string& base64) {
  static const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned bits = 0;
  int held = 0;
  for (const char c : base64) {
    if (c == '=')
      break;
    bits = bits << 6U | static_cast<unsigned>(digits.find(c));
    held += 6;
    if (held >= 8) {
      held -= 8;
      bytes += static_cast<char>(bits >> static_cast<unsigned>(held) & 255U);
    }
  }
  return bytes;
}

/// Every pixel another colour, which no compression makes small.
Image noise(int width, int height, unsigned seed) {
  Image image = make_image(width, height);
  std::mt19937 random(seed);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = i % 4 == 3 ? 1.0F : static_cast<float>(random() % 256) / 255.0F;
  return image;
}

void put_pictures(const fs::path& folder, StudyResults& results, int width, int height) {
  fs::create_directories(folder / "pictures");
  fs::create_directories(folder / "references");
  write_image(noise(width, height, 1000), folder / "references" / "r.png", PixelDepth::png8);
  for (Row& row : results.rows) {
    row.texts["picture"] = "pictures/" + row.id + ".png";
    row.texts["reference"] = "references/r.png";
    write_image(noise(width, height, static_cast<unsigned>(row.combination.index)),
                folder / row.texts["picture"], PixelDepth::png8);
  }
}

} // namespace

TEST_CASE("numbers of the report have sensible digits") {
  using report::number_html;
  using report::spread_html;
  CHECK(number_html(31.622777) == "31.62");
  CHECK(number_html(0.0012345678) == "0.001235");
  CHECK(number_html(0.99998) == "0.99998"); // 1.000 would say equal
  CHECK(number_html(0.99999999) == "&gt; 0.999999");
  CHECK(number_html(-2.5) == "−2.500");
  CHECK(number_html(0) == "0");
  CHECK(number_html(64) == "64");
  CHECK(number_html(12345678) == "12\u202f345\u202f678");
  CHECK(number_html(4.1234e-6) == "4.12×10<sup>−6</sup>");
  CHECK(number_html(9.999e-6) == "1.00×10<sup>−5</sup>");
  // Three digits of the median; more where they would hide that the quartiles differ.
  CHECK(spread_html(12.345, 11.5, 13.25) == "<b>12.3</b> <span class=\"quartiles\">[11.5, 13.2]</span>");
  CHECK(spread_html(12.345, 12.341, 12.349) ==
        "<b>12.345</b> <span class=\"quartiles\">[12.341, 12.349]</span>");
  CHECK(spread_html(1234.5, 1200, 1300) == "<b>1234</b> <span class=\"quartiles\">[1200, 1300]</span>");
}

TEST_CASE("texts cannot leave their place") {
  CHECK(report::escaped("<a href=\"x\">'&") == "&lt;a href=&quot;x&quot;&gt;&#39;&amp;");
  CHECK(report::escaped("é—\xff\x01\n") == "é—\ufffd\ufffd\n");
  CHECK(report::escaped("\xe2\x80") == "\ufffd\ufffd"); // a sequence that is cut off
}

TEST_CASE("a report has every row, its scene, failures, papers' numbers, and nothing that is loaded") {
  const std::string html = report_html(with_failures(), "nowhere");
  for (int i = 0; i < 8; ++i) {
    INFO(i);
    CHECK(count(html, "<details id=\"row-" + std::to_string(i) + "\">") == 1);
    CHECK(has(html, "<a href=\"#row-" + std::to_string(i) + "\">"));
  }
  CHECK(has(html, "<title>Slices &lt;against&gt; &quot;rays&quot; &amp; more</title>"));
  CHECK(has(html, "<p>Second &lt;b&gt;paragraph&lt;/b&gt;.</p>"));
  CHECK(has(html, "&lt;i&gt;&quot;odd&quot; &amp; &#39;so&#39;"));
  CHECK_FALSE(has(html, "<i>\"odd\""));
  CHECK_FALSE(has(html, "<script>bad"));
  CHECK(has(html, "volume.file: no such &lt;file&gt; &amp; nothing else"));
  CHECK(has(html, "1 combination failed, 1 was not measured"));
  CHECK(has(html, "Processor &lt;9&gt;"));
  CHECK(has(html, "0.25 at the start, not known at the end"));
  CHECK(
      has(html, "<b>200</b> <span class=\"quartiles\">[150, 250]</span>")); // 1, 2, 3·10⁸: quartiles halfway
  CHECK(has(html, ">0.515</td>"));                                          // as the paper printed it
  CHECK(has(html, "paper&#39;s rate"));
  CHECK(has(html, "12\u202f345\u202f678"));
  CHECK(has(html, ">equal</td>")); // psnr null
  CHECK(has(html, "with seed 2006"));
  CHECK(has(html, "would take 6 rounds")); // 1 − 2^(1−n) ≥ .95
  CHECK(count(html, "<script>") == 1);
  CHECK(count(html, "http://") + count(html, "https://") == 0);
  CHECK_FALSE(std::regex_search(html, std::regex("(src|xlink:href)=[\"'](?!#)|@import|<link|<iframe")));
  CHECK(html == report_html(with_failures(), "nowhere"));
}

TEST_CASE("a row's command is that of its kind of scene") {
  StudyResults results = results_of(spacing_study);
  results.rows[1].scene = R"({"image": {"pattern": "checkerboard"}})";
  results.rows[2].combination.peer = "cpu";
  const std::string html = report::scenes_html(results);
  CHECK(has(html, ">slicelens render scene.json -o row-0.png<"));
  CHECK(has(html, ">slicelens lens scene.json -o row-1.png<"));
  CHECK(has(html, ">tools/render_with_vtk --mapper cpu scene.json -o row-2.png<"));
}

TEST_CASE("the study's columns make the table, with the paper's beside") {
  StudyResults results = with_failures();
  results.study.columns = {"render.spacing", "rate"};
  const std::string html = report::tables_html(results);
  CHECK(has(html, "<code>rate</code>"));
  CHECK(html.find("Table 3") > html.find("<code>rate</code>"));
  CHECK_FALSE(has(html, "rmse"));
  CHECK_FALSE(has(html, "slices"));
}

TEST_CASE("the error's fitted order is that of the data") {
  const auto charts = charts_of(results_of(spacing_study));
  const ReportChart& chart = chart_named(charts, "Error against spacing");
  REQUIRE(chart.log_x);
  REQUIRE(chart.log_y);
  REQUIRE(chart.panels.size() == 1);
  REQUIRE(chart.panels[0].series.size() == 2);
  for (const report::ChartSeries& series : chart.panels[0].series) {
    REQUIRE(series.points.size() == 4);
    CHECK(series.points.front().x == 0.5);                        // by x
    CHECK(series.fit->exponent == Approx(2).epsilon(1e-12));      // e = h²
    CHECK(*series.fit->standard_error == Approx(0).margin(1e-9)); // all on the line
  }
  CHECK(chart.panels[0].series[0].rows == std::vector<std::size_t>{6, 4, 2, 0});
  // Times .1/h.
  const ReportChart& time = chart_named(charts, "Time against render.spacing");
  CHECK(time.panels[0].series[1].fit->exponent == Approx(-1).epsilon(1e-12));
  CHECK(time.y == "draw_s, ms");
  CHECK(time.panels[0].series[1].points.back().y == Approx(25)); // h = 4
  if (!gnuplot_is_installed())
    return;
  const std::string html = report::chart_html(results_of(spacing_study), chart, 7);
  CHECK(count(html, "<td class=\"number\">2.00 ± 0.00</td>") == 2);
  CHECK(has(html, "id=\"c7-gnuplot_canvas\""));
  CHECK_FALSE(has(html, "xmlns"));
}

TEST_CASE("a chart against what was measured has one panel, whatever varied") {
  StudyResults results = results_of(R"({"vary": [{"render.spacing": [4, 2, 1, 0.5]},
    {"name": "what", "cases": {"plain": {}, "noisy": {"render.jitter": 1}}}],
    "charts": [{"title": "Cost", "x": "slices", "y": "draw_s", "by": ["what"], "log": true}]})");
  for (Row& row : results.rows)
    row.values = {{"slices", 100 / *number_in(results, row, "render.spacing")}};
  const auto charts = charts_of(results);
  const ReportChart& chart = chart_named(charts, "Cost");
  REQUIRE(chart.panels.size() == 1);
  REQUIRE(chart.panels[0].series.size() == 2);
  for (const report::ChartSeries& series : chart.panels[0].series) {
    REQUIRE(series.points.size() == 4);
    CHECK(series.fit->exponent == Approx(1).epsilon(1e-12)); // times and slices both go with 1/h
  }
}

TEST_CASE("an error of psnr is the root of the mean square that it stands for") {
  StudyResults results = results_of(R"({"vary": {"render.spacing": [2, 1]}, "metrics": ["psnr"],
    "reference": {"set": {"render.pipeline": "reference"}}})");
  results.rows[0].values = {{"psnr", 20.0}}; // 10^(−20/20)
  results.rows[1].values = {{"psnr", 40.0}};
  const auto charts = charts_of(results);
  const ReportChart& chart = chart_named(charts, "Error against spacing");
  CHECK(chart.y == "rmse (of psnr)");
  CHECK(chart.panels[0].series[0].points[0].y == Approx(0.01));
  CHECK(chart.panels[0].series[0].points[1].y == Approx(0.1));
  CHECK_FALSE(chart.panels[0].series[0].fit->standard_error.has_value()); // two points leave none
}

TEST_CASE("the front holds what nothing beats") {
  using report::pareto_front;
  // (1,5) and (3,2) and (6,1) are best for what they cost; (2,6) costs more than the first and is worse;
  // (3,3) costs the same as (3,2); (6,1) comes twice.
  CHECK(pareto_front({{6, 1}, {2, 6}, {3, 3}, {1, 5}, {3, 2}, {6, 1}, {7, 2}}) ==
        std::vector<std::size_t>{3, 4, 0});
  CHECK(pareto_front({}).empty());
  const auto charts = charts_of(results_of(spacing_study));
  const ReportChart& chart = chart_named(charts, "Quality against time");
  // Times are alike for both cases and the second one's error is half: all of its rows.
  REQUIRE(chart.front.size() == 4);
  for (const report::FrontPoint& point : chart.front)
    CHECK(point.row % 2 == 1);
}

TEST_CASE("more lines than can be read are left out and counted") {
  const auto charts =
      charts_of(results_of(R"({"vary": {"render.spacing": [2, 1], "camera.azimuth": [0, 10, 20, 30],
    "camera.elevation": [0, 1, 2, 3, 4, 5], "camera.zoom": [1, 2, 3, 4, 5, 6, 7, 8, 9, 10]}, "metrics": ["rmse"],
    "reference": {"set": {"render.pipeline": "reference"}}})"));
  const ReportChart& chart = chart_named(charts, "Error against spacing");
  CHECK(chart.panels.size() == 6);           // elevations
  CHECK(chart.panels[0].series.size() == 4); // azimuths
  CHECK(chart.panels[5].title == "camera.elevation 5");
  REQUIRE(chart.notes.size() == 1); // zooms
  CHECK(chart.notes[0] ==
        "Drawn for camera.zoom = 1 only, one of its 10 values; the tables have the others.");
  // One axis of many values still makes lines: the first eight.
  const ReportChart lines = chart_named(charts_of(results_of(R"({"vary": {"render.spacing": [2, 1],
    "camera.zoom": [1, 2, 3, 4, 5, 6, 7, 8, 9, 10]}})")),
                                        "Time against render.spacing");
  CHECK(lines.panels[0].series.size() == 8);
  REQUIRE(lines.notes.size() == 1);
  CHECK(lines.notes[0].find("first 8 of 10 lines") != std::string::npos);
}

TEST_CASE("sizes are axes of numbers, keys that go with x make no lines, angles and zeros no logarithms") {
  const auto charts = charts_of(results_of(R"({"vary": [{"volume.size": [[32, 32, 32], [64, 64, 64]],
    "render.size": [[10, 10], [20, 20]]}, {"camera.azimuth": [15, 30]}], "scene": {"volume": {"phantom": "ball"}}})"));
  const ReportChart& sizes = chart_named(charts, "Time against volume.size");
  CHECK(sizes.panels[0].series.size() == 2); // azimuths
  CHECK(sizes.panels[0].series[0].points[1].x == 64);
  CHECK(sizes.log_x);
  CHECK_FALSE(chart_named(charts, "Time against camera.azimuth").log_x);
}

TEST_CASE("without gnuplot a report says so and is whole otherwise") {
  const TemporaryFolder empty;
  const std::string path = std::getenv("PATH") == nullptr ? "" : std::getenv("PATH");
  REQUIRE(::setenv("PATH", empty.path().c_str(), 1) == 0);
  const std::string html = report_html(with_failures(), "nowhere");
  ::setenv("PATH", path.c_str(), 1);
  CHECK(has(html, "The charts are missing: gnuplot: is not installed"));
  CHECK(count(html, "<details id=\"row-") == 8);
}

TEST_CASE("pictures are in the page byte for byte, references once") {
  const TemporaryFolder folder;
  StudyResults results = results_of(spacing_study);
  put_pictures(folder.path(), results, 8, 6);
  results.rows[3].texts["picture"] = "pictures/gone.png";
  const std::string html = report::pictures_html(results, folder.path());
  REQUIRE(count(html, "<image id=") == 8); // seven pictures and one reference
  std::smatch match;
  REQUIRE(std::regex_search(
      html, match,
      std::regex("<image id=\"p0\" width=\"8\" height=\"6\" href=\"data:image/png;base64,([^\"]*)\"")));
  CHECK(decoded(match[1]) == read_text(folder.path() / "pictures" / "id0.png"));
  CHECK(has(html, "cannot be read"));
  CHECK(count(html, "<option data-picture") == 7);
  CHECK_FALSE(has(html, "reduced"));
}

TEST_CASE("too many pictures are reduced, and the page says so") {
  const TemporaryFolder folder;
  StudyResults results = results_of(spacing_study);
  // Noise takes three bytes a pixel: nine of 900 × 700 are 17 MB.
  put_pictures(folder.path(), results, 900, 700);
  const std::string html = report::pictures_html(results, folder.path());
  CHECK(has(html, "reduced to at most 256 pixels a side"));
  CHECK(has(html, "<image id=\"p0\" width=\"256\" height=\"199\""));
  CHECK(html.size() < 3'000'000); // nine of 256 × 199 × 3 bytes, a third more as text: 1.8 MB
}

namespace {

/// Runs in the page after its own script and leaves what it finds in the document.
const char* const probe = R"(<script>
const say = (name, value) => document.documentElement.setAttribute("data-" + name, value);
say("overflow", document.documentElement.scrollWidth - innerWidth > 0);
const table = document.querySelector("table.sortable");
const heads = Array.from(table.tHead.rows[0].cells);
const column = heads.findIndex((head) => head.textContent.startsWith("render.spacing"));
const order = () => Array.from(table.tBodies[0].rows).map((row) => row.cells[column].textContent).join(" ");
heads[column].click();
say("up", order());
heads[column].click();
say("down", order());
const viewer = document.getElementById("viewer");
say("viewer", viewer.hidden ? "hidden" : "shown");
const above = viewer.querySelector(".above");
say("wipe", getComputedStyle(above).clipPath);
viewer.querySelector("input[value=difference]").click();
say("blend", getComputedStyle(above).mixBlendMode);
document.getElementById("viewer-row").selectedIndex = 2;
viewer.dispatchEvent(new Event("input"));
say("shown", above.firstElementChild.getAttribute("href"));
say("charts", Array.from(document.querySelectorAll("svg.chart")).filter((svg) => svg.getBBox().width > 100).length);
say("pictures", Array.from(document.querySelectorAll(".picture svg use")).filter((use) => use.getBBox().width === 8).length);
</script>)";

/// A command's wait status; what it prints goes to `out`.
int run(const std::string& command, const fs::path& out) {
  return std::system((command + " >'" + out.string() + "' 2>/dev/null").c_str());
}

/// The document that a headless Chromium has of the page after its scripts.
std::string browsed(const TemporaryFolder& folder, const fs::path& page) {
  std::string url = "file://" + page.string();
  for (std::size_t at = url.find(' '); at != std::string::npos; at = url.find(' '))
    url.replace(at, 1, "%20");
  REQUIRE(run("timeout 200 chromium --headless --no-sandbox --disable-gpu --window-size=1280,1000 "
              "--user-data-dir='" +
                  (folder / "profile").string() + "' --screenshot='" + (folder / "screen.png").string() +
                  "' --dump-dom '" + url + "'",
              folder / "out") == 0);
  return read_text(folder / "out");
}

} // namespace

TEST_CASE("a browser runs the report: sorted tables, viewer, charts, nothing wider than the page") {
  const TemporaryFolder folder;
  if (run("chromium --version", folder / "out") != 0) {
    std::puts("SKIPPED: chromium is not installed");
    return;
  }
  StudyResults results = with_failures();
  put_pictures(folder.path(), results, 8, 6);
  std::string html = report_html(results, folder.path());
  html.insert(html.rfind("</body>"), probe);
  folder.put("report.html", html);
  const std::string dom = browsed(folder, folder / "report.html");
  const std::string head = dom.substr(0, dom.find("<head>"));
  INFO(head);
  CHECK(has(head, "data-script=\"ran\""));
  CHECK(has(head, "data-overflow=\"false\""));
  CHECK(has(head, "data-up=\"0.5 0.5 1 1 2 2 4 4\""));
  CHECK(has(head, "data-down=\"4 4 2 2 1 1 0.5 0.5\""));
  CHECK(has(head, "data-viewer=\"shown\""));
  CHECK(has(head, "data-wipe=\"inset(0px 0px 0px 50%)\""));
  CHECK(has(head, "data-blend=\"difference\""));
  CHECK(has(head, "data-shown=\"#p3\"")); // p0, the reference p1, p2, p3
  if (gnuplot_is_installed())
    CHECK(has(head, "data-charts=\"3\""));
  CHECK(has(head, "data-pictures=\"16\""));
}
