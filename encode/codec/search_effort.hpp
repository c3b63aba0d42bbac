#pragma once
// Search effort of the dense encoder. docs/notes/codec.md lists the time and bits of each effort.

#include <algorithm>
#include <array>

namespace rs::encode {

inline constexpr int kLeastEffort = 1;
inline constexpr int kMostEffort = 9;
inline constexpr int kUsualEffort = 5;

// What is tried for each unit.
struct UnitEffort {
    int intra = 4;               // modes of intra prediction that are looked at closely
    int coded = 7;               // predictions that are coded in full, of those that look best
    int refits = 2;              // times a unit with samples that are not valid is coded anew
    bool all_transforms = true;  // both sizes for each prediction; else small ones for the best prediction alone
    bool all_splits = true;      // quarters even where the whole needs no coefficients
    int motion_step = 1;         // MotionSearch::step
    int fractions = 8;           // neighbours in halves and quarters of a sample: 8, or 4
};

struct SearchEffort {
    UnitEffort unit;
    UnitEffort first_pass;  // of the pass that only finds the probabilities
    int sampled = 1;        // the first pass takes every so many-th tile
};

constexpr SearchEffort search_effort(int effort) {
    constexpr UnitEffort kLeast{1, 1, 0, false, false, 2, 4};
    constexpr UnitEffort kLess{2, 1, 0, false, false, 2, 8};
    constexpr UnitEffort kSome{2, 2, 1, false, false, 2, 8};
    constexpr UnitEffort kUsual{3, 3, 1, false, false, 2, 8};
    constexpr UnitEffort kMore{4, 4, 1, false, true, 1, 8};
    constexpr UnitEffort kMuch{4, 5, 2, true, true, 1, 8};
    constexpr UnitEffort kAll{};
    constexpr std::array<SearchEffort, kMostEffort> kEfforts = {{{kLeast, kLeast, 8},
                                                                 {kLess, kLeast, 8},
                                                                 {kSome, kLeast, 4},
                                                                 {kSome, kLess, 4},
                                                                 {kUsual, kLess, 4},
                                                                 {kUsual, kSome, 2},
                                                                 {kMore, kSome, 2},
                                                                 {kMuch, kUsual, 1},
                                                                 {kAll, kAll, 1}}};
    return kEfforts[static_cast<std::size_t>(std::clamp(effort, kLeastEffort, kMostEffort) - 1)];
}

}  // namespace rs::encode
