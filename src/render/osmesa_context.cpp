#include <render/gl_backends.h>
#include <render/shared_library.h>

#include <GL/osmesa.h>
#include <opened_libraries.h>

#include <array>
#include <stdexcept>

namespace mobbscope {

namespace {

class OsmesaContext final : public GlContext {
  public:
    OsmesaContext() {
        // A compatibility profile would do as well, but core is what the shaders are written for.
        const std::array<int, 9> attributes{OSMESA_FORMAT,
                                            OSMESA_RGBA,
                                            OSMESA_PROFILE,
                                            OSMESA_CORE_PROFILE,
                                            OSMESA_CONTEXT_MAJOR_VERSION,
                                            3,
                                            OSMESA_CONTEXT_MINOR_VERSION,
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
    decltype(&OSMesaCreateContextAttribs) create_ =
        library_.function<decltype(&OSMesaCreateContextAttribs)>("OSMesaCreateContextAttribs");
    decltype(&OSMesaDestroyContext) destroy_ =
        library_.function<decltype(&OSMesaDestroyContext)>("OSMesaDestroyContext");
    decltype(&OSMesaMakeCurrent) make_current_ = library_.function<decltype(&OSMesaMakeCurrent)>("OSMesaMakeCurrent");
    decltype(&OSMesaGetProcAddress) get_ = library_.function<decltype(&OSMesaGetProcAddress)>("OSMesaGetProcAddress");
    std::array<unsigned char, kSide * kSide * 4> buffer_{};
    OSMesaContext context_ = nullptr;
};

}  // namespace

std::unique_ptr<GlContext> open_osmesa() { return std::make_unique<OsmesaContext>(); }

}  // namespace mobbscope
