#include <app/document/described.h>
#include <app/document/job.h>
#include <app/panels/panels.h>
#include <app/ui/widgets.h>
#include <base/text.h>
#include <scene/answer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope::app {

namespace {

constexpr float kStatusPad = 12;             // pixels at scale 1
constexpr float kProgressWidth = 120;        // pixels at scale 1
constexpr double kProgressFrame = 1 / 15.0;  // seconds between frames while it moves
constexpr double kSweep = 1.6;               // seconds that the bar takes where nothing is known

/// "2 agents, 2 clips, 62 nodes, 21 tests": all of the scene, and the tests of the query in view.
std::string counts(const Workspace& workspace) {
    if (workspace.empty()) return "";
    const FittedScene& fitted = *workspace.document().fitted;
    const std::size_t agents = workspace.crowd() ? workspace.crowd()->agents.size() : workspace.scene().agents.size();
    std::size_t nodes = 0;
    for (int clip = 0; clip < static_cast<int>(workspace.scene().clips.size()); ++clip) {
        nodes += fitted.tree(clip).nodes().size();
    }
    std::string out = agents > 0 ? counted(agents, "agent", "agents") + ", " : "";
    out += counted(workspace.scene().clips.size(), "clip", "clips") + ", " + counted(nodes, "node", "nodes");
    if (const RecordedQuery* recorded = workspace.recorded()) {
        out += ", " + counted(recorded->trace.events(), "test", "tests");
    }
    return out;
}

/// What is under the mouse, as short as it can be said.
std::string hover_facts(const Workspace& workspace, const QueryInspector& queries) {
    const Selection& what = workspace.hovered;
    if (what.kind == Selection::Kind::none || !exists(workspace.fitted(), what)) return "";
    if (what.kind == Selection::Kind::query) {
        const auto index = static_cast<std::size_t>(what.index);
        return sentence(workspace.fitted().queries()[index], queries.answer_of(index).contact);
    }
    constexpr std::array<std::string_view, 8> kFacts{"clip",  "samples",   "time", "radius",
                                                     "speed", "tightness", "cost", "lasts"};
    const Described described = describe(workspace, what);
    std::string out = cleaned(described.name);
    for (const auto& [key, value] : described.facts) {
        if (std::ranges::find(kFacts, key) != kFacts.end()) out += "   " + key + ' ' + cleaned(value);
    }
    return out;
}

/// Something under way, and what ends it.
struct WorkUnderWay {
    const Job* job = nullptr;
    std::function<void(Session&)> cancel;
};

/// Jobs of the scene, the oldest first, behind them a sweep and that of screens; last films, which take minutes.
std::vector<WorkUnderWay> work_under_way(const Session& session) {
    std::vector<WorkUnderWay> out;
    const auto add_jobs = [&](bool films) {
        for (std::size_t i = 0; i < session.jobs.count(); ++i) {
            if ((session.jobs.purpose(i) == JobPurpose::film) == films)
                out.push_back({&session.jobs.job(i), [i](Session& of) { of.jobs.cancel(i); }});
        }
    };
    add_jobs(false);
    if (const Job* sweep = session.sweeps.job()) out.push_back({sweep, [](Session& of) { of.sweeps.cancel(); }});
    for (std::size_t i = 0; i < session.screens.size(); ++i) {
        if (const Job* work = session.screens[i]->work())
            out.push_back({work, [i](Session& of) { of.screens[i]->cancel(); }});
    }
    add_jobs(true);
    return out;
}

/// Ends what the bar shows.
void cancel_first(Session& session) {
    const std::vector<WorkUnderWay> work = work_under_way(session);
    if (!work.empty()) work.front().cancel(session);
}

/// The work under way from `right` to the left; returns where it begins.
float job_part(Ui& ui, const std::vector<WorkUnderWay>& work, float right) {
    const Job& job = *work.front().job;
    ui.want_frame_in(kProgressFrame);
    std::string title = job.title();
    if (work.size() > 1) title += formatted(" (and %d more)", static_cast<int>(work.size()) - 1);
    const float gap = ui.px(8);
    const float width = ui.px(kProgressWidth);
    const float height = ui.px(6);
    const float line = ImGui::GetTextLineHeight();
    const float button = ImGui::CalcTextSize("Cancel").x + 2 * ImGui::GetStyle().FramePadding.x;
    const float text = ImGui::CalcTextSize(title.c_str()).x;
    const float left = std::max(ui.px(kStatusPad), right - button - width - text - 2 * gap);
    const float y = ImGui::GetCursorPosY();
    ImGui::SetCursorPos({left, y});
    fitted_line(ui, ui.style.quiet, title, right - button - width - 2 * gap - left);
    ui.mark("job.0");
    ImGui::SetCursorPos({right - button - gap - width, y});
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float top = at.y + (line - height) / 2;
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.AddRectFilled({at.x, top}, {at.x + width, top + height}, ui.style.raised, height / 2);
    const double progress = job.progress();
    float from = 0;
    float to = static_cast<float>(progress);
    if (progress < 0) {
        from = static_cast<float>(0.75 * (0.5 - 0.5 * std::cos(ui.now / kSweep * 6.283)));
        to = from + 0.25f;
    }
    draw.AddRectFilled({at.x + from * width, top}, {at.x + to * width, top + height}, ui.style.accent, height / 2);
    ImGui::Dummy({width, line});
    ui.mark("job.0.bar");
    ImGui::SetCursorPos({right - button, y});
    if (small_button(ui, "Cancel", "job.0.cancel")) ui.later(cancel_first);
    return left;
}

}  // namespace

float status_height(const Ui& ui) { return std::floor(ui.style.caption->FontSize + ui.px(6)); }

void status_bar(Ui& ui, QueryInspector& queries, ImVec2 size) {
    ImGui::SetCursorScreenPos({0, ImGui::GetIO().DisplaySize.y - size.y});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
    ImGui::BeginChild("status", size, false, ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
    ImGui::PopStyleVar();
    ImGui::PushFont(ui.style.caption);
    ImGui::PushStyleColor(ImGuiCol_Text, ui.style.quiet);
    const ImVec2 corner = ImGui::GetWindowPos();
    ImGui::GetWindowDrawList()->AddLine(corner, {corner.x + size.x, corner.y}, ui.style.border);
    const float pad = ui.px(kStatusPad);
    const float y = 0.5f * (size.y - ImGui::GetTextLineHeight());
    float right = size.x - pad;
    if (ui.frame_seconds > 0) {
        const std::string time = formatted("%.0f ms", 1000 * ui.frame_seconds);
        // As wide as the longest, so that nothing beside it moves.
        right -= ImGui::CalcTextSize("0000 ms").x;
        ImGui::SetCursorPos({size.x - pad - ImGui::CalcTextSize(time.c_str()).x, y});
        ImGui::TextUnformatted(time.c_str());
        ui.mark("status.frame");
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("What the last frame took");
    }
    ImGui::SetCursorPosY(y);
    const std::vector<WorkUnderWay> work = work_under_way(ui.session);
    if (!work.empty()) right = job_part(ui, work, right) - pad;
    // What there is least room for is what is under the mouse: its tooltip says it too.
    const Screen* screen = ui.session.screen;
    ImGui::SetCursorPos({pad, y});
    fitted_line(ui, ui.style.quiet, screen ? screen->counts() : counts(ui.workspace), std::max(right - pad, 0.0f));
    ui.mark("status.counts");
    const float left = ImGui::GetItemRectMax().x + 2 * pad;
    const std::string facts = screen ? "" : hover_facts(ui.workspace, queries);
    if (!facts.empty() && right - left > ui.px(40)) {
        ImGui::SetCursorPos({left, y});
        fitted_line(ui, ui.style.text, facts, right - left);
        ui.mark("status.hover");
    }
    ImGui::PopStyleColor();
    ImGui::PopFont();
    ImGui::EndChild();
}

}  // namespace mobbscope::app
