#include <base/error.h>
#include <cases/case_result.h>
#include <render/image/png.h>

#include <algorithm>
#include <iterator>

namespace mobbscope::picture_tests {

bool draws_nothing(const CaseResult& result) {
    return result.drawn_by.backend == kDrawsNothing || lacks_opengl(result);
}

ImageDiff compared_again(const CaseResult& result, const Image& actual, const Image& golden) {
    std::optional<Image> mask;
    if (result.mask) mask = read_mask(*result.mask, {golden.width, golden.height}, result.file.golden());
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

bool can_be_taken(const CaseResult& result) {
    const bool is_no_golden = result.outcome == CaseOutcome::different || result.outcome == CaseOutcome::missing_golden;
    if (!is_no_golden) return false;
    const std::size_t kept = unmended(result).size();
    return kept == 0 || kept < result.findings.size();
}

std::vector<Finding> unmended(const CaseResult& result) {
    std::vector<Finding> out;
    std::ranges::copy_if(result.findings, std::back_inserter(out),
                         [](const Finding& finding) { return finding.golden.empty(); });
    return out;
}

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

std::string message_of(std::span<const Finding> findings) {
    std::string out;
    for (const Finding& finding : findings) out.append(out.empty() ? "" : "; ").append(finding.message);
    return out;
}

std::vector<std::string> lines_of(const CaseResult& result) {
    std::vector<std::string> out;
    for (const Finding& finding : result.findings) {
        if (finding.words.empty()) out.push_back(finding.message);
        const bool named = finding.golden.empty() || (!finding.words.empty() && finding.words[0] == finding.message);
        const std::string before = named ? "" : finding.golden.filename().string() + ": ";
        for (const std::string& line : finding.words) out.push_back(before + line);
    }
    if (out.empty()) out.push_back(result.message);
    return out;
}

std::vector<std::filesystem::path> take(CaseResult& result) {
    write_goldens(result.fresh);
    std::vector<std::filesystem::path> written;
    for (const GoldenChange& golden : result.fresh) {
        if (golden.bytes) written.push_back(golden.file);
    }
    result.fresh.clear();
    result.findings = unmended(result);
    result.remarks.clear();
    result.golden.clear();
    if (!result.actual.empty()) {
        const Image taken = read_png_bytes(result.actual);
        const DiffOptions options = result.image ? result.image->options : DiffOptions{};
        result.image = diff(taken, taken, options, nullptr, HeatMap::left_out);
    }
    result.outcome = result.findings.empty() ? CaseOutcome::passed : CaseOutcome::different;
    result.message = message_of(result.findings);
    if (lacks_opengl(result) && result.findings.empty()) {
        result.outcome = CaseOutcome::skipped;
        result.message = "the picture was not drawn: " + result.not_drawn;
    }
    return written;
}

}  // namespace mobbscope::picture_tests
