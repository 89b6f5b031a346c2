#include <app/commands/situations.h>
#include <base/text.h>
#include <cases/case_scene.h>
#include <review/review_panels.h>
#include <review/review_screen.h>

#include <nlohmann/json.hpp>

#include <utility>

namespace mobbscope::app {

namespace {

using Json = nlohmann::ordered_json;

Json text_or_null(const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); }

Json state_of(const ReviewCase& one) {
    if (one.state == ReviewCase::State::not_drawn) return "not drawn";
    return one.drawn() ? Json(picture_tests::name(one.outcome())) : Json("waiting");
}

}  // namespace

void ReviewScreen::open(const ReviewFolder& found) {
    const auto opened = std::make_shared<Review>(
        found, ReviewSurroundings{session_.options.attended, [&at = *session_.desktop] { at.wake(); },
                                  [this](const auto& file) { session_.files.check_may_write(file); }, case_drawer,
                                  session_.options.may_write});
    session_.files.come_back([this, opened] {
        session_.playback.stop();
        if (review_) opened->begin_as(*review_);
        review_ = opened;
        session_.screen = this;
        session_.notifications.retire();
        if (review_->output().empty()) review_->run.draw_all();
        poll();
    });
}

void ReviewScreen::leave() {
    session_.files.come_back([this] { session_.screen = nullptr; });
}

void ReviewScreen::back() {
    session_.playback.stop();
    session_.screen = this;
}

void ReviewScreen::open_case(std::size_t index) {
    const picture_tests::CaseFile file = review_->cases()[index].file;
    // What is opened last is meant.
    session_.jobs.drop(JobPurpose::opens);
    const auto work = [this, file](JobControl& control) -> Job::Finish {
        Document document = document_of(picture_tests::scene_of(file), nullptr, progress_of(control));
        return [this, document = std::move(document), file] { session_.files.visit(document, file.name); };
    };
    session_.jobs.start("Opening " + file.name, work, JobPurpose::opens);
}

const ScreenWords& ReviewScreen::words() const {
    static constexpr ScreenWords kWords{"picture tests are shown: leave them first", "no picture tests are shown",
                                        "Search commands, cases"};
    return kWords;
}

std::string ReviewScreen::counts() const {
    return counted(review_->cases().size(), "picture test", "picture tests") + ": " + sum_of(*review_);
}

std::vector<Command> ReviewScreen::commands() const { return review_commands(); }

const Situation& ReviewScreen::situation() const {
    static const Situation kReviewing{
        "You look at picture tests",
        "Go through the cases that differ; accept what is right, and leave the rest to be mended.",
        &ReviewScreen::shown,
        {"review.next_failing", "review.previous_failing", "review.accept", "review.undo", "review.blink",
         "review.open", "review.draw_all", "review.leave"}};
    return kReviewing;
}

std::vector<NamedThing> ReviewScreen::things() const {
    std::vector<NamedThing> out;
    for (const ReviewCase& one : review_->cases()) out.push_back({"review.show", one.file.name, "Case"});
    return out;
}

std::array<ScreenPanel, 3> ReviewScreen::panels() {
    return {{{"cases", [this](Ui& ui) { review_list(ui, *review_); }},
             {"pictures", [this](Ui& ui) { pixel_ = review_pictures(ui, *review_); }},
             {"facts", [this](Ui& ui) { review_facts(ui, *review_, pixel_); }}}};
}

void ReviewScreen::draw_above_scene(Ui& ui) { review_way_back(ui); }

void ReviewScreen::add_state(Json& state) const {
    if (!review_) return;
    const ReviewLook& look = review_->look;
    const ReviewCase& now = review_->shown();
    Json cases;
    for (const ReviewCase& one : review_->cases()) cases[one.file.name] = state_of(one);
    const auto names = [&](const std::vector<std::size_t>& indices) {
        Json out = Json::array();
        for (const std::size_t index : indices) out.push_back(review_->cases()[index].file.name);
        return out;
    };
    state["review"] = {{"shown", shown()},
                       {"folder", review_->folder().string()},
                       {"cases", std::move(cases)},
                       {"listed", names(review_->listed())},
                       {"marked", names(review_->marked())},
                       {"case", now.file.name},
                       {"outcome", state_of(now)},
                       {"accepted", now.accepted},
                       {"mode", kReviewModes[static_cast<std::size_t>(look.mode)].name},
                       {"blink_seconds", look.blink_seconds},
                       {"divider", look.divider},
                       {"zoom", look.zoom},
                       {"middle", Json::array({look.middle.x, look.middle.y})},
                       {"failed_only", look.failed_only},
                       {"order", kReviewOrders[static_cast<std::size_t>(look.order)]},
                       {"drawing", review_->run.drawing()},
                       {"undo", text_or_null(review_->goldens.undo_title())},
                       {"redo", text_or_null(review_->goldens.redo_title())},
                       {"open_case", text_or_null(session_.files.visited())}};
}

void ReviewScreen::poll() {
    if (!review_) return;
    for (const ReviewNews& news : review_->run.poll()) tell(news);
}

void ReviewScreen::tell(const ReviewNews& news) {
    if (!news.instead_of.empty()) session_.notifications.take_down(news.instead_of);
    session_.notifications.tell(news.level, news.text);
}

void ReviewScreen::cancel() {
    if (!work()) return;
    review_->run.cancel();
    session_.notifications.tell(MessageLevel::info, "Cancelled");
}

void ReviewScreen::end_work() {
    if (review_) review_->run.cancel();
}

ReviewScreen& add_review(Session& session) {
    auto screen = std::make_unique<ReviewScreen>(session);
    ReviewScreen& added = *screen;
    add_screen(session, std::move(screen));
    return added;
}

std::span<const Command> commands_with_review() {
    static const std::vector<Command> table = commands_with(review_commands());
    return table;
}

}  // namespace mobbscope::app
