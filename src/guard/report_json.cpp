#include <guard/report_words.h>
#include <guard/reports.h>
#include <render/diff_json.h>

namespace mobbscope::guard {

void write_json(std::ostream& out, const RunFacts& facts, std::span<const CaseResult> results) {
    JsonWriter json(out);
    json.begin_object();
    json.member("folder", facts.folder);
    json.member("backend", facts.backend);
    json.member("renderer", facts.renderer);
    const Summary sum = summary(results);
    json.key("summary");
    json.begin_object(JsonWriter::Layout::row);
    json.member("passed", sum.passed);
    json.member("different", sum.different);
    json.member("missing", sum.missing);
    json.member("failed", sum.failed);
    json.member("skipped", sum.skipped);
    json.end_object();
    if (const std::vector<std::string> sentences = not_compared(results); !sentences.empty()) {
        json.key("not_compared");
        json.begin_array();
        for (const std::string& sentence : sentences) json.value(sentence);
        json.end_array();
    }
    json.key("cases");
    json.begin_array();
    for (const CaseResult& result : results) {
        json.begin_object();
        json.member("name", result.file.name);
        json.member("outcome", name(result.outcome));
        json.member("message", result.message);
        json.member("seconds", result.seconds);
        json.member("tolerance", name(result.tolerance));
        json.key("diff");
        if (result.image) {
            write_diff(json, *result.image);
        } else {
            json.null();
        }
        json.end_object();
    }
    json.end_array();
    json.end_object();
}

}  // namespace mobbscope::guard
