#include <picture_tests/contact_sheet.h>
#include <render/image/png.h>
#include <render/pictures/sheet.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace mobbscope::picture_tests {

namespace {

constexpr PictureSize kLargestPicture{320, 240};
constexpr PictureSize kSmallestPicture{64, 48};
constexpr double kPixelsOfAll = 16e6;  // of a sheet with its memory bounded, whatever the run
constexpr PictureSize kLettersOf{1600, 1200};

/// What comes first.
constexpr std::array<int, kOutcomeWords.size()> kOrder{3, 1, 2, 0, 4};
static_assert(kOrder[static_cast<std::size_t>(CaseOutcome::failed)] == 0);

/// The theme of a sheet that suits a picture: by its corner, where seldom anything is drawn.
Theme theme_around(const Image& picture) {
    const std::uint8_t* corner = picture.at(0, 0);
    return corner[0] + corner[1] + corner[2] > 3 * 127 ? Theme::light : Theme::dark;
}

/// In the place of a picture that there is none of.
Image empty_picture(PictureSize size, const Rgba& color) {
    Image out(size.width, size.height);
    for (std::size_t i = 0; i < out.rgba.size(); ++i) {
        out.rgba[i] = i % 4 == 3 ? 255 : static_cast<std::uint8_t>(std::lround(255 * color[static_cast<int>(i % 4)]));
    }
    return out;
}

}  // namespace

ContactSheet::ContactSheet(std::size_t cases) {
    const double side = std::sqrt(kPixelsOfAll / static_cast<double>(std::max<std::size_t>(cases, 1)));
    most_.width = std::clamp(static_cast<int>(side), kSmallestPicture.width, kLargestPicture.width);
    most_.height = most_.width * kLargestPicture.height / kLargestPicture.width;
}

void ContactSheet::add(const CaseResult& result) {
    if (result.actual.empty()) return;
    const Image picture = read_png_bytes(result.actual);
    const int side =
        std::max((picture.width + most_.width - 1) / most_.width, (picture.height + most_.height - 1) / most_.height);
    pictures_[result.file.name] = shrunk(picture, side);
}

std::optional<Image> ContactSheet::draw(std::span<const CaseResult> results, std::optional<int> columns,
                                        Renderer& renderer) const {
    std::vector<const CaseResult*> in_order;
    for (const CaseResult& result : results) {
        if (!draws_nothing(result) || result.outcome != CaseOutcome::passed) in_order.push_back(&result);
    }
    if (in_order.empty()) return std::nullopt;
    std::ranges::stable_sort(
        in_order, {}, [](const CaseResult* result) { return kOrder[static_cast<std::size_t>(result->outcome)]; });
    const Palette& colors = palette(pictures_.empty() ? Theme::dark : theme_around(pictures_.begin()->second));
    PictureSize largest = kSmallestPicture;
    for (const auto& [name, picture] : pictures_) {
        largest.width = std::max(largest.width, picture.width);
        largest.height = std::max(largest.height, picture.height);
    }
    std::vector<SheetCell> cells;
    for (const CaseResult* result : in_order) {
        const auto picture = pictures_.find(result->file.name);
        SheetCell cell{result->file.name,
                       picture == pictures_.end() ? empty_picture(largest, colors.grid) : picture->second};
        if (result->outcome != CaseOutcome::passed) {
            cell.title.insert(0, std::string(words_of(result->outcome).badge) + ": ");
            cell.mark = result->outcome == CaseOutcome::skipped ? colors.quiet_text : colors.hit;
        }
        cells.push_back(std::move(cell));
    }
    const int count = static_cast<int>(cells.size());
    const int square = static_cast<int>(std::lround(std::sqrt(count)));
    return make_sheet(cells, std::min(count, columns.value_or(square)), colors, colors.background,
                      metrics_of(kLettersOf), renderer);
}

}  // namespace mobbscope::picture_tests
