#include "capture/photos/segmentation/network_segmenter.hpp"

#include "capture/opencv/connected_components.hpp"
#include "capture/opencv/opencv_image.hpp"
#include "capture/photos/intake/reduction.hpp"
#include "capture/photos/intake/survey.hpp"
#include "rayspace/api/types/check.hpp"

#include <opencv2/core/utility.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace rs::capture {
namespace {

constexpr int kHalfProbability = 128;

// Removes what is small beside the largest component: distant things that the network takes for objects.
void keep_large_components(Image<std::uint8_t>& mask, const FusionParameters& parameters) {
    const cv::Mat1b pixels(mask.height(), mask.width(), mask.data());
    const ConnectedComponents components(pixels, 8);
    int largest_px = 0;
    for (int label = 1; label < components.count(); ++label) largest_px = std::max(largest_px, components.area(label));
    components.for_each_pixel([&](int x, int y, int label) {
        if (components.area(label) < parameters.min_component * largest_px) mask(x, y) = 0;
    });
}

// Photos go through the network one after the other, each on all cores: two at a time would need twice its memory.
class OpenCvThreads {
public:
    explicit OpenCvThreads(int count) : before_(cv::getNumThreads()) { cv::setNumThreads(count); }
    ~OpenCvThreads() { cv::setNumThreads(before_); }
    OpenCvThreads(const OpenCvThreads&) = delete;
    OpenCvThreads& operator=(const OpenCvThreads&) = delete;

private:
    int before_;
};

}  // namespace

Result<NetworkMasks> NetworkMasks::compute(const SegmentationNetwork& network, const PhotoFolder& folder,
                                           const FusionParameters& parameters, Progress* progress) {
    const OpenCvThreads all_cores(cv::getNumberOfCPUs());
    std::vector<Image<std::uint8_t>> probabilities;
    if (progress != nullptr) progress->start("running the network", std::ssize(folder.photos));
    for (std::size_t i = 0; i < folder.photos.size(); ++i) {
        RS_ASSIGN_OR_RETURN(const Image<Rgba8> photo, read_photo(folder, i));
        RS_ASSIGN_OR_RETURN(const Image<float> found, network.foreground_probability(reduced(photo, kSampleSide_px)));
        Image<std::uint8_t>& codes = probabilities.emplace_back(found.width(), found.height());
        std::ranges::transform(found.pixels(), codes.pixels().begin(),
                               [](float p) { return static_cast<std::uint8_t>(std::lround(255 * p)); });
        if (progress != nullptr) progress->advance();
    }
    if (progress != nullptr) progress->finish();
    return NetworkMasks(std::move(probabilities), parameters);
}

Image<std::uint8_t> NetworkMasks::mask(std::size_t photo, int width, int height) const {
    const Image<std::uint8_t>& probability = probabilities_[photo];
    Image<std::uint8_t> mask(width, height);
    if (mask.empty()) return mask;
    cv::Mat1b resized(height, width, mask.data());
    cv::resize(mat_view(probability), resized, resized.size(), 0, 0, cv::INTER_LINEAR);
    for (std::uint8_t& code : mask.pixels()) code = code >= kHalfProbability ? 255 : 0;
    keep_large_components(mask, parameters_);
    return mask;
}

Image<std::uint8_t> static_foreground_hull(const NetworkMasks& masks, std::span<const std::size_t> photos,
                                           ConstImageView<std::uint8_t> always_visible,
                                           const FusionParameters& parameters) {
    const int width = always_visible.width(), height = always_visible.height();
    Image<int> kept(width, height);
    for (const std::size_t photo : photos) {
        const Image<std::uint8_t> mask = masks.mask(photo, width, height);
        std::ranges::transform(mask.pixels(), kept.pixels(), kept.pixels().begin(),
                               [](std::uint8_t m, int count) { return count + (m != 0 ? 1 : 0); });
    }
    std::vector<cv::Point> points;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            if (always_visible(x, y) != 0 && 2 * kept(x, y) > static_cast<int>(photos.size()))
                points.emplace_back(x, y);
        }
    }
    if (static_cast<double>(points.size()) < parameters.min_static_share * width * height) return {};
    std::vector<cv::Point> hull;
    cv::convexHull(points, hull);
    Image<std::uint8_t> region(width, height);
    cv::Mat1b pixels(height, width, region.data());
    cv::fillConvexPoly(pixels, hull, 255);
    return region;
}

Result<Segmentation> NetworkSegmenter::segment(const TurnPhoto& photo) const {
    return Segmentation{masks_.mask(photo.index, photo.image.width(), photo.image.height()), false};
}

FusedSegmenter::FusedSegmenter(NetworkMasks masks, std::shared_ptr<const BackgroundModelSegmenter> background,
                               Image<std::uint8_t> region)
    : masks_(std::move(masks)), background_(std::move(background)), region_(std::move(region)) {
    RS_CHECK(!region_.empty());
}

Result<Segmentation> FusedSegmenter::segment(const TurnPhoto& photo) const {
    const int width = photo.image.width(), height = photo.image.height();
    Image<std::uint8_t> mask = masks_.mask(photo.index, width, height);
    const Image<std::uint8_t> by_background = background_->mask_of(photo.image);
    for (int y = 0; y < height; ++y) {
        const int v = static_cast<int>(static_cast<std::int64_t>(y) * region_.height() / height);
        for (int x = 0; x < width; ++x) {
            const int u = static_cast<int>(static_cast<std::int64_t>(x) * region_.width() / width);
            if (region_(u, v) != 0) mask(x, y) = by_background(x, y);
        }
    }
    keep_large_components(mask, masks_.parameters());
    return Segmentation{std::move(mask), false};
}

double FusedSegmenter::background_share() const {
    const auto within = std::ranges::count_if(region_.pixels(), [](std::uint8_t pixel) { return pixel != 0; });
    return static_cast<double>(within) / static_cast<double>(region_.pixels().size());
}

}  // namespace rs::capture
