/// Lines for the person: over the picture for some seconds, then in the list behind the bell.
#pragma once

#include <app/document/message_level.h>

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope::app {

/// A command that a message offers; it is drawn as a button.
struct MessageOffer {
    std::string command;   ///< its id
    std::string argument;  ///< empty: none
    std::string label;     ///< "Mend unit..."
};

/// What went wrong and what to do, or what was done.
struct Message {
    MessageLevel level = MessageLevel::info;
    std::string text;
    std::vector<MessageOffer> offers{};  ///< none once another document is open, if they were about the last one
    std::optional<double> shown_at{};    ///< seconds of the window's clock, when it was shown first
    double goes_at = 0;                  ///< ... when it goes behind the bell; only once it was shown
    bool up = true;                      ///< it lies over the picture
    bool read = false;                   ///< the list was opened since, or it was only what was done (info)
    bool of_window = false;              ///< about no scene: it stays when another one is opened
};

class Notifications {
  public:
    void tell(MessageLevel level, const std::string& text, std::vector<MessageOffer> offers = {});
    /// About no scene: see Message::of_window.
    void tell_of_window(MessageLevel level, const std::string& text, std::vector<MessageOffer> offers = {});
    /// The oldest first, at most 50; the list behind the bell.
    const std::vector<Message>& all() const { return messages_; }
    /// Whether a warning or an error lies over the picture: what was only done goes by itself.
    bool has_up() const;
    /// How many warnings and errors nobody has looked at in the list.
    std::size_t unread() const;
    /// The list was opened: all count as read, and none lies over the picture any more.
    void mark_read();
    /// Takes one out of the list.
    void dismiss(std::size_t message);
    void clear() { messages_.clear(); }
    /// ... those that offer this command, with this argument if one is given.
    void dismiss_offers(std::string_view command, std::string_view argument = {});
    /// What messages offer is over: it was about another scene.
    void withdraw_offers();
    /// Warnings and errors so far were about what was shown before.
    void retire();
    /// That message goes behind the bell, if it lies over the picture.
    void take_down(const std::string& text);
    /// All of them do.
    void put_away();
    /// The window shows its messages at this time of its clock: those whose time is over go behind the bell. `held`:
    /// the mouse is on them, so none goes. Returns in how many seconds the next one goes; infinity: none is up.
    double age(double now, bool held);

  private:
    std::vector<Message> messages_;
};

}  // namespace mobbscope::app
