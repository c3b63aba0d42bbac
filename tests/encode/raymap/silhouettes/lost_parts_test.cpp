// Selects and paints large parts that masks lack.

#include "encode/raymap/silhouettes/lost_parts.hpp"

#include "tests/encode/raymap/drawn_views.hpp"
#include "tests/encode/raymap/striped_ball.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace rs::encode {
namespace {

// A square object with a notch at its right side, and the missing part.
class LostPart : public testing::Test {
protected:
    static constexpr int kSide = 64;
    static constexpr int kFrom = 12, kTo = 52;                 // the object
    static constexpr int kLeft = 30, kTop = 20, kBottom = 44;  // the notch, up to the object's right end

    LostPart() : missing_(kSide, kSide, kNoDepth) {
        Camera camera = drawn_ring(8).views[0].camera;
        camera.width = camera.height = kSide;
        view_ = make_work_view(camera, Image<Rgba8>(kSide, kSide), 1);
        for_each([&](int column, int row) {
            const bool object = column >= kFrom && column < kTo && row >= kFrom && row < kTo;
            view_.columns(row, column) = {90, 90, 90,
                                          static_cast<std::uint8_t>(object && !bitten(column, row) ? 255 : 0)};
        });
    }

    static bool bitten(int column, int row) { return column >= kLeft && column < kTo && row >= kTop && row < kBottom; }
    static void for_each(const std::function<void(int, int)>& each) {
        for (int column = 0; column < kSide; ++column) {
            for (int row = 0; row < kSide; ++row) each(column, row);
        }
    }
    void miss(const std::function<bool(int, int)>& is_missing, float depth = 0.25F) {
        for_each([&](int column, int row) {
            if (is_missing(column, row)) missing_(row, column) = depth;
        });
    }
    static int count_of(const Image<float>& part) {
        return static_cast<int>(std::ranges::count_if(part.pixels(), [](float depth) { return !std::isnan(depth); }));
    }

    WorkView view_;
    Image<float> missing_;
};

TEST_F(LostPart, IsFoundWithItsGapsAndThoseBesideTheObject) {
    // No pixels next to the object, a slit, and a hole.
    miss([](int c, int r) {
        return c >= kLeft + 2 && c < kTo && r >= kTop + 2 && r < kBottom - 2 && c != 40 &&
               !(c > 43 && c < 46 && r == 30);
    });
    const Image<float> part = select_lost_part(view_, missing_);
    for_each([&](int c, int r) {
        const bool inside = c >= kLeft && c < kTo - 2 && r >= kTop && r < kBottom;
        if (inside) {
            EXPECT_EQ(part(r, c), 0.25F) << c << ", " << r;
        } else if (!bitten(c, r)) {
            EXPECT_TRUE(std::isnan(part(r, c))) << c << ", " << r;
        }
    });
}

TEST_F(LostPart, HasSmoothDepths) {
    miss(bitten);
    missing_(30, 40) = 0.9F;
    missing_(33, 45) = -0.9F;
    const Image<float> part = select_lost_part(view_, missing_);
    EXPECT_EQ(part(30, 40), 0.25F);
    EXPECT_EQ(part(33, 45), 0.25F);
}

TEST_F(LostPart, IsNothingWhereFewPointsAreMissing) {
    miss([](int c, int r) { return bitten(c, r) && c % 2 == 0 && r % 2 == 0; });
    EXPECT_EQ(count_of(select_lost_part(view_, missing_)), 0);
}

TEST_F(LostPart, IsNoStripAlongARim) {
    miss([](int c, int r) { return c >= kFrom && c < kTo && r >= kFrom - 5 && r < kFrom; });
    EXPECT_EQ(count_of(select_lost_part(view_, missing_)), 0);
}

TEST_F(LostPart, DoesNotFloat) {
    const auto square = [](int left) {
        return [left](int c, int r) { return c >= left && c < left + 14 && r >= kTop + 4 && r < kTop + 18; };
    };
    miss(square(kTo - 14));
    EXPECT_EQ(count_of(select_lost_part(view_, missing_)), 0);  // the object is at none of its sides
    missing_ = Image<float>(kSide, kSide, kNoDepth);
    miss([](int c, int r) { return c < kFrom && r >= 20 && r < 40; });
    EXPECT_EQ(count_of(select_lost_part(view_, missing_)), 0);  // the object is at one of its sides
}

// A ring about a ball, with images twice as large as the views; one lacks its middle.
class LostPartPainting : public testing::Test {
protected:
    static constexpr int kBitten = 3;
    static constexpr int kLeft = 48, kRight = 80, kTop = 40, kBottom = 72;

    LostPartPainting() {
        for (const RigView& each : drawn_ring(24).views) {
            images_.push_back(striped_ball(each.camera));
            DepthView view{make_work_view(each.camera, images_.back(), 2), {}};
            view.depth = Image<float>(view.view.height, view.view.width, kNoDepth);
            for (int column = 0; column < view.view.width; ++column) {
                for (int row = 0; row < view.view.height; ++row) {
                    if (view.view.at(column, row).a < 255) continue;
                    view.depth(row, column) = static_cast<float>(ball_depth(view.view, column, row));
                }
            }
            ring_.push_back(std::move(view));
        }
        whole_ = images_[kBitten];
        part_ = Image<float>(whole_.height() / 2, whole_.width() / 2, kNoDepth);
        for (int x = kLeft; x < kRight; ++x) {
            for (int y = kTop; y < kBottom; ++y) {
                images_[kBitten](x, y) = {};
                ring_[kBitten].view.columns(y / 2, x / 2) = {};
                part_(y / 2, x / 2) = ring_[kBitten].depth(y / 2, x / 2);
            }
        }
    }

    [[nodiscard]] LostPartPainter painter() const {
        return LostPartPainter(ring_[kBitten].view, part_, 2, images_[kBitten]);
    }
    [[nodiscard]] LostPartPainter::Painter from(int n) const {
        return {&ring_[static_cast<std::size_t>(n)], &images_[static_cast<std::size_t>(n)]};
    }

    std::vector<Image<Rgba8>> images_;
    std::vector<DepthView> ring_;
    Image<Rgba8> whole_;
    Image<float> part_;
};

TEST_F(LostPartPainting, ShowsWhatAImageBesideShows) {
    LostPartPainter brush = painter();
    EXPECT_FALSE(brush.done());
    EXPECT_EQ(brush.shown_by(from(kBitten + 1)), 32U * 32U);
    brush.paint_from(from(kBitten + 1));
    EXPECT_TRUE(brush.done());
    const Image<Rgba8> painted = std::move(brush).image();
    double squares = 0;
    for (int y = 0; y < whole_.height(); ++y) {
        for (int x = 0; x < whole_.width(); ++x) {
            const Rgba8 &truth = whole_(x, y), &found = painted(x, y);
            ASSERT_EQ(truth.a, found.a) << x << ", " << y;
            const bool bitten = x >= kLeft && x < kRight && y >= kTop && y < kBottom;
            ASSERT_TRUE(bitten || truth == found) << x << ", " << y;
            squares += (truth.r - found.r) * (truth.r - found.r);
        }
    }
    EXPECT_LT(std::sqrt(squares / (32 * 32)), 6);  // stripes of 200 codes, 15 degrees away
}

TEST_F(LostPartPainting, LeavesWhatAImageDoesNotShow) {
    LostPartPainter brush = painter();
    brush.paint_from(from(kBitten + 12));  // from behind
    EXPECT_EQ(std::move(brush).image(), images_[kBitten]);
}

TEST_F(LostPartPainting, DoesNotTakeWhatStandsBeforeIt) {
    for (float& depth : ring_[kBitten + 1].depth.pixels()) depth -= 0.2F;
    LostPartPainter brush = painter();
    EXPECT_EQ(brush.shown_by(from(kBitten + 1)), 0U);
    EXPECT_EQ(brush.shown_by(from(kBitten + 1), true), 32U * 32U);
    brush.paint_from(from(kBitten + 1));
    EXPECT_EQ(brush.shown_by(from(kBitten - 1)), 32U * 32U);
}

TEST_F(LostPartPainting, TakesAllOfAImageThatShowsMost) {
    DepthView& other = ring_[kBitten + 1];
    for (int row = 0; row < other.view.height; row += 5) {
        for (int column = 0; column < other.view.width; ++column) other.depth(row, column) -= 0.2F;
    }
    LostPartPainter brush = painter();
    EXPECT_LT(brush.shown_by(from(kBitten + 1)), 32U * 32U);
    brush.paint_from(from(kBitten + 1));
    EXPECT_TRUE(brush.done());
}

TEST_F(LostPartPainting, KeepsAImagesOwnSoftEdge) {
    Rgba8& soft = images_[kBitten](kLeft + 4, kTop + 4);
    soft = {10, 20, 30, 51};  // alpha of one fifth
    LostPartPainter brush = painter();
    brush.paint_from(from(kBitten + 1));
    const Rgba8 found = std::move(brush).image()(kLeft + 4, kTop + 4);
    EXPECT_EQ(found.a, 255);
    EXPECT_NEAR(found.b, 0.2 * 30 + 0.8 * 128, 1);
}

}  // namespace
}  // namespace rs::encode
