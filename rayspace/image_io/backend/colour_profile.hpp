#pragma once
// Colours of a file that carries an ICC profile, as sRGB: phones take photographs in Display P3, cameras in Adobe RGB,
// which look dull where their numbers are taken for sRGB's.

#include "rayspace/image/image.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <utility>

namespace rs::image_io {

// For one thread. Little CMS, with relative colorimetric intent: what sRGB cannot show becomes its nearest edge.
class ColourProfile {
public:
    // None where the bytes are no profile of RGB images, and where it gives all colours within two 8-bit codes of
    // what sRGB does: those stay as they are.
    static std::optional<ColourProfile> unlike_srgb(std::span<const std::byte> icc);

    ColourProfile(ColourProfile&& other) noexcept
        : of_codes_(std::exchange(other.of_codes_, nullptr)), of_floats_(std::exchange(other.of_floats_, nullptr)) {}
    ColourProfile& operator=(ColourProfile&&) = delete;
    ~ColourProfile();

    // Alpha stays. Of floats, 0..1 is the range of the codes.
    void to_srgb(std::span<Rgba8> pixels) const;
    void to_srgb(std::span<RgbaF> pixels) const;

private:
    ColourProfile(void* of_codes, void* of_floats) : of_codes_(of_codes), of_floats_(of_floats) {}
    void* of_codes_;  // cmsHTRANSFORM
    void* of_floats_;
};

}  // namespace rs::image_io
