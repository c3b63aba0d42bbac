// Figure of the RS map: place and colour of every cell.

#include "encode/report/ray_map_image.hpp"

#include "rayspace/base/conventions.hpp"
#include "tests/support/small_object.hpp"

#include <gtest/gtest.h>

#include <set>
#include <tuple>

namespace rs::encode {
namespace {

// Two planes of 3 x 2 cells, photos 4 and 5 in turning order.
Ring two_planes() {
    Ring ring;
    ring.planes = 2;
    ring.x_cells = 3;
    ring.u_cells = 2;
    ring.views = {4, 5};
    ring.cells.assign(12, kNoImage);
    return ring;
}

TEST(RayMapImage, CellsAreAtXAcrossAndUDown) {
    Ring ring = two_planes();
    ring.cells[ring.cell_index(0, 2, 1)] = 4;  // upper half of the first plane
    ring.cells[ring.cell_index(1, 0, 0)] = 5;  // lower half of the second
    const Result<Image<Rgba8>> image = ray_map_image(ring);
    ASSERT_TRUE(image.ok()) << image.error().message;
    const int side = 512 / 3;
    ASSERT_EQ(image->width(), 3 * side);
    ASSERT_EQ(image->height(), 4 * side);
    EXPECT_EQ((*image)(3 * side - 1, 0), ray_map_colour(0, 2));
    EXPECT_EQ((*image)(2 * side, side - 1), ray_map_colour(0, 2));
    EXPECT_EQ((*image)(0, 4 * side - 1), ray_map_colour(1, 2));
    int opaque = 0;
    for (const Rgba8& pixel : image->pixels()) opaque += pixel.a == 255;
    EXPECT_EQ(opaque, 2 * side * side);
    const Result<Image<Rgba8>> second = ray_map_image(ring, 1);
    ASSERT_TRUE(second.ok());
    EXPECT_EQ(second->height(), 2 * side);
    EXPECT_EQ((*second)(0, side), ray_map_colour(1, 2));
    EXPECT_EQ((*second)(side, side).a, 0);
}

TEST(RayMapImage, PhotosHaveColoursOfTheirOwn) {
    EXPECT_EQ(ray_map_colour(0, 8), (Rgba8{255, 0, 0, 255}));
    EXPECT_EQ(ray_map_colour(4, 12), (Rgba8{0, 255, 0, 255}));
    std::set<std::tuple<int, int, int>> colours;
    for (std::size_t n = 0; n < 120; ++n) {
        const Rgba8 colour = ray_map_colour(n, 120);
        colours.insert({colour.r, colour.g, colour.b});
    }
    EXPECT_EQ(colours.size(), 120U);
}

// From top to bottom the azimuth of the rays increases, also from plane to plane, so along x = 0 the photos follow each
// other in turning order.
TEST(RayMapImage, AlongUThePhotosFollowInTurningOrder) {
    const RaySpaceObject object =
        test::small_object({.views_per_ring = 16, .planes = 4, .x_cells = 512, .u_cells = 32});
    const Ring& ring = object.rings.front();
    const Result<Image<Rgba8>> image = ray_map_image(ring);
    ASSERT_TRUE(image.ok());
    ASSERT_EQ(image->height(), 4 * 32);
    int steps = 0;
    for (int row = 1; row < image->height(); ++row) {
        const auto place_of = [&](int at) {
            for (std::size_t n = 0; n < 16; ++n) {
                if ((*image)(256, at) == ray_map_colour(n, 16)) return static_cast<int>(n);
            }
            return -100;
        };
        const int step = (place_of(row) - place_of(row - 1) + 16) % 16;
        steps += step != 0;
        // Planes overlap a little at their borders.
        EXPECT_TRUE(step == 0 || step == 1 || (row % 32 == 0 && step == 15)) << row << ": " << step;
    }
    EXPECT_GE(steps, 15);
}

TEST(RayMapImage, OfALargeMapEveryNthCellIsDrawn) {
    Ring ring = two_planes();
    ring.u_cells = kMaxImageSide_px;
    ring.cells.assign(std::size_t{2 * 3} * kMaxImageSide_px, 4);
    const Result<Image<Rgba8>> image = ray_map_image(ring);
    ASSERT_TRUE(image.ok());
    EXPECT_EQ(image->height(), kMaxImageSide_px);
    EXPECT_EQ(image->width(), 2);
    EXPECT_EQ((*image)(1, kMaxImageSide_px - 1), ray_map_colour(0, 2));
}

TEST(RayMapImage, APlaneThatTheRingLacksIsRefused) {
    const Result<Image<Rgba8>> image = ray_map_image(two_planes(), 2);
    ASSERT_FALSE(image.ok());
    EXPECT_NE(image.error().message.find("planes 0 to 1"), std::string::npos) << image.error().message;
    EXPECT_FALSE(ray_map_image(two_planes(), -1).ok());
}

}  // namespace
}  // namespace rs::encode
