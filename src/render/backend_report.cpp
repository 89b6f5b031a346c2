#include <render/backend_report.h>
#include <render/gl_backends.h>

#include <glad/gl.h>

#include <stdexcept>

namespace mobbscope {

namespace {

std::string gl_string(GLenum name) {
    const GLubyte* text = glGetString(name);
    return text ? reinterpret_cast<const char*>(text) : "";
}

BackendReport report(const char* name, std::unique_ptr<GlContext> (*open)()) {
    BackendReport out;
    out.name = name;
    try {
        const std::unique_ptr<GlContext> context = open();
        context->make_current();
        out.version = gl_string(GL_VERSION);
        out.renderer = gl_string(GL_RENDERER);
        out.works = true;
    } catch (const std::runtime_error& error) {
        out.why_not = error.what();
    }
    return out;
}

}  // namespace

std::vector<BackendReport> report_backends() { return {report("osmesa", open_osmesa), report("egl", open_egl)}; }

}  // namespace mobbscope
