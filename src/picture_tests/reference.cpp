#include <picture_tests/reference.h>

#include <base/file.h>
#include <base/json.h>
#include <base/json_writer.h>
#include <base/text.h>
#include <cases/result_line.h>
#include <render/drawlist/font.h>

#include <imgui.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <sstream>
#include <string_view>
#include <system_error>
#include <utility>

namespace mobbscope::picture_tests {

namespace {

constexpr int kReferenceVersion = 1;

/// "Mesa 22.3.6" of "3.3 (Core Profile) Mesa 22.3.6-1"; of a driver that is not Mesa's all of it.
std::string driver_of(const std::string& version) {
    constexpr std::string_view kMesa = "Mesa ";
    const std::size_t begin = version.find(kMesa);
    if (begin == std::string::npos) return version;
    const std::size_t end = version.find_first_not_of("0123456789.", begin + kMesa.size());
    return version.substr(begin, end - begin);
}

/// The hash of a font, or what stands for it where there is no such font.
std::string hash_in(const Reference& reference, const std::string& font) {
    const auto found = reference.fonts.find(font);
    return found == reference.fonts.end() ? "none" : found->second;
}

}  // namespace

Reference reference_of(const Renderer& renderer) {
    Reference out;
    for (const FontFace face : {FontFace::text, FontFace::mono}) {
        out.fonts.emplace(Font::file_name(face), Font::file_sha256(face));
    }
    out.imgui = IMGUI_VERSION;
    // "llvmpipe (LLVM 15.0.6, 256 bits)": the pictures are the same whatever the processor.
    const std::string& device = renderer.context().device();
    out.opengl = driver_of(renderer.context().version()) + ", " + device.substr(0, device.find(" ("));
    return out;
}

std::filesystem::path reference_file(const std::filesystem::path& folder) { return folder / "reference.json"; }

std::optional<Reference> read_reference(const std::filesystem::path& folder) {
    const std::filesystem::path file = reference_file(folder);
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored)) return std::nullopt;
    const std::string name = file.string();
    const JsonText value = parse_json(read_file(file), name);
    const JsonPlace root(value, name);
    root.allow_only({"mobbscope_reference", "fonts", "imgui", "opengl"});
    const JsonPlace version = root.require("mobbscope_reference");
    if (version.number() != kReferenceVersion) {
        version.fail("the reference has version " + format_double(version.number()) + "; this program reads version " +
                     std::to_string(kReferenceVersion));
    }
    return read_drawn_with(root);
}

std::string reference_text(const Reference& reference) {
    std::ostringstream text;
    JsonWriter json(text);
    json.begin_object();
    json.member("mobbscope_reference", kReferenceVersion);
    write_drawn_with(json, reference);
    json.end_object();
    return std::move(text).str();
}

void write_reference(const std::filesystem::path& folder, const Reference& reference) {
    check_stays_in_folder(reference_file(folder));
    write_file(reference_file(folder), reference_text(reference));
}

Image coarse_picture(const Image& image) {
    constexpr int kStep = 4;  // between levels
    Image out(image.width / 2, image.height / 2);
    for (int y = 0; y < out.height; ++y) {
        for (int x = 0; x < out.width; ++x) {
            for (int c = 0; c < 4; ++c) {
                const int sum = image.at(2 * x, 2 * y)[c] + image.at(2 * x + 1, 2 * y)[c] +
                                image.at(2 * x, 2 * y + 1)[c] + image.at(2 * x + 1, 2 * y + 1)[c];
                const int level = (sum + 2 * kStep) / (4 * kStep);
                out.at(x, y)[c] = static_cast<std::uint8_t>(std::min(level * kStep, 255));
            }
        }
    }
    return out;
}

bool same_text(const Reference& here, const Reference& reference, bool in_window) {
    return here.fonts == reference.fonts && (!in_window || here.imgui == reference.imgui);
}

std::string what_is_other(const Reference& here, const Reference& reference) {
    constexpr std::size_t kDigits = 8;  // of a hash: enough for a message
    std::string out;
    const auto add = [&out](const std::string& what, const std::string& mine, const std::string& other) {
        out += (out.empty() ? "" : ", ") + what + mine + " for " + other;
    };
    std::map<std::string, std::string> fonts = here.fonts;
    fonts.insert(reference.fonts.begin(), reference.fonts.end());
    for (const auto& [name, hash] : fonts) {
        const std::string mine = hash_in(here, name);
        const std::string other = hash_in(reference, name);
        if (mine != other) add(name + ' ', mine.substr(0, kDigits), other.substr(0, kDigits));
    }
    if (here.imgui != reference.imgui) add("Dear ImGui ", here.imgui, reference.imgui);
    if (here.opengl != reference.opengl) add("", here.opengl, reference.opengl);
    return out;
}

}  // namespace mobbscope::picture_tests
