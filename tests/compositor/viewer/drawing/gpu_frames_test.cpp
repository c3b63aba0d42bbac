// Frames whose objects are rendered on the GPU, in the context of the frame, equal those of the software core.

#include "compositor/gpu/gpu_executor.hpp"
#include "compositor/gpu/shader/texture_layout.hpp"
#include "tests/compositor/viewer/drawing/compositing.hpp"

#include <memory>
#include <utility>
#include <vector>

namespace rs::compositor {
namespace {

// A drum that the executor `gpu` loads.
std::shared_ptr<const ViewableObject> drum_for_gpu() {
    RaySpaceObject object = test::drum_object();
    auto for_board = std::make_shared<const RaySpaceObject>(object);
    Result<ViewableObject> viewable = make_viewable(std::move(object));
    RS_CHECK(viewable.ok());
    viewable->for_board = std::move(for_board);
    return std::make_shared<const ViewableObject>(std::move(*viewable));
}

class GpuFrames : public Compositing {
protected:
    // A compositor of the objects that the executor `gpu` renders.
    static Result<FrameCompositor> on_gpu(const Scene& scene, const std::vector<PlacedObject>& objects,
                                          const FrameOptions& options, const GpuExecutorOptions& gpu) {
        RS_ASSIGN_OR_RETURN(std::unique_ptr<engine::Executor> executor, create_gpu_executor(gpu));
        const auto engine = std::make_shared<engine::RenderSession>(viewer_session_limits(), std::move(executor));
        RS_ASSIGN_OR_RETURN(const std::shared_ptr<const DisplayedNodes> nodes, load_all_nodes(objects, *engine));
        std::vector<engine::ObjectHandle> handles;
        for (const DisplayedNode& node : *nodes) handles.push_back(node.handle);
        engine->load_on_board(handles);
        return FrameCompositor::create(scene, engine, nodes, options);
    }

    void expect_equal(const Scene& scene, const std::vector<PlacedObject>& objects, const FrameOptions& options,
                      const Camera& camera, const GpuExecutorOptions& gpu = {}) {
        Result<FrameCompositor> core = FrameCompositor::create(scene, objects, options);
        Result<FrameCompositor> other = on_gpu(scene, objects, options, gpu);
        ASSERT_TRUE(core.ok() && other.ok());
        const Result<Image<Rgba8>> expected = core->compose(camera);
        const Result<Image<Rgba8>> frame = other->compose(camera);
        ASSERT_TRUE(expected.ok() && frame.ok());
        EXPECT_EQ(other->statistics().nodes_by_board, static_cast<int>(objects.size()));
        EXPECT_EQ(*frame, *expected);
        EXPECT_NE(*frame, *FrameCompositor::create(scene, std::vector<PlacedObject>(), options)->compose(camera));
        const Result<Image<Rgba8>> again = other->compose(camera);  // its textures exist already
        ASSERT_TRUE(again.ok());
        EXPECT_EQ(*again, *expected);
        EXPECT_EQ(other->object_at(kFrameWidth / 2, kFrameHeight / 2),
                  core->object_at(kFrameWidth / 2, kFrameHeight / 2));
    }
};

TEST_F(GpuFrames, EqualThoseOfTheCore) {
    const auto drum = drum_for_gpu();
    // Two drums that intersect each other and a box, and a mirrored one.
    const std::vector<PlacedObject> objects = {test::placed_at(drum), test::placed_at(drum, {{0.9, 0.2, 0.3}}),
                                               test::placed_at(drum, {.translation = {-1.6, 0, -1}, .mirrored = true})};
    const Scene scene = with_box({0.8, 3, 0.8}, {-0.6, 0, 0.6});
    const Camera above = look_at_camera({1, 2.5, 6}, {0, 0, 0}, radians(50), kFrameWidth, kFrameHeight);
    for (const ObjectDepth depth : {ObjectDepth::kPlane, ObjectDepth::kPixel}) {
        for (const int samples : {1, 4}) {
            for (const bool upright : {false, true}) {
                SCOPED_TRACE(static_cast<int>(depth) * 100 + samples * 10 + (upright ? 1 : 0));
                const FrameOptions options{.width = kFrameWidth,
                                           .height = kFrameHeight,
                                           .samples = samples,
                                           .shadows = samples == 4,
                                           .object_depth = depth,
                                           .upright_images = upright};
                expect_equal(scene, objects, options, kFront);
                expect_equal(scene, objects, options, above);
            }
        }
    }
}

TEST_F(GpuFrames, EqualThoseOfTheCoreInLittleMemory) {
    const auto drum = drum_for_gpu();
    const std::vector<PlacedObject> objects = {test::placed_at(drum), test::placed_at(drum, {{1.2, 0.2, 0.3}})};
    const RaySpaceObject object = test::drum_object();
    const FrameOptions options{.width = kFrameWidth, .height = kFrameHeight};
    expect_equal({}, objects, options, kFront, {.memory_bytes = 2 * gpu_bytes(object, 3)});
}

}  // namespace
}  // namespace rs::compositor
