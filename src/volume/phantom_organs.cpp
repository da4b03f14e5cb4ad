// `organs` and `organs-labels`: one animal (phantom_organs.h), as values and as numbers of its organs.
#include "volume/phantom_organs.h"

#include "volume/phantom.h"
#include "volume/phantom_rows.h"
#include "volume/phantom_sdf.h"

#include <array>

namespace slicelens {

namespace {

using glm::dvec3;
using namespace frog;

/// Order in which organs are painted: where two overlap the later one counts.
constexpr Organ kOrder[] = {lung,   liver,        stomach, small_intestine, large_intestine, fat_body, kidney,
                            spleen, gall_bladder, bladder, vessels,         heart,           skeleton, brain,
                            nerves, eye,          lens};

/// Calls paint(label, distance) for what may lie within a width w of p, in the order of painting.
template <class Paint>
void visit(const dvec3& p, double w, Paint paint) {
  const double outside = frog::surface(p);
  if (outside > w)
    return;
  paint(skin, outside);
  const double flesh = outside + kSkinThickness;
  if (flesh > w)
    return;
  paint(muscle, flesh);
  // The trunk's organs lie near the middle; bones, vessels and nerves reach into the limbs.
  const bool trunk = std::abs(p.x) < 24;
  for (const Organ organ : kOrder) {
    if (trunk || organ == skeleton || organ == vessels || organ == nerves)
      paint(organ, std::max(frog::distance(organ, p), flesh));
  }
}

/// Calls value(p, w) along a row.
template <class Value>
PhantomRows organ_rows_of(Value value) {
  return [value](const PhantomGrid& grid, std::size_t j, std::size_t k, std::span<double> row) {
    const double w = 1.2 * std::max({grid.spacing(0), grid.spacing(1), grid.spacing(2)});
    dvec3 p = (dvec3(0, grid.texture(1, j), grid.texture(2, k)) - 0.5) * grid.edges;
    for (std::size_t i = 0; i < row.size(); ++i) {
      p.x = (grid.texture(0, i) - 0.5) * grid.edges.x;
      row[i] = value(p, w);
    }
  };
}

} // namespace

const std::vector<OrganInfo>& organs() {
  // The harder a tissue the larger its value, so that borders pass through values that look like both sides.
  static const std::vector<OrganInfo> list = {{0, "air", 0},
                                              {skin, "skin", 30},
                                              {muscle, "muscle", 40},
                                              {skeleton, "skeleton", 230},
                                              {eye, "eye", 80},
                                              {lens, "lens of the eye", 200},
                                              {brain, "brain", 100},
                                              {nerves, "spinal cord and nerves", 170},
                                              {lung, "lung", 12},
                                              {heart, "heart", 140},
                                              {vessels, "blood vessels", 155},
                                              {liver, "liver", 110},
                                              {gall_bladder, "gall bladder", 70},
                                              {stomach, "stomach", 165},
                                              {small_intestine, "small intestine", 180},
                                              {large_intestine, "large intestine", 190},
                                              {spleen, "spleen", 130},
                                              {kidney, "kidney", 120},
                                              {fat_body, "fat body", 60},
                                              {bladder, "urinary bladder", 90}};
  return list;
}

PhantomRows organ_rows() {
  std::array<double, organ_count> values{};
  for (const OrganInfo& info : organs())
    values[static_cast<std::size_t>(info.label)] = info.value;
  return organ_rows_of([values](const dvec3& p, double w) {
    double v = values[0];
    visit(p, w, [&](Organ organ, double d) {
      sdf::put(v, values[static_cast<std::size_t>(organ)], sdf::inside(d, w));
    });
    return v;
  });
}

PhantomRows organ_label_rows() {
  return organ_rows_of([](const dvec3& p, double) {
    double label = 0;
    visit(p, 0, [&](Organ organ, double d) {
      if (d < 0)
        label = organ;
    });
    return label;
  });
}

} // namespace slicelens
