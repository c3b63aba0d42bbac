#pragma once
// Data shared by all dense images of an object (chunk CODE), and the head of each image before its tiles (chunk PICT):
// encode/FORMAT.md, sections "CODE" and "PICT".

#include "rayspace/codec/code/contexts.hpp"
#include "rayspace/codec/code/tile_grid.hpp"
#include "rayspace/codec/kernels/prediction.hpp"
#include "rayspace/codec/kernels/transform.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

namespace rs::codec {

enum class AlphaCoding : std::uint8_t {
    kLevels = 0,  // a level of 1 to 4 bits per sample
    kMask = 1,    // 1 or 2 bits: a mask of samples covered by one half or more, and with 2 bits the inner level
    kDepths = 2,  // 3 to 6 bits: a mask, and the distance from 0 or full
};

/// Distance of alpha from 0 (255) beside a mask's edge: [mask][weight of the differing samples around, 1 .. 12].
using EdgeAlpha = std::array<std::uint8_t, 24>;
inline constexpr int kEdgeWeights = 12;
inline constexpr int kMaxEdgeAlpha = 127;

struct DenseCode {
    bool has_masks = true;                           // false: alpha is coded as levels
    int alpha_bits = 2;                              // 1 .. kMaxAlphaBits, or kMaxAlphaLevelBits
    EdgeAlpha edge_alpha = {};                       // 0 .. kMaxEdgeAlpha; 1-bit masks only
    bool deblocking = true;                          // deblocking.hpp
    bool adaptation = true;                          // context_states.hpp
    bool sign_data_hiding = true;                    // syntax.hpp
    std::array<int, 2> chroma_step_offset = {0, 0};  // U and V: added to the step index of Y; +-kMaxChromaOffset
    std::array<std::uint16_t, context::kCount> probabilities = {};  // probability of a 0 in 4096ths; 8 .. 4088

    [[nodiscard]] AlphaCoding alpha_coding() const {
        if (!has_masks) return AlphaCoding::kLevels;
        return alpha_bits <= 2 ? AlphaCoding::kMask : AlphaCoding::kDepths;
    }
    [[nodiscard]] bool has_edge_alpha() const { return has_masks && alpha_bits == 1; }
    /// The number of contexts in use.
    [[nodiscard]] int contexts() const { return has_masks ? context::kMaskCount : context::kLevelsCount; }
    /// The step index of plane 0 .. 2.
    [[nodiscard]] int plane_step(int step, int plane) const {
        if (plane == 0) return step;
        return std::clamp(step + chroma_step_offset[static_cast<std::size_t>(plane - 1)], 0, kMaxStep);
    }
};
inline constexpr int kMaxAlphaBits = 6;       // with masks
inline constexpr int kMaxAlphaLevelBits = 4;  // with levels
inline constexpr int kMaxChromaOffset = 31;

inline constexpr std::uint16_t kNoReference = 0xFFFF;

struct ImageHead {
    int step = 0;                                                           // quantiser step of Y, 0 .. kMaxStep
    std::array<std::uint16_t, 2> reference = {kNoReference, kNoReference};  // views; the second only with the first
    std::array<MotionVector, 2> global_motion;
    [[nodiscard]] int references() const {
        return (reference[0] != kNoReference ? 1 : 0) + (reference[1] != kNoReference ? 1 : 0);
    }
};

}  // namespace rs::codec
