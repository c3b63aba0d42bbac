#pragma once
// Finds the frames between which the turntable makes one turn.

#include "capture/photos/intake/video/frame_copy.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace rs::capture {

/// Frames [begin, end). If `is_closed`, frame `end` shows the same pose as frame `begin`; otherwise no pose is shown
/// twice, and the range covers all frames in which the object turns.
struct TurnRange {
    std::size_t begin = 0;
    std::size_t end = 0;
    bool is_closed = false;
};

/// Finds the first turn whose end matches its beginning best, by self-similarity.
///
/// Frames are compared by their mean absolute difference over the moving region. A frame repeats an earlier one if
/// their difference, averaged with that of the following frames, is a local minimum far below the median difference.
/// \param copies  All of one size, normalize_exposure() applied.
/// \param region  moving_region() of the copies.
/// \param speed   TurningSpeed::per_frame: leading and trailing frames without rotation are removed.
TurnRange find_turn(const std::vector<FrameCopy>& copies, const Image<std::uint8_t>& region,
                    const std::vector<double>& speed);

}  // namespace rs::capture
