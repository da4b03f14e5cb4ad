#include "render/several_volumes.h"

#include "core/errors.h"
#include "render/uniforms.h"
#include "render/warp_glsl.h"

namespace slicelens {

namespace {

/// Every name that gpu/one_volume.glsl and the files it includes declare, and those of a chain of warps.
const std::vector<std::string>& own_names() {
  static const std::vector<std::string> names = {
      // gpu/volume.glsl, lib/cubic.glsl
      "value_from_texel", "texel_at", "cubic_weights", "cubic_fetches", "cubic_axis", "linear_texels",
      "filtered_texels", "filtered_texel", "volume_texture", "sample_texel", "displayed_texel",
      "displayed_value",
      // gpu/pages.glsl
      "page_texture", "texture_from_pool", "pages_from_voxels", "level_voxels", "level_pages", "no_place",
      "page_of", "page_texels", "voxel_of", "sample_texels", "held_page", "hold_page", "held_texel",
      // gpu/classify.glsl
      "transfer_texture", "transfer_from_value", "transfer_from_texel", "classify", "classify_texel",
      // the chain of warps, gpu/warp.glsl
      "chain_texture_from_object", "chain_jacobian", "box_size", "texture_from_box", "texture_from_object",
      "displayed_gradient", "in_volume", "data_plane_count", "data_planes", "in_data_planes",
      // gpu/gradient.glsl, lib/gradient.glsl
      "voxel", "gradient_texture", "gradient_scale", "gradient_at", "tap", "gradient_value",
      "forward_gradient", "central_gradient", "carried_gradient", "shown_gradient",
      // gpu/light.glsl
      "world_from_gradient", "to_light", "ambient", "diffuse", "specular", "power", "cool", "warm",
      "two_sided", "shade_with", "shade", "opacity_factor", "plain_color", "transfer_2d_texture",
      "transfer_2d_place", "classify_2d", "full_gradient",
      // gpu/one_volume.glsl
      "own_from_first", "length_ratio", "unit_from_value", "own_sample", "own_unit", "own_color"};
  return names;
}

std::string suffix(std::size_t index) { return "_" + std::to_string(index); }

std::string chain_name(std::size_t index) { return "generated/warps" + suffix(index) + ".glsl"; }

/// One volume's declarations under names of its own.
std::string one_volume(std::size_t index, std::size_t warps, const PreparedScene& volume) {
  std::vector<std::string> names = own_names();
  for (std::size_t i = 0; i < warps; ++i)
    names.push_back("warp_" + std::to_string(i));
  std::string text = "#undef GRADIENT_IN_OBJECT_SPACE\n";
  if (volume.gradient_space == GradientSpace::object)
    text += "#define GRADIENT_IN_OBJECT_SPACE\n";
  text += "#undef PAGED\n#undef LEVELS\n";
  if (is_paged(volume))
    text += "#define PAGED\n#define LEVELS 1\n";
  text += "#undef TRANSFER_2D\n";
  if (!volume.scene.transfer.shapes.empty())
    text += "#define TRANSFER_2D\n";
  for (const std::string& name : names)
    text += "#define " + name + " " + name + suffix(index) + "\n";
  text += "#include \"" + chain_name(index) + "\"\n#include \"gpu/one_volume.glsl\"\n";
  for (const std::string& name : names)
    text += "#undef " + name + "\n";
  return text;
}

/// The functions that shaders call, of all volumes.
std::string combining_functions(std::size_t count) {
  std::string samples = "vec4 all_samples(vec3 p, vec3 to_eye) {\n  vec4 samples[4];\n";
  std::string units = "vec4 all_units(vec3 p) {\n  vec4 units = vec4(0.0);\n";
  std::string colors = "vec4 color_of_units(vec4 units) {\n  vec4 samples[4];\n";
  for (std::size_t i = 0; i < count; ++i) {
    const std::string at = "[" + std::to_string(i) + "]";
    samples += "  samples" + at + " = own_sample" + suffix(i) + "(p, to_eye);\n";
    units += "  units" + at + " = own_unit" + suffix(i) + "(p);\n";
    colors += "  samples" + at + " = own_color" + suffix(i) + "(units" + at + ");\n";
  }
  const std::string end = "  return combined(samples, VOLUMES, COMBINE);\n}\n";
  return samples + end + units + "  return units;\n}\n" + colors + end;
}

/// Texture units in the order in which they are asked for; 2 is the one of MIP's maxima.
class UnitCounter {
public:
  explicit UnitCounter(int available) : available_(available) {}

  GLenum take() {
    if (next_ == 2)
      ++next_;
    if (static_cast<int>(next_) >= available_)
      throw LimitError("the volumes and their warps need more than the " + std::to_string(available_) +
                       " textures that the driver reads at once; show fewer volumes, landmarks or fields");
    return next_++;
  }

private:
  int available_;
  GLenum next_ = 0;
};

} // namespace

std::vector<EmbeddedFile> generated_files(const PreparedScene& prepared) {
  if (prepared.others.empty())
    return {warp_chain(drawn_maps(prepared)), {"generated/volumes.glsl", ""}};
  std::vector<EmbeddedFile> files = {{"generated/warps.glsl", ""}};
  std::vector<WarpMap> all;
  std::string text = "#include \"lib/combine.glsl\"\n#include \"generated/warp_types.glsl\"\n";
  for (std::size_t i = 0; i < volume_count(prepared); ++i) {
    const std::vector<WarpMap> maps = drawn_maps(volume_at(prepared, i));
    all.insert(all.end(), maps.begin(), maps.end());
    files.push_back({chain_name(i), warp_chain_functions(maps)});
    text += one_volume(i, maps.size(), volume_at(prepared, i));
  }
  files.push_back({"generated/warp_types.glsl", warp_includes(all)});
  files.push_back({"generated/volumes.glsl", text + combining_functions(volume_count(prepared))});
  return files;
}

std::vector<std::string> volume_macros(const PreparedScene& prepared) {
  if (prepared.others.empty())
    return {};
  return {"VOLUMES " + std::to_string(volume_count(prepared)),
          "COMBINE " + std::to_string(static_cast<int>(prepared.scene.combine))};
}

double length_ratio(const PreparedScene& prepared, std::size_t index) {
  if (prepared.scene.render.opacity_correction == OpacityCorrection::none)
    return 1;
  return prepared.unit_distance / volume_at(prepared, index).unit_distance;
}

glm::dvec2 several_unit_from_value(const PreparedScene& prepared) {
  const Volume& volume = prepared.volume;
  const double scale = 254.0 / 255 / (volume.max > volume.min ? volume.max - volume.min : 1);
  if (prepared.scene.render.mode == Mode::minip)
    return {-scale, 1 + scale * volume.min};
  return {scale, 1.0 / 255 - scale * volume.min};
}

void set_volumes(const gl::Functions& gl, const gl::Program& program, const PreparedScene& prepared,
                 const GpuScene& scene) {
  GLint available = 0;
  gl.GetIntegerv(GL_MAX_TEXTURE_IMAGE_UNITS, &available);
  UnitCounter counter(available);
  for (std::size_t i = 0; i < volume_count(prepared); ++i) {
    const PreparedScene& volume = volume_at(prepared, i);
    const GpuScene& textures = i == 0 ? scene : scene.others[i - 1];
    const gl::Uniforms uniforms(program, suffix(i));
    TextureUnits units;
    units.volume = counter.take();
    units.transfer = counter.take();
    units.pages = textures.pool ? counter.take() : 0;
    units.gradient = textures.gradients.texture ? counter.take() : 0;
    units.transfer_2d = textures.transfer_2d ? counter.take() : 0;
    units.grids.clear();
    for (std::size_t k = 0; k < textures.grids.size(); ++k)
      units.grids.push_back(counter.take());
    set_volume_uniforms(gl, uniforms, volume, textures, units);
    set_uniform(gl, uniforms, "own_from_first", glm::mat4(own_from_first(prepared, i)));
    set_uniform(gl, uniforms, "length_ratio", static_cast<float>(length_ratio(prepared, i)));
    set_uniform(gl, uniforms, "unit_from_value", glm::vec2(several_unit_from_value(volume)));
  }
}

} // namespace slicelens
