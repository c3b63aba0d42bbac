#include "capture/photos/background/background_model.hpp"

#include "capture/photos/background/background_estimate.hpp"
#include "tests/capture/photos/turn_of_images.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <tuple>

namespace rs::capture {
namespace {

Survey survey_of(std::vector<Image<Rgba8>> samples) {
    Survey survey;
    survey.samples = std::move(samples);
    return survey;
}

Survey drawn_before(Rgba8 colour) {
    test::DrawnTurn turn;
    turn.backdrop = colour;
    return survey_of(test::draw_photos(turn));
}

int distance(const Rgba8& a, const Rgba8& b) {
    return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
}

TEST(BackgroundModel, ParsesTheDocumentedValues) {
    EXPECT_FALSE(parse_background("auto")->kind.has_value());
    EXPECT_EQ(parse_background("white")->kind, BackgroundKind::kWhite);
    EXPECT_EQ(parse_background("black")->kind, BackgroundKind::kBlack);
    EXPECT_EQ(parse_background("alpha")->kind, BackgroundKind::kAlpha);
    EXPECT_EQ(parse_background("0,128,255")->colour, (Rgba8{0, 128, 255, 255}));
    for (const char* wrong : {"", "grey", "1,2", "1,2,3,4", "1,2,256", "-1,2,3", "1,2,3 ", "1,,3"}) {
        EXPECT_FALSE(parse_background(wrong).ok()) << wrong;
    }
}

TEST(BackgroundModel, DetectsEachKind) {
    EXPECT_EQ(estimate_background(drawn_before({250, 251, 249, 255}), {}, "x")->kind, BackgroundKind::kWhite);
    EXPECT_EQ(estimate_background(drawn_before({12, 12, 14, 255}), {}, "x")->kind, BackgroundKind::kBlack);
    const Rgba8 blue{60, 70, 180, 255};
    const Result<BackgroundModel> found = estimate_background(drawn_before(blue), {}, "x");
    ASSERT_TRUE(found.ok()) << found.error().message;
    EXPECT_EQ(found->kind, BackgroundKind::kColour);
    EXPECT_LE(distance(found->colour, blue), 2);
}

// Most of the border is dark; in the second case a bright part of it is static.
TEST(BackgroundModel, DarkRoomIsNotBlack) {
    for (const auto& [columns, kind] :
         {std::pair{0.02, BackgroundKind::kBlack}, std::pair{0.35, BackgroundKind::kColour}}) {
        test::DrawnTurn turn;
        turn.backdrop = {12, 12, 14, 255};
        std::vector<Image<Rgba8>> photos = test::draw_photos(turn);
        for (Image<Rgba8>& photo : photos) {
            for (int y = 0; y < photo.height() / 6; ++y) {
                for (int x = 0; x < columns * photo.width(); ++x) photo(x, y) = {150, 180, 230, 255};
            }
        }
        EXPECT_EQ(estimate_background(survey_of(photos), {}, "x")->kind, kind);
        photos.resize(3);  // too few to identify static pixels
        EXPECT_EQ(estimate_background(survey_of(photos), {}, "x")->kind, BackgroundKind::kBlack);
    }
}

// No value is the same in most frames, so nothing along the border is static. White is normalised to its median
// exposure; black has too few codes for that.
TEST(BackgroundModel, WhiteAndBlackNeedNoStaticBorder) {
    for (const auto& [codes, kind, colour] :
         {std::tuple{std::array{225, 240, 255}, BackgroundKind::kWhite, Rgba8{240, 240, 240, 255}},
          std::tuple{std::array{0, 16, 36}, BackgroundKind::kBlack, Rgba8{0, 0, 0, 255}}}) {
        std::vector<Image<Rgba8>> photos;
        for (int i = 0; i < 6; ++i) {
            test::DrawnTurn turn;
            const auto code = static_cast<std::uint8_t>(codes[static_cast<std::size_t>(i % 3)]);
            turn.backdrop = {code, code, code, 255};
            photos.push_back(test::draw_view(turn, 2 * i).photo);
        }
        const Result<BackgroundModel> found = estimate_background(survey_of(photos), {}, "x");
        ASSERT_TRUE(found.ok()) << found.error().message;
        EXPECT_EQ(found->kind, kind);
        EXPECT_EQ(found->colour, colour);
        EXPECT_FALSE(found->plate.empty());
    }
}

TEST(BackgroundModel, FailsWithoutAStaticBorder) {
    std::vector<Image<Rgba8>> photos;
    for (int i = 0; i < 6; ++i) {  // a moving crowd
        Image<Rgba8> photo = test::draw_view({}, 2 * i).photo;
        Image<std::uint8_t> blocks(photo.width() / 8 + 1, photo.height() / 8 + 1);
        std::mt19937 random(3);
        for (std::uint8_t& code : blocks.pixels())
            code = static_cast<std::uint8_t>(40 + 34 * ((random() + static_cast<unsigned>(i)) % 6));
        for (int y = 0; y < photo.height(); ++y) {
            for (int x = 0; x < photo.width(); ++x) {
                const std::uint8_t code = blocks(x / 8, y / 8);
                if (photo(x, y) == test::DrawnTurn{}.backdrop) photo(x, y) = {code, code, code, 255};
            }
        }
        photos.push_back(std::move(photo));
    }
    for (const BackgroundRequest& request :
         {BackgroundRequest{}, BackgroundRequest{BackgroundKind::kColour, std::nullopt}}) {
        const Result<BackgroundModel> found = estimate_background(survey_of(photos), request, "folder");
        ASSERT_FALSE(found.ok());
        EXPECT_THAT(found.error().message, testing::HasSubstr("folder"));
    }
}

TEST(BackgroundModel, PrefersTheAlphaOfThePhotos) {
    std::vector<Image<Rgba8>> photos = test::draw_photos({});
    for (Image<Rgba8>& photo : photos) {
        for (int x = 0; x < 40; ++x) photo(x, 0).a = 0;
    }
    EXPECT_NE(estimate_background(survey_of(photos), {}, "x")->kind, BackgroundKind::kAlpha)
        << "40 transparent pixels are not enough";
    for (Image<Rgba8>& photo : photos) {
        for (int y = 0; y < 30; ++y) {
            for (int x = 0; x < 40; ++x) photo(x, y).a = 0;
        }
    }
    EXPECT_EQ(estimate_background(survey_of(photos), {}, "x")->kind, BackgroundKind::kAlpha);
}

TEST(BackgroundModel, FailsOnRequestedAlphaWithoutAlpha) {
    const Result<BackgroundModel> found =
        estimate_background(drawn_before({255, 255, 255, 255}), {BackgroundKind::kAlpha, std::nullopt}, "folder");
    ASSERT_FALSE(found.ok());
    EXPECT_THAT(found.error().message, testing::HasSubstr("folder"));
}

TEST(BackgroundModel, PlateIsInpaintedWhereAlwaysCovered) {
    test::DrawnTurn turn;
    turn.backdrop = {60, 70, 180, 255};
    turn.orbit_px = 6;  // the axis' column is covered in every view
    const Result<BackgroundModel> found = estimate_background(survey_of(test::draw_photos(turn)), {}, "x");
    ASSERT_TRUE(found.ok());
    for (int y = 0; y < turn.height; ++y) {
        for (int x = 0; x < turn.width; ++x) ASSERT_LE(distance(found->plate(x, y), turn.backdrop), 6) << x << "," << y;
    }
}

TEST(FillPushPull, FillsGapsAndKeepsKnownPixels) {
    Image<Rgba8> image(37, 23, Rgba8{100, 120, 140, 255});
    Image<std::uint8_t> known(37, 23, 1);
    for (int y = 5; y < 18; ++y) {
        for (int x = 8; x < 30; ++x) {
            image(x, y) = {255, 0, 0, 255};
            known(x, y) = 0;
        }
    }
    image(0, 0) = {7, 8, 9, 255};
    fill_push_pull(image, known);
    EXPECT_EQ(image(0, 0), (Rgba8{7, 8, 9, 255}));
    for (int y = 5; y < 18; ++y) {
        for (int x = 8; x < 30; ++x) ASSERT_LE(distance(image(x, y), {100, 120, 140, 255}), 3);
    }
}

}  // namespace
}  // namespace rs::capture
