// Showroom files: deterministic bytes, complete, with a RaySpace node for every object.

#include "datasets-synthetic/showroom/world_file.hpp"
#include "datasets-synthetic/showroom/showroom.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/image_io/image_io.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <set>
#include <string>

namespace rs::synthetic {
namespace {

World small_showroom() {
    return make_showroom({.texture_scale = 0.05F});
}

std::string text_of(const std::filesystem::path& path) {
    const auto bytes = read_file(path, std::uint64_t{1} << 26U);
    EXPECT_TRUE(bytes.ok()) << path;
    if (!bytes.ok()) return "";
    return {reinterpret_cast<const char*>(bytes->data()), bytes->size()};
}

std::size_t count(const std::string& text, const std::string& pattern) {
    const std::regex regex(pattern);
    return static_cast<std::size_t>(
        std::distance(std::sregex_iterator(text.begin(), text.end(), regex), std::sregex_iterator()));
}

TEST(WorldFile, IsTheSameEveryTime) {
    const test::TemporaryFolder folder;
    for (const char* name : {"first", "second"}) {
        const Status written = write_world(small_showroom(), folder / name, "room", "..");
        ASSERT_TRUE(written.ok()) << written.error().message;
    }
    std::size_t files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "first")) {
        const std::string name = entry.path().filename().string();
        if (name.front() == '.') continue;
        EXPECT_TRUE(text_of(entry.path()) == text_of(folder / "second" / name)) << name;
        ++files;
    }
    EXPECT_EQ(files, small_showroom().textures.size() + 4);
}

TEST(WorldFile, NamesWhatIsThere) {
    const test::TemporaryFolder folder;
    const World world = small_showroom();
    const Status written = write_world(world, folder / "room", "room", "../objects");
    ASSERT_TRUE(written.ok()) << written.error().message;
    const std::string text = text_of(folder / "room" / "room.wrl");
    EXPECT_EQ(text.rfind("#VRML V2.0 utf8\n", 0), 0U);
    for (const char* pair : {"{}", "[]"}) {
        EXPECT_EQ(std::count(text.begin(), text.end(), pair[0]), std::count(text.begin(), text.end(), pair[1]));
    }
    EXPECT_EQ(text.find("nan"), std::string::npos);
    EXPECT_EQ(text.find("inf "), std::string::npos);
    EXPECT_EQ(count(text, "RaySpace \\{ url \"../objects/[a-z]+\\.rso\" size 0\\.[0-9]+ "), world.objects.size());
    EXPECT_EQ(count(text, "\nViewpoint \\{"), world.viewpoints.size());
    std::set<std::string> used;
    const std::regex url("url \"([^\"]+\\.png)\"");
    for (std::sregex_iterator it(text.begin(), text.end(), url), end; it != end; ++it) used.insert((*it)[1]);
    EXPECT_EQ(used.size(), world.textures.size()) << "every texture is used";
    for (const std::string& file : used) {
        const Result<ImageInfo> info = read_image_info(folder / "room" / file);
        EXPECT_TRUE(info.ok()) << file;
    }
    std::size_t triangles = 0;
    for (const WorldPart& part : world.parts) triangles += part.mesh.triangles.size();
    EXPECT_EQ(count(text, "[ \n][0-9]+ [0-9]+ [0-9]+ -1(?=[ \n])"), triangles);
    const nlohmann::json walk = nlohmann::json::parse(text_of(folder / "room" / "room-walk.json"));
    EXPECT_EQ(walk["camera"]["path"].size(), world.walk.size());
    EXPECT_EQ(walk["camera"]["frames"], world.walk_frames);
}

// Parses a viewpoint and converts its orientation to a viewing direction.
TEST(WorldFile, ViewpointsLookAtTheirPoint) {
    World world;
    world.viewpoints = {
        {"ahead", {0, 1, 0}, {0, 1, -2}}, {"left", {0, 1, 0}, {-2, 1, 0}}, {"down", {0, 1, 0}, {1, 0, 0}}};
    const std::string text = vrml_text(world, ".");
    EXPECT_NE(text.find("\"ahead\" position 0 1 0 orientation 0 1 0 0 "), std::string::npos) << text;
    EXPECT_NE(text.find("\"left\" position 0 1 0 orientation 0 1 0 1.5708 "), std::string::npos) << text;
    // Right by 90 degrees, then down by 45; reference computed by hand.
    EXPECT_NE(text.find("\"down\" position 0 1 0 orientation -0.3574 -0.8629 -0.3574 1.7178 "), std::string::npos)
        << text;
}

}  // namespace
}  // namespace rs::synthetic
