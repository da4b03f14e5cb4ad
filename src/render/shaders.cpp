#include "render/shaders.h"

#include "core/embedded.h"
#include "core/errors.h"

#include <sstream>

namespace slicelens {

const std::vector<EmbeddedFile>& embedded_shaders(); // made at build time

namespace {

const std::string& shader_text(const std::string& name, const std::vector<EmbeddedFile>& generated) {
  for (const std::vector<EmbeddedFile>* files : {&generated, &embedded_shaders()}) {
    for (const EmbeddedFile& file : *files) {
      if (file.name == name)
        return file.text;
    }
  }
  throw GraphicsError("shader file " + name + " is not part of this program; build it again");
}

/// Appends `name` with its includes before the lines that follow them, one piece per run of lines, so that
/// messages name the right file. A piece's lines count from its own first line; blank lines keep the count
/// true.
void append_expanded(std::vector<gl::ShaderSource>& pieces, GLenum stage, const std::string& name,
                     const std::vector<EmbeddedFile>& generated) {
  const std::string marker = "#include \"";
  std::istringstream lines(shader_text(name, generated));
  std::string line;
  std::string text;
  int line_count = 0;
  while (std::getline(lines, line)) {
    ++line_count;
    if (line.rfind(marker, 0) != 0) {
      text += line + "\n";
      continue;
    }
    pieces.push_back({stage, name, text + "\n"});
    append_expanded(pieces, stage, line.substr(marker.size(), line.find('"', marker.size()) - marker.size()),
                    generated);
    text = std::string(static_cast<std::size_t>(line_count), '\n');
  }
  pieces.push_back({stage, name, text});
}

} // namespace

std::vector<gl::ShaderSource> shader_stage(GLenum stage, const std::string& entry,
                                           const std::vector<std::string>& macros,
                                           const std::vector<EmbeddedFile>& generated) {
  std::string head = "#version 330 core\n#define real float\n";
  for (const std::string& macro : macros)
    head += "#define " + macro + "\n";
  std::vector<gl::ShaderSource> pieces = {{stage, "macros of " + entry, head}};
  append_expanded(pieces, stage, entry, generated);
  return pieces;
}

} // namespace slicelens
