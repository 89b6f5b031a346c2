#include <base/text.h>
#include <explain/query_sentence.h>
#include <render/layout/annotations.h>
#include <render/layout/caption.h>
#include <render/parts/node_boxes.h>
#include <render/query/query_boxes.h>
#include <render/text/labels.h>
#include <scene/arrangement.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace mobbscope {

namespace {

constexpr const char* kDot = "  \u00B7  ";

struct Sizes {
    float headline, detail, indent, between;
    std::size_t most_lines;  ///< of the headline, and of the detail
    Sizes(float scale, CaptionSize size)
        : headline(std::round((size == CaptionSize::large ? 16.0f : 12.0f) * scale)),
          detail(std::round(12 * scale)),
          indent(std::round(1.1f * headline)),
          between(std::round(3 * scale)),
          most_lines(size == CaptionSize::large ? 2 : 4) {}
};

/// The first of the texts that so many lines hold. The rest of the last one is cut off visibly rather than run down the
/// picture, and so are words too long for a line; returns whether nothing is cut off.
bool wrap(std::span<const std::string> texts, std::size_t most, float text_size, float room,
          std::vector<std::string>& lines) {
    for (const std::string& text : texts) {
        lines = wrap_text(text, FontFace::text, text_size, room);
        if (lines.size() <= most) break;
    }
    for (std::size_t i = most; i < lines.size(); ++i) lines[most - 1] += ' ' + lines[i];
    lines.resize(std::min(lines.size(), most));
    bool whole = true;
    for (std::string& line : lines) {
        std::string fits = fit_text(line, FontFace::text, text_size, room);
        whole &= fits == line;
        line = std::move(fits);
    }
    return whole;
}

std::string levels_text(const LevelRange& levels, int last) {
    if (levels.leaves) return "leaves";
    const int first = std::min(levels.first, last);
    if (first == last) return "level " + std::to_string(first);
    return "levels " + std::to_string(first) + " to " + std::to_string(last);
}

/// The boxes of one level can be compared by their volume; those of several levels contain one another.
std::string boxes_text(std::span<const DrawnAgent> agents, const LevelRange& levels) {
    std::size_t count = 0;
    double total = 0;
    int last = 0;
    for (const DrawnAgent& agent : agents) {
        if (!agent.is_whole()) continue;
        const mobb::Tree& tree = agent.placed.tree();
        last = std::max(last, last_shown_level(tree, levels));
        for (const int node : shown_nodes(agent, levels)) {
            total += mobb::volume(tree.box(node), tree.time_scale());
            ++count;
        }
    }
    std::string text = levels_text(levels, last) + ", " + std::to_string(count) + (count == 1 ? " box" : " boxes");
    if (levels.leaves || std::min(levels.first, last) == last) {
        text += ", " + figure(total, 3) + " m\u00B2\u00B7s";
    }
    return text;
}

/// "MOBB, leaf 10".
std::string fit_words(const mobb::FitOptions& fit) {
    const mobb::TreeInfo& tree = mobb::info(fit.tree);
    return std::string(tree.title) + (tree.splits() ? ", leaf " + std::to_string(fit.leaf) : "");
}

void mention_part(Caption& caption, const std::string& node) { mention(caption, "only " + node + " and below"); }

}  // namespace

std::string at_time(double time) { return formatted(" at %.2f s", time); }

Caption scene_caption(const FittedScene& fitted, std::span<const DrawnAgent> agents, const ViewState& view,
                      std::optional<double> box_tests) {
    Caption caption;
    caption.title = fitted.scene().file.stem().string();
    if (!caption.title.empty()) caption.headlines = {caption.title};
    if (view.boxes) caption.detail = fit_words(fitted.options()) + kDot + boxes_text(agents, view.levels);
    if (box_tests) caption.detail += kDot + figure(*box_tests, 2) + " box tests a query";
    if (!names_fit(shown_count(agents)) && !is_in_grid(fitted.scene(), view)) {
        const std::string left_out = std::to_string(shown_count(agents)) +
                                     (fitted.scene().agents.empty() ? " clips" : " agents") + ", unnamed here";
        caption.detail += (caption.detail.empty() ? "" : kDot) + left_out;
    }
    for (const DrawnAgent& agent : agents) {
        if (agent.subtree && agent.is_whole()) mention_part(caption, node_name(agent, *agent.subtree));
    }
    return caption;
}

void mention(Caption& caption, const std::string& text) {
    caption.detail = caption.detail.empty() ? text : text + kDot + caption.detail;
    for (std::string& detail : caption.short_details) detail.insert(0, text + kDot);
}

Caption query_caption(const Palette& palette, std::span<const DrawnAgent> sides, const RecordedQuery& recorded,
                      const QueryProgress& progress) {
    Caption caption;
    const int step = progress.step;
    caption.headlines = step_sentences(sides, recorded.trace, step);
    caption.short_headlines = outcome_sentences(sides, recorded.trace, step);
    caption.title = step_of(step, recorded.trace);
    const std::string fit = fit_words(sides[0].placed.tree().options()) + kDot;
    caption.detail = fit + answer_sentence(sides, recorded);
    caption.short_details = {fit + answer_sentence(with_short_names(sides, kShortName), recorded),
                             fit + cost_words(recorded.tests)};
    if (recorded.trace.stopped()) mention(caption, recording_words(recorded.trace));
    caption.mark = outcome_style(state_found(progress), palette).color;
    return caption;
}

Caption proof_caption(const Palette& palette, std::span<const DrawnAgent> sides, const RecordedQuery& recorded,
                      const QueryProof& proof) {
    Caption caption;
    const std::vector<DrawnAgent> short_names = with_short_names(sides, kShortName);
    for (const std::span<const DrawnAgent> named : {sides, std::span<const DrawnAgent>(short_names)})
        caption.headlines.push_back(named[0].label + " and " + named[1].label + " never collide");
    caption.title = "never collide";
    const std::string fit = fit_words(sides[0].placed.tree().options()) + kDot;
    const std::string doubt = doubt_words(sides[0].label, sides[0].clip(), sides[1].label, sides[1].clip());
    const std::string proven =
        proof_words(proof.certificate, proof.ends) + (doubt.empty() ? "" : " Not proven: " + doubt + '.');
    caption.detail = fit + proven + kDot + cost_words(recorded.tests);
    caption.short_details = {proven};
    caption.mark = palette.separated;
    return caption;
}

void mention_cursor_outside(Caption& caption, double time, double begin, double end) {
    mention(caption,
            to_thousandth(time) + " s lies outside " + to_thousandth(begin) + ".." + to_thousandth(end) + " s");
}

void mention_hidden(Caption& caption, std::span<const std::string> hidden, std::size_t all) {
    if (hidden.empty()) return;
    if (hidden.size() == 1) return mention(caption, hidden[0] + " is hidden");
    if (hidden.size() == 2) return mention(caption, hidden[0] + " and " + hidden[1] + " are hidden");
    mention(caption, std::to_string(hidden.size()) + " of " + std::to_string(all) + " are hidden");
}

void mention_foreground(Caption& caption, std::span<const std::string> foreground) {
    if (foreground.empty()) return;
    if (foreground.size() == 1) return mention(caption, foreground[0] + " is in the foreground");
    if (foreground.size() == 2)
        return mention(caption, foreground[0] + " and " + foreground[1] + " are in the foreground");
    mention(caption, std::to_string(foreground.size()) + " are in the foreground");
}

CaptionLines caption_lines(const Caption& caption, float room, float scale, CaptionSize size) {
    const Sizes sizes(scale, size);
    room -= caption.mark.a > 0 ? sizes.indent : 0;
    std::vector<std::string> headlines = caption.headlines;
    std::vector<std::string> details{caption.detail};
    if (size == CaptionSize::small) {
        headlines.insert(headlines.end(), caption.short_headlines.begin(), caption.short_headlines.end());
        details.insert(details.end(), caption.short_details.begin(), caption.short_details.end());
    }
    CaptionLines out;
    out.size = size;
    out.whole_headline = wrap(headlines, sizes.most_lines, sizes.headline, room, out.headline);
    out.whole_detail = wrap(details, sizes.most_lines, sizes.detail, room, out.detail);
    return out;
}

glm::vec2 caption_size(const Caption& caption, const CaptionLines& lines, float scale) {
    if (lines.headline.empty() && lines.detail.empty()) return glm::vec2(0);
    const Sizes sizes(scale, lines.size);
    const bool marked = caption.mark.a > 0;
    glm::vec2 size(0);
    const auto add = [&](const std::string& line, float text_size) {
        size.x = std::max(size.x, Font::of(FontFace::text).width(line, text_size) + (marked ? sizes.indent : 0));
        size.y += line_height(FontFace::text, text_size);
    };
    for (const std::string& line : lines.headline) add(line, sizes.headline);
    if (!lines.detail.empty()) size.y += sizes.between;
    for (const std::string& line : lines.detail) add(line, sizes.detail);
    return glm::ceil(size);
}

void add_caption(DrawList& list, const Caption& caption, const CaptionLines& lines, glm::vec2 corner, float scale) {
    const Sizes sizes(scale, lines.size);
    glm::vec2 at = corner;
    if (caption.mark.a > 0 && !lines.headline.empty()) {
        const float r = 0.3f * sizes.headline;
        const glm::vec2 middle = at + glm::vec2(r, 0.56f * line_height(FontFace::text, sizes.headline));
        list.panels.push_back({{middle - r, middle + r}, r, caption.mark, Rgba(0), 0});
        at.x += sizes.indent;
    }
    const auto add = [&](const std::string& line, float text_size, Rgba color) {
        list.texts.push_back(text_at(TextRole::caption, line, FontFace::text, text_size, color, at));
        at.y += line_height(FontFace::text, text_size);
    };
    for (const std::string& line : lines.headline) add(line, sizes.headline, list.palette.text);
    if (!lines.detail.empty()) at.y += sizes.between;
    for (const std::string& line : lines.detail) add(line, sizes.detail, list.palette.quiet_text);
}

}  // namespace mobbscope
