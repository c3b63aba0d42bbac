// The RS map against a brute-force search, and the integers of captured views against their cameras.

#include "encode/raymap/plane_map.hpp"
#include "encode/raymap/captured_view.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/geometry/ray_space.hpp"
#include "rayspace/geometry/rig.hpp"
#include "tests/support/plane_ray.hpp"
#include "tests/support/ring_object.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

namespace rs::encode {
namespace {

TEST(CapturedView, DescribesItsCamera) {
    std::mt19937_64 engine(7);
    const auto in = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine); };
    for (int n = 0; n < 200; ++n) {
        SCOPED_TRACE(n);
        const double angle = in(0, 2 * kPi), distance = in(1.5, 20), height = in(-1, 1);
        Camera camera = look_at_camera({distance * std::sin(angle), height, distance * std::cos(angle)},
                                       {in(-0.3, 0.3), height, in(-0.3, 0.3)}, radians(in(5, 60)), 640, 480);
        camera.cx += in(-30, 30);
        const int planes = 12;
        const CapturedView view = *captured_view(camera, planes);
        EXPECT_NEAR(view.height_q20 / 1048576.0, height, 1e-6);
        for (int k = 0; k < planes; ++k) {
            const double x = in(-1, 1), y = in(-1, 1);
            const glm::dvec3 point = x * reference_plane(k, planes).tangent + glm::dvec3(0, y, 0);
            const glm::dvec3 pixel = camera.project(point);
            if (pixel.z < 0.2) continue;
            const CapturedLine& line = view.lines[static_cast<std::size_t>(k)];
            const double l = line.l0_q20 / 1048576.0 + x * line.l1_q30 / 1073741824.0;
            EXPECT_NEAR(l, pixel.z, 1e-5);
            EXPECT_NEAR(view.cx_q16 / 65536.0 + (line.q0_q16 / 65536.0 + x * line.q1_q16 / 65536.0) / l, pixel.x, 2e-2);
            EXPECT_NEAR((view.cy_q16 - view.fl_y_q16 / l * (y - height)) / 65536.0, pixel.y, 2e-2);
        }
    }
}

TEST(CapturedView, RefusesWhatTheFormatCannotHold) {
    Camera camera = look_at_camera({0, 0, 80}, {0, 0, 0}, radians(4), 512, 512);
    EXPECT_TRUE(captured_view(camera, 12).ok());
    camera.fl_x = camera.fl_y = 10000;
    EXPECT_TRUE(captured_view(camera, 12).ok());
    // Three degrees past the axis, the axis is 41,900 px radii to the side: q0 would wrap around.
    Camera past = look_at_camera({0, 0, 80}, {80 * std::tan(radians(3)), 0, 0}, radians(4), 512, 512);
    past.fl_x = past.fl_y = 10000;
    EXPECT_NE(captured_view(past, 12).error().message.find("too far from the Y axis"), std::string::npos);
    camera.fl_y = 65536 + 700;
    EXPECT_NE(captured_view(camera, 12).error().message.find("focal length"), std::string::npos);
}

// The image whose ray through the cell's plane point deviates least in angle.
TEST(PlaneMap, HoldsTheNearestRayOfEveryCell) {
    const test::RingObjectOptions ring_options{.views = 17, .width = 64, .height = 48, .fl_px = 70};
    const Rig rig = test::ring_rig(ring_options);
    const PlaneMapOptions options{.planes = 5, .x_cells = 23, .u_cells = 31};
    const Ring ring = make_plane_map(rig, find_rings(rig).front(), options);
    const double x_half = ring.x_half_q20 / 1048576.0;
    const double u_half = ring.u_half_q28 / 268435456.0;
    EXPECT_GT(x_half, 1 / std::cos(kPi / options.planes));
    EXPECT_GT(u_half, std::tan(kPi / options.planes));
    int answered = 0;
    int exact = 0;
    for (int k = 0; k < options.planes; ++k) {
        const ReferencePlane plane = reference_plane(k, options.planes);
        for (int xi = 0; xi < options.x_cells; ++xi) {
            for (int ui = 0; ui < options.u_cells; ++ui) {
                const double x = -x_half + (xi + 0.5) * 2 * x_half / options.x_cells;
                const double u = -u_half + (ui + 0.5) * 2 * u_half / options.u_cells;
                double best = 1e9;
                for (const RigView& view : rig.views) {
                    const glm::dvec3 point = x * plane.tangent + glm::dvec3(0, view.camera.centre().y, 0);
                    const auto ray = test::to_ray_space({view.camera.centre(), point - view.camera.centre()}, plane);
                    const glm::dvec3 pixel = view.camera.project(point);
                    if (!ray || pixel.z <= 0 || pixel.x < 0 || pixel.x >= 64) continue;
                    best = std::min(best, std::abs(std::atan(ray->u) - std::atan(u)));
                }
                const std::uint16_t cell = ring.cells[ring.cell_index(k, xi, ui)];
                if (best > 1e8) {
                    EXPECT_EQ(cell, kNoImage);
                    continue;
                }
                ASSERT_NE(cell, kNoImage);
                const glm::dvec3 centre = rig.views[cell].camera.centre();
                const double angle = std::atan(viewpoint_line(centre, plane).u_at(x));
                // Near the border of two images the preferred one may be up to a quarter of their distance farther.
                const double off = std::abs(angle - std::atan(u));
                EXPECT_GE(off, best - 1e-9);
                EXPECT_LE(off, best * 5 / 3 + 1e-9);
                exact += off < best + 1e-9;
                ++answered;
            }
        }
    }
    EXPECT_GT(answered, 2000);
    EXPECT_GT(exact, answered * 8 / 10);
}

// Half-way between two captured viewpoints all columns come from one image.
TEST(PlaneMap, HalfWayViewpointsSeeOneImage) {
    const Rig rig = test::ring_rig({.views = 51});
    const Ring ring = make_plane_map(rig, find_rings(rig).front(), {.planes = 12, .x_cells = 512, .u_cells = 512});
    const double x_half = ring.x_half_q20 / 1048576.0;
    const double u_half = ring.u_half_q28 / 268435456.0;
    for (int i = 0; i < 51; ++i) {
        const double azimuth = 2 * kPi * (i + 0.5) / 51;
        const glm::dvec3 viewpoint(3.5 * std::sin(azimuth), 0, 3.5 * std::cos(azimuth));
        std::set<int> images;
        for (int column = -40; column <= 40; ++column) {
            const glm::dvec3 at = glm::dvec3(std::cos(azimuth), 0, -std::sin(azimuth)) * (column / 45.0);
            const test::Ray ray{viewpoint, at - viewpoint};
            const int k = test::most_perpendicular_plane(ray.direction, 12);
            const auto place = test::to_ray_space(ray, reference_plane(k, 12));
            ASSERT_TRUE(place);
            const int xi = static_cast<int>((place->x + x_half) * 512 / (2 * x_half));
            const int ui = static_cast<int>((place->u + u_half) * 512 / (2 * u_half));
            images.insert(ring.cells[ring.cell_index(k, xi, ui)]);
        }
        EXPECT_EQ(images.size(), 1U) << "between views " << i << " and " << i + 1;
    }
}

TEST(PlaneMap, CellsBetweenViewsTellsWhenTheMapIsTooCoarse) {
    const Rig rig = test::ring_rig({.views = 90});
    const ViewRing ring = find_rings(rig).front();
    EXPECT_LT(cells_between_views(rig, ring, {.planes = 4, .x_cells = 64, .u_cells = 32}), 2);
    EXPECT_GT(cells_between_views(rig, ring, {.planes = 12, .x_cells = 512, .u_cells = 512}), 20);
    const Rig one = test::ring_rig({.views = 1});
    EXPECT_EQ(cells_between_views(one, find_rings(one).front(), {}), 0);
}

TEST(Rings, ViewsOfOneElevationAreOneRingInTurningOrder) {
    Rig rig = make_ring({.count = 8, .elevation_rad = radians(2), .fl_px = 100});
    const Rig above = make_ring({.count = 5, .elevation_rad = radians(30), .fl_px = 100, .first_rad = 1});
    rig.views.insert(rig.views.end(), above.views.begin(), above.views.end());
    std::swap(rig.views[1], rig.views[6]);
    const std::vector<ViewRing> rings = find_rings(rig);
    ASSERT_EQ(rings.size(), 2U);
    EXPECT_EQ(rings[0].views, (std::vector<int>{0, 6, 2, 3, 4, 5, 1, 7}));
    EXPECT_EQ(rings[1].views, (std::vector<int>{8, 9, 10, 11, 12}));
    EXPECT_NEAR(degrees(rings[0].elevation_rad), 2, 1e-6);
    EXPECT_NEAR(degrees(rings[1].elevation_rad), 30, 1e-6);
}

}  // namespace
}  // namespace rs::encode
