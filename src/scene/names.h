// The words that stand for enumerators in scene files, on the command line and in tables.
#pragma once

#include "scene/scene.h"

#include <string>
#include <vector>

namespace slicelens {

template <class Enum>
struct EnumName {
  Enum value;
  const char* name;
};

/// All words of an enumeration, in the order in which help texts show them.
const std::vector<EnumName<Alignment>>& names_of(Alignment);
const std::vector<EnumName<Combine>>& names_of(Combine);
const std::vector<EnumName<VolumeAccess>>& names_of(VolumeAccess);
const std::vector<EnumName<ProjectionName>>& names_of(ProjectionName);
const std::vector<EnumName<Pipeline>>& names_of(Pipeline);
const std::vector<EnumName<Mode>>& names_of(Mode);
const std::vector<EnumName<LabelMode>>& names_of(LabelMode);
const std::vector<EnumName<Order>>& names_of(Order);
const std::vector<EnumName<Proxy>>& names_of(Proxy);
const std::vector<EnumName<OpacityCorrection>>& names_of(OpacityCorrection);
const std::vector<EnumName<Shading>>& names_of(Shading);
const std::vector<EnumName<Gradient>>& names_of(Gradient);
const std::vector<EnumName<GradientSpace>>& names_of(GradientSpace);
const std::vector<EnumName<GradientResolution>>& names_of(GradientResolution);
const std::vector<EnumName<GradientFormat>>& names_of(GradientFormat);
const std::vector<EnumName<Classification>>& names_of(Classification);
const std::vector<EnumName<Filter>>& names_of(Filter);
const std::vector<EnumName<Footprint>>& names_of(Footprint);
const std::vector<EnumName<Skip>>& names_of(Skip);
const std::vector<EnumName<Target>>& names_of(Target);
const std::vector<EnumName<VolumeTexture>>& names_of(VolumeTexture);
const std::vector<EnumName<TransferTexture>>& names_of(TransferTexture);
const std::vector<EnumName<AxisFilter>>& names_of(AxisFilter);
const std::vector<EnumName<HighlightFunction>>& names_of(HighlightFunction);
const std::vector<EnumName<AttenuationFunction>>& names_of(AttenuationFunction);
const std::vector<EnumName<ContextName>>& names_of(ContextName);
const std::vector<EnumName<ClipSpace>>& names_of(ClipSpace);
const std::vector<EnumName<LensShape>>& names_of(LensShape);
const std::vector<EnumName<Wireframe>>& names_of(Wireframe);
const std::vector<EnumName<PlaneStyle>>& names_of(PlaneStyle);
const std::vector<EnumName<LensBorder>>& names_of(LensBorder);
const std::vector<EnumName<Axis>>& names_of(Axis);
const std::vector<EnumName<Direction>>& names_of(Direction);
const std::vector<EnumName<LandmarkSpace>>& names_of(LandmarkSpace);
const std::vector<EnumName<LandmarkMethod>>& names_of(LandmarkMethod);
const std::vector<EnumName<FieldDirection>>& names_of(FieldDirection);
const std::vector<EnumName<FieldVectors>>& names_of(FieldVectors);

/// The word of an enumerator.
template <class Enum>
std::string word(Enum value) {
  for (const auto& entry : names_of(value)) {
    if (entry.value == value)
      return entry.name;
  }
  return "?";
}

/// All words of the enumeration of `any`.
template <class Enum>
std::vector<std::string> words_of(Enum any) {
  std::vector<std::string> words;
  for (const auto& entry : names_of(any))
    words.emplace_back(entry.name);
  return words;
}

} // namespace slicelens
