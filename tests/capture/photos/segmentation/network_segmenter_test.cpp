#include "capture/photos/segmentation/network_segmenter.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace rs::capture {
namespace {

constexpr int kFused_width = 120, kFused_height = 90;
constexpr int kFused_photos = 8;
constexpr Rgba8 kFused_wall{90, 140, 100, 255}, kFused_disc{150, 150, 160, 255}, kFused_object{200, 40, 30, 255};

bool is_disc(int x, int y) {
    return y >= 66 && y < 84 && x >= 20 && x < 100;
}

// A block on the disc that moves from photo to photo.
bool is_object(int photo, int x, int y) {
    const int left = 45 + 3 * photo;
    return x >= left && x < left + 12 && y >= 30 && y < 75;
}

Image<Rgba8> fused_photo(int photo) {
    Image<Rgba8> image(kFused_width, kFused_height);
    for (int y = 0; y < kFused_height; ++y) {
        for (int x = 0; x < kFused_width; ++x) {
            image(x, y) = is_object(photo, x, y) ? kFused_object : is_disc(x, y) ? kFused_disc : kFused_wall;
        }
    }
    return image;
}

// A network that finds the object but keeps the disc, and a speck.
NetworkMasks network_masks() {
    std::vector<Image<std::uint8_t>> probabilities;
    for (int i = 0; i < kFused_photos; ++i) {
        Image<std::uint8_t>& p = probabilities.emplace_back(kFused_width, kFused_height);
        for (int y = 0; y < kFused_height; ++y) {
            for (int x = 0; x < kFused_width; ++x) p(x, y) = is_object(i, x, y) || is_disc(x, y) ? 240 : 10;
        }
        p(2, 2) = 255;
    }
    return NetworkMasks(std::move(probabilities));
}

std::vector<std::size_t> all_photos() {
    std::vector<std::size_t> photos(kFused_photos);
    std::iota(photos.begin(), photos.end(), std::size_t{0});
    return photos;
}

BackgroundModel fused_background() {
    Survey survey;
    for (int i = 0; i < kFused_photos; ++i) {
        survey.samples.push_back(fused_photo(i));
        survey.borders.push_back(measure_border(survey.samples.back()));
    }
    return *estimate_background(survey, {}, "drawn");
}

double share_of_disc(const Image<std::uint8_t>& mask, int photo) {
    int kept = 0, disc = 0;
    for (int y = 0; y < kFused_height; ++y) {
        for (int x = 0; x < kFused_width; ++x) {
            if (!is_disc(x, y) || is_object(photo, x, y)) continue;
            ++disc;
            kept += mask(x, y) != 0 ? 1 : 0;
        }
    }
    return static_cast<double>(kept) / disc;
}

TEST(NetworkMasks, DropSpecksAndScale) {
    const Image<std::uint8_t> mask = network_masks().mask(0, 2 * kFused_width, 2 * kFused_height);
    EXPECT_EQ(mask(4, 4), 0);
    EXPECT_EQ(mask(100, 80), 255);
    EXPECT_EQ(mask(10, 100), 0);
}

TEST(StaticForegroundHull, IsTheDiscAndNotTheMovingObject) {
    const BackgroundModel model = fused_background();
    const Image<std::uint8_t> region = static_foreground_hull(network_masks(), all_photos(), model.always_visible);
    ASSERT_FALSE(region.empty());
    EXPECT_EQ(region(25, 75), 255) << "the disc";
    EXPECT_EQ(region(60, 75), 255) << "the disc's middle, which the object passes";
    EXPECT_EQ(region(60, 40), 0) << "the object above the disc";
    EXPECT_EQ(region(5, 20), 0) << "the wall";
}

TEST(StaticForegroundHull, IsEmptyWhereNothingStaticIsKept) {
    std::vector<Image<std::uint8_t>> nothing(kFused_photos, Image<std::uint8_t>(kFused_width, kFused_height));
    EXPECT_TRUE(
        static_foreground_hull(NetworkMasks(std::move(nothing)), all_photos(), fused_background().always_visible)
            .empty());
}

TEST(FusedSegmenter, RemovesTheDiscThatTheNetworkKeeps) {
    const BackgroundModel model = fused_background();
    const Image<Rgba8> photo = fused_photo(3);
    const NetworkSegmenter alone(network_masks());
    const Image<std::uint8_t> by_network = alone.segment({3, photo.view()})->mask;
    EXPECT_GT(share_of_disc(by_network, 3), 0.99);

    const FusedSegmenter fused(network_masks(),
                               std::make_shared<BackgroundModelSegmenter>(model, kFused_width, kFused_height),
                               static_foreground_hull(network_masks(), all_photos(), model.always_visible));
    EXPECT_NEAR(fused.background_share(), 80.0 * 18 / (kFused_width * kFused_height), 0.03);
    const Result<Segmentation> found = fused.segment({3, photo.view()});
    ASSERT_TRUE(found.ok());
    EXPECT_FALSE(found->is_alpha);
    EXPECT_LT(share_of_disc(found->mask, 3), 0.02);
    int missing = 0;
    for (int y = 31; y < 74; ++y) {
        for (int x = 0; x < kFused_width; ++x) missing += is_object(3, x, y) && found->mask(x, y) == 0 ? 1 : 0;
    }
    EXPECT_LE(missing, 12);
}

}  // namespace
}  // namespace rs::capture
