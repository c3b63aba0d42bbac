#include "compositor/viewer/drawing/image_coverage.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <utility>

namespace rs::compositor {
namespace {

// Discs and a bar, some soft, some touching the border, on an empty image.
Image<Rgba8> shapes(int width, int height, std::mt19937& random) {
    Image<Rgba8> image(width, height);
    std::uniform_int_distribution<int> x_of(0, width - 1);
    std::uniform_int_distribution<int> y_of(0, height - 1);
    for (int n = 0; n < 3; ++n) {
        const int cx = x_of(random);
        const int cy = y_of(random);
        const double radius = 4.0 + 12 * n;
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                const double inside = radius - std::hypot(x - cx, y - cy);
                if (inside > 0) image(x, y).a = static_cast<std::uint8_t>(n == 0 || inside >= 2 ? 255 : 100);
            }
        }
    }
    return image;
}

TEST(ShownParts, HoldAllThatShowsSomethingAndOpaqueOnesNothingElse) {
    std::mt19937 random(7);
    for (const int margin : {0, 1, 5}) {
        for (const int width : {1, 15, 64, 131}) {
            const int height = width == 64 ? 16 : 75;
            const Image<Rgba8> image = shapes(width, height, random);
            const auto alpha = [&](int x, int y) {
                return x < 0 || y < 0 || x >= width || y >= height ? 0 : static_cast<int>(image(x, y).a);
            };
            int next_row = -margin;
            std::int64_t opaque = 0;
            for (const CoverageBand& band : coverage_bands(image, margin)) {
                ASSERT_EQ(band.top, next_row);
                next_row = band.bottom;
                for (int y = band.top; y < band.bottom; ++y) {
                    for (int x = -margin; x < width + margin; ++x) {
                        int largest = 0;
                        int least = 255;
                        for (int dy = -margin; dy <= margin; ++dy) {
                            for (int dx = -margin; dx <= margin; ++dx) {
                                largest = std::max(largest, alpha(x + dx, y + dy));
                                least = std::min(least, alpha(x + dx, y + dy));
                            }
                        }
                        int runs = 0;
                        for (const CoverageRun& run : band.runs) {
                            if (x < run.begin || x >= run.end) continue;
                            ++runs;
                            if (run.opaque) {
                                ASSERT_EQ(least, 255) << x << ", " << y;
                            }
                            opaque += run.opaque ? 1 : 0;
                        }
                        ASSERT_EQ(runs == 1, runs != 0) << x << ", " << y << " is in two runs";
                        if (largest > 0) {
                            ASSERT_EQ(runs, 1) << x << ", " << y << " is missing";
                        }
                    }
                }
            }
            ASSERT_EQ(next_row, height + margin);
            if (width > 100) {
                EXPECT_GT(opaque, 100);
            }
        }
    }
}

TEST(ShownParts, AnEmptyImageHasNone) {
    for (const CoverageBand& band : coverage_bands(Image<Rgba8>(40, 40), 3)) EXPECT_TRUE(band.runs.empty());
    EXPECT_TRUE(coverage_mesh(coverage_bands(Image<Rgba8>(40, 40), 3), glm::dmat3(1)).corners.empty());
}

// Positive on one side of the line from a to b, negative on the other.
double side_of_line(const glm::vec3& a, const glm::vec3& b, const glm::vec3& p) {
    return static_cast<double>(b.x - a.x) * (p.y - a.y) - static_cast<double>(b.y - a.y) * (p.x - a.x);
}

TEST(ShownParts, TrianglesCoverEveryPointOfTheRunsOnce) {
    std::mt19937 random(11);
    const Image<Rgba8> image = shapes(131, 75, random);
    const std::vector<CoverageBand> bands = coverage_bands(image, 2);
    const CoverageMesh mesh = coverage_mesh(bands, glm::dmat3(1));
    for (const glm::vec3& corner : mesh.corners) ASSERT_EQ(corner.z, 1);
    for (const CoverageBand& band : bands) {
        for (int y = band.top; y < band.bottom; ++y) {
            for (int x = -2; x < 133; ++x) {
                const glm::vec3 p(static_cast<float>(x) + 0.37F, static_cast<float>(y) + 0.53F, 1);
                int expected = 0;  // 1: blended, 100: opaque
                for (const CoverageRun& run : band.runs) {
                    if (x >= run.begin && x < run.end) expected += run.opaque ? 100 : 1;
                }
                int covered = 0;
                for (const auto& [indices, weight] : {std::pair(&mesh.opaque, 100), {&mesh.blended, 1}}) {
                    for (std::size_t i = 0; i < indices->size(); i += 3) {
                        const glm::vec3& a = mesh.corners[(*indices)[i]];
                        const glm::vec3& b = mesh.corners[(*indices)[i + 1]];
                        const glm::vec3& c = mesh.corners[(*indices)[i + 2]];
                        const double ab = side_of_line(a, b, p);
                        const double bc = side_of_line(b, c, p);
                        const double ca = side_of_line(c, a, p);
                        covered += (ab < 0 && bc < 0 && ca < 0) || (ab > 0 && bc > 0 && ca > 0) ? weight : 0;
                    }
                }
                ASSERT_EQ(covered, expected) << x << ", " << y;
            }
        }
    }
}

}  // namespace
}  // namespace rs::compositor
