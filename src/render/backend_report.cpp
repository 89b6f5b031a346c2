#include <render/backend_report.h>
#include <render/gl_backends.h>
#include <render/gl_objects.h>

#include <stdexcept>

namespace mobbscope {

namespace {

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
