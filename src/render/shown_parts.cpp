#include "render/shown_parts.h"

namespace slicelens {

namespace {

/// One texel of the tables of pipeline `axis`: between two texels the map drawn takes the values of the exact
/// one between them, which moves what is shown by no more. 0 elsewhere.
glm::dvec3 table_texel(const PreparedScene& prepared) {
  glm::dvec3 texel(0);
  if (prepared.scene.render.pipeline != Pipeline::axis)
    return texel;
  for (int axis = 0; axis < 3; ++axis) {
    const std::size_t count = prepared.tables.texels[static_cast<std::size_t>(axis)].size();
    texel[axis] = 1.0 / static_cast<double>(count);
  }
  return texel;
}

} // namespace

ShownBounds shown_parts(const PreparedScene& prepared) {
  const std::vector<WarpMap> maps = drawn_maps(prepared);
  if (maps.empty())
    return [](const Bounds& box) { return std::optional<Bounds>(box); };
  const BoxSpace space = prepared.space;
  // Offsets are filtered with rounded weights, so the data looked at may be a little off as well.
  const glm::dvec3 texel = table_texel(prepared);
  return [space, texel, shown = shown_bounds_of(maps)](const Bounds& box) {
    std::optional<Bounds> bounds =
        shown({box_from_texture(space, box.low - texel), box_from_texture(space, box.high + texel)});
    if (bounds) {
      bounds->low = texture_from_box(space, bounds->low) - texel;
      bounds->high = texture_from_box(space, bounds->high) + texel;
    }
    return bounds;
  };
}

Bounds with_edge(const Bounds& box) {
  return {glm::mix(box.low, glm::dvec3(-1), glm::lessThanEqual(box.low, glm::dvec3(0))),
          glm::mix(box.high, glm::dvec3(2), glm::greaterThanEqual(box.high, glm::dvec3(1)))};
}

} // namespace slicelens
