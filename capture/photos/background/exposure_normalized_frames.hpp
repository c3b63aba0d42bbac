#pragma once
/// \file
/// Frames of a turn with equalised exposure, and a denoised copy of them.
///
/// First stage of the background estimate (background_model.hpp): later stages compare the frames pixel by pixel, so a
/// change of exposure must not look like motion. Denoised values (`smooth()`) determine which frames agree, since noise
/// is independent between pixels while motion covers neighbours; the original values give the colours.

#include "capture/photos/intake/exposure.hpp"
#include "rayspace/image/image.hpp"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace rs::capture {

/// Read access is thread-safe.
class ExposureNormalizedFrames {
public:
    /// Starts without a correction. `frames`: at least one, all of one size, sRGB; they must outlive this. Memory: a
    /// denoised copy of all frames.
    explicit ExposureNormalizedFrames(std::span<const Image<Rgba8>> frames);

    /// Divides frame i by its exposure_gain() relative to `background`, measured where `always_visible` is not 0; both
    /// have the size of the frames. Replaces an earlier correction. Does nothing unless the gains of two frames differ
    /// by the factor `min_change` (>= 1) in some channel. Returns whether any value has changed.
    bool normalize(ConstImageView<Rgba8> background, ConstImageView<std::uint8_t> always_visible, float min_change = 1);

    [[nodiscard]] std::size_t count() const { return frames_.size(); }
    [[nodiscard]] int width() const { return frames_[0].width(); }
    [[nodiscard]] int height() const { return frames_[0].height(); }
    /// Corrected pixel, opaque.
    [[nodiscard]] Rgba8 operator()(std::size_t frame, int x, int y) const {
        return mapped(code_maps_[frame], frames_[frame](x, y));
    }
    /// The same, denoised by a 3 x 3 binomial filter (1 2 1).
    [[nodiscard]] Rgba8 smooth(std::size_t frame, int x, int y) const {
        return mapped(code_maps_[frame], smooth_[index_of(x, y) + frame]);
    }

private:
    using CodeMap = std::array<std::array<std::uint8_t, 256>, 3>;  // [channel][code]

    static Rgba8 mapped(const CodeMap& map, const Rgba8& p) { return {map[0][p.r], map[1][p.g], map[2][p.b], 255}; }

    // Index of the pixel's first frame in smooth_.
    [[nodiscard]] std::size_t index_of(int x, int y) const {
        return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width()) + static_cast<std::size_t>(x)) *
               count();
    }

    std::span<const Image<Rgba8>> frames_;
    std::vector<Rgba8> smooth_;       // [y][x][frame]: most callers read all frames of a pixel
    std::vector<CodeMap> code_maps_;  // [frame]
};

}  // namespace rs::capture
