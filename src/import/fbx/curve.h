/// A number that moves in time, as FBX keys it.
#pragma once

#include <import/fbx/document.h>

#include <memory>
#include <vector>

namespace mobbscope {

/// From a key to the next one.
enum class FbxInterpolation { constant, constant_next, linear, cubic };

struct FbxKey {
    double time = 0;  ///< seconds
    double value = 0;
    FbxInterpolation interpolation = FbxInterpolation::linear;  ///< until the next key
    // Tangents of cubic keys: units a second, and the handle's length as a share of the time to the next key, 0 to 1.
    double slope_before = 0;
    double slope_after = 0;
    double weight_before = 1.0 / 3;
    double weight_after = 1.0 / 3;
};

/// What a curve does before its first or after its last key.
struct FbxExtrapolation {
    enum class Kind { constant, slope, repeat, mirror, repeat_relative };
    Kind kind = Kind::constant;
    double times = -1;  ///< at most so often; below 0: without end
};

class FbxCurve {
  public:
    /// Keys with times that never fall; of several at one time the last one counts from there on.
    FbxCurve(std::vector<FbxKey> keys, double ticks_per_second, FbxExtrapolation before, FbxExtrapolation after)
        : keys_(std::move(keys)), ticks_per_second_(ticks_per_second), before_(before), after_(after) {}

    const std::vector<FbxKey>& keys() const { return keys_; }
    /// The distinct times of the keys, seconds.
    std::vector<double> times() const;
    /// Whether all keys have one value, but for less than `tolerance`.
    bool is_constant(double tolerance) const;
    /// The value at a time in seconds; there is at least one key.
    double at(double seconds) const;

  private:
    double inside(double seconds) const;
    double outside(double seconds) const;

    std::vector<FbxKey> keys_;
    double ticks_per_second_;
    FbxExtrapolation before_, after_;
};

/// The curve of an AnimationCurve record; null if it has no keys. Throws InputError.
std::shared_ptr<const FbxCurve> fbx_curve(FbxDocument& document, FbxDocument::Index record, double ticks_per_second);

/// FBX 6: the same of a channel of a take, whose keys stand in one list of times, values and letters. Throws
/// InputError.
std::shared_ptr<const FbxCurve> fbx_curve_of_channel(FbxDocument& document, FbxDocument::Index channel,
                                                     double ticks_per_second);

}  // namespace mobbscope
