/// The command line: commands, their options and arguments, what --help says of them, and where their values go.
///
/// CLI11 reads it. Only command_line.cpp includes that library, as every file that does takes many seconds to compile.
#pragma once

#include <concepts>
#include <functional>
#include <list>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace mobbscope::cli {

/// What else holds for an option, a flag or an argument: a handle that is good while its command lives.
class Option {
  public:
    explicit Option(CLI::Option& option) : option_(&option) {}

    Option& required();
    /// Stands under this headline in the help.
    Option& group(const std::string& headline);
    /// Bad usage without the other.
    Option& needs(const Option& other);
    /// Bad usage together with the other.
    Option& excludes(const Option& other);
    /// Takes these texts alone.
    Option& among(const std::vector<std::string>& allowed);
    /// Takes as many values as follow, or none.
    Option& any_number();

  private:
    CLI::Option* option_;
};

/// An option, a flag or an argument that stands on the command line.
struct GivenOption {
    std::string name;   ///< as in the help: the long one, such as "--output", or an argument's, such as "FILE"
    std::string value;  ///< the first
};

/// A program, or a command of one. Names of options are as "-o,--output"; a name without dashes is an argument that
/// stands by itself. Targets must live until the command has run; those that are not given stay as they are.
class Command {
  public:
    /// Options alone, without --help, as in a line of a file.
    Command();
    /// A program; its arguments may name one command at most.
    Command(const std::string& name, const std::string& description);
    /// Not for callers: what CLI11 knows of a command.
    explicit Command(std::shared_ptr<CLI::App> app);

    Command(const Command&) = delete;
    Command& operator=(const Command&) = delete;

    /// `add_options` is called when the command is asked for, with a command that lives as long as this one: the
    /// options of all commands would take longer than most commands do.
    void add_subcommand(const std::string& name, const std::string& description,
                        std::function<void(Command&)> add_options);
    /// The same for options that are read into `Arguments`, which `run` gets, alone or behind the command. It runs
    /// within the program's parse(); the status is what it returns, if anything.
    template <class Arguments, class Run>
    void add_subcommand(const std::string& name, const std::string& description,
                        void (*add_options)(Command&, Arguments&), Run run) {
        add_subcommand(name, description, [add_options, run, status = status_](Command& command) {
            const auto arguments = std::make_shared<Arguments>();
            add_options(command, *arguments);
            command.callback([&command, arguments, run, status] {
                const auto call = [&] {
                    if constexpr (std::invocable<Run, Arguments&>)
                        return run(*arguments);
                    else
                        return run(command, *arguments);
                };
                if constexpr (std::is_void_v<decltype(call())>)
                    call();
                else
                    *status = call();
            });
        });
    }
    /// Bad usage without a subcommand.
    void require_subcommand();

    /// Adds --version, which says `text`, here and to the subcommands.
    void add_version(const std::string& text);
    Option add_flag(const std::string& name, bool& target, const std::string& help);
    /// `set` gets false for the names that begin with "!", as in "--floor,!--no-floor".
    Option add_flag(const std::string& name, std::function<void(bool)> set, const std::string& help);
    /// The std::invalid_argument that `set` throws becomes bad usage of the option.
    Option add_option(const std::string& name, std::function<void(const std::string&)> set, const std::string& help,
                      const std::string& placeholder);
    /// The same of an option that may be given more than once: `set` gets each.
    Option add_repeated_option(const std::string& name, std::function<void(const std::string&)> set,
                               const std::string& help, const std::string& placeholder);
    /// The same with as many texts as follow.
    Option add_list_option(const std::string& name, const std::function<void(const std::vector<std::string>&)>& set,
                           const std::string& help, const std::string& placeholder);
    /// `target`: a text, a path, a path that need not be given, or a list of texts or paths.
    template <class T>
    requires(!std::invocable<T, const std::string&>) Option
        add_option(const std::string& name, T& target, const std::string& help,
                   const std::string& placeholder = "TEXT");

    /// Runs when everything is read, before the subcommand does.
    void before_subcommand(std::function<void()> check);

    /// Reads the words behind the program's name and runs the command. Returns what --help or --version ask for, and
    /// then runs nothing; else an empty text. Throws UsageError, and what the command throws.
    std::string parse(std::vector<std::string> words);

    std::string name() const;
    const std::list<Command>& subcommands() const { return subcommands_; }
    /// The names of the subcommands that are asked for, as in "graph build"; empty if none is.
    std::string chosen() const;
    /// Whether the option of this name stands on the command line.
    bool is_given(const std::string& name) const;
    /// All that stand there, in the order in which they were added.
    std::vector<GivenOption> given() const;
    /// What the command that ran left as the program's exit status; 0 before.
    int status() const { return *status_; }

  private:
    void callback(std::function<void()> run);

    std::shared_ptr<CLI::App> app_;
    std::list<Command> subcommands_;
    std::string version_;                                     ///< what --version says
    std::shared_ptr<int> status_ = std::make_shared<int>(0);  ///< of the program, for all of its commands
};

/// Adds an option whose text goes through `parse`; the std::invalid_argument that it throws becomes bad usage.
template <class Parse, class T>
Option add_parsed(Command& command, const std::string& name, T& target, Parse parse, const std::string& help,
                  const std::string& placeholder) {
    return command.add_option(
        name, [&target, parse](const std::string& text) { target = parse(text); }, help, placeholder);
}

}  // namespace mobbscope::cli
