#include <render/diff_json.h>

namespace mobbscope {

void write_diff(JsonWriter& json, const ImageDiff& diff) {
    json.begin_object();
    json.member("same", diff.same);
    json.member("same_size", diff.same_size);
    json.member("pixels", diff.pixels);
    json.member("failing", diff.differing);
    json.member("fraction", diff.fraction());
    json.member("maximum", diff.largest);
    json.member("mean", diff.mean);
    json.key("bounds");
    if (diff.bounds) {
        json.begin_object(JsonWriter::Layout::row);
        json.member("x", diff.bounds->x);
        json.member("y", diff.bounds->y);
        json.member("width", diff.bounds->width);
        json.member("height", diff.bounds->height);
        json.end_object();
    } else {
        json.null();
    }
    json.key("histogram");
    json.begin_array(JsonWriter::Layout::row);
    if (diff.same_size) {
        for (const std::int64_t count : diff.histogram) json.value(count);
    }
    json.end_array();
    json.end_object();
}

}  // namespace mobbscope
