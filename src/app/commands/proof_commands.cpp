#include <app/commands/arguments.h>
#include <app/commands/command.h>
#include <base/file.h>
#include <explain/certificate_file.h>

#include <filesystem>
#include <string>

namespace mobbscope::app {

namespace {

bool has_lines(const QueryInspector& queries) {
    const auto findings = queries.findings();
    return findings && !findings->proof.lines.empty();
}
std::string_view why_no_line(const Workspace& workspace) {
    return workspace.view().query ? "this answer has no proof lines" : "no query is shown";
}

/// The time cursor goes where the two are nearest in it, and the walls are shown.
void to_line(Workspace& workspace, const QueryProof& proof, std::size_t index) {
    workspace.change_view([&](ViewState& view) {
        view.time = proof.lines[index].nearest;
        view.step = {Step::Unit::end, 0};
    });
}

void to_numbered(Workspace& workspace, QueryInspector& queries, const std::string& text) {
    const QueryProof& proof = queries.findings()->proof;
    const int last = static_cast<int>(proof.lines.size()) - 1;
    to_line(workspace, proof, static_cast<std::size_t>(whole_number_in(text, "the line", 0, last)));
}

/// From the line that the time cursor is in; without one to the tightest. Behind the last comes the first.
void to_neighbour(Workspace& workspace, QueryInspector& queries, bool forward) {
    const QueryProof& proof = queries.findings()->proof;
    const auto& time = workspace.view().time;
    const auto now = time ? proof.at(*time) : std::nullopt;
    const std::size_t count = proof.lines.size();
    to_line(workspace, proof, !now ? *proof.tightest : (*now + (forward ? 1 : count - 1)) % count);
}

void save_proof(Session& session, const std::string& file) {
    if (file.empty()) return session.dialogs.open(Dialog::save_proof);
    session.files.check_may_export(file);
    const int query = *session.workspace.view().query;
    write_file(file,
               certificate_text(session.workspace.fitted(), {{query, session.queries.findings()->proof.certificate}}));
    session.notifications.tell(MessageLevel::info,
                               "Wrote " + file + ". mobbscope verify checks it against the samples alone");
}

}  // namespace

std::vector<Command> proof_commands() {
    const Condition kHasLines{has_lines, why_no_line};
    return {
        Command("proof.next", "Next line of the proof",
                "Goes to the next line that keeps the two apart, where they are nearest; at first to the tightest.",
                [](Workspace& workspace, QueryInspector& queries) { to_neighbour(workspace, queries, true); },
                {.shortcut = "Y", .repeats = true, .enabled = kHasLines}),
        Command("proof.previous", "Previous line of the proof",
                "Goes to the line before, where the two are nearest; at first to the tightest.",
                [](Workspace& workspace, QueryInspector& queries) { to_neighbour(workspace, queries, false); },
                {.shortcut = "Shift+Y", .repeats = true, .enabled = kHasLines}),
        Command("proof.line", "Go to a line of the proof", "Shows a line of the proof by its number from 0.",
                to_numbered, {.menu = kNoMenu, .argument = "N", .enabled = kHasLines}),
        Command("proof.save", "Save the proof...",
                "Writes the proof of the query in view, which `mobbscope verify` checks against the samples alone.",
                save_proof, {.argument = "[FILE.json]", .enabled = kHasLines, .also = "certificate export"}),
    };
}

}  // namespace mobbscope::app
