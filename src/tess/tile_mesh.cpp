#include "tess/tile_mesh.h"

#include "tess/homogeneous.h"

#include <algorithm>

namespace slicelens {

namespace {

void append_fan(LensMesh& mesh, const LensPolygon& polygon, LensRegion region) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), polygon.begin(), polygon.end());
  for (std::uint32_t i = 2; i < polygon.size(); ++i) {
    mesh.triangles.insert(mesh.triangles.end(), {first, first + i - 1, first + i});
    mesh.regions.push_back(region);
  }
}

/// Cuts `rest` at the boundaries of `axis` and goes on with the next axis. `tile` counts the tiles passed on
/// earlier axes.
void split(LensPolygon rest, LensRegion region, const TileCuts& cuts, std::size_t axis, std::size_t tile,
           std::size_t stride, std::vector<LensMesh>& tiles) {
  if (axis == 3) {
    append_fan(tiles[tile], rest, region);
    return;
  }
  const std::vector<double>& planes = cuts.planes[axis];
  const std::size_t next_stride = stride * (planes.size() + 1);
  glm::dvec3 normal(0);
  normal[static_cast<int>(axis)] = 1;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    const TextureHalfSpace above = homogeneous(Plane{normal, planes[i]});
    double low = 0;
    double high = 0;
    for (const LensVertex& vertex : rest) {
      const double value = glm::dot(above.coefficients, vertex.texture);
      low = std::min(low, value);
      high = std::max(high, value);
    }
    if (low >= 0)
      continue; // nothing below this boundary: not even a corner's area
    if (high <= 0) {
      split(std::move(rest), region, cuts, axis + 1, tile + i * stride, next_stride, tiles);
      return;
    }
    const LensPolygon below = clip(rest, homogeneous(Plane{-normal, -planes[i]}));
    if (!below.empty())
      split(below, region, cuts, axis + 1, tile + i * stride, next_stride, tiles);
    rest = clip(rest, above);
    if (rest.empty())
      return;
  }
  split(std::move(rest), region, cuts, axis + 1, tile + planes.size() * stride, next_stride, tiles);
}

} // namespace

std::size_t tile_count(const TileCuts& cuts) {
  return (cuts.planes[0].size() + 1) * (cuts.planes[1].size() + 1) * (cuts.planes[2].size() + 1);
}

std::vector<LensMesh> split_by_tiles(const LensMesh& mesh, const TileCuts& cuts) {
  std::vector<LensMesh> tiles(tile_count(cuts));
  const std::size_t count = mesh.regions.size();
  for (std::size_t begin = 0; begin < count;) {
    const auto corner = [&](std::size_t triangle, std::size_t c) { return mesh.triangles[3 * triangle + c]; };
    LensPolygon polygon = {mesh.vertices[corner(begin, 0)], mesh.vertices[corner(begin, 1)],
                           mesh.vertices[corner(begin, 2)]};
    std::size_t end = begin + 1;
    while (end < count && corner(end, 0) == corner(begin, 0) && corner(end, 1) == corner(end - 1, 2)) {
      polygon.push_back(mesh.vertices[corner(end, 2)]);
      ++end;
    }
    split(std::move(polygon), mesh.regions[begin], cuts, 0, 0, 1, tiles);
    begin = end;
  }
  return tiles;
}

} // namespace slicelens
