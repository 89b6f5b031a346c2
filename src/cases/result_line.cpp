#include <base/base64.h>
#include <base/json.h>
#include <base/json_writer.h>
#include <base/text.h>
#include <cases/case_scene.h>
#include <cases/result_line.h>
#include <render/image/image_diff.h>
#include <render/image/png.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <span>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope::picture_tests {

namespace {

std::optional<std::string> packed(const std::optional<std::string>& bytes) {
    if (!bytes) return std::nullopt;
    return base64(*bytes);
}

std::optional<std::string> packed_picture(const std::string& png) {
    if (png.empty()) return std::nullopt;
    return base64(png);
}

std::optional<std::string> unpacked(const JsonPlace& place) {
    if (place.is_null()) return std::nullopt;
    std::optional<std::string> bytes = from_base64(place.string());
    if (!bytes) place.fail("is not base64");
    return bytes;
}

/// A golden of the case, told by its ending: what others wrote must not name any other file.
std::filesystem::path golden_at(const JsonPlace& place, const CaseFile& file) {
    const std::string& ending = place.string();
    if (!is_golden_ending(ending))
        place.fail(in_quotes(ending) + " is not a golden of a case, such as .png or .state.json");
    return file.beside(ending);
}

/// What would be written in the place of a golden; null if nothing would.
const GoldenChange* change_of(const std::vector<GoldenChange>& fresh, const std::filesystem::path& golden) {
    const auto found = std::ranges::find(fresh, golden, &GoldenChange::file);
    return found == fresh.end() ? nullptr : &*found;
}

/// Of the mask, relative to the case: a report is read in other folders too.
std::string mask_name(const CaseResult& result) {
    const std::filesystem::path relative = result.mask->lexically_relative(result.file.file.parent_path());
    return relative.empty() ? result.mask->string() : relative.string();
}

/// The names of CaseOutcome.
constexpr auto kOutcomes = [] {
    std::array<std::string_view, kOutcomeWords.size()> out{};
    std::ranges::transform(kOutcomeWords, out.begin(), &OutcomeWords::name);
    return out;
}();

template <class Value>
Value named(const JsonPlace& place, std::span<const std::string_view> names) {
    const std::optional<Value> value = enumerator_named<Value>(names, place.string());
    if (!value) place.fail(in_quotes(place.string()) + " is not one of the names");
    return *value;
}

PictureSize read_picture_size(const JsonPlace& place) {
    place.require_size(2, "the width and the height");
    return {place[0].integer(0, kMaxInt), place[1].integer(0, kMaxInt)};
}

std::optional<PixelRect> read_bounds(const JsonPlace& place) {
    if (place.is_null()) return std::nullopt;
    return PixelRect{place.require("x").integer(0, kMaxInt), place.require("y").integer(0, kMaxInt),
                     place.require("width").integer(0, kMaxInt), place.require("height").integer(0, kMaxInt)};
}

/// As write_diff writes it.
ImageDiff read_diff(const JsonPlace& place) {
    ImageDiff out;
    out.same = place.require("same").boolean();
    out.passes = place.require("passes").boolean();
    out.same_size = place.require("same_size").boolean();
    const JsonPlace actual = place.require("size_a"), reference = place.require("size_b");
    out.actual_size = read_picture_size(actual);
    out.reference_size = read_picture_size(reference);
    out.pixels = place.require("pixels").count();
    out.unequal = place.require("unequal").count();
    out.differing = place.require("failing").count();
    out.largest = place.require("maximum").integer(0, 255);
    out.mean = place.require("mean").number(0, 255);
    const JsonPlace unequal_bounds = place.require("unequal_bounds"), bounds = place.require("bounds");
    out.unequal_bounds = read_bounds(unequal_bounds);
    out.bounds = read_bounds(bounds);
    const JsonPlace histogram = place.require("histogram");
    histogram.require_size(static_cast<int>(out.histogram.size()), "the pixels of each difference");
    for (std::size_t i = 0; i < out.histogram.size(); ++i) out.histogram[i] = histogram[static_cast<int>(i)].count();
    out.options.channel_tolerance = place.require("threshold").number(0, 255);
    out.options.pixel_fraction = place.require("allowed").number(0, 1);
    out.options.least_pixels = place.require("least_pixels").count();
    out.options.shift = place.require("shift").integer(0, 1);
    // Older reports lack it.
    if (const auto tile_mean = place.find("tile_mean")) {
        out.tile_mean = tile_mean->number(0, 255);
        out.options.tile_tolerance = place.require("tile_threshold").number(0, 255);
        const JsonPlace tile = place.require("tile");
        out.tile = read_bounds(tile);
    }
    return out;
}

}  // namespace

void write_result(JsonWriter& json, const CaseResult& result, Pictures pictures, std::string_view folder) {
    json.begin_object(JsonWriter::Layout::row);
    json.member("name", result.file.name);
    if (!folder.empty()) json.member("folder", folder);
    json.member("outcome", name(result.outcome));
    json.member("message", result.message);
    json.values("remarks", result.remarks);
    if (pictures == Pictures::all) {
        json.member("seconds", result.seconds);
        std::vector<std::string> read;
        for (const std::filesystem::path& file : result.read) {
            if (is_utf8(file.string())) read.push_back(file.string());
        }
        if (!read.empty()) json.values("read", read);
    }
    // Of what draws nothing no pixel is compared.
    const bool draws = !draws_nothing(result);
    json.member("tolerance", draws ? std::optional(std::string(name(result.tolerance))) : std::nullopt);
    json.member("backend", result.drawn_by.backend);
    json.member("renderer", result.drawn_by.renderer);
    if (lacks_opengl(result)) json.member("not_drawn", result.not_drawn);
    json.key("diff");
    result.image ? write_diff(json, *result.image) : json.null();
    json.list("findings", result.findings, [&](const Finding& finding) {
        json.begin_object();
        json.member("golden", finding.golden.empty() ? "" : result.file.ending_of(finding.golden));
        json.member("message", finding.message);
        json.values("words", finding.words);
        json.end_object();
    });
    json.member("mask", result.mask ? std::optional(mask_name(result)) : std::nullopt);
    const bool there_already = pictures == Pictures::not_in_fresh && change_of(result.fresh, result.file.golden());
    json.member("actual", there_already ? std::nullopt : packed_picture(result.actual));
    json.member("golden", there_already ? std::nullopt : packed_picture(result.golden));
    json.list("fresh", result.fresh, [&](const GoldenChange& fresh) {
        json.begin_object();
        json.member("golden", result.file.ending_of(fresh.file));
        json.member("bytes", packed(fresh.bytes));
        json.member("replaces", packed(fresh.replaces));
        json.end_object();
    });
    json.end_object();
}

CaseResult read_result(const JsonPlace& root, const std::vector<CaseFile>& cases) {
    const JsonPlace named_case = root.require("name");
    const std::string& of = named_case.string();
    const auto file = std::ranges::find(cases, of, &CaseFile::name);
    if (file == cases.end()) named_case.fail(in_quotes(of) + " is not one of the cases");
    CaseResult result;
    result.file = *file;
    result.outcome = named<CaseOutcome>(root.require("outcome"), kOutcomes);
    result.message = root.require("message").string();
    result.remarks = root.require("remarks").strings();
    if (const auto seconds = root.find("seconds")) result.seconds = seconds->number();
    if (const auto read = root.find("read")) {
        read->each([&](const JsonPlace& one) { result.read.emplace_back(one.string()); });
    }
    const JsonPlace tolerance = root.require("tolerance");
    if (!tolerance.is_null()) result.tolerance = named<Tolerance>(tolerance, kTolerances);
    result.drawn_by = {root.require("backend").string(), root.require("renderer").string()};
    if (const auto not_drawn = root.find("not_drawn")) result.not_drawn = not_drawn->string();
    const JsonPlace diff = root.require("diff");
    if (!diff.is_null()) result.image = read_diff(diff);
    root.require("findings").each([&](const JsonPlace& finding) {
        const JsonPlace golden = finding.require("golden");
        result.findings.push_back({golden.string().empty() ? std::filesystem::path() : golden_at(golden, *file),
                                   finding.require("message").string(), finding.require("words").strings()});
    });
    root.require("fresh").each([&](const JsonPlace& one) {
        const JsonPlace golden = one.require("golden");
        GoldenChange change{golden_at(golden, *file), unpacked(one.require("bytes")),
                            unpacked(one.require("replaces"))};
        if (change_of(result.fresh, change.file)) golden.fail(in_quotes(golden.string()) + " is given twice");
        result.fresh.push_back(std::move(change));
    });
    const JsonPlace mask = root.require("mask");
    if (!mask.is_null()) result.mask = read_path(mask, file->file.parent_path());
    const GoldenChange* there_already = change_of(result.fresh, file->golden());
    const JsonPlace actual = root.require("actual"), golden = root.require("golden");
    result.actual = unpacked(actual).value_or(there_already ? there_already->bytes.value_or("") : "");
    result.golden =
        unpacked(golden).value_or(there_already && actual.is_null() ? there_already->replaces.value_or("") : "");
    return result;
}

void write_result_line(std::ostream& out, const CaseResult& result) {
    JsonWriter json(out);
    write_result(json, result, Pictures::all);
}

CaseResult read_result_line(std::string_view line, const std::vector<CaseFile>& cases) {
    const std::string name = "a result";
    const JsonText value = parse_json(line, name);
    return read_result(JsonPlace(value, name), cases);
}

std::string request_line(const CaseRequest& request) {
    std::ostringstream out;
    JsonWriter json(out);
    json.begin_object(JsonWriter::Layout::row);
    json.member("name", request.name);
    json.member("fresh", kFreshGoldens[static_cast<std::size_t>(request.options.fresh)]);
    if (request.options.asked) json.member("case", *request.options.asked);
    json.end_object();
    return out.str();
}

CaseRequest read_request_line(std::string_view line) {
    const std::string name = "a request";
    const JsonText value = parse_json(line, name);
    const JsonPlace root(value, name);
    CaseRequest out{root.require("name").string()};
    out.options.fresh = named<FreshGoldens>(root.require("fresh"), kFreshGoldens);
    if (const auto asked = root.find("case")) out.options.asked = asked->string();
    return out;
}

}  // namespace mobbscope::picture_tests
