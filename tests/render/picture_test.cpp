// What a picture must show whatever the pipeline: backgrounds, clipping, any grid in any pose, any camera.
#include "catch.h"
#include "render_fixture.h"
#include "volume/closed_forms.h"
#include "volume_fixture.h"

using namespace slicelens;

namespace {

const std::vector<std::string> pipelines = {"slices", "rays", "reference"};
const std::string oblique = R"("camera":{"azimuth":33,"elevation":21,"roll":10},)";

PreparedScene box_scene(const std::string& extra = "", double opacity = 0.05) {
  return prepare_phantom(
      R"({"volume":{"phantom":"box","size":[32,32,32]},)" + oblique + extra +
          R"("render":{"size":[48,48],"filter":"linear-exact","background":[0,0,0,0],"spacing":0.25}})",
      grey(opacity));
}

/// The interval of `ray` inside the axis-aligned cube [−16, 16]³, by the slab method written out.
Interval cube_interval(const Ray& ray) {
  Interval inside{-1e30, 1e30};
  for (int axis = 0; axis < 3; ++axis) {
    const double a = (-16 - ray.origin[axis]) / ray.direction[axis];
    const double b = (16 - ray.origin[axis]) / ray.direction[axis];
    inside.near = std::max(inside.near, std::min(a, b));
    inside.far = std::min(inside.far, std::max(a, b));
  }
  return inside;
}

double opacity_of(double alpha, double length) { return length > 0 ? 1 - std::pow(1 - alpha, length) : 0; }

} // namespace

TEST_CASE("a background shows through what the volume leaves") {
  gl::Context context = test_context();
  for (const std::string& pipeline : pipelines) {
    const std::string key = "render.pipeline=" + pipeline;
    const Image bare = picture(changed(box_scene(), {key}), context);
    const Image opaque = picture(changed(box_scene(), {key, "render.background=[0.2,0.4,0.6,1]"}), context);
    const Image half = picture(changed(box_scene(), {key, "render.background=[0.2,0.4,0.6,0.5]"}), context);
    const double color[3] = {0.2, 0.4, 0.6};
    double largest = 0;
    for (int y = 0; y < bare.height; ++y) {
      for (int x = 0; x < bare.width; ++x) {
        const double through = 1 - static_cast<double>(channel(bare, x, y, 3));
        const auto check = [&](const Image& image, int c, double expected) {
          largest = std::max(largest, std::abs(static_cast<double>(channel(image, x, y, c)) - expected));
        };
        for (int c = 0; c < 3; ++c) {
          const double own = static_cast<double>(channel(bare, x, y, c));
          check(opaque, c, own + through * color[c]);
          check(half, c, own + through * 0.5 * color[c]);
        }
        check(opaque, 3, 1);
        check(half, 3, 1 - 0.5 * through);
      }
    }
    INFO(pipeline);
    CHECK(largest < 1e-6); // float rounding
    CHECK(channel(bare, 24, 24, 3) > 0.5F);
  }
}

TEST_CASE("clipping planes leave the chord on their kept side") {
  gl::Context context = test_context();
  const glm::dvec3 normals[2] = {{-1, 0.3, 0.2}, {0.2, 1, 0.1}};
  // Texture (.5,.5,.5) and (.4,.3,.6) of a 32 mm cube centred on the origin.
  const glm::dvec3 points[2] = {{0, 0, 0}, {-3.2, -6.4, 3.2}};
  const std::string clip = R"("clip":[{"point":[0.5,0.5,0.5],"normal":[-1,0.3,0.2]},)"
                           R"({"point":[0.4,0.3,0.6],"normal":[0.2,1,0.1]}],)";
  for (const std::string projection : {"orthographic", "perspective"}) {
    for (const std::string& pipeline : pipelines) {
      const PreparedScene scene =
          changed(box_scene(clip), {"render.pipeline=" + pipeline, "camera.projection=" + projection});
      const auto chord = [&](int x, int y) {
        const Ray ray = pixel_ray(scene, x, y);
        Interval kept = cube_interval(ray);
        for (int i = 0; i < 2; ++i) {
          const double slope = glm::dot(normals[i], ray.direction);
          const double crossing = glm::dot(normals[i], points[i] - ray.origin) / slope;
          (slope > 0 ? kept.near : kept.far) =
              slope > 0 ? std::max(kept.near, crossing) : std::min(kept.far, crossing);
        }
        return kept.far - kept.near;
      };
      const double error = mean_error(
          picture(scene, context), 3, [&](int x, int y) { return opacity_of(0.05, chord(x, y)); },
          [&](int x, int y) { return chord(x, y) > 0; });
      INFO(pipeline << ", " << projection << ": " << error);
      // Either end of the chord is known to ±Δ/2, evenly: Δ/3 in the mean of the two. With τ = .051 per voxel
      // and Δ = ¼ that is 4.3e-3 where nothing is in front, less elsewhere.
      CHECK(error < 4.3e-3);
    }
  }
}

TEST_CASE("a plane that leaves nothing gives the background, one that takes nothing the whole box") {
  gl::Context context = test_context();
  for (const std::string& pipeline : pipelines) {
    const std::string key = "render.pipeline=" + pipeline;
    const Image nothing =
        picture(changed(box_scene(), {key, R"(clip=[{"point":[0.5,-0.1,0.5],"normal":[0,-1,0]}])"}), context);
    CHECK(max_difference(nothing, make_image(48, 48)) == 0);
    const Image all =
        picture(changed(box_scene(), {key, R"(clip=[{"point":[0.5,-0.1,0.5],"normal":[0,1,0]}])"}), context);
    CHECK(max_difference(all, picture(changed(box_scene(), {key}), context)) < 1e-6);
  }
}

TEST_CASE("wide and tall pictures show the same pixels in their middle") {
  gl::Context context = test_context();
  const std::string scale = "camera.parallel_scale=";
  for (const std::string& pipeline : pipelines) {
    const std::string key = "render.pipeline=" + pipeline;
    const Image square = picture(changed(box_scene(), {key, scale + "28"}), context);
    const Image wide = picture(changed(box_scene(), {key, scale + "28", "render.size=[80,48]"}), context);
    const Image tall = picture(changed(box_scene(), {key, scale + "56", "render.size=[48,96]"}), context);
    const auto differing = [&](const Image& larger, int dx, int dy) {
      int count = 0;
      for (int y = 0; y < 48; ++y) {
        for (int x = 0; x < 48; ++x)
          count += std::abs(channel(square, x, y, 3) - channel(larger, x + dx, y + dy, 3)) > 1e-4F ? 1 : 0;
      }
      return count;
    };
    INFO(pipeline);
    // The rays are the same but for rounding, which moves single samples across the box's faces.
    CHECK(differing(wide, 16, 0) <= 24);
    CHECK(differing(tall, 0, 24) <= 24);
  }
}

TEST_CASE("the middle ray of a 1 x 1 picture") {
  gl::Context context = test_context();
  for (const std::string& pipeline : pipelines) {
    const PreparedScene scene = changed(box_scene(), {"render.pipeline=" + pipeline, "render.size=[1,1]"});
    const Interval inside = cube_interval(pixel_ray(scene, 0, 0));
    CHECK(channel(picture(scene, context), 0, 0, 3) ==
          Approx(opacity_of(0.05, inside.far - inside.near)).margin(0.007));
  }
}

TEST_CASE("a camera inside the volume sees what lies before it") {
  gl::Context context = test_context();
  const std::string camera =
      R"("camera":{"projection":"perspective","view_angle":70,"position":[3,-5,2],"focal_point":[20,9,-4]},)";
  for (const std::string& pipeline : pipelines) {
    const PreparedScene scene = prepare_phantom(
        R"({"volume":{"phantom":"box","size":[32,32,32]},)" + camera +
            R"("render":{"size":[48,48],"filter":"linear-exact","background":[0,0,0,0],"spacing":0.25,"pipeline":")" +
            pipeline + R"("}})",
        grey(0.05));
    const double error = mean_error(picture(scene, context), 3, [&](int x, int y) {
      return opacity_of(0.05, cube_interval(pixel_ray(scene, x, y)).far);
    });
    INFO(pipeline << ": " << error);
    CHECK(error < 4.3e-3); // as for clipping planes
  }
}

TEST_CASE("a view that misses the volume shows the background only") {
  gl::Context context = test_context();
  for (const std::string& pipeline : pipelines) {
    for (const std::string mode : {"dvr", "mip", "xray"}) {
      for (const std::string projection : {"orthographic", "perspective"}) {
        const Image image =
            picture(changed(box_scene(), {"render.pipeline=" + pipeline, "render.mode=" + mode,
                                          "camera.projection=" + projection, "camera.position=[0,200,0]",
                                          "camera.focal_point=[300,400,0]", "camera.parallel_scale=10",
                                          "render.background=[0.1,0.2,0.3,1]"}),
                    context);
        INFO(pipeline << " " << mode << " " << projection);
        bool right = true;
        for (std::size_t i = 0; i < image.pixels.size(); i += 4) {
          right = right && image.pixels[i] == 0.1F && image.pixels[i + 1] == 0.2F &&
                  image.pixels[i + 2] == 0.3F && image.pixels[i + 3] == 1.0F;
        }
        CHECK(right);
      }
    }
  }
}

TEST_CASE("early termination stays within its bound") {
  gl::Context context = test_context();
  const double stop = 0.9;
  std::vector<Image> stopped_pictures;
  for (const std::string pipeline : {"rays", "reference"}) {
    const PreparedScene scene =
        changed(box_scene("", 0.1), {"render.pipeline=" + pipeline, "render.spacing=0.5"});
    const Image full = picture(scene, context);
    const Image early = picture(changed(scene, {"render.early_termination=0.9"}), context);
    int stopped = 0;
    double largest = 0;
    for (std::size_t i = 3; i < full.pixels.size(); i += 4) {
      const auto alpha = static_cast<double>(early.pixels[i]);
      const double lost = static_cast<double>(full.pixels[i]) - alpha;
      largest = std::max(largest, lost);
      stopped += lost > 1e-4 ? 1 : 0;
      if (lost > 1e-6)
        CHECK(alpha >= stop); // nothing stops before
    }
    INFO(pipeline);
    CHECK(largest <= 1 - stop + 1e-6); // what is behind can add no more
    CHECK(stopped > 50);
    stopped_pictures.push_back(early);
  }
  // Every ray stops at the same sample in both, unless rounding decides.
  CHECK(share_over(stopped_pictures[0], stopped_pictures[1], 1e-3) <= 0.01);
}

TEST_CASE("voxels of any scalar type with the same values give the same picture") {
  gl::Context context = test_context();
  const auto values = [](int i, int j, int k) { return (i * 37 + j * 61 + k * 17 + i * j * k) % 120; };
  const TransferFunction transfer = rising(10, 119, 0.4);
  const auto drawn = [&](ScalarType type, const std::string& texture, const std::string& pipeline) {
    const PreparedScene scene =
        prepare(scene_from_json("{" + oblique +
                                    R"("render":{"size":[32,32],"filter":"linear-exact","volume_texture":")" +
                                    texture + R"(","pipeline":")" + pipeline + R"("}})",
                                "test"),
                volume_of(type, {9, 7, 8}, values), transfer);
    return picture(scene, context);
  };
  const Image truth = drawn(ScalarType::f64, "auto", "reference");
  for (const ScalarType type :
       {ScalarType::u8, ScalarType::i8, ScalarType::u16, ScalarType::i16, ScalarType::u32, ScalarType::i32,
        ScalarType::u64, ScalarType::i64, ScalarType::f32, ScalarType::f64}) {
    INFO(name_of(type));
    CHECK(max_difference(drawn(type, "auto", "reference"), truth) == 0);
    for (const std::string texture : {"auto", "r16", "r32f"}) {
      INFO(texture);
      // Box-face samples may flip by rounding; 16-bit texels of floats are 1/65535 of the range off.
      CHECK(share_over(drawn(type, texture, "slices"), truth, 1e-3) <= 0.01);
      CHECK(share_over(drawn(type, texture, "rays"), truth, 1e-3) <= 0.01);
    }
  }
}

TEST_CASE("negative, large and offset values keep their differences") {
  gl::Context context = test_context();
  // The same pattern about different middles, seen through a transfer function that moves along.
  const auto drawn = [&](ScalarType type, double middle, const std::string& pipeline) {
    const auto values = [middle](int i, int j, int k) { return middle + (i * 5 + j * 7 + k * 3) % 60 - 30; };
    return picture(
        prepare(scene_from_json("{" + oblique +
                                    R"("render":{"size":[32,32],"filter":"linear-exact","pipeline":")" +
                                    pipeline + R"("}})",
                                "test"),
                volume_of(type, {6, 8, 7}, values), rising(middle - 20, middle + 29, 0.4)),
        context);
  };
  const Image truth = drawn(ScalarType::f64, 0, "reference");
  for (const std::string& pipeline : pipelines) {
    INFO(pipeline);
    CHECK(share_over(drawn(ScalarType::i8, -60, pipeline), truth, 1e-3) <= 0.01);
    CHECK(share_over(drawn(ScalarType::i16, -30000, pipeline), truth, 1e-3) <= 0.01);
    CHECK(share_over(drawn(ScalarType::u16, 65000, pipeline), truth, 1e-3) <= 0.01);
    // A float has 24 bits: steps of 1/16 at a million, 1/16 of a grey level of 49.
    CHECK(share_over(drawn(ScalarType::i32, 1e6, pipeline), truth, 5e-3) <= 0.01);
    CHECK(share_over(drawn(ScalarType::u64, 1e6, pipeline), truth, 5e-3) <= 0.01);
    CHECK(share_over(drawn(ScalarType::f64, 1e6, pipeline), truth, 5e-3) <= 0.01);
  }
}
