#include <render/gl/gl_context.h>

#include <base/error.h>

#include <glad/gl.h>

#include <utility>

namespace mobbscope {

namespace {

/// The context that glad's functions, which are global, were taken from.
const GlContext* loaded = nullptr;

void GLAD_API_PTR on_message(GLenum /*source*/, GLenum type, GLuint /*id*/, GLenum /*severity*/, GLsizei /*length*/,
                             const GLchar* message, const void* context) {
    if (type != GL_DEBUG_TYPE_ERROR) return;
    static_cast<GlContext*>(const_cast<void*>(context))->complain(message);
}

/// What the current context says of itself; empty if nothing.
std::string gl_string(GLenum name) {
    const GLubyte* text = glGetString(name);
    return text ? reinterpret_cast<const char*>(text) : "";
}

}  // namespace

GlContext::~GlContext() {
    if (loaded == this) loaded = nullptr;
}

bool GlContext::try_make_current() noexcept {
    if (!bind()) return false;
    if (loaded == this) return true;
    const auto load = [](void* context, const char* name) -> GLADapiproc {
        return static_cast<GlContext*>(context)->function(name);
    };
    loaded = nullptr;
    if (!gladLoadGLUserPtr(load, this) || !GLAD_GL_VERSION_3_3) return false;
    loaded = this;
    device_ = gl_string(GL_RENDERER);
    version_ = gl_string(GL_VERSION);
    policy_ = DrawingPolicy::of(device_);
    if (GLAD_GL_KHR_debug) {
        glEnable(GL_DEBUG_OUTPUT);
        if (policy_.errors_at_once) glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
        glDebugMessageCallback(on_message, this);
    }
    return true;
}

void GlContext::make_current() {
    if (!try_make_current()) throw MachineError("its OpenGL 3.3 context cannot be made current");
}

void GlContext::check(std::string_view doing) {
    std::vector<std::string> told;
    {
        const std::lock_guard lock(telling_);
        told.swap(complaints_);
    }
    // The driver says more than the number, but it may be late, or silent.
    const bool silent = told.empty();
    for (GLenum error = glGetError(); error != GL_NO_ERROR; error = glGetError()) {
        if (silent) told.push_back("OpenGL error " + std::to_string(error));
    }
    if (told.empty()) return;
    std::string text;
    for (const std::string& error : told) text += (text.empty() ? "" : "; ") + error;
    throw MachineError(std::string(name()) + ", " + std::string(doing) + ": " + text);
}

void GlContext::complain(std::string message) {
    const std::lock_guard lock(telling_);
    complaints_.push_back(std::move(message));
}

}  // namespace mobbscope
