#include <app/window/headless_window.h>

#include <utility>

namespace mobbscope::app {

namespace {

constexpr double kHeadlessFrame = 1.0 / 60;
/// What still wants frames after that many is an animation.
constexpr int kMostToSettle = 120;

}  // namespace

HeadlessWindow::HeadlessWindow(std::unique_ptr<GlContext> context, Session& session, PictureSize size, double scale)
    : size_(size), shell_(std::move(context), session, scale) {}

void HeadlessWindow::frame() {
    shell_.frame(size_, now_);
    now_ += kHeadlessFrame;
}

void HeadlessWindow::run_for(double seconds) {
    for (const double end = now_ + seconds; now_ < end;) frame();
}

void HeadlessWindow::settle() {
    frame();
    for (int i = 0; i < kMostToSettle && !shell_.settled(); ++i) frame();
}

}  // namespace mobbscope::app
