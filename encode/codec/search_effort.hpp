#pragma once
// Effort levels of the dense encoder's search. docs/notes/codec.md lists the time and gain of each level.

#include <algorithm>
#include <array>

namespace rs::encode {

inline constexpr int kMinEffort = 1;
inline constexpr int kMaxEffort = 9;
inline constexpr int kDefaultEffort = 5;

/// Search effort per unit.
struct UnitEffort {
    int intra = 4;               // intra modes that are evaluated with all planes
    int coded = 7;               // predictions that are coded in full, best estimates first
    int refits = 2;              // repetitions of the transform for units with invalid samples
    bool all_transforms = true;  // both sizes for each prediction; else small ones for the best prediction only
    bool all_splits = true;      // try splitting even if the whole unit needs no coefficients
    int motion_step = 1;         // MotionSearch::step
    int fractions = 8;           // MotionSearch::neighbours
};

struct SearchEffort {
    UnitEffort unit;
    UnitEffort first_pass;  // effort of the pass that only measures the probabilities
    int sampled = 1;        // the first pass codes every `sampled`-th tile
};

constexpr SearchEffort search_effort(int effort) {
    constexpr UnitEffort kLeast{1, 1, 0, false, false, 2, 4};
    constexpr UnitEffort kLess{2, 1, 0, false, false, 2, 8};
    constexpr UnitEffort kSome{2, 2, 1, false, false, 2, 8};
    constexpr UnitEffort kUsual{3, 3, 1, false, false, 2, 8};
    constexpr UnitEffort kMore{4, 4, 1, false, true, 1, 8};
    constexpr UnitEffort kMuch{4, 5, 2, true, true, 1, 8};
    constexpr UnitEffort kAll{};
    constexpr std::array<SearchEffort, kMaxEffort> kEfforts = {{{kLeast, kLeast, 8},
                                                                {kLess, kLeast, 8},
                                                                {kSome, kLeast, 4},
                                                                {kSome, kLess, 4},
                                                                {kUsual, kLess, 4},
                                                                {kUsual, kSome, 2},
                                                                {kMore, kSome, 2},
                                                                {kMuch, kUsual, 1},
                                                                {kAll, kAll, 1}}};
    return kEfforts[static_cast<std::size_t>(std::clamp(effort, kMinEffort, kMaxEffort) - 1)];
}

}  // namespace rs::encode
