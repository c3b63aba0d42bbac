// Writes the seed files of the corpus: `make_fuzz_seeds tests/fuzz/corpus`. Must be run again when the format changes.
#include "rayspace/file/file_output.hpp"
#include "rayspace/format/object_chunks.hpp"
#include "rayspace/format/object_file.hpp"
#include "tests/fuzz/chunk_soup.hpp"
#include "tests/support/coded_object.hpp"
#include "tests/support/small_shape.hpp"

#include <cstdio>
#include <filesystem>
#include <string_view>
#include <utility>

namespace {

namespace fs = std::filesystem;
using namespace rs;

Status write_seeds(const fs::path& corpus) {
    test::SmallObjectOptions one_ring;
    one_ring.views_per_ring = 3;
    one_ring.planes = 3;
    one_ring.x_cells = 2;
    one_ring.u_cells = 3;
    one_ring.width = 3;
    one_ring.height = 2;
    test::SmallObjectOptions two_rings = one_ring;
    two_rings.rings = 2;
    // Includes gaps without lines; two rings, only one of which has a shape map.
    const test::SmallShapeOptions shape{.p_cells = 5, .bands = 4, .lines = {2, 0, 1}};
    RaySpaceObject with_shape = test::small_object(two_rings);
    with_shape.rings[1].shape = test::small_shape(with_shape, 1, shape);
    test::SmallObjectOptions larger = one_ring;
    larger.width = 36;
    larger.height = 20;
    RaySpaceObject standing = test::small_object(one_ring);
    standing.foot_q20 = -700000;
    const std::pair<const char*, RaySpaceObject> objects[] = {
        {"one-ring", test::small_object(one_ring)},   {"standing", std::move(standing)},
        {"two-rings", test::small_object(two_rings)}, {"shape", std::move(with_shape)},
        {"coded", test::coded_object(larger, {})},    {"mask", test::coded_object(larger, {.alpha_bits = 1})},
        {"board", test::board_object(larger, {})}};
    for (const auto& [name, object] : objects) {
        const fs::path file = corpus / "container" / (std::string("seed-") + name + ".rso");
        if (Status status = write_object(file, object); !status) return status;
        const auto reader = ContainerReader::open(file);
        if (!reader) return reader.error();
        std::vector<fuzz::SoupChunk> chunks;
        for (const ChunkEntry& entry : reader->table()) {
            auto payload = reader->read(entry);
            if (!payload) return payload.error();
            // Uncompressed, so that mutations change the numbers.
            if (entry.name == object_chunks::kRing && name == std::string_view("two-rings")) {
                payload = object_chunks::ring_payload(object, entry.index, object_chunks::LineCoding::kPlain);
            }
            chunks.push_back({entry.name, entry.index, std::move(payload).value()});
        }
        const auto input = fuzz::input_from_chunks(chunks);
        const fs::path soup = corpus / "object" / (std::string("seed-") + name + ".chunks");
        if (Status status = write_file(soup, std::as_bytes(std::span(input))); !status) return status;
    }
    return {};
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2 || argv[1][0] == '-') {
        std::fprintf(stderr, "usage: make_fuzz_seeds CORPUS-FOLDER\n");
        return 2;
    }
    const Status status = write_seeds(argv[1]);
    if (!status) std::fprintf(stderr, "make_fuzz_seeds: error: %s\n", status.error().message.c_str());
    return status.ok() ? 0 : 1;
}
