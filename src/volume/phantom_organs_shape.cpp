#include "volume/phantom_organs.h"
#include "volume/phantom_sdf.h"

namespace slicelens::frog {

using glm::dvec3;
using namespace sdf;

namespace {

/// The frog is symmetric but for its gut: most shapes are built on the left side only.
dvec3 mirrored(const dvec3& p) { return {std::abs(p.x), p.y, p.z}; }

double sphere(const dvec3& p, const dvec3& center, double r) { return glm::length(p - center) - r; }

/// Chain of capsules whose radius goes linearly from ra at its first to rb at its last point.
template <std::size_t N>
double chain(const dvec3& p, const dvec3 (&points)[N], double ra, double rb) {
  double d = 1e9;
  for (std::size_t i = 0; i + 1 < N; ++i) {
    const double a = static_cast<double>(i) / (N - 1);
    const double b = static_cast<double>(i + 1) / (N - 1);
    d = std::min(d, capsule(p, points[i], points[i + 1], ra + (rb - ra) * a, ra + (rb - ra) * b));
  }
  return d;
}

// Joints of the limbs, left side.
constexpr dvec3 kHip{9, 36, -3};
constexpr dvec3 kKnee{41, 15, -4};
constexpr dvec3 kAnkle{27, 52, -11};
constexpr dvec3 kHeel{52, 39, -14};
constexpr dvec3 kToes[] = {{58, 22, -16}, {68, 20, -16}, {75, 27, -16}, {75, 37, -16}, {68, 46, -16}};
constexpr dvec3 kShoulder{17, -17, -6};
constexpr dvec3 kElbow{35, -8, -9};
constexpr dvec3 kWrist{35, -32, -14};
constexpr dvec3 kFingers[] = {{26, -42, -16}, {32, -47, -16}, {39, -46, -16}, {45, -39, -16}};

/// Limbs as flesh (thick) or as bones (thin).
double hind_leg(const dvec3& m, bool bones) {
  if (bones) {
    double d = std::min(capsule(m, kHip, kKnee, 1.7), capsule(m, kKnee, kAnkle, 1.6));
    d = std::min(d, capsule(m, kAnkle, kHeel, 1.3));
    d = std::min({d, sphere(m, kHip, 2.4), sphere(m, kKnee, 2.5), sphere(m, kAnkle, 2)});
    for (const dvec3& toe : kToes)
      d = std::min(d, capsule(m, kHeel, toe, 0.9, 0.6));
    return d;
  }
  const dvec3 belly = (kHip + kKnee) * 0.5;
  double d = blend(capsule(m, kHip, kKnee, 8, 6), ellipsoid(m - belly, {11, 10, 8.5}), 8);
  const dvec3 calf = kKnee * 0.62 + kAnkle * 0.38;
  d = blend(d, blend(capsule(m, kKnee, kAnkle, 5, 3.4), sphere(m, calf, 6.6), 6), 3);
  d = blend(d, capsule(m, kAnkle, kHeel, 3.6, 3.2), 2);
  double web = 1e9;
  for (int i = 0; i < 5; ++i) {
    d = blend(d, capsule(m, kHeel, kToes[i], 2.4, 1.4), 1.5);
    d = std::min(d, sphere(m, kToes[i], 1.9));
    if (i < 4) { // skin between the toes, to two thirds of their length
      const dvec3 between = kHeel + ((kToes[i] + kToes[i + 1]) * 0.5 - kHeel) * 0.62;
      web = std::min(web, capsule(m, kHeel, between, 3, 4.2));
    }
  }
  return blend(d, meet(web, std::abs(m.z - (-15.4)) - 1, 0.6), 1);
}

double front_leg(const dvec3& m, bool bones) {
  const double upper = bones ? 1.5 : 5.2;
  const double fore = bones ? 1.3 : 4.2;
  double d = blend(capsule(m, kShoulder, kElbow, upper, bones ? 1.5 : 4),
                   capsule(m, kElbow, kWrist, fore, bones ? 1.2 : 3), bones ? 0.5 : 3);
  for (const dvec3& finger : kFingers) {
    d = blend(d, capsule(m, kWrist, finger, bones ? 0.9 : 2.2, bones ? 0.6 : 1.3), bones ? 0.2 : 1.5);
    if (!bones)
      d = std::min(d, sphere(m, finger, 1.8));
  }
  return d;
}

double skull(const dvec3& p, const dvec3& m) {
  const dvec3 upper[] = {{0, -53, -2}, {10, -49, -2}, {18, -38, -2}, {19.5, -22, -3}};
  const dvec3 lower[] = {{0, -52, -7}, {10, -48, -7}, {17, -38, -7}, {19.5, -23, -4}};
  double d = std::min(chain(m, upper, 1.6, 1.6), chain(m, lower, 1.4, 1.4));
  const double box = ellipsoid(p - dvec3(0, -30, 1.5), {6.2, 14, 5});
  d = std::min(d, meet(box, -(box + 1.3), 0.3));                // braincase, hollow
  d = blend(d, capsule(m, {4, -42, 2}, {10, -49, -2}, 1.2), 1); // around the eyes
  d = blend(d, capsule(m, {5, -25, 2}, {19.5, -22, -3}, 1.4), 1);
  return blend(d, capsule(m, {0, -44, 2}, {0, -53, -1}, 1.5), 1);
}

double spine(const dvec3& p, const dvec3& m) {
  // Nine vertebrae from y = −14 to 18, rising with the back.
  const double pitch = 4;
  const double level = std::clamp(std::round((p.y + 14) / pitch), 0.0, 8.0);
  const double y = -14 + level * pitch;
  const double z = 4 + 0.45 * level;
  const dvec3 q(m.x, m.y - y, m.z - z);
  double d = meet(ellipsoid(q - dvec3(0, 0, -1), {3.2, 3.2, 2.6}), std::abs(q.y) - 1.5, 0.6);
  d = blend(d, capsule(q, {0, 0, 1}, {0, 0.6, 3}, 0.8), 0.6);
  const double reach = level < 1 || level > 7 ? 7 : 5.5;
  d = blend(d, capsule(q, {2, 0, 0}, {reach, 0.5, -0.4}, 0.9, 0.7), 0.6);
  d = std::min(d, capsule(p, {0, 20, 7.4}, {0, 42, 3}, 1.3, 0.9)); // urostyle
  return d;
}

double girdles(const dvec3& m) {
  double d = capsule(m, {6.5, 17, 7}, {5, 38, 0}, 1.3, 1.8);                  // ilium
  d = std::min(d, ellipsoid(m - dvec3(0, 39, -2), {5.5, 3.5, 4}));            // pelvis
  d = std::min(d, capsule(m, kShoulder, {15, -13, 4}, 1.4, 2));               // shoulder blade
  d = std::min(d, capsule(m, kShoulder, {0, -19, -12.5}, 1.3));               // collar bone
  return std::min(d, capsule(m, {0, -22, -12.5}, {0, -10, -13.5}, 1.6, 2.2)); // breastbone
}

double brain_at(const dvec3& p, const dvec3& m) {
  double d = ellipsoid(m - dvec3(1.9, -36, 1.6), {2.2, 5, 2.3});
  d = std::min(d, capsule(m, {1.5, -40, 1.4}, {1.5, -43, 1.2}, 1.2, 0.9)); // olfactory lobes
  d = std::min(d, sphere(m, {2.3, -28.5, 2}, 2.5));                        // optic lobes
  return blend(d, capsule(p, {0, -28, 1}, {0, -19, 3}, 2, 1.5), 0.8);
}

double nerves_at(const dvec3& m) {
  const dvec3 sciatic[] = {{1, 17, 6}, {6, 28, 3}, kHip + dvec3(3, -1, 3), kKnee + dvec3(-3, -1, 3.4)};
  double d = capsule(m, {0, -19, 4.2}, {0, 19, 8}, 1.25, 0.9); // spinal cord
  d = std::min(d, chain(m, sciatic, 0.9, 0.7));
  const dvec3 brachial[] = {{1, -12, 4}, {9, -14, 2}, kShoulder + dvec3(1, 1, 2.5)};
  d = std::min(d, chain(m, brachial, 0.8, 0.6));
  return std::min(d, capsule(m, {2, -36, 1}, kEyeCenter, 0.9)); // optic nerve
}

double heart_at(const dvec3& p, const dvec3& m) {
  double d = blend(capsule(p, {0, -10, -9}, {0, -5.5, -11}, 4.2, 1.8), sphere(m, {2.6, -13.5, -7}, 3.1), 1.2);
  return blend(d, capsule(p, {-0.5, -13, -9}, {-1.5, -17, -8}, 1.8, 1.5), 1);
}

double vessels_at(const dvec3& p, const dvec3& m) {
  const dvec3 arch[] = {{0.5, -16, -8}, {6, -19, -5}, {8.5, -14, 0}, {6, -6, 3}, {0, 3, 3.6}};
  double d = chain(m, arch, 1.4, 1.3);
  const dvec3 aorta[] = {{0, 3, 3.6}, {0, 20, 3.4}, {0, 34, 0}};
  d = std::min(d, chain(p, aorta, 1.5, 1.2));
  const dvec3 iliac[] = {{0, 34, 0}, kHip + dvec3(0, -3, 0), kKnee + dvec3(-4, 3, 0)};
  d = std::min(d, chain(m, iliac, 1.1, 0.7));
  const dvec3 cava[] = {{-1, 22, 0}, {-2, 8, -3}, {-1.5, -3, -6}, {-1, -11, -7}};
  d = std::min(d, chain(p, cava, 1.3, 1.5));
  const dvec3 carotid[] = {{6, -19, -5}, {7, -27, -3}, {6, -38, -3}};
  return std::min(d, chain(m, carotid, 0.9, 0.6));
}

double liver_at(const dvec3& p) {
  double d = ellipsoid(p - dvec3(-9.5, 1.5, -8.5), {8.5, 10, 5});
  d = blend(d, ellipsoid(p - dvec3(9.5, 0, -9), {8, 9, 4.6}), 2);
  d = blend(d, ellipsoid(p - dvec3(1, -1, -9), {6, 5, 3.4}), 3);
  return cut(d, capsule(p, {0, 12, -9}, {-1, 2, -9}, 2.2, 0.8), 1.5); // the notch between the lobes
}

double stomach_at(const dvec3& p) {
  const dvec3 gullet[] = {{0, -22, -4}, {2, -14, -2}, {6, -6, -1}};
  const dvec3 body[] = {{6, -6, -1}, {12, 3, -2}, {14, 11, -4}, {11, 17, -5}, {6, 19, -6}};
  return blend(chain(p, gullet, 1.6, 2.4),
               blend(chain(p, body, 2.4, 2.2), ellipsoid(p - dvec3(13, 7, -3), {4.6, 9, 4.4}), 4), 2);
}

double small_intestine_at(const dvec3& p) {
  const dvec3 coil[] = {{6, 19, -6},    {1, 22, -8},    {-6, 21, -9},    {-12, 16, -7}, {-14, 20, -5},
                        {-10, 25, -7},  {-3, 26, -8},   {4, 24, -9.5},   {10, 25, -8},  {12, 20, -9},
                        {7, 16.5, -11}, {1, 16, -11.5}, {-6, 15, -11.5}, {-8, 20, -12}, {-3, 22, -12.5},
                        {3, 21, -12.5}, {5, 26, -11.5}, {2, 30, -8}};
  return chain(p, coil, 2, 1.7);
}

double fat_at(const dvec3& m) {
  const dvec3 root(5, 9, 2);
  double d = capsule(m, root, {12, 4, 1.5}, 1.4, 1);
  d = std::min(d, capsule(m, root, {15, 8, 1}, 1.4, 1));
  d = std::min(d, capsule(m, root, {15.5, 13, 0}, 1.4, 1));
  return std::min(d, capsule(m, root, {12.5, 17, 0}, 1.4, 1));
}

} // namespace

double surface(const dvec3& p) {
  const dvec3 m = mirrored(p);
  double d = ellipsoid(p - dvec3(0, 6, -4), {24, 37, 14});
  d = blend(d, ellipsoid(p - dvec3(0, 22, 2), {15, 22, 11}), 10);    // the hump of the back
  d = blend(d, ellipsoid(p - dvec3(0, -28, -3), {22, 20, 9.5}), 12); // head
  d = blend(d, ellipsoid(p - dvec3(0, -43, -3.5), {13, 14, 7}), 9);  // snout
  d = blend(d, sphere(m, kEyeCenter, 7.4), 3);
  if (p.y < -20) {
    d = cut(d, capsule(m, {0, -60, -4.6}, {19, -46, -4.6}, 0.7), 0.5); // mouth
    d = cut(d, capsule(m, {19, -46, -4.6}, {25, -24, -4.2}, 0.7), 0.5);
    d = cut(d, sphere(m, {4.5, -55, 0.6}, 1), 0.6);                  // nostril
    d = cut(d, sphere(m, kEyeCenter + dvec3(9, -7.3, 4), 5.5), 1.2); // flat where the pupil is
  }
  d = blend(d, meet(sphere(m, {20.5, -22, 1}, 4), std::abs(m.x - 20) - 3, 1), 1.5); // eardrum
  d = blend(d, hind_leg(m, false), 3);
  return blend(d, front_leg(m, false), 3.5);
}

double distance(Organ organ, const dvec3& p) {
  const dvec3 m = mirrored(p);
  switch (organ) {
  case skeleton:
    return std::min({skull(p, m), spine(p, m), girdles(m), hind_leg(m, true), front_leg(m, true)});
  case eye:
    return sphere(m, kEyeCenter, kEyeRadius);
  case lens:
    return sphere(m, kLensCenter, kLensRadius);
  case brain:
    return brain_at(p, m);
  case nerves:
    return nerves_at(m);
  case lung:
    return ellipsoid(m - dvec3(13, 1, -0.5), {5.6, 14, 5.6});
  case heart:
    return heart_at(p, m);
  case vessels:
    return vessels_at(p, m);
  case liver:
    return liver_at(p);
  case gall_bladder:
    return sphere(p, kGallCenter, kGallRadius);
  case stomach:
    return stomach_at(p);
  case small_intestine:
    return small_intestine_at(p);
  case large_intestine:
    return capsule(p, {2, 29.5, -6}, {0, 41, -3}, 3.6, 2.8);
  case spleen:
    return sphere(p, kSpleenCenter, kSpleenRadius);
  case kidney:
    return ellipsoid(m - kKidneyCenter, kKidneyRadii);
  case fat_body:
    return fat_at(m);
  case bladder:
    return ellipsoid(p - kBladderCenter, kBladderRadii);
  case skin:
  case muscle:
  case organ_count:
    break;
  }
  return 1e9;
}

} // namespace slicelens::frog
