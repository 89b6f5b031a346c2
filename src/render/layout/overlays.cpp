#include <base/text.h>
#include <render/layout/legend.h>
#include <render/layout/overlays.h>
#include <render/text/labels.h>

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace mobbscope {

namespace {

using Kind = Overlay::Kind;

constexpr float kWidestWords = 0.4f;  // of the picture, in a legend

float area_of(glm::vec2 size) { return size.x * size.y; }

/// Of all overlays of a picture.
struct PanelSpacing {
    float text = 0;     ///< size of the legend's words and of headers, pixels
    float padding = 0;  ///< between a panel's edge and what is on it
    float gap = 0;      ///< between panels
    float line = 0;     ///< height of a line of text
    float chevron = 0;  ///< side of the square that a chevron stands in; 0: there are none
    float header = 0;   ///< height of a folded panel
    PanelSpacing(const Metrics& metrics, bool controls)
        : text(metrics.small),
          padding(panel_padding(metrics.small)),
          gap(std::round(0.5f * metrics.pad)),
          line(line_height(FontFace::text, metrics.small)),
          chevron(controls ? line : 0),
          header(line + 2 * std::round(0.5f * padding)) {}

    glm::vec2 around(glm::vec2 content) const { return content + 2 * padding; }
    /// Where the words of a folded panel begin, from its left edge.
    float before_words() const { return chevron > 0 ? 0.5f * (header - line) + chevron + 0.3f * text : padding; }
    /// A folded panel with that text; without one the chevron alone.
    glm::vec2 header_size(const std::string& words, bool dot) const {
        if (words.empty()) return glm::vec2(header);
        const float dot_room = dot ? 0.9f * text : 0;
        const float width = dot_room + Font::of(FontFace::text).width(words, text);
        return {std::ceil(before_words() + width + padding), header};
    }
};

struct Place {
    Rect rect;
    bool open = false;
    bool no_room = false;
    std::string header;  ///< of a folded one
};

/// What stands in the corner of an area. `corner`: (0, 0) is the upper left.
Rect in_corner(const Rect& area, glm::vec2 corner, glm::vec2 size) {
    const glm::vec2 at = glm::round(area.min + corner * (area.size() - size));
    return {at, at + size};
}

/// The legend's rows that are shown: all, or the first few and how many more there are.
std::vector<LegendEntry> shown_rows(std::span<const LegendEntry> all, std::size_t most) {
    std::vector<LegendEntry> out(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(std::min(most, all.size())));
    if (out.size() == all.size()) return out;
    const std::string rest = "and " + std::to_string(all.size() - out.size()) + " more";
    out.push_back({.mark = LegendEntry::Mark::remark, .text = rest});
    return out;
}

std::string in_a_line(std::span<const std::string> lines) {
    std::string out;
    for (const std::string& line : lines) out += (out.empty() ? "" : " ") + line;
    return out;
}

/// Lines are broken at blanks, of which there may be several.
bool same_words(std::string a, std::string b) {
    std::erase(a, ' ');
    std::erase(b, ' ');
    return a == b;
}

class OverlayLayout {
  public:
    OverlayLayout(PictureSize size, const OverlayContents& contents, const ViewState& view, const Metrics& metrics,
                  bool controls)
        : size_(size),
          contents_(contents),
          view_(view),
          metrics_(metrics),
          spacing_(metrics, controls),
          area_{glm::vec2(metrics.pad), glm::vec2(size.width, size.height) - metrics.pad},
          words_room_(kWidestWords * area_.size().x) {
        fold_all();
        open_caption();
        open_legend();
        open_map();
    }

    std::vector<Rect> rects() const {
        std::vector<Rect> out;
        for (const std::optional<Place>* place : {&caption_, &legend_, &map_}) {
            if (*place) out.push_back((*place)->rect);
        }
        return out;
    }

    std::optional<Rect> add_to(DrawList& list) const {
        if (caption_) draw_caption(list);
        if (legend_) draw_legend(list);
        return map_ ? draw_map(list) : std::nullopt;
    }

  private:
    /// Every panel as its header, which is what there is room for in any picture.
    void fold_all() {
        const auto folded = [&](const std::string& title, glm::vec2 corner, float room, bool no_room, bool dot) {
            Place place;
            place.no_room = no_room;
            const auto fits = [&](const std::string& words) { return spacing_.header_size(words, dot).x <= room; };
            const std::string short_one = fit_text(title, FontFace::text, spacing_.text, 0.6f * room);
            const std::array<std::string, 2> words =
                no_room ? std::array{title + ": no room", std::string("no room")} : std::array{title, short_one};
            const auto found = std::ranges::find_if(words, fits);
            if (found != words.end()) place.header = *found;
            place.rect = in_corner(area_, corner, spacing_.header_size(place.header, dot));
            return place;
        };
        const bool has_map = contents_.map.x > 0;
        const float half = 0.5f * (area_.size().x - spacing_.gap);
        if (has_map) map_ = folded(contents_.map_title, {1, 0}, half, !view_.fold_inset, false);
        if (!contents_.caption.headlines.empty()) {
            const Caption& caption = contents_.caption;
            const std::string& title = caption.title.empty() ? caption.headlines.back() : caption.title;
            const bool dot = caption.mark.a > 0;
            const float room = area_.size().x - (map_ ? map_->rect.size().x + spacing_.gap : 0);
            caption_ = folded(title, {0, 0}, room, !view_.fold_caption, dot);
        }
        if (!contents_.legend.empty() || !contents_.bars.empty())
            legend_ = folded("Legend", {0, 1}, area_.size().x, !view_.fold_legend, false);
    }

    bool is_free(const Rect& rect, std::initializer_list<const std::optional<Place>*> others) const {
        return area_.grown(0.5f).contains(rect) && std::ranges::none_of(others, [&](const std::optional<Place>* other) {
                   return *other && (*other)->rect.grown(spacing_.gap - 0.5f).overlaps(rect);
               });
    }

    /// Whether that much may be covered beside what is open already.
    bool may_cover(glm::vec2 size) const {
        float covered = area_of(size);
        for (const std::optional<Place>* place : {&caption_, &legend_, &map_}) {
            if (*place && (*place)->open) covered += area_of((*place)->rect.size());
        }
        return covered <= kMostCovered * static_cast<float>(size_.width) * static_cast<float>(size_.height);
    }

    void open(std::optional<Place>& place, const Rect& rect) {
        place->rect = rect;
        place->open = true;
        place->no_room = false;
    }

    glm::vec2 map_panel() const {
        const float title = Font::of(FontFace::text).width(contents_.map_title, spacing_.text) + spacing_.chevron;
        return glm::ceil(spacing_.around({std::max(contents_.map.x, title), contents_.map.y + 1.5f * spacing_.line}));
    }

    void open_caption() {
        if (!caption_ || view_.fold_caption) return;
        // Beside the map if that leaves enough, for the map to be seen as well.
        const float beside_map = area_.size().x - (map_ ? map_panel().x + spacing_.gap : 0);
        const float beside_header = area_.size().x - (map_ ? map_->rect.size().x + spacing_.gap : 0);
        const bool both = map_ && !view_.fold_inset && beside_map >= 0.5f * area_.size().x;
        const float room = (both ? beside_map : beside_header) - 2 * spacing_.padding - spacing_.chevron;
        const auto fits = [&](const Caption& caption, CaptionSize at) {
            caption_lines_ = caption_lines(caption, room, metrics_.scale, at);
            // A sentence that breaks off before the outcome says nothing; a name that is cut still does.
            if (caption.headlines.size() > 1 && !caption_lines_.whole_headline) return false;
            // Small letters come before words are left out.
            const bool has_less = at == CaptionSize::large && !caption.short_details.empty();
            if (has_less && !caption_lines_.whole_detail) return false;
            const glm::vec2 text = caption_size(caption, caption_lines_, metrics_.scale);
            const glm::vec2 size = spacing_.around(text + glm::vec2(spacing_.chevron, 0));
            const Rect rect = in_corner(area_, {0, 0}, size);
            if (!is_free(rect, {&legend_, &map_}) || !may_cover(size)) return false;
            open(caption_, rect);
            return true;
        };
        Caption without_detail = contents_.caption;
        without_detail.detail.clear();
        without_detail.short_details.clear();
        for (const Caption& caption : {contents_.caption, without_detail}) {
            if (fits(caption, CaptionSize::large) || fits(caption, CaptionSize::small)) return;
        }
    }

    void open_legend() {
        if (!legend_ || view_.fold_legend) return;
        const std::span<const LegendEntry> all = contents_.legend;
        const auto fits = [&](std::size_t most) {
            rows_ = shown_rows(all, most);
            const glm::vec2 rows = legend_size(rows_, spacing_.text, words_room_);
            const glm::vec2 bars = color_bars_size(contents_.bars, spacing_.text);
            // The chevron stands at the end of the first row.
            const std::span<const LegendEntry> first(rows_.data(), contents_.bars.empty() ? 1 : 0);
            const float beside = legend_size(first, spacing_.text, words_room_).x;
            const glm::vec2 content(std::max({rows.x, bars.x + spacing_.chevron, beside + spacing_.chevron}),
                                    rows.y + bars.y);
            const glm::vec2 size = glm::ceil(spacing_.around(content));
            const Rect rect = in_corner(area_, {0, 1}, size);
            const bool short_one = most <= kLegendRows;
            if (!is_free(rect, {&caption_, &map_}) || (short_one && !may_cover(size))) return false;
            open(legend_, rect);
            return true;
        };
        if (view_.whole_legend) {
            for (std::size_t most = all.size(); most > kLegendRows; --most) {
                if (fits(most)) return;
            }
        }
        if (!fits(kLegendRows)) rows_.clear();
    }

    void open_map() {
        if (!map_ || view_.fold_inset) return;
        const Rect rect = in_corner(area_, {1, 0}, map_panel());
        if (is_free(rect, {&caption_, &legend_}) && may_cover(rect.size())) open(map_, rect);
    }

    // --- drawing

    /// Panel and chevron; of a folded one the header's words. Returns the upper left corner of what it holds.
    glm::vec2 draw_panel(DrawList& list, Kind kind, const Place& place, Rgba dot = Rgba(0)) const {
        list.panels.push_back(text_panel(place.rect, list.palette, spacing_.text));
        Overlay overlay{kind, place.rect, {}, !place.open, place.no_room, {}, {}};
        const bool has_chevron = spacing_.chevron > 0;
        if (has_chevron && place.open) {
            // As large as a folded panel is high, so that it is easily hit.
            overlay.fold = {{place.rect.max.x - spacing_.header, place.rect.min.y},
                            {place.rect.max.x, place.rect.min.y + spacing_.header}};
            add_chevron(list, overlay.fold->center(), {0, 1});
        } else if (has_chevron) {
            overlay.fold = place.rect;
            add_chevron(list, place.rect.min + 0.5f * spacing_.header, {1, 0});
        }
        if (!place.open && !place.header.empty()) {
            const float top = place.rect.min.y + 0.5f * (spacing_.header - spacing_.line);
            float x = place.rect.min.x + spacing_.before_words();
            if (dot.a > 0) {
                const float r = 0.3f * spacing_.text;
                const glm::vec2 middle(x + r, top + 0.52f * spacing_.line);
                list.panels.push_back({{middle - r, middle + r}, r, dot, Rgba(0), 0});
                x += 0.9f * spacing_.text;
            }
            list.texts.push_back(text_at(TextRole::header, place.header, FontFace::text, spacing_.text,
                                         list.palette.quiet_text, {x, top}));
        }
        list.overlays.push_back(overlay);
        return place.rect.min + spacing_.padding;
    }

    /// An angle that points along x or y.
    void add_chevron(DrawList& list, glm::vec2 middle, glm::vec2 way) const {
        const float r = 0.26f * spacing_.text;
        const glm::vec2 across(way.y, way.x);
        const glm::vec2 tip = middle + 0.5f * r * way;
        for (const float side : {-1.0f, 1.0f}) {
            list.overlay_lines.push_back({middle - 0.5f * r * way + side * r * across, tip, list.palette.quiet_text,
                                          1.3f * metrics_.scale, kSolid});
        }
    }

    void draw_caption(DrawList& list) const {
        list.headline = contents_.caption.headlines.front();
        const glm::vec2 corner = draw_panel(list, Kind::caption, *caption_, contents_.caption.mark);
        const Caption& caption = contents_.caption;
        const CaptionLines& shown = caption_lines_;
        if (!caption_->open || !same_words(in_a_line(shown.headline), caption.headlines.front()) ||
            !same_words(in_a_line(shown.detail), caption.detail)) {
            list.overlays.back().whole = caption.headlines.front();
            if (!caption.detail.empty()) list.overlays.back().whole += '\n' + caption.detail;
        }
        if (caption_->open) add_caption(list, caption, shown, corner, metrics_.scale);
    }

    void draw_legend(DrawList& list) const {
        list.legend = contents_.legend;
        glm::vec2 corner = draw_panel(list, Kind::legend, *legend_);
        if (!legend_->open) return;
        add_color_bars(list, contents_.bars, corner, spacing_.text);
        corner.y += color_bars_size(contents_.bars, spacing_.text).y;
        if (!add_legend(list, rows_, corner, spacing_.text, words_room_)) {
            std::string& whole = list.overlays.back().whole;
            for (const LegendEntry& row : rows_) whole += (whole.empty() ? "" : "\n") + row.text;
        }
        if (spacing_.chevron == 0 || list.legend.size() <= kLegendRows) return;
        const Rect& panel = legend_->rect;
        const float row = legend_row(spacing_.text);
        const bool whole = rows_.size() > kLegendRows + 1;
        // The words that count the rest, or where all rows are there a chevron at the end of the last.
        Rect more{{panel.min.x, panel.max.y - row - 0.5f * spacing_.padding}, panel.max};
        if (whole) {
            more.min = panel.max - spacing_.header;
            add_chevron(list, more.center(), {0, -1});
        }
        list.overlays.back().more = more;
    }

    std::optional<Rect> draw_map(DrawList& list) const {
        const glm::vec2 corner = draw_panel(list, Kind::inset, *map_);
        if (!map_->open) return std::nullopt;
        list.texts.push_back(text_at(TextRole::map, contents_.map_title, FontFace::text, spacing_.text,
                                     list.palette.quiet_text, corner));
        const Rect& panel = map_->rect;
        const glm::vec2 at(std::round(panel.center().x - 0.5f * contents_.map.x),
                           panel.max.y - spacing_.padding - contents_.map.y);
        return Rect{at, at + contents_.map};
    }

    PictureSize size_;
    const OverlayContents& contents_;
    const ViewState& view_;
    const Metrics& metrics_;
    PanelSpacing spacing_;
    Rect area_;         ///< the picture without its margin
    float words_room_;  ///< of the legend
    std::optional<Place> caption_, legend_, map_;
    CaptionLines caption_lines_;
    std::vector<LegendEntry> rows_;
};

}  // namespace

std::optional<Rect> add_overlays(DrawList& list, const OverlayContents& contents, const ViewState& view,
                                 const Metrics& metrics, bool controls) {
    return OverlayLayout(list.size, contents, view, metrics, controls).add_to(list);
}

std::vector<Rect> overlay_rects(PictureSize size, const OverlayContents& contents, const ViewState& view,
                                const Metrics& metrics, bool controls) {
    return OverlayLayout(size, contents, view, metrics, controls).rects();
}

}  // namespace mobbscope
