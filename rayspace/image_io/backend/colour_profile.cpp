#include "rayspace/image_io/backend/colour_profile.hpp"

#include <lcms2.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <type_traits>
#include <vector>

namespace rs::image_io {
namespace {

struct CloseProfile {
    void operator()(void* profile) const { cmsCloseProfile(profile); }
};
using Profile = std::unique_ptr<std::remove_pointer_t<cmsHPROFILE>, CloseProfile>;

// Splits the pixels, since lcms counts in 32 bits.
template <class Pixel>
void transform(void* by, std::span<Pixel> pixels) {
    constexpr std::size_t kAtATime = 1 << 24;
    for (std::size_t done = 0; done < pixels.size(); done += kAtATime) {
        const auto part = pixels.subspan(done, std::min(kAtATime, pixels.size() - done));
        cmsDoTransform(by, part.data(), part.data(), static_cast<cmsUInt32Number>(part.size()));
    }
}

}  // namespace

std::optional<ColourProfile> ColourProfile::create_unless_srgb(std::span<const std::byte> icc) {
    constexpr std::size_t kLargest_bytes = 16 << 20;
    if (icc.empty() || icc.size() > kLargest_bytes) return std::nullopt;
    const Profile file(cmsOpenProfileFromMem(icc.data(), static_cast<cmsUInt32Number>(icc.size())));
    if (!file || cmsGetColorSpace(file.get()) != cmsSigRgbData) return std::nullopt;
    const Profile srgb(cmsCreate_sRGBProfile());
    constexpr cmsUInt32Number kFlags = cmsFLAGS_NOCACHE | cmsFLAGS_COPY_ALPHA;
    const auto to_srgb = [&](cmsUInt32Number format) {
        return cmsCreateTransform(file.get(), format, srgb.get(), format, INTENT_RELATIVE_COLORIMETRIC, kFlags);
    };
    ColourProfile made(to_srgb(TYPE_RGBA_8), to_srgb(TYPE_RGBA_FLT));
    if (made.of_codes_ == nullptr || made.of_floats_ == nullptr) return std::nullopt;

    constexpr int kSteps = 5, kSameWithin_codes = 2;
    std::vector<Rgba8> colours;
    for (int i = 0; i < kSteps * kSteps * kSteps; ++i) {
        const auto code = [](int step) { return static_cast<std::uint8_t>(255 * step / (kSteps - 1)); };
        colours.push_back({code(i % kSteps), code(i / kSteps % kSteps), code(i / kSteps / kSteps), 255});
    }
    std::vector<Rgba8> shown = colours;
    made.to_srgb(std::span(shown));
    const auto near = [](const Rgba8& a, const Rgba8& b) {
        return std::abs(a.r - b.r) <= kSameWithin_codes && std::abs(a.g - b.g) <= kSameWithin_codes &&
               std::abs(a.b - b.b) <= kSameWithin_codes;
    };
    if (std::equal(colours.begin(), colours.end(), shown.begin(), near)) return std::nullopt;
    return made;
}

ColourProfile::~ColourProfile() {
    if (of_codes_ != nullptr) cmsDeleteTransform(of_codes_);
    if (of_floats_ != nullptr) cmsDeleteTransform(of_floats_);
}

void ColourProfile::to_srgb(std::span<Rgba8> pixels) const {
    transform(of_codes_, pixels);
}

void ColourProfile::to_srgb(std::span<RgbaF> pixels) const {
    transform(of_floats_, pixels);
    for (RgbaF& p : pixels) {
        p = {std::clamp(p.r, 0.0F, 1.0F), std::clamp(p.g, 0.0F, 1.0F), std::clamp(p.b, 0.0F, 1.0F), p.a};
    }
}

}  // namespace rs::image_io
