#include <fuzz/mutate.h>

#include <base/error.h>
#include <import/fbx/document.h>

#include "import/fbx_writer.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <variant>

namespace mobbscope::fuzz {

namespace {

using testing::FbxWrite;
using testing::FbxWritten;

/// A record with all that is inside it, as it can be written again; an array that cannot be read is left empty.
FbxWrite written(FbxDocument& document, FbxDocument::Index at, int deep = 0) {
    const FbxRecord record = document.record(at);
    FbxWrite out{std::string(record.name)};
    for (const FbxValue& value : document.values(at)) {
        switch (value.kind) {
            case FbxValue::Kind::integer:
                out.values.emplace_back(value.integer);
                break;
            case FbxValue::Kind::real:
                out.values.emplace_back(value.real);
                break;
            case FbxValue::Kind::text:
                out.values.emplace_back(fbx_text(value));
                break;
            case FbxValue::Kind::array:
                try {
                    if (out.name == "KeyAttrDataFloat") {
                        out.values.emplace_back(document.float_bits(at));
                    } else if (value.type == 'd' || value.type == 'f') {
                        out.values.emplace_back(document.numbers(at));
                    } else {
                        out.values.emplace_back(document.integers(at));
                    }
                } catch (const InputError&) {
                    out.values.emplace_back(std::vector<double>{});
                }
        }
    }
    constexpr int kDeep = 50;
    if (deep < kDeep) {
        document.each_inside(
            at, [&](FbxDocument::Index inside) { out.inside.push_back(written(document, inside, deep + 1)); });
    }
    return out;
}

struct FbxFile {
    int version = 7400;
    std::vector<FbxWrite> records;
};

/// No records of what cannot be read.
FbxFile fbx_file(const std::string& bytes) {
    FbxFile out;
    try {
        FbxDocument document(bytes, "fuzz.fbx");
        out.version = document.version();
        document.each_inside(FbxDocument::kFile, [&](FbxDocument::Index at) {
            if (document.record(at).name != "FBXHeaderExtension") out.records.push_back(written(document, at));
        });
    } catch (const InputError&) {
        out.records.clear();
    }
    return out;
}

struct FbxSpot {
    FbxWrite* record;
    std::vector<FbxWrite>* among;
    std::size_t index;
};

void collect_records(std::vector<FbxWrite>& records, std::vector<FbxSpot>& out) {
    for (std::size_t i = 0; i < records.size(); ++i) {
        out.push_back({&records[i], &records, i});
        collect_records(records[i].inside, out);
    }
}

std::vector<FbxSpot> records_of(std::vector<FbxWrite>& records) {
    std::vector<FbxSpot> out;
    collect_records(records, out);
    return out;
}

std::int64_t whole_of(double number) {
    return std::abs(number) < 9e18 ? static_cast<std::int64_t>(number) : std::numeric_limits<std::int64_t>::min();
}

template <class Number>
void edit_list(std::vector<Number>& list, Mutation& by) {
    const auto other = [&](Number number) {
        if constexpr (std::is_same_v<Number, double>) {
            return by.one_in(12) ? std::numeric_limits<double>::quiet_NaN() : by.other_number(number);
        } else if constexpr (std::is_same_v<Number, std::uint32_t>) {
            return by.one_in(2) ? static_cast<std::uint32_t>(by.random()) : number ^ (1u << by.below(32));
        } else {
            return by.one_in(2) ? number ^ (std::int64_t{1} << by.below(63))
                                : whole_of(by.other_number(static_cast<double>(number)));
        }
    };
    switch (by.below(6)) {
        case 0:
            list.resize(by.below(list.size() + 3));
            break;
        case 1:
            if (!list.empty() && list.size() < 5000) list.insert(list.end(), list.begin(), list.end());
            break;
        case 2:
            std::reverse(list.begin(), list.end());
            break;
        default:
            if (!list.empty()) {
                Number& number = list[by.below(list.size())];
                number = other(number);
            }
    }
}

/// What is within a value becomes another one of its kind; now and then it is of another kind.
void edit_value(FbxWritten& value, const std::vector<FbxSpot>& spots, Mutation& by) {
    if (by.one_in(4)) {  // a number or name that stands elsewhere: mostly of other objects
        const FbxWrite& other = *spots[by.below(spots.size())].record;
        if (!other.values.empty()) value = FbxWritten(other.values[by.below(other.values.size())]);
        return;
    }
    if (auto* whole = std::get_if<std::int64_t>(&value))
        *whole = whole_of(by.other_number(static_cast<double>(*whole)));
    if (auto* real = std::get_if<double>(&value)) *real = by.other_number(*real);
    if (auto* text = std::get_if<std::string>(&value)) *text = by.bytes(*text);
    if (auto* list = std::get_if<std::vector<std::int64_t>>(&value)) edit_list(*list, by);
    if (auto* list = std::get_if<std::vector<double>>(&value)) edit_list(*list, by);
    if (auto* list = std::get_if<std::vector<std::uint32_t>>(&value)) edit_list(*list, by);
}

void edit_fbx(std::vector<FbxWrite>& records, Mutation& by) {
    const std::vector<FbxSpot> spots = records_of(records);
    if (spots.empty()) return;
    const FbxSpot spot = spots[by.below(spots.size())];
    switch (by.below(8)) {
        case 0:
            spot.among->erase(spot.among->begin() + static_cast<std::ptrdiff_t>(spot.index));
            break;
        case 1: {
            const FbxWrite copy = *spot.record;
            spot.among->insert(spot.among->end(), by.one_in(8) ? 30 : 1, copy);
            break;
        }
        case 2: {  // of another file
            FbxFile donor = fbx_file(by.donor());
            const std::vector<FbxSpot> others = records_of(donor.records);
            if (!others.empty()) spot.among->push_back(*others[by.below(others.size())].record);
            break;
        }
        case 3: {
            FbxWrite copy = *spots[by.below(spots.size())].record;
            spot.record->inside.push_back(std::move(copy));
            break;
        }
        default:
            if (!spot.record->values.empty())
                edit_value(spot.record->values[by.below(spot.record->values.size())], spots, by);
    }
}

}  // namespace

std::string mutated_fbx(const std::string& bytes, Mutation& mutation) {
    FbxFile file = fbx_file(bytes);
    if (file.records.empty()) return "";
    for (std::size_t edits = mutation.edits(); edits > 0; --edits) edit_fbx(file.records, mutation);
    testing::FbxForm form{file.version, mutation.one_in(4), mutation.one_in(2), mutation.one_in(8)};
    if (mutation.one_in(16)) form.version = form.version == 7400 ? 7500 : 7100;
    return testing::fbx_bytes(std::move(file.records), form);
}

}  // namespace mobbscope::fuzz
