#include <app/panels/query_parts.h>
#include <app/ui/swatch.h>
#include <app/ui/widgets.h>
#include <explain/query_findings.h>
#include <explain/query_sentence.h>

namespace mobbscope::app {

namespace {

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
    ImGui::SameLine(0, ui.px(8));
}

void expectation(Ui& ui) {
    const auto index = static_cast<std::size_t>(*ui.session.view().query);
    const SceneQuery query = ui.session.fitted().queries()[index];
    if (query.expect) {
        const auto wrong = disagreement(query, ui.session.answer_of(index));
        if (!wrong) {
            words(ui.style.quiet, "As the scene expects.");
            return;
        }
        words(ui.style.warning, "Not as the scene expects: " + *wrong);
    }
    query_button(ui, query.expect ? "Expect this instead" : "Expect this answer", "query.expect");
}

void contact_rows(Ui& ui, const QueryFindings& findings, const mobb::Contact& contact) {
    number_row(ui, "Contact at", with_unit(contact.time, "s"), contact.time, "s");
    number_row(ui, ("Sample of " + findings.sides[0].label).c_str(), std::to_string(contact.a_sample), contact.a_sample,
               "");
    number_row(ui, ("Sample of " + findings.sides[1].label).c_str(), std::to_string(contact.b_sample), contact.b_sample,
               "");
    number_row(ui, "Distance", with_unit(contact.distance, "m"), contact.distance, "m");
    number_row(ui, "Sum of radii", with_unit(contact.radii, "m"), contact.radii, "m");
    number_row(ui, "How deep", with_unit(contact.radii - contact.distance, "m"), contact.radii - contact.distance, "m");
}

}  // namespace

void query_answer(Ui& ui, const QueryFindings& findings) {
    const bool collide = findings.clearance.contact.has_value();
    const EventMark mark = collide ? EventMark::hit : EventMark::separated;
    framed(ui, mark_color(ui.style, mark, 0.10f), mark_color(ui.style, mark), [&] {
        ImGui::PushFont(ui.style.title);
        answer_sign(ui, collide, mark_color(ui.style, mark));
        words(mark_text(ui.style, mark), answer_words(findings.sides, findings.clearance));
        ImGui::PopFont();
        for (const std::string& sentence : why_words(findings.sides, findings.clearance, findings.floor)) {
            words(ui.style.text, sentence);
        }
    });
    ui.mark("query.answer");
    if (const auto& contact = ui.session.recorded()->contact) {
        contact_rows(ui, findings, *contact);
        query_button(ui, "Go to contact", "go.contact");
    }
    expectation(ui);
}

}  // namespace mobbscope::app
