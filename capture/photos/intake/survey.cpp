#include "capture/photos/intake/survey.hpp"

#include "capture/photos/intake/bounded_work.hpp"
#include "capture/photos/intake/colour_difference.hpp"
#include "rayspace/base/median.hpp"
#include "rayspace/pictures/picture_io.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

namespace rs::capture {
namespace {

std::size_t sample_count(std::size_t photos) {
    return std::min<std::size_t>(photos, kMaxSamples);
}

// The input pixels [begin, end) that one output pixel covers, which spans [from, to) of the input.
struct Cover {
    int begin, end;
    double from, to;
    // Share of the output pixel that input pixel i makes up.
    [[nodiscard]] float weight(int i) const {
        return static_cast<float>((std::min(to, i + 1.0) - std::max(from, static_cast<double>(i))) / (to - from));
    }
};

// `count` output pixels side by side over `length` input pixels.
std::vector<Cover> covers(int count, int length) {
    std::vector<Cover> result;
    for (int i = 0; i < count; ++i) {
        const double from = static_cast<double>(i) * length / count;
        const double to = static_cast<double>(i + 1) * length / count;
        result.push_back({static_cast<int>(from), std::min(length, static_cast<int>(std::ceil(to))), from, to});
    }
    return result;
}

// Adds `weight` times a row of the input, colours premultiplied, to the sums of a row of the output.
void add_row(std::span<const Rgba8> row, const std::vector<Cover>& columns, float weight, std::vector<RgbaF>& sums) {
    for (std::size_t x = 0; x < columns.size(); ++x) {
        const Cover& over = columns[x];
        RgbaF& sum = sums[x];
        for (int u = over.begin; u < over.end; ++u) {
            const Rgba8& p = row[static_cast<std::size_t>(u)];
            const float a = weight * over.weight(u) * static_cast<float>(p.a) / 255;
            sum.r += a * static_cast<float>(p.r);
            sum.g += a * static_cast<float>(p.g);
            sum.b += a * static_cast<float>(p.b);
            sum.a += a;
        }
    }
}

Rgba8 mean_colour(const RgbaF& sum) {
    const float inverse = sum.a > 0 ? 1 / sum.a : 0;
    const auto code = [](float v) { return static_cast<std::uint8_t>(std::min(255.0F, v + 0.5F)); };
    return {code(sum.r * inverse), code(sum.g * inverse), code(sum.b * inverse), code(sum.a * 255)};
}

}  // namespace

Image<Rgba8> reduced(ConstImageView<Rgba8> picture, int side_px) {
    const int longest = std::max(picture.width(), picture.height());
    if (longest <= side_px) {
        Image<Rgba8> copy(picture.width(), picture.height());
        for (int y = 0; y < picture.height(); ++y) std::copy_n(picture.row(y), picture.width(), copy.row(y));
        return copy;
    }
    const double scale = static_cast<double>(side_px) / longest;
    const int width = std::max(1, static_cast<int>(std::lround(picture.width() * scale)));
    const int height = std::max(1, static_cast<int>(std::lround(picture.height() * scale)));
    const std::vector<Cover> columns = covers(width, picture.width());
    const std::vector<Cover> rows = covers(height, picture.height());
    Image<Rgba8> result(width, height);
    std::vector<RgbaF> sums;  // of one row of the result: colours times alpha, and alpha
    for (int y = 0; y < height; ++y) {
        const Cover& over = rows[static_cast<std::size_t>(y)];
        sums.assign(static_cast<std::size_t>(width), {});
        for (int v = over.begin; v < over.end; ++v) add_row(picture.row_span(v), columns, over.weight(v), sums);
        std::transform(sums.begin(), sums.end(), result.row(y), mean_colour);
    }
    return result;
}

Rgba8 median_colour(std::span<const Rgba8> colours) {
    const auto median_of_channel = [&](std::uint8_t Rgba8::*channel) {
        std::vector<std::uint8_t> codes;
        for (const Rgba8& colour : colours) codes.push_back(colour.*channel);
        return median(std::move(codes));
    };
    return {median_of_channel(&Rgba8::r), median_of_channel(&Rgba8::g), median_of_channel(&Rgba8::b), 255};
}

Border border_of(ConstImageView<Rgba8> picture) {
    constexpr int kDark_code = 3;
    constexpr int kNear_codes = 10;
    constexpr double kNearShare = 0.85;  // of all ...
    constexpr double kFlatShare = 0.97;  // ... and of these
    std::vector<Rgba8> pixels;
    for (int y = 0; y < picture.height(); ++y) {
        const bool whole_row = y == 0 || y == picture.height() - 1;
        for (int x = 0; x < picture.width(); x += whole_row ? 1 : std::max(1, picture.width() - 1)) {
            pixels.push_back(picture(x, y));
        }
    }
    if (pixels.empty()) return {};
    Border border{median_colour(pixels)};
    std::int64_t near = 0, flat = 0, dark = 0, black = 0;
    for (const Rgba8& pixel : pixels) {
        const int brightest = std::max({pixel.r, pixel.g, pixel.b});
        dark += brightest <= kDark_code ? 1 : 0;
        black += brightest == 0 ? 1 : 0;
        near += within_codes(pixel, border.median, kNear_codes) ? 1 : 0;
        flat += within_codes(pixel, border.median, kFlat_codes) ? 1 : 0;
    }
    const bool flat_black = 2 * dark > std::ssize(pixels) && black == dark;
    const bool dark_median = std::max({border.median.r, border.median.g, border.median.b}) <= kDark_code;
    const bool flat_other = static_cast<double>(near) >= kNearShare * static_cast<double>(pixels.size()) &&
                            static_cast<double>(flat) >= kFlatShare * static_cast<double>(near);
    border.flat = dark_median ? flat_black : flat_other;
    return border;
}

Result<Survey> survey_photos(const PhotoFolder& folder, Progress* progress) {
    const std::size_t count = folder.photos.size();
    Survey survey;
    survey.thumbnails.resize(count);
    survey.samples.resize(sample_count(count));
    survey.borders.resize(survey.samples.size());
    std::vector<std::optional<std::size_t>> sample_of(count);
    for (std::size_t s = 0; s < survey.samples.size(); ++s) {
        survey.sample_photos.push_back(s * count / survey.samples.size());
        sample_of[survey.sample_photos.back()] = s;
    }
    const auto look_at = [&](std::size_t i) -> Status {
        const Result<Image<Rgba8>> picture = read_picture(folder.photos[i]);
        if (!picture) return picture.error();
        Image<Rgba8> sample = reduced(*picture, kSampleSide_px);
        survey.thumbnails[i] = reduced(sample, kThumbnailSide_px);
        if (sample_of[i]) {
            survey.samples[*sample_of[i]] = std::move(sample);
            survey.borders[*sample_of[i]] = border_of(*picture);
        }
        return {};
    };
    if (Status status = for_each_photo(folder, kReadBytesPerPixel, "looking at the pictures", progress, look_at);
        !status) {
        return status.error();
    }
    return survey;
}

}  // namespace rs::capture
