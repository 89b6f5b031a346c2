#include <app/document/picture_export.h>
#include <base/text.h>
#include <scene/view_options.h>

#include <algorithm>
#include <optional>
#include <sstream>
#include <stdexcept>

namespace mobbscope::app {

namespace {

/// The keys of what can be left out.
std::vector<std::string_view> keys_to_leave_out() {
    std::vector<std::string_view> out;
    for (const ViewOption& option : view_options()) {
        if (!option.without.empty()) out.push_back(option.key);
    }
    return out;
}

std::set<std::string> parse_without(const std::string& text) {
    std::set<std::string> out;
    if (text == "none") return out;
    const std::vector<std::string_view> known = keys_to_leave_out();
    std::istringstream words(text);
    for (std::string key; words >> key;) {
        if (std::ranges::find(known, key) == known.end()) {
            throw std::invalid_argument(in_quotes(key) + " cannot be left out: give none, or " + listed(known));
        }
        out.insert(key);
    }
    return out;
}

std::string text_of(const std::set<std::string>& without) {
    std::string out;
    for (const std::string& key : without) out += (out.empty() ? "" : " ") + key;
    return out.empty() ? "none" : out;
}

/// The index of a text among an option's choices.
std::size_t choice_in(const std::string& text, const std::vector<std::string>& choices, const char* what) {
    const auto at = std::ranges::find(choices, text);
    if (at == choices.end()) {
        throw std::invalid_argument(in_quotes(text) + " is not a " + what + ": give " +
                                    either(std::vector<std::string_view>(choices.begin(), choices.end())));
    }
    return static_cast<std::size_t>(at - choices.begin());
}

std::vector<ExportOption> all_export_options() {
    const std::vector<std::string> shapes{"free", "kept"};
    const std::vector<std::string> backgrounds{"opaque", "transparent"};
    const std::vector<std::string> themes{"view", "dark", "light"};
    const std::vector<std::string> films{"play", "turn"};
    return {
        {.key = "size",
         .title = "Picture size",
         .doc = "Says how large the export dialog makes pictures, in pixels; viewport: as the picture in the window.",
         .argument = "WxH|viewport",
         .choices = {"viewport", "1280x720", "1920x1080", "2560x1440", "3840x2160", "1080x1080"},
         .parse =
             [](const std::string& text, PictureExport& to) {
                 to.size = text == "viewport" ? std::nullopt : std::optional(parse_size(text));
             },
         .text = [](const PictureExport& of) { return of.size ? size_word(*of.size) : "viewport"; }},
        {.key = "shape",
         .title = "Picture shape",
         .doc = "Says whether the export dialog keeps the picture's shape when a side is changed.",
         .argument = "free|kept",
         .choices = shapes,
         .parse = [shapes](const std::string& text,
                           PictureExport& to) { to.keeps_shape = choice_in(text, shapes, "shape") == 1; },
         .text = [shapes](const PictureExport& of) { return shapes[of.keeps_shape ? 1 : 0]; }},
        {.key = "scale",
         .title = "Picture text and lines",
         .doc = "Says how large text and lines of exported pictures are; 1 suits 1280x720, auto what the size is.",
         .argument = "X|auto",
         .choices = {"auto", "1", "1.5", "2", "3"},
         .parse =
             [](const std::string& text, PictureExport& to) {
                 to.scale = text == "auto" ? 0 : parse_number_within(text, kLeastScale, kMostScale);
             },
         .text = [](const PictureExport& of) { return of.scale > 0 ? format_double(of.scale) : "auto"; }},
        {.key = "samples",
         .title = "Picture samples",
         .doc = "Says how many samples a pixel of exported pictures has: more make smoother edges.",
         .argument = "1|2|4|8",
         .choices = {"1", "2", "4", "8"},
         .parse = [](const std::string& text, PictureExport& to) { to.samples = parse_samples(text); },
         .text = [](const PictureExport& of) { return std::to_string(of.samples); }},
        {.key = "background",
         .title = "Picture transparency",
         .doc = "Says whether exported pictures are transparent where nothing is drawn.",
         .argument = "opaque|transparent",
         .choices = backgrounds,
         .choice_titles = {"Opaque", "Transparent"},
         .parse = [backgrounds](
                      const std::string& text,
                      PictureExport& to) { to.transparent = choice_in(text, backgrounds, "background") == 1; },
         .text = [backgrounds](const PictureExport& of) { return backgrounds[of.transparent ? 1 : 0]; }},
        {.key = "theme",
         .title = "Picture theme",
         .doc = "Says whether exported pictures are dark or light; view: as the window.",
         .argument = "view|dark|light",
         .choices = themes,
         .choice_titles = {"As shown", "Dark", "Light"},
         .parse =
             [themes](const std::string& text, PictureExport& to) {
                 choice_in(text, themes, "theme");
                 to.theme = theme_from_name(text);
             },
         .text = [](const PictureExport& of) { return of.theme ? std::string(name(*of.theme)) : "view"; }},
        {.key = "without",
         .title = "Picture without",
         .doc = "Says what exported pictures leave out, beside what the view does not show: keys of its options.",
         .argument = "none|KEY...",
         .parse = [](const std::string& text, PictureExport& to) { to.without = parse_without(text); },
         .text = [](const PictureExport& of) { return text_of(of.without); }},
        {.key = "film",
         .title = "Film of",
         .doc = "Says what exported films show: the motion, or the query's steps; or the scene from all around.",
         .argument = "play|turn",
         .choices = films,
         .choice_titles = {"From beginning to end", "Once around"},
         .parse = [films](const std::string& text,
                          PictureExport& to) { to.film_turns = choice_in(text, films, "kind of film") == 1; },
         .text = [films](const PictureExport& of) { return films[of.film_turns ? 1 : 0]; }},
        {.key = "turntable",
         .title = "Film's pictures once around",
         .doc = "Says how many pictures an exported film has that goes once around the scene.",
         .argument = "N",
         .choices = {"60", "120", "240", "360"},
         .parse =
             [](const std::string& text, PictureExport& to) {
                 const std::optional<int> count = parse_int(text);
                 if (!count || *count < 1 || *count > kMostTurntable) {
                     throw std::invalid_argument(in_quotes(text) + " is not a number of pictures: give 1 to " +
                                                 std::to_string(kMostTurntable));
                 }
                 to.turntable = *count;
             },
         .text = [](const PictureExport& of) { return std::to_string(of.turntable); }},
        {.key = "rate",
         .title = "Film's pictures a second",
         .doc = "Says how many pictures a second exported films have; auto: 30, and of a query's steps 2.",
         .argument = "FPS|auto",
         .choices = {"auto", "1", "2", "10", "24", "30", "60"},
         .parse =
             [](const std::string& text, PictureExport& to) {
                 to.rate = text == "auto" ? 0 : parse_number_within(text, 1 / kMostFilmRate, kMostFilmRate);
             },
         .text = [](const PictureExport& of) { return of.rate > 0 ? format_double(of.rate) : "auto"; }},
    };
}

}  // namespace

std::span<const ExportOption> export_options() {
    static const std::vector<ExportOption> table = all_export_options();
    return table;
}

}  // namespace mobbscope::app
