#include <render/gl_backends.h>
#include <render/shared_library.h>

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <opened_libraries.h>

#include <initializer_list>
#include <stdexcept>
#include <vector>

namespace mobbscope {

namespace {

class EglContext final : public GlContext {
  public:
    EglContext() {
        const auto get_display = reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(get_("eglGetPlatformDisplayEXT"));
        if (!get_display) throw std::runtime_error("it knows no platforms");
        display_ = get_display(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr);
        if (display_ == EGL_NO_DISPLAY ||
            !call<decltype(&eglInitialize)>("eglInitialize")(display_, nullptr, nullptr)) {
            throw std::runtime_error("it has no surfaceless display");
        }
        if (!call<decltype(&eglBindAPI)>("eglBindAPI")(EGL_OPENGL_API)) throw std::runtime_error("it has no OpenGL");
        // Only debug contexts must report errors; before EGL 1.5 there is no such attribute.
        context_ = create({EGL_CONTEXT_OPENGL_DEBUG, EGL_TRUE});
        if (context_ == EGL_NO_CONTEXT) context_ = create({});
        if (context_ == EGL_NO_CONTEXT) throw std::runtime_error("it makes no OpenGL 3.3 core context");
    }
    ~EglContext() override {
        // The display stays initialised: it is shared by all contexts of the process.
        make_current_(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        destroy_(display_, context_);
    }

    std::string_view name() const override { return "egl"; }

  private:
    EGLContext create(std::initializer_list<EGLint> more) const {
        std::vector<EGLint> attributes{EGL_CONTEXT_MAJOR_VERSION,       3,
                                       EGL_CONTEXT_MINOR_VERSION,       3,
                                       EGL_CONTEXT_OPENGL_PROFILE_MASK, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT};
        attributes.insert(attributes.end(), more);
        attributes.push_back(EGL_NONE);
        // No config: there is no surface whose pixels it would describe (EGL_KHR_no_config_context).
        return call<decltype(&eglCreateContext)>("eglCreateContext")(display_, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT,
                                                                     attributes.data());
    }
    bool bind() noexcept override { return make_current_(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_); }
    Function function(const char* name) const noexcept override { return get_(name); }

    template <class F>
    F call(const char* name) const {
        return library_.function<F>(name);
    }

    SharedLibrary library_{egl_libraries()};
    decltype(&eglGetProcAddress) get_ = call<decltype(&eglGetProcAddress)>("eglGetProcAddress");
    decltype(&eglMakeCurrent) make_current_ = call<decltype(&eglMakeCurrent)>("eglMakeCurrent");
    decltype(&eglDestroyContext) destroy_ = call<decltype(&eglDestroyContext)>("eglDestroyContext");
    EGLDisplay display_ = EGL_NO_DISPLAY;
    EGLContext context_ = EGL_NO_CONTEXT;
};

}  // namespace

std::unique_ptr<GlContext> open_egl() { return std::make_unique<EglContext>(); }

}  // namespace mobbscope
