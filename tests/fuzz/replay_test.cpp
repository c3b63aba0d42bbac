// Runs every file of the corpus through its fuzz entry, as a regression test of earlier findings.
#include "capture/calibration/known/known_files.hpp"
#include "compositor/displays/head_datagram.hpp"
#include "compositor/scene/reader/scene_file.hpp"
#include "compositor/scene/reader/vrml_file.hpp"
#include "compositor/sharing/shared_view.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/format/object_file.hpp"
#include "rayspace/image_io/image_io.hpp"
#include "tests/fuzz/chunk_soup.hpp"
#include "tests/fuzz/entries.hpp"
#include "tests/fuzz/mutated_world.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <random>

namespace {

namespace fs = std::filesystem;
using namespace rs;
using Entry = int (*)(const std::uint8_t*, std::size_t);

std::vector<fs::path> corpus(const std::string& name) {
    std::vector<fs::path> files;
    for (const auto& entry :
         fs::directory_iterator(fs::path(RAYSPACE_SOURCE_DIR) / "tests" / "fuzz" / "corpus" / name)) {
        files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

std::vector<std::uint8_t> contents(const fs::path& path) {
    const auto bytes = read_file(path, 1 << 24);
    EXPECT_TRUE(bytes.ok()) << path;
    if (!bytes) return {};
    const auto* const first = reinterpret_cast<const std::uint8_t*>(bytes->data());
    return {first, first + bytes->size()};
}

constexpr int kTrialsOfModels = 50;  // Assimp's readers start slowly, above all under the sanitizers

void replay(const std::string& name, Entry entry, int trials = 200) {
    const auto files = corpus(name);
    ASSERT_GE(files.size(), 2U);
    for (const fs::path& file : files) {
        SCOPED_TRACE(file.string());
        const auto input = contents(file);
        EXPECT_EQ(entry(input.data(), input.size()), 0);
        // Also try a few mutations of each file, as the fuzzer would.
        std::mt19937 random(1);
        for (int trial = 0; trial < trials; ++trial) {
            auto mutated = input;
            if (mutated.empty()) break;
            for (int i = 0; i < 3; ++i) mutated[random() % mutated.size()] = static_cast<std::uint8_t>(random());
            if (trial % 4 == 0) mutated.resize(random() % mutated.size());
            EXPECT_EQ(entry(mutated.data(), mutated.size()), 0);
        }
    }
}

TEST(FuzzReplay, Container) {
    replay("container", fuzz::fuzz_container);
}
TEST(FuzzReplay, Object) {
    replay("object", fuzz::fuzz_object);
}
TEST(FuzzReplay, Rig) {
    replay("rig", fuzz::fuzz_rig);
}
TEST(FuzzReplay, PhotoRows) {
    replay("photo_rows", fuzz::fuzz_photo_rows);
}
TEST(FuzzReplay, Middlebury) {
    replay("middlebury", fuzz::fuzz_middlebury);
}

TEST(FuzzReplay, Colmap) {
    replay("colmap", fuzz::fuzz_colmap, 2000);
}

TEST(FuzzReplay, Vrml) {
    replay("vrml", fuzz::fuzz_vrml);
}

TEST(FuzzReplay, Sequence) {
    replay("sequence", fuzz::fuzz_sequence);
}

TEST(FuzzReplay, Vrml1) {
    replay("vrml1", fuzz::fuzz_vrml1);
}

TEST(FuzzReplay, X3d) {
    replay("x3d", fuzz::fuzz_x3d);
}

TEST(FuzzReplay, Luminaire) {
    replay("luminaire", fuzz::fuzz_luminaire);
}

TEST(FuzzReplay, Walls) {
    replay("walls", fuzz::fuzz_walls);
}

TEST(FuzzReplay, Head) {
    replay("head", fuzz::fuzz_head);
}

TEST(FuzzReplay, Sharing) {
    replay("sharing", fuzz::fuzz_sharing, 2000);
}

TEST(FuzzReplay, Lights) {
    replay("lights", fuzz::fuzz_lights);
}

TEST(FuzzReplay, NetworkSettings) {
    replay("network_settings", fuzz::fuzz_network_settings);
}

TEST(FuzzReplay, Onnx) {
    replay("onnx", fuzz::fuzz_onnx);
}

TEST(FuzzReplay, Gltf) {
    replay("gltf", fuzz::fuzz_gltf);
}
TEST(FuzzReplay, Obj) {
    replay("obj", fuzz::fuzz_obj, kTrialsOfModels);
}
TEST(FuzzReplay, Mtl) {
    replay("mtl", fuzz::fuzz_mtl, kTrialsOfModels);
}
TEST(FuzzReplay, Ply) {
    replay("ply", fuzz::fuzz_ply);
}
TEST(FuzzReplay, Image) {
    replay("image", fuzz::fuzz_image);
}
TEST(FuzzReplay, Film) {
    replay("film", fuzz::fuzz_film);
}

TEST(FuzzReplay, FaultyWorldsAreReadOrRefused) {
    std::vector<std::string> worlds;
    for (const char* const form : {"vrml", "vrml1", "x3d"}) {
        for (const fs::path& file : corpus(form)) {
            const auto input = contents(file);
            worlds.emplace_back(input.begin(), input.end());
        }
    }
    constexpr std::uint64_t kSeed = 1;
    SCOPED_TRACE(kSeed);
    std::mt19937_64 random(kSeed);
    int read = 0;
    for (int i = 0; i < 600; ++i) {
        const std::string world = fuzz::mutated_world(worlds, random);
        SCOPED_TRACE(i);
        EXPECT_EQ(fuzz::fuzz_vrml(reinterpret_cast<const std::uint8_t*>(world.data()), world.size()), 0);
        read += compositor::scene_from_vrml(world, "input.wrl").ok();
    }
    // Both results occur.
    EXPECT_GT(read, 50);
    EXPECT_LT(read, 550);
}

// Seeds are useful only if they pass all checks; likewise the objects of earlier renderer failures.
TEST(FuzzReplay, SeedsAreValid) {
    int seeds = 0;
    for (const fs::path& file : corpus("object")) {
        const std::string name = file.filename().string();
        if (name.rfind("seed-", 0) != 0 && name.rfind("overflow-", 0) != 0) continue;
        const auto container =
            ContainerReader::over(fuzz::container_of(fuzz::chunks_from_input(contents(file))), file.string());
        ASSERT_TRUE(container.ok()) << container.error().message;
        const auto object = read_object(*container);
        EXPECT_TRUE(object.ok()) << object.error().message;
        ++seeds;
    }
    for (const fs::path& file : corpus("container")) {
        if (file.filename().string().rfind("seed-", 0) != 0) continue;
        EXPECT_TRUE(read_object(file).ok()) << file;
        ++seeds;
    }
    for (const fs::path& file : corpus("middlebury")) {
        if (file.filename().string().rfind("seed-", 0) != 0) continue;
        const auto turn = capture::read_middlebury_parameters(file);
        EXPECT_TRUE(turn.ok()) << turn.error().message;
        ++seeds;
    }
    std::vector<fs::path> of_worlds = corpus("vrml");
    for (const char* const form : {"vrml1", "x3d"}) {
        for (const fs::path& file : corpus(form)) of_worlds.push_back(file);
    }
    for (const fs::path& file : of_worlds) {
        if (file.filename().string().rfind("seed-", 0) != 0) continue;
        const auto input = contents(file);
        const auto scene =
            compositor::scene_from_vrml({reinterpret_cast<const char*>(input.data()), input.size()}, file);
        EXPECT_TRUE(scene.ok()) << scene.error().message;
        ++seeds;
    }
    for (const char* const kind : {"gltf", "obj"}) {
        for (const fs::path& file : corpus(kind)) {
            if (file.filename().string().rfind("seed-", 0) != 0) continue;
            const auto scene = compositor::read_scene(file);
            EXPECT_TRUE(scene.ok()) << scene.error().message;
            ++seeds;
        }
    }
    for (const fs::path& file : corpus("image")) {
        if (file.filename().string().rfind("seed-", 0) != 0) continue;
        EXPECT_TRUE(read_image(file).ok()) << file;
        ++seeds;
    }
    for (const fs::path& file : corpus("head")) {
        if (file.filename().string().rfind("seed-", 0) != 0) continue;
        const auto input = contents(file);
        EXPECT_TRUE(compositor::head_from_datagram(std::as_bytes(std::span(input))).ok()) << file;
        ++seeds;
    }
    for (const fs::path& file : corpus("sharing")) {
        if (file.filename().string().rfind("seed-", 0) != 0) continue;
        const auto input = contents(file);
        compositor::SharedViewReader reader(0x0123456789abcdef);
        EXPECT_TRUE(reader.take(std::as_bytes(std::span(input))).ok()) << file;
        EXPECT_TRUE(reader.take_view().has_value()) << file;
        ++seeds;
    }
    EXPECT_GE(seeds, 18);
}

}  // namespace
