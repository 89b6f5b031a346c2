#include <render/gl_context.h>

#include <import/error.h>
#include <render/gl_backends.h>

#include <glad/gl.h>

#include <stdexcept>

namespace mobbscope {

namespace {

void GLAD_API_PTR on_message(GLenum /*source*/, GLenum type, GLuint /*id*/, GLenum /*severity*/, GLsizei /*length*/,
                             const GLchar* message, const void* context) {
    if (type != GL_DEBUG_TYPE_ERROR) return;
    static_cast<GlContext*>(const_cast<void*>(context))->complain(message);
}

}  // namespace

std::optional<Backend> backend_from_name(std::string_view name) {
    if (name == "auto") return Backend::automatic;
    if (name == "osmesa") return Backend::osmesa;
    if (name == "egl") return Backend::egl;
    return std::nullopt;
}

std::unique_ptr<GlContext> GlContext::open(Backend backend) {
    std::string reasons;
    const auto attempt = [&](const char* name, std::unique_ptr<GlContext> (*opener)()) -> std::unique_ptr<GlContext> {
        try {
            std::unique_ptr<GlContext> context = opener();
            context->make_current();
            return context;
        } catch (const std::runtime_error& error) {
            reasons += (reasons.empty() ? "" : "; ") + std::string(name) + ": " + error.what();
            return nullptr;
        }
    };
    if (backend != Backend::egl) {
        if (auto context = attempt("osmesa", open_osmesa)) return context;
    }
    if (backend != Backend::osmesa) {
        if (auto context = attempt("egl", open_egl)) return context;
    }
    throw MachineError("no OpenGL 3.3 context without a display (" + reasons + ")");
}

void GlContext::make_current() {
    bind();
    // glad's functions are global, so they follow whichever context is current.
    const auto load = [](void* context, const char* name) -> GLADapiproc {
        return static_cast<GlContext*>(context)->function(name);
    };
    if (!gladLoadGLUserPtr(load, this) || !GLAD_GL_VERSION_3_3) {
        throw std::runtime_error("its functions are older than OpenGL 3.3");
    }
    if (GLAD_GL_KHR_debug) {
        glEnable(GL_DEBUG_OUTPUT);
        glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
        glDebugMessageCallback(on_message, this);
    }
}

void GlContext::check(std::string_view doing) {
    // Without KHR_debug the plain error flag still tells that something went wrong.
    for (GLenum error = glGetError(); error != GL_NO_ERROR; error = glGetError()) {
        if (!GLAD_GL_KHR_debug) complain("OpenGL error " + std::to_string(error));
    }
    if (complaints_.empty()) return;
    std::string text;
    for (const std::string& complaint : complaints_) text += (text.empty() ? "" : "; ") + complaint;
    complaints_.clear();
    throw MachineError(std::string(name()) + ", " + std::string(doing) + ": " + text);
}

}  // namespace mobbscope
