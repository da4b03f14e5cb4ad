// Inside src/volume only: the anatomy shared by `head` and `head-mr`. Positions in millimetres from the box
// centre, LPS: +x the patient's left, +y back, +z up. The shapes are this project's own, set to the usual
// sizes of an adult head (breadth 160, length 198 mm), not to any one scan. Signed distances, negative
// inside.
#pragma once

#include <glm/glm.hpp>

#include <vector>

namespace slicelens::head {

/// The intracranial space, without the spinal canal.
double cavity(const glm::dvec3& p);

/// The spinal canal from the foramen magnum down.
double spinal_canal(const glm::dvec3& p);

/// The skin's outer surface with nose, lips, lids and ears.
double skin(const glm::dvec3& p);

/// Skull, jaw and neck vertebrae, before the air spaces, orbits and the cavity are taken out; `intracranial`
/// is cavity(p). Not yet limited to the inside of the skin.
double bone(const glm::dvec3& p, double intracranial);

/// The orbits' cones.
double orbit(const glm::dvec3& p);

double tooth(const glm::dvec3& p);

/// Air inside the head: nasal passages with septum and turbinates, sinuses, throat, ear canals; `surface` is
/// skin(p).
double airways(const glm::dvec3& p, double surface);

double eyeball(const glm::dvec3& p);
double eye_lens(const glm::dvec3& p);
/// Optic nerve and eye muscles.
double orbital_muscle(const glm::dvec3& p);

double ventricles(const glm::dvec3& p);
double deep_grey(const glm::dvec3& p);

/// A piece of an artery.
struct Vessel {
  glm::dvec3 a{0};
  glm::dvec3 b{0};
  double ra = 1;
  double rb = 1;
};

/// Centre and radius of the aneurysm, on the left internal carotid's bifurcation above the skull base.
constexpr glm::dvec3 kAneurysmCenter{21, -19, 16};
constexpr double kAneurysmRadius = 8;

/// Carotid and vertebral arteries, the circle of Willis, its branches over the brain and the aneurysm (a
/// vessel of zero length). Made anew on every call, always the same.
std::vector<Vessel> arteries();

} // namespace slicelens::head
