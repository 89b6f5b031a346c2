#include <render/gl_backends.h>
#include <render/shared_library.h>

#include <glad/gl.h>
#include <opened_libraries.h>

#include <array>
#include <stdexcept>

namespace mobbscope {

namespace {

/// The part of OSMesa's interface that is used. Declared here, as its header is in no package where OSMesa is gone.
namespace osmesa {

using Context = struct Opaque*;
using Create = Context (*)(const int* attributes, Context shared_with);
using Destroy = void (*)(Context);
using MakeCurrent = GLboolean (*)(Context, void* buffer, GLenum type, GLsizei width, GLsizei height);
using GetFunction = void (*(*)(const char* name))();

constexpr int kFormat = 0x22;
constexpr int kProfile = 0x33;
constexpr int kCoreProfile = 0x34;
constexpr int kContextMajorVersion = 0x36;
constexpr int kContextMinorVersion = 0x37;

}  // namespace osmesa

class OsmesaContext final : public GlContext {
  public:
    OsmesaContext() {
        // A compatibility profile would do as well, but core is what the shaders are written for.
        const std::array<int, 9> attributes{osmesa::kFormat,
                                            GL_RGBA,
                                            osmesa::kProfile,
                                            osmesa::kCoreProfile,
                                            osmesa::kContextMajorVersion,
                                            3,
                                            osmesa::kContextMinorVersion,
                                            3,
                                            0};
        context_ = create_(attributes.data(), nullptr);
        if (!context_) throw std::runtime_error("it makes no OpenGL 3.3 core context");
    }
    ~OsmesaContext() override { destroy_(context_); }

    std::string_view name() const override { return "osmesa"; }

  private:
    bool bind() noexcept override {
        // The buffer is never drawn to, as pictures go into our own framebuffer.
        return make_current_(context_, buffer_.data(), GL_UNSIGNED_BYTE, kSide, kSide);
    }
    Function function(const char* name) const noexcept override { return get_(name); }

    static constexpr int kSide = 8;

    SharedLibrary library_{osmesa_libraries()};
    osmesa::Create create_ = library_.function<osmesa::Create>("OSMesaCreateContextAttribs");
    osmesa::Destroy destroy_ = library_.function<osmesa::Destroy>("OSMesaDestroyContext");
    osmesa::MakeCurrent make_current_ = library_.function<osmesa::MakeCurrent>("OSMesaMakeCurrent");
    osmesa::GetFunction get_ = library_.function<osmesa::GetFunction>("OSMesaGetProcAddress");
    std::array<unsigned char, kSide * kSide * 4> buffer_{};
    osmesa::Context context_ = nullptr;
};

}  // namespace

std::unique_ptr<GlContext> open_osmesa() { return std::make_unique<OsmesaContext>(); }

}  // namespace mobbscope
