#pragma once
// Converts the colours of files with an ICC profile to sRGB. Phones write Display P3 and cameras Adobe RGB, which look
// dull if interpreted as sRGB.

#include "rayspace/image/image.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <utility>

namespace rs::image_io {

/// Little CMS transform with relative colorimetric intent: colours outside of sRGB are clipped to its gamut. Not
/// thread-safe.
class ColourProfile {
public:
    /// Creates the transform; nullopt if the bytes are not a profile of RGB images, or if all colours are within two
    /// 8-bit codes of sRGB.
    static std::optional<ColourProfile> create_unless_srgb(std::span<const std::byte> icc);

    ColourProfile(ColourProfile&& other) noexcept
        : of_codes_(std::exchange(other.of_codes_, nullptr)), of_floats_(std::exchange(other.of_floats_, nullptr)) {}
    ColourProfile& operator=(ColourProfile&&) = delete;
    ~ColourProfile();

    /// Converts colours; alpha is unchanged. Floats of 0..1 span the range of the codes.
    void to_srgb(std::span<Rgba8> pixels) const;
    void to_srgb(std::span<RgbaF> pixels) const;

private:
    ColourProfile(void* of_codes, void* of_floats) : of_codes_(of_codes), of_floats_(of_floats) {}
    void* of_codes_;  // cmsHTRANSFORM
    void* of_floats_;
};

}  // namespace rs::image_io
