#include <app/session/reviews.h>
#include <cases/case_scene.h>

#include <utility>

namespace mobbscope::app {

void Reviews::open(const ReviewFolder& found) {
    const auto opened =
        std::make_shared<Review>(found, Review::Surroundings{options_.attended, [&at = *desktop_] { at.wake(); },
                                                             [this](const auto& file) { files_.check_may_write(file); },
                                                             case_drawer, options_.may_write});
    files_.come_back([this, opened] {
        playback_.stop();
        if (review_) opened->begin_as(*review_);
        review_ = opened;
        screen_ = this;
        notifications_.retire();
        if (review_->output().empty()) review_->draw_all();
        poll();
    });
}

void Reviews::leave() {
    files_.come_back([this] { screen_ = nullptr; });
}

void Reviews::back() {
    playback_.stop();
    screen_ = this;
}

void Reviews::cancel_run() {
    if (!review_ || !review_->drawing()) return;
    review_->cancel();
    notifications_.tell(MessageLevel::info, "Cancelled");
}

void Reviews::open_case(std::size_t index) {
    const picture_tests::CaseFile file = review_->cases()[index].file;
    // What is opened last is meant.
    jobs_.drop(JobPurpose::opens);
    const auto work = [this, file](JobControl& control) -> Job::Finish {
        Document document = document_of(picture_tests::scene_of(file), nullptr, progress_of(control));
        return [this, document = std::move(document), file] { files_.visit(document, file.name); };
    };
    jobs_.start("Opening " + file.name, work, JobPurpose::opens);
}

void Reviews::poll() {
    if (!review_) return;
    for (const ReviewNews& news : review_->poll()) notifications_.tell(news.level, news.text);
}

}  // namespace mobbscope::app
