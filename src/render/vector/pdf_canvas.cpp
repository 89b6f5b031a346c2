// PDF by cairo, in the faces that pictures are lettered in: the glyphs that are used become part of the file.
#include <base/error.h>
#include <base/text.h>
#include <render/vector/vector_canvas.h>

#include <cairo-ft.h>
#include <cairo-pdf.h>
#include <cairo.h>
#include <ft2build.h>
#include FT_FREETYPE_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace mobbscope {

namespace {

template <auto Destroy>
struct By {
    template <class T>
    void operator()(T* object) const {
        Destroy(object);
    }
};
template <class T, auto Destroy>
using Owned = std::unique_ptr<T, By<Destroy>>;

/// An embedded face as cairo has it. cairo may keep a face beyond its last use, so they live as long as the program.
class PdfFace {
  public:
    static const PdfFace& of(FontFace face) {
        static const PdfFace text(FontFace::text), mono(FontFace::mono);
        return face == FontFace::text ? text : mono;
    }
    cairo_font_face_t* get() const { return cairo_face_; }
    unsigned long glyph(char32_t code) const {
        const bool control = code < 0x20 || (code >= 0x7F && code < 0xA0);
        return FT_Get_Char_Index(face_, control ? U' ' : code);
    }

  private:
    explicit PdfFace(FontFace face) {
        const std::string_view bytes = Font::file(face);
        if (FT_Init_FreeType(&library_) != 0 ||
            FT_New_Memory_Face(library_, reinterpret_cast<const FT_Byte*>(bytes.data()),
                               static_cast<FT_Long>(bytes.size()), 0, &face_) != 0)
            throw std::logic_error("an embedded font cannot be read");
        cairo_face_ = cairo_ft_font_face_create_for_ft_face(face_, 0);
    }

    FT_Library library_ = nullptr;
    FT_Face face_ = nullptr;
    cairo_font_face_t* cairo_face_ = nullptr;
};

class PdfCanvas : public VectorCanvas {
  public:
    PdfCanvas(PictureSize size, const std::string& title)
        : size_(size), surface_(cairo_pdf_surface_create_for_stream(&PdfCanvas::take, this, size.width, size.height)) {
        // What every journal takes: later versions pack their objects, too.
        cairo_pdf_surface_restrict_to_version(surface_.get(), CAIRO_PDF_VERSION_1_4);
        // No dates: the same picture is the same file.
        cairo_pdf_surface_set_metadata(surface_.get(), CAIRO_PDF_METADATA_TITLE, cleaned(title).c_str());
        cairo_pdf_surface_set_metadata(surface_.get(), CAIRO_PDF_METADATA_CREATE_DATE, "");
        context_.reset(cairo_create(surface_.get()));
    }

    void fill(Rgba color) override {
        set(color);
        cairo_paint(context_.get());
    }

    void image(const Image& image) override {
        // cairo's pixels are numbers with alpha highest, and colours have it multiplied in.
        const int stride = cairo_format_stride_for_width(CAIRO_FORMAT_ARGB32, image.width);
        std::vector<unsigned char> pixels(static_cast<std::size_t>(stride) * static_cast<std::size_t>(image.height));
        for (int y = 0; y < image.height; ++y) {
            for (int x = 0; x < image.width; ++x) {
                const std::uint8_t* from = image.at(x, y);
                const auto with_alpha = [&](int i) { return (std::uint32_t{from[i]} * from[3] + 127) / 255; };
                const std::uint32_t argb =
                    std::uint32_t{from[3]} << 24 | with_alpha(0) << 16 | with_alpha(1) << 8 | with_alpha(2);
                std::memcpy(pixels.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(stride) +
                                4 * static_cast<std::size_t>(x),
                            &argb, sizeof argb);
            }
        }
        const Owned<cairo_surface_t, cairo_surface_destroy> source(
            cairo_image_surface_create_for_data(pixels.data(), CAIRO_FORMAT_ARGB32, image.width, image.height, stride));
        cairo_t* c = context_.get();
        cairo_save(c);
        cairo_scale(c, static_cast<double>(size_.width) / image.width,
                    static_cast<double>(size_.height) / image.height);
        cairo_set_source_surface(c, source.get(), 0, 0);
        cairo_paint(c);
        cairo_restore(c);
        // The pixels are written before they go.
        cairo_surface_finish(source.get());
    }

    void rectangle(const Rect& rect, float radius, Rgba fill, Rgba line, float width) override {
        outline(rect, radius);
        cairo_t* c = context_.get();
        if (fill.a > 0) {
            set(fill);
            cairo_fill_preserve(c);
        }
        if (line.a > 0) {
            set(line);
            cairo_set_line_width(c, width);
            cairo_set_dash(c, nullptr, 0, 0);
            cairo_stroke_preserve(c);
        }
        cairo_new_path(c);
    }

    void stroke(const VectorStroke& stroke) override {
        cairo_t* c = context_.get();
        for (const std::vector<glm::vec2>& run : stroke.runs) {
            cairo_move_to(c, run.front().x, run.front().y);
            for (std::size_t i = 1; i < run.size(); ++i) cairo_line_to(c, run[i].x, run[i].y);
        }
        set(stroke.color);
        cairo_set_line_width(c, stroke.width);
        cairo_set_line_join(c, CAIRO_LINE_JOIN_ROUND);
        const std::array<double, 4> dash{stroke.dash.x, stroke.dash.y, stroke.dash.z, stroke.dash.w};
        cairo_set_dash(c, dash.data(), stroke.dash == kSolid ? 0 : 4, stroke.dash_start);
        cairo_stroke(c);
    }

    void text(const TextRun& text) override {
        const Font& font = Font::of(text.face);
        const std::string utf8 = cleaned(text.text);
        const std::vector<char32_t> codes = code_points(utf8);
        std::vector<cairo_glyph_t> glyphs;
        std::vector<cairo_text_cluster_t> clusters;
        set(text.color);
        cairo_set_font_size(context_.get(), text.size);
        std::size_t begin = 0, at = 0;
        float pen = text.baseline.x;
        for (std::size_t i = 0; i < codes.size(); ++i) {
            const FontFace face = Font::drawing(text.face, codes[i]);
            const std::size_t before = at;
            read_code_point(utf8, at);
            glyphs.push_back(
                {PdfFace::of(face).glyph(codes[i]), pen + font.indent(codes[i], text.size), text.baseline.y});
            clusters.push_back({static_cast<int>(at - before), 1});
            const bool last = i + 1 == codes.size();
            pen += font.advance(codes[i], last ? 0 : codes[i + 1], text.size);
            if (!last && Font::drawing(text.face, codes[i + 1]) == face) continue;
            cairo_set_font_face(context_.get(), PdfFace::of(face).get());
            cairo_show_text_glyphs(context_.get(), utf8.data() + begin, static_cast<int>(at - begin), glyphs.data(),
                                   static_cast<int>(glyphs.size()), clusters.data(), static_cast<int>(clusters.size()),
                                   cairo_text_cluster_flags_t{});
            glyphs.clear();
            clusters.clear();
            begin = at;
        }
    }

    std::string finish() override {
        const cairo_status_t drawn = cairo_status(context_.get());
        context_.reset();
        cairo_surface_finish(surface_.get());
        const cairo_status_t written = cairo_surface_status(surface_.get());
        for (const cairo_status_t status : {drawn, written}) {
            if (status != CAIRO_STATUS_SUCCESS)
                throw MachineError("the picture cannot be written as PDF: " +
                                   std::string(cairo_status_to_string(status)));
        }
        return std::move(out_);
    }

  private:
    static cairo_status_t take(void* canvas, const unsigned char* bytes, unsigned int count) {
        static_cast<PdfCanvas*>(canvas)->out_.append(reinterpret_cast<const char*>(bytes), count);
        return CAIRO_STATUS_SUCCESS;
    }

    void set(Rgba color) { cairo_set_source_rgba(context_.get(), color.r, color.g, color.b, color.a); }

    void outline(const Rect& rect, float radius) {
        cairo_t* c = context_.get();
        const glm::vec2 size = rect.size();
        if (radius <= 0) return cairo_rectangle(c, rect.min.x, rect.min.y, size.x, size.y);
        const double r = std::min({radius, 0.5F * size.x, 0.5F * size.y});
        constexpr double kQuarter = 1.5707963267948966;
        cairo_new_sub_path(c);
        cairo_arc(c, rect.max.x - r, rect.min.y + r, r, -kQuarter, 0);
        cairo_arc(c, rect.max.x - r, rect.max.y - r, r, 0, kQuarter);
        cairo_arc(c, rect.min.x + r, rect.max.y - r, r, kQuarter, 2 * kQuarter);
        cairo_arc(c, rect.min.x + r, rect.min.y + r, r, 2 * kQuarter, 3 * kQuarter);
        cairo_close_path(c);
    }

    PictureSize size_;
    std::string out_;
    Owned<cairo_surface_t, cairo_surface_destroy> surface_;
    Owned<cairo_t, cairo_destroy> context_;
};

}  // namespace

std::unique_ptr<VectorCanvas> pdf_canvas(PictureSize size, const std::string& title) {
    return std::make_unique<PdfCanvas>(size, title);
}

}  // namespace mobbscope
