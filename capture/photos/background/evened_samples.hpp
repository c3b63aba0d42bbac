#pragma once
// The samples of a survey as they would look had all of them been exposed alike, and a copy of them without the
// sensor's noise to judge by what stands still: noise differs from pixel to pixel, what moves seldom does.

#include "capture/photos/intake/exposure.hpp"
#include "rayspace/image/image.hpp"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace rs::capture {

class EvenedSamples {
public:
    // Exposed as they are. At least one sample, all of one size; they must outlive this. Takes as much memory again.
    explicit EvenedSamples(std::span<const Image<Rgba8>> samples);

    // Divides sample i by exposure_gain() from `still`, over the pixels where `untouched` is not 0; but none unless two
    // gains differ by the factor `least_change` at least in a channel. Whether any sample looks different now.
    bool even_out(ConstImageView<Rgba8> still, ConstImageView<std::uint8_t> untouched, float least_change = 1);

    [[nodiscard]] std::size_t count() const { return samples_.size(); }
    [[nodiscard]] int width() const { return samples_[0].width(); }
    [[nodiscard]] int height() const { return samples_[0].height(); }
    [[nodiscard]] Rgba8 operator()(std::size_t sample, int x, int y) const {
        return evened(codes_[sample], samples_[sample](x, y));
    }
    // The weighted mean of 3 x 3 pixels (1 2 1 either way).
    [[nodiscard]] Rgba8 smooth(std::size_t sample, int x, int y) const {
        return evened(codes_[sample], smooth_[place(x, y) + sample]);
    }

private:
    using Codes = std::array<std::array<std::uint8_t, 256>, 3>;  // [channel][code]

    static Rgba8 evened(const Codes& codes, const Rgba8& p) {
        return {codes[0][p.r], codes[1][p.g], codes[2][p.b], 255};
    }

    // Of the first sample in smooth_.
    [[nodiscard]] std::size_t place(int x, int y) const {
        return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width()) + static_cast<std::size_t>(x)) *
               count();
    }

    std::span<const Image<Rgba8>> samples_;
    std::vector<Rgba8> smooth_;  // [y][x][sample]: most who ask for one at a place ask for all
    std::vector<Codes> codes_;   // [sample]
};

}  // namespace rs::capture
