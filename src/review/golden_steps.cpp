#include <base/text.h>
#include <cases/golden_change.h>
#include <cases/weak_cases.h>
#include <review/golden_steps.h>
#include <review/review.h>

#include <algorithm>
#include <exception>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace mobbscope::app {

using picture_tests::GoldenChange;

namespace {

/// What a step writes, as one change: all or nothing.
template <class Taken>
std::vector<GoldenChange> changes_of(const std::vector<Taken>& taken) {
    std::vector<GoldenChange> out;
    for (const Taken& one : taken) out.insert(out.end(), one.before.fresh.begin(), one.before.fresh.end());
    return out;
}

/// Somebody has accepted the same before.
bool is_there_already(const std::vector<GoldenChange>& fresh) {
    return std::ranges::all_of(
        fresh, [](const GoldenChange& one) { return picture_tests::golden_bytes(one.file) == one.bytes; });
}

}  // namespace

std::vector<ReviewNews> GoldenSteps::accept(const std::vector<std::size_t>& indices) {
    std::vector<std::size_t> ready;
    std::string not_accepted;
    const bool alone = indices.size() == 1 && indices.front() == review_.current();
    for (const std::size_t index : indices) {
        std::string why = review_.why_not_accept(index);
        if (why.empty() && !alone && brings_case(review_.cases()[index].result))
            why = "the report brings the case itself, no golden; accept it alone, while it is shown";
        if (!why.empty()) {
            not_accepted += (not_accepted.empty() ? "" : "; ") + review_.cases()[index].file.name + ": " + why;
            continue;
        }
        for (const GoldenChange& change : review_.cases()[index].result.fresh) {
            if (surroundings_.check_may_write) surroundings_.check_may_write(change.file);
        }
        ready.push_back(index);
    }
    if (ready.empty()) {
        throw std::invalid_argument(indices.empty() ? "there is no case to accept" : not_accepted);
    }
    std::vector<ReviewNews> news = write(ready);
    if (!not_accepted.empty()) news.push_back({MessageLevel::warning, "Not accepted: " + not_accepted});
    return news;
}

std::vector<ReviewNews> GoldenSteps::write(const std::vector<std::size_t>& indices) {
    Step step;
    std::vector<ReviewNews> refused, known, on_cases;
    std::exception_ptr first_refusal;
    for (const std::size_t index : indices) {
        ReviewCase& one = review_.change(index);
        try {
            if (is_there_already(one.result.fresh)) {
                one.accepted = true;
                one.marked = false;
                known.push_back({MessageLevel::info, one.file.name + ": it is the golden already"});
                continue;
            }
            if (one.from_output) picture_tests::check_bytes(one.result.fresh, review_.output());
            std::vector<std::string> words;
            if (brings_case(one.result)) words = words_on_brought_case(one.result);
            picture_tests::write_goldens(one.result.fresh);
            for (std::string& line : words) on_cases.push_back({MessageLevel::warning, std::move(line)});
        } catch (const std::exception& error) {
            if (!first_refusal) first_refusal = std::current_exception();
            refused.push_back({MessageLevel::error, error.what()});
            continue;
        }
        step.taken.push_back({index, one.result});
        one.accepted = true;
        one.marked = false;
    }
    if (step.taken.empty() && first_refusal) std::rethrow_exception(first_refusal);
    if (step.taken.empty()) return known;
    step.title = step.taken.size() == 1 ? "accepting " + review_.cases()[step.taken.front().index].file.name
                                        : "accepting " + counted(step.taken.size(), "picture", "pictures");
    step.said = "Accepted " + step.title.substr(std::string_view("accepting ").size()) + "; undo gives the golden" +
                (step.taken.size() == 1 ? "" : "s") + " back";
    steps_.resize(done_);
    std::vector<ReviewNews> said{{MessageLevel::info, step.said}};
    steps_.push_back(std::move(step));
    ++done_;
    said.insert(said.end(), on_cases.begin(), on_cases.end());
    said.insert(said.end(), known.begin(), known.end());
    said.insert(said.end(), refused.begin(), refused.end());
    return said;
}

bool GoldenSteps::waits(const Step& step) const {
    return std::ranges::any_of(step.taken, [&](const Step::Taken& taken) {
        return review_.cases()[taken.index].state == ReviewCase::State::waiting;
    });
}

ReviewNews GoldenSteps::stand(Step& step, bool accepted, const std::string& what) {
    for (const Step::Taken& taken : step.taken) {
        ReviewCase& one = review_.change(taken.index);
        one.result = taken.before;
        one.accepted = accepted;
    }
    if (std::ranges::find(step.taken, review_.current(), &Step::Taken::index) == step.taken.end()) {
        review_.show(step.taken.front().index);
    }
    const std::string before = std::exchange(step.said, what + step.title);
    return {MessageLevel::info, step.said, before};
}

ReviewNews GoldenSteps::undo() {
    Step& step = steps_[done_ - 1];
    picture_tests::write_goldens(picture_tests::taken_back(changes_of(step.taken)));
    --done_;
    return stand(step, false, "Undone: ");
}

ReviewNews GoldenSteps::redo() {
    Step& step = steps_[done_];
    picture_tests::write_goldens(changes_of(step.taken));
    ++done_;
    return stand(step, true, "Done again: ");
}

}  // namespace mobbscope::app
