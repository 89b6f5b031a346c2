#include <base/error.h>
#include <base/file.h>
#include <base/text.h>
#include <cli/command_line.h>
#include <cli/options.h>
#include <cli/program.h>
#include <cli/render_outputs.h>
#include <render/image/image.h>
#include <render/image/image_diff.h>
#include <render/image/png.h>

#include <filesystem>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope::cli {

namespace {

struct DiffCommandArguments {
    std::filesystem::path a, b;
    std::optional<std::filesystem::path> heat, strip, mask;
    DiffOptions options;
    bool json = false;
};

int parse_pixel_shift(const std::string& text) {
    if (text == "0" || text == "1") return text == "1" ? 1 : 0;
    throw std::invalid_argument(in_quotes(text) + " is neither 0 nor 1: a picture may be shifted by one pixel at most");
}

ImageDiff compare(const DiffCommandArguments& arguments, const Image& a, const Image& b) {
    if (!arguments.mask) return diff(a, b, arguments.options);
    const Image mask = read_mask(*arguments.mask, {b.width, b.height}, arguments.b);
    return diff(a, b, arguments.options, &mask);
}

void check_picture_name(const std::optional<std::filesystem::path>& output) {
    if (!output) return;
    check_file_name(*output);
    check_extension(*output, ".png", "pictures are written as .png; rename the output");
}

void check_outputs(const DiffCommandArguments& arguments) {
    OutputCheck files;
    if (arguments.heat) files.writes({*arguments.heat, {}, {}});
    if (arguments.strip) files.writes({*arguments.strip, {}, {}});
}

/// A, B and, where there is one, the heat map. Throws InputError if that is too large.
Image strip_of(const DiffCommandArguments& arguments, const Image& a, const Image& b, const ImageDiff& found) {
    std::vector<const Image*> pictures{&a, &b};
    if (found.same_size) pictures.push_back(&found.heat);
    return at_place(arguments.strip->string(), "", [&] { return make_strip(pictures); });
}

/// Both or none. Takes the pictures: while the largest strips are packed there is no room for them.
void write_pictures(const DiffCommandArguments& arguments, Image a, Image b, ImageDiff& found) {
    std::string strip, heat;
    std::vector<FileBytes> files;
    if (arguments.heat && found.same_size) {
        heat = png_bytes(found.heat);
        files.push_back({*arguments.heat, heat});
    }
    if (arguments.strip) {
        const Image pictures = strip_of(arguments, a, b, found);
        for (Image* const packed : {&a, &b, &found.heat}) *packed = {};
        strip = png_bytes(pictures);
        files.push_back({*arguments.strip, strip});
    }
    write_files(files);
    if (arguments.heat && !found.same_size)
        warn(arguments.heat->string() + ": not written, as pictures of two sizes have no heat map");
}

int run_diff(const DiffCommandArguments& arguments) {
    check_picture_name(arguments.heat);
    check_picture_name(arguments.strip);
    Image a = read_png(arguments.a);
    Image b = read_png(arguments.b);
    ImageDiff found = compare(arguments, a, b);
    check_outputs(arguments);
    write_pictures(arguments, std::move(a), std::move(b), found);
    if (arguments.json) {
        JsonWriter out(std::cout);
        write_diff(out, found);
    } else {
        std::cout << diff_sentence(found) << '\n';
    }
    flush_results();
    return found.passes ? kDone : kFailed;
}

void add_diff_options(Command& command, DiffCommandArguments& arguments) {
    command.add_option("A.png", arguments.a, "A picture, such as a new one", "").required();
    command.add_option("B.png", arguments.b, "The picture that it is compared with", "").required();
    add_parsed(command, "-o,--output", arguments.heat, parse_output_name, "Heat map: B in grey, differences bright",
               "HEAT.png");
    add_parsed(command, "--strip", arguments.strip, parse_output_name, "A, B and the heat map side by side",
               "STRIP.png");
    const auto parsed_by = [&arguments](void (*set)(DiffOptions&, const std::string&)) {
        return [&arguments, set](const std::string& text) {
            DiffOptions options = arguments.options;
            set(options, text);
            return options;
        };
    };
    add_parsed(command, "--threshold", arguments.options, parsed_by(set_threshold),
               "How far a channel may be off: levels of 255, or a share as 3/255, 1.2%, or a number between 0 "
               "and 1 (3; means of tiles of 32x32 pixels 0.3)",
               "X");
    add_parsed(command, "--allowed", arguments.options, parsed_by(set_allowance),
               "How many pixels may be farther off: 12px, or a share of those compared, 0.1% or 50ppm (20ppm, or "
               "4px where that is more)",
               "P");
    add_parsed(command, "--shift", arguments.options.shift, parse_pixel_shift, "1: something may lie a pixel aside (0)",
               "0|1");
    command.add_option("--mask", arguments.mask, "Compares only where this picture is neither black nor transparent",
                       "MASK.png");
    command.add_flag("--json", arguments.json, "The verdict with all figures as JSON");
}

}  // namespace

void add_diff_command(Command& program) {
    program.add_subcommand("diff",
                           "Compare two pictures; exit status 0 if they agree as far as is asked, 1 if they differ",
                           add_diff_options, run_diff);
}

}  // namespace mobbscope::cli
