#include "render/reference.h"

#include "render/cut_planes.h"
#include "render/gradient_texture.h"
#include "render/level_values.h"
#include "render/pre_classification.h"
#include "render/ray_frame.h"
#include "render/segment_integral.h"
#include "render/several_volumes.h"
#include "render/smooth_copy.h"
#include "render/voxel_filter.h"
#include "volume/gradient_volume.h"
#include "volume/streamed.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <mutex>

namespace slicelens {

namespace {

// Names of GLSL for the shared shader functions below. They are compiled inside a class, so that the values
// they take from their host (uniforms and samplers in GLSL) are its members.
using namespace glm;
using real = double;
using uint = std::uint32_t;
using vec2 = glm::dvec2;
using vec3 = glm::dvec3;
using vec4 = glm::dvec4;

struct SharedFunctions {
#include "lib/combine.glsl"
#include "lib/composite.glsl"
#include "lib/jitter.glsl"
#include "lib/labels.glsl"
#include "lib/opacity.glsl"
#include "lib/ray.glsl"
#include "lib/segment.glsl"
#include "lib/shade.glsl"
#include "lib/two_level.glsl"
};

/// One of several volumes, whatever the type of its voxels.
struct VolumeSampler {
  virtual ~VolumeSampler() = default;
  /// Straight colour, and opacity per reference length of the first volume, at a point of the first one's
  /// texture coordinates; nothing outside.
  virtual vec4 color(vec3 first, vec3 to_eye) = 0;
  /// The data value there, negated under `minip`; −∞ outside.
  virtual real extreme(vec3 first) = 0;
  /// Colour and opacity of the largest of these, as above.
  virtual vec4 classified(real extreme) const = 0;
};
using VolumeSamplers = std::vector<std::unique_ptr<VolumeSampler>>;

/// Everything one thread needs to trace rays through voxels of type T.
template <class T>
struct Tracer : SharedFunctions {
  const PreparedScene& prepared;
  const T* voxels;
  const std::byte* classified; ///< RGBA of 8 bits under classification `pre`, else null
  const SmoothCopy* smooth;    ///< of gradient `prefiltered`, else null
  ivec3 dims;
  vec3 voxel;
  dmat3 world_from_gradient;
  Filter filter;
  real level = 0; ///< that the sample reads, with render.levels or render.footprint
  Correction correction;
  real ratio;
  std::vector<CutPlane> planes;
  vec3 half_step{0};      ///< along the ray that is traced, texture space
  VolumeSamplers volumes; ///< all of several volumes; none for a single one

  Tracer(const PreparedScene& scene, const std::byte* classified_voxels, const SmoothCopy* smooth_voxels)
      : prepared(scene), voxels(reinterpret_cast<const T*>(scene.volume.voxels.data())),
        classified(classified_voxels), smooth(smooth_voxels),
        dims(scene.volume.dims[0], scene.volume.dims[1], scene.volume.dims[2]), voxel(1.0 / vec3(dims)),
        world_from_gradient(glm::transpose(glm::inverse(dmat3(scene.box.world_from_texture)))),
        filter(scene.scene.render.filter), correction(correction_of(scene)),
        ratio(scene.scene.render.opacity_correction == OpacityCorrection::none ? 1
                                                                               : axis_distance_ratio(scene)),
        planes(cut_planes(scene)) {}

  std::size_t voxel_index(int i, int j, int k) const {
    return (static_cast<std::size_t>(k) * static_cast<std::size_t>(dims.y) + static_cast<std::size_t>(j)) *
               static_cast<std::size_t>(dims.x) +
           static_cast<std::size_t>(i);
  }

  real voxel_value(int i, int j, int k) const {
    const real value = static_cast<real>(voxels[voxel_index(i, j, k)]);
    if constexpr (std::is_floating_point_v<T>)
      return std::isfinite(value) ? value : prepared.volume.min;
    return value;
  }

  /// What `voxel_at` gives for voxels (i, j, k), at p.
  template <class VoxelAt>
  auto interpolated(vec3 p, const VoxelAt& voxel_at) const {
    return filtered(filter, dims, p * vec3(dims), voxel_at);
  }

  /// The data value at p, of the sample's level.
  real displayed_value(vec3 p) const {
    return prepared.pyramid.empty()
               ? full_value(p)
               : blended_levels(prepared, level, p, [this](vec3 t) { return full_value(t); });
  }

  /// At full resolution.
  real full_value(vec3 p) const {
    return interpolated(p, [&](int i, int j, int k) { return voxel_value(i, j, k); });
  }

  /// Classification `pre`: the associated colour at p, interpolated in double between the texture's 8 bits.
  vec4 classified_sample(vec3 p) const {
    return interpolated(p, [&](int i, int j, int k) {
      const std::byte* texel = classified + classified_voxel_bytes * voxel_index(i, j, k);
      return vec4(std::to_integer<int>(texel[0]), std::to_integer<int>(texel[1]),
                  std::to_integer<int>(texel[2]), std::to_integer<int>(texel[3])) /
             255.0;
    });
  }

  /// What differences are taken of, at p in the data or, in object space, in the displayed volume.
  real gradient_value(vec3 p) const {
    const vec3 t = prepared.gradient_space == GradientSpace::object ? data_point(p) : p;
    return smooth != nullptr ? smooth->value(t) : displayed_value(t);
  }

#include "lib/gradient.glsl"

  /// Derivatives of the data at voxel (i, j, k) by texture coordinates, by central differences.
  vec3 voxel_gradient(int i, int j, int k) const {
    const auto difference = [&](ivec3 step) {
      const ivec3 above = min(ivec3(i, j, k) + step, dims - 1);
      const ivec3 below = max(ivec3(i, j, k) - step, ivec3(0));
      return voxel_value(above.x, above.y, above.z) - voxel_value(below.x, below.y, below.z);
    };
    return vec3(difference({1, 0, 0}), difference({0, 1, 0}), difference({0, 0, 1})) * vec3(dims) * 0.5;
  }

  /// Of the displayed volume by its texture coordinates, at p, which shows t.
  vec3 shown_gradient(vec3 t, vec3 p) {
    const bool in_object_space = prepared.gradient_space == GradientSpace::object;
    const vec3 at = in_object_space ? p : t;
    vec3 gradient;
    switch (prepared.scene.render.gradient) {
    case Gradient::forward:
      gradient = forward_gradient(at, voxel * gradient_step(prepared, level, p));
      break;
    case Gradient::central:
      gradient = central_gradient(at, voxel * gradient_step(prepared, level, p));
      break;
    case Gradient::prefiltered:
      gradient = central_gradient(at, 1.0 / vec3(smooth->dims));
      break;
    case Gradient::precomputed:
      gradient = filtered(Filter::linear, dims, t * vec3(dims),
                          [&](int i, int j, int k) { return voxel_gradient(i, j, k); });
      break;
    }
    return in_object_space ? gradient : displayed_gradient(gradient, p);
  }

  vec3 shaded(vec3 color, vec3 t, vec3 p, vec3 to_eye) {
    const vec3 gradient = world_from_gradient * shown_gradient(t, p);
    const vec3 to_light = light_direction(prepared, to_eye);
    const LightSettings& light = prepared.scene.light;
    if (prepared.scene.render.shading == Shading::tone)
      return this->tone_color(color, gradient, to_light, light.cool, light.warm);
    if (prepared.scene.render.shading == Shading::phong)
      return this->phong_color(color, gradient, to_light, to_eye, light.ambient, light.diffuse,
                               light.specular, light.power, light.two_sided);
    return color * this->diffuse_factor(gradient, to_light, light.ambient, light.diffuse, light.two_sided);
  }

  /// u = u_1 ∘ … ∘ u_n (docs/pipeline.md).
  vec3 data_point(vec3 p) const {
    if (!is_warped(prepared))
      return p;
    return texture_from_box(prepared.space,
                            texture_from_object(prepared.maps, box_from_texture(prepared.space, p)));
  }

  /// Jᵀ∇v, by texture coordinates.
  vec3 displayed_gradient(vec3 gradient, vec3 p) const {
    if (!is_warped(prepared))
      return gradient;
    const dmat3 j = jacobian(prepared.maps, box_from_texture(prepared.space, p));
    return ((gradient / prepared.space.size) * j) * prepared.space.size;
  }

  /// Inside the volume and the planes that clip the data.
  bool shows_data(vec3 t) const {
    if (any(lessThan(t, vec3(0))) || any(greaterThan(t, vec3(1))))
      return false;
    return std::all_of(prepared.data_clip.begin(), prepared.data_clip.end(),
                       [&](const Plane& plane) { return signed_value(plane, t) >= 0; });
  }

  /// Attenuation and highlight at the displayed point p.
  vec2 focus_at(vec3 p) const {
    return {has_attenuation(prepared.effects) ? attenuation_at(prepared.effects, p) : 1,
            has_highlight(prepared.effects) ? highlight_at(prepared.effects, p) : 0};
  }

  /// A straight colour and its opacity per reference length after both.
  vec4 with_effects(vec4 color, vec2 focus) const {
    return vec4(mix(vec3(color), prepared.effects.highlight_color, focus.y), color.w * focus.x);
  }

  /// −1 where the smallest value is looked for.
  real sign() const { return prepared.scene.render.mode == Mode::minip ? -1 : 1; }

  /// The value shown at p, for lib/iso.glsl.
  real iso_value(vec3 p) const { return displayed_value(data_point(p)); }

#include "lib/iso.glsl"

  /// Mode `iso`: the first surface between two of the samples `first` to `last`, opaque.
  vec4 first_surface(const SharedFunctions::PixelRay& ray, std::int64_t first, std::int64_t last, real offset,
                     vec3 to_eye) {
    const real iso = isovalue_of(prepared);
    bool had = false;
    real before_value = 0;
    vec3 before(0);
    for (std::int64_t k = first; k <= last; ++k) {
      const vec3 p = ray.origin + ((static_cast<real>(k) + 0.5 + offset) * prepared.spacing) * ray.direction;
      const vec3 t = data_point(p);
      const bool has = !is_warped(prepared) || shows_data(t);
      const real value = displayed_value(t);
      if (had && has && (value < iso) != (before_value < iso)) {
        const vec3 hit = refined_crossing(before, p, before_value, value, iso);
        vec3 color(evaluate(prepared.transfer, iso));
        if (prepared.scene.render.shading != Shading::none)
          color = shaded(color, data_point(hit), hit, to_eye);
        return vec4(vec3(with_effects(vec4(color, 1), focus_at(hit))), 1);
      }
      had = has;
      before_value = value;
      before = p;
    }
    return vec4(0);
  }

  /// Mode `two-level`: the row of the voxel that holds t.
  std::size_t label_row(vec3 t) {
    const int i = this->label_voxel(t.x, dims.x);
    const int j = this->label_voxel(t.y, dims.y);
    const int k = this->label_voxel(t.z, dims.z);
    return prepared.labels.rows[voxel_index(i, j, k)];
  }

  /// Straight colour and opacity per reference length of a value that is looked up at t.
  vec4 classified_value(vec3 t, real value) {
    if (prepared.labels.table.empty())
      return evaluate(prepared.transfer, value);
    const LabelRow& row = prepared.labels.table[label_row(t)];
    vec4 color = evaluate(row.transfer, value);
    if (row.length_ratio != 1)
      color.w = this->corrected_opacity(color.w, row.length_ratio);
    return color;
  }

  /// One more sample of a ray through objects of which some have a mode of their own.
  TwoLevel gather_objects(const TwoLevel& state, vec3 p, vec3 to_eye) {
    const vec3 t = data_point(p);
    if (is_warped(prepared) && !shows_data(t))
      return this->ended_run(state, prepared.xray_scale);
    const std::size_t row = label_row(t);
    const LabelMode mode = prepared.labels.table[row].mode;
    const real value = displayed_value(t);
    // Neither gradient nor light for a largest value, no light for a line integral.
    vec4 color = classified_value(t, value);
    if (mode == LabelMode::dvr)
      color = sample_color(t, p, to_eye);
    else if (mode == LabelMode::xray)
      color.w *= opacity_factor(t, p, color.w);
    color = with_effects(color, focus_at(p));
    const real alpha = correction == Correction::none ? color.w : this->corrected_opacity(color.w, ratio);
    return this->with_sample(state, static_cast<int>(row), static_cast<int>(mode), value, color, alpha, ratio,
                             prepared.xray_scale);
  }

  /// Of modulate_by_gradient, on an opacity; 1 without it.
  real opacity_factor(vec3 t, vec3 p, real opacity) {
    const auto& full = prepared.scene.render.modulate_by_gradient;
    return full && opacity > 0 ? min(length(world_from_gradient * shown_gradient(t, p)) / *full, 1.0) : 1;
  }

  /// Straight colour and opacity per own reference length.
  vec4 sample_color(vec3 t, vec3 p, vec3 to_eye) {
    const auto& shapes = prepared.scene.transfer.shapes;
    vec4 color = shapes.empty() ? classified_value(t, displayed_value(t))
                                : evaluate(shapes, displayed_value(t),
                                           length(world_from_gradient * shown_gradient(t, p)));
    color.w *= opacity_factor(t, p, color.w);
    if (prepared.scene.render.shading == Shading::none || color.w == 0)
      return color;
    return vec4(shaded(vec3(color), t, p, to_eye), color.w);
  }

  /// Of all volumes together.
  vec4 gather_several(vec4 gathered, vec3 p, vec3 to_eye) {
    const Mode mode = prepared.scene.render.mode;
    vec4 samples[max_volumes];
    for (std::size_t i = 0; i < volumes.size(); ++i) {
      if (classifies_last(mode))
        gathered[static_cast<int>(i)] = max(gathered[static_cast<int>(i)], volumes[i]->extreme(p));
      else
        samples[i] = volumes[i]->color(p, to_eye);
    }
    if (classifies_last(mode))
      return gathered;
    vec4 color =
        this->combined(samples, static_cast<int>(volumes.size()), static_cast<int>(prepared.scene.combine));
    if (mode == Mode::xray) {
      const vec4 grey = with_effects(vec4(1, 1, 1, color.w * ratio), focus_at(p));
      return gathered + this->associated(vec3(grey), grey.w);
    }
    color = with_effects(color, focus_at(p));
    return this->under(gathered, this->associated(vec3(color), this->corrected_opacity(color.w, ratio)));
  }

  /// MIP of several volumes: the colour of their largest values.
  vec4 classified_maxima(vec4 largest) {
    vec4 samples[max_volumes];
    for (std::size_t i = 0; i < volumes.size(); ++i)
      samples[i] = volumes[i]->classified(largest[static_cast<int>(i)]);
    const vec4 color =
        this->combined(samples, static_cast<int>(volumes.size()), static_cast<int>(prepared.scene.combine));
    return this->associated(vec3(color), color.w);
  }

  /// Classification `preintegrated`: the segment around p, which shows t. Shaded and highlighted as its
  /// middle is.
  vec4 gather_segment(vec4 gathered, vec3 t, vec3 p, vec3 to_eye) {
    const vec4 segment = segment_integral(prepared.transfer, displayed_value(data_point(p - half_step)),
                                          displayed_value(data_point(p + half_step)), ratio);
    if (segment.w == 0)
      return gathered;
    vec4 color(vec3(segment) / segment.w, 1);
    if (prepared.scene.render.shading != Shading::none)
      color = vec4(shaded(vec3(color), t, p, to_eye), 1);
    color = with_effects(color, focus_at(p));
    return this->under(gathered,
                       this->associated(vec3(color), this->segment_opacity(segment.w, color.w, ratio, 1)));
  }

  vec4 gather(vec4 gathered, vec3 p, vec3 to_eye) {
    if (!volumes.empty())
      return gather_several(gathered, p, to_eye);
    if (!prepared.pyramid.empty())
      level = level_at(prepared, p);
    const vec3 t = data_point(p);
    if (is_warped(prepared) && !shows_data(t))
      return gathered;
    const Mode mode = prepared.scene.render.mode;
    if (prepared.scene.render.classification == Classification::preintegrated)
      return gather_segment(gathered, t, p, to_eye);
    if (classified != nullptr) {
      const vec4 color = classified_sample(t);
      return mode == Mode::xray ? gathered + vec4(color.w * ratio) : this->under(gathered, color);
    }
    if (mode == Mode::average)
      return gathered + vec4(displayed_value(t), 0, 0, 1);
    if (mode == Mode::mip || mode == Mode::minip) {
      const real value = sign() * displayed_value(t);
      return value > gathered.x ? vec4(value, focus_at(p), 1) : gathered;
    }
    if (mode == Mode::xray) {
      const vec4 color = sample_color(t, p, to_eye);
      const vec4 grey = with_effects(vec4(1, 1, 1, color.w * ratio), focus_at(p));
      return gathered + this->associated(vec3(grey), grey.w);
    }
    const vec4 color = with_effects(sample_color(t, p, to_eye), focus_at(p));
    const real alpha = correction == Correction::none ? color.w : this->corrected_opacity(color.w, ratio);
    return this->under(gathered, this->associated(vec3(color), alpha));
  }

  /// The nearest cutting plane on the ray within the interval, which ends there, and its opaque colour.
  vec4 stop_at_plane(const SharedFunctions::PixelRay& ray, vec2& interval) const {
    vec4 color(0);
    for (const CutPlane& plane : planes) {
      const real s = -signed_value(plane.place, ray.origin) / dot(plane.place.normal, ray.direction);
      const vec3 t = data_point(ray.origin + s * ray.direction);
      const bool inside = all(greaterThanEqual(t, vec3(0))) && all(lessThanEqual(t, vec3(1)));
      const bool warped = is_warped(prepared);
      if (!(s >= interval.x && s <= interval.y) || (warped && !inside))
        continue;
      const real value = displayed_value(t);
      const real shade = plane.grey.x * value + plane.grey.y;
      if (!plane.classified && shade < 0) // below black
        continue;
      interval.y = s;
      const vec3 grey(std::min(shade, 1.0));
      color = vec4(plane.classified ? vec3(evaluate(prepared.transfer, value)) : grey, 1);
    }
    return color;
  }

  /// Mode `two-level`, run by run.
  vec4 trace_objects(const SharedFunctions::PixelRay& ray, std::int64_t first, std::int64_t last, real offset,
                     vec3 to_eye, real stop) {
    TwoLevel state = this->nothing_gathered();
    for (std::int64_t k = first; k <= last; ++k) {
      const real s = (static_cast<real>(k) + 0.5 + offset) * prepared.spacing;
      state = gather_objects(state, ray.origin + s * ray.direction, to_eye);
      if (stop < 1 && state.gathered.w >= stop)
        break;
    }
    return this->ended_run(state, prepared.xray_scale).gathered;
  }

  /// (x, y) in [−1, 1]², y up; `offset` of the samples, in Δ.
  vec4 trace(const SharedFunctions::RayFrame& frame, bool perspective, real x, real y, real offset) {
    const SharedFunctions::PixelRay ray = this->ray_from_pixel(frame, perspective, x, y);
    vec2 interval = this->hit_box(ray, prepared.object_low, prepared.object_high);
    const vec4 behind = planes.empty() ? vec4(0) : stop_at_plane(ray, interval);
    const auto cut = [&](const Plane& plane) {
      interval = this->clip_interval(interval, ray, vec4(plane.normal, -plane.offset));
    };
    std::for_each(prepared.object_clip.begin(), prepared.object_clip.end(), cut);
    if (!is_warped(prepared))
      std::for_each(prepared.data_clip.begin(), prepared.data_clip.end(), cut);
    const Mode mode = prepared.scene.render.mode;
    const bool mip = classifies_last(mode);
    const real nothing = -std::numeric_limits<real>::infinity();
    vec4 gathered(0);
    if (mip && mode != Mode::average)
      gathered = volumes.empty() ? vec4(nothing, 0, 0, 0) : vec4(nothing);
    if (interval.x > interval.y)
      return behind;
    const vec3 to_eye = perspective ? -normalize(dmat3(prepared.box.world_from_texture) * ray.direction)
                                    : -prepared.view.forward;
    const real delta = prepared.spacing;
    half_step = 0.5 * delta * ray.direction;
    const auto first = static_cast<std::int64_t>(this->first_sample(interval.x - offset * delta, delta));
    const auto last = static_cast<std::int64_t>(this->last_sample(interval.y - offset * delta, delta));
    if (mode == Mode::iso)
      return first_surface(ray, first, last, offset, to_eye);
    const real stop = composites(mode) ? prepared.scene.render.early_termination : 2;
    if (has_local_modes(prepared.labels))
      return trace_objects(ray, first, last, offset, to_eye, stop);
    for (std::int64_t k = first; k <= last; ++k) {
      gathered = gather(gathered,
                        ray.origin + ((static_cast<real>(k) + 0.5 + offset) * delta) * ray.direction, to_eye);
      if (stop < 1 && gathered.w >= stop)
        break;
    }
    if (!mip)
      return planes.empty() ? gathered : this->under(gathered, behind);
    if (!volumes.empty())
      return classified_maxima(gathered);
    if (gathered.w == 0)
      return vec4(0);
    const real shown = mode == Mode::average ? gathered.x / gathered.w : sign() * gathered.x;
    const vec4 color = with_effects(evaluate(prepared.transfer, shown),
                                    mode == Mode::average ? vec2(1, 0) : vec2(gathered.y, gathered.z));
    return this->associated(vec3(color), color.w);
  }
};

template <class T>
class TypedSampler : public VolumeSampler {
public:
  TypedSampler(const PreparedScene& scene, std::size_t index, const SmoothCopy* smooth)
      : tracer_(volume_at(scene, index), nullptr, smooth), own_from_first_(own_from_first(scene, index)),
        length_ratio_(length_ratio(scene, index)) {}

  vec4 color(vec3 first, vec3 to_eye) override {
    const vec3 p(own_from_first_ * vec4(first, 1));
    const vec3 t = tracer_.data_point(p);
    return tracer_.shows_data(t) ? corrected(tracer_.sample_color(t, p, to_eye)) : vec4(0);
  }
  real extreme(vec3 first) override {
    const vec3 t = tracer_.data_point(vec3(own_from_first_ * vec4(first, 1)));
    return tracer_.shows_data(t) ? tracer_.sign() * tracer_.displayed_value(t)
                                 : -std::numeric_limits<real>::infinity();
  }
  vec4 classified(real extreme) const override {
    return std::isfinite(extreme) ? corrected(evaluate(tracer_.prepared.transfer, tracer_.sign() * extreme))
                                  : vec4(0);
  }

private:
  vec4 corrected(vec4 color) const {
    SharedFunctions shared;
    return vec4(vec3(color), shared.corrected_opacity(color.w, length_ratio_));
  }

  Tracer<T> tracer_;
  dmat4 own_from_first_;
  real length_ratio_;
};

SharedFunctions::RayFrame shared_frame(const PreparedScene& prepared) {
  const RayFrameValues values = ray_frame(prepared);
  return {values.center,     values.forward,     values.right, values.up,
          values.half_width, values.half_height, values.anchor};
}

/// The Gaussian copy, where gradients are taken from one.
template <class T>
std::optional<SmoothCopy> smooth_voxels(const PreparedScene& prepared) {
  const RenderSettings& render = prepared.scene.render;
  if (!uses_gradients(prepared.scene) || render.gradient != Gradient::prefiltered)
    return std::nullopt;
  const Tracer<T> voxels(prepared, nullptr, nullptr);
  const auto dims = reduced_dims(prepared.volume.dims, reduction_of(render.gradient_resolution));
  return smooth_copy(voxels.dims, ivec3(dims[0], dims[1], dims[2]), render.gradient_sigma,
                     [&](int i, int j, int k) { return voxels.voxel_value(i, j, k); });
}

/// Of each of several volumes.
std::vector<std::optional<SmoothCopy>> smooth_copies(const PreparedScene& prepared) {
  std::vector<std::optional<SmoothCopy>> copies;
  for (std::size_t i = 0; i < volume_count(prepared) && !prepared.others.empty(); ++i) {
    const PreparedScene& volume = volume_at(prepared, i);
    visit_scalar_type(volume.volume.type, [&](auto* tag) {
      copies.push_back(smooth_voxels<std::remove_pointer_t<decltype(tag)>>(volume));
    });
  }
  return copies;
}

/// One sampler for each of several volumes, for one thread.
VolumeSamplers make_samplers(const PreparedScene& prepared,
                             const std::vector<std::optional<SmoothCopy>>& copies) {
  VolumeSamplers samplers;
  for (std::size_t i = 0; i < copies.size(); ++i) {
    visit_scalar_type(volume_at(prepared, i).volume.type, [&](auto* tag) {
      using T = std::remove_pointer_t<decltype(tag)>;
      samplers.push_back(std::make_unique<TypedSampler<T>>(prepared, i, copies[i] ? &*copies[i] : nullptr));
    });
  }
  return samplers;
}

/// Of the samples of a pixel, in Δ; y from the top.
real pixel_shift(const PreparedScene& prepared, int x, int y) {
  const RenderSettings& render = prepared.scene.render;
  if (render.jitter == 0)
    return 0;
  return render.jitter * SharedFunctions().pixel_offset(static_cast<uint>(x),
                                                        static_cast<uint>(prepared.view.height - 1 - y),
                                                        static_cast<uint>(render.jitter_seed));
}

template <class T>
void trace_all(const PreparedScene& prepared, Image& image, const Progress& progress) {
  const View& view = prepared.view;
  const SharedFunctions::RayFrame frame = shared_frame(prepared);
  std::vector<std::byte> classified;
  if (prepared.scene.render.classification == Classification::pre)
    classified = classify_voxels(prepared);
  const std::byte* colors = classified.empty() ? nullptr : classified.data();
  const std::optional<SmoothCopy> smooth = smooth_voxels<T>(prepared);
  const std::vector<std::optional<SmoothCopy>> copies = smooth_copies(prepared);
  std::atomic<int> done = 0;
  std::mutex reporting;
  tbb::parallel_for(0, view.height, [&](int y) {
    Tracer<T> tracer(prepared, colors, smooth ? &*smooth : nullptr);
    tracer.volumes = make_samplers(prepared, copies);
    for (int x = 0; x < view.width; ++x) {
      const vec4 color =
          tracer.trace(frame, view.projection == Projection::perspective, 2 * (x + 0.5) / view.width - 1,
                       1 - 2 * (y + 0.5) / view.height, pixel_shift(prepared, x, y));
      for (int c = 0; c < 4; ++c)
        channel(image, x, y, c) = static_cast<float>(color[c]);
    }
    const int rows = ++done;
    if (progress.advance && rows % 16 == 0) {
      const std::lock_guard lock(reporting);
      report_progress(progress, "draw", static_cast<double>(rows) / view.height);
    }
  });
}

} // namespace

Image render_reference(const PreparedScene& prepared, const Progress& progress) {
  check_sample_count(prepared);
  for (std::size_t i = 0; i < volume_count(prepared); ++i)
    require_voxels(volume_at(prepared, i).volume, "pipeline 'reference'");
  Image image = make_image(prepared.view.width, prepared.view.height);
  visit_scalar_type(prepared.volume.type, [&](auto* tag) {
    trace_all<std::remove_pointer_t<decltype(tag)>>(prepared, image, progress);
  });
  return image;
}

} // namespace slicelens
