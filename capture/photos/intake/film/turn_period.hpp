#pragma once
// Where one turn of the turntable begins and ends in a film.

#include "capture/photos/intake/film/frame_copy.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace rs::capture {

/// Frames [begin, end). Where `is_closed`, frame `end` shows the pose of frame `begin` again; otherwise the film shows
/// no pose twice, and the range is all of the film in which the object turns.
struct TurnRange {
    std::size_t begin = 0;
    std::size_t end = 0;
    bool is_closed = false;
};

/// The first turn in the film whose end repeats its beginning best.
///
/// Frames are compared by their mean absolute difference over the moving region. A frame repeats an earlier one where
/// their difference, and that of the frames right after them, falls to a local minimum far below what frames of this
/// film differ by.
/// \param copies  All of one size, normalize_exposure() applied.
/// \param region  moving_region() of the copies.
/// \param speed   TurningSpeed::per_frame: frames at its beginning and end that do not turn are cut off.
TurnRange find_turn(const std::vector<FrameCopy>& copies, const Image<std::uint8_t>& region,
                    const std::vector<double>& speed);

}  // namespace rs::capture
