// Scene texts, transfer functions in them included, of volumes and of pictures; what is read is written and
// read again.
#include "scene/scene_json.h"

#include "fuzz.h"
#include "scene/image_scene.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace slicelens;
  const std::string text = fuzz::text_of(data, size);
  fuzz::one_line_or_value([&] {
    const std::string first = scene_to_json(scene_from_json(text, "scene"));
    if (scene_to_json(scene_from_json(first, "written scene")) != first) {
      std::fprintf(stderr, "a scene that was written is read as another one:\n%s\n", first.c_str());
      std::abort();
    }
  });
  fuzz::one_line_or_value([&] {
    if (is_image_scene(text))
      image_scene_to_json(image_scene_from_json(text, "scene"));
  });
  // KEY=VALUE lines, as --set takes them.
  return fuzz::one_line_or_value([&] {
    const std::size_t end = text.find('\n');
    scene_from_json("{}", "scene", {parse_assignment(text.substr(0, end))});
  });
}
