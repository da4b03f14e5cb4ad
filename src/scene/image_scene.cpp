#include "scene/image_scene.h"

#include "scene/keys_json.h"

namespace slicelens {

using namespace keys_json;

namespace {

// ---- the key table of 2D scenes; lenses have the keys of scene/keys.h

template <class Visitor, class Settings>
void image_keys(Visitor& visit, Settings& s) {
  visit.key("file", s.file, "any picture that OpenImageIO reads; excludes the patterns");
  visit.option("checkerboard", s.checkerboard, "black and white squares", [](auto& v, auto& x) {
    v.key("size", x.size, "pixels [width, height]");
    v.key("squares", x.squares, "along the longer edge");
  });
  visit.option("testcard", s.testcard, "colour picture with fine detail",
               [](auto& v, auto& x) { v.key("size", x.size, "pixels [width, height]"); });
}

template <class Visitor, class Settings>
void image_render_keys(Visitor& visit, Settings& s) {
  visit.key("pipeline", s.pipeline,
            "where the lens is evaluated: tessellated (per vertex), fixed-function (per vertex, without "
            "shaders, 8 bits), fragment, lookup (a table of RG32F texels) or reference (CPU, double)");
  visit.key("size", s.size,
            "picture [width, height] in pixels (none: the image's own); the image is fitted into it");
  visit.key("filter", s.filter,
            "nearest, linear (the driver's) or linear-exact (float weights in the shader)");
  visit.key("target", s.target, "what is drawn into: rgba8, rgba16f or rgba32f");
  visit.key("image_texture", s.image_texture, "texture the image is held in: rgba8 or rgba32f");
  visit.key("lookup_size", s.lookup_size, "texels along the longer edge of the table of pipeline lookup");
  visit.key("background", s.background, "[r, g, b, a] in [0,1], not associated", Range::unit);
  visit.key("context", s.context, "auto (osmesa, then egl), osmesa, egl or window");
}

template <class Visitor, class Settings>
void image_scene_keys(Visitor& visit, Settings& s) {
  visit.key("title", s.title, "shown in galleries and reports");
  visit.section("image", s.image, "what is looked at", [](auto& v, auto& x) { image_keys(v, x); });
  visit.section("render", s.render, "how it is drawn", [](auto& v, auto& x) { image_render_keys(v, x); });
  visit.section("overlay", s.overlay, "what is drawn over it", [](auto& v, auto& x) { overlay_keys(v, x); });
  visit.warps("warp", s.warp);
}

// ---- what differs from a volume's lens: two coordinates, no depth

void widen_lens(Json& lens, const std::string& path) {
  if (!lens.is_object())
    return; // the reader says what is wrong
  if (!lens.contains("kind") || lens["kind"].is_null())
    lens["kind"] = "lamar";
  for (const char* key : {"depth_inner", "depth_outer"}) {
    if (lens.contains(key) && !lens[key].is_null())
      throw UsageError(path + "." + key + ": a picture has no depth; leave it out");
  }
  if (!lens.contains("center") || lens["center"].is_null())
    return;
  Json& center = lens["center"];
  const bool flat = center.is_array() && center.size() == 3 && center[2] == 0.5;
  if (center.is_array() && center.size() == 2)
    center.push_back(0.5);
  else if (!flat)
    refuse(path + ".center", center, "give [x, y] from the image's top left corner");
}

void widen_lenses(Json& json) {
  if (!json.contains("warp") || json["warp"].is_null())
    json["warp"] = Json::object();
  Json& warp = json["warp"];
  if (!warp.is_array()) {
    widen_lens(warp, "warp");
    return;
  }
  for (std::size_t i = 0; i < warp.size(); ++i)
    widen_lens(warp[i], "warp[" + std::to_string(i) + "]");
}

void narrow_lens(Json& lens) {
  lens["center"].erase(2);
  lens.erase("depth_inner");
  lens.erase("depth_outer");
}

void validate_size(const std::array<std::size_t, 2>& size, const std::string& key) {
  for (const std::size_t n : size) {
    if (n < 1 || n > 32768)
      throw UsageError(key + ": width and height must be from 1 to 32768 pixels");
  }
  if (size[0] * size[1] > max_image_pixels) {
    throw UsageError(key + ": " + std::to_string(size[0]) + "×" + std::to_string(size[1]) +
                     " pixels are too many; at most " + std::to_string(max_image_pixels));
  }
}

} // namespace

const std::vector<EnumName<LensPipeline>>& names_of(LensPipeline) {
  static const std::vector<EnumName<LensPipeline>> names = {{LensPipeline::tessellated, "tessellated"},
                                                            {LensPipeline::fixed_function, "fixed-function"},
                                                            {LensPipeline::fragment, "fragment"},
                                                            {LensPipeline::lookup, "lookup"},
                                                            {LensPipeline::reference, "reference"}};
  return names;
}

bool draws_triangles(LensPipeline pipeline) {
  return pipeline == LensPipeline::tessellated || pipeline == LensPipeline::fixed_function;
}

void validate(const ImageScene& scene) {
  if (scene.render.filter == Filter::cubic) {
    throw UsageError("render.filter 'cubic' is for volumes; a picture takes nearest, linear or linear-exact");
  }
  if (scene.render.pipeline == LensPipeline::fixed_function) {
    const auto refuse = [](const std::string& problem, const std::string& key, const std::string& value) {
      throw UsageError("pipeline 'fixed-function' " + problem + "; set " + key + " to " + value);
    };
    if (scene.render.target != Target::rgba8)
      refuse("draws into the papers' 8 bits", "render.target", "rgba8");
    if (scene.render.image_texture != TransferTexture::rgba8)
      refuse("holds the image in 8 bits", "render.image_texture", "rgba8");
    if (scene.render.filter == Filter::linear_exact)
      refuse("has no filter 'linear-exact', which is a shader's", "render.filter", "linear or nearest");
  }
  const ImageSettings& image = scene.image;
  const int given = (image.file ? 1 : 0) + (image.checkerboard ? 1 : 0) + (image.testcard ? 1 : 0);
  if (given != 1)
    throw UsageError("image.file, image.checkerboard and image.testcard exclude each other; give one");
  if (image.file && image.file->empty())
    throw UsageError("image.file is empty; name a picture");
  if (image.checkerboard) {
    validate_size(image.checkerboard->size, "image.checkerboard.size");
    const std::size_t squares = image.checkerboard->squares;
    if (squares < 1 || squares > 32768)
      throw UsageError("image.checkerboard.squares must be from 1 to 32768, not " + std::to_string(squares));
  }
  if (image.testcard)
    validate_size(image.testcard->size, "image.testcard.size");
  if (scene.render.size)
    validate_size(*scene.render.size, "render.size");
  if (scene.render.lookup_size < 2 || scene.render.lookup_size > 4096) {
    throw UsageError("render.lookup_size must be from 2 to 4096 texels, not " +
                     std::to_string(scene.render.lookup_size));
  }
  validate(scene.overlay);
  if (scene.overlay.wireframe != Wireframe::none && !draws_triangles(scene.render.pipeline)) {
    throw UsageError("overlay.wireframe shows the triangles of pipeline 'tessellated'; '" +
                     word(scene.render.pipeline) + "' has none");
  }
  for (const Warp& warp : scene.warp) {
    validate(warp);
    const auto* lens = std::get_if<LamarLens>(&warp);
    if (lens == nullptr)
      throw UsageError("warp '" + kind_of(warp) + "' has no form for pictures; give lamar");
    if (!lens->homogeneous && !draws_triangles(scene.render.pipeline)) {
      throw UsageError("homogeneous false is about corners of triangles; pipeline '" +
                       word(scene.render.pipeline) + "' has none, give tessellated");
    }
  }
}

ImageScene image_scene_from_json(const std::string& text, const std::string& source,
                                 const std::vector<KeyValue>& changes) {
  Json json = changed_document(text, source, changes);
  ImageScene scene;
  try {
    widen_lenses(json);
    Reader reader(json, "");
    image_scene_keys(reader, scene);
    reader.finish();
    if (!scene.image.file && !scene.image.checkerboard && !scene.image.testcard)
      scene.image.testcard.emplace();
    if (scene.render.pipeline == LensPipeline::fixed_function) {
      if (!has_value(json, "render", "target"))
        scene.render.target = Target::rgba8;
      if (!has_value(json, "render", "image_texture"))
        scene.render.image_texture = TransferTexture::rgba8;
    }
    validate(scene);
  } catch (const UsageError& error) {
    throw UsageError(source + ": " + error.what());
  }
  return scene;
}

std::string image_scene_to_json(const ImageScene& scene, int indent) {
  Writer writer;
  image_scene_keys(writer, scene);
  Json& warp = writer.object["warp"];
  if (warp.is_array()) {
    for (Json& lens : warp)
      narrow_lens(lens);
  } else {
    narrow_lens(warp);
  }
  return writer.object.dump(indent, ' ', true, Json::error_handler_t::replace);
}

bool is_image_scene(const std::string& text) {
  const Json json = Json::parse(text, nullptr, false, true);
  return json.is_object() && json.contains("image") && !json.contains("volume");
}

std::vector<std::pair<std::string, std::string>> list_image_scene_keys() {
  std::vector<std::pair<std::string, std::string>> keys;
  Lister lister{keys, ""};
  const ImageScene scene;
  image_scene_keys(lister, scene);
  std::erase_if(keys, [](const auto& key) { return key.first.find(".depth_") != std::string::npos; });
  return keys;
}

} // namespace slicelens
