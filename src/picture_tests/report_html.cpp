#include <base/base64.h>
#include <base/markup.h>
#include <base/text.h>
#include <cases/case_report.h>
#include <picture_tests/reports.h>
#include <render/image/png.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <vector>

namespace report_assets {
std::string_view embedded(std::string_view name);
}

namespace mobbscope::picture_tests {

namespace {

using Results = std::vector<const CaseResult*>;

Results of(std::span<const CaseResult> results, CaseOutcome outcome) {
    Results out;
    for (const CaseResult& result : results) {
        if (result.outcome == outcome) out.push_back(&result);
    }
    return out;
}

std::string headline(const RunFacts& facts, const Summary& sum, std::size_t cases) {
    const std::string all = counted(static_cast<long long>(cases), "picture test", "picture tests");
    if (!sum.ok()) return std::to_string(sum.bad()) + " of " + all + " did not pass";
    if (facts.strict && !facts.orphans.empty()) {
        return counted(facts.orphans.size(), "golden has", "goldens have") + " no case";
    }
    const int passed = sum[CaseOutcome::passed], skipped = sum[CaseOutcome::skipped];
    if (passed == 0) return "No picture was compared";
    return counted(passed, "picture test", "picture tests") + " passed" +
           (skipped > 0 ? ", " + std::to_string(skipped) + " skipped" : "");
}

std::string badge(CaseOutcome outcome) {
    const OutcomeWords& words = words_of(outcome);
    std::ostringstream out;
    out << "<span class=\"badge " << words.kind << "\">" << words.mark << ' ' << words.badge << "</span>";
    return out.str();
}

void write_fact(std::ostream& out, const char* what, std::string_view text) {
    out << "<dt>" << what << "</dt><dd>" << escaped(text) << "</dd>\n";
}

/// A line for a shell, with a button that copies it.
void write_command(std::ostream& out, std::string_view purpose, const std::string& command) {
    out << "<p class=\"command\">" << purpose << " <code>" << escaped(command)
        << "</code> <button type=\"button\" class=\"copy\" hidden>Copy</button></p>\n";
}

/// `png`: the bytes of a PNG file.
void write_image(std::ostream& out, std::string_view png, const std::string& what) {
    const PictureSize size = png_size(png, what);
    out << "<img width=\"" << size.width << "\" height=\"" << size.height << "\" alt=\"" << escaped(what)
        << "\" src=\"data:image/png;base64," << base64(png) << "\">";
}

void write_figure(std::ostream& out, const char* kind, const char* title, std::string_view png, const std::string& name,
                  const std::optional<PixelRect>& bounds = {}) {
    const PictureSize size = png_size(png, name);
    out << "<figure class=\"" << kind << "\"><figcaption>" << title << " <small>" << size_text(size)
        << "</small></figcaption><div class=\"paper\">";
    write_image(out, png, std::string(title) + ": " + name);
    if (bounds) {
        out << "<svg viewBox=\"0 0 " << size.width << ' ' << size.height << "\" aria-hidden=\"true\"><rect x=\""
            << bounds->x << "\" y=\"" << bounds->y << "\" width=\"" << bounds->width << "\" height=\"" << bounds->height
            << "\"/></svg>";
    }
    out << "</div></figure>\n";
}

/// Ways to look at two pictures; without scripts they stand side by side.
void write_modes(std::ostream& out) {
    out << "<div class=\"modes\" role=\"group\" aria-label=\"How to compare\" hidden>"
        << "<button type=\"button\" data-mode=\"side\" aria-pressed=\"true\">Side by side <kbd>1</kbd></button>"
        << "<button type=\"button\" data-mode=\"blink\" aria-pressed=\"false\">Blink <kbd>2</kbd></button>"
        << "<button type=\"button\" data-mode=\"slide\" aria-pressed=\"false\">Slide <kbd>3</kbd></button>"
        << "<button type=\"button\" class=\"swap\" hidden>Swap by hand <kbd>S</kbd></button>"
        << "<label class=\"slider\" hidden>Actual <input type=\"range\" min=\"0\" max=\"100\" value=\"50\"> "
           "Golden</label></div>\n";
}

/// How many pixels differ by how much; the bars' lengths grow with the logarithm, so that a single pixel is seen.
void write_histogram(std::ostream& out, const ImageDiff& diff, double tolerance) {
    constexpr std::array<std::pair<int, int>, 8> kRows{
        {{0, 0}, {1, 3}, {4, 8}, {9, 16}, {17, 32}, {33, 64}, {65, 128}, {129, 255}}};
    out << "<table class=\"histogram\"><caption>Pixels by their difference</caption><tbody>\n";
    for (const auto& [first, last] : kRows) {
        std::int64_t count = 0;
        for (int i = first; i <= last; ++i) count += diff.histogram[static_cast<std::size_t>(i)];
        const double length = std::log1p(static_cast<double>(count)) / std::log1p(static_cast<double>(diff.pixels));
        out << "<tr" << (first > tolerance ? " class=\"beyond\"" : "") << "><th scope=\"row\">" << first;
        if (last > first) out << "–" << last;
        out << "</th><td><svg width=\"120\" height=\"10\" aria-hidden=\"true\"><rect width=\""
            << std::lround(120 * length) << "\" height=\"10\"/></svg></td><td class=\"number\">" << count
            << "</td></tr>\n";
    }
    out << "</tbody></table>\n";
}

void write_numbers(std::ostream& out, const CaseResult& result) {
    const ImageDiff& diff = *result.image;
    const DiffOptions& allowed = result.image->options;
    out << "<div class=\"numbers\"><dl>\n<dt>Failing pixels</dt><dd>" << diff.differing << " of " << diff.pixels << ", "
        << brief(100 * diff.fraction()) << " %</dd>\n<dt>Allowed</dt><dd>" << diff.allowed() << " beyond "
        << brief(allowed.channel_tolerance) << " of 255 (" << name(result.tolerance) << ")</dd>\n<dt>Maximum</dt><dd>"
        << diff.largest << " of 255</dd>\n<dt>Mean</dt><dd>" << brief(diff.mean) << " of 255</dd>\n<dt>Where</dt><dd>";
    if (diff.bounds) {
        out << diff.bounds->width << " x " << diff.bounds->height << " pixels at (" << diff.bounds->x << ", "
            << diff.bounds->y << ")";
    } else {
        out << "nowhere";
    }
    out << "</dd>\n</dl>\n";
    write_histogram(out, diff, allowed.channel_tolerance);
    out << "</div>\n";
}

/// The pictures of one case are unpacked at a time.
void write_pictures(std::ostream& out, const CaseResult& result) {
    const bool has_actual = !result.actual.empty();
    const bool has_golden = !result.golden.empty();
    if (!has_actual && !has_golden) return;
    const std::string& name = result.file.name;
    if (has_actual && has_golden) write_modes(out);
    out << "<div class=\"pictures\" data-mode=\"side\">\n";
    if (has_golden) write_figure(out, "golden", "Golden", result.golden, name);
    if (has_actual) write_figure(out, "actual", "Actual", result.actual, name);
    if (const std::optional<Image> heat = heat_map(result)) {
        write_figure(out, "difference", "Difference", png_bytes(*heat), name, result.image->bounds);
    }
    out << "</div>\n";
    if (result.image && result.image->same_size) write_numbers(out, result);
}

void write_lines(std::ostream& out, const std::vector<std::string>& lines) {
    if (lines.empty()) return;
    out << "<ul>\n";
    for (const std::string& line : lines) out << "<li>" << escaped(line) << "</li>\n";
    out << "</ul>\n";
}

void write_case(std::ostream& out, const RunFacts& facts, const CaseResult& result, std::size_t number) {
    out << "<section class=\"case\" id=\"case" << number << "\" tabindex=\"-1\">\n<h2>" << badge(result.outcome) << ' '
        << escaped(result.file.name) << "</h2>\n<p class=\"message\">" << escaped(result.message) << "</p>\n";
    for (const Finding& finding : result.findings) {
        if (finding.words.size() > 1) write_lines(out, finding.words);
    }
    write_lines(out, result.remarks);
    write_pictures(out, result);
    if (can_be_taken(result)) {
        const std::string_view names[] = {result.file.name};
        write_command(out, if_right(result), update_command(facts, names));
        if (!facts.page.empty()) write_command(out, "or, from this page:", accept_command(facts, names));
    }
    out << "</section>\n";
}

/// Pixels beyond the tolerance, for sorting; of what was not compared more than any picture has.
std::string sort_keys(const CaseResult& result) {
    const bool compared = result.image && result.image->same_size;
    std::ostringstream out;
    out << " data-name=\"" << escaped(result.file.name) << "\" data-pixels=\""
        << (compared ? std::to_string(result.image->differing) : "1e15") << "\" data-largest=\""
        << (compared ? result.image->largest : 255) << '"';
    return out.str();
}

/// Sort what follows, if there are scripts.
void write_orders(std::ostream& out) {
    out << "<div class=\"orders\" role=\"group\" aria-label=\"Order\" hidden>Sort by "
        << "<button type=\"button\" data-by=\"name\" aria-pressed=\"true\">name</button> "
        << "<button type=\"button\" data-by=\"pixels\" aria-pressed=\"false\">pixels that differ</button></div>\n";
}

/// "412 pixels, up to 87 of 255"; of a picture that is its golden's, nothing.
std::string how_much(const CaseResult& result) {
    if (!result.image || !result.image->same_size || result.image->same) return "";
    const ImageDiff& diff = *result.image;
    const std::string far = ", up to " + std::to_string(diff.largest) + " of 255";
    if (diff.differing > 0) return counted(diff.differing, "pixel", "pixels") + far;
    return counted(diff.unequal, "pixel", "pixels") + " within the tolerance" + far;
}

void write_contents(std::ostream& out, const Results& open) {
    if (open.size() < 2) return;
    out << "<nav aria-label=\"Cases that did not pass\">\n";
    write_orders(out);
    out << "<ol class=\"sorted\">\n";
    for (std::size_t i = 0; i < open.size(); ++i) {
        out << "<li" << sort_keys(*open[i]) << '>' << badge(open[i]->outcome) << " <a href=\"#case" << i << "\">"
            << escaped(open[i]->file.name) << "</a> <small>" << how_much(*open[i]) << "</small></li>\n";
    }
    out << "</ol></nav>\n";
}

void write_header(std::ostream& out, const RunFacts& facts, std::span<const CaseResult> results, const Results& open) {
    const Summary sum = summary(results);
    out << "<header>\n<h1>" << headline(facts, sum, results.size()) << "</h1>\n<dl class=\"facts\">\n";
    write_fact(out, "Result", sum_of(sum));
    write_fact(out, "Folder", facts.folder);
    if (!facts.shard.empty()) write_fact(out, "Shard", facts.shard);
    write_fact(out, "Drawn by", drawn_by(facts, results));
    for (const std::string& sentence : other_systems(results)) write_fact(out, "Other system", sentence);
    if (const std::string passed = differing_passes(results); !passed.empty()) write_fact(out, "Passed", passed);
    for (const std::string& orphan : facts.orphans) write_fact(out, "No case has", orphan);
    out << "</dl>\n";
    write_contents(out, open);
    std::vector<std::string_view> names;
    for (const CaseResult* result : open) {
        if (can_be_taken(*result)) names.push_back(result->file.name);
    }
    if (names.size() > 1) {
        const bool pictures = std::ranges::none_of(open, [](const CaseResult* one) { return draws_nothing(*one); });
        write_command(out, pictures ? "If all of these pictures are right:" : "If all of this is right:",
                      update_command(facts, names));
        if (!facts.page.empty()) write_command(out, "or, from this page:", accept_command(facts, {}));
    }
    if (!open.empty()) {
        out << "<p class=\"keys\" hidden><kbd>J</kbd> next case, <kbd>K</kbd> the one before; <kbd>1</kbd> side by "
               "side, <kbd>2</kbd> blink, <kbd>3</kbd> slide; <kbd>S</kbd> swaps while blinking</p>\n";
    }
    out << "</header>\n";
}

void write_passed(std::ostream& out, const Results& passed) {
    if (passed.empty()) return;
    out << "<details class=\"passed\"><summary>" << badge(CaseOutcome::passed) << ' ' << passed.size()
        << "</summary>\n";
    write_orders(out);
    out << "<div class=\"thumbnails sorted\">\n";
    for (const CaseResult* result : passed) {
        out << "<figure" << sort_keys(*result) << '>';
        if (!result->actual.empty()) {
            out << "<button type=\"button\" class=\"thumbnail\" aria-pressed=\"false\">";
            write_image(out, result->actual, result->file.name);
            out << "</button>";
        }
        out << "<figcaption>" << escaped(result->file.name) << "<small>" << how_much(*result) << "</small>";
        for (const std::string& remark : result->remarks) out << "<small>" << escaped(remark) << "</small>";
        out << "</figcaption></figure>\n";
    }
    out << "</div></details>\n";
}

void write_skipped(std::ostream& out, const Results& skipped) {
    if (skipped.empty()) return;
    out << "<details class=\"skipped\"><summary>" << badge(CaseOutcome::skipped) << ' ' << skipped.size()
        << "</summary>\n<dl>\n";
    for (const CaseResult* result : skipped) {
        out << "<dt>" << escaped(result->file.name) << "</dt><dd>" << escaped(result->message) << "</dd>\n";
    }
    out << "</dl></details>\n";
}

}  // namespace

void write_html(std::ostream& out, const RunFacts& facts, std::span<const CaseResult> results) {
    Results open = of(results, CaseOutcome::failed);
    for (const CaseOutcome outcome : {CaseOutcome::different, CaseOutcome::missing_golden}) {
        const Results more = of(results, outcome);
        open.insert(open.end(), more.begin(), more.end());
    }
    // The policy keeps a browser from loading anything, whatever a name in the page holds.
    out << "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
        << "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; "
           "style-src 'unsafe-inline'; script-src 'unsafe-inline'\">\n"
        << "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
        << "<meta name=\"color-scheme\" content=\"light dark\">\n<title>"
        << headline(facts, summary(results), results.size()) << " - " << escaped(facts.folder) << "</title>\n<style>\n"
        << report_assets::embedded("report.css") << "</style>\n</head>\n<body>\n";
    write_header(out, facts, results, open);
    out << "<main>\n";
    for (std::size_t i = 0; i < open.size(); ++i) write_case(out, facts, *open[i], i);
    write_skipped(out, of(results, CaseOutcome::skipped));
    write_passed(out, of(results, CaseOutcome::passed));
    out << "</main>\n" << kReportBegins;
    write_case_report(out, results);
    out << kReportEnds << "\n<script>\n" << report_assets::embedded("report.js") << "</script>\n</body>\n</html>\n";
}

}  // namespace mobbscope::picture_tests
