#include "capture/photos/intake/survey.hpp"

#include "capture/photos/intake/bounded_work.hpp"
#include "capture/photos/intake/colour_difference.hpp"
#include "capture/photos/intake/reduction.hpp"
#include "rayspace/base/median.hpp"

#include <algorithm>
#include <optional>
#include <span>
#include <utility>

namespace rs::capture {
namespace {

std::size_t count_samples(std::size_t photos) {
    return std::min<std::size_t>(photos, kMaxSamples);
}

}  // namespace

Rgba8 median_colour(std::span<const Rgba8> colours) {
    const auto median_of_channel = [&](std::uint8_t Rgba8::*channel) {
        std::vector<std::uint8_t> codes;
        for (const Rgba8& colour : colours) codes.push_back(colour.*channel);
        return median(std::move(codes));
    };
    return {median_of_channel(&Rgba8::r), median_of_channel(&Rgba8::g), median_of_channel(&Rgba8::b), 255};
}

Border measure_border(ConstImageView<Rgba8> photo) {
    constexpr int kMaxDark_code = 3;
    constexpr int kNear_codes = 10;
    constexpr double kMinNear = 0.85;  // share of all pixels
    constexpr double kMinFlat = 0.97;  // share of the near pixels
    std::vector<Rgba8> pixels;
    for (int y = 0; y < photo.height(); ++y) {
        const bool whole_row = y == 0 || y == photo.height() - 1;
        for (int x = 0; x < photo.width(); x += whole_row ? 1 : std::max(1, photo.width() - 1)) {
            pixels.push_back(photo(x, y));
        }
    }
    if (pixels.empty()) return {};
    Border border{median_colour(pixels)};
    std::int64_t near = 0, flat = 0, dark = 0, black = 0;
    for (const Rgba8& pixel : pixels) {
        const int brightest = std::max({pixel.r, pixel.g, pixel.b});
        dark += brightest <= kMaxDark_code ? 1 : 0;
        black += brightest == 0 ? 1 : 0;
        near += within_codes(pixel, border.median, kNear_codes) ? 1 : 0;
        flat += within_codes(pixel, border.median, kFlat_codes) ? 1 : 0;
    }
    const bool flat_black = 2 * dark > std::ssize(pixels) && black == dark;
    const bool dark_median = std::max({border.median.r, border.median.g, border.median.b}) <= kMaxDark_code;
    const bool flat_other = static_cast<double>(near) >= kMinNear * static_cast<double>(pixels.size()) &&
                            static_cast<double>(flat) >= kMinFlat * static_cast<double>(near);
    border.flat = dark_median ? flat_black : flat_other;
    return border;
}

Result<Survey> survey_photos(const PhotoFolder& folder, Progress* progress) {
    const std::size_t count = folder.photos.size();
    Survey survey;
    survey.thumbnails.resize(count);
    survey.samples.resize(count_samples(count));
    survey.borders.resize(survey.samples.size());
    std::vector<std::optional<std::size_t>> sample_of(count);
    for (std::size_t s = 0; s < survey.samples.size(); ++s) {
        survey.sample_photos.push_back(s * count / survey.samples.size());
        sample_of[survey.sample_photos.back()] = s;
    }
    const auto survey_photo = [&](std::size_t i) -> Status {
        RS_ASSIGN_OR_RETURN(const Image<Rgba8> photo, read_photo(folder, i));
        Image<Rgba8> sample = reduced(photo, kSampleSide_px);
        survey.thumbnails[i] = reduced(sample, kThumbnailSide_px);
        if (sample_of[i]) {
            survey.samples[*sample_of[i]] = std::move(sample);
            survey.borders[*sample_of[i]] = measure_border(photo);
        }
        return {};
    };
    RS_TRY(for_each_photo(folder, kReadBytesPerPixel, "surveying photos", progress, survey_photo));
    return survey;
}

}  // namespace rs::capture
