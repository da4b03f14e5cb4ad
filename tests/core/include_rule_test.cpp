// Which folder of src/ may include which: the table of docs/structure.md, read against the files themselves.
// The libraries' include roots make most violations fail to compile; this also sees what the compiler cannot:
// paths with .., and a library that links more than its folder may use.

#include "catch.h"

#include <algorithm>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

using Words = std::set<std::string>;

const std::map<std::string, Words> may_include = {
    {"core", {}},
    {"image", {"core"}},
    {"volume", {"core"}},
    {"warp", {"core"}},
    {"scene", {"core", "volume", "warp"}},
    {"slicing", {"core"}},
    {"tess", {"core", "slicing", "warp"}},
    {"gl", {"core"}},
    {"render", {"core", "image", "volume", "warp", "scene", "slicing", "tess", "gl"}},
    {"study", {"core", "image", "volume", "warp", "scene", "slicing", "tess", "gl", "render"}},
    {"window", {"core", "image", "volume", "warp", "scene", "slicing", "tess", "gl", "render", "study"}},
};

/// The quoted paths of a text's #include lines.
std::vector<std::string> quoted_includes(std::istream& text) {
  std::vector<std::string> paths;
  for (std::string line; std::getline(text, line);) {
    const auto hash = line.find_first_not_of(" \t");
    if (hash == std::string::npos || line[hash] != '#')
      continue;
    const auto word = line.find("include", hash);
    const auto open = line.find('"');
    const auto close = line.rfind('"');
    if (word != std::string::npos && open != std::string::npos && close > open)
      paths.push_back(line.substr(open + 1, close - open - 1));
  }
  return paths;
}

/// Why a file of `folder` may not include `path`; empty where it may. Files of the same folder may be named
/// without it. The shared shader functions (*.glsl) are compiled as C++ by the folders that evaluate them.
std::string objection(const std::string& folder, const std::string& path) {
  if (path.find("..") != std::string::npos)
    return "leaves its folder with ..";
  if (fs::path(path).extension() == ".glsl")
    return folder == "render" || folder == "warp" ? "" : "is a shader";
  const auto slash = path.find('/');
  const std::string other = slash == std::string::npos ? folder : path.substr(0, slash);
  if (other == folder || may_include.at(folder).count(other) > 0)
    return "";
  return may_include.count(other) > 0 ? "is not allowed" : "is no folder of src/";
}

bool is_source(const fs::path& path) {
  const std::string extension = path.extension().string();
  return extension == ".h" || extension == ".cpp" || extension == ".inc";
}

} // namespace

TEST_CASE("the include rule's own checker sees what it must") {
  std::istringstream text("#include \"core/box.h\"\n  # include \"../gl/check.h\" // why\n#include <vector>\n"
                          "// #include \"study/metrics.h\"\nauto s = \"image/image.h\";\n");
  CHECK(quoted_includes(text) == std::vector<std::string>{"core/box.h", "../gl/check.h"});
  CHECK(objection("volume", "core/errors.h").empty());
  CHECK(objection("volume", "readers.h").empty());
  CHECK_FALSE(objection("volume", "image/image.h").empty());
  CHECK_FALSE(objection("core", "volume/volume.h").empty());
  CHECK_FALSE(objection("render", "study/metrics.h").empty());
  CHECK_FALSE(objection("gl", "../image/image.h").empty());
  CHECK_FALSE(objection("gl", "lib/ray.glsl").empty());
}

TEST_CASE("a folder of src/ includes only the folders below it") {
  const fs::path root = fs::path(SLICELENS_SOURCE_DIR) / "src";
  std::vector<std::string> wrong;
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(root)) {
    if (!entry.is_regular_file() || !is_source(entry.path()))
      continue;
    const fs::path file = fs::relative(entry.path(), root);
    const std::string folder = file.begin()->string();
    if (may_include.count(folder) == 0) {
      wrong.push_back("src/" + folder + " is missing in the table of this test and of docs/structure.md");
      continue;
    }
    ++files;
    std::ifstream text(entry.path());
    for (const std::string& path : quoted_includes(text)) {
      const std::string why = objection(folder, path);
      if (!why.empty())
        wrong.push_back("src/" + file.string() + " includes \"" + path + "\", which " + why);
    }
  }
  std::sort(wrong.begin(), wrong.end());
  for (const std::string& line : wrong)
    UNSCOPED_INFO(line);
  CHECK(wrong.empty());
  CHECK(files > 50); // the folder was really walked
}
