#include "capture/photos/survey.hpp"

#include "capture/photos/opencv_image.hpp"
#include "rayspace/picture_io.hpp"

#include <tbb/parallel_for.h>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace rs::capture {
namespace {

std::size_t sample_count(std::size_t photos) {
    return std::min<std::size_t>(photos, kMaxSamples);
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
    cv::Mat4f premultiplied(picture.height(), picture.width());
    for (int y = 0; y < picture.height(); ++y) {
        const Rgba8* from = picture.row(y);
        for (int x = 0; x < picture.width(); ++x) {
            const float a = static_cast<float>(from[x].a) / 255;
            premultiplied(y, x) = {static_cast<float>(from[x].r) * a, static_cast<float>(from[x].g) * a,
                                   static_cast<float>(from[x].b) * a, a};
        }
    }
    cv::Mat4f small;
    cv::resize(premultiplied, small, {width, height}, 0, 0, cv::INTER_AREA);
    Image<Rgba8> result(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const cv::Vec4f& p = small(y, x);
            const float inverse = p[3] > 0 ? 1 / p[3] : 0;
            const auto code = [&](float v) { return static_cast<std::uint8_t>(std::min(255.0F, v * inverse + 0.5F)); };
            result(x, y) = {code(p[0]), code(p[1]), code(p[2]), static_cast<std::uint8_t>(p[3] * 255 + 0.5F)};
        }
    }
    return result;
}

Result<Survey> survey_photos(const PhotoFolder& folder, Progress* progress) {
    const std::size_t count = folder.photos.size();
    Survey survey;
    survey.thumbnails.resize(count);
    survey.samples.resize(sample_count(count));
    std::vector<std::optional<std::size_t>> sample_of(count);
    for (std::size_t s = 0; s < survey.samples.size(); ++s) {
        survey.sample_photos.push_back(s * count / survey.samples.size());
        sample_of[survey.sample_photos.back()] = s;
    }
    std::vector<Status> statuses(count);
    if (progress != nullptr) progress->start("looking at the pictures", static_cast<std::int64_t>(count));
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
        const Result<Image<Rgba8>> picture = read_picture(folder.photos[i]);
        if (!picture) {
            statuses[i] = picture.error();
            return;
        }
        Image<Rgba8> sample = reduced(*picture, kSampleSide_px);
        survey.thumbnails[i] = reduced(sample, kThumbnailSide_px);
        if (sample_of[i]) survey.samples[*sample_of[i]] = std::move(sample);
        if (progress != nullptr) progress->advance();
    });
    if (progress != nullptr) progress->finish();
    for (const Status& status : statuses) {
        if (!status) return status.error();
    }
    return survey;
}

}  // namespace rs::capture
