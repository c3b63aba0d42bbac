// The widest view that prepare_view accepts stays within 63-bit arithmetic (engine/RECONSTRUCTION.md, "Ranges").
#include "engine/core/definition/ray_setup.hpp"
#include "engine/core/definition/view_registers.hpp"
#include "tests/support/ring_object.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace rs::engine {
namespace {

// Camera of one pixel, whose ray has the horizontal length `length` and passes the axis at 45 degrees to one of four
// planes.
Camera wide_camera(double length) {
    const glm::dvec3 along = glm::normalize(glm::dvec3(1, 0, -1));
    const glm::dvec3 across = glm::normalize(glm::dvec3(1, 0, 1));
    const glm::dvec3 forward = along / length + std::sqrt(1 - 1 / (length * length)) * across;
    const glm::dvec3 right = glm::cross(forward, glm::dvec3(0, 1, 0));
    Camera camera;
    camera.width = camera.height = 1;
    camera.fl_x = camera.fl_y = 1;
    camera.cx = 0.5 - length * glm::dot(along, right);
    camera.cy = 0.5;
    camera.world_from_camera = {
        glm::dvec4(right, 0), {0, 1, 0, 0}, glm::dvec4(-forward, 0), glm::dvec4(-3.0 * along, 1)};
    return camera;
}

TEST(ViewBounds, TheWidestRayHasALengthOf63Bits) {
    const RaySpaceObject object = test::ring_object({.planes = 4});
    double accepted = 8, refused = 16;
    ASSERT_TRUE(prepare_view(object, wide_camera(accepted)).ok());
    ASSERT_FALSE(prepare_view(object, wide_camera(refused)).ok());
    for (int i = 0; i < 60; ++i) {
        const double middle = (accepted + refused) / 2;
        (prepare_view(object, wide_camera(middle)).ok() ? accepted : refused) = middle;
    }
    EXPECT_GT(accepted, 11.3);  // 8 along the normal and 8 along the tangent
    const Result<ViewRegisters> registers = prepare_view(object, wide_camera(accepted));
    ASSERT_TRUE(registers.ok());
    const PlanePoint point = plane_point(object.rings[0], *registers, 0, 0);
    ASSERT_TRUE(point.exists);
    const auto square =
        static_cast<__int128>(point.n_q28) * point.n_q28 + static_cast<__int128>(point.t_q28) * point.t_q28;
    // Rounding of the registers adds at most 512 to either component over 8192 pixels in both directions.
    const __int128 margin = 2 * static_cast<__int128>(1024) * (std::int64_t{1} << 31);
    EXPECT_LT(square + margin, std::numeric_limits<std::int64_t>::max());
}

}  // namespace
}  // namespace rs::engine
