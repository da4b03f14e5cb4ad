#include "volume/phantom_head.h"
#include "volume/phantom_sdf.h"

namespace slicelens::head {

using glm::dvec2;
using glm::dvec3;
using namespace sdf;

namespace {

/// The head is symmetric but for its arteries: most shapes are built on the left side only.
dvec3 mirrored(const dvec3& p) { return {std::abs(p.x), p.y, p.z}; }

double sphere(const dvec3& p, const dvec3& center, double r) { return glm::length(p - center) - r; }

/// Distance to a chain of capsules of one radius.
template <std::size_t N>
double chain(const dvec3& p, const dvec3 (&points)[N], double r) {
  double d = 1e9;
  for (std::size_t i = 0; i + 1 < N; ++i)
    d = std::min(d, capsule(p, points[i], points[i + 1], r));
  return d;
}

constexpr double kEarScale = 0.88;

double ear(const dvec3& m) {
  // Ear frame: u across the ear's plate, v backward, w upward; the plate stands off by 25° and leans back.
  const dvec3 q = (m - dvec3(78, 17, -3)) / kEarScale;
  if (glm::dot(q, q) > 60 * 60)
    return (glm::length(q) - 40) * kEarScale;
  const double u = 0.906 * q.x - 0.423 * q.y;
  const double v0 = 0.423 * q.x + 0.906 * q.y;
  const double v = 0.97 * v0 - 0.24 * q.z;
  const double w = 0.24 * v0 + 0.97 * q.z;
  const double narrow = 17 + 0.12 * w; // the lobe is narrower than the top
  const double rim = (glm::length(dvec2(v / narrow, w / 30)) - 1) * 17;
  const double plate = meet(std::abs(u) - 2.2, rim, 2);
  const double helix = glm::length(dvec2(rim + 1.5, u - 2)) - 3;
  const double antihelix = glm::length(dvec2(rim + 8.5, u - 1.5)) - 2.2;
  const double behind_front = -8 - v; // the inner folds stop short of the cheek
  double d = blend(plate, helix, 3);
  d = blend(d, std::max(antihelix, behind_front), 2);
  d = blend(d, glm::length(q - dvec3(-1, -12, -4)) - 4.5, 4); // tragus
  return d * kEarScale;
}

double lids_and_eye(double face, const dvec3& m) {
  const dvec3 q = m - dvec3(33, -71.5, 4);
  if (glm::dot(q, q) > 40 * 40)
    return face;
  double d = cut(face, sphere(m, dvec3(31, -99, 6), 17), 9);
  // The lids are a shell over the eyeball with an almond-shaped opening.
  const double shell = glm::length(q) - 14.2;
  const double across = (m.x - 33) / 12.5;
  const double opening = std::abs(m.z - 3.6) - 4.2 * (1 - across * across);
  d = blend(d, shell, 5);
  d = cut(d, std::max(opening, m.y + 72), 1.5);
  return std::min(d, glm::length(q) - 12.3);
}

double nose(const dvec3& m) {
  double d = capsule(m, {0, -88, 14}, {0, -111, -19}, 5.5, 8);
  d = blend(d, sphere(m, {8.5, -101, -24}, 7), 5);
  d = blend(d, capsule(m, {0, -112, -21}, {0, -98, -30}, 5, 4), 4);
  return d;
}

double lips(const dvec3& m) {
  const double upper = capsule(m, {3, -95, -54}, {19, -87, -58.5}, 5, 2.5);
  const double lower = capsule(m, {0, -93.5, -64}, {17, -86.5, -60.5}, 5.5, 2.5);
  return std::min(upper, lower);
}

} // namespace

double cavity(const dvec3& p) {
  const dvec3 m = mirrored(p);
  // An egg from above: narrower at the forehead than at the parietal bones.
  double cerebrum = blend(ellipsoid(p - dvec3(0, -12, 36), {57, 64, 64}),
                          ellipsoid(p - dvec3(0, 24, 36), {67, 68, 69}), 24);
  if (cerebrum > 40)
    return cerebrum;
  cerebrum = meet(cerebrum, 12 - 0.05 * p.y - p.z, 12); // the floor of the anterior fossa
  const double temporal = ellipsoid(m - dvec3(37, -6, 8), {25, 34, 23});
  const double posterior = ellipsoid(p - dvec3(0, 50, -2), {50, 38, 32});
  return blend(blend(cerebrum, temporal, 7), posterior, 9);
}

double spinal_canal(const dvec3& p) {
  return std::min(capsule(p, {0, 22, 6}, {0, 32, -48}, 11, 9), capsule(p, {0, 32, -48}, {0, 34, -200}, 9));
}

double skin(const dvec3& p) {
  const dvec3 m = mirrored(p);
  const double cranium = blend(ellipsoid(p - dvec3(0, -12, 36), {70, 77, 78}),
                               ellipsoid(p - dvec3(0, 24, 36), {80, 81, 83}), 24);
  if (p.z > 60)
    return cranium;
  double d = ellipsoid(p - dvec3(0, -34, -32), {61, 58, 64});
  d = blend(d, ellipsoid(p - dvec3(0, -48, -80), {45, 41, 29}), 14);
  d = blend(d, ellipsoid(m - dvec3(46, -26, -44), {17, 34, 38}), 14); // masseter and the side of the jaw
  d = blend(d, ellipsoid(m - dvec3(50, -20, -12), {21, 42, 24}), 12); // over the zygomatic arch
  d = blend(d, ellipsoid(p - dvec3(0, 46, -4), {64, 52, 44}), 14);    // nape
  d = blend(d, ellipsoid(p - dvec3(0, -85, -95), {17, 13, 13}), 12);  // chin
  d = blend(d, ellipsoid(m - dvec3(46, -58, -15), {19, 20, 18}), 12); // cheekbone
  d = blend(d, capsule(m, {8, -86, 22}, {37, -75, 22}, 6), 10);       // brow
  d = blend(d, cranium, 16);
  d = blend(d, capsule(p * dvec3(1, 0.97, 1), {0, 14, -40}, {0, 30, -200}, 55), 22); // neck
  if (p.y < -40)
    d = lids_and_eye(d, m);
  if (p.y < -60) {
    d = blend(d, nose(m), 8);
    d = cut(d, ellipsoid(p - dvec3(0, -104, -46), {3.5, 8, 8}), 4); // philtrum
    d = blend(d, lips(m), 4);
    d = cut(d, box(p - dvec3(0, -99, -59.5), {19, 9, 0.8}, 0.8), 2);
    d = cut(d, ellipsoid(p - dvec3(0, -103, -76), {22, 9, 6}), 8); // below the lower lip
  }
  return blend(d, ear(m), 5);
}

namespace {

double face_bone(const dvec3& m) {
  double d = ellipsoid(m - dvec3(0, -56, -20), {38, 29, 34});
  d = blend(d, ellipsoid(m - dvec3(0, -20, -16), {34, 26, 18}), 8); // sphenoid and pterygoid
  d = blend(d, capsule(m, {0, -76, 21}, {36, -68, 22}, 8.5), 6);    // supraorbital bar
  d = blend(d, capsule(m, {36, -71, 22}, {52, -60, 12}, 6.5, 5), 5);
  d = blend(d, capsule(m, {52, -60, 12}, {49, -63, -12}, 5), 5);  // lateral orbital rim
  d = blend(d, capsule(m, {49, -63, -14}, {24, -78, -18}, 6), 6); // lower orbital rim
  d = blend(d, ellipsoid(m - dvec3(45, -62, -18), {12, 11, 10}), 6);
  const dvec3 arch[] = {{50, -60, -17}, {61, -40, -15}, {66, -18, -13}, {66, 2, -11}};
  d = blend(d, chain(m, arch, 3.8), 4);
  d = blend(d, capsule(m, {0, -83, 15}, {0, -97, -5}, 5.5, 4.5), 4); // nasal bones
  const dvec3 alveolar[] = {{0, -82, -46}, {19, -75, -46}, {31, -61, -45}, {36, -46, -42}};
  d = blend(d, chain(m, alveolar, 6), 6);
  return blend(d, ellipsoid(m - dvec3(58, 22, -26), {10, 13, 18}), 6); // mastoid
}

double mandible(const dvec3& m) {
  // Flattened tubes: distances in a stretched space, so shorter than true by the stretch, which is undone
  // along the thin direction, where it matters.
  const dvec3 squeeze(1, 1, 0.6);
  const dvec3 body[] = {dvec3(0, -80, -91) * squeeze, dvec3(18, -74, -91) * squeeze,
                        dvec3(32, -58, -87) * squeeze, dvec3(46, -30, -79) * squeeze};
  double d = chain(m * squeeze, body, 6.2);
  d = blend(d, ellipsoid(m - dvec3(0, -85, -98), {15, 7, 6}), 5);
  const dvec3 flatten(1.8, 1, 1);
  const double ramus =
      capsule(m * flatten, dvec3(47, -24, -76) * flatten, dvec3(51, -12, -36) * flatten, 13, 9) / 1.8;
  d = blend(d, ramus, 5);
  d = blend(d, capsule(m, {51, -8, -38}, {54, -1, -21}, 4.5, 5.5), 4);
  return blend(d, capsule(m, {50, -20, -40}, {50, -24, -24}, 4, 3), 4);
}

/// Neck vertebrae, repeated every 17 mm.
double vertebrae(const dvec3& m) {
  if (m.z > -36)
    return 1e3;
  const double pitch = 17;
  const double level = std::max(0.0, std::round((-50 - m.z) / pitch));
  const dvec3 q(m.x, m.y - 33, m.z + 50 + level * pitch);
  const double height = std::abs(q.z);
  const double body = meet((glm::length(dvec2(q.x / 13, (q.y + 18) / 9.5)) - 1) * 9.5, height - 7, 3);
  const double ring = meet(std::abs(glm::length(dvec2(q.x, q.y)) - 12.5) - 3, height - 5.5, 3);
  const double side = capsule(q, {12, -9, 0}, {26, -5, -2}, 4, 3.5);
  const double spine = capsule(q, {0, 14, -1}, {0, 30, -6}, 3.2, 3.8);
  return blend(blend(body, ring, 3), std::min(side, spine), 3);
}

} // namespace

double bone(const dvec3& p, double intracranial) {
  const dvec3 m = mirrored(p);
  // The vault: a shell about the cavity, thinner at the temples.
  const double temple = std::clamp((m.x - 45) / 20, 0.0, 1.0) * std::clamp((40 - p.z) / 40, 0.0, 1.0);
  const double shell = intracranial - (7 - 2.2 * temple);
  if (p.z > 50)
    return shell;
  double d = blend(shell, face_bone(m), 5);
  if (p.z < -10)
    d = std::min({d, mandible(m), vertebrae(m)});
  return d;
}

double orbit(const dvec3& p) {
  if (p.y > -25)
    return 1e3;
  const dvec3 m = mirrored(p);
  const dvec3 q = (m - dvec3(0, 0, 4)) * dvec3(1, 1, 1.08); // a little wider than high
  return std::min(capsule(q, {34, -80, 0}, {15, -34, 1}, 18.5, 4),
                  capsule(q, {36, -110, -1}, {34, -80, 0}, 19.5, 18.5));
}

double tooth(const dvec3& p) {
  if (p.z < -88 || p.z > -40 || p.y > -40)
    return 1e3;
  const dvec3 m = mirrored(p);
  // Positions along the dental arch, y = −82.5 + x²/38, from the incisors to the second molar; half-widths.
  constexpr double x[] = {4, 11.5, 18, 24, 29, 33.5, 37};
  constexpr double half_width[] = {3.9, 3.5, 3.7, 3.7, 3.8, 4.6, 4.6};
  double d = 1e3;
  for (int i = 0; i < 7; ++i) {
    const double y = -82.5 + x[i] * x[i] / 38;
    const bool molar = i > 2;
    const dvec3 r(half_width[i], molar ? 4.4 : 3.1, 10.5);
    d = std::min(d, ellipsoid(m - dvec3(x[i], y - 1, -54), r));
    d = std::min(d, ellipsoid(m - dvec3(x[i] * 0.95, y + 1, -73.5), r));
  }
  // Crowns meet in a flat bite.
  return std::max(d, 0.6 - std::abs(p.z + 63.5));
}

namespace {

double nasal_passage(const dvec3& p, const dvec3& m) {
  // Pear-shaped in the frontal plane, the same from the aperture to the throat.
  const double pear = capsule(dvec3(p.x, p.z, 0), {0, 2, 0}, {0, -25, 0}, 4, 11);
  double d = meet(pear, std::abs(p.y + 61) - 33, 5);
  d = cut(d, std::abs(p.x) - 0.9, 1);                               // septum
  d = cut(d, capsule(m, {9, -80, -27}, {9, -38, -27}, 3.6), 1);     // lower turbinate
  d = cut(d, capsule(m, {6.5, -76, -13}, {6.5, -38, -13}, 2.4), 1); // middle turbinate
  return d;
}

} // namespace

double airways(const dvec3& p, double surface) {
  if (p.z > 40)
    return 1e3;
  const dvec3 m = mirrored(p);
  double d = nasal_passage(p, m);
  d = std::min(d, ellipsoid(m - dvec3(26, -57, -22), {11, 16, 13}));  // maxillary sinus
  d = std::min(d, ellipsoid(m - dvec3(10, -77, 22), {8, 3, 6}));      // frontal sinus
  d = std::min(d, ellipsoid(m - dvec3(7.5, -21, -11), {6.5, 10, 8})); // sphenoid sinus
  for (const double y : {-68.0, -56.0, -44.0})                        // ethmoid cells
    d = std::min(d, ellipsoid(m - dvec3(6.5, y, 5), {4.2, 5.2, 5.5}));
  for (const double z : {-34.0, -26.0, -18.0}) // mastoid cells
    d = std::min(d, sphere(m, {58, 22, z}, 2.8));
  d = meet(d, surface + 3.5, 2);                                      // no wall thinner than that
  d = std::min(d, capsule(m, {6, -108, -36}, {6, -94, -22}, 3.2, 4)); // nostrils
  const dvec3 throat[] = {{0, -30, -26}, {0, -13, -48}, {0, -9, -84}, {0, -14, -200}};
  d = std::min(d, chain(p, throat, 7));
  return std::min(d, capsule(m, {90, 9, -5}, {56, 13, -6}, 3.2)); // ear canal
}

double eyeball(const dvec3& p) { return sphere(mirrored(p), {33, -71.5, 4}, 12.2); }

double eye_lens(const dvec3& p) { return ellipsoid(mirrored(p) - dvec3(33, -79.5, 4), {4.6, 2.2, 4.6}); }

double orbital_muscle(const dvec3& p) {
  const dvec3 m = mirrored(p);
  const dvec3 apex(15, -36, 4);
  double d = capsule(m, {31, -60, 4}, apex, 2.4);
  for (const dvec3& end : {dvec3(33, -70, 17), dvec3(33, -70, -9), dvec3(20, -70, 4), dvec3(46, -68, 4)})
    d = std::min(d, capsule(m, end, apex, 1.8));
  return d;
}

double ventricles(const dvec3& p) {
  const dvec3 m = mirrored(p);
  const dvec3 lateral[] = {{9, -26, 36}, {10, 0, 42}, {13, 24, 40}, {22, 44, 28}, {30, 34, 12}, {34, 8, 4}};
  double d = chain(m, lateral, 4.6);
  d = blend(d, capsule(m, {25, 44, 26}, {16, 68, 24}, 4, 2), 4);    // posterior horn
  d = std::min(d, ellipsoid(p - dvec3(0, 8, 22), {2.2, 14, 10}));   // third ventricle
  d = std::min(d, capsule(p, {0, 20, 14}, {0, 34, -4}, 1.4));       // aqueduct
  return std::min(d, ellipsoid(p - dvec3(0, 37, -8), {7, 4.5, 9})); // fourth ventricle
}

double deep_grey(const dvec3& p) {
  const dvec3 m = mirrored(p);
  const double thalamus = ellipsoid(m - dvec3(10, 12, 24), {7.5, 14, 9});
  const double putamen = ellipsoid(m - dvec3(26, -4, 24), {5, 17, 11});
  const double caudate = capsule(m, {12, -20, 29}, {17, 14, 40}, 6, 3);
  return std::min({thalamus, putamen, caudate});
}

} // namespace slicelens::head
