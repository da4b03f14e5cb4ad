#include "scene/names.h"

namespace slicelens {

const std::vector<EnumName<Alignment>>& names_of(Alignment) {
  static const std::vector<EnumName<Alignment>> names = {{Alignment::world, "world"},
                                                         {Alignment::center, "center"}};
  return names;
}

const std::vector<EnumName<Combine>>& names_of(Combine) {
  static const std::vector<EnumName<Combine>> names = {{Combine::mix, "mix"},
                                                       {Combine::sum, "sum"},
                                                       {Combine::max, "max"},
                                                       {Combine::difference, "difference"}};
  return names;
}

const std::vector<EnumName<ProjectionName>>& names_of(ProjectionName) {
  static const std::vector<EnumName<ProjectionName>> names = {{ProjectionName::orthographic, "orthographic"},
                                                              {ProjectionName::perspective, "perspective"}};
  return names;
}

const std::vector<EnumName<Pipeline>>& names_of(Pipeline) {
  static const std::vector<EnumName<Pipeline>> names = {
      {Pipeline::slices, "slices"}, {Pipeline::tessellated, "tessellated"},
      {Pipeline::axis, "axis"},     {Pipeline::fragment, "fragment"},
      {Pipeline::grid, "grid"},     {Pipeline::fixed_function, "fixed-function"},
      {Pipeline::rays, "rays"},     {Pipeline::reference, "reference"}};
  return names;
}

const std::vector<EnumName<Mode>>& names_of(Mode) {
  static const std::vector<EnumName<Mode>> names = {
      {Mode::dvr, "dvr"},   {Mode::mip, "mip"}, {Mode::minip, "minip"},        {Mode::average, "average"},
      {Mode::xray, "xray"}, {Mode::iso, "iso"}, {Mode::two_level, "two-level"}};
  return names;
}

const std::vector<EnumName<LabelMode>>& names_of(LabelMode) {
  static const std::vector<EnumName<LabelMode>> names = {
      {LabelMode::dvr, "dvr"}, {LabelMode::mip, "mip"}, {LabelMode::xray, "xray"}};
  return names;
}

const std::vector<EnumName<Order>>& names_of(Order) {
  static const std::vector<EnumName<Order>> names = {{Order::back_to_front, "back-to-front"},
                                                     {Order::front_to_back, "front-to-back"}};
  return names;
}

const std::vector<EnumName<Proxy>>& names_of(Proxy) {
  static const std::vector<EnumName<Proxy>> names = {{Proxy::planes, "planes"}, {Proxy::shells, "shells"}};
  return names;
}

const std::vector<EnumName<OpacityCorrection>>& names_of(OpacityCorrection) {
  static const std::vector<EnumName<OpacityCorrection>> names = {{OpacityCorrection::fragment, "fragment"},
                                                                 {OpacityCorrection::frame, "frame"},
                                                                 {OpacityCorrection::none, "none"}};
  return names;
}

const std::vector<EnumName<Shading>>& names_of(Shading) {
  static const std::vector<EnumName<Shading>> names = {{Shading::none, "none"},
                                                       {Shading::diffuse, "diffuse"},
                                                       {Shading::phong, "phong"},
                                                       {Shading::tone, "tone"}};
  return names;
}

const std::vector<EnumName<Gradient>>& names_of(Gradient) {
  static const std::vector<EnumName<Gradient>> names = {{Gradient::forward, "forward"},
                                                        {Gradient::central, "central"},
                                                        {Gradient::prefiltered, "prefiltered"},
                                                        {Gradient::precomputed, "precomputed"}};
  return names;
}

const std::vector<EnumName<GradientSpace>>& names_of(GradientSpace) {
  static const std::vector<EnumName<GradientSpace>> names = {{GradientSpace::data, "data"},
                                                             {GradientSpace::object, "object"}};
  return names;
}

const std::vector<EnumName<GradientFormat>>& names_of(GradientFormat) {
  static const std::vector<EnumName<GradientFormat>> names = {{GradientFormat::rgb16f, "rgb16f"},
                                                              {GradientFormat::rgba32f, "rgba32f"}};
  return names;
}

const std::vector<EnumName<GradientResolution>>& names_of(GradientResolution) {
  static const std::vector<EnumName<GradientResolution>> names = {{GradientResolution::full, "full"},
                                                                  {GradientResolution::half, "half"},
                                                                  {GradientResolution::quarter, "quarter"}};
  return names;
}

const std::vector<EnumName<Classification>>& names_of(Classification) {
  static const std::vector<EnumName<Classification>> names = {
      {Classification::post, "post"},
      {Classification::pre, "pre"},
      {Classification::preintegrated, "preintegrated"}};
  return names;
}

const std::vector<EnumName<Footprint>>& names_of(Footprint) {
  static const std::vector<EnumName<Footprint>> names = {{Footprint::point, "point"},
                                                         {Footprint::mip, "mip"}};
  return names;
}

const std::vector<EnumName<Filter>>& names_of(Filter) {
  static const std::vector<EnumName<Filter>> names = {{Filter::nearest, "nearest"},
                                                      {Filter::linear, "linear"},
                                                      {Filter::linear_exact, "linear-exact"},
                                                      {Filter::cubic, "cubic"}};
  return names;
}

const std::vector<EnumName<VolumeAccess>>& names_of(VolumeAccess) {
  static const std::vector<EnumName<VolumeAccess>> names = {{VolumeAccess::automatic, "auto"},
                                                            {VolumeAccess::memory, "memory"},
                                                            {VolumeAccess::stream, "stream"},
                                                            {VolumeAccess::cache, "cache"}};
  return names;
}

const std::vector<EnumName<Skip>>& names_of(Skip) {
  static const std::vector<EnumName<Skip>> names = {
      {Skip::none, "none"}, {Skip::empty, "empty"}, {Skip::empty_and_hidden, "empty+hidden"}};
  return names;
}

const std::vector<EnumName<Target>>& names_of(Target) {
  static const std::vector<EnumName<Target>> names = {
      {Target::rgba8, "rgba8"}, {Target::rgba16f, "rgba16f"}, {Target::rgba32f, "rgba32f"}};
  return names;
}

const std::vector<EnumName<VolumeTexture>>& names_of(VolumeTexture) {
  static const std::vector<EnumName<VolumeTexture>> names = {{VolumeTexture::automatic, "auto"},
                                                             {VolumeTexture::r8, "r8"},
                                                             {VolumeTexture::r16, "r16"},
                                                             {VolumeTexture::r32f, "r32f"}};
  return names;
}

const std::vector<EnumName<TransferTexture>>& names_of(TransferTexture) {
  static const std::vector<EnumName<TransferTexture>> names = {{TransferTexture::rgba8, "rgba8"},
                                                               {TransferTexture::rgba32f, "rgba32f"}};
  return names;
}

const std::vector<EnumName<AxisFilter>>& names_of(AxisFilter) {
  static const std::vector<EnumName<AxisFilter>> names = {{AxisFilter::linear, "linear"},
                                                          {AxisFilter::nearest, "nearest"}};
  return names;
}

const std::vector<EnumName<HighlightFunction>>& names_of(HighlightFunction) {
  static const std::vector<EnumName<HighlightFunction>> names = {{HighlightFunction::off, "off"},
                                                                 {HighlightFunction::distance, "distance"},
                                                                 {HighlightFunction::focus, "focus"}};
  return names;
}

const std::vector<EnumName<AttenuationFunction>>& names_of(AttenuationFunction) {
  static const std::vector<EnumName<AttenuationFunction>> names = {
      {AttenuationFunction::off, "off"},
      {AttenuationFunction::distance, "distance"},
      {AttenuationFunction::viewpoint, "viewpoint"}};
  return names;
}

const std::vector<EnumName<ContextName>>& names_of(ContextName) {
  static const std::vector<EnumName<ContextName>> names = {{ContextName::automatic, "auto"},
                                                           {ContextName::osmesa, "osmesa"},
                                                           {ContextName::egl, "egl"},
                                                           {ContextName::window, "window"}};
  return names;
}

const std::vector<EnumName<ClipSpace>>& names_of(ClipSpace) {
  static const std::vector<EnumName<ClipSpace>> names = {{ClipSpace::texture, "texture"},
                                                         {ClipSpace::object, "object"}};
  return names;
}

const std::vector<EnumName<LensShape>>& names_of(LensShape) {
  static const std::vector<EnumName<LensShape>> names = {{LensShape::circle, "circle"},
                                                         {LensShape::square, "square"}};
  return names;
}

const std::vector<EnumName<LensBorder>>& names_of(LensBorder) {
  static const std::vector<EnumName<LensBorder>> names = {
      {LensBorder::simple, "simple"}, {LensBorder::linear, "linear"}, {LensBorder::cubic, "cubic"}};
  return names;
}

const std::vector<EnumName<Wireframe>>& names_of(Wireframe) {
  static const std::vector<EnumName<Wireframe>> names = {
      {Wireframe::none, "none"}, {Wireframe::segments, "segments"}, {Wireframe::triangles, "triangles"}};
  return names;
}

const std::vector<EnumName<Axis>>& names_of(Axis) {
  static const std::vector<EnumName<Axis>> names = {{Axis::x, "x"}, {Axis::y, "y"}, {Axis::z, "z"}};
  return names;
}

const std::vector<EnumName<Direction>>& names_of(Direction) {
  static const std::vector<EnumName<Direction>> names = {
      {Direction::x, "x"},        {Direction::y, "y"},        {Direction::z, "z"},
      {Direction::minus_x, "-x"}, {Direction::minus_y, "-y"}, {Direction::minus_z, "-z"}};
  return names;
}

const std::vector<EnumName<LandmarkSpace>>& names_of(LandmarkSpace) {
  static const std::vector<EnumName<LandmarkSpace>> names = {{LandmarkSpace::world, "world"},
                                                             {LandmarkSpace::texture, "texture"}};
  return names;
}

const std::vector<EnumName<LandmarkMethod>>& names_of(LandmarkMethod) {
  static const std::vector<EnumName<LandmarkMethod>> names = {{LandmarkMethod::tps, "tps"},
                                                              {LandmarkMethod::bspline, "bspline"}};
  return names;
}

const std::vector<EnumName<FieldDirection>>& names_of(FieldDirection) {
  static const std::vector<EnumName<FieldDirection>> names = {{FieldDirection::inverse, "inverse"},
                                                              {FieldDirection::forward, "forward"}};
  return names;
}

const std::vector<EnumName<FieldVectors>>& names_of(FieldVectors) {
  static const std::vector<EnumName<FieldVectors>> names = {
      {FieldVectors::automatic, "auto"}, {FieldVectors::lps, "lps"}, {FieldVectors::ras, "ras"}};
  return names;
}

const std::vector<EnumName<PlaneStyle>>& names_of(PlaneStyle) {
  static const std::vector<EnumName<PlaneStyle>> names = {{PlaneStyle::values, "values"},
                                                          {PlaneStyle::transfer, "transfer"}};
  return names;
}

} // namespace slicelens
