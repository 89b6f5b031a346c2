#include <render/layout/legend.h>
#include <render/layout/text_budget.h>

#include <algorithm>

namespace mobbscope {

TextBudget fit_to_budget(const Caption& caption, std::vector<LegendEntry> legend, glm::vec2 map, PictureSize size,
                         const Metrics& metrics) {
    const glm::vec2 picture(size.width, size.height);
    const float room = picture.x - 2 * metrics.pad;
    for (LegendEntry& entry : legend) {
        entry.text = fit_text(entry.text, FontFace::text, metrics.small, 0.45f * picture.x);
    }
    TextBudget words{caption_lines(caption, room, metrics.scale, 2), std::move(legend), map};
    const auto fits = [&] {
        const auto area = [](glm::vec2 extent) { return extent.x * extent.y; };
        const float covered = area(caption_size(caption, words.caption, metrics.scale)) +
                              area(legend_size(words.legend, metrics.small)) + area(words.map);
        return covered <= kMostWords * area(picture);
    };
    if (fits()) return words;
    std::erase_if(words.legend, [](const LegendEntry& entry) { return entry.mark == LegendEntry::Mark::remark; });
    if (fits()) return words;
    words.map = glm::vec2(0);
    if (fits()) return words;
    words.legend.clear();
    if (fits()) return words;
    words.caption.detail.clear();
    if (fits()) return words;
    if (caption.headlines.empty()) return words;
    words.caption.headline = caption_lines(caption, room, metrics.scale, 1).headline;
    // A line that breaks off before the outcome says nothing.
    const bool whole = words.caption.headline == std::vector<std::string>{caption.headlines.back()};
    if (whole && fits()) return words;
    words.caption.headline.clear();
    return words;
}

}  // namespace mobbscope
