// Visibility of a surface: a wall with a plate in front of it, seen by two cameras.

#include "encode/raymap/visibility.hpp"

#include "tests/encode/raymap/drawn_views.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <vector>

namespace rs::encode {
namespace {

constexpr double kWallZ = -0.2;
constexpr double kPlateZ = 0.3;
constexpr double kPlateHalfWidth = 0.12;
constexpr double kPlateHalfHeight = 0.3;

// Intersection of a pixel's ray with the plane of this z: its depth, and x and y there.
struct PlaneHit {
    double depth = 0, x = 0, y = 0;
};

PlaneHit meet_plane(const WorkView& view, int column, int row, double z) {
    const HorizontalRay ray = view.ray_of(column + 0.5);
    const double depth = (z - ray.foot.y) / ray.along.y;
    return {depth, ray.place_at(depth).x, view.height_of(row + 0.5, ray.axial_at(depth))};
}

bool is_on_plate(double x, double y) {
    return std::abs(x) < kPlateHalfWidth && std::abs(y) < kPlateHalfHeight;
}

enum class Paint { kTextured, kPlain };

// A camera at this azimuth, with the true depths of the wall and the plate.
DepthView draw(double azimuth_deg, Paint paint) {
    const Camera camera = drawn_ring(1, azimuth_deg).views[0].camera;
    DepthView made{make_work_view(camera, Image<Rgba8>(camera.width, camera.height), 1), {}};
    made.depth = Image<float>(made.view.height, made.view.width, kNoDepth);
    for (int column = 0; column < made.view.width; ++column) {
        for (int row = 0; row < made.view.height; ++row) {
            PlaneHit hit = meet_plane(made.view, column, row, kPlateZ);
            if (!is_on_plate(hit.x, hit.y)) hit = meet_plane(made.view, column, row, kWallZ);
            made.depth(row, column) = static_cast<float>(hit.depth);
            const double wave = std::sin(90 * hit.x) * std::sin(80 * hit.y);
            const auto code = static_cast<std::uint8_t>(paint == Paint::kPlain ? 128 : std::lround(128 + 90 * wave));
            made.view.columns(row, column) = {code, code, code, 255};
        }
    }
    return made;
}

// The photos and the line halfway between them.
class Visibility : public testing::Test {
protected:
    void draw_both(Paint paint) {
        first_ = draw(-10, paint);
        second_ = draw(10, paint);
    }

    void find_both() {
        const std::array<const DepthView*, 1> beside_first = {&second_};
        const std::array<const DepthView*, 1> beside_second = {&first_};
        Image<std::uint8_t> of_first = find_occluders(first_, measure_texture(first_.view), beside_first);
        second_.occluders = find_occluders(second_, measure_texture(second_.view), beside_second);
        first_.occluders = std::move(of_first);
    }

    // Classifies the wall's cells. Calls check(cell, place, height) for each.
    void classify_wall(const std::function<void(const ShapeCell&, const glm::dvec2&, double)>& check) const {
        LineGrid grid;
        grid.p_cells = grid.bands = 100;
        grid.p_low = grid.h_low = -1;
        grid.cells_per_unit = grid.bands_per_unit = 50;
        grid.distance = 3.5;
        const ViewPair photos{first_, second_, 0.5 * (first_.view.centre + second_.view.centre)};
        for (int p = 25; p < 75; ++p) {
            const CellRay ray(grid, photos.viewpoint, p);
            const auto depth =
                nearest_depth(127, [&](int d) { return std::abs(ray.place(d).y - kWallZ) < 0.6 * kDepthStep; });
            ASSERT_TRUE(depth.has_value());
            std::vector<ShapeCell> cells(static_cast<std::size_t>(grid.bands),
                                         ShapeCell{.depth = *depth, .shown = ShapeCell::kByBoth});
            classify_visibility(grid, photos, p, cells.data());
            for (int h = 25; h < 75; ++h) {
                check(cells[static_cast<std::size_t>(h)], ray.place(*depth), ray.height(h, *depth));
            }
        }
    }

    // The distance inside of the plate's contour (below 0: outside) at which the segment from a photo to a point
    // crosses the plate.
    static double margin_in(const DepthView& photo, const glm::dvec2& place, double y) {
        const double part = (kPlateZ - place.y) / (photo.view.centre.y - place.y);
        const double x = place.x + part * (photo.view.centre.x - place.x);
        const double height = y + part * (photo.view.centre_y - y);
        return std::min(kPlateHalfWidth - std::abs(x), kPlateHalfHeight - std::abs(height));
    }

    [[nodiscard]] int count_shown_by_one() const {
        int count = 0;
        classify_wall([&](const ShapeCell& cell, const glm::dvec2&, double) {
            count += cell.shown != ShapeCell::kByBoth ? 1 : 0;
        });
        return count;
    }

    DepthView first_, second_;
};

TEST_F(Visibility, ATexturedOccluderIsFound) {
    draw_both(Paint::kTextured);
    find_both();
    constexpr double kMargin = 0.05;  // about 3 pixels
    int occluded = 0;
    classify_wall([&](const ShapeCell& cell, const glm::dvec2& place, double y) {
        const double in_first = margin_in(first_, place, y);
        const double in_second = margin_in(second_, place, y);
        if (std::abs(in_first) < kMargin || std::abs(in_second) < kMargin) return;
        int expected = ShapeCell::kByBoth;
        if (in_first > 0 && in_second < 0) expected = ShapeCell::kBySecond;
        if (in_first < 0 && in_second > 0) expected = ShapeCell::kByFirst;
        EXPECT_EQ(int{cell.shown}, expected) << place.x << ", " << y;
        occluded += expected != ShapeCell::kByBoth ? 1 : 0;
    });
    EXPECT_GT(occluded, 100);
}

TEST_F(Visibility, APlainSurfaceDoesNotOcclude) {
    draw_both(Paint::kPlain);
    find_both();
    EXPECT_EQ(count_shown_by_one(), 0);
    for (DepthView* const photo : {&first_, &second_}) {
        photo->occluders = Image<std::uint8_t>(photo->depth.width(), photo->depth.height(), 1);
    }
    EXPECT_GT(count_shown_by_one(), 100) << "although its depths say so";
}

TEST_F(Visibility, ADepthThatNoPhotoConfirmsDoesNotOcclude) {
    draw_both(Paint::kTextured);
    // The first photo's plate is 0.15 radii in front of the second one's.
    for (int column = 0; column < first_.view.width; ++column) {
        for (int row = 0; row < first_.view.height; ++row) {
            const PlaneHit hit = meet_plane(first_.view, column, row, kPlateZ);
            if (is_on_plate(hit.x, hit.y)) first_.depth(row, column) -= 0.15F;
        }
    }
    find_both();
    EXPECT_EQ(count_shown_by_one(), 0);
    // A third photo, on the other side of the first, confirms it.
    DepthView third = first_;
    const std::array<const DepthView*, 2> neighbors = {&second_, &third};
    first_.occluders = find_occluders(first_, measure_texture(first_.view), neighbors);
    EXPECT_GT(count_shown_by_one(), 100);
}

TEST(Texture, IsTheDeviationOfLumaWithinTheSilhouette) {
    const Camera camera = drawn_ring(1).views[0].camera;
    WorkView view = make_work_view(camera, Image<Rgba8>(camera.width, camera.height), 1);
    for (int column = 20; column < 100; ++column) {
        for (int row = 20; row < 100; ++row) {
            const auto code = static_cast<std::uint8_t>(column < 60 ? 100 : 100 + 20 * ((column + row) % 2));
            view.columns(row, column) = {code, code, code, 255};
        }
    }
    const Image<std::uint8_t> texture = measure_texture(view);
    EXPECT_EQ(texture(50, 40), 0);
    EXPECT_EQ(texture(20, 20), 0) << "the background does not count";
    EXPECT_NEAR(texture(50, 80), 10, 1);
    EXPECT_NEAR(texture(50, 99), 10, 1);
    EXPECT_EQ(texture(50, 105), 0);
}

}  // namespace
}  // namespace rs::encode
