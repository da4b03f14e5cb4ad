// Cohen's tables as the driver holds them: read back and compared bit by bit with hand calculation.
#include "axis_table_bytes.h"
#include "gl/check.h"
#include "render/axis_textures.h"
#include "render_fixture.h"
#include "volume_fixture.h"

using namespace slicelens;
using namespace axis_table_bytes;

namespace {

std::vector<glm::vec4> read_back(const gl::Context& context, const gl::Texture& texture) {
  const gl::Functions& gl = context.functions();
  using GetTexImage = void (*)(GLenum, GLint, GLenum, GLenum, void*);
  const auto get_tex_image = reinterpret_cast<GetTexImage>(context.proc_address("glGetTexImage"));
  REQUIRE(get_tex_image != nullptr);
  gl.BindTexture(GL_TEXTURE_1D, texture.name());
  GLint width = 0;
  GLint format = 0;
  gl.GetTexLevelParameteriv(GL_TEXTURE_1D, 0, GL_TEXTURE_WIDTH, &width);
  gl.GetTexLevelParameteriv(GL_TEXTURE_1D, 0, GL_TEXTURE_INTERNAL_FORMAT, &format);
  CHECK(format == GL_RGBA32F);
  std::vector<glm::vec4> texels(static_cast<std::size_t>(width));
  get_tex_image(GL_TEXTURE_1D, 0, GL_RGBA, GL_FLOAT, texels.data());
  gl::check_errors(gl, "reading a table");
  return texels;
}

/// A volume of 8 × 16 × 8 voxels under the two examples of axis_table_bytes.h.
PreparedScene small_scene(const std::string& warp, const std::string& keys = "") {
  return prepare(scene_from_json(R"({"warp":)" + warp + R"(,"highlight":{"function":"distance"},
                     "attenuation":{"function":"distance"},"render":{"pipeline":"axis","size":[8,8])" +
                                     keys + "}}",
                                 "test"),
                 volume_of(ScalarType::u8, {8, 16, 8}, [](int i, int, int) { return i; }), grey(0.5));
}

const std::string bifocal =
    R"({"kind":"bifocal","focus":[[0.375,0.625],[0.375,0.625],[0.375,0.625]],"shown":[[0.25,0.75],[0.25,0.75],[0.25,0.75]]})";
const std::string lens =
    R"({"kind":"volume-lens","center":[0.5,0.5,0.5],"inner":0.125,"outer":0.375,"magnification":2})";

} // namespace

TEST_CASE("the tables that a scene uploads are those worked out by hand, bit by bit") {
  const gl::Context context = test_context();
  AxisTextures textures;
  const std::size_t bytes = upload_axis_tables(context.functions(), small_scene(bifocal), textures);
  CHECK(bytes == (8 + 16 + 8) * 16); // RGBA of four bytes: one texel for each voxel along the axis
  check_bits(read_back(context, textures[0]), bifocal_bits());
  check_bits(read_back(context, textures[2]), bifocal_bits());
  const std::vector<glm::vec4> y = read_back(context, textures[1]);
  REQUIRE(y.size() == 16);
  CHECK(y[0] == glm::vec4(0.015625F, 1, 0.125F, 0.0625F)); // x = 1/32: u = 3/64, x/(1/4), 1 − 2·15/32
  CHECK(y[7] == glm::vec4(0.015625F, 1, 1, 0.9375F));      // x = 15/32: u = 3/8 + 7/64 = 31/64

  // A changed effect rewrites them in place.
  const GLuint name = textures[0].name();
  CHECK(upload_axis_tables(context.functions(), small_scene(lens), textures) == bytes);
  CHECK(textures[0].name() == name);
  check_bits(read_back(context, textures[0]), lens_bits());
  check_bits(read_back(context, textures[2]), lens_bits());
}

TEST_CASE("render.axis_texels sets the length of all three tables") {
  const gl::Context context = test_context();
  AxisTextures textures;
  (void)upload_axis_tables(context.functions(), small_scene(bifocal), textures);
  const std::size_t bytes =
      upload_axis_tables(context.functions(), small_scene(bifocal, R"(,"axis_texels":16)"), textures);
  CHECK(bytes == std::size_t{3 * 16 * 16});
  for (const gl::Texture& texture : textures)
    CHECK(read_back(context, texture).size() == 16);
  CHECK(read_back(context, textures[0])[7] == glm::vec4(0.015625F, 1, 1, 0.9375F));
}
