// Third-party worlds: all load, and are not empty.

#include "compositor/gl/context.hpp"
#include "compositor/scene/reader/scene_file.hpp"
#include "compositor/viewer/drawing/frame_compositor.hpp"
#include "compositor/viewer/views/framing.hpp"
#include "tests/fuzz/entries.hpp"
#include "tests/fuzz/mutated_world.hpp"
#include "tests/support/real_data.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>

namespace rs::compositor {
namespace {

std::vector<std::filesystem::path> worlds_in(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> worlds;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        if (entry.path().extension() == ".wrl") worlds.push_back(entry.path());
    }
    std::sort(worlds.begin(), worlds.end());
    return worlds;
}

TEST(RealWorlds, AllAreShown) {
    const auto folder = RS_REAL_DATA_OR_SKIP("vrml");
    const auto worlds = worlds_in(folder);
    ASSERT_GE(worlds.size(), 13U);
    Result<gl::Context> context = gl::Context::create_surfaceless({.debug = true});
    if (!context) GTEST_SKIP() << context.error().message;
    for (const auto& world : worlds) {
        SCOPED_TRACE(world.string());
        const Result<Scene> scene = read_scene(world);
        ASSERT_TRUE(scene) << scene.error().message;
        const bool is_empty = world.filename().string().starts_with("empty");
        EXPECT_EQ(scene->geometry.empty(), is_empty);
        if (is_empty) continue;
        constexpr int kWidth = 160;
        constexpr int kHeight = 120;
        const CameraPose pose = framing_pose(bounds_of(*scene), radians(50), 4.0 / 3);
        const Camera camera = scene->viewpoints.empty()
                                  ? look_at_camera(pose.eye, pose.at, radians(50), kWidth, kHeight)
                                  : camera_at(scene->viewpoints.front(), kWidth, kHeight);
        auto compositor = FrameCompositor::create(*scene, {}, {.width = kWidth, .height = kHeight});
        ASSERT_TRUE(compositor) << compositor.error().message;
        const auto image = compositor->compose(camera);
        ASSERT_TRUE(image) << image.error().message;
        const Rgba8 corner = (*image)(0, 0);
        const auto shown = std::count_if(image->pixels().begin(), image->pixels().end(),
                                         [&](const Rgba8& pixel) { return pixel != corner; });
        EXPECT_GT(shown, world.stem() == "light_radius" ? 0 : 100);
        EXPECT_THAT(context->take_errors(), ::testing::IsEmpty());
    }
}

TEST(RealWorlds, FaultyOnesAreReadOrRefused) {
    const auto folder = RS_REAL_DATA_OR_SKIP("vrml");
    std::vector<std::string> worlds;
    for (const auto& world : worlds_in(folder)) {
        std::ifstream file(world, std::ios::binary);
        worlds.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
    }
    constexpr std::uint64_t kSeed = 5;
    SCOPED_TRACE(kSeed);
    std::mt19937_64 random(kSeed);
    for (int i = 0; i < 300; ++i) {
        const std::string world = fuzz::mutated_world(worlds, random);
        SCOPED_TRACE(i);
        EXPECT_EQ(fuzz::fuzz_vrml(reinterpret_cast<const std::uint8_t*>(world.data()), world.size()), 0);
    }
}

}  // namespace
}  // namespace rs::compositor
