#pragma once
// Objects with images of profile `board` for tests of block decompression: random ones, which no encoder produces, and
// encoded ones.

#include "rayspace/codec/board/board_profile.hpp"
#include "rayspace/codec/stream/decode_image.hpp"
#include "tests/engine/model/board_test_objects.hpp"
#include "tests/support/coded_object.hpp"

#include <random>

namespace rs::engine::model::test {

inline BoardConfig compressed() {
    Result<BoardConfig> config = read_board_config("compressed-2000");
    EXPECT_TRUE(config.ok());
    return *config;
}

inline BlockDecompression& block_decompression(Board& board) {
    return dynamic_cast<SingleBoard<BlockDecompression>&>(*board.top().body).reading;
}

// Every class, all codebooks, tiles of random bytes that are often truncated, missing tiles; images of four levels with
// none, one or two references to any lower level, so that predictions have up to three hops.
inline codec::CodedImages random_images(const RaySpaceObject& object, std::mt19937_64& random) {
    const auto below = [&](std::uint64_t n) { return static_cast<int>(random() % n); };
    codec::CodedImages coded;
    coded.profile = codec::Profile::kBoard;
    coded.width = object.width;
    coded.height = object.height;
    for (std::size_t set = 0; set < 2; ++set) {
        for (std::size_t c = 1; c < coded.board.classes[set].size(); ++c) {
            coded.board.classes[set][c] = {set == 1 && below(8) > 0, below(3) == 0, below(3), below(5)};
        }
    }
    const int most = 1 << below(7);  // amplitude of the differences
    const auto fill = [&](codec::Book& book, int dimensions) {
        book.resize(static_cast<std::size_t>(codec::kBookEntries * dimensions));
        for (std::int8_t& value : book)
            value = static_cast<std::int8_t>(below(2 * static_cast<std::uint64_t>(most)) - most);
    };
    for (std::size_t set = 0; set < 2; ++set) {
        const codec::StageCounts counts = codec::stage_counts(coded.board, set);
        for (int s = 0; s < counts.block; ++s)
            fill(coded.board.books[set].block[static_cast<std::size_t>(s)], codec::kBlockDimensions);
        for (int s = 0; s < counts.quarter; ++s)
            fill(coded.board.books[set].quarter[static_cast<std::size_t>(s)], codec::kQuarterDimensions);
    }
    if (codec::uses_alpha(coded.board)) {
        coded.board.alpha.resize(std::size_t{codec::kBookEntries} * 16);
        for (std::uint8_t& a : coded.board.alpha) a = static_cast<std::uint8_t>(below(256));
    }
    const auto tiles = static_cast<std::size_t>(coded.tile_columns() * coded.tile_rows());
    for (std::size_t v = 0; v < object.views.size(); ++v) {
        coded.levels.push_back(static_cast<std::uint8_t>(v < 4 ? v : static_cast<std::size_t>(below(4))));
        coded.images.emplace_back();
        for (std::size_t t = 0; t < tiles; ++t) {
            std::vector<std::byte>& bytes = coded.images.back().bytes;
            const auto size = static_cast<std::uint32_t>(below(3) == 0 ? below(40) : below(430));
            coded.images.back().tiles.push_back({static_cast<std::uint32_t>(bytes.size()), size, below(8) > 0});
            for (std::uint32_t n = 0; n < size; ++n) bytes.push_back(static_cast<std::byte>(random()));
        }
    }
    for (std::size_t v = 0; v < object.views.size(); ++v) {
        // Mostly references to the level below, for long chains.
        const int only = coded.levels[v] - 1;
        const bool any = below(4) == 0;
        std::vector<std::uint16_t> lower;
        for (std::size_t r = 0; r < object.views.size(); ++r) {
            const int level = coded.levels[r];
            if (any ? level <= only : level == only) lower.push_back(static_cast<std::uint16_t>(r));
        }
        codec::ImageHead& head = coded.images[v].head;
        const int references = std::min(static_cast<int>(lower.size()), below(8) == 0 ? 0 : 1 + below(2));
        if (references > 0) head.reference[0] = lower[random() % lower.size()];
        if (references > 1) {
            do head.reference[1] = lower[random() % lower.size()];
            while (head.reference[1] == head.reference[0]);
        }
    }
    return coded;
}

// Object with coded images for the board and, in object.images, their decoded images for the definition.
inline RaySpaceObject with_coded(RaySpaceObject object, codec::CodedImages coded) {
    object.coded = std::make_shared<codec::CodedImages>(std::move(coded));
    codec::decode_images(object);
    return object;
}

inline RaySpaceObject random_coded_object(const rs::test::RingObjectOptions& options) {
    RaySpaceObject object = rs::test::ring_object(options);
    std::mt19937_64 random(options.seed);
    codec::CodedImages coded = random_images(object, random);
    return with_coded(std::move(object), std::move(coded));
}

// Rendered balls, encoded with the settings of rs-encode, and the same object uncompressed.
struct EncodedObject {
    RaySpaceObject coded;
    RaySpaceObject raw;
};
inline EncodedObject encoded_object(int views, int side) {
    EncodedObject object;
    object.raw = rs::test::ring_object({.views = views,
                                        .width = side,
                                        .height = side,
                                        .fl_px = 1.3 * side,
                                        .planes = 6,
                                        .x_cells = 64,
                                        .u_cells = 64});
    const std::vector<Image<Rgba8>> images = rs::test::drawn_images(object.raw);
    object.coded = with_coded(object.raw, rs::test::code_board_images(object.raw, images, {}));
    for (std::size_t v = 0; v < images.size(); ++v) object.raw.images[v] = planar_from_rgba(images[v].view());
    return object;
}

}  // namespace rs::engine::model::test
