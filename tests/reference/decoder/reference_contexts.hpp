#pragma once
// FORMAT.md, "Contexts": the first context of each name.

namespace rs::reference {

enum Context {
    kMacroblockAlpha = 0,
    kBlockAlpha = 32,
    kSplit = 64,
    kInter = 67,
    kBoth = 73,
    kSecond = 79,
    kIntraMode = 85,
    kMotionZero = 99,
    kComponentZero = 101,
    kComponentSign = 103,
    kComponentClass = 105,
    kComponentTop = 125,
    kSmallTransforms = 145,
    kCoded = 147,
    kPlaneCoded = 159,
    kLastClass = 183,
    kLastTop = 247,
    kNonZero = 319,
    kAboveOne = 479,
    kAboveTwo = 559,
    kRestClass = 639,
    kAlphaZero = 751,
    kAlphaFull = 1075,
    kAlphaBetween = 1399,
    // With alpha_coding 1 and 2, instead of the last three:
    kMask = 751,
    kInner = 1263,
    kDepthOff = 1569,
    kDepthBelow = 1605,
    kDepthClass = 1617,
    kDepthTop = 1633,
};

}  // namespace rs::reference
