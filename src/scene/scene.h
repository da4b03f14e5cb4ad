// The scene: everything that decides a picture, as plain values (docs/scenes.md is the contract of its keys).
#pragma once

#include "volume/transfer_2d.h"
#include "volume/volume.h"
#include "warp/focus_effects.h"
#include "warp/warp.h"

#include <glm/glm.hpp>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace slicelens {

/// Where the voxels are while they are drawn: `automatic` leaves those on disk that render.memory does not
/// hold; `stream` reads parts of the file as they are needed, which few formats allow; `cache` reads parts of
/// a copy in bricks, made once (volume/streamed.h).
enum class VolumeAccess { automatic, memory, stream, cache };

/// Section `volume`. Exactly one of `file` and `phantom` is set.
struct VolumeSettings {
  std::optional<std::string> file = std::nullopt; ///< as given; relative paths are relative to the scene file
  std::optional<std::string> phantom = std::nullopt;
  std::optional<std::array<std::size_t, 3>> size = std::nullopt; ///< phantoms and headerless raw files
  std::optional<ScalarType> type = std::nullopt;                 ///< headerless raw
  std::optional<glm::dvec3> spacing = std::nullopt;              ///< headerless raw
  std::optional<bool> big_endian = std::nullopt;       ///< headerless raw: `endian` is "little" or "big"
  std::optional<std::size_t> component = std::nullopt; ///< which one of a multi-component volume
  std::size_t frame = 0;                               ///< of a 4D file
  std::string series;                                  ///< which DICOM series of a folder
  std::optional<std::string> labels = std::nullopt;    ///< label volume: a phantom's name or a file, as given
  VolumeAccess access = VolumeAccess::automatic;
  std::optional<std::string> cache = std::nullopt; ///< file of the copy in bricks; none: in the user's cache
};

/// Section `transfer`. At most one of `preset`, `file` and `points`; none: automatic from the histogram.
struct TransferSettings {
  std::optional<std::string> preset = std::nullopt;
  std::optional<std::vector<std::array<double, 5>>> points =
      std::nullopt;                                   ///< value (data units), r, g, b, opacity in [0,1]
  std::vector<TransferShape> shapes = {};             ///< of value and gradient, instead of the others
  std::optional<std::string> file = std::nullopt;     ///< as given (scene/transfer_files.h)
  std::optional<std::string> map = std::nullopt;      ///< of a file that holds several
  std::optional<glm::dvec2> range = std::nullopt;     ///< onto which the points of a file are stretched
  std::optional<double> unit_distance = std::nullopt; ///< Δ₀, world units; none: h
  std::optional<double> window = std::nullopt;        ///< width of its values, data units; none: its own
  std::optional<double> level = std::nullopt;         ///< their middle, data units; none: its own
};

enum class ProjectionName { orthographic, perspective };

/// Section `camera`. Angles in degrees, positions in world space (LPS).
struct CameraSettings {
  std::optional<std::string> file = std::nullopt; ///< as given; excludes everything else but zoom
  double azimuth = 0;
  double elevation = 0;
  double roll = 0;
  double zoom = 1;
  ProjectionName projection = ProjectionName::orthographic;
  double view_angle = 30;
  std::optional<glm::dvec3> position = std::nullopt;
  std::optional<glm::dvec3> focal_point = std::nullopt;
  std::optional<glm::dvec3> view_up = std::nullopt;
  std::optional<double> parallel_scale = std::nullopt;
};

/// Most planes that one fragment samples.
inline constexpr std::size_t max_planes_per_pass = 4096;

enum class Pipeline { slices, tessellated, axis, fragment, grid, fixed_function, rays, reference };
/// `two_level`: a transfer function and a mode for each label (Hauser, Mroz, Bischi and Gröller 2001).
enum class Mode { dvr, mip, minip, average, xray, iso, two_level };
/// What a ray's run through one object of a two-level picture becomes.
enum class LabelMode { dvr, mip, xray };
enum class Order { back_to_front, front_to_back };
/// What slices are: planes, or under perspective shells about the eye, whose samples are those of rays.
enum class Proxy { planes, shells };
enum class OpacityCorrection { fragment, frame, none };
enum class Shading { none, diffuse, phong, tone };
/// `prefiltered`: central differences of a Gaussian copy; `precomputed`: central differences at voxels,
/// interpolated.
enum class Gradient { forward, central, prefiltered, precomputed };
/// Where differences are taken under a warp: in the data, or in the displayed volume (docs/pipeline.md).
enum class GradientSpace { data, object };
/// Of the Gaussian copy, as a share of the volume's voxels on each axis.
enum class GradientResolution { full, half, quarter };
/// Of `precomputed`: halfs, or floats with the data's value beside the gradient.
enum class GradientFormat { rgb16f, rgba32f };
/// `pre`: voxels become colours of 8 bits before they are interpolated; `preintegrated`: samples stand for
/// segments (Engel, Kraus and Ertl 2001).
enum class Classification { post, pre, preintegrated };
enum class Filter { nearest, linear, linear_exact, cubic };
/// `mip`: samples read the level of a mip pyramid that their spacing in the data asks for (docs/pipeline.md).
enum class Footprint { point, mip };
enum class Target { rgba8, rgba16f, rgba32f };
enum class VolumeTexture { automatic, r8, r16, r32f };
enum class TransferTexture { rgba8, rgba32f };
/// Which samples are left out because they cannot change the picture: none, those in cells of the volume
/// where the transfer function shows nothing, and also those behind opaque ones.
enum class Skip { none, empty, empty_and_hidden };
/// How pipeline `axis` reads its tables.
enum class AxisFilter { linear, nearest };
enum class ContextName { automatic, osmesa, egl, window };

/// Section `render`.
struct RenderSettings {
  Pipeline pipeline = Pipeline::slices; ///< in files: none means slices, or the first warp's own paper's
  Mode mode = Mode::dvr;
  std::optional<double> xray_scale = std::nullopt; ///< none: one over the box diagonal in Δ₀
  std::array<std::size_t, 2> size{512, 512};
  std::optional<double> isovalue =
      std::nullopt; ///< of mode iso, data units; none: middle of the data's range
  /// Gradient, in data units per world unit, from which on opacities are the transfer function's; below they
  /// are lowered in proportion (Levoy 1988). None: never.
  std::optional<double> modulate_by_gradient = std::nullopt;
  double jitter = 0;           ///< of the samples of each pixel along its ray, in slice distances: 0 to 1
  std::size_t jitter_seed = 1; ///< of the pixels' offsets
  double spacing = 1;          ///< in units of h
  Order order = Order::back_to_front;
  Proxy proxy = Proxy::planes;
  OpacityCorrection opacity_correction = OpacityCorrection::fragment;
  Shading shading = Shading::none;
  Gradient gradient = Gradient::central;
  std::optional<GradientSpace> gradient_space = std::nullopt;        ///< none: gradient_space_of decides
  GradientResolution gradient_resolution = GradientResolution::full; ///< of `prefiltered`
  GradientFormat gradient_texture = GradientFormat::rgb16f;          ///< of `precomputed`
  double gradient_sigma = 1; ///< of `prefiltered`: standard deviation in voxels of its copy
  Classification classification = Classification::post;
  Filter filter = Filter::linear;
  Footprint footprint = Footprint::point;
  Target target = Target::rgba32f;
  VolumeTexture volume_texture = VolumeTexture::automatic;
  TransferTexture transfer_texture = TransferTexture::rgba32f;
  std::array<std::size_t, 3> tiles{1, 1, 1}; ///< textures that the volume is held in, on each axis
  std::size_t levels = 1; ///< of a mip pyramid that a lens reads (1: full resolution only); with footprint
                          ///< `mip` the most it may have (1: as many as the picture needs)
  std::optional<std::size_t> memory = std::nullopt; ///< MiB of textures that a volume may take; none: 1024
  std::size_t brick = 32; ///< voxels along the edge of a brick, where the volume takes more
  std::optional<std::size_t> axis_texels =
      std::nullopt; ///< of each table of `axis`; none: one for each voxel
  AxisFilter axis_filter = AxisFilter::linear;
  std::size_t subdivision =
      32; ///< of `tessellated` without LaMar's own mesh: cells along a slice's longest edge
  std::array<std::size_t, 3> grid_size{32, 32, 32}; ///< nodes of `grid` on each axis
  Skip skip = Skip::none;
  std::size_t planes_per_pass = 1; ///< slices that one fragment samples; 1: as the papers draw
  double early_termination = 1;    ///< rays stop when their opacity reaches this; 1: never
  glm::dvec4 background{0, 0, 0, 1};
  ContextName context = ContextName::automatic;
};

/// Section `light`.
struct LightSettings {
  std::optional<glm::dvec3>
      direction; ///< world vector from the object towards the light; none: at the camera
  double ambient = 0.3;
  double diffuse = 0.7;
  double specular = 0.2; ///< shading `phong`, with `power`: white highlights
  double power = 10;
  glm::dvec3 cool{0, 0, 0.4};   ///< shading `tone`: added to what faces away from the light
  glm::dvec3 warm{0.4, 0.4, 0}; ///< and to what faces it
  bool two_sided = true;
};

enum class ClipSpace { texture, object };

/// One entry of `clip`: keeps the side its normal points to.
struct ClipSettings {
  glm::dvec3 point{0.5};      ///< texture coordinates
  glm::dvec3 normal{0, 1, 0}; ///< world space, any length but zero
  ClipSpace space = ClipSpace::texture;
};

/// Section `crop`: the part of the volume that is kept.
struct CropSettings {
  glm::dvec3 low{0}; ///< texture coordinates
  glm::dvec3 high{1};
  ClipSpace space = ClipSpace::texture;
};

enum class PlaneStyle { values, transfer };

/// One entry of `planes`: an opaque polygon that shows the displayed volume where it cuts it.
struct PlaneSettings {
  glm::dvec3 point{0.5};                          ///< texture coordinates of the displayed volume
  glm::dvec3 normal{0, -1, 0};                    ///< world space, any length but zero
  PlaneStyle style = PlaneStyle::values;          ///< grey, or the transfer function's colours
  std::optional<glm::dvec2> range = std::nullopt; ///< of the grey, data units; none: the data's
};

enum class Wireframe { none, segments, triangles };

/// Most letters of overlay.unit.
inline constexpr std::size_t max_unit_letters = 8;

/// Section `overlay`: lines, false colours and lettering drawn over the picture.
struct OverlaySettings {
  Wireframe wireframe = Wireframe::none;
  bool outline = false;
  std::size_t lattice = 0;  ///< cells along the longer edge; 0: none
  double magnification = 0; ///< opacity of the false colours
  double line_width = 1.5;  ///< pixels
  double stack =
      0; ///< volumes only: degrees the camera goes aside to show the slices themselves; 0: the volume
  double landmarks = 0; ///< volumes only: radius in pixels of the circles around landmarks; 0: none
  // Volumes only (render/annotations.h).
  bool legend = false;
  bool scale_bar = false;
  bool labels = false;
  std::optional<std::string> unit = std::nullopt; ///< behind lengths; none: what the format says
};

/// Section `pick`.
struct PickSettings {
  std::optional<double> gradient; ///< data units per world unit; none: a tenth of the range over h
};

/// What a volume's own coordinates in its file count from.
enum class Alignment { world, center };

/// Section `placement` of an entry of `volumes`: where a volume lies beside the first one.
struct Placement {
  Alignment align = Alignment::world; ///< as the file says, or its centre on the first volume's
  glm::dvec3 translate{0};            ///< world units
  glm::dvec3 rotate{0}; ///< degrees about the world's x, then y, then z axis, through the volume's centre
  glm::dvec3 scale{1};  ///< along the volume's own axes, about its centre

  bool operator==(const Placement&) const = default;
};

/// How the samples of several volumes become one (Brunet, Nowak and Gleicher 2006 §4.3; docs/pipeline.md).
enum class Combine { mix, sum, max, difference };

/// Most entries of `volumes`.
inline constexpr std::size_t max_volumes = 4;

/// One entry of `volumes`.
struct VolumeLayer {
  VolumeSettings volume;
  TransferSettings transfer;
  std::vector<Warp> warp; ///< in forward order
  Placement placement;
};

/// One entry of `labels`: how the voxels of one label are shown (mode `two-level`).
struct LabelSettings {
  std::size_t label = 0; ///< number in the label volume
  std::string name;      ///< for people
  LabelMode mode = LabelMode::dvr;
  std::optional<TransferSettings> transfer = std::nullopt; ///< none: the scene's own
  bool visible = true;
};

/// Most entries of `labels`: with the row of all other labels they fill a texture of 8 bits.
inline constexpr std::size_t max_labels = 255;

/// With several volumes, `volume`, `transfer`, `warp` and `placement` are those of the first one.
struct Scene {
  std::string title;
  VolumeSettings volume;
  TransferSettings transfer;
  CameraSettings camera;
  RenderSettings render;
  LightSettings light;
  std::vector<ClipSettings> clip;
  std::optional<CropSettings> crop;
  std::vector<Warp> warp; ///< in forward order (docs/pipeline.md)
  Highlight highlight;
  Attenuation attenuation;
  PickSettings pick;
  std::vector<PlaneSettings> planes; ///< not cut by `clip`
  OverlaySettings overlay;
  Placement placement;
  std::vector<VolumeLayer> others; ///< the volumes after the first
  Combine combine = Combine::mix;
  std::vector<LabelSettings> labels; ///< of volume.labels; labels that it does not name are the scene's own
};

/// How many volumes the scene shows: 1 to max_volumes.
inline std::size_t volume_count(const Scene& scene) { return 1 + scene.others.size(); }

/// Volume `index` as a scene of its own, seen and sampled as the whole; without highlight and attenuation,
/// which belong to the first one.
Scene scene_of_volume(const Scene& scene, std::size_t index);

/// Most entries of `planes`.
inline constexpr std::size_t max_planes_shown = 16;

/// Limits of render.memory, MiB, and what it is where it is not given: the largest texture that software
/// drivers make. Of render.brick, in steps of 8.
inline constexpr std::size_t default_memory = 1024;
inline constexpr std::size_t max_memory = std::size_t{1} << 20;
inline constexpr std::size_t min_brick = 16;
inline constexpr std::size_t max_brick = 128;

/// Limits of render.tiles and render.levels.
inline constexpr std::size_t max_tiles = 1024;    ///< in all
inline constexpr std::size_t min_tile_voxels = 4; ///< on each axis of a tile
inline constexpr std::size_t max_levels = 8;

/// Of render.subdivision.
inline constexpr std::size_t max_subdivision = 512;
/// Limit of render.grid_size; the upper one is max_grid_nodes.
inline constexpr std::size_t smallest_grid_size = 8;

/// Whether a pipeline blends slices (and not rays).
bool draws_slices(Pipeline pipeline);

/// Where the scene's gradients are taken: `data` without a warp and for `precomputed`; else
/// render.gradient_space; where that is not given, as the paper of the first warp did: LaMar's and Cohen's
/// warps in the data, all others in object space (Brunet, Nowak and Gleicher 2006, eq. 1).
GradientSpace gradient_space_of(const Scene& scene);

/// Whether a mode shows one value of each ray, which is classified at the end.
inline bool classifies_last(Mode mode) {
  return mode == Mode::mip || mode == Mode::minip || mode == Mode::average;
}

/// Whether opacities are composited along the ray.
inline bool composites(Mode mode) { return mode == Mode::dvr || mode == Mode::two_level; }

/// Whether samples need the gradient of what is shown.
inline bool uses_gradients(const RenderSettings& render) {
  return render.shading != Shading::none || render.modulate_by_gradient.has_value();
}
inline bool uses_gradients(const Scene& scene) {
  return uses_gradients(scene.render) || !scene.transfer.shapes.empty();
}

/// Whether the scene highlights or attenuates anything.
bool has_effects(const Scene& scene);

/// The pipeline of a scene that names none: slices, or the first warp's own paper's, or axis where there are
/// effects only.
Pipeline default_pipeline(const Scene& scene);

/// Defaults that the pipeline decides, for keys that were not given: `fixed-function` takes classification
/// pre, target rgba8 and opacity correction frame.
void use_pipeline_defaults(RenderSettings& render, bool classification_given, bool target_given,
                           bool correction_given);

/// Whether a legend, a scale bar or labels are drawn.
bool is_annotated(const OverlaySettings& overlay);

/// Throws UsageError naming the key.
void validate(const OverlaySettings& overlay);

/// Checks what single keys cannot say: alternatives given together, combinations that make no sense.
/// Throws UsageError naming the keys.
void validate(const Scene& scene);

} // namespace slicelens
