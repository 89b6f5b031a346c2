// SVG by hand: cairo writes the glyphs of an SVG file as paths, and text must stay text.
#include <base/base64.h>
#include <base/markup.h>
#include <base/text.h>
#include <render/image/png.h>
#include <render/vector/vector_canvas.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string_view>

namespace mobbscope {

namespace {

std::string number(double value) { return to_thousandth(value); }

void attribute(std::string& out, std::string_view name, std::string_view value) {
    out.append(" ").append(name).append("=\"").append(value).append("\"");
}

/// `what`: "fill" or "stroke".
void paint(std::string& out, std::string_view what, Rgba color) {
    if (color.a <= 0) return attribute(out, what, "none");
    const auto level = [](float channel) { return static_cast<int>(std::lround(255 * std::clamp(channel, 0.f, 1.f))); };
    attribute(out, what, formatted("#%02x%02x%02x", level(color.r), level(color.g), level(color.b)));
    if (color.a < 1) attribute(out, std::string(what) + "-opacity", number(color.a));
}

class SvgCanvas : public VectorCanvas {
  public:
    SvgCanvas(PictureSize size, const std::string& title) : size_(size) {
        const std::string width = std::to_string(size.width), height = std::to_string(size.height);
        out_ =
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" "
            "xmlns:xlink=\"http://www.w3.org/1999/xlink\"";
        attribute(out_, "width", width);
        attribute(out_, "height", height);
        attribute(out_, "viewBox", "0 0 " + width + ' ' + height);
        attribute(out_, "xml:space", "preserve");
        // Fira Code would draw "->" as an arrow.
        out_ += ">\n<style>text{font-variant-ligatures:none;white-space:pre}</style>\n";
        if (!title.empty()) out_ += "<title>" + escaped(title) + "</title>\n";
    }

    void fill(Rgba color) override {
        if (color.a <= 0) return;
        out_ += "<rect";
        place({{0, 0}, {size_.width, size_.height}});
        paint(out_, "fill", color);
        out_ += "/>\n";
    }

    void image(const Image& image) override {
        out_ += "<image";
        place({{0, 0}, {size_.width, size_.height}});
        attribute(out_, "xlink:href", "data:image/png;base64," + base64(png_bytes(image)));
        out_ += "/>\n";
    }

    void rectangle(const Rect& rect, float radius, Rgba fill, Rgba line, float width) override {
        if (fill.a <= 0 && line.a <= 0) return;
        out_ += "<rect";
        place(rect);
        if (radius > 0) attribute(out_, "rx", number(radius));
        paint(out_, "fill", fill);
        if (line.a > 0) {
            paint(out_, "stroke", line);
            attribute(out_, "stroke-width", number(width));
        } else if (radius <= 0) {
            // Neighbours leave no seam.
            attribute(out_, "shape-rendering", "crispEdges");
        }
        out_ += "/>\n";
    }

    void stroke(const VectorStroke& stroke) override {
        std::string path;
        for (const std::vector<glm::vec2>& run : stroke.runs) {
            for (std::size_t i = 0; i < run.size(); ++i) {
                path += i == 0 ? 'M' : i == 1 ? 'L' : ' ';
                path.append(number(run[i].x)).append(",").append(number(run[i].y));
            }
        }
        out_ += "<path";
        attribute(out_, "d", path);
        attribute(out_, "fill", "none");
        paint(out_, "stroke", stroke.color);
        // Of one pixel it would be a hairline to browsers, which they draw unevenly.
        attribute(out_, "stroke-width", number(stroke.width == 1 ? 1.01F : stroke.width));
        attribute(out_, "stroke-linejoin", "round");
        if (stroke.dash != kSolid) {
            const Dash& dash = stroke.dash;
            std::string pattern;
            for (int i = 0; i < 4; ++i) pattern.append(i > 0 ? " " : "").append(number(dash[i]));
            attribute(out_, "stroke-dasharray", pattern);
            if (stroke.dash_start != 0) attribute(out_, "stroke-dashoffset", number(stroke.dash_start));
        }
        out_ += "/>\n";
    }

    void text(const TextRun& text) override {
        const bool mono = text.face == FontFace::mono;
        out_ += "<text";
        attribute(out_, "x", number(text.baseline.x));
        attribute(out_, "y", number(text.baseline.y));
        attribute(out_, "font-family", mono ? "'Fira Code', monospace" : "'Open Sans', sans-serif");
        attribute(out_, "font-size", number(text.size));
        // As wide as here, also where the face is another.
        const float width = Font::of(text.face).width(text.text, text.size);
        if (width > 0) attribute(out_, "textLength", number(width));
        paint(out_, "fill", text.color);
        out_ += '>' + escaped(text.text) + "</text>\n";
    }

    std::string finish() override { return std::move(out_) + "</svg>\n"; }

  private:
    void place(const Rect& rect) {
        attribute(out_, "x", number(rect.min.x));
        attribute(out_, "y", number(rect.min.y));
        attribute(out_, "width", number(rect.size().x));
        attribute(out_, "height", number(rect.size().y));
    }

    PictureSize size_;
    std::string out_;
};

}  // namespace

std::unique_ptr<VectorCanvas> svg_canvas(PictureSize size, const std::string& title) {
    return std::make_unique<SvgCanvas>(size, title);
}

}  // namespace mobbscope
