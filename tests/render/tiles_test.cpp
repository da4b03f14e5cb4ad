// The volume held in several textures: the same picture, cut exactly where tiles meet.
#include "catch.h"
#include "render/bricks.h"
#include "render_fixture.h"
#include "volume_fixture.h"

#include <map>

using namespace slicelens;

namespace {

/// The head with a lens whose centre is the corner where the tiles of [2,2,2] meet: (32 + ½)/64.
PreparedScene head_scene() {
  return prepare_phantom(
      R"({"volume":{"phantom":"head","size":[64,64,64]},"camera":{"azimuth":33,"elevation":21,"roll":10},
          "warp":{"kind":"lamar","zoom":3,"center":[0.5078125,0.5078125,0.5078125],"inner":0.15,"outer":0.28},
          "render":{"pipeline":"tessellated","size":[80,80],"filter":"linear-exact","background":[0,0,0,0]}})",
      rising(100, 1500, 0.3));
}

using Edge = std::array<float, 6>; // as the driver gets them

/// Total length of the edges that do not meet an edge of equal corners: the outline, and any T-junction.
double open_length(const std::vector<LensMesh>& meshes) {
  std::map<Edge, int> count;
  for (const LensMesh& mesh : meshes) {
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      const std::size_t next = i % 3 == 2 ? i - 2 : i + 1;
      glm::vec3 a(mesh.vertices[mesh.triangles[i]].position);
      glm::vec3 b(mesh.vertices[mesh.triangles[next]].position);
      if (std::tie(b.x, b.y, b.z) < std::tie(a.x, a.y, a.z))
        std::swap(a, b);
      ++count[{a.x, a.y, a.z, b.x, b.y, b.z}];
    }
  }
  double length = 0;
  for (const auto& [e, times] : count) {
    if (times == 1)
      length += static_cast<double>(glm::length(glm::vec3(e[3] - e[0], e[4] - e[1], e[5] - e[2])));
  }
  return length;
}

double area(const LensMesh& mesh) {
  double sum = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
    const glm::dvec3 a = mesh.vertices[mesh.triangles[i]].position;
    sum += 0.5 * glm::length(glm::cross(mesh.vertices[mesh.triangles[i + 1]].position - a,
                                        mesh.vertices[mesh.triangles[i + 2]].position - a));
  }
  return sum;
}

} // namespace

TEST_CASE("tiles share out a slice once, with equal corners where they meet") {
  // Planes across x of the unit cube with a lens whose magnified data cross several boundaries.
  LamarLens lens;
  lens.center = {0.45, 0.52, 0.48};
  lens.inner = 0.2;
  lens.outer = 0.35;
  lens.angular_segments = 24;
  WarpView view;
  view.forward = {1, 0, 0};
  view.right = {0, 1, 0};
  view.up = {0, 0, 1};
  const BoxSpace space;
  const std::vector<LensTessellation> lenses = {prepare_lens(lens, space, view, 100)};
  const TileCuts cuts{{{{0.37}, {0.31, 0.5, 0.55}, {0.25, 0.61}}}};
  REQUIRE(tile_count(cuts) == 24);
  for (const double x : {0.1, 0.37, 0.45, 0.6}) {
    const Polygon square = {{x, 0, 0}, {x, 1, 0}, {x, 1, 1}, {x, 0, 1}};
    const LensMesh whole = tessellate_slice(square, lenses, space, {});
    const std::vector<LensMesh> tiles = split_by_tiles(whole, cuts);
    double sum = 0;
    for (std::size_t tile = 0; tile < tiles.size(); ++tile) {
      sum += area(tiles[tile]);
      for (const LensVertex& vertex : tiles[tile].vertices) {
        const glm::dvec3 t = glm::dvec3(vertex.texture) / vertex.texture.w;
        const std::size_t place[3] = {tile % 2, tile / 2 % 4, tile / 8};
        for (int axis = 0; axis < 3; ++axis) {
          const auto& planes = cuts.planes[static_cast<std::size_t>(axis)];
          const std::size_t i = place[axis];
          CHECK(t[axis] >= (i == 0 ? 0 : planes[i - 1]) - 1e-12); // rounding of the cut
          CHECK(t[axis] <= (i == planes.size() ? 1 : planes[i]) + 1e-12);
        }
      }
    }
    INFO("x = " << x);
    CHECK(sum == Approx(area(whole)).epsilon(1e-12));
    CHECK(open_length(tiles) == Approx(open_length({whole})).epsilon(1e-5)); // lengths of floats
  }
}

TEST_CASE("tiles change no picture", "[one-driver]") {
  gl::Context context = test_context();
  const PreparedScene head = head_scene();
  const std::vector<std::vector<std::string>> variants = {
      {},
      {"render.shading=diffuse"},
      {"render.shading=diffuse", "render.gradient=forward"},
      {"camera.projection=perspective", "render.shading=diffuse"},
      {R"(clip=[{"point":[0.5,0.4,0.5],"normal":[0.2,1,0.1]},{"point":[0.6,0.5,0.5],"normal":[-1,0.2,0],"space":"object"}])"},
      {"render.mode=mip"},
      {"render.mode=xray"},
      {"render.filter=linear"},
      {"render.filter=nearest"},
      {"render.filter=cubic"},
      {"render.filter=cubic", "render.shading=diffuse"},
      {"render.filter=cubic", "render.shading=diffuse", "render.gradient=forward", "render.levels=3"},
      {"render.order=front-to-back"},
      {"warp.shape=square", "warp.border=linear"},
      {"warp.border=simple", "warp.bounded=false"},
      {"render.volume_texture=r32f", "render.target=rgba16f"},
      {"warp=[]", "render.pipeline=slices", "render.shading=diffuse"},
      {"render.levels=3", "render.shading=diffuse"},
  };
  for (const auto& keys : variants) {
    const PreparedScene whole = changed(head, keys);
    for (const std::string tiles : {"[2,2,2]", "[3,1,4]"}) {
      std::string text;
      for (const std::string& key : keys)
        text += key + " ";
      const double decibels =
          psnr(picture(whole, context), picture(changed(whole, {"render.tiles=" + tiles}), context));
      INFO(text << tiles << ": " << decibels << " dB");
      CHECK(decibels >= 70); // rounding of coordinates: 83 to 160 dB; one missing voxel of overlap gives 46
                             // to 60 (cubic: 65)
    }
  }
}

TEST_CASE("neighbouring tiles overlap by one voxel, and by the gradient's reach more") {
  const Volume volume = volume_of(ScalarType::f32, {64, 20, 9}, [](int i, int, int) { return i; });
  const auto plan = [&](const std::string& keys) {
    return plan_bricks(
        prepare(scene_from_json(R"({"render":{"tiles":[2,1,1],"levels":1)" + keys + "}}", "test"), volume,
                grey(0.1)));
  };
  // Boundary at the centre of voxel 32: tiles hold voxels 0 … 32 and 32 … 63.
  const BrickPlan plain = plan("");
  REQUIRE(plain.bricks.size() == 2);
  CHECK(plain.cuts.planes[0] == std::vector<double>{32.5 / 64});
  CHECK(plain.bricks[0].size == std::array<std::size_t, 3>{33, 20, 9});
  CHECK(plain.bricks[1].first[0] == 32);
  CHECK(plain.bricks[1].size[0] == 32);
  CHECK(brick_voxels(plain) == (33 + 32) * 20 * 9);
  // The centre of voxel 40 is at (40 + ½)/64, in the second brick its voxel 8: (8 + ½)/32.
  CHECK(plain.bricks[1].scale.x * 40.5 / 64 + plain.bricks[1].offset.x == Approx(8.5 / 32).epsilon(1e-14));
  const BrickPlan central = plan(R"(,"shading":"diffuse")"); // 0 … 33 and 31 … 63
  CHECK(central.bricks[0].size[0] == 34);
  CHECK(central.bricks[1].first[0] == 31);
  CHECK(central.bricks[1].size[0] == 33);
  const BrickPlan forward = plan(R"(,"shading":"diffuse","gradient":"forward")"); // 0 … 33 and 32 … 63
  CHECK(forward.bricks[0].size[0] == 34);
  CHECK(forward.bricks[1].first[0] == 32);

  const BrickPlan cubic = plan(R"(,"filter":"cubic")"); // 0 … 33 and 31 … 63
  CHECK(cubic.bricks[0].size[0] == 34);
  CHECK(cubic.bricks[1].first[0] == 31);
  const BrickPlan shaded =
      plan(R"(,"filter":"cubic","shading":"diffuse","gradient":"forward")"); // 0 … 34, 31 … 63
  CHECK(shaded.bricks[0].size[0] == 35);
  CHECK(shaded.bricks[1].first[0] == 31);

  gl::Context context = test_context();
  PreparedScene scene =
      prepare(scene_from_json(R"({"render":{"tiles":[2,1,1],"size":[8,8]}})", "test"), volume, grey(0.1));
  const RenderResult result = render(scene, &context, {});
  CHECK(result.volume_textures == 2);
  // r32f: 4 bytes; the transfer function takes the same in both.
  CHECK(result.texture_bytes - result.whole_texture_bytes == 1 * 20 * 9 * 4);
  CHECK(result.slices > 0);
}

TEST_CASE("tiles and levels that cannot be are refused by name") {
  const auto refusal = [](const std::string& render, const std::string& rest = "") {
    try {
      prepare_phantom(R"({"volume":{"phantom":"box","size":[16,16,16]},"render":{)" + render + "}" + rest +
                          "}",
                      grey(0.1));
    } catch (const UsageError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const std::string lens = R"(,"warp":{"kind":"lamar","zoom":2})";
  const auto names = [](const std::string& text, const std::string& part) {
    INFO(text);
    CHECK(text.find(part) != std::string::npos);
  };
  names(refusal(R"("tiles":[0,1,1])"), "render.tiles");
  names(refusal(R"("tiles":[5,1,1])"), "at most 4");
  names(refusal(R"("tiles":[2000,1,1])"), "1024");
  names(refusal(R"("tiles":[1000,1000,1000])"), "render.tiles asks for 1000000000");
  names(refusal(R"("tiles":[18446744073709551615,18446744073709551615,2])"), "render.tiles");
  names(refusal(R"("tiles":[2,1])"), "render.tiles");
  names(refusal(R"("tiles":[2,1,1],"pipeline":"rays")"), "pipeline 'rays'");
  names(refusal(R"("tiles":[2,1,1],"pipeline":"fragment")", lens), "pipeline 'fragment'");
  CHECK(refusal(R"("tiles":[2,1,1],"pipeline":"reference")").empty());
  CHECK(refusal(R"("tiles":[4,4,4])").empty());
  names(refusal(R"("levels":0)"), "render.levels");
  names(refusal(R"("levels":9)"), "render.levels");
  names(refusal(R"("levels":6)"), "render.levels 6 is more");
  CHECK(refusal(R"("levels":5)").empty());
  names(refusal(R"("levels":3)", R"(,"warp":{"kind":"lamar","zoom":1})"), "warp.zoom");
  names(refusal(R"("levels":3)", R"(,"warp":{"kind":"lamar","homogeneous":false})"), "warp.homogeneous");
}
