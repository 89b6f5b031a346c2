#include <render/caption.h>
#include <render/label_layout.h>
#include <render/level_boxes.h>
#include <render/query_boxes.h>
#include <render/query_progress.h>
#include <render/query_sentence.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>

namespace mobbscope {

namespace {

/// "mobb" as "MOBB", "hybrid1" as it stands.
std::string tree_title(mobb::TreeKind kind) {
    std::string text(mobb::name(kind));
    if (text.find("mobb") != std::string::npos) {
        std::transform(text.begin(), text.end(), text.begin(),
                       [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    }
    return text;
}

std::string levels_text(const LevelRange& levels, int last) {
    if (levels.leaves) return "leaves";
    const int first = std::min(levels.first, last);
    if (first == last) return "level " + std::to_string(first);
    return "levels " + std::to_string(first) + " to " + std::to_string(last);
}

/// The boxes of one level can be compared by their volume; those of several levels contain one another.
std::string boxes_text(std::span<const Subject> subjects, const LevelRange& levels) {
    std::size_t count = 0;
    double total = 0;
    int last = 0;
    for (const Subject& subject : subjects) {
        const mobb::Tree& tree = subject.placed.tree();
        last = std::max(last, last_shown_level(tree, levels));
        for (const int node : shown_nodes(tree, levels)) {
            total += mobb::volume(subject.placed.node(node).box, tree.time_scale());
            ++count;
        }
    }
    std::string text = levels_text(levels, last) + ", " + std::to_string(count) + (count == 1 ? " box" : " boxes");
    if (levels.leaves || std::min(levels.first, last) == last) {
        char volume[48];
        std::snprintf(volume, sizeof volume, total >= 1000 && total < 1e9 ? "%.0f" : "%.3g", total);
        text += std::string(", ") + volume + " m\u00B2\u00B7s";
    }
    return text;
}

}  // namespace

Caption scene_caption(const Palette&, const FittedScene& fitted, std::span<const Subject> subjects,
                      const ViewState& view) {
    Caption caption;
    caption.headline = fitted.scene().file.empty() ? "scene" : fitted.scene().file.stem().string();
    if (view.boxes) {
        caption.detail = tree_title(fitted.options().tree) + ", leaf " + std::to_string(fitted.options().leaf) +
                         "  \u00B7  " + boxes_text(subjects, view.levels);
    }
    return caption;
}

Caption query_caption(const Palette& palette, std::span<const Subject> sides, const RecordedQuery& recorded, int step) {
    Caption caption;
    caption.headline = step_sentence(sides, recorded.trace, step);
    caption.detail = tree_title(sides[0].placed.tree().options().tree) + ", leaf " +
                     std::to_string(sides[0].placed.tree().options().leaf) + "  \u00B7  " +
                     answer_sentence(sides, recorded);
    const mobb::Outcome outcome = recorded.trace[step].outcome;
    caption.mark = outcome_style(box_state(outcome), palette).color;
    return caption;
}

float add_caption(DrawList& list, const Caption& caption, float margin, float scale) {
    const float size = std::round(16 * scale);
    const float detail_size = std::round(12 * scale);
    const bool marked = caption.mark.a > 0;
    const float indent = marked ? std::round(1.1f * size) : 0.0f;
    const float room = static_cast<float>(list.size.width) - 2 * margin - indent;
    list.headline = caption.headline;
    std::vector<std::string> lines = wrap_text(caption.headline, FontFace::text, size, room);
    if (lines.size() > 2) {
        // The rest is cut off visibly rather than run down the picture.
        for (std::size_t i = 2; i < lines.size(); ++i) lines[1] += ' ' + lines[i];
        lines.resize(2);
    }
    float y = margin;
    if (marked) {
        const float r = 0.3f * size;
        const glm::vec2 middle(margin + r, y + 0.56f * line_height(FontFace::text, size));
        list.panels.push_back({{middle - r, middle + r}, r, caption.mark, Rgba(0), 0});
    }
    for (const std::string& line : lines) {
        list.texts.push_back(text_at(fit_text(line, FontFace::text, size, room), FontFace::text, size,
                                     list.palette.text, {margin + indent, y}));
        y += line_height(FontFace::text, size);
    }
    y += std::round(3 * scale);
    for (const std::string& line : wrap_text(caption.detail, FontFace::text, detail_size, room)) {
        list.texts.push_back(text_at(fit_text(line, FontFace::text, detail_size, room), FontFace::text, detail_size,
                                     list.palette.quiet_text, {margin + indent, y}));
        y += line_height(FontFace::text, detail_size);
    }
    return y;
}

}  // namespace mobbscope
