#pragma once
// Context indices of the binary decisions of a dense image, 0 .. kCount - 1, into the object's probability table:
// encode/FORMAT.md, section "Contexts".

namespace rs::codec::context {

/// Kinds of coefficient blocks: plane (Y, or U and V) * 4 + size (8x8, 16x16) * 2 + (is inter-predicted).
inline constexpr int kBlockKinds = 8;
inline constexpr int kBands = 4;
inline constexpr int kNearSums = 5;

inline constexpr int kMacroblockAlpha = 0;                     // [left class 4][above class 4][bin 2]
inline constexpr int kBlockAlpha = kMacroblockAlpha + 32;      // [left class 4][above class 4][bin 2]
inline constexpr int kSplit = kBlockAlpha + 32;                // [neighbours split 3]
inline constexpr int kInter = kSplit + 3;                      // [size 2][neighbours inter 3]
inline constexpr int kBoth = kInter + 6;                       // [size 2][neighbours that use both 3]
inline constexpr int kSecond = kBoth + 6;                      // [size 2][neighbours that use the second 3]
inline constexpr int kIntraMode = kSecond + 6;                 // [size 2][node 7]
inline constexpr int kMotionZero = kIntraMode + 14;            // [size 2]
inline constexpr int kComponentZero = kMotionZero + 2;         // [component 2]
inline constexpr int kComponentSign = kComponentZero + 2;      // [component 2]
inline constexpr int kComponentClass = kComponentSign + 2;     // [component 2][place 10]
inline constexpr int kComponentTop = kComponentClass + 20;     // [component 2][class 10]
inline constexpr int kSmallTransforms = kComponentTop + 20;    // [inter 2]
inline constexpr int kCoded = kSmallTransforms + 2;            // [size 2][inter 2][neighbours coded 3]
inline constexpr int kPlaneCoded = kCoded + 12;                // [plane 3][size 2][inter 2][planes coded before 2]
inline constexpr int kLastClass = kPlaneCoded + 24;            // [kind 8][place 8]
inline constexpr int kLastTop = kLastClass + kBlockKinds * 8;  // [kind 8][class 9]
inline constexpr int kNonZero = kLastTop + kBlockKinds * 9;    // [kind 8][band 4][near sum 5]
inline constexpr int kAboveOne = kNonZero + kBlockKinds * kBands * kNearSums;  // [kind 8][is DC 2][near sum 5]
inline constexpr int kAboveTwo = kAboveOne + kBlockKinds * 2 * kNearSums;      // [kind 8][is DC 2][near sum 5]
inline constexpr int kRestClass = kAboveTwo + kBlockKinds * 2 * kNearSums;     // [kind 8][place 14]
inline constexpr int kAlphaZero = kRestClass + kBlockKinds * 14;               // [predicted 4][W 3][N 3][NW 3][NE 3]
inline constexpr int kAlphaFull = kAlphaZero + 4 * 81;                         // [predicted 4][W 3][N 3][NW 3][NE 3]
inline constexpr int kAlphaBetween = kAlphaFull + 4 * 81;                      // [mean of W and N 3][node 16]
inline constexpr int kLevelsCount = kAlphaBetween + 3 * 16;

/// Objects whose alpha is a mask use these instead of the three above.
inline constexpr int kMaskFroms = 8;
inline constexpr int kMask = kAlphaZero;                // [predicted 8][samples coded before 64]
inline constexpr int kInner = kMask + kMaskFroms * 64;  // [neighbours 3][predicted 3][mask 2][sum of mask 17]
/// Masks of more than two bits; beside: whether the mask changes around the sample.
inline constexpr int kDepthOff = kInner + 3 * 3 * 2 * 17;  // [predicted 3][beside 2][activity 6]
inline constexpr int kDepthBelow = kDepthOff + 3 * 2 * 6;  // [beside 2][activity 6]
inline constexpr int kDepthClass = kDepthBelow + 2 * 6;    // [beside 2][place 8]
inline constexpr int kDepthTop = kDepthClass + 2 * 8;      // [beside 2][class 8]
inline constexpr int kMaskCount = kDepthTop + 2 * 8;

inline constexpr int kCount = kMaskCount > kLevelsCount ? kMaskCount : kLevelsCount;

}  // namespace rs::codec::context
