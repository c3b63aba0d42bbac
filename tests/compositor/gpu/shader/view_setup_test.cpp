// Photos that the set-ups of a view refer to.

#include "compositor/gpu/shader/view_setup.hpp"

#include "engine/core/definition/reconstruct.hpp"
#include "engine/core/definition/view_registers.hpp"
#include "tests/support/random_ring_object.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace rs::compositor {
namespace {

using test::Pose;
using test::Random;

// Transparent photos in place of all those that a view does not need.
RaySpaceObject only(const std::vector<int>& photos, RaySpaceObject object) {
    for (std::size_t view = 0; view < object.images.size(); ++view) {
        if (!std::binary_search(photos.begin(), photos.end(), static_cast<int>(view))) {
            for (std::uint8_t& alpha : object.images[view].a.pixels()) alpha = 0;
        }
    }
    return object;
}

TEST(ViewSetup, ViewsNeedNoOtherPhotos) {
    std::size_t needed = 0;
    std::size_t all = 0;
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        const test::RingObjectOptions options = test::random_options(random);
        RaySpaceObject object = test::random_object(random, options);
        if (seed % 4 == 3) object.rings[0].shape = {};
        const Camera camera = test::shape_camera(random, options, seed % 2 == 0 ? Pose::upright : Pose::tilted);
        const auto registers = engine::prepare_view(object, camera);
        if (!registers) continue;
        const std::vector<ColumnBounds> bounds = column_bounds(object.rings[0].shape);
        const int rows = registers->upright() ? 1 : registers->height;
        const std::vector<SetupTexel> setups = set_up_rows(object, *registers, bounds, 0, rows);
        const std::vector<int> photos = photos_of(setups, registers->width);
        for (const int photo : photos) ASSERT_LT(static_cast<std::size_t>(photo), object.views.size());
        Image<Rgba8> whole(camera.width, camera.height);
        Image<Rgba8> reduced(camera.width, camera.height);
        engine::reconstruct_scalar(object, *registers, whole);
        engine::reconstruct_scalar(only(photos, object), *registers, reduced);
        ASSERT_EQ(whole, reduced);
        needed += photos.size();
        all += object.views.size();
    }
    EXPECT_GT(needed, 100U);
    EXPECT_LT(needed, all);
}

}  // namespace
}  // namespace rs::compositor
