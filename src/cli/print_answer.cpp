#include <base/text.h>
#include <cli/print_answer.h>

#include <algorithm>
#include <ostream>
#include <string>

namespace mobbscope::cli {

namespace {

void print_event(std::ostream& out, int step, const mobb::Trace::Event& event) {
    // A step's number leads each line, so that it can be given to `render --step`.
    const std::string number = std::to_string(step);
    out << std::string(8 - std::min<std::size_t>(number.size(), 7), ' ') << number << "  "
        << std::string(2 * static_cast<std::size_t>(event.depth), ' ') << event.a << " x " << event.b << "  "
        << mobb::name(event.test) << ": ";
    switch (event.outcome) {
        case mobb::Outcome::disjoint_in_time:
            out << "apart in time";
            break;
        case mobb::Outcome::separated:
            out << "separated along axis " << event.axis << " by " << brief(event.gap) << " m";
            break;
        case mobb::Outcome::overlap:
            out << "overlap";
            break;
        case mobb::Outcome::hit:
            out << "hit";
            break;
        case mobb::Outcome::no_hit:
            out << "no hit";
            break;
    }
    if (event.test == mobb::TestKind::samples) {
        out << " (" << counted(static_cast<long long>(event.pairs.size()), "pair", "pairs") << " measured";
        if (event.outcome == mobb::Outcome::hit) {
            const mobb::MeasuredPair& pair = event.pairs.back();
            out << ", samples " << pair.i << " and " << pair.j << " at " << brief(pair.distance) << " m";
        }
        out << ')';
    }
    out << '\n';
}

}  // namespace

void print_answer(std::ostream& out, std::size_t index, const SceneQuery& query, const Answer& answer) {
    out << index << ": " << sentence(query, answer.contact) << '\n'
        << "   Tests: " << answer.tests.time << " of time, " << answer.tests.obb2d << " of 2D boxes, "
        << answer.tests.obb3d << " of 3D boxes";
    if (answer.tests.moving > 0) out << ", " << answer.tests.moving << " of moving boxes";
    if (answer.tests.aabb > 0) out << ", " << answer.tests.aabb << " of AABBs";
    out << "; " << counted(answer.tests.samples, "pair", "pairs") << " of samples measured.\n";
    if (answer.contacts) {
        out << "   In contact:";
        if (answer.contacts->empty()) out << " never";
        const char* separator = " ";
        for (const mobb::Interval& interval : *answer.contacts) {
            out << separator << brief(interval.t0) << " to " << brief(interval.t1) << " s";
            separator = ", ";
        }
        out << ".\n";
    }
    if (answer.trace) {
        out << "   Trace (node of " << cleaned(query.a.name) << " x node of " << cleaned(query.b.name) << "):\n";
        for (int step = 0; step < answer.trace->size(); ++step) print_event(out, step, (*answer.trace)[step]);
    }
}

}  // namespace mobbscope::cli
