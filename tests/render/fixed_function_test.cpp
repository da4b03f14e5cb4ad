// Pipeline `fixed-function`: the same picture as `tessellated`, without a shader.
#include "catch.h"
#include "gl/check.h"
#include "gl/state.h"
#include "render/fixed_function.h"
#include "render_fixture.h"
#include "volume_fixture.h"

using namespace slicelens;
using Catch::Matchers::Contains;

namespace {

PreparedScene head_scene() {
  return prepare_phantom(
      R"({"volume":{"phantom":"head","size":[48,48,48]},"camera":{"azimuth":33,"elevation":21,"roll":10},
          "render":{"size":[96,96],"pipeline":"fixed-function","background":[0,0,0,0]}})",
      {{{-500, 0.4, 0.2, 0.1, 0}, {200, 0.8, 0.6, 0.4, 0.05}, {1200, 1, 1, 0.9, 0.7}}, std::nullopt, ""});
}

std::string lens(const std::string& keys) {
  return R"(warp={"kind":"lamar","center":[0.5,0.4,0.55],"inner":0.14,"outer":0.25,)" + keys + "}";
}

Image fixed_picture(const PreparedScene& scene) {
  gl::Context context = test_context(gl::Profile::compatibility);
  const Image image = picture(scene, context);
  CHECK(context.functions().GetError() == GL_NO_ERROR);
  return image;
}

Image shader_picture(const PreparedScene& scene) {
  gl::Context context = test_context();
  const std::string pipeline = scene.lenses.empty() ? "slices" : "tessellated";
  return picture(changed(scene, {"render.pipeline=" + pipeline}), context);
}

std::string refusal(const std::string& render, const std::string& rest = "") {
  try {
    scene_from_json(R"({"render":{"pipeline":"fixed-function",)" + render + "}" + rest + "}", "test");
  } catch (const UsageError& error) {
    return error.what();
  }
  return "accepted";
}

/// Two triangles that cover the picture and look at a texture through homogeneous coordinates (s·q, t·q, 0,
/// q).
LensMesh whole_picture(double q) {
  LensMesh mesh;
  for (const glm::dvec2 p : {glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(1, 1), glm::dvec2(0, 1)})
    mesh.vertices.push_back({glm::dvec3(p, 0), glm::dvec4(p * q, 0, q)});
  mesh.triangles = {0, 1, 2, 0, 2, 3};
  mesh.regions.assign(2, LensRegion::normal);
  return mesh;
}

} // namespace

TEST_CASE("without shaders the picture is that of tessellated slices") {
  // Same triangles, same 8-bit texture, same 8-bit blending: what may differ is the last bit of interpolated
  // coordinates, and with it a sample by one step of 255, which blending over some 80 slices keeps below two.
  const std::string planes = R"(clip=[{"point":[0.5,0.5,0.5],"normal":[-1,0.3,0.2]},
                                      {"point":[0.5,0.4,0.5],"normal":[0.2,1,0.1],"space":"object"}])";
  const std::vector<std::vector<std::string>> settings = {
      {"title=plain"},
      {planes},
      {lens(R"("zoom":3)")},
      {lens(R"("zoom":3,"shape":"square")")},
      {lens(R"("zoom":2,"border":"linear","bounded":false)"), planes},
      {lens(R"("zoom":2,"border":"simple","homogeneous":false)")},
      {"camera.projection=perspective"},
      {"camera.projection=perspective", "camera.view_angle=60", lens(R"("zoom":3)"), planes},
      {"render.order=front-to-back", lens(R"("zoom":3)")},
      {"render.spacing=0.5", "render.filter=nearest", "render.opacity_correction=none"}};
  const PreparedScene head = head_scene();
  for (const std::vector<std::string>& keys : settings) {
    const PreparedScene scene = changed(head, keys);
    const Image fixed = fixed_picture(scene);
    const Image shader = shader_picture(scene);
    std::string shown;
    for (const std::string& key : keys)
      shown += key + " ";
    INFO(shown);
    CHECK(max_difference(fixed, shader) <= 2.0 / 255 + 1e-6);
    // Something is in the picture.
    CHECK(share_over(fixed, Image{fixed.width, fixed.height, std::vector<float>(fixed.pixels.size()), {}},
                     0.2) > 0.05);
  }
}

TEST_CASE("a lens changes the fixed-function picture, and affine coordinates change it otherwise") {
  const PreparedScene head = head_scene();
  const Image plain = fixed_picture(head);
  const Image round = fixed_picture(changed(head, {lens(R"("zoom":3,"radial_segments":1)")}));
  const Image affine =
      fixed_picture(changed(head, {lens(R"("zoom":3,"radial_segments":1,"homogeneous":false)")}));
  CHECK(share_over(plain, round, 0.02) > 0.01);
  CHECK(share_over(round, affine, 0.02) > 0.001);
}

TEST_CASE("two slices blend as 8 bits do, without shaders") {
  // A box 8 voxels deep at spacing 4 is two samples of α' = 1 − .95⁴ = .1855 → 47/255. Over itself: 47 +
  // 47·(1 − 47/255) = 85.3 of 255; each blending step may round the other way.
  const PreparedScene box = prepare_phantom(
      R"({"volume":{"phantom":"box","size":[8,8,8]},"render":{"size":[16,16],"pipeline":"fixed-function",
          "spacing":4,"background":[0,0,0,0]}})",
      constant_transfer({1, 0.5, 0, 0.05}));
  const Image image = fixed_picture(box);
  CHECK(channel(image, 8, 8, 3) * 255 == Approx(85.3).margin(1));
  CHECK(channel(image, 8, 8, 0) * 255 == Approx(85.3).margin(1));
  // Green is 23.65 → 24 in each texel: 24 + 24·(1 − 47/255) = 43.6.
  CHECK(channel(image, 8, 8, 1) * 255 == Approx(43.6).margin(1));
  CHECK(channel(image, 8, 8, 2) == 0);
}

TEST_CASE("fixed function and shaders take turns in one process") {
  const PreparedScene head = changed(head_scene(), {lens(R"("zoom":3)")});
  const Image fixed = fixed_picture(head);
  const Image shader = shader_picture(head);
  gl::Context core = test_context();
  gl::Context compatibility = test_context(gl::Profile::compatibility);
  CHECK(picture(head, compatibility).pixels == fixed.pixels);
  core.make_current();
  CHECK(picture(changed(head, {"render.pipeline=tessellated"}), core).pixels == shader.pixels);
  compatibility.make_current();
  CHECK(picture(head, compatibility).pixels == fixed.pixels);
  // Shaders draw in a compatibility context as well, after fixed function left it as it was.
  CHECK(max_difference(picture(changed(head, {"render.pipeline=tessellated"}), compatibility), shader) <=
        1.0 / 255 + 1e-6);
}

TEST_CASE("a mesh with a 2D texture is drawn without shaders") {
  gl::Context context = test_context(gl::Profile::compatibility);
  const gl::Functions& gl = context.functions();
  const std::vector<std::uint8_t> texels = {255, 0, 0,   255, 0,   255, 0,   255,
                                            0,   0, 255, 255, 255, 255, 255, 255};
  gl::TextureSpec spec;
  spec.format = GL_RGBA8;
  spec.filter = GL_NEAREST;
  const gl::Texture texture = gl::make_texture_2d(gl, spec, {2, 2}, std::as_bytes(std::span(texels)));
  const gl::Target target = gl::make_target(gl, 4, 4, GL_RGBA8);
  FixedFunctionRenderer renderer(context);
  for (const double q : {1.0, 3.0}) { // (s·q, t·q, 0, q) is the same place for every q
    renderer.set_geometry(whole_picture(q));
    renderer.draw({GL_TEXTURE_2D, texture.name()},
                  glm::mat4(2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1, 0, -1, -1, 0, 1), Order::back_to_front, target,
                  {});
    const std::vector<float> pixels = gl::read_pixels(gl, target); // row 0 at the top: t = 1
    const auto pixel = [&](std::size_t x, std::size_t y) {
      const float* p = &pixels[4 * (4 * y + x)];
      return glm::vec4(p[0], p[1], p[2], p[3]);
    };
    CHECK(pixel(0, 3) == glm::vec4(1, 0, 0, 1));
    CHECK(pixel(3, 3) == glm::vec4(0, 1, 0, 1));
    CHECK(pixel(0, 0) == glm::vec4(0, 0, 1, 1));
    CHECK(pixel(3, 0) == glm::vec4(1, 1, 1, 1));
  }
  CHECK(renderer.triangle_count() == 2);
}

TEST_CASE("fixed function restores the state it finds, and is not disturbed by it") {
  const PreparedScene head = head_scene();
  const Image expected = fixed_picture(head);
  gl::Context context = test_context(gl::Profile::compatibility);
  const gl::Functions& gl = context.functions();
  const gl::FixedFunctions fixed = gl::load_fixed_functions(context);
  constexpr GLenum lighting = 0x0B50;
  constexpr GLenum alpha_test = 0x0BC0;
  constexpr GLenum generate_s = 0x0C60;
  const std::array<GLfloat, 16> matrix = {2, 0, 0, 0, 0, 3, 0, 0, 0, 0, 4, 0, 0.5, 0.25, 0.125, 1};
  for (const GLenum mode : {GLenum{GL_TEXTURE}, gl::fixed::modelview, gl::fixed::projection}) {
    fixed.MatrixMode(mode);
    fixed.LoadMatrixf(matrix.data());
  }
  fixed.TexEnvi(gl::fixed::texture_environment, gl::fixed::texture_environment_mode, GL_BLEND);
  const std::vector<GLenum> switches = {
      lighting,      alpha_test,        generate_s,      GL_TEXTURE_CUBE_MAP,
      GL_TEXTURE_2D, GL_CLIP_DISTANCE0, GL_SCISSOR_TEST, GL_COLOR_LOGIC_OP};
  for (const GLenum name : switches)
    gl.Enable(name);
  gl.Scissor(0, 0, 1, 1);
  gl.ActiveTexture(GL_TEXTURE2);
  fixed.ClientActiveTexture(GL_TEXTURE1);
  gl.BlendFunc(GL_ZERO, GL_ZERO);
  gl.ColorMask(GL_TRUE, GL_FALSE, GL_TRUE, GL_TRUE);

  CHECK(picture(head, context).pixels == expected.pixels);

  GLint unit = 0;
  gl.GetIntegerv(GL_ACTIVE_TEXTURE, &unit);
  CHECK(unit == GL_TEXTURE2);
  gl.ActiveTexture(GL_TEXTURE0); // whose switches they are
  for (const GLenum name : switches) {
    INFO(name);
    CHECK(gl.IsEnabled(name) != GL_FALSE);
  }
  CHECK(gl.IsEnabled(GL_TEXTURE_3D) == GL_FALSE);
  for (const GLenum name :
       {gl::fixed::texture_matrix, gl::fixed::modelview_matrix, gl::fixed::projection_matrix}) {
    std::array<GLfloat, 16> now{};
    gl.GetFloatv(name, now.data());
    CHECK(now == matrix);
  }
  const auto integer = [&](GLenum name) {
    GLint value = 0;
    gl.GetIntegerv(name, &value);
    return static_cast<GLenum>(value);
  };
  CHECK(integer(gl::fixed::matrix_mode) == gl::fixed::projection);
  CHECK(integer(gl::fixed::client_active_texture) == GL_TEXTURE1);
  CHECK(integer(GL_BLEND_SRC_RGB) == GL_ZERO);
  CHECK(integer(GL_VERTEX_ARRAY_BINDING) == 0);
  CHECK(integer(GL_TEXTURE_BINDING_3D) == 0);
  GLint environment = 0;
  fixed.GetTexEnviv(gl::fixed::texture_environment, gl::fixed::texture_environment_mode, &environment);
  CHECK(environment == GL_BLEND);
  CHECK(gl.GetError() == GL_NO_ERROR);
}

TEST_CASE("fixed function chooses what its hardware had and refuses the rest by name") {
  const Scene scene = scene_from_json(R"({"render":{"pipeline":"fixed-function"}})", "test");
  CHECK(scene.render.classification == Classification::pre);
  CHECK(scene.render.target == Target::rgba8);
  CHECK(scene.render.opacity_correction == OpacityCorrection::frame);
  const auto names = Contains("fixed-function");
  CHECK_THAT(refusal(R"("classification":"post")"), names && Contains("render.classification"));
  CHECK_THAT(refusal(R"("mode":"mip")"), names && Contains("render.mode"));
  CHECK_THAT(refusal(R"("mode":"xray")"), names && Contains("render.mode"));
  CHECK_THAT(refusal(R"("target":"rgba16f")"), names && Contains("render.target"));
  CHECK_THAT(refusal(R"("shading":"diffuse")"), names && Contains("render.shading"));
  CHECK_THAT(refusal(R"("filter":"linear-exact")"), names && Contains("linear-exact"));
  CHECK_THAT(refusal(R"("opacity_correction":"fragment")", R"(,"camera":{"projection":"perspective"})"),
             Contains("render.opacity_correction"));
  CHECK(refusal(R"("spacing":1)", R"(,"camera":{"projection":"perspective"})") == "accepted");
}

TEST_CASE("fixed function in a core context is refused by name") {
  gl::Context core = test_context();
  CHECK_THROWS_WITH(picture(head_scene(), core), Contains("compatibility") && Contains("core"));
  CHECK(core.functions().GetError() == GL_NO_ERROR);
}
