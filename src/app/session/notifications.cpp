#include <app/session/notifications.h>
#include <base/text.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace mobbscope::app {

namespace {

constexpr std::size_t kMostMessages = 50;
/// How long a message lies over the picture; one with an offer stays longer, and none goes sooner than this after the
/// mouse has left it.
constexpr double kInfoSeconds = 4;
constexpr double kErrorSeconds = 10;
constexpr double kOfferSeconds = 20;
constexpr double kLeftSeconds = 2;
constexpr std::size_t kLongestMessage = 500;  // characters; names of files may be longer

}  // namespace

void Notifications::tell(MessageLevel level, const std::string& text, std::vector<MessageOffer> offers) {
    const std::string said = shortened(text, kLongestMessage);
    // Twice the same says nothing new.
    std::erase_if(messages_, [&](const Message& message) { return message.text == said; });
    messages_.push_back({level, said, std::move(offers), {}, 0, true, level == MessageLevel::info});
    if (messages_.size() > kMostMessages) messages_.erase(messages_.begin());
}

void Notifications::tell_of_window(MessageLevel level, const std::string& text, std::vector<MessageOffer> offers) {
    tell(level, text, std::move(offers));
    messages_.back().of_window = true;
}

void Notifications::take_down(const std::string& text) {
    for (Message& message : messages_) {
        if (message.text == shortened(text, kLongestMessage)) message.up = false;
    }
}

void Notifications::retire() {
    for (Message& message : messages_) {
        if (message.level == MessageLevel::info || message.of_window) continue;
        message.up = false;
        message.read = true;
    }
}

std::size_t Notifications::unread() const {
    return static_cast<std::size_t>(std::ranges::count(messages_, false, &Message::read));
}

void Notifications::mark_read() {
    put_away();
    for (Message& message : messages_) message.read = true;
}

void Notifications::dismiss_offers(std::string_view command, std::string_view argument) {
    const auto is_it = [&](const MessageOffer& offer) {
        return offer.command == command && (argument.empty() || offer.argument == argument);
    };
    std::erase_if(messages_, [&](const Message& message) { return std::ranges::any_of(message.offers, is_it); });
}

void Notifications::withdraw_offers() {
    for (Message& message : messages_) {
        if (!message.of_window) message.offers.clear();
    }
}

void Notifications::put_away() {
    for (Message& message : messages_) message.up = false;
}

double Notifications::age(double now, bool held) {
    double next = std::numeric_limits<double>::infinity();
    for (Message& message : messages_) {
        if (!message.up) continue;
        if (!message.shown_at) {
            message.shown_at = now;
            message.goes_at = now + (!message.offers.empty()               ? kOfferSeconds
                                     : message.level == MessageLevel::info ? kInfoSeconds
                                                                           : kErrorSeconds);
        }
        if (held) message.goes_at = std::max(message.goes_at, now + kLeftSeconds);
        message.up = now < message.goes_at;
        if (message.up) next = std::min(next, message.goes_at - now);
    }
    return next;
}

bool Notifications::has_up() const {
    return std::ranges::any_of(
        messages_, [](const Message& message) { return message.up && message.level != MessageLevel::info; });
}

void Notifications::dismiss(std::size_t message) {
    if (message < messages_.size()) messages_.erase(messages_.begin() + static_cast<std::ptrdiff_t>(message));
}

}  // namespace mobbscope::app
