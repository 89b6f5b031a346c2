#include <app/commands/command.h>
#include <app/ui/widgets.h>
#include <base/sentences.h>
#include <base/text.h>
#include <review/review_panels.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace mobbscope::app {

using picture_tests::CaseOutcome;

namespace {

std::string headline_of(const ReviewCase& one) { return one.accepted ? "Accepted" : as_sentence(outcome_word(one)); }

/// Of one that passed, whether the picture is the very golden.
std::string passed_sentence(const ReviewCase& one) {
    if (draws_nothing(one.result)) return "All that it holds is as its goldens say.";
    const auto& figures = one.result.image;
    if (!figures || figures->largest == 0) return "The picture is the golden's.";
    if (figures->differing == 0)
        return "No pixel differs by more than " + std::to_string(figures->largest) + " of 255.";
    return counted(figures->differing, "pixel differs", "pixels differ") + ", by up to " +
           std::to_string(figures->largest) + " of 255" +
           (figures->passes ? ": no more than may." : "; see the remarks.");
}

/// What it comes to, in a sentence.
std::string sentence_of(const Review& review, const ReviewCase& one) {
    if (one.state == ReviewCase::State::waiting) return "It is being drawn.";
    if (!one.drawn()) {
        return review.output().empty()
                   ? "It was not drawn yet."
                   : "It is not in " + review.output().string() + ": it passed there, or was not run.";
    }
    if (one.accepted) {
        return std::string(draws_nothing(one.result) ? "Its goldens are replaced; undo brings the old ones back."
                                                     : "The picture is the golden now; undo brings the old one back.") +
               (stays_different(one.result) ? " The scene still expects another answer." : "");
    }
    if (one.outcome() == CaseOutcome::passed) return passed_sentence(one);
    if (one.outcome() == CaseOutcome::failed || one.outcome() == CaseOutcome::skipped) return one.result.message;
    // All of it stands below.
    std::string out;
    for (const picture_tests::Finding& finding : one.result.findings) {
        const std::string file = finding.golden.filename().string();
        std::error_code ignored;
        const bool numbers = finding.golden.extension() == ".json";
        const auto& figures = one.result.image;
        out += out.empty() ? "" : " ";
        if (one.outcome() == CaseOutcome::missing_golden && !std::filesystem::exists(finding.golden, ignored)) {
            out += "There is no " + file + ".";
        } else if (finding.golden.empty()) {
            out += "An answer is not the one that the scene expects.";
        } else if (numbers) {
            out += "The numbers of " + file + " differ.";
        } else if (figures && figures->differing > 0) {
            out += counted(figures->differing, "pixel", "pixels") + " of " + file + " differ, by up to " +
                   std::to_string(figures->largest) + " of 255.";
        } else if (figures && !figures->same_size) {
            out += file + " has another size.";
        } else {
            out += finding.message + ".";
        }
    }
    return out.empty() ? one.result.message : out;
}

void outcome_frame(Ui& ui, const Review& review, const ReviewCase& one) {
    const ImU32 color = outcome_color(ui.style, one);
    ImVec4 fill = ImGui::ColorConvertU32ToFloat4(color);
    fill.w = 0.1f;
    framed(ui, ImGui::ColorConvertFloat4ToU32(fill), color, [&] {
        const float side = ui.px(14);
        const ImVec2 at = ImGui::GetCursorScreenPos();
        const float height = ui.style.title->FontSize;
        outcome_shape(*ImGui::GetWindowDrawList(), ui.style, {at.x + side / 2, at.y + height / 2}, side, one);
        ImGui::Dummy({side, height});
        ImGui::SameLine();
        text_line(color, headline_of(one), ui.style.title);
        ui.mark("review.outcome");
        words(ui.style.text, sentence_of(review, one));
    });
}

void actions(Ui& ui, const Review& review) {
    ImGui::Dummy({0, ui.px(2)});
    struct Button {
        const char* label;
        const char* command;
    };
    std::vector<Button> buttons{{"Accept", "review.accept"},
                                {"Undo", "review.undo"},
                                {"Next failing", "review.next_failing"},
                                {"Draw again", "review.draw"},
                                {"Open as scene", "review.open"}};
    const std::string marked = "Accept " + std::to_string(review.marked().size()) + " marked";
    if (!review.marked().empty()) buttons.push_back({marked.c_str(), "review.accept_marked"});
    for (std::size_t i = 0; i < buttons.size(); ++i) {
        if (i > 0) flow(button_width(buttons[i].label));
        command_button(ui, buttons[i].label, buttons[i].command, buttons[i].command);
    }
    const ReviewCase& one = review.shown();
    const std::string why = review.why_not_accept(review.current());
    if (one.failing() && !why.empty()) words(ui.style.quiet, "It cannot be accepted: " + why + ".");
}

// --- the pixel under the mouse

/// "12  34  56 255" of a picture; a dash beside it.
std::string channels_at(const std::shared_ptr<const Image>& image, const std::optional<glm::ivec2>& pixel) {
    if (!image || !pixel || pixel->x >= image->width || pixel->y >= image->height) return "-";
    const std::uint8_t* at = image->at(pixel->x, pixel->y);
    return formatted("%3d %3d %3d %3d", at[0], at[1], at[2], at[3]);
}

std::string difference_at(const ReviewPictures& pictures, const std::optional<glm::ivec2>& pixel) {
    const auto& a = pictures.golden;
    const auto& b = pictures.actual;
    const auto inside = [&](const auto& image) {
        return image && pixel && pixel->x < image->width && pixel->y < image->height;
    };
    if (!inside(a) || !inside(b)) return "-";
    const std::uint8_t* before = a->at(pixel->x, pixel->y);
    const std::uint8_t* after = b->at(pixel->x, pixel->y);
    return formatted("%+3d %+3d %+3d %+3d", after[0] - before[0], after[1] - before[1], after[2] - before[2],
                     after[3] - before[3]);
}

/// A label, and at `right` the end of a text; below the label where both have no room.
void labelled(Ui& ui, const char* label, const std::string& text, float right) {
    text_line(ui.style.quiet, label);
    const float x = right - text_size(*ui.style.mono, text).x;
    const float label_end = ImGui::GetItemRectMax().x - ImGui::GetWindowPos().x + ImGui::GetScrollX();
    if (x > label_end + ui.px(8)) {
        ImGui::SameLine(x);
    } else {
        ImGui::SetCursorPosX(std::max(x, ImGui::GetCursorPosX()));
    }
    text_line(ui.style.text, text, ui.style.mono);
}

void pixel_row(Ui& ui, const char* label, const std::string& numbers, const std::shared_ptr<const Image>* image,
               const std::optional<glm::ivec2>& pixel) {
    const float side = ui.px(12);
    const float right = ImGui::GetWindowContentRegionMax().x;
    labelled(ui, label, numbers, right - side - ui.px(8));
    ImGui::SameLine(right - side);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::Dummy({side, ImGui::GetTextLineHeight()});
    if (!image || !*image || !pixel || pixel->x >= (*image)->width || pixel->y >= (*image)->height) return;
    const std::uint8_t* rgba = (*image)->at(pixel->x, pixel->y);
    const float y = at.y + (ImGui::GetTextLineHeight() - side) / 2;
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.AddRectFilled({at.x, y}, {at.x + side, y + side}, IM_COL32(rgba[0], rgba[1], rgba[2], rgba[3]), ui.px(2));
    draw.AddRect({at.x, y}, {at.x + side, y + side}, ui.style.border, ui.px(2));
}

void pixel_section(Ui& ui, const ReviewPictures& pictures, const std::optional<glm::ivec2>& pixel) {
    heading(ui, "PIXEL UNDER THE MOUSE", pixel ? std::to_string(pixel->x) + ", " + std::to_string(pixel->y) : "none");
    pixel_row(ui, "golden", channels_at(pictures.golden, pixel), &pictures.golden, pixel);
    pixel_row(ui, "actual", channels_at(pictures.actual, pixel), &pictures.actual, pixel);
    pixel_row(ui, "difference", difference_at(pictures, pixel), &pictures.difference, pixel);
}

// --- what differs

void findings(Ui& ui, const ReviewCase& one, const ReviewPictures& pictures) {
    // Of a case without a picture they stand in the middle.
    if (draws_nothing(one.result)) return;
    bool has_heading = false;
    for (const picture_tests::Finding& finding : one.accepted ? unmended(one.result) : one.result.findings) {
        // Its pixels are told already, or that there is none.
        const bool has_pixels = pictures.diff || !pictures.golden;
        if (has_pixels && finding.golden == pictures.golden_file) continue;
        if (!std::exchange(has_heading, true)) heading(ui, "WHAT DIFFERS BESIDES");
        const std::string of = finding.golden.empty() ? "scene" : finding.golden.filename().string();
        text_line(ui.style.text, of);
        ui.mark("finding." + of);
        ImGui::Indent(ui.px(10));
        if (finding.words.empty()) words(ui.style.quiet, finding.message);
        for (const std::string& line : finding.words) words(ui.style.quiet, line);
        ImGui::Unindent(ui.px(10));
    }
}

/// What is to be known besides.
void remarks(Ui& ui, const ReviewCase& one) {
    if (one.accepted || one.result.remarks.empty()) return;
    heading(ui, "REMARKS");
    for (const std::string& remark : one.result.remarks) words(ui.style.quiet, remark);
}

void text_row(Ui& ui, const char* label, const std::string& text) {
    labelled(ui, label, text, ImGui::GetWindowContentRegionMax().x);
}

void numbers(Ui& ui, const ReviewCase& one, const ReviewPictures& pictures) {
    if (!pictures.diff) return;
    const ImageDiff& diff = *pictures.diff;
    heading(ui, "PIXELS", std::string(name(one.result.tolerance)) + " tolerance");
    if (!diff.same_size) {
        text_row(ui, "golden", size_text(diff.reference_size));
        text_row(ui, "actual", size_text(diff.actual_size));
        return;
    }
    text_row(ui, "size", size_text(diff.actual_size));
    text_row(ui, "differ", std::to_string(diff.differing) + " of " + std::to_string(diff.pixels));
    text_row(ui, "may differ", std::to_string(diff.allowed()));
    text_row(ui, "largest difference", std::to_string(diff.largest) + " of 255");
    text_row(ui, "counts above",
             brief(diff.options.channel_tolerance) + " of 255" + (diff.options.shift > 0 ? ", a pixel aside" : ""));
    text_row(ui, "mean of a tile", "up to " + figure(diff.tile_mean, 3) + " of 255");
    if (!diff.bounds) return;
    const PixelRect& bounds = *diff.bounds;
    text_row(ui, "within", formatted("%dx%d at %d, %d", bounds.width, bounds.height, bounds.x, bounds.y));
    command_button(ui, "Zoom to the difference", "review.zoom_to_difference", "review.zoom_to_difference");
}

/// A file's name; its tooltip is all of the path, which a click copies.
void path_of_file(Ui& ui, const char* label, const std::string& path) {
    text_line(ui.style.quiet, label);
    ImGui::SameLine(ImGui::GetWindowContentRegionMin().x + ui.px(64));
    const std::string shown = fitted_name(path, ImGui::GetContentRegionAvail().x);
    text_line(ui.style.text, shown);
    if (!ImGui::IsItemHovered()) return;
    ImGui::SetTooltip("%s\nClick to copy", path.c_str());
    if (ImGui::IsItemClicked()) ui.session.desktop->set_clipboard(path);
}

void files(Ui& ui, const Review& review, const ReviewCase& one, const ReviewPictures& pictures) {
    heading(ui, "FILES");
    path_of_file(ui, "case", one.file.file.string());
    if (!pictures.golden_file.empty()) path_of_file(ui, "golden", pictures.golden_file.string());
    for (const std::filesystem::path& golden : pictures.number_files) path_of_file(ui, "golden", golden.string());
    if (one.from_output) path_of_file(ui, "report", review.output().string());
    // "llvmpipe (LLVM 15.0.6, 256 bits)": the processor makes no difference.
    const std::string& renderer = one.result.drawn_by.renderer;
    if (one.from_output) {
        words(ui.style.quiet,
              std::string(draws_nothing(one.result) ? "What is there now is" : "The actual picture is") +
                  " the report's. Accepting takes the report's goldens byte by byte.");
    } else if (one.drawn() && draws_nothing(one.result)) {
        words(ui.style.quiet, "Answered by mobbscope test, which drew nothing.");
    } else if (one.drawn() && !one.result.drawn_by.backend.empty()) {
        words(ui.style.quiet, "Drawn by mobbscope test with " + one.result.drawn_by.backend + ", " +
                                  renderer.substr(0, renderer.find(" (")) + ".");
    }
    heading(ui, "AGAIN WITHOUT A WINDOW");
    words(ui.style.quiet, test_command_line(review.run.drawer(), review.folder(), one.file.name));
    command_button(ui, "Copy as command", "review.copy_command", "review.copy_command");
}

}  // namespace

void review_facts(Ui& ui, Review& review, const std::optional<glm::ivec2>& pixel) {
    const ReviewCase& one = review.shown();
    const ReviewPictures& pictures = review.pictures();
    heading(ui, "CASE", std::to_string(review.current() + 1) + " of " + std::to_string(review.cases().size()));
    words(ui.style.text, one.file.name);
    outcome_frame(ui, review, one);
    actions(ui, review);
    if (!draws_nothing(one.result)) pixel_section(ui, pictures, pixel);
    numbers(ui, one, pictures);
    findings(ui, one, pictures);
    remarks(ui, one);
    files(ui, review, one, pictures);
}

}  // namespace mobbscope::app
