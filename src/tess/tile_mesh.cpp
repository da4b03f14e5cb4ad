#include "tess/tile_mesh.h"

#include "tess/homogeneous.h"

#include <cmath>
#include <tuple>

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

/// A polygon's two sides of a boundary.
struct Halves {
  LensPolygon below;
  LensPolygon above;
};

/// Where the edge crosses the boundary, computed from the same end whichever way round the polygon goes, so
/// that neighbours get the same corner.
LensVertex crossing(const LensVertex& a, const LensVertex& b, double va, double vb) {
  if (std::tie(b.position.x, b.position.y, b.position.z) < std::tie(a.position.x, a.position.y, a.position.z))
    return crossing(b, a, vb, va);
  const double x = va / (va - vb);
  return {glm::mix(a.position, b.position, x), glm::mix(a.texture, b.texture, x)};
}

/// Corners nearer to the boundary than rounding can tell (texture coordinates) are on it: a slice that lies
/// in a boundary would else be cut to pieces by noise.
constexpr double on_boundary = 1e-12;

/// Cuts at texture coordinate `c` of `axis`: S − c·q < 0 below.
Halves cut(const LensPolygon& polygon, int axis, double c) {
  std::vector<double> values;
  bool some_below = false;
  bool some_above = false;
  for (const LensVertex& vertex : polygon) {
    const double value = vertex.texture[axis] - c * vertex.texture.w;
    values.push_back(std::abs(value) <= on_boundary * vertex.texture.w ? 0 : value);
    some_below = some_below || values.back() < 0;
    some_above = some_above || values.back() > 0;
  }
  if (!some_below)
    return {{}, polygon};
  if (!some_above)
    return {polygon, {}};
  Halves halves;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const std::size_t next = (i + 1) % polygon.size();
    if (values[i] <= 0)
      halves.below.push_back(polygon[i]);
    if (values[i] >= 0)
      halves.above.push_back(polygon[i]);
    if ((values[i] < 0 && values[next] > 0) || (values[i] > 0 && values[next] < 0)) {
      const LensVertex corner = crossing(polygon[i], polygon[next], values[i], values[next]);
      halves.below.push_back(corner);
      halves.above.push_back(corner);
    }
  }
  return halves;
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
  for (std::size_t i = 0; i < planes.size() && rest.size() >= 3; ++i) {
    Halves halves = cut(rest, static_cast<int>(axis), planes[i]);
    if (halves.below.size() >= 3)
      split(std::move(halves.below), region, cuts, axis + 1, tile + i * stride, next_stride, tiles);
    rest = std::move(halves.above);
  }
  if (rest.size() >= 3)
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
