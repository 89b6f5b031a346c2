#include <base/text.h>
#include <import/fbx/curve.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>

namespace mobbscope {

namespace {

// KeyAttrFlags of the FBX SDK.
constexpr std::uint32_t kConstant = 0x2;
constexpr std::uint32_t kCubic = 0x8;
constexpr std::uint32_t kConstantNext = 0x100;
constexpr std::uint32_t kTensionContinuityBias = 0x200;
constexpr std::uint32_t kUserTangents = 0x400;
constexpr std::uint32_t kClamped = 0x1000;
constexpr std::uint32_t kTimeIndependent = 0x2000;
constexpr std::uint32_t kClampedProgressively = 0x4000;
constexpr std::uint32_t kWeightedAfter = 0x1000000;
constexpr std::uint32_t kWeightedBeforeNext = 0x2000000;

constexpr double kUnweighted = 1.0 / 3;
constexpr double kWeightUnit = 1e-4;  // weights are stored as 16-bit fixed point, two in the bits of one float

/// What one entry of KeyAttrFlags and KeyAttrDataFloat says of a key.
struct Attributes {
    std::uint32_t flags = 0;
    std::array<double, 3> data{};  ///< slope after, slope before the next key; or tension, continuity, bias
    std::uint32_t weights = 0;

    double weight_after() const {
        return (flags & kWeightedAfter) ? std::min((weights & 0xffff) * kWeightUnit, 1.0) : kUnweighted;
    }
    double weight_before_next() const {
        return (flags & kWeightedBeforeNext) ? std::min((weights >> 16) * kWeightUnit, 1.0) : kUnweighted;
    }
};

/// Units a second from a key to a later one; 0 where it is not later.
double chord(const FbxKey& from, const FbxKey& to) {
    return to.time > from.time ? (to.value - from.value) / (to.time - from.time) : 0;
}

/// What a bias beyond 500 % adds to a slope: MotionBuilder's, units a second.
double beyond_bias(double bias, double sign) {
    const double beyond = std::abs(bias) / 100 - 5;
    return beyond > 0 ? std::copysign(40 * beyond * beyond, sign) : 0;
}

/// The slope that an automatic tangent has at `key`; null: there is no key on that side. `bias` in percent leads it
/// towards the next key, below 0 towards the one before. As the FBX SDK gives it, measured.
double automatic_slope(const FbxKey* before, const FbxKey& key, const FbxKey* after, double bias, std::uint32_t flags) {
    const auto is_flat = [&](const FbxKey* other) { return other && other->value == key.value; };
    if ((flags & kClamped) && (is_flat(before) || is_flat(after))) return 0;
    const bool is_biased = (flags & kTimeIndependent) == 0;
    if (!before || !after) {
        if (flags & kClampedProgressively) return 0;
        const double slope = before ? chord(*before, key) : after ? chord(key, *after) : 0;
        return slope + (is_biased ? beyond_bias(bias, bias) : 0);
    }
    double slope = chord(*before, *after);
    if (is_biased) {
        const double slope_before = chord(*before, key);
        const double slope_after = chord(key, *after);
        const double share = (key.time - before->time) / (after->time - before->time);
        // Half the chord over both keys, half the parabola through all three.
        slope = 0.5 * slope + 0.5 * ((1 - share) * slope_before + share * slope_after);
        const double weight = std::abs(bias) / 100;
        const double target = bias > 0 ? slope_after : slope_before;
        const double to_target = target - slope;
        slope += weight * to_target + beyond_bias(bias, std::abs(to_target) > 1e-5 ? to_target : bias);
    }
    if (flags & kClampedProgressively) {
        // No handle may reach beyond the value of the key on its side.
        const double sign = slope < 0 ? -1 : 1;
        const double most_before = sign * chord(*before, key) / std::max(key.weight_before, 1e-9);
        const double most_after = sign * chord(key, *after) / std::max(key.weight_after, 1e-9);
        slope = sign * std::clamp(std::min(most_before, most_after), 0.0, std::abs(slope));
    }
    return slope;
}

/// Kochanek and Bartels 1984, equations 8 and 9, over the slopes on both sides; at the ends there is but one.
void set_tension_continuity_bias(const FbxKey* before, FbxKey& key, const FbxKey* after, const Attributes& attributes) {
    const auto [tension, continuity, bias] = attributes.data;
    const double slope_before = before ? chord(*before, key) : 0;
    const double slope_after = after ? chord(key, *after) : 0;
    const double share = (before && after ? 0.5 : 1.0) * (1 - tension);
    key.slope_before =
        share * ((1 + bias) * (1 - continuity) * slope_before + (1 - bias) * (1 + continuity) * slope_after);
    key.slope_after =
        share * ((1 + bias) * (1 + continuity) * slope_before + (1 - bias) * (1 - continuity) * slope_after);
}

/// Tangents of key `i`, whose slope_before and weight_before are what the key before says of it; and what it says of
/// the next key.
void set_tangents(std::vector<FbxKey>& keys, std::size_t i, const Attributes& attributes) {
    FbxKey& key = keys[i];
    FbxKey* const next = i + 1 < keys.size() ? &keys[i + 1] : nullptr;
    const auto say_of_next = [&](double slope, double weight) {
        if (!next) return;
        next->slope_before = slope;
        next->weight_before = weight;
    };
    if (attributes.flags & kConstant) {
        key.interpolation =
            (attributes.flags & kConstantNext) ? FbxInterpolation::constant_next : FbxInterpolation::constant;
        return say_of_next(0, kUnweighted);
    }
    if (!(attributes.flags & kCubic)) {
        key.interpolation = FbxInterpolation::linear;
        key.slope_after = next ? chord(key, *next) : 0;
        return say_of_next(key.slope_after, kUnweighted);
    }
    key.interpolation = FbxInterpolation::cubic;
    key.slope_after = attributes.data[0];
    key.weight_after = attributes.weight_after();
    const FbxKey* const before = i > 0 && keys[i - 1].time < key.time ? &keys[i - 1] : nullptr;
    const FbxKey* const after = next && key.time < next->time ? next : nullptr;
    if (attributes.flags & kTensionContinuityBias) {
        key.weight_after = kUnweighted;
        set_tension_continuity_bias(before, key, after, attributes);
        return say_of_next(0, kUnweighted);
    }
    if (!(attributes.flags & kUserTangents)) {
        // The slopes that are stored are biases then; where both sides have one of their own, the tangent is broken.
        const double bias_before = -key.slope_before;
        const double bias_after = key.slope_after;
        const bool is_broken = before && after && std::abs(bias_after - bias_before) > 1e-4;
        key.slope_after =
            automatic_slope(before, key, after, before && !after ? bias_before : bias_after, attributes.flags);
        key.slope_before =
            is_broken ? automatic_slope(before, key, after, bias_before, attributes.flags) : key.slope_after;
    }
    say_of_next(attributes.data[1], attributes.weight_before_next());
}

/// The parameter in [0, 1] at which Bezier's cubic with the ordinates 0, a, b, 1 is `x`; a and b in [0, 1], so it
/// rises.
double bezier_parameter(double a, double b, double x) {
    double low = 0;
    double high = 1;
    double at = x;
    for (int i = 0; i < 60 && high - low > 1e-15; ++i) {
        const double rest = 1 - at;
        const double off = 3 * rest * rest * at * a + 3 * rest * at * at * b + at * at * at - x;
        if (off == 0) break;
        (off < 0 ? low : high) = at;
        const double slope = 3 * rest * rest * a + 6 * rest * at * (b - a) + 3 * at * at * (1 - b);
        const double newton = at - off / slope;
        // Where handles are long, Newton's step leaves what is known; then halve.
        at = newton > low && newton < high ? newton : (low + high) / 2;
    }
    return at;
}

double bezier(const FbxKey& from, const FbxKey& to, double seconds) {
    const double span = to.time - from.time;
    const double t = bezier_parameter(from.weight_after, 1 - to.weight_before, (seconds - from.time) / span);
    const double rest = 1 - t;
    const double first = from.value + from.weight_after * span * from.slope_after;
    const double second = to.value - to.weight_before * span * to.slope_before;
    return rest * rest * rest * from.value + 3 * rest * rest * t * first + 3 * rest * t * t * second +
           t * t * t * to.value;
}

FbxExtrapolation extrapolation(const FbxDocument& document, FbxDocument::Index curve, std::string_view name) {
    FbxExtrapolation out;
    const FbxDocument::Index record = document.find(curve, name);
    const std::span<const FbxValue> type = document.values(document.find(record, "Type"));
    if (type.empty()) return out;
    // A letter: in text as a word, in binary as a number.
    const FbxValue& value = type[0];
    const std::int64_t letter = value.text.empty() ? value.integer : value.text[0];
    switch (letter) {
        case 'A':
            out.kind = FbxExtrapolation::Kind::repeat_relative;
            break;
        case 'K':
            out.kind = FbxExtrapolation::Kind::slope;
            break;
        case 'M':
            out.kind = FbxExtrapolation::Kind::mirror;
            break;
        case 'R':
            out.kind = FbxExtrapolation::Kind::repeat;
            break;
        default:
            break;
    }
    const std::span<const FbxValue> times = document.values(document.find(record, "Repetition"));
    if (!times.empty()) out.times = times[0].real;
    return out;
}

}  // namespace

std::vector<double> FbxCurve::times() const {
    std::vector<double> out;
    for (const FbxKey& key : keys_) {
        if (out.empty() || key.time > out.back()) out.push_back(key.time);
    }
    return out;
}

bool FbxCurve::is_constant(double tolerance) const {
    const auto [least, most] = std::ranges::minmax(keys_, {}, &FbxKey::value);
    return !(most.value - least.value > tolerance);
}

double FbxCurve::at(double seconds) const {
    if (keys_.size() == 1) return keys_[0].value;
    const bool is_inside = seconds >= keys_.front().time && seconds <= keys_.back().time;
    return is_inside ? inside(seconds) : outside(seconds);
}

double FbxCurve::inside(double seconds) const {
    const auto next = std::ranges::upper_bound(keys_, seconds, {}, &FbxKey::time);
    if (next == keys_.begin()) return keys_.front().value;
    const FbxKey& from = *(next - 1);
    if (next == keys_.end() || from.time == seconds) return from.value;
    switch (from.interpolation) {
        case FbxInterpolation::constant:
            return from.value;
        case FbxInterpolation::constant_next:
            return next->value;
        case FbxInterpolation::linear:
            return from.value + (next->value - from.value) * ((seconds - from.time) / (next->time - from.time));
        case FbxInterpolation::cubic:
            return bezier(from, *next, seconds);
    }
    return from.value;
}

double FbxCurve::outside(double seconds) const {
    using Kind = FbxExtrapolation::Kind;
    const bool is_before = seconds < keys_.front().time;
    const FbxKey& end = is_before ? keys_.front() : keys_.back();
    const FbxExtrapolation& rule = is_before ? before_ : after_;
    if (rule.kind == Kind::constant) return end.value;
    if (rule.kind == Kind::slope)
        return end.value + (seconds - end.time) * (is_before ? end.slope_after : end.slope_before);

    // In whole ticks, so that a time on a repeated key is on that key.
    const double begin = std::round(keys_.front().time * ticks_per_second_);
    const double duration = std::round(keys_.back().time * ticks_per_second_) - begin;
    if (duration < 1 || rule.times == 0) return end.value;
    const double beyond = std::round(std::abs(seconds - end.time) * ticks_per_second_);
    double cycle = std::floor(beyond / duration);
    double within = beyond - cycle * duration;
    if (rule.times > 0 && cycle >= rule.times) {
        cycle = rule.times - 1;
        within = duration;
    }
    const bool is_mirrored = rule.kind == Kind::mirror && std::fmod(cycle, 2) == 0;
    if (is_mirrored != is_before) within = duration - within;
    const double value = inside((begin + within) / ticks_per_second_);
    if (rule.kind != Kind::repeat_relative) return value;
    const double gain = keys_.back().value - keys_.front().value;
    return value + (cycle + 1) * (is_before ? -gain : gain);
}

namespace {

/// Goes through the keys of a channel.
class ChannelKeys {
  public:
    ChannelKeys(const FbxDocument& document, FbxDocument::Index record)
        : document_(document), record_(record), rest_(document.values(record)) {}

    bool at_end() const { return rest_.empty(); }

    double number() {
        const FbxValue& value = next();
        if (value.kind != FbxValue::Kind::integer && value.kind != FbxValue::Kind::real)
            fail(in_quotes(value.text) + " where a number is expected");
        return value.real;
    }
    /// In binary files as a number.
    char letter() {
        const FbxValue& value = next();
        return value.kind == FbxValue::Kind::text && !value.text.empty() ? value.text[0]
                                                                         : static_cast<char>(value.integer);
    }
    /// What stands behind time and value.
    Attributes attributes() {
        const char way = letter();
        if (way == 'L') return {};
        if (way == 'C') return {kConstant | (letter() == 'n' ? kConstantNext : 0), {}, 0};
        if (way != 'U') fail_letter(way);
        Attributes out{kCubic, {}, 0};
        const char slopes = letter();
        const std::size_t count = slopes == 's' || slopes == 'b' ? 2 : slopes == 't' ? 3 : 0;
        if (count == 0 && slopes != 'a') fail_letter(slopes);
        if (count > 0) out.flags |= count == 2 ? kUserTangents : kTensionContinuityBias;
        for (std::size_t i = 0; i < count; ++i) out.data[i] = number();
        if (count != 3) take_weights(out);
        return out;
    }

  private:
    [[noreturn]] void fail(const std::string& what) const {
        document_.fail(record_, "has " + what + "; export the file again as FBX 7.4 (FBX 2014/2015) or newer");
    }
    [[noreturn]] void fail_letter(char letter) const {
        fail("a key of a kind that is not known, " + in_quotes(cleaned({&letter, 1})));
    }

    const FbxValue& next() {
        if (rest_.empty()) fail("a key that is cut off");
        const FbxValue& value = rest_.front();
        rest_ = rest_.subspan(1);
        return value;
    }

    /// Of both handles, of this key's, of the next one's, or as usual.
    void take_weights(Attributes& out) {
        const char which = letter();
        if (which == 'n' || which == 'c') return;
        if (which != 'a' && which != 'r' && which != 'l') fail_letter(which);
        const auto stored = [this] {
            return static_cast<std::uint32_t>(std::clamp(number(), 0.0, 1.0) / kWeightUnit + 0.5);
        };
        if (which != 'l') {
            out.flags |= kWeightedAfter;
            out.weights |= stored();
        }
        if (which != 'r') {
            out.flags |= kWeightedBeforeNext;
            out.weights |= stored() << 16;
        }
    }

    const FbxDocument& document_;
    FbxDocument::Index record_;
    std::span<const FbxValue> rest_;
};

}  // namespace

std::shared_ptr<const FbxCurve> fbx_curve_of_channel(FbxDocument& document, FbxDocument::Index channel,
                                                     double ticks_per_second) {
    constexpr std::int64_t kOldestKeys = 4005;
    const FbxDocument::Index record = document.find(channel, "Key");
    if (record == FbxDocument::kNone) return nullptr;
    const FbxDocument::Index version = document.find(channel, "KeyVer");
    const std::span<const FbxValue> said = document.values(version);
    if (!said.empty() && said[0].integer < kOldestKeys)
        document.fail(version,
                      "is " + std::to_string(said[0].integer) +
                          ", and such keys are not read; export the file again as FBX 7.4 (FBX 2014/2015) or newer");
    ChannelKeys from(document, record);
    std::vector<FbxKey> keys;
    std::vector<Attributes> attributes;
    while (!from.at_end()) {
        keys.emplace_back().time = from.number() / ticks_per_second;
        keys.back().value = from.number();
        attributes.push_back(from.attributes());
        if (keys.size() > 1 && keys.back().time < keys[keys.size() - 2].time)
            document.fail(record, "has key " + std::to_string(keys.size() - 1) +
                                      " before the one before it; export the file again");
    }
    document.charge(record, keys.size(), sizeof(FbxKey));
    for (std::size_t i = 0; i < keys.size(); ++i) set_tangents(keys, i, attributes[i]);
    if (keys.empty()) return nullptr;
    return std::make_shared<const FbxCurve>(std::move(keys), ticks_per_second, FbxExtrapolation{}, FbxExtrapolation{});
}

std::shared_ptr<const FbxCurve> fbx_curve(FbxDocument& document, FbxDocument::Index record, double ticks_per_second) {
    const auto part = [&](std::string_view name) { return document.find(record, name); };
    const std::vector<std::int64_t> times = document.integers(part("KeyTime"));
    const std::vector<double> values = document.numbers(part("KeyValueFloat"));
    if (times.size() != values.size()) {
        document.fail(record, "has " + std::to_string(times.size()) + " times for " + std::to_string(values.size()) +
                                  " values; export the file again");
    }
    if (times.empty()) return nullptr;
    document.charge(record, times.size(), sizeof(FbxKey));
    std::vector<FbxKey> keys(times.size());
    for (std::size_t i = 0; i < keys.size(); ++i) {
        keys[i].time = static_cast<double>(times[i]) / ticks_per_second;
        keys[i].value = values[i];
        if (i > 0 && times[i] < times[i - 1])
            document.fail(record, "has key " + std::to_string(i) + " before the one before it; export the file again");
    }

    // One entry stands for as many keys as KeyAttrRefCount says, with four numbers of KeyAttrDataFloat.
    const std::vector<std::int64_t> flags = document.integers(part("KeyAttrFlags"));
    const std::vector<std::int64_t> counts = document.integers(part("KeyAttrRefCount"));
    const std::vector<std::uint32_t> data = document.float_bits(part("KeyAttrDataFloat"));
    if (counts.size() != flags.size() || data.size() != 4 * flags.size()) {
        document.fail(record, "has " + std::to_string(flags.size()) + " flags, " + std::to_string(data.size()) +
                                  " tangents and " + std::to_string(counts.size()) +
                                  " counts of keys, which do not belong together; export the file again");
    }
    std::size_t key = 0;
    for (std::size_t entry = 0; entry < flags.size(); ++entry) {
        const std::uint32_t* const bits = &data[4 * entry];
        const auto real = [&](std::size_t i) { return static_cast<double>(std::bit_cast<float>(bits[i])); };
        if (counts[entry] < 0)
            document.fail(record, "counts " + std::to_string(counts[entry]) + " keys; export the file again");
        const Attributes attributes{static_cast<std::uint32_t>(flags[entry]), {real(0), real(1), real(2)}, bits[2]};
        for (std::int64_t i = 0; i < counts[entry] && key < keys.size(); ++i) set_tangents(keys, key++, attributes);
    }
    if (!flags.empty() && key < keys.size()) {
        document.fail(record, "has tangents for " + std::to_string(key) + " of its " + std::to_string(keys.size()) +
                                  " keys; export the file again");
    }
    return std::make_shared<const FbxCurve>(std::move(keys), ticks_per_second,
                                            extrapolation(document, record, "Pre-Extrapolation"),
                                            extrapolation(document, record, "Post-Extrapolation"));
}

}  // namespace mobbscope
