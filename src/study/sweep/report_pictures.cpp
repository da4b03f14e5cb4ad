// The report's pictures: each embedded once, shown beside its reference, and laid over it.
#include "core/errors.h"
#include "core/files.h"
#include "image/image_io.h"
#include "image/pictures.h"
#include "study/process.h"
#include "study/sweep/report_parts.h"

#include <algorithm>
#include <map>
#include <system_error>

namespace slicelens::report {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_bytes = std::size_t{15} << 20; ///< of PNG; base64 makes 20 MB of it
constexpr int reduced_side = 256;
constexpr std::size_t linked_rows = 2000;

struct Embedded {
  std::size_t number = 0; ///< its element's id is p0, p1 …
  int width = 0;
  int height = 0;
};

/// The pictures that are in the page, by their path.
struct Store {
  std::map<std::string, Embedded> pictures;
  std::string html; ///< the elements that hold them
  std::size_t bytes = 0;
  bool reduced = false;
  bool full = false; ///< no more room
};

std::string base64(const std::string& bytes) {
  static const char* const digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t k) {
      return k < bytes.size() ? static_cast<unsigned>(static_cast<unsigned char>(bytes[k])) : 0U;
    };
    const unsigned value = byte(i) << 16U | byte(i + 1) << 8U | byte(i + 2);
    text += digits[value >> 18U];
    text += digits[value >> 12U & 63U];
    text += i + 1 < bytes.size() ? digits[value >> 6U & 63U] : '=';
    text += i + 2 < bytes.size() ? digits[value & 63U] : '=';
  }
  return text;
}

/// Width or height of a PNG (ISO/IEC 15948, §11.2.2: after the signature comes IHDR); 0 where it is none.
int png_side(const std::string& png, std::size_t at) {
  if (png.size() < 24 || png.compare(1, 3, "PNG") != 0)
    return 0;
  unsigned value = 0;
  for (std::size_t i = 0; i < 4; ++i)
    value = value << 8U | static_cast<unsigned char>(png[at + i]);
  return value <= 65536 ? static_cast<int>(value) : 0;
}

std::string reduced_png(const fs::path& file) {
  Image image = read_image(file);
  image.metadata.clear();
  const double factor = static_cast<double>(reduced_side) / std::max(image.width, image.height);
  if (factor < 1)
    image = resize(image, std::max(1, static_cast<int>(image.width * factor)),
                   std::max(1, static_cast<int>(image.height * factor)));
  const ScratchFolder folder;
  write_image(image, folder / "reduced.png", PixelDepth::png8);
  return read_text(folder / "reduced.png", most_bytes);
}

void embed(Store& store, const fs::path& folder, const std::string& path) {
  if (path.empty() || store.full || store.pictures.count(path) != 0)
    return;
  std::string png;
  try {
    png = store.reduced ? reduced_png(folder / path) : read_text(folder / path, most_bytes);
  } catch (const Error&) {
    return; // the figure says that it is not there
  }
  const int width = png_side(png, 16);
  const int height = png_side(png, 20);
  if (width == 0 || height == 0)
    return;
  if (store.bytes + png.size() > most_bytes) {
    store.full = true;
    return;
  }
  store.bytes += png.size();
  const std::size_t number = store.pictures.size();
  store.pictures[path] = {number, width, height};
  store.html += "<image id=\"p" + std::to_string(number) + "\" width=\"" + std::to_string(width) +
                "\" height=\"" + std::to_string(height) + "\" href=\"data:image/png;base64," + base64(png) +
                "\"/>\n";
}

std::string path_of(const Row& row, const std::string& what) {
  const auto text = row.texts.find(what);
  return text == row.texts.end() ? "" : text->second;
}

constexpr const char* kinds[] = {"picture", "reference", "heat_map"};
constexpr const char* names[] = {"picture", "reference", "difference, as heat map"};

Store store_of(const StudyResults& results, const fs::path& folder) {
  std::size_t bytes = 0;
  std::map<std::string, bool> seen;
  for (const Row& row : results.rows) {
    for (const char* kind : kinds) {
      const std::string path = path_of(row, kind);
      if (path.empty() || seen[path])
        continue;
      seen[path] = true;
      std::error_code error;
      const auto size = fs::file_size(folder / path, error);
      bytes += error ? 0 : static_cast<std::size_t>(size);
    }
  }
  Store store;
  store.reduced = bytes > most_bytes;
  for (const Row& row : results.rows) {
    for (const char* kind : kinds)
      embed(store, folder, path_of(row, kind));
  }
  return store;
}

const Embedded* find(const Store& store, const std::string& path) {
  const auto found = store.pictures.find(path);
  return found == store.pictures.end() ? nullptr : &found->second;
}

std::string percent_encoded(const std::string& path) {
  std::string text;
  for (const char c : path) {
    const bool plain =
        std::isalnum(static_cast<unsigned char>(c)) != 0 || std::string("-_./~").find(c) != std::string::npos;
    char code[8];
    std::snprintf(code, sizeof code, "%%%02X", static_cast<unsigned>(static_cast<unsigned char>(c)));
    text += plain ? std::string(1, c) : code;
  }
  return text;
}

/// One of a row's pictures, with a link to its file.
std::string picture_html(const Store& store, const std::string& path, const std::string& name) {
  const std::string link = "<a href=\"" + percent_encoded(path) + "\">" + name + "</a>";
  const Embedded* picture = find(store, path);
  if (picture == nullptr)
    return "<div class=\"picture none\"><span>" +
           std::string(store.full ? "not in this page" : "cannot be read") + "</span><small>" + link +
           "</small></div>";
  return "<div class=\"picture\"><svg role=\"img\" aria-label=\"" + escaped(name) + "\" viewBox=\"0 0 " +
         std::to_string(picture->width) + " " + std::to_string(picture->height) + "\"><use href=\"#p" +
         std::to_string(picture->number) + "\"/></svg><small>" + link + "</small></div>";
}

std::string metrics_line(const StudyResults& results, const Row& row) {
  std::string html;
  for (const std::string& metric : results.study.metrics) {
    if (html.size() > 400)
      break;
    if (const auto value = number_in(results, row, metric))
      html += (html.empty() ? "" : ", ") + code(metric) + " " + number_html(*value);
  }
  return html;
}

std::string row_html(const StudyResults& results, const Store& store, const Row& row) {
  std::string pictures;
  for (std::size_t i = 0; i < std::size(kinds); ++i) {
    const std::string path = path_of(row, kinds[i]);
    if (!path.empty())
      pictures += picture_html(store, path, names[i]);
  }
  const std::string index = std::to_string(row.combination.index);
  return "<figure class=\"row\"><div class=\"side\">" + pictures + "</div><figcaption><a href=\"#row-" +
         index + "\">" + index + "</a> <code>" + escaped(labels_text(row)) + "</code><br>" +
         metrics_line(results, row) + "</figcaption></figure>\n";
}

/// What the script reads to fill the viewer: a row each, only those with both pictures in the page.
std::string options_html(const StudyResults& results, const Store& store) {
  std::string html;
  for (const Row& row : results.rows) {
    const Embedded* picture = find(store, path_of(row, "picture"));
    const Embedded* reference = find(store, path_of(row, "reference"));
    if (picture == nullptr || reference == nullptr)
      continue;
    html += "<option data-picture=\"p" + std::to_string(picture->number) + "\" data-reference=\"p" +
            std::to_string(reference->number) + "\" data-width=\"" + std::to_string(picture->width) +
            "\" data-height=\"" + std::to_string(picture->height) + "\">" +
            std::to_string(row.combination.index) + ": " + escaped(labels_text(row)) + "</option>\n";
  }
  return html;
}

std::string viewer_html(const std::string& options) {
  return "<div id=\"viewer\" hidden>\n<p class=\"controls\"><label>Row <select id=\"viewer-row\">\n" +
         options +
         "</select></label>\n"
         "<span class=\"choice\"><label><input type=\"radio\" name=\"viewer-mode\" value=\"wipe\" checked> "
         "wipe</label> <label><input type=\"radio\" name=\"viewer-mode\" value=\"difference\"> "
         "difference</label></span>\n"
         "<label class=\"for-wipe\">reference <input type=\"range\" id=\"viewer-wipe\" min=\"0\" max=\"100\" "
         "value=\"50\"> picture</label>\n"
         "<label class=\"for-difference\">brightness <select id=\"viewer-gain\"><option value=\"1\">× "
         "1</option>"
         "<option value=\"4\">× 4</option><option value=\"16\" selected>× 16</option><option value=\"64\">× "
         "64</option>"
         "</select></label>\n"
         "<label>size <select id=\"viewer-size\"><option value=\"0\">fitting</option><option value=\"1\">× "
         "1</option>"
         "<option value=\"2\">× 2</option><option value=\"4\">× 4</option><option value=\"8\">× "
         "8</option></select>"
         "</label></p>\n"
         "<div id=\"viewer-frame\"><div id=\"viewer-stage\"><svg class=\"below\"><use/></svg>"
         "<svg class=\"above\"><use/></svg><div id=\"viewer-line\"></div></div></div>\n"
         "<p class=\"note\" id=\"viewer-text\"></p>\n</div>\n";
}

} // namespace

std::string pictures_html(const StudyResults& results, const fs::path& folder) {
  const Store store = store_of(results, folder);
  std::string rows;
  std::size_t count = 0;
  std::size_t shown = 0;
  for (const Row& row : results.rows) {
    const std::string path = path_of(row, "picture");
    if (path.empty() || ++count > linked_rows)
      continue;
    shown += find(store, path) == nullptr ? 0 : 1;
    rows += row_html(results, store, row);
  }
  if (rows.empty())
    return "";
  std::string html;
  if (store.reduced)
    html += "<p class=\"notice\">The pictures of this study are too many or too large for one page: they are "
            "shown "
            "reduced to at most " +
            std::to_string(reduced_side) + " pixels a side" +
            (shown < count ? ", and only those of the first rows (" + std::to_string(shown) + " of " +
                                 std::to_string(count) + ")"
                           : "") +
            ". The files beside this page, which the names below the pictures lead to, are whole.</p>\n";
  if (count > linked_rows)
    html += "<p class=\"notice\">Listed are the first " + std::to_string(linked_rows) + " of " +
            std::to_string(count) + " rows; <code>results.json</code> names all pictures.</p>\n";
  const std::string options = options_html(results, store);
  html += "<svg class=\"store\" width=\"0\" height=\"0\" aria-hidden=\"true\"><defs>\n" + store.html +
          "</defs></svg>\n";
  if (!options.empty())
    html += viewer_html(options);
  const bool single = std::none_of(results.rows.begin(), results.rows.end(),
                                   [](const Row& row) { return row.texts.count("reference") != 0; });
  return html + "<div class=\"rows" + (single ? " single" : "") + "\">\n" + rows + "</div>\n";
}

} // namespace slicelens::report
