#include <render/gl/gl_context.h>

#include <base/error.h>

#include <glad/gl.h>

#include <stdexcept>

namespace mobbscope {

namespace {

/// The context that glad's functions, which are global, were taken from.
const GlContext* loaded = nullptr;

void GLAD_API_PTR on_message(GLenum /*source*/, GLenum type, GLuint /*id*/, GLenum /*severity*/, GLsizei /*length*/,
                             const GLchar* message, const void* context) {
    if (type != GL_DEBUG_TYPE_ERROR) return;
    static_cast<GlContext*>(const_cast<void*>(context))->complain(message);
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
    if (GLAD_GL_KHR_debug) {
        glEnable(GL_DEBUG_OUTPUT);
        glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
        glDebugMessageCallback(on_message, this);
    }
    return true;
}

void GlContext::make_current() {
    if (!try_make_current()) throw MachineError("its OpenGL 3.3 context cannot be made current");
}

void GlContext::check(std::string_view doing) {
    // The callback tells more than the flag, but it may be missing or switched off.
    const bool told = !complaints_.empty();
    for (GLenum error = glGetError(); error != GL_NO_ERROR; error = glGetError()) {
        if (!told) complain("OpenGL error " + std::to_string(error));
    }
    if (complaints_.empty()) return;
    std::string text;
    for (const std::string& complaint : complaints_) text += (text.empty() ? "" : "; ") + complaint;
    complaints_.clear();
    throw MachineError(std::string(name()) + ", " + std::string(doing) + ": " + text);
}

}  // namespace mobbscope
