#include <render/drawlist/font.h>
#include <render/drawlist/picture_options.h>
#include <render/pictures/sheet.h>
#include <render/text/labels.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace mobbscope {

namespace {

constexpr FontFace kFace = FontFace::text;

/// Pixels.
struct Spacing {
    int gap = 0;    ///< around and between the cells
    int title = 0;  ///< height of the row of titles, 0 without
    float text = 0;
};

Spacing spacing_of(const Metrics& metrics, bool titles) {
    Spacing out;
    out.gap = static_cast<int>(std::round(metrics.pad));
    if (!titles) return out;
    out.text = std::round(1.2f * metrics.text);
    const Font& font = Font::of(kFace);
    out.title = static_cast<int>(std::ceil(font.ascent(out.text) + font.descent(out.text) + 0.3f * metrics.pad));
    return out;
}

int rows_of(int cells, int columns) { return (cells + columns - 1) / columns; }

std::uint8_t byte(float channel) { return static_cast<std::uint8_t>(std::lround(255 * std::clamp(channel, 0.f, 1.f))); }

Image sheet_ground(PictureSize size, const Rgba& color) {
    Image image(size.width, size.height);
    const std::uint8_t pixel[4] = {byte(color.r), byte(color.g), byte(color.b), byte(color.a)};
    for (std::size_t i = 0; i < image.rgba.size(); ++i) image.rgba[i] = pixel[i % 4];
    return image;
}

void paste(const Image& from, Image& to, int x, int y) {
    for (int row = 0; row < from.height; ++row) {
        std::copy_n(from.at(0, row), static_cast<std::size_t>(from.width) * 4, to.at(x, y + row));
    }
}

/// Around an image that is pasted at (x, y): as wide as the gap lets it be without touching the next.
void frame(const Image& image, Image& to, int x, int y, int width, const Rgba& color) {
    const Image edge = sheet_ground({image.width + 2 * width, image.height + 2 * width}, color);
    paste(edge, to, x - width, y - width);
}

/// A title in the middle of a picture of its own.
Image title_picture(const SheetCell& cell, PictureSize size, float text, const Palette& palette, const Rgba& background,
                    Renderer& renderer) {
    DrawList list;
    list.size = size;
    list.palette = palette;
    list.background = background;
    const auto room = static_cast<float>(size.width);
    const std::string line = fit_text(cell.title, kFace, text, room);
    const float left = std::round(0.5f * (room - Font::of(kFace).width(line, text)));
    list.texts.push_back(text_at(TextRole::caption, line, kFace, text, cell.mark.value_or(palette.text), {left, 0}));
    return renderer.draw(list);
}

}  // namespace

PictureSize cell_size(PictureSize sheet, int cells, int columns, bool titles, const Metrics& metrics) {
    const Spacing spacing = spacing_of(metrics, titles);
    const int rows = rows_of(cells, columns);
    const PictureSize cell{(sheet.width - spacing.gap) / columns - spacing.gap,
                           (sheet.height - spacing.gap) / rows - spacing.gap - spacing.title};
    if (cell.width < kMinSide || cell.height < kMinSide) {
        throw std::invalid_argument(std::to_string(cells) + " pictures do not fit into " + std::to_string(sheet.width) +
                                    "x" + std::to_string(sheet.height) +
                                    " pixels; give a larger size or another number of columns");
    }
    return cell;
}

Image make_sheet(std::span<const SheetCell> cells, int columns, const Palette& palette, const Rgba& background,
                 const Metrics& metrics, Renderer& renderer, PictureSize size) {
    const auto has_title = [](const SheetCell& cell) { return !cell.title.empty(); };
    const Spacing spacing = spacing_of(metrics, std::any_of(cells.begin(), cells.end(), has_title));
    int width = 0;
    std::vector<int> heights(static_cast<std::size_t>(rows_of(static_cast<int>(cells.size()), columns)));
    for (std::size_t i = 0; i < cells.size(); ++i) {
        int& height = heights[i / static_cast<std::size_t>(columns)];
        width = std::max(width, cells[i].image.width);
        height = std::max(height, cells[i].image.height);
    }
    const int rows = static_cast<int>(heights.size());
    const int needed =
        std::accumulate(heights.begin(), heights.end(), spacing.gap) + rows * (spacing.title + spacing.gap);
    size.width = std::max(size.width, columns * (width + spacing.gap) + spacing.gap);
    size.height = std::max(size.height, needed);

    if (std::int64_t{size.width} * size.height > kMostSheetPixels) {
        throw std::invalid_argument("a sheet of " + std::to_string(size.width) + "x" + std::to_string(size.height) +
                                    " pixels is too large; put fewer pictures into it");
    }
    Image sheet = sheet_ground(size, background);
    int above = spacing.gap;  // of the row
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const Image& image = cells[i].image;
        const int column = static_cast<int>(i) % columns;
        const int row = static_cast<int>(i) / columns;
        if (column == 0 && row > 0) above += heights[static_cast<std::size_t>(row) - 1] + spacing.title + spacing.gap;
        const int x = spacing.gap + column * (size.width - spacing.gap) / columns;
        const int y = above + row * (size.height - needed) / rows;
        if (has_title(cells[i])) {
            const PictureSize room{width, spacing.title};
            paste(title_picture(cells[i], room, spacing.text, palette, background, renderer), sheet, x, y);
        }
        const int left = x + (width - image.width) / 2;
        if (cells[i].mark) frame(image, sheet, left, y + spacing.title, spacing.gap / 3, *cells[i].mark);
        paste(image, sheet, left, y + spacing.title);
    }
    return sheet;
}

}  // namespace mobbscope
