#include <base/error.h>
#include <base/threads.h>
#include <render/gl/backends.h>
#include <render/gl/driver_watch.h>
#include <render/gl/gl_context.h>
#include <render/gl/renderer.h>

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <dlfcn.h>
#include <glad/gl.h>
#include <opened_libraries.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <initializer_list>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

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
        using namespace osmesa;
        const std::array attributes{
            kFormat, int{GL_RGBA}, kProfile, kCoreProfile, kContextMajorVersion, 3, kContextMinorVersion, 3, 0};
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

/// Mesa waits for ever for threads that it could not start.
void ask_for_few_threads() {
    constexpr const char* kVariable = "LP_NUM_THREADS";
    static constexpr long kMostOfMesa = 32;
    static const bool is_done = [] {
        const char* asked = std::getenv(kVariable);
        const long wanted = asked ? std::strtol(asked, nullptr, 10) : ::sysconf(_SC_NPROCESSORS_ONLN);
        const int most = static_cast<int>(std::clamp(wanted, 0L, kMostOfMesa));
        const int startable = startable_threads(most);
        if (startable < most) ::setenv(kVariable, std::to_string(startable).c_str(), 1);
        return true;
    }();
    static_cast<void>(is_done);
}

/// A context that is current. Throws std::runtime_error saying why it cannot be had here.
template <class Context>
std::unique_ptr<GlContext> open_current() {
    ask_for_few_threads();
    ::setenv("EGL_LOG_LEVEL", "fatal", 0);  // the one line that says why there is no OpenGL is ours
    std::unique_ptr<GlContext> context = std::make_unique<Context>();
    context->make_current();
    return context;
}

struct BackendRow {
    Backend backend;
    std::string_view name;
    std::unique_ptr<GlContext> (*open)();
};
/// In the order in which they are tried.
constexpr BackendRow kBackends[] = {{Backend::osmesa, "osmesa", open_current<OsmesaContext>},
                                    {Backend::egl, "egl", open_current<EglContext>}};

}  // namespace

std::vector<BackendReport> report_backends(const std::function<void(Renderer&)>& draw) {
    constexpr std::chrono::seconds kLongest{30};  // shaders that are compiled for the first time take two
    std::vector<BackendReport> out;
    for (const BackendRow& row : kBackends) {
        BackendReport& report = out.emplace_back();
        report.name = row.name;
        const auto draw_here = [&] {
            Renderer renderer(row.open());
            draw(renderer);
            return renderer.context().version() + '\n' + renderer.context().device();
        };
        try {
            const std::string told = done_in_child(draw_here, kLongest);
            const std::size_t end = told.find('\n');
            report.version = told.substr(0, end);
            report.renderer = told.substr(end + 1);
            report.works = true;
        } catch (const std::runtime_error& error) {
            report.why_not = error.what();
        }
    }
    return out;
}

std::optional<Backend> backend_from_name(std::string_view name) {
    if (name == "auto") return Backend::automatic;
    for (const BackendRow& row : kBackends) {
        if (row.name == name) return row.backend;
    }
    return std::nullopt;
}

void compile_quickly() { ::setenv("GALLIVM_PERF", "nopt", 0); }

std::unique_ptr<GlContext> GlContext::open(Backend backend) {
    std::string reasons;
    for (std::size_t i = 0; i < std::size(kBackends); ++i) {
        const BackendRow& row = kBackends[i];
        if (backend != Backend::automatic && backend != row.backend) continue;
        if (const auto crash = go_on_watched(static_cast<int>(i), std::string(row.name), reasons)) {
            i = static_cast<std::size_t>(crash->backend);
            reasons = crash->reasons;
            continue;
        }
        try {
            return row.open();
        } catch (const std::runtime_error& error) {
            reasons += (reasons.empty() ? "" : "; ") + std::string(row.name) + ": " + error.what();
        }
    }
    throw MachineError("no OpenGL 3.3 context without a display (" + reasons + ")" + driver_advice());
}

SharedLibrary::SharedLibrary(const std::vector<std::string>& names) {
    std::string reasons;
    for (const std::string& name : names) {
        handle_ = dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL);
        if (handle_) {
            name_ = name;
            return;
        }
        reasons += (reasons.empty() ? "" : ", ") + std::string(dlerror());
    }
    throw std::runtime_error(reasons);
}

// Never closed: Mesa's libraries keep threads and exit handlers that outlive their contexts.
SharedLibrary::~SharedLibrary() = default;

void* SharedLibrary::symbol(const char* name) const {
    if (void* address = dlsym(handle_, name)) return address;
    throw std::runtime_error(name_ + " has no function " + name);
}

}  // namespace mobbscope
