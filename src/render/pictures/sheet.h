/// Pictures side by side with titles over them: panels of a figure, contact sheets.
#pragma once

#include <render/drawlist/palette.h>
#include <render/drawlist/picture_options.h>
#include <render/gl/renderer.h>
#include <render/image/image.h>

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace mobbscope {

inline constexpr std::int64_t kMostSheetPixels = std::int64_t{1} << 27;

struct SheetCell {
    std::string title;  ///< UTF-8; where all are empty there is no room for titles
    Image image;
    std::optional<Rgba> mark{};  ///< of its title and of a frame around it
};

/// The size of a cell's picture when `cells` of them in `columns` fill a sheet of this size, with or without titles.
/// Throws std::invalid_argument if a cell would be smaller than a picture may be.
PictureSize cell_size(PictureSize sheet, int cells, int columns, bool titles, const Metrics& metrics);

/// Row by row; pictures keep their pixels and stand under their titles, in rows as high as their highest picture.
/// `background`: behind all, may be seen through. `size`: of the sheet; where it is less than the cells need, as large
/// as they need. Throws std::invalid_argument if it would have more than kMostSheetPixels, MachineError if OpenGL
/// reports an error.
Image make_sheet(std::span<const SheetCell> cells, int columns, const Palette& palette, const Rgba& background,
                 const Metrics& metrics, Renderer& renderer, PictureSize size = {});

}  // namespace mobbscope
