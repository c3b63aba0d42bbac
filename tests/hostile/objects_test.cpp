// Objects with faulty chunks and valid checksums: rejected with one line, or rendered equally by definition and core.

#include "engine/core/definition/reconstruct.hpp"
#include "engine/core/fast/renderer.hpp"
#include "rayspace/format/object_file.hpp"
#include "rayspace/geometry/ray_space.hpp"
#include "tests/hostile/mutation.hpp"
#include "tests/hostile/surviving.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace rs {
namespace {

using fuzz::SoupChunk;

// Objects of the conformance set: every profile, map and ring shape.
std::vector<std::vector<SoupChunk>> sound_objects() {
    std::vector<std::vector<SoupChunk>> objects;
    const std::filesystem::path folder = std::filesystem::path(RAYSPACE_SOURCE_DIR) / "engine/conformance/vectors";
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.path().extension() == ".rso") files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    for (const std::filesystem::path& file : files) {
        const auto container = ContainerReader::open(file);
        if (!container) continue;
        std::vector<SoupChunk> chunks;
        for (const ChunkEntry& entry : container->table()) {
            auto payload = container->read(entry);
            if (payload) chunks.push_back({entry.name, entry.index, std::move(*payload)});
        }
        objects.push_back(std::move(chunks));
    }
    return objects;
}

// Renders from the front, close by, far below and nearly overhead; returns the first difference, if any.
std::string find_difference(const RaySpaceObject& object, const engine::Renderer& renderer) {
    for (const glm::dvec3 eye :
         {glm::dvec3(0, 0, 3), glm::dvec3(-1.1, 0.4, -0.6), glm::dvec3(40, -30, 2), glm::dvec3(0.2, 2.5, 0.3)}) {
        const Camera camera = look_at_camera(eye * object.units_per_radius, glm::dvec3(0), 0.8, 40, 33);
        for (const Camera& each : {camera, upright_camera(camera)}) {
            const auto registers = engine::prepare_view(object, each);
            if (!registers) continue;
            Image<Rgba8> defined(each.width, each.height), drawn(each.width, each.height);
            engine::reconstruct_scalar(object, *registers, defined);
            renderer.render(*registers, drawn);
            if (defined != drawn) return "the core's image differs from the definition's";
        }
    }
    return "";
}

std::string of_one_line(const Error& error) {
    return error.message.find('\n') == std::string::npos ? "" : "an error of two lines: " + error.message;
}

TEST(HostileObjects, AreRefusedOrDrawnAlike) {
    const auto sound = sound_objects();
    ASSERT_GT(sound.size(), 10U);
    int accepted = 0, tried = 0;  // counts of the running child
    const int trials = test::survive([&](std::uint64_t seed) -> std::string {
        if (seed == test::hostile_seed()) {  // all are accepted without a mutation
            for (const auto& chunks : sound) {
                const auto container = ContainerReader::over(fuzz::container_of(chunks), "sound");
                if (!container || !read_object(*container)) return "a sound object is refused";
            }
        }
        test::Random random(seed);
        std::vector<SoupChunk> chunks = sound[test::below(random, sound.size())];
        test::mutate_chunks(chunks, random);
        std::vector<std::byte> bytes = fuzz::container_of(chunks);
        if (test::below(random, 10) == 0) test::mutate_bytes(bytes, random);
        if (++tried == 200 && accepted < 10)
            return "hardly anything gets past the readers: the mutations are too coarse";
        const auto container = ContainerReader::over(std::move(bytes), "input");
        if (!container) return of_one_line(container.error());
        ReadObjectOptions options;
        options.memory_cap_bytes = std::uint64_t{64} << 20;
        auto object = read_object(*container, options);
        if (!object) return of_one_line(object.error());
        ++accepted;
        options.decode = false;
        auto coded = read_object(*container, options);
        if (!coded) return "is accepted decoded and refused coded";
        const bool is_coded = coded->images.empty() || coded->images.front().empty();
        const auto renderer = engine::Renderer::create(is_coded ? std::move(*coded) : *object);
        if (!renderer) return of_one_line(renderer.error());
        return find_difference(*object, *renderer);
    });
    EXPECT_GT(trials, 20);
}

}  // namespace
}  // namespace rs
