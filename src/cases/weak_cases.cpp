#include <base/error.h>
#include <base/file.h>
#include <base/text.h>
#include <cases/weak_cases.h>
#include <render/image/image_diff.h>
#include <render/image/png.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>

namespace mobbscope::picture_tests {

namespace {

// A case that lets more pass than this is weak.
constexpr double kMostPixels = 0.1;      // share of those compared
constexpr double kMostLevels = 64;       // of 255
constexpr double kLeastCompared = 0.01;  // share of the picture

std::string percent(double share) { return figure(100 * share, 3) + " %"; }

/// The pixels that a mask leaves.
std::int64_t compared(const Image& mask) {
    std::int64_t count = 0;
    for (int y = 0; y < mask.height; ++y) {
        for (int x = 0; x < mask.width; ++x) count += is_compared(&mask, x, y) ? 1 : 0;
    }
    return count;
}

/// Adds how little is left to see of the golden's pixels.
void add_pixel_weaknesses(const CaseFile& file, const CaseTerms& terms, std::vector<std::string>& out) {
    double share = terms.diff.pixel_fraction;
    try {
        const PictureSize size = png_size(read_file(file.golden()), file.golden().string());
        std::int64_t pixels = std::int64_t{size.width} * size.height;
        if (terms.mask) {
            const std::int64_t left = compared(read_mask(*terms.mask, size, file.golden()));
            const double compared = static_cast<double>(left) / static_cast<double>(pixels);
            if (compared < kLeastCompared) out.push_back("\"mask\" leaves " + percent(compared) + " of its pixels");
            pixels = left;
        }
        share = static_cast<double>(terms.diff.allowed(pixels)) / static_cast<double>(pixels);
    } catch (const InputError&) {
        // There is no golden yet, or the mask does not fit it.
    }
    if (share > kMostPixels)
        out.push_back("\"allowed\" lets " + percent(std::min(share, 1.0)) + " of its pixels differ");
}

using Keys = std::map<std::string, nlohmann::json>;

Keys keys_of(const std::string& text) {
    Keys out;
    const nlohmann::json root = nlohmann::json::parse(text);
    for (const auto& [key, value] : root.items()) out.emplace(key, value);
    return out;
}

/// "\"scene\", \"skip\"": what stands in one of them alone, or otherwise.
std::string changed_keys(const Keys& before, const Keys& now) {
    std::string out;
    Keys all = before;
    all.insert(now.begin(), now.end());
    for (const auto& [key, value] : all) {
        const auto was = before.find(key), is = now.find(key);
        if (was == before.end() || is == now.end() || was->second != is->second)
            out += (out.empty() ? "\"" : ", \"") + cleaned(key) + '"';
    }
    return out;
}

/// What the second lets pass and the first does not.
std::vector<std::string> weakened(const CaseTerms& before, const CaseTerms& now) {
    std::vector<std::string> out;
    if (now.skip && !before.skip) out.push_back("it is skipped: " + *now.skip);
    for (const Held held : before.hold) {
        if (!now.holds(held)) out.push_back("it no longer holds \"" + std::string(name(held)) + '"');
    }
    const DiffOptions &was = before.diff, &is = now.diff;
    const auto larger = [&out](const char* what, double from, double to) {
        if (to > from) out.push_back(std::string(what) + " grows from " + brief(from) + " to " + brief(to));
    };
    larger("\"threshold\"", was.channel_tolerance, is.channel_tolerance);
    larger("what the mean of a tile may be off", was.tile_tolerance, is.tile_tolerance);
    larger("the share of pixels in \"allowed\"", was.pixel_fraction, is.pixel_fraction);
    larger("the number of pixels in \"allowed\"", static_cast<double>(was.least_pixels),
           static_cast<double>(is.least_pixels));
    larger("how far aside a pixel may lie", was.shift, is.shift);
    if (now.mask && now.mask != before.mask)
        out.push_back("only what the mask " + in_quotes(now.mask->filename().string()) + " leaves is compared");
    if (before.state && !now.state) out.push_back("\"state\" is held no longer");
    return out;
}

const GoldenChange* brought(const CaseResult& result) {
    const auto found = std::ranges::find(result.fresh, result.file.file, &GoldenChange::file);
    return found == result.fresh.end() ? nullptr : &*found;
}

}  // namespace

std::vector<std::string> weaknesses(const CaseFile& file, const CaseTerms& terms) {
    std::vector<std::string> out;
    if (terms.skip) out.push_back("it is skipped: " + *terms.skip);
    if (!terms.holds(Held::picture)) return out;
    add_pixel_weaknesses(file, terms, out);
    if (terms.diff.channel_tolerance > kMostLevels)
        out.push_back("\"threshold\" lets a channel be off by " + brief(terms.diff.channel_tolerance) + " of 255");
    return out;
}

bool brings_case(const CaseResult& result) {
    const GoldenChange* const change = brought(result);
    return change && golden_bytes(change->file) != change->bytes;
}

std::vector<std::string> words_on_brought_case(const CaseResult& result) {
    const GoldenChange* const change = brought(result);
    const std::string file = result.file.file.string();
    if (!change->bytes) throw InputError(file, "", "the report would remove the case itself; remove it by hand");
    const CaseTerms now = read_terms(result.file, change->bytes);
    const std::optional<std::string> before = golden_bytes(result.file.file);
    std::vector<std::string> out{file + " is the case itself, no golden: "}, weaker;
    if (before) {
        std::string changed;
        try {
            weaker = weakened(read_terms(result.file, before), now);
            changed = changed_keys(keys_of(*before), keys_of(*change->bytes));
        } catch (const InputError&) {
            // What is there is no case: nothing is known of it.
        }
        out.front() += changed.empty() ? "written otherwise" : "other " + changed;
    } else {
        weaker = weaknesses(result.file, now);
        out.front() += "a new one";
    }
    for (const std::string& how : weaker) out.push_back(file + " is weaker: " + how);
    return out;
}

}  // namespace mobbscope::picture_tests
