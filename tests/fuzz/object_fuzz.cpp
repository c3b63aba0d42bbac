#include "engine/core/definition/reconstruct.hpp"
#include "rayspace/format/chunk_table.hpp"
#include "rayspace/format/object_file.hpp"
#include "rayspace/format/object_stream.hpp"
#include "rayspace/geometry/ray_space.hpp"
#include "tests/fuzz/chunk_soup.hpp"
#include "tests/fuzz/entries.hpp"

#include <algorithm>

namespace rs::fuzz {
namespace {

// Accepted objects must survive a round trip: the writer's payloads give the same object again.
void check_rewriting(const RaySpaceObject& object) {
    using namespace object_chunks;
    std::vector<SoupChunk> chunks;
    for (const ChunkKey key : chunk_order(object)) {
        chunks.push_back({key.name, key.index, chunk_payload(object, key)});
    }
    const auto container = ContainerReader::over(container_of(chunks), "rewritten");
    RS_CHECK(container.ok());
    const auto again = read_object(*container);
    RS_CHECK(again.ok());
    RS_CHECK(again->name == object.name && again->rig_json == object.rig_json && again->foot_q20 == object.foot_q20);
    RS_CHECK(again->views == object.views && again->rings == object.rings && again->images == object.images);
}

// Accepted objects must be safe to render from any viewpoint.
void check_rendering(const RaySpaceObject& object) {
    // In front, close by, far below, and nearly overhead, where rays have the least horizontal length.
    for (const glm::dvec3 eye :
         {glm::dvec3(0, 0, 3), glm::dvec3(-1.1, 0.4, -0.6), glm::dvec3(40, -30, 2), glm::dvec3(0.2, 2.5, 0.3)}) {
        const Camera camera = look_at_camera(eye * object.units_per_radius, glm::dvec3(0), 0.8, 24, 20);
        for (const Camera& each : {camera, upright_camera(camera)}) {
            const auto registers = engine::prepare_view(object, each);
            if (!registers) continue;
            Image<Rgba8> image(each.width, each.height);
            engine::reconstruct_scalar(object, *registers, image);
        }
    }
}

// A file that arrives in pieces gives the object of the whole file, or an error as that does.
void check_streaming(const std::vector<std::byte>& file, const ReadObjectOptions& options) {
    ReadObjectOptions coded = options;
    coded.decode = false;
    const auto container = ContainerReader::over(file, "input");
    const auto whole = read_object(*container, coded);
    constexpr std::size_t kPieces[] = {7, 64, 1000};
    for (const std::size_t piece : kPieces) {
        ObjectStream stream("input", file.size(), options);
        bool accepted = true;
        for (std::size_t at = 0; at < file.size() && accepted; at += piece) {
            accepted = stream.add(at, std::span(file).subspan(at, std::min(piece, file.size() - at))).ok();
        }
        accepted = accepted && stream.finish(file.size()).ok();
        RS_CHECK(accepted == whole.ok());
        if (!accepted) continue;
        RS_CHECK(stream.object().views == whole->views && stream.object().rings == whole->rings);
        RS_CHECK(stream.object().images == whole->images);
    }
}

}  // namespace

int fuzz_object(const std::uint8_t* data, std::size_t size) {
    const std::vector<SoupChunk> chunks = chunks_from_input({data, size});
    if (chunks.empty()) return 0;
    const auto container = ContainerReader::over(container_of(chunks), "input");
    if (!container) return 0;
    ReadObjectOptions options;
    options.memory_cap_bytes = std::uint64_t{16} << 20;
    const auto whole = read_object(*container, options);
    if (!whole) RS_CHECK(whole.error().message.find('\n') == std::string::npos);
    if (whole) check_rewriting(*whole);
    if (whole) check_rendering(*whole);
    check_streaming(container_of(chunks), options);
    options.max_level = 0;
    const auto coarse = read_object(*container, options);
    RS_CHECK(!whole || coarse.ok());
    RS_CHECK(!summarise_chunks(*container).empty());
    return 0;
}

}  // namespace rs::fuzz
