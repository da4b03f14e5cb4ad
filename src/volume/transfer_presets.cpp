// The presets. Names are those of 3D Slicer's volume rendering module, so that its users find what they
// expect; the values are this project's own, set from the radiodensity of tissues in Hounsfield units:
//   air −1000, aerated lung −900…−500, fat −120…−60, water 0, brain 20…45, muscle 40…70, clotted blood 50…90,
//   vessels with contrast agent 150…450, spongy bone 150…500, cortical bone 700…2000, enamel 2000…3000.
// Opacity is per h, the smallest voxel spacing: at 0.5 a surface hides what lies three or four voxels behind
// it (1 − 0.5⁴ = 0.94).
#include "core/errors.h"
#include "core/text.h"
#include "volume/phantom.h"
#include "volume/transfer.h"

#include <algorithm>

namespace slicelens {

namespace {

struct Preset {
  PresetInfo info;
  std::vector<TransferPoint> points; ///< values in HU, or fractions of the data's range for relative presets
};

/// Bones in ivory, without anything around them.
std::vector<Preset> bone_presets() {
  return {
      {{"CT-Bone", "bone surfaces from 200 HU on, ivory", false},
       {{150, .55, .30, .20, 0},
        {260, .78, .58, .42, .12},
        {450, .91, .82, .68, .55},
        {1000, .98, .95, .88, .9},
        {2000, 1, 1, 1, .95}}},
      {{"CT-Bones", "spongy and cortical bone told apart by colour", false},
       {{140, .62, .20, .12, 0},
        {240, .75, .35, .20, .06},
        {450, .90, .65, .40, .28},
        {800, .95, .88, .74, .65},
        {1600, 1, .99, .96, .9}}},
      {{"CT-Cropped-Volume-Bone", "dense bone with a faint trace of soft tissue, for cropped volumes", false},
       {{-50, .55, .25, .20, 0},
        {50, .65, .32, .25, .012},
        {180, .70, .40, .30, .012},
        {350, .88, .76, .60, .35},
        {900, .97, .93, .85, .85},
        {2000, 1, 1, 1, .95}}},
      {{"CT-AAA", "abdominal aorta with contrast agent, bone behind it", false},
       {{110, .45, .05, .05, 0},
        {170, .70, .12, .08, .25},
        {330, .86, .25, .16, .5},
        {480, .90, .55, .38, .5},
        {800, .95, .88, .76, .7},
        {1800, 1, 1, 1, .9}}},
      {{"CT-AAA2", "aorta and bone over translucent muscle", false},
       {{20, .40, .10, .10, 0},
        {60, .55, .18, .15, .015},
        {120, .60, .15, .12, .03},
        {190, .80, .20, .12, .35},
        {340, .90, .40, .25, .55},
        {800, .96, .90, .80, .75}}},
      {{"CT-Cardiac", "heart muscle translucent, chambers and vessels with contrast agent dense", false},
       {{30, .30, .05, .05, 0},
        {90, .50, .12, .10, .04},
        {160, .65, .18, .12, .15},
        {280, .85, .35, .22, .45},
        {450, .95, .70, .50, .55},
        {1000, 1, .96, .90, .8}}},
      {{"CT-Cardiac2", "heart surfaces, opaque", false},
       {{40, .35, .08, .08, 0},
        {110, .58, .16, .12, .3},
        {250, .80, .32, .22, .7},
        {450, .93, .70, .52, .85},
        {1000, 1, .97, .92, .95}}},
      {{"CT-Cardiac3", "contrast-filled chambers only", false},
       {{150, .50, .08, .05, 0}, {220, .74, .20, .12, .2}, {380, .92, .50, .30, .5}, {700, 1, .90, .78, .7}}},
      {{"CT-Chest-Contrast-Enhanced", "chest: skin trace, vessels and heart, bone", false},
       {{-400, .80, .60, .50, 0},
        {-250, .85, .65, .52, .006},
        {-20, .70, .40, .30, .004},
        {100, .62, .18, .14, .02},
        {180, .78, .20, .13, .25},
        {350, .90, .45, .30, .45},
        {700, .97, .92, .82, .7}}},
      {{"CT-Chest-Vessels", "lung and mediastinal vessels", false},
       {{-550, .35, .12, .20, 0},
        {-400, .55, .18, .22, .05},
        {-100, .66, .20, .20, .08},
        {60, .70, .16, .13, .12},
        {200, .84, .26, .16, .4},
        {500, .96, .80, .64, .6}}},
      {{"CT-Coronary-Arteries", "coronary arteries over a faint heart", false},
       {{90, .45, .10, .08, 0},
        {160, .62, .16, .10, .06},
        {260, .85, .35, .20, .4},
        {400, .96, .66, .42, .7},
        {900, 1, .97, .92, .85}}},
      {{"CT-Coronary-Arteries-2", "coronary arteries and chambers, dense", false},
       {{120, .40, .06, .06, 0},
        {190, .72, .18, .12, .35},
        {320, .90, .48, .30, .7},
        {600, .98, .86, .70, .85}}},
      {{"CT-Coronary-Arteries-3", "the brightest contrast only", false},
       {{200, .55, .10, .06, 0},
        {300, .86, .34, .18, .3},
        {450, .97, .72, .48, .65},
        {900, 1, .98, .94, .8}}},
  };
}

std::vector<Preset> soft_tissue_presets() {
  return {
      {{"CT-Fat", "fat between air and water", false},
       {{-220, .85, .70, .30, 0},
        {-150, .93, .80, .42, .10},
        {-90, .98, .88, .52, .25},
        {-40, .96, .80, .50, .08},
        {0, .80, .50, .35, 0}}},
      {{"CT-Liver-Vasculature", "liver vessels with contrast agent in a translucent liver", false},
       {{40, .35, .15, .12, 0},
        {90, .50, .22, .16, .015},
        {140, .60, .25, .18, .04},
        {190, .82, .26, .18, .35},
        {300, .92, .55, .38, .6},
        {800, .98, .93, .85, .8}}},
      {{"CT-Lung", "aerated lung, airways and their walls", false},
       {{-980, .20, .30, .55, 0},
        {-900, .35, .50, .75, .01},
        {-750, .55, .70, .88, .03},
        {-550, .85, .72, .70, .07},
        {-350, .85, .45, .40, .10},
        {-200, .75, .35, .30, .02},
        {-100, .70, .30, .25, 0}}},
      {{"CT-Muscle", "skin and muscle surfaces with bone showing through", false},
       {{-300, .80, .58, .45, 0},
        {-160, .86, .64, .50, .03},
        {-30, .84, .58, .44, .06},
        {25, .68, .26, .20, .12},
        {75, .74, .30, .23, .22},
        {160, .78, .42, .32, .15},
        {320, .92, .80, .64, .45},
        {1000, .98, .95, .88, .9}}},
      {{"CT-Pulmonary-Arteries", "pulmonary arteries with contrast agent", false},
       {{-300, .25, .10, .25, 0},
        {-100, .40, .14, .28, .015},
        {100, .55, .15, .20, .04},
        {200, .72, .18, .20, .3},
        {350, .88, .40, .30, .6},
        {700, .97, .88, .78, .75}}},
      {{"CT-Soft-Tissue", "the body's surface, opaque", false},
       {{-500, .80, .55, .42, 0},
        {-300, .90, .68, .55, .35},
        {-50, .93, .74, .60, .7},
        {60, .85, .55, .44, .8},
        {300, .95, .86, .74, .9}}},
      {{"CT-Air", "walls of air spaces: airways and sinuses through a translucent skin", false},
       {{-980, .45, .65, .90, 0},
        {-900, .50, .70, .92, .03},
        {-650, .75, .86, .97, .12},
        {-400, .90, .90, .90, .02},
        {-250, .90, .90, .90, 0}}},
      {{"CT-MIP", "grey window over contrast and bone for maximum intensity projection", false},
       {{-100, 0, 0, 0, 0}, {150, .25, .25, .25, .08}, {700, .85, .85, .85, .6}, {1500, 1, 1, 1, 1}}},
      {{"CT-X-ray", "opacity in proportion to attenuation, for X-ray mode", false},
       {{-1000, 1, 1, 1, 0}, {0, 1, 1, 1, .010}, {1000, 1, 1, 1, .022}, {3000, 1, 1, 1, .045}}},
  };
}

std::vector<Preset> relative_presets() {
  return {
      {{"MR-Angio", "bright vessels in dark tissue", true},
       {{.30, .30, .05, .05, 0},
        {.45, .55, .12, .10, .05},
        {.60, .82, .28, .18, .35},
        {.80, .95, .65, .45, .7},
        {1, 1, .95, .85, .9}}},
      {{"MR-Default", "tissue in warm colours, brighter is denser", true},
       {{.05, .12, .06, .05, 0},
        {.15, .42, .20, .16, .03},
        {.35, .68, .42, .32, .10},
        {.60, .88, .70, .56, .25},
        {1, 1, .96, .90, .5}}},
      {{"MR-MIP", "grey window for maximum intensity projection", true},
       {{.02, 0, 0, 0, 0}, {.5, .5, .5, .5, .25}, {1, 1, 1, 1, 1}}},
      {{"MR-T2-Brain", "brain translucent, fluid bright", true},
       {{.08, .10, .08, .10, 0},
        {.25, .45, .30, .28, .05},
        {.45, .70, .50, .42, .15},
        {.65, .80, .72, .66, .08},
        {.80, .55, .75, .90, .35},
        {1, .85, .95, 1, .6}}},
      {{"DTI-FA-Brain", "fractional anisotropy: fibre tracts from 0.2 of the range on", true},
       {{.12, .10, .15, .35, 0},
        {.25, .15, .45, .65, .04},
        {.45, .35, .75, .45, .2},
        {.70, .95, .80, .30, .5},
        {1, 1, .45, .20, .8}}},
      {{"US-Fetal", "ultrasound: skin surfaces in warm light", true},
       {{.18, .25, .12, .08, 0},
        {.32, .60, .36, .24, .12},
        {.55, .86, .62, .45, .4},
        {.80, .98, .84, .68, .65},
        {1, 1, .95, .86, .8}}},
      {{"cast-and-steel", "industrial CT: dense parts opaque inside a translucent casting", true},
       {{.25, .30, .36, .42, 0},
        {.40, .45, .52, .58, .03},
        {.62, .62, .68, .72, .05},
        {.72, .85, .62, .30, .12},
        {.88, .96, .78, .42, .7},
        {1, 1, .92, .70, .9}}},
      {{"grey-ramp", "black to white, opacity rising to 0.1", true}, {{0, 0, 0, 0, 0}, {1, 1, 1, 1, .1}}},
      {{"halves", "red below the middle of the range, blue above, a step: shows the order of compositing",
        true},
       {{.5, .90, .25, .15, .03}, {.5, .20, .45, .95, .03}}},
      {{"fog", "thin white haze, opacity rising to 0.01", true}, {{0, 1, 1, 1, 0}, {1, 1, 1, 1, .01}}},
      {{"opaque", "opaque from the middle of the range on, a step", true},
       {{.5, .80, .45, .30, 0}, {.5, .80, .45, .30, 1}, {1, 1, .93, .80, 1}}},
  };
}

/// The colours of the frog's organs by label, and how opaque they are shown.
struct OrganColor {
  double r, g, b, opacity;
};

constexpr OrganColor kOrganColors[] = {
    {0, 0, 0, 0},          // air
    {.42, .60, .26, .060}, // skin
    {.78, .50, .40, .002}, // muscle
    {.95, .92, .82, .80},  // skeleton
    {.96, .96, .90, .70},  // eye
    {.10, .10, .12, .95},  // lens
    {.95, .70, .72, .80},  // brain
    {.98, .90, .35, .80},  // nerves
    {.62, .80, .95, .35},  // lung
    {.85, .10, .12, .90},  // heart
    {.95, .22, .18, .90},  // vessels
    {.55, .22, .14, .70},  // liver
    {.20, .65, .25, .90},  // gall bladder
    {.93, .62, .42, .70},  // stomach
    {.98, .74, .58, .80},  // small intestine
    {.72, .45, .35, .80},  // large intestine
    {.55, .10, .30, .90},  // spleen
    {.70, .20, .22, .90},  // kidney
    {.98, .80, .25, .85},  // fat body
    {.90, .88, .45, .60},  // bladder
};

TransferPoint organ_point(double value, const OrganColor& color, double opacity) {
  return {value, color.r, color.g, color.b, opacity};
}

/// A step half-way between two labels.
std::vector<TransferPoint> label_points() {
  std::vector<TransferPoint> points;
  for (const OrganInfo& organ : organs()) {
    const OrganColor& color = kOrganColors[organ.label];
    if (organ.label > 0)
      points.push_back(organ_point(organ.label - 0.5, color, color.opacity));
    if (organ.label + 1U < organs().size())
      points.push_back(organ_point(organ.label + 0.5, color, color.opacity));
  }
  return points;
}

std::vector<Preset> phantom_presets() {
  return {
      {{"organs", "the frog's skeleton and organs in warm colours inside a translucent skin", false,
        "values of phantom organs"},
       {{3, .5, .7, .4, 0},
        {14, .45, .65, .32, .03},
        {30, .4, .6, .26, .055},
        {40, .55, .4, .28, .002},
        {52, .7, .4, .25, .004},
        {62, .96, .78, .34, .07},
        {80, .92, .8, .55, .07},
        {95, .8, .45, .4, .05},
        {110, .62, .24, .15, .12},
        {130, .66, .16, .16, .16},
        {142, .86, .14, .12, .24},
        {155, .94, .24, .18, .24},
        {166, .95, .62, .44, .14},
        {190, .98, .8, .64, .2},
        {204, .97, .9, .78, .5},
        {226, 1, .97, .88, .95}}},
      {{"organs-labels", "a colour for each organ of the frog, by its label", false,
        "labels of phantom organs-labels"},
       label_points()},
      {{"colon", "the wall seen from inside and outside, translucent; polyps red", false,
        "HU of phantom colon"},
       {{-960, .75, .60, .58, 0},
        {-700, .85, .68, .62, .12},
        {-400, .95, .74, .66, .20},
        {-200, .95, .70, .62, .06},
        {-110, .95, .65, .58, 0},
        {50, .90, .50, .40, 0},
        {70, .85, .12, .10, .6},
        {90, .85, .10, .08, .9}}},
  };
}

const std::vector<Preset>& all_presets() {
  static const std::vector<Preset> list = [] {
    std::vector<Preset> all = bone_presets();
    for (auto* more : {&soft_tissue_presets, &relative_presets, &phantom_presets}) {
      for (Preset& entry : more())
        all.push_back(std::move(entry));
    }
    return all;
  }();
  return list;
}

} // namespace

const std::vector<PresetInfo>& presets() {
  static const std::vector<PresetInfo> infos = [] {
    std::vector<PresetInfo> list;
    for (const Preset& entry : all_presets())
      list.push_back(entry.info);
    return list;
  }();
  return infos;
}

TransferFunction preset(const std::string& name, double data_min, double data_max) {
  std::vector<std::string> names;
  for (const Preset& entry : all_presets()) {
    names.push_back(entry.info.name);
    if (entry.info.name != name)
      continue;
    TransferFunction transfer{entry.points, std::nullopt, name};
    if (entry.info.relative) {
      const double low = data_min < data_max ? data_min : data_min - 1;
      const double high = data_min < data_max ? data_max : data_min;
      for (TransferPoint& point : transfer.points)
        point.value = low * (1 - point.value) + high * point.value;
    }
    return transfer;
  }
  const auto nearest = nearest_word(name, names);
  throw UsageError("preset '" + name + "' is not known" +
                   (nearest ? "; did you mean '" + *nearest + "'?" : "") + " (" + join(names) + ")");
}

} // namespace slicelens
