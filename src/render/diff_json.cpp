#include <render/diff_json.h>

namespace mobbscope {

namespace {

using Layout = JsonWriter::Layout;

void write_size(JsonWriter& out, const char* key, PictureSize size) {
    out.key(key);
    out.begin_array(Layout::row);
    out.value(size.width);
    out.value(size.height);
    out.end_array();
}

void write_bounds(JsonWriter& out, const std::optional<PixelRect>& bounds) {
    out.key("bounds");
    if (!bounds) return out.null();
    out.begin_object(Layout::row);
    out.member("x", bounds->x);
    out.member("y", bounds->y);
    out.member("width", bounds->width);
    out.member("height", bounds->height);
    out.end_object();
}

}  // namespace

void write_diff(JsonWriter& out, const ImageDiff& diff) {
    out.begin_object();
    out.member("same", diff.same);
    out.member("same_size", diff.same_size);
    write_size(out, "size_a", diff.actual_size);
    write_size(out, "size_b", diff.reference_size);
    out.member("pixels", diff.pixels);
    out.member("failing", diff.differing);
    out.member("fraction", diff.fraction());
    out.member("maximum", diff.largest);
    out.member("mean", diff.mean);
    write_bounds(out, diff.bounds);
    out.key("histogram");
    out.begin_array(Layout::row);
    for (const std::int64_t count : diff.histogram) out.value(count);
    out.end_array();
    out.member("threshold", diff.options.channel_tolerance);
    out.member("allowed", diff.options.pixel_fraction);
    out.member("shift", diff.options.shift);
    out.end_object();
}

}  // namespace mobbscope
