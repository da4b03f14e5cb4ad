// OSMesa: Mesa's software rasterisers drawing into ordinary memory. No display and no driver files needed.
#include "core/errors.h"
#include "gl/library.h"
#include "gl/native.h"

#include <array>

namespace slicelens::gl {
namespace {

// From GL/osmesa.h, which a machine that only builds the program need not have.
using OSMesaContext = struct osmesa_context*;
constexpr int osmesa_format = 0x22;
constexpr int osmesa_profile = 0x33;
constexpr int osmesa_core_profile = 0x34;
constexpr int osmesa_compatibility_profile = 0x35;
constexpr int osmesa_major = 0x36;
constexpr int osmesa_minor = 0x37;

// Everything is drawn into framebuffer objects, so the buffer that OSMesa asks for can be tiny.
constexpr int buffer_size = 4;

class OsmesaContext final : public NativeContext {
public:
  explicit OsmesaContext(Profile profile) {
    using Create = OSMesaContext (*)(const int*, OSMesaContext);
    const auto create = library_.function<Create>("OSMesaCreateContextAttribs");
    make_current_ = library_.function<MakeCurrent>("OSMesaMakeCurrent");
    destroy_ = library_.function<Destroy>("OSMesaDestroyContext");
    address_ = library_.function<Address>("OSMesaGetProcAddress");
    // Mesa gives the highest version it has for the profile, so 3.3 is asked for once.
    const int attributes[] = {osmesa_format,
                              GL_RGBA,
                              osmesa_profile,
                              profile == Profile::core ? osmesa_core_profile : osmesa_compatibility_profile,
                              osmesa_major,
                              3,
                              osmesa_minor,
                              3,
                              0};
    context_ = create(attributes, nullptr);
    if (context_ == nullptr)
      throw GraphicsError("OSMesa cannot create a 3.3 context of this profile");
  }
  ~OsmesaContext() override { destroy_(context_); }

  void make_current() override {
    if (make_current_(context_, buffer_.data(), GL_UNSIGNED_BYTE, buffer_size, buffer_size) == GL_FALSE)
      throw GraphicsError("OSMesaMakeCurrent failed");
  }
  void release() noexcept override { make_current_(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0); }
  AnyFunction proc_address(const char* name) const override { return address_(name); }

private:
  using MakeCurrent = GLboolean (*)(OSMesaContext, void*, GLenum, GLsizei, GLsizei);
  using Destroy = void (*)(OSMesaContext);
  using Address = AnyFunction (*)(const char*);

  Library library_{{"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"}};
  MakeCurrent make_current_ = nullptr;
  Destroy destroy_ = nullptr;
  Address address_ = nullptr;
  OSMesaContext context_ = nullptr;
  std::array<unsigned char, 4 * buffer_size * buffer_size> buffer_{};
};

} // namespace

std::unique_ptr<NativeContext> open_osmesa(Profile profile) {
  return std::make_unique<OsmesaContext>(profile);
}

} // namespace slicelens::gl
