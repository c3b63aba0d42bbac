#include "capture/photos/segmentation/segmenter_choice.hpp"

#include "rayspace/image_io/image_io.hpp"
#include "tests/capture/photos/turn_of_images.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace rs::capture {
namespace {

using testing::HasSubstr;

// A turn of a reddish disc, drawn over `background`.
class SegmenterChoice : public testing::Test {
protected:
    Result<Intake> intake(const Rgba8& background) {
        test::DrawnTurn turn;
        turn.backdrop = background;
        std::filesystem::create_directory(folder_ / "photos");
        std::filesystem::create_directory(folder_ / "masks");
        for (int i = 0; i < turn.views; ++i) {
            const test::DrawnView view = test::draw_view(turn, i);
            const std::string name = std::to_string(i + 1) + ".png";
            EXPECT_TRUE(write_png(folder_ / "photos" / name, view.photo).ok());
            Image<Rgba8> mask(turn.width, turn.height);
            for (int y = 0; y < turn.height; ++y) {
                for (int x = 0; x < turn.width; ++x) {
                    const std::uint8_t code = view.alpha(x, y) >= 0.5F ? 255 : 0;
                    mask(x, y) = {code, code, code, 255};
                }
            }
            EXPECT_TRUE(write_png(folder_ / "masks" / name, mask).ok());
        }
        Result<PhotoFolder> photos = open_photo_folder(folder_ / "photos");
        if (!photos) return photos.error();
        return run_intake(std::move(*photos), nullptr);
    }
    ChosenSegmenter chosen(const SegmenterRequest& request, const Rgba8& background = {255, 255, 255, 255}) {
        const Result<Intake> taken = intake(background);
        EXPECT_TRUE(taken.ok());
        Result<ChosenSegmenter> chosen = choose_segmenter(request, *taken, "photos", nullptr);
        EXPECT_TRUE(chosen.ok()) << chosen.error().message;
        return std::move(*chosen);
    }
    std::string error(const SegmenterRequest& request) {
        const Result<Intake> taken = intake({255, 255, 255, 255});
        const Result<ChosenSegmenter> chosen = choose_segmenter(request, *taken, "photos", nullptr);
        EXPECT_FALSE(chosen.ok());
        return chosen.ok() ? std::string() : chosen.error().message;
    }
    // Gives a high probability to what is more red than blue (make_tiny_models.py).
    static std::filesystem::path tiny_network() {
        return std::filesystem::path(RAYSPACE_SOURCE_DIR) / "tests/capture/photos/masks/models/plain.onnx";
    }
    // Share of the pixels of the first photo whose label differs from the truth.
    static double error_of(const Segmenter& segmenter, const Rgba8& background) {
        test::DrawnTurn turn;
        turn.backdrop = background;
        const test::DrawnView view = test::draw_view(turn, 0);
        const Result<Segmentation> found = segmenter.segment({0, view.photo.view()});
        EXPECT_TRUE(found.ok());
        int wrong = 0;
        for (int y = 0; y < turn.height; ++y) {
            for (int x = 0; x < turn.width; ++x) {
                wrong += (found->mask(x, y) >= 128) != (view.alpha(x, y) >= 0.5F) ? 1 : 0;
            }
        }
        return static_cast<double>(wrong) / (turn.width * turn.height);
    }

    test::TemporaryFolder folder_;
};

TEST_F(SegmenterChoice, TakesTheBackgroundModelWithoutAnythingElse) {
    const ChosenSegmenter found = chosen({});
    EXPECT_EQ(found.kind, SegmenterKind::kBackground);
    EXPECT_EQ(found.background, BackgroundKind::kWhite);
    EXPECT_EQ(found.background_share, 1);
    EXPECT_LT(error_of(*found.segmenter, {255, 255, 255, 255}), 0.01);
}

TEST_F(SegmenterChoice, TakesAConfiguredNetworkButNotBeforeBlack) {
    SegmenterRequest request;
    request.network = tiny_network();
    const ChosenSegmenter network = chosen(request);
    EXPECT_EQ(network.kind, SegmenterKind::kModel);
    EXPECT_THAT(network.reason, HasSubstr("plain.onnx"));
    EXPECT_LT(error_of(*network.segmenter, {255, 255, 255, 255}), 0.02);
    EXPECT_EQ(chosen(request, {0, 0, 0, 255}).kind, SegmenterKind::kBackground);
    request.kind = SegmenterKind::kModel;
    EXPECT_EQ(chosen(request, {0, 0, 0, 255}).kind, SegmenterKind::kModel) << "on request";
}

TEST_F(SegmenterChoice, TakesMasksFirst) {
    SegmenterRequest request;
    request.network = tiny_network();
    request.masks = folder_ / "masks";
    const ChosenSegmenter found = chosen(request);
    EXPECT_EQ(found.kind, SegmenterKind::kMasks);
    EXPECT_EQ(error_of(*found.segmenter, {255, 255, 255, 255}), 0);
}

TEST_F(SegmenterChoice, ChromaKeyNeedsNoBackgroundModel) {
    constexpr Rgba8 kGreen{30, 170, 60, 255};
    SegmenterRequest request;
    request.kind = SegmenterKind::kChromaKey;
    const ChosenSegmenter found = chosen(request, kGreen);
    EXPECT_EQ(found.kind, SegmenterKind::kChromaKey);
    EXPECT_LT(error_of(*found.segmenter, kGreen), 0.01);
}

TEST_F(SegmenterChoice, RefusesContradictions) {
    SegmenterRequest request;
    request.kind = SegmenterKind::kModel;
    EXPECT_THAT(error(request), HasSubstr("--segmentation-model"));
    request.kind = SegmenterKind::kMasks;
    EXPECT_THAT(error(request), HasSubstr("--masks"));
    request = {};
    request.masks_are_alpha = true;
    EXPECT_THAT(error(request), HasSubstr("--masks-alpha"));
    request = {};
    request.masks = folder_ / "masks";
    request.kind = SegmenterKind::kBackground;
    EXPECT_THAT(error(request), HasSubstr("--masks: has no effect"));
    request = {};
    request.masks = folder_ / "masks";
    request.shadow = ShadowHandling::kKeep;
    EXPECT_THAT(error(request), HasSubstr("--shadow keep"));
    request = {};
    request.kind = SegmenterKind::kAlpha;
    EXPECT_THAT(error(request), HasSubstr("no transparent pixels"));
}

}  // namespace
}  // namespace rs::capture
