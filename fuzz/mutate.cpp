#include <fuzz/mutate.h>

#include <support/gzip.h>
#include <support/png_file.h>
#include "import/gltf_bytes.h"

#include <zlib.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace mobbscope::fuzz {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::array kOddNumbers{"0",
                                 "-0.0",
                                 "1",
                                 "-1",
                                 "2",
                                 "3",
                                 "7",
                                 "64",
                                 "1000",
                                 "65536",
                                 "1000000",
                                 "1e9",
                                 "1e-9",
                                 "0.5",
                                 "1e15",
                                 "2147483647",
                                 "-2147483648",
                                 "4294967295",
                                 "1e300",
                                 "-1e300",
                                 "1e-320",
                                 "360",
                                 "9007199254740993",
                                 "1e308",
                                 "0.1",
                                 "1e6",
                                 "1e5",
                                 "-0.5"};

constexpr std::size_t kDeepest = 200;

/// A value of a document, what holds it, and its key there.
struct JsonSpot {
    Json* value;
    Json* holder;  ///< null: it is the root
    std::string key;
};

void collect(Json& value, Json* holder, const std::string& key, std::vector<JsonSpot>& out) {
    out.push_back({&value, holder, key});
    if (value.is_object()) {
        for (auto& [name, member] : value.items()) collect(member, &value, name, out);
    } else if (value.is_array()) {
        for (Json& element : value) collect(element, &value, key, out);
    }
}

std::vector<JsonSpot> spots_of(Json& document) {
    std::vector<JsonSpot> out;
    collect(document, nullptr, "", out);
    return out;
}

/// Nothing of what is no JSON, or nested so deep that copies of it would overflow the stack.
Json parsed_json(const std::string& text) {
    std::size_t deep = 0, deepest = 0;
    for (const char c : text) {
        if (c == '[' || c == '{') deepest = std::max(deepest, ++deep);
        if ((c == ']' || c == '}') && deep > 0) --deep;
    }
    return deepest > kDeepest ? Json(Json::value_t::discarded) : Json::parse(text, nullptr, false);
}

void edit_json(Json& document, Mutation& by) {
    const std::vector<JsonSpot> spots = spots_of(document);
    const JsonSpot spot = spots[by.below(spots.size())];
    Json& value = *spot.value;
    constexpr std::size_t kWithin = 2;  // where there is a plain value it is mostly changed within
    switch (value.is_structured() || by.one_in(3) ? by.below(10) : kWithin) {
        case 0:
            value = Json::parse(by.odd_number());
            break;
        case 1:
        case 2:
            if (value.is_number()) {
                const double number = by.other_number(value.get<double>());
                value = number == std::floor(number) && std::abs(number) < 1e15
                            ? Json(static_cast<std::int64_t>(number))
                            : Json(number);
            } else if (value.is_boolean()) {
                value = !value.get<bool>();
            } else if (value.is_string()) {
                value = by.bytes(value.get<std::string>());
            }
            break;
        case 3: {
            const Json copy = *spots[by.below(spots.size())].value;
            value = copy;
            break;
        }
        case 4:
        case 5: {  // what another document has there, or anything of it
            Json donor = parsed_json(by.donor());
            if (donor.is_discarded()) break;
            std::vector<JsonSpot> others = spots_of(donor);
            std::vector<JsonSpot> alike;
            std::ranges::copy_if(others, std::back_inserter(alike),
                                 [&](const JsonSpot& other) { return other.key == spot.key; });
            const JsonSpot& taken =
                alike.empty() || by.one_in(4) ? others[by.below(others.size())] : alike[by.below(alike.size())];
            if (spot.value->is_object() && by.one_in(2)) {
                (*spot.value)[taken.key] = *taken.value;
            } else {
                value = *taken.value;
            }
            break;
        }
        case 6:
            if (!spot.holder) break;
            if (spot.holder->is_object()) {
                spot.holder->erase(spot.key);
            } else {
                spot.holder->erase(by.below(spot.holder->size()));
            }
            break;
        case 7:
        case 8:
            if (spot.holder && spot.holder->is_array()) {
                const Json copy = value;
                for (std::size_t i = by.one_in(8) ? 100 : 1 + by.below(3); i > 0; --i) spot.holder->push_back(copy);
            }
            break;
        default: {
            const std::array<Json, 7> plain{Json(),        Json(true),     Json(false), Json(""),
                                            Json::array(), Json::object(), Json("1")};
            value = plain[by.below(plain.size())];
        }
    }
}

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> out;
    for (std::size_t at = 0; at <= text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        out.push_back(text.substr(at, end - at));
        at = end + 1;
    }
    return out;
}

/// A line as words and what stands between them, in turns; it begins with what stands before the first word.
std::vector<std::string> pieces_of(const std::string& line) {
    constexpr std::string_view kBetween = " \t,;:(){}[]\"'<>=\r/";
    std::vector<std::string> out{""};
    for (const char c : line) {
        const bool between = kBetween.find(c) != kBetween.npos;
        if (between != (out.size() % 2 == 1)) out.emplace_back();
        out.back() += c;
    }
    return out;
}

/// `word` is one of the pieces.
void edit_word(std::string& word, std::vector<std::string>& pieces, Mutation& by) {
    switch (by.below(5)) {
        case 0:
            word = by.odd_number();
            break;
        case 1:
            word.clear();
            break;
        case 2: {
            const std::vector<std::string> others = lines_of(by.donor());
            const std::vector<std::string> taken = pieces_of(others[by.below(others.size())]);
            word = taken[by.below(taken.size())];
            break;
        }
        case 3:
            std::swap(word, pieces[1 + 2 * by.below(pieces.size() / 2)]);
            break;
        default: {
            std::string& other = pieces[by.below(pieces.size())];
            other = by.one_in(2) ? other + other : by.bytes(other);
        }
    }
}

void edit_line(std::string& line, Mutation& by) {
    std::vector<std::string> pieces = pieces_of(line);
    if (pieces.size() < 2) {
        line = by.bytes(line);
        return;
    }
    std::string& word = pieces[1 + 2 * by.below(pieces.size() / 2)];
    char* end = nullptr;
    const double number = std::strtod(word.c_str(), &end);
    if (end != word.c_str() && !by.one_in(4)) {
        char text[40];
        std::snprintf(text, sizeof text, "%.9g", by.other_number(number));
        word = by.one_in(6) ? by.odd_number() : text;
    } else {
        edit_word(word, pieces, by);
    }
    line.clear();
    for (const std::string& piece : pieces) line += piece;
}
/// The text of a chunk of a GLB, and the binary one.
struct GlbParts {
    std::string json, binary;
};

std::uint32_t little_endian(const std::string& bytes, std::size_t at) {
    std::uint32_t out = 0;
    for (std::size_t i = 0; i < 4; ++i)
        out |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at + i])) << (8 * i);
    return out;
}

GlbParts glb_parts(const std::string& bytes) {
    GlbParts out;
    for (std::size_t at = 12; at + 8 <= bytes.size();) {
        const std::size_t size = little_endian(bytes, at);
        const std::string content = bytes.substr(at + 8, size);
        (bytes.compare(at + 4, 4, "JSON") == 0 ? out.json : out.binary) = content;
        at += 8 + size;
    }
    return out;
}

/// Numbers of one width in the middle of others.
void edit_numbers(std::string& bytes, Mutation& by) {
    constexpr std::array<float, 9> kFloats{0, -1, 1, 1e-30F, 1e30F, INFINITY, NAN, 0.5F, 1e5F};
    if (bytes.size() < 4) return;
    const std::size_t at = by.below(bytes.size() / 4) * 4;
    switch (by.below(4)) {
        case 0:
            std::memcpy(&bytes[at], &kFloats[by.below(kFloats.size())], 4);
            break;
        case 1:
            std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(by.below(bytes.size() / 4) * 4), 4,
                        bytes.begin() + static_cast<std::ptrdiff_t>(at));
            break;
        case 2: {
            float number = 0;
            std::memcpy(&number, &bytes[at], 4);
            number = by.one_in(2) ? -number : number * 1.5F;
            std::memcpy(&bytes[at], &number, 4);
            break;
        }
        default:
            bytes[at + by.below(4)] = static_cast<char>(by.random());
    }
}

struct PngPart {
    std::string type, data;
};

std::vector<PngPart> png_parts(const std::string& file) {
    std::vector<PngPart> out;
    for (std::size_t at = testing::kPngSignature.size(); at + 12 <= file.size();) {
        std::size_t size = 0;
        for (std::size_t i = 0; i < 4; ++i) size = size << 8 | static_cast<unsigned char>(file[at + i]);
        out.push_back({file.substr(at + 4, 4), file.substr(at + 8, size)});
        at += 12 + size;
    }
    return out;
}

/// What zlib or gzip packed, up to 256 KiB; what there is of it where it is damaged.
std::string inflated(const std::string& packed) {
    constexpr int kEither = 32;
    z_stream stream{};
    if (inflateInit2(&stream, MAX_WBITS + kEither) != Z_OK) return "";
    std::string in = packed;
    std::string out(1 << 18, '\0');
    stream.next_in = reinterpret_cast<Bytef*>(in.data());
    stream.avail_in = static_cast<uInt>(in.size());
    stream.next_out = reinterpret_cast<Bytef*>(out.data());
    stream.avail_out = static_cast<uInt>(out.size());
    inflate(&stream, Z_FINISH);
    out.resize(out.size() - stream.avail_out);
    inflateEnd(&stream);
    return out;
}

void edit_png(std::vector<PngPart>& parts, Mutation& by) {
    if (parts.empty()) return;
    constexpr std::array kTypes{"PLTE", "tRNS", "gAMA", "cHRM", "sRGB", "iCCP", "sBIT", "bKGD", "tEXt", "IDAT", "IEND"};
    const std::size_t at = by.below(parts.size());
    PngPart& part = parts[at];
    const auto place = parts.begin() + static_cast<std::ptrdiff_t>(at);
    switch (by.below(8)) {
        case 0:
            parts.erase(place);
            break;
        case 1:
            parts.insert(place, PngPart(part));
            break;
        case 2:
            std::swap(part, parts[by.below(parts.size())]);
            break;
        case 3:
            part.type = kTypes[by.below(kTypes.size())];
            break;
        case 4:
            parts.insert(place, {kTypes[by.below(kTypes.size())], by.bytes(part.data.substr(0, 20))});
            break;
        default:
            if (part.type == "IDAT") {
                std::string rows = inflated(part.data);
                if (!rows.empty() && by.one_in(2)) rows[by.below(rows.size())] = static_cast<char>(by.below(8));
                part.data = testing::packed(by.one_in(3) ? by.bytes(rows) : rows);
            } else if (part.type == "IHDR" && part.data.size() == 13) {
                constexpr std::array<int, 14> kBytes{0, 1, 2, 3, 4, 6, 8, 16, 5, 7, 32, 64, 127, 255};
                const std::size_t byte = by.one_in(3) ? by.below(13) : 3 + by.below(10);
                part.data[byte] = static_cast<char>(kBytes[by.below(kBytes.size())]);
            } else {
                part.data = by.bytes(part.data);
            }
    }
}

using Mutate = std::string (*)(const std::string& bytes, Mutation& by);

/// Of what is packed in another file, with what a donor has there.
std::string mutated_inside(Mutate mutate, const std::string& text, const std::string& donor, Mutation& by) {
    const std::vector<std::string> donors{donor};
    Mutation inside{by.random, donors, by.bytes};
    std::string out = mutate(text, inside);
    by.random = inside.random;
    return out;
}

Mutate mutated_as(Form form) {
    switch (form) {
        case Form::fbx:
            return mutated_fbx;
        case Form::json:
            return mutated_json;
        case Form::glb:
            return mutated_glb;
        case Form::lines:
            return mutated_lines;
        case Form::sqlite:
            return mutated_sqlite;
        case Form::gzip:
            return mutated_gzip;
        case Form::png:
            return mutated_png;
    }
    throw std::logic_error("a form without a mutator");
}

}  // namespace

std::string Mutation::odd_number() { return kOddNumbers[below(kOddNumbers.size())]; }

double Mutation::other_number(double number) {
    switch (below(7)) {
        case 0:
            return number + 1;
        case 1:
            return number - 1;
        case 2:
            return -number;
        case 3:
            return number * 1000;
        case 4:
            return number / 2;
        case 5:
            return number + 1e-9;
        default:
            return std::strtod(odd_number().c_str(), nullptr);
    }
}

std::string mutated_json(const std::string& text, Mutation& mutation) {
    Json document = parsed_json(text);
    if (document.is_discarded()) return "";
    for (std::size_t edits = mutation.edits(); edits > 0; --edits) edit_json(document, mutation);
    return document.dump(mutation.one_in(8) ? 1 : -1, ' ', false, Json::error_handler_t::replace);
}

std::string mutated_lines(const std::string& text, Mutation& mutation) {
    std::vector<std::string> lines = lines_of(text);
    for (std::size_t edits = mutation.edits(); edits > 0 && !lines.empty(); --edits) {
        const std::size_t at = mutation.below(lines.size());
        const auto place = lines.begin() + static_cast<std::ptrdiff_t>(at);
        switch (mutation.below(10)) {
            case 0:
                lines.insert(place, mutation.one_in(8) ? 50 : 1 + mutation.below(2), std::string(lines[at]));
                break;
            case 1:
                lines.erase(place);
                break;
            case 2:
                std::swap(lines[at], lines[mutation.below(lines.size())]);
                break;
            case 3: {
                const std::vector<std::string> others = lines_of(mutation.donor());
                lines.insert(place, others[mutation.below(others.size())]);
                break;
            }
            case 4:
                lines[at] = mutation.bytes(lines[at]);
                break;
            default:
                edit_line(lines[at], mutation);
        }
    }
    std::string out;
    for (const std::string& line : lines) out += (&line == lines.data() ? "" : "\n") + line;
    return out;
}

std::string mutated_glb(const std::string& bytes, Mutation& mutation) {
    if (!bytes.starts_with("glTF")) return "";
    GlbParts parts = glb_parts(bytes);
    if (!parts.binary.empty() && mutation.one_in(3)) {
        for (std::size_t edits = mutation.edits(); edits > 0; --edits) edit_numbers(parts.binary, mutation);
    } else {
        parts.json = mutated_inside(mutated_json, parts.json, glb_parts(mutation.donor()).json, mutation);
    }
    return parts.json.empty() ? "" : testing::join_glb(parts.json, parts.binary);
}

std::string mutated_png(const std::string& bytes, Mutation& mutation) {
    std::vector<PngPart> parts = png_parts(bytes);
    if (parts.empty()) return "";
    for (std::size_t edits = mutation.edits(); edits > 0; --edits) edit_png(parts, mutation);
    std::string out(testing::kPngSignature);
    for (const PngPart& part : parts) out += testing::png_chunk(part.type, part.data);
    return out;
}

std::string mutated_gzip(const std::string& bytes, Mutation& mutation) {
    const std::string unpacked = inflated(bytes);
    if (unpacked.empty()) return "";
    std::string out = testing::gzipped(mutated_inside(mutated_lines, unpacked, inflated(mutation.donor()), mutation));
    if (mutation.one_in(8)) out += mutation.one_in(2) ? out : testing::gzipped(unpacked);
    if (mutation.one_in(16)) out.append(mutation.below(600), '\0');
    return out;
}

std::string mutated(Form form, const std::string& bytes, Mutation& mutation) {
    const std::string out = mutated_as(form)(bytes, mutation);
    return out.empty() ? mutation.bytes(bytes) : out;
}

}  // namespace mobbscope::fuzz
