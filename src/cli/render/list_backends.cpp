#include <base/error.h>
#include <base/json_writer.h>
#include <base/text.h>
#include <cli/program.h>
#include <cli/render/list_backends.h>
#include <render/gl/backends.h>

#include <algorithm>
#include <iostream>
#include <vector>

namespace mobbscope::cli {

namespace {

void print_words(const std::vector<BackendReport>& backends) {
    for (const BackendReport& backend : backends) {
        std::cout << backend.name << ": "
                  << cleaned(backend.works ? "OpenGL " + backend.version + ", " + backend.renderer
                                           : "not here: " + backend.why_not)
                  << '\n';
    }
}

void print_backends_json(const std::vector<BackendReport>& backends) {
    JsonWriter json(std::cout);
    json.begin_object();
    json.key("backends");
    json.begin_array();
    for (const BackendReport& backend : backends) {
        json.begin_object();
        json.member("name", backend.name);
        json.member("works", backend.works);
        if (backend.works) {
            json.member("version", backend.version);
            json.member("renderer", backend.renderer);
        } else {
            json.member("why_not", backend.why_not);
        }
        json.end_object();
    }
    json.end_array();
    json.end_object();
}

}  // namespace

void list_backends(bool json) {
    const std::vector<BackendReport> backends = report_backends();
    json ? print_backends_json(backends) : print_words(backends);
    flush_results();
    const bool any = std::any_of(backends.begin(), backends.end(), [](const BackendReport& b) { return b.works; });
    if (!any) throw MachineError("no OpenGL 3.3 context without a display; see above which libraries were tried");
}

}  // namespace mobbscope::cli
