#pragma once
// Record classes of the `board` encoder, [0] being the empty block; chosen by experiments on captured objects. They are
// written into the file; decoders accept any classes.

#include "rayspace/codec/code/board_code.hpp"

#include <array>

namespace rs::encode {

/// predicted, alpha, block stages, quarter stages
inline constexpr std::array<codec::RecordClass, codec::kBoardClasses> kFlatClasses = {{{},
                                                                                       {false, false, 1, 0},
                                                                                       {false, false, 1, 1},
                                                                                       {false, false, 1, 2},
                                                                                       {false, false, 1, 4},
                                                                                       {false, true, 1, 1},
                                                                                       {false, true, 1, 2},
                                                                                       {false, true, 1, 4}}};
inline constexpr std::array<codec::RecordClass, codec::kBoardClasses> kPredictedClasses = {{{},
                                                                                            {true, false, 2, 0},
                                                                                            {true, false, 2, 1},
                                                                                            {true, false, 2, 2},
                                                                                            {true, false, 2, 3},
                                                                                            {true, true, 2, 1},
                                                                                            {true, true, 2, 2},
                                                                                            {false, true, 1, 1}}};

}  // namespace rs::encode
