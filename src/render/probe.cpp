#include "render/probe.h"

#include "core/errors.h"
#include "gl/check.h"
#include "gl/state.h"
#include "gl/target.h"
#include "render/gpu_scene.h"
#include "render/pages.h"
#include "render/several_volumes.h"
#include "render/shaders.h"
#include "render/uniforms.h"

#include <algorithm>
#include <cmath>

namespace slicelens {

namespace {

/// The part of [near, far] in a half-space; near > far for nothing.
void cut(Interval& interval, const Plane& plane, const Ray& ray) {
  const double value = signed_value(plane, ray.origin);
  const double slope = glm::dot(plane.normal, ray.direction);
  if (slope > 0)
    interval.near = std::max(interval.near, -value / slope);
  else if (slope < 0)
    interval.far = std::min(interval.far, -value / slope);
  else if (value < 0)
    interval.far = interval.near - 1;
}

gl::Program probe_program(const gl::Functions& gl, const PreparedScene& prepared, bool place) {
  std::vector<std::string> macros = common_macros(prepared);
  if (place)
    macros.emplace_back("PROBE_PLACE");
  if (!uses_gradients(prepared.scene)) { // else gradients are those of the shading
    macros.emplace_back("GRADIENTS");
    macros.emplace_back("GRADIENT_CENTRAL");
    if (prepared.gradient_space == GradientSpace::object)
      macros.emplace_back("GRADIENT_IN_OBJECT_SPACE");
  }
  std::vector<gl::ShaderSource> stages = shader_stage(GL_VERTEX_SHADER, "probe.vert", {});
  const auto fragment = shader_stage(GL_FRAGMENT_SHADER, "probe.frag", macros, generated_files(prepared));
  stages.insert(stages.end(), fragment.begin(), fragment.end());
  return gl::make_program(gl, stages);
}

/// One row of pixels for the line, all four channels.
std::vector<float> rasterise(const gl::Functions& gl, const PreparedScene& prepared, const GpuScene& scene,
                             const ProbeLine& line, int count, bool place) {
  const gl::Program program = probe_program(gl, prepared, place);
  const gl::Target target = gl::make_target(gl, count, 1, GL_RGBA32F);
  const gl::VertexArray no_vertices = gl::make_vertex_array(gl);
  {
    const gl::StateGuard guard(gl);
    gl::bind_target(gl, target);
    for (const GLenum off : {GL_BLEND, GL_DEPTH_TEST, GL_CULL_FACE, GL_DITHER})
      gl.Disable(off);
    gl.ClearColor(0, 0, 0, 0);
    gl.Clear(GL_COLOR_BUFFER_BIT);
    gl.UseProgram(program.name());
    set_common_uniforms(gl, program, prepared, scene);
    set_uniform(gl, program, "line_begin", glm::vec3(line.begin));
    set_uniform(gl, program, "line_end", glm::vec3(line.end));
    set_uniform(gl, program, "line_row", 0.0F);
    gl.BindVertexArray(no_vertices.name());
    gl.DrawArrays(GL_LINES, 0, 2);
    gl::check_errors(gl, "probing a line");
  }
  return gl::read_pixels(gl, target);
}

} // namespace

std::optional<ProbeLine> probe_line(const PreparedScene& prepared, double x, double y) {
  const Ray world = ray_from_pixel(prepared.view, x, y);
  const glm::dmat4 to_texture = texture_from_world(prepared.box);
  const Ray ray{glm::dvec3(to_texture * glm::dvec4(world.origin, 1)),
                glm::dmat3(to_texture) * world.direction};
  Interval interval{-1e300, 1e300};
  if (prepared.view.projection == Projection::perspective)
    interval.near = 0;
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 normal(0);
    normal[axis] = 1;
    cut(interval, {normal, prepared.object_low[axis]}, ray);
    cut(interval, {-normal, -prepared.object_high[axis]}, ray);
  }
  for (const Plane& plane : prepared.object_clip)
    cut(interval, plane, ray);
  if (!is_warped(prepared)) {
    for (const Plane& plane : prepared.data_clip)
      cut(interval, plane, ray);
  }
  if (!(interval.near < interval.far))
    return std::nullopt;
  return ProbeLine{ray.origin + interval.near * ray.direction, ray.origin + interval.far * ray.direction,
                   interval.near, interval.far};
}

int probe_sample_count(const PreparedScene& prepared, const ProbeLine& line) {
  const double wanted = std::ceil(4 * (line.far - line.near) / prepared.spacing);
  return static_cast<int>(std::clamp(wanted, 64.0, static_cast<double>(max_probe_samples)));
}

std::vector<ProbeSample> sample_line(const PreparedScene& prepared, const gl::Context& context,
                                     const ProbeLine& line, int count) {
  if (!prepared.volume.colors.rgba.empty())
    throw UsageError("a volume of colours has no values to pick; choose one component with volume.component");
  if (is_paged(prepared))
    throw UsageError(
        "picking holds the volume in one texture, and render.memory is too small for it; raise it");
  const gl::Functions& gl = context.functions();
  const GpuScene scene = upload(gl, prepared, {});
  const std::vector<float> places = rasterise(gl, prepared, scene, line, count, true);
  const std::vector<float> values = rasterise(gl, prepared, scene, line, count, false);
  std::vector<ProbeSample> samples;
  for (int k = 0; k < count; ++k) {
    const auto at = [&](const std::vector<float>& row, int c) {
      return static_cast<double>(row[static_cast<std::size_t>(4 * k + c)]);
    };
    const double s = (k + 0.5) / count;
    ProbeSample sample;
    sample.distance = glm::mix(line.near, line.far, s);
    sample.object = glm::mix(line.begin, line.end, s);
    sample.texture = {at(places, 0), at(places, 1), at(places, 2)};
    sample.inside = at(places, 3) > 0.5;
    if (sample.inside) {
      sample.value = at(values, 0);
      sample.opacity = at(values, 1);
      sample.gradient = at(values, 2);
    }
    samples.push_back(sample);
  }
  return samples;
}

std::optional<std::size_t> first_visible(const std::vector<ProbeSample>& samples) {
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (samples[i].inside && samples[i].opacity > 0)
      return i;
  }
  return std::nullopt;
}

std::optional<std::size_t> first_gradient(const std::vector<ProbeSample>& samples, double threshold) {
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (samples[i].inside && samples[i].gradient >= threshold)
      return i;
  }
  return std::nullopt;
}

std::optional<std::size_t> first_accumulated(const std::vector<ProbeSample>& samples, double ratio) {
  double sum = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    sum += samples[i].inside ? samples[i].opacity * ratio : 0;
    if (sum >= 1)
      return i;
  }
  return std::nullopt;
}

double gradient_threshold(const PreparedScene& prepared) {
  const Volume& volume = prepared.volume;
  return prepared.scene.pick.gradient.value_or(0.1 * (volume.max - volume.min) / smallest_spacing(volume));
}

} // namespace slicelens
