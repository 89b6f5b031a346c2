#include <render/subject.h>

#include <stdexcept>

namespace mobbscope {

namespace {

Subject make_subject(const FittedScene& fitted, const Participant& participant, int index, int color_index) {
    return {fitted.placed(participant), participant.name, agent_color(fitted.scene(), participant, color_index), index};
}

}  // namespace

std::vector<Subject> subjects(const FittedScene& fitted, const ViewState& view) {
    std::vector<Subject> out;
    if (!view.query) {
        for (const Participant& participant : fitted.participants()) {
            const int index = static_cast<int>(out.size());
            out.push_back(make_subject(fitted, participant, index, index));
        }
        return out;
    }
    const int count = static_cast<int>(fitted.queries().size());
    if (*view.query < 0 || *view.query >= count) {
        throw std::invalid_argument("there is no query " + std::to_string(*view.query) + ": the scene has " +
                                    (count == 0 ? "none" : std::to_string(count) + ", counted from 0"));
    }
    const SceneQuery& query = fitted.queries()[static_cast<std::size_t>(*view.query)];
    const int color_a = query.a.agent >= 0 ? query.a.agent : 0;
    out.push_back(make_subject(fitted, query.a, 0, color_a));
    out.push_back(make_subject(fitted, query.b, 1, query.b.agent >= 0 ? query.b.agent : color_a + 1));
    // Two sides of one colour or name could not be told apart.
    if (out[1].color == out[0].color) out[1] = make_subject(fitted, query.b, 1, color_a + 1);
    if (out[1].name == out[0].name) {
        out[0].name += " (A)";
        out[1].name += " (B)";
    }
    return out;
}

}  // namespace mobbscope
