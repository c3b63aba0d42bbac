// Tests of the blend of two captured images, and of a surface composited over a farther one or over that of the
// farthest cell (engine/RECONSTRUCTION.md, section 8).
#include "rayspace/object/ray_space_object.hpp"
#include "tests/engine/core/definition/shape_pixels.hpp"
#include "tests/support/sphere_object.hpp"

#include <gtest/gtest.h>

#include <set>
#include <tuple>

namespace rs::engine {
namespace {

using test::pixel_at;
using test::RingObjectOptions;
using test::Texel;

// View midway between views 0 and 1; all cells are equal.
class Midway : public testing::Test {
protected:
    Midway() : object_(test::ring_object(options_)) {
        object_.rings[0].shape = test::empty_shape(test::ring_rig(options_), object_.rings[0], 2, 16, 16);
    }
    [[nodiscard]] ShapePixel shown(ShapeCell cell, const Texel& texel) {
        std::fill(object_.rings[0].shape.cells.begin(), object_.rings[0].shape.cells.end(), cell);
        return pixel_at(object_, camera_, kPixel, kPixel, texel);
    }
    static Rgba8 by_view(int view) {
        const auto grey = static_cast<std::uint8_t>(view == 0 ? 100 : 200);
        return {grey, grey, grey, 255};
    }

    static constexpr int kPixel = 62;
    RingObjectOptions options_{.views = 18, .width = 128, .height = 128, .fl_px = 200};
    Camera camera_ = test::between_views(options_, 0, 0.5);
    RaySpaceObject object_;
    Texel plain_ = [](int view, int, int) { return by_view(view); };
};

TEST_F(Midway, BlendsBothImagesWithHalfWeightEach) {
    EXPECT_EQ(shown({128, ShapeCell::kByBoth}, plain_).colour, (Rgba8{150, 150, 150, 255}));
    for (const int eighth : {1, 2, 6, 7}) {
        camera_ = test::between_views(options_, 0, eighth / 8.0);
        EXPECT_NEAR(shown({128, ShapeCell::kByBoth}, plain_).colour.r, 100 + 100 * eighth / 8.0, 1);
    }
    EXPECT_EQ(shown({}, plain_).colour, Rgba8{});
}

TEST_F(Midway, AnImageThatDoesNotShowTheSurfaceHasNoWeight) {
    EXPECT_EQ(shown({128, ShapeCell::kByFirst}, plain_).colour, by_view(0));
    EXPECT_EQ(shown({128, ShapeCell::kBySecond}, plain_).colour, by_view(1));
    EXPECT_EQ(leaning_weight(100, 8), 100);
    EXPECT_EQ(leaning_weight(100, 4), 50);
    EXPECT_EQ(leaning_weight(100, 0), 0);
    EXPECT_EQ(leaning_weight(100, 12), 178);
    EXPECT_EQ(leaning_weight(100, 16), 256);
    EXPECT_EQ(leaning_weight(101, 7), 88);  // 88.375
}

// Colour is weighted by alpha.
TEST_F(Midway, BlendsPremultipliedColour) {
    const Texel translucent = [](int view, int, int) {
        Rgba8 grey = by_view(view);
        if (view == 1) grey.a = 85;
        return grey;
    };
    EXPECT_EQ(shown({128, ShapeCell::kByBoth}, translucent).colour, (Rgba8{125, 125, 125, 170}));
}

TEST_F(Midway, ATransparentSampleInEitherImageHidesTheSurface) {
    for (const int clear_view : {0, 1}) {
        const Texel texel = [=](int view, int, int) { return view == clear_view ? Rgba8{} : by_view(view); };
        EXPECT_EQ(shown({128, ShapeCell::kByBoth}, texel).colour, Rgba8{});
    }
}

// A sample outside of an image is neither transparent nor visible: only the other image is used.
TEST_F(Midway, ASurfaceOutsideOfOneFrameIsShownByTheOther) {
    for (const int lost : {0, 1}) {
        object_.views[static_cast<std::size_t>(lost)].cx_q16 = 1 << 29;
        EXPECT_EQ(shown({128, ShapeCell::kByBoth}, plain_).colour, by_view(1 - lost));
        object_.views[static_cast<std::size_t>(lost)].cx_q16 = object_.views[2].cx_q16;
    }
}

TEST_F(Midway, ItsDepthIsThatOfTheSurface) {
    const double apart = std::ldexp(shown({170, 3}, plain_).lambda_q20 - shown({90, 3}, plain_).lambda_q20, -20);
    EXPECT_NEAR(apart, 80 * 2 * (1 + 1.0 / 32) / 255, 0.01);
}

// Cells along p alternate between two surfaces; at the pixel the nearer one has more weight.
class AtAStep : public Midway {
protected:
    AtAStep() : near_(recorded(kNearer, of_nearer_)), far_(recorded(kFarther, of_farther_)) {
        for (const std::size_t nearer : {std::size_t{0}, std::size_t{1}}) {
            const ShapeMap& shape = object_.rings[0].shape;
            for (std::size_t n = 0; n < shape.cells.size(); ++n) {
                const std::size_t column = n / static_cast<std::size_t>(shape.bands);
                object_.rings[0].shape.cells[n] = column % 2 == nearer ? kNearer : kFarther;
            }
            if (pixel_at(object_, camera_, kPixel, kPixel, plain_).lambda_q20 == near_) break;
        }
    }
    // Pixel if the surfaces have these alphas.
    [[nodiscard]] ShapePixel pixel(int nearer_alpha, int farther_alpha) {
        return pixel_at(object_, camera_, kPixel, kPixel, [=, this](int view, int column, int row) {
            const bool is_nearer = of_nearer_.contains({view, column, row});
            EXPECT_NE(is_nearer, of_farther_.contains({view, column, row}));
            return is_nearer ? Rgba8{50, 50, 50, static_cast<std::uint8_t>(nearer_alpha)}
                             : Rgba8{80, 80, 80, static_cast<std::uint8_t>(farther_alpha)};
        });
    }

private:
    static constexpr ShapeCell kNearer{90, 3}, kFarther{170, 3};
    using Texels = std::set<std::tuple<int, int, int>>;  // view, column, row

    std::int32_t recorded(ShapeCell cell, Texels& texels) {
        const Texel recording = [&](int view, int column, int row) {
            texels.emplace(view, column, row);
            return by_view(view);
        };
        return shown(cell, recording).lambda_q20;
    }

    Texels of_nearer_, of_farther_;

protected:
    std::int32_t near_, far_;  // axial depths of both surfaces
};

TEST_F(AtAStep, ASurfaceThatDoesNotCoverItsPixelIsCompositedOverOneThatDoes) {
    const auto expect = [&](int nearer_alpha, int farther_alpha, int grey, int alpha, std::int32_t lambda_q20) {
        SCOPED_TRACE(std::to_string(nearer_alpha) + " before " + std::to_string(farther_alpha));
        const ShapePixel shown = pixel(nearer_alpha, farther_alpha);
        const auto level = static_cast<std::uint8_t>(grey);
        EXPECT_EQ(shown.colour, (Rgba8{level, level, level, static_cast<std::uint8_t>(alpha)}));
        EXPECT_EQ(shown.lambda_q20, lambda_q20);
    };
    EXPECT_LT(near_, far_);
    expect(255, 255, 50, 255, near_);
    expect(230, 255, 50, 230, near_);
    expect(229, 255, 53, 255, near_);
    expect(229, 230, 53, 252, near_);
    expect(229, 229, 50, 229, near_);
    expect(128, 255, 65, 255, near_);
    expect(127, 255, 65, 255, far_);
    expect(100, 0, 50, 100, near_);
    expect(0, 100, 80, 100, far_);
}

// Cells along p differ by less than a jump, and the surface is interpolated between them.
TEST_F(Midway, AnInterpolatedSurfaceIsCompositedOverTheFarthestCell) {
    constexpr ShapeCell kNearer{60, 3}, kFarthest{160, 3};
    object_.rings[0].shape.jump = 100;
    std::set<std::tuple<int, int, int>> of_farthest;
    const std::int32_t farthest = shown(kFarthest, [&](int view, int column, int row) {
                                      of_farthest.emplace(view, column, row);
                                      return by_view(view);
                                  }).lambda_q20;
    std::vector<ShapeCell>& cells = object_.rings[0].shape.cells;
    const auto bands = static_cast<std::size_t>(object_.rings[0].shape.bands);
    for (std::size_t n = 0; n < cells.size(); ++n) cells[n] = n / bands % 2 == 0 ? kNearer : kFarthest;
    const auto pixel = [&](int mean_alpha, int farthest_alpha) {
        return pixel_at(object_, camera_, kPixel, kPixel, [&](int view, int column, int row) {
            return of_farthest.contains({view, column, row})
                       ? Rgba8{80, 80, 80, static_cast<std::uint8_t>(farthest_alpha)}
                       : Rgba8{50, 50, 50, static_cast<std::uint8_t>(mean_alpha)};
        });
    };
    EXPECT_LT(pixel(255, 255).lambda_q20, farthest);
    EXPECT_EQ(pixel(230, 255).colour, (Rgba8{50, 50, 50, 230}));
    EXPECT_EQ(pixel(229, 255).colour, (Rgba8{53, 53, 53, 255}));
    EXPECT_EQ(pixel(229, 229).colour, (Rgba8{50, 50, 50, 229}));
    EXPECT_EQ(pixel(0, 255).colour, (Rgba8{80, 80, 80, 255}));
    EXPECT_EQ(pixel(0, 255).lambda_q20, farthest);
    EXPECT_EQ(pixel(0, 100).colour, (Rgba8{80, 80, 80, 100}));
    // If a surrounding cell has no surface, the ray may pass beside the object.
    for (ShapeCell& cell : cells) {
        if (cell == kFarthest) cell = {};
    }
    EXPECT_EQ(pixel(0, 255).colour, Rgba8{});
}

TEST_F(Midway, AGapWithoutLinesShowsTheNearestImage) {
    ShapeMap& shape = object_.rings[0].shape;
    for (ShapeGap& gap : shape.gaps) gap = {};
    shape.cells.clear();
    for (const double fraction : {0.2, 0.8}) {
        camera_ = test::between_views(options_, 0, fraction);
        const Rgba8 nearest = by_view(fraction < 0.5 ? 0 : 1);
        int rays = 0;
        for (int i = 0; i < 128; i += 3) {
            const ShapePixel pixel = pixel_at(object_, camera_, i, 64, plain_);
            if (pixel.colour.a == 0) continue;
            EXPECT_EQ(pixel.colour, nearest) << i;
            ++rays;
        }
        EXPECT_GT(rays, 30);
        const glm::dvec3 ray = camera_.ray(64.5, 64.5), eye = camera_.centre();
        const double to_foot = -(eye.x * ray.x + eye.z * ray.z) / (ray.x * ray.x + ray.z * ray.z);
        EXPECT_NEAR(std::ldexp(pixel_at(object_, camera_, 64, 64, plain_).lambda_q20, -20), to_foot, 1e-4);
    }
}

}  // namespace
}  // namespace rs::engine
