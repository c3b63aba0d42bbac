// Limits of the published board, on both sides of each limit.

#include "engine/model/layout/object_image.hpp"
#include "tests/support/ring_object.hpp"

#include <gtest/gtest.h>

namespace rs::engine::model {
namespace {

const ObjectLayout& published() {
    return layout_of(BoardKind::raw_images);
}

// An object with the given sizes; the board checks sizes, not pixels.
RaySpaceObject shaped(std::size_t views, int side, int planes, int map_side) {
    RaySpaceObject object;
    object.name = "shaped";
    object.width = object.height = side;
    object.views.resize(views);
    Ring ring;
    ring.planes = planes;
    ring.x_cells = ring.u_cells = map_side;
    ring.views.resize(views);
    ring.cells.resize(static_cast<std::size_t>(planes) * static_cast<std::size_t>(map_side) *
                      static_cast<std::size_t>(map_side));
    object.rings.push_back(std::move(ring));
    return object;
}

TEST(BoardLimits, TheLargestPublishedObjectFits) {
    EXPECT_TRUE(published().fits(shaped(120, 512, 12, 256), {}).ok());
}

TEST(BoardLimits, OneMoreOfAnythingDoesNot) {
    const auto refused = [](const RaySpaceObject& object, const char* what) {
        const Status status = published().fits(object, {});
        return !status.ok() && status.error().message.find(what) != std::string::npos;
    };
    EXPECT_TRUE(refused(shaped(121, 512, 12, 256), "images: 121"));
    EXPECT_TRUE(refused(shaped(120, 513, 12, 256), "side: 513"));
    EXPECT_TRUE(refused(shaped(120, 512, 13, 256), "planes: 13"));
    EXPECT_TRUE(refused(shaped(1, 8, 3, 1025), "side: 1025"));
    RaySpaceObject two_rings = shaped(8, 64, 4, 16);
    two_rings.rings.push_back(two_rings.rings.front());
    EXPECT_TRUE(refused(two_rings, "rings"));
}

TEST(BoardLimits, FootprintIsThatOfThePublishedFormat) {
    const BoardFootprint footprint = published().footprint(shaped(120, 512, 12, 1024));
    EXPECT_EQ(footprint.luma_bytes, 120U * 512 * 512);
    EXPECT_EQ(footprint.chroma_bytes, 120U * 512 * 512 / 2);
    EXPECT_EQ(footprint.alpha_bytes, 120U * 512 * 512 / 4);
    EXPECT_EQ(footprint.map_bytes, 12U * 1024 * 1024);
}

TEST(BoardLimits, MemoryIsFilledToTheLastByteAndNotBeyond) {
    const std::vector<RaySpaceObject> objects(3, shaped(90, 256, 12, 128));
    BoardLimits limits;
    limits.memory_bytes = image_buffer_bytes(limits) + 3 * published().footprint(objects[0]).total_bytes();
    EXPECT_TRUE(published().fit_together(objects, limits).ok());
    --limits.memory_bytes;
    EXPECT_FALSE(published().fit_together(objects, limits).ok());
    limits.memory_bytes = std::uint64_t{1} << 40;
    EXPECT_TRUE(published().fit_together(std::vector<RaySpaceObject>(20, shaped(2, 8, 3, 4)), limits).ok());
    EXPECT_FALSE(published().fit_together(std::vector<RaySpaceObject>(21, shaped(2, 8, 3, 4)), limits).ok());
}

}  // namespace
}  // namespace rs::engine::model
