#include <app/commands/command.h>
#include <app/panels/panels.h>
#include <app/panels/query_parts.h>
#include <app/ui/swatch.h>
#include <app/ui/widgets.h>
#include <base/sentences.h>
#include <base/text.h>
#include <explain/query_findings.h>
#include <explain/query_sentence.h>

#include <memory>
#include <vector>

namespace mobbscope::app {

namespace {

/// Which of the queries is in view, and the ways to the others.
void query_header(Ui& ui) {
    const std::size_t count = ui.workspace.fitted().queries().size();
    const std::string which = std::to_string(*ui.workspace.view().query + 1) + " / " + std::to_string(count);
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {ui.px(6), ui.px(1)});
    ImGui::AlignTextToFramePadding();
    text_line(ui.style.quiet, count == 1 ? "Query" : "Query " + which);
    if (count > 1) {
        flow(button_width("previous"));
        query_button(ui, "previous", "query.previous");
        flow(button_width("next"));
        query_button(ui, "next", "query.next");
    }
    flow(button_width("close"));
    query_button(ui, "close", "query.none");
    if (ui.workspace.in_excerpt()) {
        flow(button_width("back to the whole scene"));
        command_button(ui, "back to the whole scene", "crowd.back", "crowd.back");
    }
    ImGui::PopStyleVar();
}

constexpr float kLeastWords = 160;  // pixels at scale 1

/// Two disks, apart or one over the other: the answer without words.
void answer_sign(Ui& ui, bool collide, ImU32 color) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float r = ui.px(6);
    const float height = ImGui::GetTextLineHeight();
    const float apart = collide ? 1.1f * r : 2.6f * r;
    const float y = at.y + 0.5f * height;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddCircleFilled({at.x + r, y}, r, color);
    list.AddCircle({at.x + r + apart, y}, r, color, 0, ui.px(1.8f));
    ImGui::Dummy({2 * r + apart, height});
    // In a narrow panel the words have a line of their own.
    if (ImGui::GetContentRegionAvail().x >= ui.px(kLeastWords)) ImGui::SameLine(0, ui.px(8));
}

void expectation(Ui& ui, QueryInspector& queries, std::span<const DrawnAgent> sides) {
    const auto index = static_cast<std::size_t>(*ui.workspace.view().query);
    const SceneQuery query = ui.workspace.fitted().queries()[index];
    const auto wrong = disagreement(query, queries.answer_of(index));
    const bool traces_agree = !query.trace || queries.stored_check().agrees();
    if (wrong) words(ui.style.warning, "Not as the scene expects: " + *wrong);
    if (!traces_agree) {
        const std::string traces =
            check_words(queries.stored_check(), sides, *query.trace, ui.workspace.recorded()->trace) + '.';
        const bool answer_agrees = query.expect && !wrong;
        words(ui.style.warning,
              answer_agrees ? "The answer is as the scene expects, but " + traces : as_sentence(traces));
    }
    if (wrong || !traces_agree) ui.mark_only("query.disagrees");
    if (query.expect && !wrong && traces_agree) words(ui.style.quiet, "As the scene expects.");
    if (!query.expect || wrong)
        query_button(ui, query.expect ? "Expect this instead" : "Expect this answer", "query.expect");
    if (!traces_agree && queries.stored_check().difference) query_button(ui, "first difference", "compare.difference");
}

void contact_rows(Ui& ui, const QueryFindings& findings, const mobb::Contact& contact) {
    number_row(ui, "Contact at", with_unit(contact.time, "s"), contact.time, "s");
    number_row(ui, ("Sample of " + findings.sides[0].label).c_str(), std::to_string(contact.a_sample), contact.a_sample,
               "");
    number_row(ui, ("Sample of " + findings.sides[1].label).c_str(), std::to_string(contact.b_sample), contact.b_sample,
               "");
    number_row(ui, "Distance", with_unit(contact.distance, "m"), contact.distance, "m");
    number_row(ui, "Sum of radii", with_unit(contact.radii, "m"), contact.radii, "m");
    const mobb::PlacedClip& a = findings.sides[0].clip();
    const mobb::PlacedClip& b = findings.sides[1].clip();
    number_row(ui, "How deep", overlap_words(a, b, contact.a_sample, contact.b_sample),
               most_overlap(a, b, contact.a_sample, contact.b_sample), "m");
}

/// All that the sentences of the answer round.
std::vector<double> exact_numbers(const QueryFindings& findings) {
    std::vector<double> out;
    const auto add_piece = [&](const ClearancePiece& piece) {
        for (const double value : {piece.clearance, -piece.clearance, piece.least_at, piece.t0, piece.t1})
            out.push_back(value);
    };
    const Clearance& clearance = findings.clearance;
    if (clearance.contact) out.push_back(clearance.contact_time);
    if (clearance.least) add_piece(clearance.pieces[*clearance.least]);
    if (clearance.contact) add_piece(clearance.pieces[*clearance.contact]);
    out.push_back(findings.floor.apart);
    if (findings.floor.meeting) out.push_back(findings.floor.meeting->gap);
    for (const ProofLine& line : findings.proof.lines) {
        for (const double value : {line.gap, line.t0, line.t1, line.speed}) out.push_back(value);
    }
    return out;
}

void right_aligned(const std::string& text, float right, ImU32 color) {
    ImGui::SameLine(right - ImGui::CalcTextSize(text.c_str()).x);
    text_line(color, text);
}

/// What lists and counts are restricted to.
void focus_line(Ui& ui, const QueryFindings& findings) {
    const FocusWindow& focus = ui.workspace.look.focus;
    if (focus.is_all()) return;
    std::string text = "Focus:";
    if (focus.branch) {
        const RecursionPair& pair = findings.recursion.pairs[static_cast<std::size_t>(*focus.branch)];
        text += ' ' + node_name(findings.sides[0], pair.a) + " / " + node_name(findings.sides[1], pair.b);
    }
    if (focus.time) text += formatted(" %.2f to %.2f s", focus.time->t0, focus.time->t1);
    words(ui.style.accent, text);
    flow(button_width("everything"));
    query_button(ui, "everything", "focus.none");
}

/// What to do to see one.
void no_query(Ui& ui) {
    if (!section(ui, "QUERY")) return;
    const char* what = ui.workspace.empty() ? "Open a scene to ask whether two agents collide."
                       : ui.workspace.fitted().queries().empty()
                           ? "A query asks whether two agents ever collide. Make or add agents at the left: every "
                             "pair of them is asked by itself."
                           : "Choose a query at the left to see why the two collide, or why not.";
    words(ui.style.quiet, what);
}

}  // namespace

void query_button(Ui& ui, const char* label, const char* command) {
    const std::string id = command;
    command_button(ui, label, command, "query." + id.substr(id.find('.') + 1));
}

void query_panel(Ui& ui, QueryInspector& queries, QueryPictures& pictures) {
    const std::shared_ptr<const QueryFindings> findings = queries.findings();
    if (!findings) return no_query(ui);
    query_header(ui);
    query_answer(ui, queries, *findings, pictures.bodies);
    proof_section(ui, *findings);
    if (!findings->recursion.pairs.empty()) {
        // Above what grows and shrinks with the step: its strips stay below the mouse that clicks in them.
        const bool compares = ui.workspace.compare_with.has_value();
        if (compares) pictures.compare(ui, queries, *findings);
        focus_line(ui, *findings);
        step_transport(ui);
        current_test(ui, *findings);
        reasons(ui, queries, *findings);
        why_axes(ui, *findings);
        measured_pairs(ui, *findings);
        costliest(ui, queries, ui.session.costs, *findings);
        query_counters(ui, queries, *findings);
        if (!compares) pictures.compare(ui, queries, *findings);
        break_when(ui, queries);
        bookmarks(ui);
        pictures.stay();
        if (section(ui, "RECURSION: TIME OF A BY TIME OF B")) {
            pictures.square(ui, queries, *findings);
            recording_note(ui, "square");
            outcome_legend(ui);
        }
    }
    if (section(ui, "CLEARANCE OVER TIME")) pictures.clearance(ui, queries, *findings, ui.px(110));
}

void query_answer(Ui& ui, QueryInspector& queries, const QueryFindings& findings, QueryBodies& bodies) {
    const bool collide = findings.clearance.contact.has_value();
    const EventMark mark = collide ? EventMark::hit : EventMark::separated;
    framed(ui, mark_color(ui.style, mark, 0.10f), mark_color(ui.style, mark), [&] {
        ImGui::PushFont(ui.style.title);
        answer_sign(ui, collide, mark_color(ui.style, mark));
        const std::vector<double> exact = exact_numbers(findings);
        words(ui, mark_text(ui.style, mark), answer_words(findings.sides, findings.clearance), exact);
        ui.mark_only("query.verdict");
        ImGui::PopFont();
        for (const std::string& sentence : proof_sentences(findings)) words(ui, ui.style.text, sentence, exact);
        for (const std::string& sentence : why_words(findings.sides, findings.clearance, findings.floor))
            words(ui, ui.style.quiet, sentence, exact);
    });
    ui.mark("query.answer");
    if (const auto& contact = ui.workspace.recorded()->contact) {
        contact_rows(ui, findings, *contact);
        query_button(ui, "Go to contact", "go.contact");
    }
    bodies.show(ui, queries.findings());
    expectation(ui, queries, findings.sides);
}

void recording_note(Ui& ui, const std::string& where) {
    const mobb::Trace& trace = ui.workspace.recorded()->trace;
    if (!trace.stopped()) return;
    words(ui.style.warning, "Here " + recording_words(trace) + ".");
    ui.mark_only("query.stopped." + where);
}

void query_counters(Ui& ui, QueryInspector& queries, const QueryFindings& findings) {
    const bool whole = ui.workspace.look.focus.is_all();
    if (!section(ui, "TESTS", whole ? "" : "in the focus")) return;
    const Recursion& recursion = findings.recursion;
    const mobb::TestCounts& of_query = ui.workspace.recorded()->tests;
    FocusCounts total = queries.counts_in_all();
    // All that were made are known where recording stopped, too.
    if (whole) total.tests = of_query;
    const FocusCounts now = queries.counts_so_far();
    const float left = ImGui::GetCursorPosX();
    const float room = ImGui::GetContentRegionAvail().x;
    const float first = left + 0.68f * room;
    const float second = left + room;
    ImGui::PushFont(ui.style.caption);
    ImGui::TextUnformatted("");
    right_aligned("so far", first, ui.style.quiet);
    right_aligned("in all", second, ui.style.quiet);
    ImGui::PopFont();
    const auto row = [&](const std::string& label, std::string_view doc, std::int64_t so_far, std::int64_t in_all) {
        text_line(ui.style.quiet, label);
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", std::string(doc).c_str());
        ImGui::PushFont(ui.style.mono);
        right_aligned(std::to_string(so_far), first, ui.style.text);
        copies(ui, Ui::last_rect(), {.value = static_cast<double>(so_far), .tip = label + " so far"});
        right_aligned(std::to_string(in_all), second, ui.style.quiet);
        copies(ui, Ui::last_rect(), {.value = static_cast<double>(in_all), .tip = label + " in all"});
        ImGui::PopFont();
    };
    const auto tests = [&](const std::string& label, std::string_view doc, mobb::TestKind test) {
        row(label, doc, now.tests[test], total.tests[test]);
    };
    tests("time tests", "Do two nodes share time?", mobb::TestKind::time);
    for (const mobb::BoxKind kind : mobb::kBoxKinds) {
        const mobb::BoxInfo& box = mobb::info(kind);
        if (box.in_paper || total.tests[kind] > 0) tests(std::string(box.title) + " tests", box.test, kind);
    }
    tests("sample pairs", "Pairs of disks whose distance was measured", mobb::TestKind::samples);
    row("avoidable", "Box tests that found an overlap although one line keeps the disks apart", now.avoidable,
        total.avoidable);
    ui.mark("query.avoidable");
    if (!recursion.avoidable.all_judged()) {
        words(ui.style.warning, judged_words(recursion.avoidable));
        query_button(ui, "Judge all", "query.judge");
    }
    words(ui, ui.style.quiet, gain_words(of_query, findings.clearance));
    recording_note(ui, "counters");
}

}  // namespace mobbscope::app
