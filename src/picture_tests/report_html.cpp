#include <base/base64.h>
#include <base/markup.h>
#include <base/text.h>
#include <cases/case_report.h>
#include <picture_tests/reports.h>
#include <render/image/png.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <map>
#include <sstream>
#include <vector>

namespace report_assets {
std::string_view embedded(std::string_view name);
}

namespace mobbscope::picture_tests {

namespace {

using Results = std::vector<const CaseResult*>;

/// In the order of the page.
constexpr std::array kOnPage{CaseOutcome::failed, CaseOutcome::different, CaseOutcome::missing_golden,
                             CaseOutcome::skipped, CaseOutcome::passed};

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
    if (!facts.weak.empty()) return counted(facts.weak.size(), "weakness", "weaknesses") + " of cases";
    const int passed = sum[CaseOutcome::passed], skipped = sum[CaseOutcome::skipped];
    if (passed == 0) return "No picture was compared";
    return counted(passed, "picture test", "picture tests") + " passed" +
           (skipped > 0 ? ", " + std::to_string(skipped) + " skipped" : "");
}

/// A sign that needs no colour, and words.
std::string badge(CaseOutcome outcome) {
    const OutcomeWords& words = words_of(outcome);
    std::ostringstream out;
    out << "<span class=\"badge " << words.key << "\">" << words.mark << ' ' << words.badge << "</span>";
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

/// Without scripts these are the way to take pictures.
void write_commands(std::ostream& out, const RunFacts& facts, const char* purpose,
                    std::span<const std::string_view> names, bool all) {
    out << "<details class=\"commands\"><summary>" << purpose << "</summary>\n";
    if (!facts.page.empty()) {
        write_command(out, "From this page:", accept_command(facts, all ? std::span<const std::string_view>{} : names));
    }
    write_command(out, "Drawn anew, on the system of the goldens:", update_command(facts, names));
    out << "</details>\n";
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
    // A frame along the edges of the picture says nothing.
    const bool framed = bounds && (bounds->width < 0.9 * size.width || bounds->height < 0.9 * size.height);
    out << "<figure class=\"" << kind << "\" style=\"--width: " << size.width << "; --height: " << size.height
        << "\"><figcaption>" << title << " <small>" << size_text(size) << (framed ? ", framed where pixels differ" : "")
        << "</small></figcaption><div class=\"paper\"><div class=\"sheet\">";
    write_image(out, png, std::string(title) + ": " + name);
    if (bounds) {
        out << "<svg" << (framed ? "" : " class=\"unseen\"") << " viewBox=\"0 0 " << size.width << ' ' << size.height
            << "\" aria-hidden=\"true\"><rect x=\"" << bounds->x << "\" y=\"" << bounds->y << "\" width=\""
            << bounds->width << "\" height=\"" << bounds->height << "\"/></svg>";
    }
    out << "</div></div></figure>\n";
}

/// Ways to look at pictures; without scripts they stand side by side.
void write_modes(std::ostream& out, bool has_both, bool has_difference) {
    out << "<div class=\"modes\" role=\"group\" aria-label=\"How to look\" hidden>";
    if (has_both) {
        out << "<button type=\"button\" data-mode=\"side\" aria-pressed=\"true\">Side by side <kbd>1</kbd></button>"
            << "<button type=\"button\" data-mode=\"blink\" aria-pressed=\"false\">Blink <kbd>2</kbd></button>"
            << "<button type=\"button\" data-mode=\"slide\" aria-pressed=\"false\">Slide <kbd>3</kbd></button>";
    }
    if (has_difference) {
        out << "<button type=\"button\" data-mode=\"heat\" aria-pressed=\"false\">Difference <kbd>4</kbd></button>";
    }
    out << "<button type=\"button\" class=\"enlarge\">Zoom: <span>fit</span> <kbd>Z</kbd></button>";
    if (has_both) {
        out << "<button type=\"button\" class=\"swap\" hidden>Swap by hand <kbd>S</kbd></button>"
            << "<label class=\"slider\" hidden>Golden <input type=\"range\" min=\"0\" max=\"100\" step=\"any\" "
               "value=\"50\"> Actual</label>";
    }
    out << "</div>\n";
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
    out << "<details class=\"roomy\" open><summary>Numbers</summary><div class=\"numbers\"><dl>\n"
        << "<dt>Failing pixels</dt><dd>" << diff.differing << " of " << diff.pixels << ", "
        << brief(100 * diff.fraction()) << " %</dd>\n<dt>Allowed</dt><dd>" << diff.allowed() << " beyond "
        << brief(allowed.channel_tolerance) << " of 255 (" << name(result.tolerance) << ")</dd>\n<dt>Maximum</dt><dd>"
        << diff.largest << " of 255</dd>\n<dt>Mean</dt><dd>" << brief(diff.mean)
        << " of 255</dd>\n<dt>Mean of a tile</dt><dd>up to " << figure(diff.tile_mean, 3) << ", allowed "
        << brief(allowed.tile_tolerance) << " of 255</dd>\n<dt>Where</dt><dd>";
    if (diff.bounds) {
        out << diff.bounds->width << " x " << diff.bounds->height << " pixels at (" << diff.bounds->x << ", "
            << diff.bounds->y << ")";
    } else {
        out << "nowhere";
    }
    out << "</dd>\n</dl>\n";
    write_histogram(out, diff, allowed.channel_tolerance);
    out << "</div></details>\n";
}

/// The pictures of one case are unpacked at a time.
void write_pictures(std::ostream& out, const CaseResult& result) {
    const bool has_actual = !result.actual.empty();
    const bool has_golden = !result.golden.empty();
    if (!has_actual && !has_golden) return;
    const std::string& name = result.file.name;
    if (result.image && result.image->same) {
        write_modes(out, false, false);
        out << "<div class=\"pictures\" data-mode=\"side\">\n";
        write_figure(out, "actual", "Golden and actual: the same pixels", result.actual, name);
        out << "</div>\n";
        return;
    }
    const std::optional<Image> heat = heat_map(result);
    write_modes(out, has_actual && has_golden, heat.has_value());
    out << "<div class=\"pictures\" data-mode=\"side\">\n";
    if (has_golden) write_figure(out, "golden", "Golden", result.golden, name);
    if (has_actual) write_figure(out, "actual", "Actual", result.actual, name);
    if (heat) write_figure(out, "difference", "Difference", png_bytes(*heat), name, result.image->bounds);
    out << "</div>\n";
    if (result.image && result.image->same_size) write_numbers(out, result);
}

/// Where the name of what a line is about ends; 0 where no word says so.
std::size_t end_of_subject(std::string_view line) {
    constexpr std::array<std::string_view, 6> kVerbs{": ",         " is missing", " is new",
                                                     " moved by ", " turned by ", " was "};
    bool quoted = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        // An apostrophe within a word is no quote.
        if (line[i] == '\'' && (quoted ? i + 1 == line.size() || line[i + 1] == ' ' : i == 0 || line[i - 1] == ' '))
            quoted = !quoted;
        const auto begins = [&](std::string_view verb) { return line.substr(i).starts_with(verb); };
        if (!quoted && std::ranges::any_of(kVerbs, begins)) return i;
    }
    return 0;
}

void write_lines(std::ostream& out, std::span<const std::string> lines) {
    out << "<ul>\n";
    for (const std::string& line : lines) {
        const std::size_t end = end_of_subject(line);
        out << "<li>";
        if (end > 0) out << "<strong>" << escaped(line.substr(0, end)) << "</strong>";
        out << escaped(line.substr(end)) << "</li>\n";
    }
    out << "</ul>\n";
}

/// Pictures stand near to the first lines; the others are folded.
void write_first_lines(std::ostream& out, std::span<const std::string> lines) {
    constexpr std::size_t kFirst = 4;
    if (lines.size() <= kFirst + 1) return write_lines(out, lines);
    write_lines(out, lines.first(kFirst));
    out << "<details><summary>" << lines.size() - kFirst << " more lines</summary>\n";
    write_lines(out, lines.subspan(kFirst));
    out << "</details>\n";
}

/// What a golden holds, by what follows the name of its case; without one, the scene itself says what is to be.
std::string_view kind_of_golden(const CaseFile& file, const std::filesystem::path& golden) {
    constexpr std::array<std::pair<std::string_view, std::string_view>, 7> kKinds{{{"", "What the scene expects"},
                                                                                   {".case.json", "Case"},
                                                                                   {".png", "Picture"},
                                                                                   {".state.json", "What is drawn"},
                                                                                   {".answers.json", "Answers"},
                                                                                   {".trace.json", "Trace"},
                                                                                   {".fit.json", "Fit"}}};
    const std::string ending = golden.empty() ? "" : file.ending_of(golden);
    const auto kind = std::ranges::find(kKinds, ending, [](const auto& row) { return row.first; });
    return kind == kKinds.end() ? "Golden" : kind->second;
}

void write_heading(std::ostream& out, const CaseResult& result, const std::filesystem::path& golden) {
    out << "<h3>" << kind_of_golden(result.file, golden) << " <small>" << escaped(golden.filename().string())
        << "</small></h3>\n";
}

/// What is wrong, a part for each golden.
void write_words(std::ostream& out, const CaseResult& result) {
    out << "<div class=\"words\">\n";
    if (result.findings.empty()) out << "<p class=\"message\">" << escaped(result.message) << "</p>\n";
    for (const Finding& finding : result.findings) {
        write_heading(out, result, finding.golden);
        if (finding.words.empty()) {
            out << "<p class=\"message\">" << escaped(finding.message) << "</p>\n";
        } else {
            write_first_lines(out, finding.words);
        }
    }
    out << "</div>\n";
}

void write_notes(std::ostream& out, const CaseResult& result) {
    if (result.remarks.empty()) return;
    out << "<details class=\"roomy words\" open><summary>Notes</summary>\n";
    write_lines(out, result.remarks);
    out << "</details>\n";
}

/// What the page filters and sorts by: of what could not be compared and did not pass, more pixels than pictures have.
std::string item_data(const CaseResult& result) {
    const bool compared = result.image && result.image->same_size;
    const bool unknown = !compared && result.outcome != CaseOutcome::passed;
    std::ostringstream out;
    out << " data-name=\"" << escaped(result.file.name) << "\" data-outcome=\"" << words_of(result.outcome).key
        << "\" data-pixels=\""
        << (compared  ? std::to_string(result.image->differing)
            : unknown ? "1e15"
                      : "0")
        << "\" data-largest=\""
        << (compared  ? result.image->largest
            : unknown ? 255
                      : 0)
        << '"';
    return out.str();
}

void write_case(std::ostream& out, const RunFacts& facts, const CaseResult& result, std::size_t number) {
    const std::string_view names[] = {result.file.name};
    const bool taken = can_be_taken(result);
    out << "<section class=\"case\" id=\"case" << number << "\" tabindex=\"-1\"" << item_data(result);
    if (taken) out << " data-word=\"" << escaped(shell_word(result.file.name)) << '"';
    out << ">\n<div class=\"title\"><h2>" << badge(result.outcome) << ' ' << escaped(result.file.name) << "</h2>";
    if (taken) {
        out << "<label class=\"take\" hidden><input type=\"checkbox\" autocomplete=\"off\"> Accept "
               "<kbd>A</kbd></label>";
    }
    out << "</div>\n";
    write_words(out, result);
    if (taken && stays_different(result)) {
        out << "<p class=\"message\">Accepting writes the goldens. The case passes once the scene expects this answer, "
               "too.</p>\n";
    }
    write_pictures(out, result);
    write_notes(out, result);
    if (taken) write_commands(out, facts, "Commands that accept this case", names, false);
    out << "</section>\n";
}

/// "412 pixels, up to 87 of 255"; of a picture that is its golden's, nothing.
std::string how_much(const CaseResult& result) {
    if (!result.image || !result.image->same_size || result.image->same) return "";
    const ImageDiff& diff = *result.image;
    const std::string far = ", up to " + std::to_string(diff.largest) + " of 255";
    if (diff.differing > 0) return counted(diff.differing, "pixel", "pixels") + far;
    if (diff.tile_differs()) return "the mean of a tile by " + figure(diff.tile_mean, 3) + " of 255";
    return counted(diff.unequal, "pixel", "pixels") + " within the tolerance" + far;
}

/// Each outcome as long as it has cases.
void write_outcomes(std::ostream& out, const Summary& sum) {
    out << "<div class=\"outcomes\" role=\"img\" aria-label=\"" << sum_of(sum) << "\">";
    for (const CaseOutcome outcome : kOnPage) {
        if (sum[outcome] == 0) continue;
        out << "<span class=\"" << words_of(outcome).key << "\" style=\"flex-grow: " << sum[outcome] << "\"></span>";
    }
    out << "</div>\n";
}

/// Scripts show them.
void write_tools(std::ostream& out, const Summary& sum) {
    out << "<div class=\"tools\" role=\"search\" hidden>\n<input type=\"search\" id=\"filter\" autocomplete=\"off\" "
           "aria-label=\"Filter by name and message\" placeholder=\"Filter names and messages\">\n"
        << "<div class=\"chips\" role=\"group\" aria-label=\"Outcomes that are shown\">";
    for (const CaseOutcome outcome : kOnPage) {
        if (sum[outcome] == 0) continue;
        const OutcomeWords& words = words_of(outcome);
        out << "<button type=\"button\" class=\"chip\" data-chip=\"" << words.key << "\" aria-pressed=\"true\">"
            << badge(outcome) << " <span class=\"count\">" << sum[outcome] << "</span></button>";
    }
    out << "</div>\n<div class=\"orders\" role=\"group\" aria-label=\"Order\">Sort by "
        << "<button type=\"button\" data-by=\"outcome\" aria-pressed=\"true\">outcome</button>"
        << "<button type=\"button\" data-by=\"name\" aria-pressed=\"false\">name</button>"
        << "<button type=\"button\" data-by=\"pixels\" aria-pressed=\"false\">pixels</button></div>\n"
        << "<output class=\"shown\" aria-live=\"polite\"></output>\n"
        << "<button type=\"button\" class=\"helps\">Keys <kbd>?</kbd></button>\n</div>\n";
}

void write_contents(std::ostream& out, const Results& open) {
    if (open.size() < 2) return;
    out << "<details class=\"roomy\" open><summary>" << open.size() << " did not pass</summary>\n"
        << "<nav aria-label=\"Cases that did not pass\"><ol class=\"sorted\">\n";
    for (std::size_t i = 0; i < open.size(); ++i) {
        const OutcomeWords& words = words_of(open[i]->outcome);
        out << "<li" << item_data(*open[i]) << "><span class=\"badge " << words.key << "\" title=\"" << words.badge
            << "\">" << words.mark << "</span> <a href=\"#case" << i << "\">" << escaped(open[i]->file.name)
            << "</a> <small>" << how_much(*open[i]) << "</small></li>\n";
    }
    out << "</ol></nav></details>\n";
}

void write_facts(std::ostream& out, const RunFacts& facts, std::span<const CaseResult> results) {
    out << "<details class=\"roomy\" open><summary>The run</summary>\n<dl class=\"facts\">\n";
    write_fact(out, "Result", sum_of(summary(results)));
    write_fact(out, "Folder", facts.folder);
    if (!facts.shard.empty()) write_fact(out, "Shard", facts.shard);
    if (!facts.ended.empty()) write_fact(out, "The run was", facts.ended);
    if (const std::string by = drawn_by(facts, results); !by.empty()) write_fact(out, "Drawn by", by);
    if (const std::string passed = differing_passes(results); !passed.empty()) write_fact(out, "Passed", passed);
    for (const std::string& orphan : facts.orphans) write_fact(out, "No case has", orphan);
    for (const std::string& weak : facts.weak) write_fact(out, "Weak case", weak);
    out << "</dl></details>\n";
}

void write_side(std::ostream& out, const RunFacts& facts, std::span<const CaseResult> results, const Results& open) {
    out << "<div class=\"side\">\n";
    write_contents(out, open);
    write_facts(out, facts, results);
    std::vector<std::string_view> names;
    for (const CaseResult* result : open) {
        if (can_be_taken(*result)) names.push_back(result->file.name);
    }
    if (names.size() > 1) write_commands(out, facts, "Commands that accept all", names, true);
    out << "</div>\n";
}

void write_passed(std::ostream& out, const Results& passed) {
    if (passed.empty()) return;
    out << "<details class=\"passed\"><summary>" << badge(CaseOutcome::passed) << " <span class=\"count\">"
        << passed.size() << "</span></summary>\n<div class=\"thumbnails sorted\">\n";
    for (const CaseResult* result : passed) {
        out << "<figure" << item_data(*result) << '>';
        if (!result->actual.empty()) {
            out << "<button type=\"button\" class=\"thumbnail\" aria-pressed=\"false\">";
            write_image(out, result->actual, result->file.name);
            out << "</button>";
        }
        out << "<figcaption class=\"words\">" << escaped(result->file.name) << "<small>" << how_much(*result)
            << "</small>";
        for (const std::string& remark : result->remarks) out << "<small>" << escaped(remark) << "</small>";
        out << "</figcaption></figure>\n";
    }
    out << "</div></details>\n";
}

void write_skipped(std::ostream& out, const Results& skipped) {
    if (skipped.empty()) return;
    out << "<details class=\"skipped\"><summary>" << badge(CaseOutcome::skipped) << " <span class=\"count\">"
        << skipped.size() << "</span></summary>\n<dl>\n";
    for (const CaseResult* result : skipped) {
        out << "<div" << item_data(*result) << "><dt>" << escaped(result->file.name) << "</dt><dd class=\"words\">"
            << escaped(result->message) << "</dd></div>\n";
    }
    out << "</dl></details>\n";
}

/// How many are marked, and the command that takes exactly these.
void write_decision(std::ostream& out, const RunFacts& facts) {
    const auto [before, after] = command_around_names(facts);
    out << "<aside class=\"decision\" aria-label=\"Accept\" data-before=\"" << escaped(before) << "\" data-after=\""
        << escaped(after) << "\" hidden>\n<p><output class=\"marked\" aria-live=\"polite\"></output> "
        << "<button type=\"button\" class=\"markall\">Mark all shown <kbd>Shift</kbd> <kbd>A</kbd></button> "
        << "<button type=\"button\" class=\"unmark\" hidden>Unmark all</button></p>\n"
        << "<p class=\"command\" hidden><code></code> <button type=\"button\" class=\"copy\" hidden>Copy</button></p>\n"
        << "</aside>\n";
}

void write_help(std::ostream& out) {
    constexpr std::array<std::pair<std::string_view, std::string_view>, 10> kKeys{
        {{"J K", "the next case, the one before"},
         {"1 2 3 4", "side by side, blink, slide, difference"},
         {"S", "swaps by hand while blinking"},
         {"Z", "enlarges at what differs, then again; Shift+Z goes back"},
         {"A", "marks the case to be accepted, or unmarks it"},
         {"Shift+A", "marks all that are shown"},
         {"/", "filters by words of names and messages"},
         {"Enter", "in the filter: goes to the first case"},
         {"Escape", "clears the text of the filter"},
         {"?", "these keys"}}};
    out << "<dialog id=\"keys\" aria-label=\"Keys\">\n<h2>Keys</h2>\n<dl>\n";
    for (const auto& [key, what] : kKeys) out << "<dt><kbd>" << key << "</kbd></dt><dd>" << what << "</dd>\n";
    out << "</dl>\n<p>On a picture: a click enlarges it, a drag moves it, or the line between two. All pictures of a "
           "case "
           "move together.</p>\n<p>The command takes the marked pictures from this page. Run it where the tests ran; "
           "if "
           "the page is elsewhere by now, give its path.</p>\n<button type=\"button\" class=\"closes\">Close</button>\n"
           "</dialog>\n";
}

}  // namespace

void write_html(std::ostream& out, const RunFacts& facts, std::span<const CaseResult> results) {
    Results open = of(results, CaseOutcome::failed);
    for (const CaseOutcome outcome : {CaseOutcome::different, CaseOutcome::missing_golden}) {
        const Results more = of(results, outcome);
        open.insert(open.end(), more.begin(), more.end());
    }
    const Summary sum = summary(results);
    const std::string title = headline(facts, sum, results.size());
    // The policy keeps a browser from loading anything, whatever a name in the page holds.
    out << "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
        << "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; "
           "style-src 'unsafe-inline'; script-src 'unsafe-inline'\">\n"
        << "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
        << "<meta name=\"color-scheme\" content=\"light dark\">\n<title>" << title << " - " << escaped(facts.folder)
        << "</title>\n<style>\n"
        << report_assets::embedded("report.css") << "</style>\n</head>\n<body>\n<header>\n<h1>" << title << "</h1>\n";
    write_outcomes(out, sum);
    write_tools(out, sum);
    out << "</header>\n<div class=\"columns\">\n";
    write_side(out, facts, results, open);
    out << "<main>\n<p class=\"nothing\" hidden>Nothing matches. <button type=\"button\" class=\"showall\">Show "
           "all</button></p>\n<div class=\"cases sorted\">\n";
    for (std::size_t i = 0; i < open.size(); ++i) write_case(out, facts, *open[i], i);
    out << "</div>\n";
    write_skipped(out, of(results, CaseOutcome::skipped));
    write_passed(out, of(results, CaseOutcome::passed));
    out << "</main>\n</div>\n";
    if (std::ranges::any_of(open, [](const CaseResult* result) { return can_be_taken(*result); })) {
        write_decision(out, facts);
    }
    write_help(out);
    out << kReportBegins;
    write_case_report(out, results, std::filesystem::path(facts.page).parent_path());
    out << kReportEnds << "\n<script>\n" << report_assets::embedded("report.js") << "</script>\n</body>\n</html>\n";
}

}  // namespace mobbscope::picture_tests
