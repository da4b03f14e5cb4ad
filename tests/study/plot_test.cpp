// Charts: gnuplot's commands, their escaping, and the pictures where gnuplot is installed.

#include "catch.h"
#include "core/errors.h"
#include "image/image_io.h"
#include "scene/load.h"
#include "study/axis_tables_page.h"
#include "study/gnuplot.h"
#include "study/plot.h"
#include "temporary_folder.h"

#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>

namespace {

namespace fs = std::filesystem;
using namespace slicelens;
using Catch::Matchers::Contains;

/// Sets an environment variable and puts it back.
class Environment {
public:
  Environment(const char* name, const std::string& value) : name_(name) {
    if (const char* const now = std::getenv(name))
      old_ = now;
    ::setenv(name, value.c_str(), 1);
  }
  ~Environment() {
    if (old_)
      ::setenv(name_, old_->c_str(), 1);
    else
      ::unsetenv(name_);
  }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

private:
  const char* name_;
  std::optional<std::string> old_;
};

/// Only a missing program skips a test; one that is there and fails does not.
bool gnuplot_is_installed() {
  try {
    run_gnuplot("set print '-'\nprint 1\n");
  } catch (const FileError& error) {
    return std::string(error.what()).find("is not installed") == std::string::npos;
  }
  return true;
}

const char* const no_gnuplot = "gnuplot is not installed";

PlotPage one_panel(const std::vector<glm::dvec2>& points) {
  PlotPage page;
  page.width = 480;
  page.height = 320;
  PlotPanel panel;
  panel.title = "speed";
  PlotSeries series;
  series.name = "measured";
  series.points = points;
  panel.series = {series};
  page.panels = {panel};
  return page;
}

/// Bifocal tables worked by hand: data [.4,.6] shown on [.2,.8], 8 texels.
AxisTables bifocal_tables() {
  std::vector<glm::vec4> axis;
  for (int j = 0; j < 8; ++j) {
    const float x = (static_cast<float>(j) + 0.5F) / 8;
    const float u = x < 0.2F ? 2 * x : x <= 0.8F ? 0.4F + (x - 0.2F) / 3 : 0.6F + (x - 0.8F) * 2;
    axis.push_back({u - x, 1, 1, std::max(1 - 2 * std::abs(0.5F - x), 0.0F)});
  }
  AxisTables tables;
  tables.texels = {axis, axis, axis};
  return tables;
}

/// The numbers that follow `word`, as pixels of a page of 1000.
std::vector<double> pixels(const std::string& script, const std::string& word) {
  std::vector<double> values;
  for (auto at = script.find(word); at != std::string::npos; at = script.find(word, at + 1))
    values.push_back(std::round(1e6 * std::stod(script.substr(at + word.size(), 24))) / 1e3);
  return values;
}

} // namespace

TEST_CASE("a text in a gnuplot script is one string whatever it holds") {
  CHECK(gnuplot_text("plain") == "'plain'");
  CHECK(gnuplot_text("x'_min") == "'x''_min'");
  CHECK(gnuplot_text("a\nexit\r\tb") == "'a exit  b'");
  CHECK(gnuplot_text("`id` $x @y \\ \"z\"") == "'`id` $x @y \\ \"z\"'");
}

TEST_CASE("the script holds data, styles, ranges, logarithmic axes, regions and markers") {
  PlotPage page = one_panel({{1, 0.5}, {10, 1e-6}});
  PlotPanel& panel = page.panels[0];
  panel.x = {"voxels", std::pair{1.0, 100.0}, true, {}};
  panel.y.label = "error";
  panel.series[0].point = PointStyle::circle;
  panel.series[0].line = LineStyle::dashed;
  panel.series[0].rgb = 0x00ff7f;
  panel.regions = {{2, 5}};
  panel.markers = {{3, "x_f"}};
  panel.key = KeyPlace::bottom_right;
  const std::string script = plot_script(page, PlotFormat::svg);
  CHECK_THAT(script, Contains("set terminal svg noenhanced size 480,320 "));
  CHECK_THAT(script, Contains("$p0_0 << END\n1 0.5\n10 1e-06\nEND\n"));
  CHECK_THAT(script, Contains("set logscale x 10\n") && !Contains("set logscale y"));
  CHECK_THAT(script, Contains("set xrange [1:100]\n") && !Contains("set yrange"));
  CHECK_THAT(script, Contains("with linespoints linecolor rgb '#00ff7f' linewidth 2 dashtype 2 pointtype 6"));
  CHECK_THAT(script, Contains("set object rectangle from first 2, graph 0 to first 5, graph 1 behind"));
  CHECK_THAT(script, Contains("set arrow from first 3, graph 0 to first 3, graph 1 nohead"));
  CHECK_THAT(script, Contains("set label 'x_f' at first 3, screen "));
  CHECK_THAT(script, Contains("set key bottom right") && Contains("title 'measured'"));
  CHECK_THAT(plot_script(page, PlotFormat::png),
             Contains("set terminal pngcairo fontscale 0.75 noenhanced size 480,320 "));
}

TEST_CASE("what cannot be shown interrupts a curve") {
  const double nan = std::nan("");
  PlotPage page =
      one_panel({{1, 1}, {2, nan}, {3, 3}, {4, std::numeric_limits<double>::infinity()}, {5, -5}});
  CHECK_THAT(plot_script(page, PlotFormat::svg), Contains("<< END\n1 1\n\n3 3\n\n5 -5\nEND\n"));
  page.panels[0].y.logarithmic = true;
  CHECK_THAT(plot_script(page, PlotFormat::svg), Contains("<< END\n1 1\n\n3 3\n\n\nEND\n"));
}

TEST_CASE("pages that cannot be drawn are refused by name") {
  const PlotPage good = one_panel({{0, 0}, {1, 1}});
  const auto refusal = [](const PlotPage& page) {
    try {
      plot_script(page, PlotFormat::png);
    } catch (const UsageError& error) {
      return std::string(error.what());
    }
    return std::string("taken");
  };
  CHECK(refusal(good) == "taken");
  PlotPage page = good;
  page.width = 0;
  CHECK_THAT(refusal(page), Contains("plot size 0x320") && Contains("200 to 8192"));
  page = good;
  page.panels.push_back(good.panels[0]);
  CHECK_THAT(refusal(page), Contains("2 panels") && Contains("the 1 places"));
  page = good;
  page.row_heights = {0};
  CHECK_THAT(refusal(page), Contains("row height 0"));
  page = good;
  page.row_heights = {1, 1, 1, 1, 1, 1}; // 58 + 5·34 pixels between six frames of at least 24
  CHECK_THAT(refusal(page), Contains("too small for its panels; give at least 132x372"));
  page = good;
  page.panels[0].series[0].points = {{0, std::nan("")}};
  CHECK_THAT(refusal(page), Contains("'speed': no point can be seen"));
  page = good;
  page.panels[0].x.range = std::pair{1.0, 1.0};
  CHECK_THAT(refusal(page), Contains("the range 1 to 1"));
  page = good;
  page.panels[0].x = {"n", std::pair{0.0, 1.0}, true, {}};
  CHECK_THAT(refusal(page), Contains("the range 0 to 1 of 'n'"));
  page = good;
  page.panels[0].markers = {{std::nan(""), "x"}};
  CHECK_THAT(refusal(page), Contains("'speed': a marker at nan"));
  CHECK(plot_format("a/b.SVG") == PlotFormat::svg);
  CHECK(plot_format("b.png") == PlotFormat::png);
  CHECK_THROWS_WITH(plot_format("b.pdf"), Contains("b.pdf") && Contains(".svg or .png"));
}

TEST_CASE("frames of one row and one column are in line") {
  PlotPage page = one_panel({{0, 0}, {1, 1}});
  page.width = 1000;
  page.height = 1000;
  page.columns = 2;
  page.row_heights = {3, 1};
  page.panels.assign(4, page.panels[0]);
  page.panels[1].x.label = "n";
  const std::string script = plot_script(page, PlotFormat::svg);
  // Two columns of 500 pixels. Each row has a title of 8 + 24 pixels above and numbers of 26 below, the first
  // row a label of 20 as well: 1000 − 2·58 − 20 pixels of frames, 648 in the first row, 216 in the second.
  using Values = std::vector<double>;
  CHECK(pixels(script, "set lmargin at screen ") == Values{86, 586, 86, 586});
  CHECK(pixels(script, "set rmargin at screen ") == Values{478, 978, 478, 978});
  CHECK(pixels(script, "set tmargin at screen ") == Values{968, 968, 242, 242}); // from the bottom
  CHECK(pixels(script, "set bmargin at screen ") == Values{320, 320, 26, 26});
}

TEST_CASE("axis tables become a curve for each channel, and boxes for the texels") {
  const AxisTables tables = bifocal_tables();
  const PlotPage page = axis_tables_page("tables", tables);
  REQUIRE(page.panels.size() == 15);
  const auto& map = page.panels[0].series.at(1).points;
  REQUIRE(map.size() == 10); // eight texels and the two ends
  // Texel 3 of 8 sits at 7/16, which shows .4 + (7/16 − .2)/3; float texels, so six digits.
  CHECK(map[4].x == 7.0 / 16);
  CHECK(map[4].y == Approx(0.4 + (7.0 / 16 - 0.2) / 3).epsilon(1e-6));
  // Beyond the last texel's centre a clamped fetch repeats its offset: 15/16 shows .6 + 2·(15/16 − .8).
  CHECK(map[9].x == 1);
  CHECK(map[9].y == Approx(1 + 0.6 + 2 * (15.0 / 16 - 0.8) - 15.0 / 16).epsilon(1e-6));
  const auto& mask = page.panels[3].series.at(0).points;
  REQUIRE(mask.size() == 16);
  CHECK(mask[2] == glm::dvec2(1.0 / 8, 1));
  CHECK(mask[3] == glm::dvec2(2.0 / 8, 1));
  CHECK(page.panels[9].series.at(0).points[1].y == Approx(2.0 / 16).epsilon(1e-6)); // 1 − 2·|½ − 1/16|

  // Mask and attenuation are one colour throughout: a box each. All eight offsets and all but the equal
  // neighbours in the middle of the highlight differ.
  CHECK(page.panels[12].boxes.size() == 8 + 1 + 1 + 7);
  CHECK(page.panels[12].boxes.back().high.x == 8);
  CHECK_THROWS_WITH(axis_tables_page("none", AxisTables{}), Contains("no texels along x"));

  AxisTables damaged = tables;
  damaged.texels[0][3] = glm::vec4(std::nanf(""));
  const PlotPanel still = axis_tables_page("damaged", damaged).panels[0];
  CHECK(still.y.range->second < 1.2); // one bad texel does not spoil the range
}

TEST_CASE("axis tables are drawn as the renderer's filter reads them") {
  AxisTables tables = bifocal_tables();
  const auto nearest = axis_tables_page("", tables, {}, AxisFilter::nearest).panels[0].series.at(1).points;
  // Texel 1 of 8 (centre 3/16, offset +3/16) over [1/8, 2/8].
  REQUIRE(nearest.size() == 16);
  CHECK(nearest[2].x == 1.0 / 8);
  CHECK(nearest[2].y == Approx(1.0 / 8 + 3.0 / 16).epsilon(1e-6));
  CHECK(nearest[3].y == Approx(2.0 / 8 + 3.0 / 16).epsilon(1e-6));
  tables.mask = AxisMask::weight; // is filtered as the rest is
  const PlotPage weights = axis_tables_page("", tables);
  CHECK(weights.panels[3].series.at(0).points.size() == 10);
  CHECK(weights.panels[3].y.label == "weight (G)");
}

TEST_CASE("focus regions are marked in displayed coordinates") {
  AxisTableMarks marks;
  marks.mapping = AxisRanges{glm::dvec2(0.2, 0.8), glm::dvec2(0.3, 0.35), glm::dvec2(0.25, 0.25)};
  marks.attenuation = marks.mapping;
  marks.highlight = AxisRanges{glm::dvec2(0.1, 0.5), glm::dvec2(0.3, 0.7), glm::dvec2(0.4, 0.9)};
  const PlotPage page = axis_tables_page("tables", bifocal_tables(), marks);
  const auto names = [&](std::size_t panel) {
    std::vector<std::string> labels;
    for (const PlotMarker& marker : page.panels[panel].markers)
      labels.push_back(marker.label);
    return labels;
  };
  using Names = std::vector<std::string>;
  CHECK(names(0) == Names{"x'_min", "x'_max", "x_f"});
  CHECK(names(1) == Names{"y'_min", "y'_max", ""}); // no room for a third
  CHECK(names(2) == Names{"z_f"});                  // a focal point
  CHECK(names(6) == Names{"", "", ""});             // named in the first row
  CHECK(names(9) == Names{"x'_min", "x'_max", "x_f"});
  CHECK(page.panels[6].markers[2].x == 0.5);
  CHECK(page.panels[9].markers[2].x == 0.3);
  CHECK(page.panels[9].regions.at(0).high == 0.5);
  CHECK(page.panels[2].regions.empty());
  CHECK(axis_tables_page("", bifocal_tables()).panels[0].markers.empty());
}

TEST_CASE("a scene's tables are plotted whatever its pipeline, with each effect's own region") {
  Scene scene;
  scene.warp = {Bifocal{}};
  scene.render.pipeline = Pipeline::fragment;
  scene.attenuation.function = AttenuationFunction::distance;
  scene.attenuation.focus = ranges_of(glm::dvec3(0.5), glm::dvec3(0.75));
  Volume volume;
  volume.dims = {4, 6, 8};
  volume.voxels.resize(voxel_bytes(volume));
  TransferFunction transfer = transfer_of(scene, volume);
  const PreparedScene prepared = prepare(scene, std::move(volume), std::move(transfer));
  const PlotPage page = axis_tables_page("scene", prepared);
  CHECK(page.panels[1].series.at(1).points.size() == 6 + 2); // a texel for each voxel
  CHECK(page.panels[0].regions.at(0).low == 0.25);           // the bifocal's default
  CHECK(page.panels[6].regions.at(0).low == 0.5);
  CHECK(page.panels[9].regions.at(0).low == 0.25);
  // Equation 3 at the first of four texels: (1/8) / x'_min.
  CHECK(page.panels[6].series.at(0).points[1].y == Approx(0.25).epsilon(1e-6));
}

TEST_CASE("offsets are blue below, white at nothing, red above") {
  CHECK(diverging_color(0) == 0xffffff);
  CHECK(diverging_color(2) == diverging_color(1));
  CHECK((diverging_color(1) >> 16) > (diverging_color(1) & 0xff));
  CHECK((diverging_color(-1) >> 16) < (diverging_color(-1) & 0xff));
}

TEST_CASE("a missing gnuplot is named with its package") {
  const TemporaryFolder empty;
  const Environment path("PATH", empty.path().string());
  const PlotPage page = one_panel({{0, 0}, {1, 1}});
  CHECK_THROWS_AS(draw_plot(page, PlotFormat::svg), FileError);
  CHECK_THROWS_WITH(draw_plot(page, PlotFormat::svg), Contains("apt-get install gnuplot-nox"));
}

TEST_CASE("a gnuplot that fails or says nothing is an error, and no temporary file is left") {
  const TemporaryFolder bin;
  const TemporaryFolder temporary;
  const Environment temporary_folder("TMPDIR", temporary.path().string());
  const fs::path program = bin.path() / "gnuplot";
  const auto message = [&](const std::string& body) {
    std::ofstream(program) << "#!/bin/sh\n" << body << "\n";
    fs::permissions(program, fs::perms::owner_all);
    const Environment path("PATH", bin.path().string());
    try {
      run_gnuplot("plot x\n");
    } catch (const FileError& error) {
      return std::string(error.what());
    }
    return std::string("taken");
  };
  CHECK(message("echo picture") == "taken");
  // What gnuplot 5.4 prints: the command, a mark, the place and the reason; $2 is the script.
  CHECK(message("printf '\\n\\nplot x\\n     ^\\n\"%s\" line 3: undefined\\n' \"$2\" >&2; exit 1") ==
        "gnuplot: failed: line 3: undefined");
  CHECK(message("echo out of paper >&2; exit 2") == "gnuplot: failed: out of paper");
  CHECK(message("exit 1") == "gnuplot: failed: no reason given");
  CHECK(message(":") == "gnuplot: wrote nothing: no reason given");
  CHECK_THAT(message("kill -9 $$"), Contains("signal 9"));
  CHECK(fs::is_empty(temporary.path()));
}

TEST_CASE("gnuplot's own error is told in one line") {
  if (!gnuplot_is_installed())
    SLICELENS_SKIP(no_gnuplot);
  CHECK_THROWS_WITH(run_gnuplot("set terminal svg\nplot nothing_known\n"),
                    Contains("line 2: undefined variable: nothing_known"));
}

TEST_CASE("an SVG holds texts as they are and each series once, and the same bytes again") {
  if (!gnuplot_is_installed())
    SLICELENS_SKIP(no_gnuplot);
  PlotPage page = one_panel({{0, 0}, {1, 0.5}, {2, 1}});
  PlotPanel& panel = page.panels[0];
  panel.title = "a_b^c {d} <e> & \"f\" \\n `echo g` %h";
  panel.key = KeyPlace::top_left;
  panel.series.push_back(panel.series[0]);
  panel.series[1].name = "second";
  panel.series[1].rgb = 0xab12cd;
  panel.markers = {{1, "x'_min"}};
  const std::string svg = draw_plot(page, PlotFormat::svg);
  CHECK_THAT(svg, Contains("<svg") && Contains("</svg>"));
  CHECK_THAT(svg, Contains("a_b^c {d} &lt;e> &amp; \"f\" \\n `echo g` %h"));
  CHECK_THAT(svg, Contains(">measured<") && Contains(">second<") && Contains("x'_min<"));
  CHECK_THAT(svg, Contains("171,  18, 205") || Contains("#ab12cd") || Contains("#AB12CD"));
  CHECK(svg == draw_plot(page, PlotFormat::svg));
}

TEST_CASE("a PNG has the size that was asked for and the series' colour") {
  if (!gnuplot_is_installed())
    SLICELENS_SKIP(no_gnuplot);
  PlotPage page = one_panel({{0, 0}, {1, 1}});
  page.panels[0].series[0].rgb = 0xff0000;
  const std::string png = draw_plot(page, PlotFormat::png);
  CHECK(png == draw_plot(page, PlotFormat::png));
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "plot.png";
  std::ofstream(file, std::ios::binary) << png;
  const Image image = read_image(file);
  CHECK(image.width == 480);
  CHECK(image.height == 320);
  int red = 0;
  for (std::size_t i = 0; i < image.pixels.size(); i += 4)
    red += image.pixels[i] > 0.9F && image.pixels[i + 1] < 0.4F && image.pixels[i + 2] < 0.4F;
  // The line crosses a frame of 372 × 262 pixels: at least one pixel in each of its columns.
  CHECK(red >= 372);
}
