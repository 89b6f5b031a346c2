#include <base/error.h>
#include <cases/case_result.h>
#include <render/image/png.h>

namespace mobbscope::picture_tests {

bool lacks_opengl(const CaseResult& result) {
    return result.outcome == CaseOutcome::skipped && result.drawn_by.backend.empty();
}

ImageDiff compared_again(const CaseResult& result, const Image& actual, const Image& golden) {
    std::optional<Image> mask;
    if (result.mask) mask = read_mask(*result.mask, {golden.width, golden.height}, result.shown);
    return diff(actual, golden, result.image ? result.image->options : DiffOptions{}, mask ? &*mask : nullptr);
}

std::optional<Image> heat_map(const CaseResult& result) {
    if (!result.image || !result.image->same_size || result.golden.empty()) return std::nullopt;
    try {
        return compared_again(result, read_png_bytes(result.actual), read_png_bytes(result.golden)).heat;
    } catch (const InputError&) {
        return std::nullopt;  // its mask is gone meanwhile
    }
}

bool can_be_taken(CaseOutcome outcome, std::string_view other_here) {
    const bool is_no_golden = outcome == CaseOutcome::different || outcome == CaseOutcome::missing_golden;
    return is_no_golden && other_here.empty();
}

bool can_be_taken(const CaseResult& result) { return can_be_taken(result.outcome, result.other_here); }

Summary summary(std::span<const CaseResult> results) {
    Summary sum;
    for (const CaseResult& result : results) ++sum[result.outcome];
    return sum;
}

std::string sum_of(const Summary& summary) {
    std::string out;
    for (std::size_t i = 0; i < summary.counts.size(); ++i) {
        if (summary.counts[i] == 0) continue;
        out +=
            (out.empty() ? "" : ", ") + std::to_string(summary.counts[i]) + ' ' + std::string(kOutcomeWords[i].in_sum);
    }
    return out.empty() ? "no cases" : out;
}

std::vector<std::filesystem::path> take(CaseResult& result) {
    write_goldens(result.fresh);
    std::vector<std::filesystem::path> written;
    for (const GoldenChange& golden : result.fresh) {
        if (golden.bytes) written.push_back(golden.file);
    }
    result.fresh.clear();
    result.findings.clear();
    result.remarks.clear();
    result.golden.clear();
    const Image taken = read_png_bytes(result.actual);
    result.image = diff(taken, taken, result.image ? result.image->options : DiffOptions{}, nullptr, HeatMap::left_out);
    result.outcome = CaseOutcome::passed;
    result.message.clear();
    return written;
}

}  // namespace mobbscope::picture_tests
