/// The parts of the query panel, and the pictures of a trace that the timeline shows too. Each draws itself at the
/// cursor of the current ImGui window.
#pragma once

#include <app/ui/ui.h>
#include <app/ui/widgets.h>
#include <explain/query_findings.h>

namespace mobbscope::app {

/// A button of this panel, marked "query.<the command's last word>".
void query_button(Ui& ui, const char* label, const char* command);

/// The scene's queries with their answers, each a click away.
void query_list(Ui& ui);

// These need a query in the view and its findings.
void query_answer(Ui& ui, const QueryFindings& findings);
void query_counters(Ui& ui, const QueryFindings& findings);
/// Buttons that step, and the slider over the trace.
void step_transport(Ui& ui);
/// What the event under test found, and of which nodes.
void current_test(Ui& ui, const QueryFindings& findings);
/// Both nodes projected on time and on every axis of a box test.
void why_axes(Ui& ui, const QueryFindings& findings);
/// The pairs of samples that were measured.
void measured_pairs(Ui& ui, const QueryFindings& findings);
/// A's time by B's: every pair of nodes that was tested.
void recursion_square(Ui& ui, const QueryFindings& findings);
/// How far A and B are apart at each moment.
void clearance_chart(Ui& ui, const QueryFindings& findings, float height);

/// The events of the trace as a strip, the present one marked; click and drag set the step. Nothing without a query in
/// the view.
void step_strip(Ui& ui, float width, float height);

/// The recursion, depth downwards; a click steps to a pair's first event. Nothing without a query in the view.
void recursion_icicle(Ui& ui, ImVec2 size);

}  // namespace mobbscope::app
