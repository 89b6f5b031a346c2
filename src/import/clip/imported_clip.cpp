#include <base/text.h>
#include <import/clip/column_choice.h>
#include <import/clip/imported_clip.h>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace mobbscope {

namespace {

constexpr double kMaxFps = 1e6;
constexpr double kMaxUnit = 1e6;
constexpr std::array<std::string_view, 3> kOrigins{"keep", "start", "start_heading"};  // as enumerated

void require(bool in_range, const std::string& message) {
    if (!in_range) throw std::invalid_argument(message);
}

bool is_unit(const std::string& text) {
    const std::optional<double> scale = metres_per_unit(text);
    return text == "auto" || (scale && *scale > 0 && *scale <= kMaxUnit);
}

}  // namespace

void check(const ImportOptions& options) {
    // Written so that NaN fails each of them.
    require(!options.fps || (*options.fps > 0 && *options.fps <= kMaxFps), "fps must be over 0 and at most 1000000");
    require(!options.unit || is_unit(*options.unit),
            "unit must be m, cm, in, auto or metres per file unit (over 0, at most 1000000)");
    require(!options.up || *options.up == "y" || *options.up == "z" || *options.up == "auto",
            "up must be y, z or auto");
    require(!options.trim || (options.trim->first >= 0 && options.trim->first < options.trim->second &&
                              options.trim->second <= mobb::kMaxTime),
            "trim must be two times A and B in seconds, 0 <= A < B <= " + format_double(mobb::kMaxTime));
    const double* const metres = options.radius ? std::get_if<double>(&*options.radius) : nullptr;
    require(!metres || (*metres >= 0 && *metres <= mobb::kMaxLength),
            "radius must be from 0 to " + format_double(mobb::kMaxLength) + " metres");
    require(!options.dt || (*options.dt > mobb::kLeastDt && *options.dt <= mobb::kMaxTime),
            "dt must be over " + format_double(mobb::kLeastDt) +
                " seconds, as what two samples share for at most 1e-9 s "
                "is not tested, and at most " +
                format_double(mobb::kMaxTime));
    if (options.columns) chosen_columns(*options.columns);
}

std::optional<double> metres_per_unit(const std::string& unit) {
    if (unit == "m") return 1;
    if (unit == "cm") return 0.01;
    if (unit == "in") return 0.0254;
    return parse_double(unit);
}

std::string_view name(Origin origin) { return kOrigins[static_cast<std::size_t>(origin)]; }
std::optional<Origin> origin_from_name(std::string_view name) { return enumerator_named<Origin>(kOrigins, name); }

std::string said(const ImportWarning& warning) {
    std::string details;
    if (warning.samples > 0) details = counted(warning.samples, "sample", "samples");
    if (warning.line > 0) details += (details.empty() ? "" : ", ") + at_line(warning.line);
    return warning.text + (details.empty() ? "" : " (" + details + ")");
}

void warn_of_no_heading(const mobb::Clip& whole, std::span<const mobb::BodyDisk> body,
                        std::vector<ImportWarning>& warnings) {
    const auto is_centred = [](const mobb::BodyDisk& disk) { return disk.forward == 0 && disk.left == 0; };
    if (std::ranges::all_of(body, is_centred) || mobb::has_direction(whole)) return;
    warnings.push_back(
        {"its body never moves and nobody says its heading: it lies along x; give the file a column heading, or the "
         "samples of a scene headings"});
}

}  // namespace mobbscope
