/// Lines over two axes as a finished picture, for numbers that a program has measured.
#pragma once

#include <render/drawlist/draw_list.h>

#include <optional>
#include <string>
#include <vector>

namespace mobbscope {

struct Chart {
    enum class Scale {
        even,
        factors,  ///< equal factors are equally far apart; only what is above 0 is drawn
    };
    struct Axis {
        std::string name;
        std::string unit{};
        Scale scale = Scale::even;
        bool from_zero = false;  ///< of an even one: 0 is always in the picture
    };
    /// A point that is not finite breaks the line.
    struct Point {
        double x = 0;
        double y = 0;
        double error = 0;  ///< half the length of its error bar; 0: none
    };
    struct Series {
        std::string name;
        std::vector<Point> points;
        std::optional<std::size_t> color{};  ///< of the categories; none: that of its place among the series
    };
    /// A place that matters.
    struct Mark {
        std::string text;
        double x = 0;
        std::optional<double> y{};  ///< none: a line across the whole chart
        bool recommended = false;   ///< stands out
    };
    enum class Colors {
        categories,  ///< series have no order
        sequence,    ///< they have one, from little to much
    };

    std::string title{};    ///< may be empty
    std::string caption{};  ///< below the title: what was measured, and how
    Axis x;
    Axis y;
    std::vector<Series> series;
    std::vector<Mark> marks{};
    Colors colors = Colors::categories;
    bool has_names = true;  ///< of the series, behind their lines
};

/// The colour of a chart's series.
Rgba series_color(const Chart& chart, std::size_t series, const Palette& palette);

struct ChartPicture {
    DrawList list;
    /// Where points are, by chart, series and point, pixels; none where one is not drawn.
    std::vector<std::vector<std::vector<std::optional<glm::vec2>>>> points;
};

/// Charts beside each other, or in a high picture one below the other. Names of series stand at the ends of their
/// lines. `scale`: of text and lines; 0: the usual. Throws std::invalid_argument if a picture cannot have the size.
ChartPicture chart_picture(const std::vector<Chart>& charts, PictureSize size, Theme theme, double scale = 0);

}  // namespace mobbscope
