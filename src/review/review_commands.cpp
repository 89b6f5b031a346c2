#include <app/commands/arguments.h>
#include <base/text.h>
#include <review/review_screen.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace mobbscope::app {

namespace {

constexpr double kDividerStep = 0.025;  // shares of the picture's width
constexpr double kPanStep = 0.1;        // shares of what is seen
constexpr double kLeastBlink = 0.1;     // seconds
constexpr double kMostBlink = 5;

constexpr FileQuestion kWhichFolder{.title = "Review picture tests",
                                    .button = "Review this folder",
                                    .prefix = "review",
                                    .command = "file.review",
                                    .of_folder = true};

void review_folder(Dialogs& dialogs, ReviewScreen& screen, const std::string& argument) {
    if (argument.empty()) return dialogs.ask_for_folder(kWhichFolder);
    const std::vector<std::filesystem::path> given = paths_in(argument);
    if (given.size() > 2) throw std::invalid_argument("give the folder of the cases, and one report at most");
    screen.open(given.front(), given.size() == 2 ? given.back() : std::filesystem::path());
}

/// One thing after the other, what lies in front first.
void leave_or_put_away(Notifications& notifications, ReviewScreen& screen) {
    if (notifications.has_up()) return notifications.put_away();
    screen.leave();
    if (screen.shown()) return;
    notifications.tell(MessageLevel::info, "The picture tests stay open in the background",
                       {{"review.back", "", "Back to them"}});
}

/// The rule of all that needs picture tests; that they are shown is everybody's rule.
bool has_review(const ReviewScreen& screen) { return screen.review() != nullptr; }

Condition when(const std::function<bool(const Review&)>& holds, const OfParts<std::string_view, const Session>& else_) {
    return {[holds](const ReviewScreen& screen) { return screen.review() && holds(*screen.review()); }, else_};
}

/// Of what is on or chosen: false where there are no picture tests.
OfParts<bool, const Session> so(const std::function<bool(const Review&)>& holds) {
    return [holds](const ReviewScreen& screen) { return screen.review() && holds(*screen.review()); };
}
OfParts<bool, const Session> so(const std::function<bool(const Review&, const std::string&)>& holds) {
    return [holds](const ReviewScreen& screen, const std::string& choice) {
        return screen.review() && holds(*screen.review(), choice);
    };
}

Condition if_failing(int by) {
    return when([by](const Review& review) { return review.next_failing(by).has_value(); },
                []() -> std::string_view { return "no other case fails"; });
}

Command go_to_failing(std::string_view id, std::string_view title, std::string_view doc, std::string_view shortcut,
                      int by) {
    const auto go = [by](ReviewScreen& screen) { screen.review()->show(*screen.review()->next_failing(by)); };
    return {id, title, doc, go, {.shortcut = shortcut, .repeats = true, .enabled = if_failing(by)}};
}

Command go_to_case(std::string_view id, std::string_view title, std::string_view doc, std::string_view shortcut,
                   int by) {
    const auto go = [by](ReviewScreen& screen) { screen.review()->show(*screen.review()->next(by)); };
    const Condition enabled = when([by](const Review& review) { return review.next(by).has_value(); },
                                   []() -> std::string_view { return "there is none from here"; });
    return {id, title, doc, go, {.shortcut = shortcut, .repeats = true, .enabled = enabled}};
}

std::vector<std::string> case_names(const ReviewScreen& screen) {
    std::vector<std::string> out;
    if (!screen.review()) return out;
    for (const ReviewCase& one : screen.review()->cases()) out.push_back(one.file.name);
    return out;
}

void show_case(ReviewScreen& screen, const std::string& name) {
    screen.review()->show(screen.review()->index_of(name));
}

/// Marks a case, or the one that is shown.
void toggle_mark(ReviewScreen& screen, const std::string& name) {
    Review& review = *screen.review();
    const std::size_t index = name.empty() ? review.current() : review.index_of(name);
    review.mark(index, !review.cases()[index].marked);
}

void mark_failing(ReviewScreen& screen) {
    Review& review = *screen.review();
    for (std::size_t i = 0; i < review.cases().size(); ++i) review.mark(i, review.why_not_accept(i).empty());
}

void order_cases(ReviewScreen& screen, const std::string& name) {
    const auto at = std::ranges::find(kReviewOrders, name);
    if (at == kReviewOrders.end()) throw std::invalid_argument("give one of " + listed(kReviewOrders));
    screen.review()->look.order = static_cast<ReviewOrder>(at - kReviewOrders.begin());
}

std::vector<Command> case_commands() {
    return {
        go_to_failing("review.next_failing", "Next failing case",
                      "Goes on to the next case that did not pass, behind the last to the first.", "N PageDown", 1),
        go_to_failing("review.previous_failing", "Previous failing case",
                      "Goes back to a case that did not pass, before the first to the last.", "P PageUp", -1),
        go_to_case("review.next", "Next case", "Goes on to the next case of the list.", "Down", 1),
        go_to_case("review.previous", "Previous case", "Goes back to the case before.", "Up", -1),
        Command("review.show", "Show case", "Shows the pictures of a case.", show_case,
                {.argument = "CASE",
                 .enabled = has_review,
                 .choices = case_names,
                 .chosen = so(
                     [](const Review& review, const std::string& name) { return review.shown().file.name == name; })}),
        Command("review.failed_only", "Only failing cases", "Hides cases that passed.",
                [](ReviewScreen& screen) { screen.review()->look.failed_only = !screen.review()->look.failed_only; },
                {.shortcut = "L", .enabled = has_review, .checked = so([](const Review& review) {
                                                             return review.look.failed_only;
                                                         })}),
        Command("review.order", "Order of the list", "Sorts the list by name, by difference or by outcome.",
                order_cases,
                {.argument = "ORDER",
                 .enabled = has_review,
                 .choices = [] { return std::vector<std::string>(kReviewOrders.begin(), kReviewOrders.end()); },
                 .chosen = so([](const Review& review, const std::string& name) {
                     return kReviewOrders[static_cast<std::size_t>(review.look.order)] == name;
                 })}),
    };
}

/// A mode that is on already stays; blinking ends.
void set_mode(ReviewScreen& screen, ReviewMode mode) {
    ReviewLook& look = screen.review()->look;
    const bool ends = mode == ReviewMode::blink && look.mode == ReviewMode::blink;
    look.mode = ends ? ReviewMode::actual : mode;
}

/// The other of golden and actual picture.
void flip(ReviewScreen& screen) {
    ReviewLook& look = screen.review()->look;
    look.mode = look.mode == ReviewMode::golden ? ReviewMode::actual : ReviewMode::golden;
}

Command divider_command(std::string_view id, std::string_view title, std::string_view shortcut, double by) {
    const auto move = [by](ReviewScreen& screen) {
        double& divider = screen.review()->look.divider;
        divider = std::clamp(divider + by, 0.0, 1.0);
    };
    const Condition enabled = when([](const Review& review) { return review.look.mode == ReviewMode::slider; },
                                   []() -> std::string_view { return "the slider is not shown"; });
    return {id,
            title,
            "Moves the line between golden and actual picture.",
            move,
            {.menu = "Review/Pictures", .shortcut = shortcut, .repeats = true, .enabled = enabled}};
}

std::vector<Command> mode_commands() {
    static const std::vector<std::string> ids = [] {
        std::vector<std::string> out;
        for (const ReviewModeWords& words : kReviewModes) out.push_back("review." + std::string(words.name));
        return out;
    }();
    std::vector<Command> out;
    for (std::size_t i = 0; i < kReviewModes.size(); ++i) {
        const auto mode = static_cast<ReviewMode>(i);
        const ReviewModeWords& words = kReviewModes[i];
        out.push_back(Command(ids[i], words.title, words.doc, [mode](ReviewScreen& screen) { set_mode(screen, mode); },
                              {.menu = "Review/Pictures",
                               .shortcut = words.shortcut,
                               .enabled = has_review,
                               .checked = so([mode](const Review& review) { return review.look.mode == mode; })}));
    }
    out.push_back(Command("review.flip", "Flip", "Shows the other of golden and actual picture.", flip,
                          {.menu = "Review/Pictures", .shortcut = "Space", .enabled = has_review}));
    out.push_back(Command("review.blink_rate", "Blink every so many seconds",
                          "Sets how long each picture stays while they blink.",
                          [](ReviewScreen& screen, const std::string& text) {
                              screen.review()->look.blink_seconds = parse_number_within(text, kLeastBlink, kMostBlink);
                          },
                          {.menu = "Review/Pictures",
                           .argument = "SECONDS",
                           .enabled = has_review,
                           .choices =
                               [] {
                                   return std::vector<std::string>{"0.2", "0.5", "1", "2"};
                               },
                           .chosen = so([](const Review& review, const std::string& text) {
                               return format_double(review.look.blink_seconds) == text;
                           })}));
    out.push_back(divider_command("review.divider_left", "Slider to the left", "Left", -kDividerStep));
    out.push_back(divider_command("review.divider_right", "Slider to the right", "Right", kDividerStep));
    return out;
}

void set_zoom(ReviewLook& look, double zoom) { look.zoom = std::clamp(zoom, kLeastReviewZoom, kMostReviewZoom); }

/// To the next power of two.
void zoom_by(ReviewScreen& screen, bool in) {
    ReviewLook& look = screen.review()->look;
    const double power = std::log2(look.scale());
    constexpr double kAlmost = 0.01;
    set_zoom(look, std::exp2(in ? std::floor(power + kAlmost) + 1 : std::ceil(power - kAlmost) - 1));
}

void zoom_to_difference(ReviewScreen& screen) {
    Review& review = *screen.review();
    const ReviewPictures& pictures = review.pictures();
    if (!pictures.diff || !pictures.diff->bounds) throw std::invalid_argument("no pixels differ in this case");
    const PixelRect& bounds = *pictures.diff->bounds;
    const double width = pictures.golden->width;
    const double height = pictures.golden->height;
    constexpr double kRoom = 0.7;  // of the view that the difference fills
    constexpr double kEnough = 16;
    const double larger = std::max(kRoom * std::min(width / bounds.width, height / bounds.height), 1.0);
    set_zoom(review.look, std::min(review.look.fits * larger, kEnough));
    review.look.middle = {(bounds.x + bounds.width / 2.0) / width, (bounds.y + bounds.height / 2.0) / height};
}

Command pan_command(std::string_view id, std::string_view title, std::string_view shortcut, double right, double down) {
    const auto pan = [right, down](ReviewScreen& screen) {
        ReviewLook& look = screen.review()->look;
        const double step = kPanStep / std::max(look.scale() / look.fits, 1.0);
        look.middle = glm::clamp(look.middle + step * glm::dvec2(right, down), 0.0, 1.0);
    };
    return {id,
            title,
            "Moves over the pictures; a drag does the same.",
            pan,
            {.menu = "Review/Zoom", .shortcut = shortcut, .repeats = true, .enabled = has_review}};
}

std::vector<Command> zoom_commands() {
    const std::string_view menu = "Review/Zoom";
    return {
        Command("review.fit", "Whole picture", "Shows all of the pictures.",
                [](ReviewScreen& screen) {
                    screen.review()->look.zoom = 0;
                    screen.review()->look.middle = glm::dvec2(0.5);
                },
                {.menu = menu, .shortcut = "F Home", .enabled = has_review}),
        Command("review.actual_size", "Actual size", "One pixel of the window for each pixel of the pictures.",
                [](ReviewScreen& screen) { set_zoom(screen.review()->look, 1); },
                {.menu = menu, .shortcut = "0", .enabled = has_review}),
        Command("review.zoom_in", "Zoom in", "Shows the pictures twice as large.",
                [](ReviewScreen& screen) { zoom_by(screen, true); },
                {.menu = menu, .shortcut = "= Shift+=", .repeats = true, .enabled = has_review}),
        Command("review.zoom_out", "Zoom out", "Shows the pictures half as large.",
                [](ReviewScreen& screen) { zoom_by(screen, false); },
                {.menu = menu, .shortcut = "-", .repeats = true, .enabled = has_review}),
        Command("review.zoom_to_difference", "Zoom to the difference",
                "Shows the part of the pictures that holds all pixels that differ.", zoom_to_difference,
                {.menu = menu, .shortcut = "D", .enabled = has_review}),
        pan_command("review.pan_left", "Move to the left", "Shift+Left", -1, 0),
        pan_command("review.pan_right", "Move to the right", "Shift+Right", 1, 0),
        pan_command("review.pan_up", "Move up", "Shift+Up", 0, -1),
        pan_command("review.pan_down", "Move down", "Shift+Down", 0, 1),
    };
}

void accept_cases(ReviewScreen& screen, const std::vector<std::size_t>& indices) {
    for (const ReviewNews& news : screen.review()->goldens.accept(indices)) screen.tell(news);
    screen.poll();
}

constexpr std::string_view kItsCasesWait = "its cases are being drawn: wait, or stop the run";

std::string_view why_no_undo(const ReviewScreen& screen) {
    return screen.review()->goldens.has_undo() ? kItsCasesWait : "nothing was accepted";
}

std::string_view why_no_redo(const ReviewScreen& screen) {
    return screen.review()->goldens.has_redo() ? kItsCasesWait : "nothing was undone";
}

std::vector<Command> golden_commands() {
    return {
        Command("review.accept", "Accept", "Makes the picture the case's golden.",
                [](ReviewScreen& screen) { accept_cases(screen, {screen.review()->current()}); },
                {.shortcut = "A",
                 .enabled = when([](const Review& review) { return review.why_not_accept(review.current()).empty(); },
                                 []() -> std::string_view { return "this case has nothing to accept"; })}),
        Command("review.mark", "Mark", "Marks a case, to accept it with others; without a name the one that is shown.",
                toggle_mark,
                {.shortcut = "M", .argument = "[CASE]", .enabled = has_review, .checked = so([](const Review& review) {
                                                                                   return review.shown().marked;
                                                                               })}),
        Command("review.mark_failing", "Mark all that can be accepted",
                "Marks every case that did not pass and has a picture to accept; takes other marks away.", mark_failing,
                {.shortcut = "Ctrl+A", .enabled = has_review}),
        Command("review.accept_marked", "Accept marked cases", "Makes the pictures of all marked cases their goldens.",
                [](ReviewScreen& screen) { accept_cases(screen, screen.review()->marked()); },
                {.shortcut = "Shift+A",
                 .enabled = when([](const Review& review) { return !review.marked().empty(); },
                                 []() -> std::string_view { return "no case is marked"; })}),
        Command("review.accept_viewed", "Accept all that were viewed",
                "Makes goldens of the pictures of all failing cases that were viewed.",
                [](ReviewScreen& screen) { accept_cases(screen, screen.review()->viewed()); },
                {.shortcut = "Ctrl+Shift+A",
                 .enabled = when([](const Review& review) { return !review.viewed().empty(); },
                                 []() -> std::string_view { return "no case that can be accepted was viewed"; })}),
        Command("review.undo", "Undo", "Restores the goldens that were there before.",
                [](ReviewScreen& screen) { screen.tell(screen.review()->goldens.undo()); },
                {.shortcut = "Ctrl+Z",
                 .enabled = when([](const Review& review) { return review.goldens.can_undo(); }, why_no_undo),
                 .title_end = [](const ReviewScreen& screen) { return ' ' + screen.review()->goldens.undo_title(); }}),
        Command("review.redo", "Redo", "Accepts again the pictures that were undone.",
                [](ReviewScreen& screen) { screen.tell(screen.review()->goldens.redo()); },
                {.shortcut = "Ctrl+Y Ctrl+Shift+Z",
                 .enabled = when([](const Review& review) { return review.goldens.can_redo(); }, why_no_redo),
                 .title_end = [](const ReviewScreen& screen) { return ' ' + screen.review()->goldens.redo_title(); }}),
    };
}

Condition if_idle() {
    return when([](const Review& review) { return !review.run.drawing(); },
                []() -> std::string_view { return "cases are being drawn"; });
}

void copy_line(const ReviewScreen& screen, Desktop& desktop, Notifications& notifications) {
    const Review& review = *screen.review();
    const std::string line = test_command_line(review.run.drawer(), review.folder(), review.shown().file.name);
    desktop.set_clipboard(line);
    notifications.tell(MessageLevel::info, "Copied: " + line);
}

std::vector<Command> run_commands() {
    return {
        Command("review.draw", "Draw the case again", "Draws the case anew and compares it.",
                [](ReviewScreen& screen) {
                    screen.review()->run.draw({screen.review()->current()});
                    screen.poll();
                },
                {.shortcut = "R", .enabled = if_idle()}),
        Command("review.draw_all", "Draw all cases again", "Draws all cases anew and compares them.",
                [](ReviewScreen& screen) {
                    screen.review()->run.draw_all();
                    screen.poll();
                },
                {.shortcut = "Shift+R F5", .enabled = if_idle()}),
        Command("review.cancel", "Stop drawing", "Stops; cases that are not drawn yet stay as they were.",
                &ReviewScreen::cancel,
                {.enabled = when([](const Review& review) { return review.run.drawing(); },
                                 []() -> std::string_view { return "nothing is drawn"; })}),
        Command("review.open", "Open the case as a scene",
                "Opens what the case draws in place of the picture tests; what was open is back when they are left.",
                [](ReviewScreen& screen) { screen.open_case(screen.review()->current()); },
                {.shortcut = "Enter", .enabled = has_review}),
        Command("review.copy_command", "Copy as command", "Copies the command line that draws and compares the case.",
                copy_line, {.shortcut = "Ctrl+Shift+C", .enabled = has_review}),
        Command("review.leave", "Leave the picture tests", "Shows the scene again that was open before.",
                leave_or_put_away, {.shortcut = "Escape", .enabled = has_review}),
    };
}

}  // namespace

std::vector<Command> review_commands() {
    std::vector<Command> rows = in_menu(
        "Review", joined({case_commands(), mode_commands(), zoom_commands(), golden_commands(), run_commands()}));
    rows.push_back(Command("review.back", "Back to the picture tests", "Shows the picture tests again.",
                           &ReviewScreen::back,
                           {.menu = "File",
                            .shortcut = "Ctrl+R",
                            .enabled = {has_review, []() -> std::string_view { return "no picture tests were shown"; }},
                            .where = Where::scene}));
    rows.push_back(Command(
        "file.review", "Review picture tests...",
        "Draws the picture tests of a folder and shows what differs from their goldens. With a report of mobbscope "
        "test, both in quotes, it shows that and draws nothing.",
        review_folder,
        {.menu = "File",
         .behind = "file.demo",
         .argument = "[FOLDER]",
         .enabled = always,
         .where = Where::everywhere}));
    return rows;
}

}  // namespace mobbscope::app
