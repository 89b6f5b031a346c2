#include <base/text.h>
#include <cli/command_line.h>
#include <cli/program.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace mobbscope::cli {

namespace {

constexpr std::size_t kLongestComplaint = 200;  // of CLI11, which repeats what it was given

/// What is wrong with the value of a flag; CLI11 does not check it where a function takes the flag.
std::string complaint_about_flag(const std::string& text) {
    errno = 0;
    bool is_flag = true;
    try {
        CLI::detail::to_flag_value(text);
        is_flag = errno != EINVAL;  // from CLI11 2.4 on
    } catch (const std::logic_error&) {
        is_flag = false;  // before
    }
    return is_flag ? "" : in_quotes(text) + " is neither true nor false";
}

/// What `set` throws as std::invalid_argument becomes bad usage of the option.
std::function<void(const std::string&)> or_refuse(const std::string& name,
                                                  std::function<void(const std::string&)> set) {
    return [name, set = std::move(set)](const std::string& text) {
        try {
            set(text);
        } catch (const std::invalid_argument& error) {
            throw UsageError(name + ": " + error.what());
        }
    };
}

}  // namespace

Option& Option::required() {
    option_->required();
    return *this;
}

Option& Option::group(const std::string& headline) {
    option_->group(headline);
    return *this;
}

Option& Option::needs(const Option& other) {
    option_->needs(other.option_);
    return *this;
}

Option& Option::excludes(const Option& other) {
    option_->excludes(other.option_);
    return *this;
}

Option& Option::among(const std::vector<std::string>& allowed) {
    option_->check(CLI::IsMember(allowed));
    return *this;
}

Option& Option::any_number() {
    option_->expected(0, -1);
    return *this;
}

Command::Command() : app_(std::make_shared<CLI::App>()) { app_->set_help_flag(); }

Command::Command(const std::string& name, const std::string& description)
    : app_(std::make_shared<CLI::App>(description, name)) {
    app_->require_subcommand(0, 1);
}

Command::Command(std::shared_ptr<CLI::App> app) : app_(std::move(app)) {}

void Command::add_subcommand(const std::string& name, const std::string& description,
                             std::function<void(Command&)> add_options) {
    CLI::App* const added = app_->add_subcommand(name, description);
    Command& command = subcommands_.emplace_back(app_->get_subcommand_ptr(added));
    command.status_ = status_;
    added->preparse_callback([this, &command, add_options = std::move(add_options)](std::size_t) {
        add_options(command);
        if (!version_.empty()) command.app_->set_version_flag("--version", version_);
    });
}

void Command::require_subcommand() { app_->require_subcommand(1); }

void Command::add_version(const std::string& text) {
    version_ = text;
    app_->set_version_flag("--version", text);
}

Option Command::add_flag(const std::string& name, bool& target, const std::string& help) {
    return Option(*app_->add_flag(name, target, help));
}

Option Command::add_flag(const std::string& name, std::function<void(bool)> set, const std::string& help) {
    const auto set_sign = [set = std::move(set)](std::int64_t given) { set(given > 0); };
    return Option(*app_->add_flag_function(name, set_sign, help)->check(complaint_about_flag));
}

Option Command::add_option(const std::string& name, std::function<void(const std::string&)> set,
                           const std::string& help, const std::string& placeholder) {
    return Option(
        *app_->add_option_function<std::string>(name, or_refuse(name, std::move(set)), help)->type_name(placeholder));
}

Option Command::add_repeated_option(const std::string& name, std::function<void(const std::string&)> set,
                                    const std::string& help, const std::string& placeholder) {
    const auto set_each = [set = or_refuse(name, std::move(set))](const std::vector<std::string>& texts) {
        for (const std::string& text : texts) set(text);
    };
    return Option(*app_->add_option_function<std::vector<std::string>>(name, set_each, help)
                       ->type_name(placeholder)
                       ->allow_extra_args(false));
}

Option Command::add_list_option(const std::string& name,
                                const std::function<void(const std::vector<std::string>&)>& set,
                                const std::string& help, const std::string& placeholder) {
    return Option(
        *app_->add_option_function<std::vector<std::string>>(name, set, help)->type_name(placeholder)->expected(1, -1));
}

template <class T>
requires(!std::invocable<T, const std::string&>) Option Command::add_option(const std::string& name, T& target,
                                                                            const std::string& help,
                                                                            const std::string& placeholder) {
    return Option(*app_->add_option(name, target, help)->type_name(placeholder));
}
template Option Command::add_option(const std::string&, std::string&, const std::string&, const std::string&);
template Option Command::add_option(const std::string&, std::optional<std::string>&, const std::string&,
                                    const std::string&);
template Option Command::add_option(const std::string&, std::filesystem::path&, const std::string&, const std::string&);
template Option Command::add_option(const std::string&, std::optional<std::filesystem::path>&, const std::string&,
                                    const std::string&);
template Option Command::add_option(const std::string&, std::vector<std::string>&, const std::string&,
                                    const std::string&);
template Option Command::add_option(const std::string&, std::vector<std::filesystem::path>&, const std::string&,
                                    const std::string&);

void Command::callback(std::function<void()> run) { app_->callback(std::move(run)); }

void Command::before_subcommand(std::function<void()> check) { app_->parse_complete_callback(std::move(check)); }

std::string Command::parse(std::vector<std::string> words) {
    std::reverse(words.begin(), words.end());  // as CLI11 takes them
    try {
        app_->parse(std::move(words));
        return {};
    } catch (const CLI::ParseError& end) {
        // Help and version are results; everything else is bad usage, whatever code CLI11 has for it.
        if (end.get_exit_code() != 0) throw UsageError(shortened(cleaned(end.what()), kLongestComplaint));
        std::ostringstream answer;
        app_->exit(end, answer, answer);
        return answer.str();
    }
}

std::string Command::name() const { return app_->get_name(); }

std::string Command::chosen() const {
    std::string names;
    for (std::vector<CLI::App*> at = app_->get_subcommands(); !at.empty(); at = at.front()->get_subcommands()) {
        names += (names.empty() ? "" : " ") + at.front()->get_name();
    }
    return names;
}

bool Command::is_given(const std::string& name) const { return app_->count(name) > 0; }

std::vector<GivenOption> Command::given() const {
    std::vector<GivenOption> given;
    for (const CLI::Option* option : app_->get_options()) {
        if (option->count() > 0) given.push_back({option->get_name(), option->results().front()});
    }
    return given;
}

}  // namespace mobbscope::cli
