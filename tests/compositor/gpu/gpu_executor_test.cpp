// The executor `gpu`: conformance vectors, slots, memory.

#include "compositor/gpu/gpu_executor.hpp"

#include "compositor/gpu/gpu_renderer.hpp"
#include "compositor/gpu/object_textures.hpp"
#include "compositor/gpu/shader/texture_layout.hpp"
#include "engine/conformance/run_vectors.hpp"
#include "engine/core/definition/view_registers.hpp"
#include "rayspace/base/conventions.hpp"
#include "tests/support/ring_object.hpp"

#include <gtest/gtest.h>

#include <filesystem>

namespace rs::compositor {
namespace {

std::unique_ptr<engine::Executor> gpu(const GpuExecutorOptions& options = {}) {
    Result<std::unique_ptr<engine::Executor>> made = create_gpu_executor(options);
    return made ? std::move(*made) : nullptr;
}

TEST(GpuExecutor, MatchesTheConformanceVectors) {
    std::shared_ptr<engine::Executor> executor = gpu();
    if (!executor) GTEST_SKIP() << "no OpenGL 4.5";
    const auto set =
        engine::read_vectors(std::filesystem::path(RAYSPACE_SOURCE_DIR) / "engine" / "conformance" / "vectors");
    ASSERT_TRUE(set.ok()) << set.error().message;
    const auto matrix = engine::run_vectors(*set, {engine::implementation_of(executor)});
    ASSERT_TRUE(matrix.ok()) << matrix.error().message;
    EXPECT_TRUE(matrix->passed());
    for (std::size_t c = 0; c < set->cases.size(); ++c) {
        const engine::CaseResult& result = matrix->results[c][0];
        EXPECT_EQ(result.same, static_cast<int>(set->cases[c].views.size()))
            << set->cases[c].name << ": " << result.first << result.declined;
    }
}

TEST(GpuExecutor, LoadsWithinItsMemory) {
    const RaySpaceObject object = test::ring_object({.views = 12});
    const std::int64_t bytes = gpu_bytes(object, kMinPhotoLayers);
    const auto executor = gpu({.memory_bytes = 2 * bytes});
    if (!executor) GTEST_SKIP() << "no OpenGL 4.5";
    const auto first = executor->load(object);
    const auto second = executor->load(object);
    ASSERT_TRUE(first.ok() && first->has_value() && second.ok() && second->has_value());
    const auto third = executor->load(object);
    ASSERT_TRUE(third.ok());
    EXPECT_FALSE(third->has_value());  // no room now
    ASSERT_TRUE(executor->evict(**first).ok());
    const auto registers = engine::prepare_view(object, look_at_camera({0, 0, 3.5}, {0, 0, 0}, radians(40), 20, 20));
    EXPECT_FALSE(executor->render({{**first, *registers, false}}).ok());
    EXPECT_TRUE(executor->render({{**second, *registers, false}}).ok());
    const auto fourth = executor->load(object);
    EXPECT_TRUE(fourth.ok() && fourth->has_value());
}

TEST(GpuExecutor, RefusesByNameWhatExceedsItsMemory) {
    const RaySpaceObject object = test::ring_object({.views = 12});
    const auto executor = gpu({.memory_bytes = gpu_bytes(object, kMinPhotoLayers) - 1});
    if (!executor) GTEST_SKIP() << "no OpenGL 4.5";
    const Status supported = executor->supports(object);
    ASSERT_FALSE(supported.ok());
    EXPECT_NE(supported.error().message.find("ring: needs"), std::string::npos) << supported.error().message;
    EXPECT_FALSE(executor->load(object).ok());
}

TEST(GpuExecutor, DefersViewsOnlyWhereTheCallerAcceptsThem) {
    const RaySpaceObject object = test::ring_object({.views = 12});
    const auto executor = gpu();
    if (!executor) GTEST_SKIP() << "no OpenGL 4.5";
    const auto slot = executor->load(object);
    ASSERT_TRUE(slot.ok() && slot->has_value());
    const auto registers = engine::prepare_view(object, look_at_camera({0, 0, 3.5}, {0, 0, 0}, radians(40), 20, 20));
    ASSERT_TRUE(registers.ok());
    const auto views = executor->render(
        {{.slot = **slot, .registers = *registers}, {.slot = **slot, .registers = *registers, .may_defer = true}});
    ASSERT_TRUE(views.ok());
    EXPECT_EQ((*views)[0].deferred, nullptr);
    EXPECT_EQ((*views)[0].image.width(), 20);
    EXPECT_NE(dynamic_cast<const DeferredGpuView*>((*views)[1].deferred.get()), nullptr);
    EXPECT_TRUE((*views)[1].image.empty());
}

TEST(GpuExecutor, IsInTheTable) {
    EXPECT_NE(executors_with_gpu().names().find("gpu"), std::string::npos);
}

}  // namespace
}  // namespace rs::compositor
