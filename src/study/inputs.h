// What users name on the command line (scenes, volumes, pictures), turned into scenes and prepared data.
#pragma once

#include "core/progress.h"
#include "render/prepare.h"
#include "render/render.h"
#include "scene/scene.h"
#include "scene/scene_json.h"

#include <filesystem>
#include <future>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace slicelens {

/// A scene and where its relative paths count from.
struct SceneInput {
  Scene scene;
  std::vector<std::filesystem::path> folders; ///< places a relative volume.file is looked for in, in order
  std::string expected_sha256;                ///< of the volume file, when the scene comes from a picture
  std::string source;                         ///< what the user named
  std::map<std::string, std::string> expected_warp_sha256 =
      {}; ///< likewise, of warps' files, by metadata name
};

enum class InputKind { scene, picture, volume };

/// By extension: .json is a scene; .png, .exr, .tif … that exist as files are pictures; everything else is a
/// volume.
InputKind kind_of(const std::string& input);

/// The scene of a scene file, of a picture written by slicelens, or of a volume with every other key at its
/// default.
SceneInput scene_input(const std::string& input, const std::vector<std::string>& set);

/// A scene before it is read: text and changes, for what reads it again with more changes.
struct SceneText {
  std::string text;
  std::vector<KeyValue> changes; ///< those of --set, and the volume that was named
  SceneInput input;              ///< the scene with these changes
};

/// The same, with its text.
SceneText scene_text(const std::string& input, const std::vector<std::string>& set);

/// A scene text that is not a file, named `source` in messages.
SceneInput scene_text_input(const std::string& text, const std::string& source,
                            const std::vector<std::string>& set);

/// Starts the SHA-256 of the volume's files on a thread of its own; of several volumes one after the other,
/// separated by spaces, "-" for phantoms; an empty future where there are only phantoms. Throws FileError
/// where there are no such files.
std::future<std::string> start_hash(const SceneInput& input);

/// Reads or makes the volume and works everything out. `sha256` receives the hash of the volume's files
/// (empty for phantoms), `hashing` is one already started. Throws FileError when a hash is not the expected
/// one: of the volume, or of the files that a warp reads.
PreparedScene load(const SceneInput& input, const Progress& progress, std::string* sha256 = nullptr,
                   std::future<std::string> hashing = {});

/// For work on all voxels at once (`what`, "slicelens warp"): volumes whose volume.access is `auto` are held
/// in memory whatever render.memory says. Throws UsageError where it is `stream` or `cache`.
void hold_voxels(SceneInput& input, const std::string& what);

/// `--volume`: which one of the scene's volumes. Throws UsageError where it has fewer.
std::size_t checked_volume(const Scene& scene, int index);

/// Works out another scene with the same volumes, each read again only where its section `volume` differs.
void load_again(PreparedScene& prepared, const SceneInput& input, const Progress& progress);

/// A context that is kept for the next scene that asks for the same kind and profile.
struct OpenContext {
  std::optional<gl::Context> context;
  ContextName name = ContextName::automatic;
  gl::Profile profile = gl::Profile::core;
};

/// Opens the context that the scene asks for, where it needs one that is not open.
void open_context(OpenContext& context, const Scene& scene);

/// The same, and renders.
RenderResult render_with(OpenContext& context, const PreparedScene& prepared, const Progress& progress);

/// Stores scene, version, driver and hashes with the picture: `sha256` of the volume, and those of the files
/// that the scene's warps have read.
void add_metadata(RenderResult& result, const Scene& scene, const std::string& sha256);

} // namespace slicelens
