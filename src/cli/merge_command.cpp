#include <cli/command_line.h>
#include <cli/conflict_listing.h>
#include <cli/program.h>

#include <filesystem>
#include <vector>

namespace mobbscope::cli {

namespace {

struct MergeArguments {
    std::vector<std::filesystem::path> files;
    bool json = false, csv = false;
};

void run_merge(const MergeArguments& arguments) {
    ConflictListing whole = merged_listing(arguments.files);
    if (arguments.json) whole.format = ListingFormat::json;
    if (arguments.csv) whole.format = ListingFormat::csv;
    write_listing(whole);
    flush_results();
}

void add_merge_options(Command& command, MergeArguments& arguments) {
    command.add_option("PART", arguments.files, "What conflicts --part has written, all parts of one whole").required();
    const Option json =
        command.add_flag("--json", arguments.json, "The whole as JSON, whatever its parts were asked for as");
    command.add_flag("--csv", arguments.csv, "The whole as CSV, likewise").excludes(json);
}

}  // namespace

void add_merge_command(Command& program) {
    program.add_subcommand("merge", "Puts the parts of conflicts --part together: what conflicts without it writes",
                           add_merge_options, run_merge);
}

}  // namespace mobbscope::cli
