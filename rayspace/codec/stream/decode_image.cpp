#include "rayspace/codec/stream/decode_image.hpp"
#include "rayspace/base/parallel_loop.hpp"

#include "rayspace/codec/board/board_profile.hpp"

#include <algorithm>
#include <cstring>
#include <utility>
#include <vector>

namespace rs::codec {

TileRect tile_rect(const CodedImages& coded, std::size_t tile) {
    const int number = static_cast<int>(tile);
    const int left = number % coded.tile_columns() * coded.tile_width();
    const int top = number / coded.tile_columns() * coded.tile_height();
    return {left, top, std::min(coded.tile_width(), coded.coded_width() - left),
            std::min(coded.tile_height(), coded.coded_height() - top)};
}

void decode_tile(const CodedImages& coded, std::size_t view, std::size_t tile,
                 const std::array<ConstPlaneViews, 2>& references, ReferenceListener* listener, const PlaneViews& out) {
    const CodedImage& image = coded.images[view];
    const TileRect place = tile_rect(coded, tile);
    if (!image.tiles[tile].present) return clear_tile(place, out);
    const CodedTile coded_tile{.head = image.head,
                               .bytes = image.tile_bytes(tile),
                               .place = place,
                               .references = references,
                               .listener = listener};
    if (coded.profile == Profile::kBoard) {
        decode_board_tile(coded.board, coded_tile, out);
    } else {
        decode_dense_tile(coded.dense, coded_tile, out);
    }
}

std::vector<Planes> decode_planes(const CodedImages& coded, const DecodeTile& decode) {
    std::vector<Planes> decoded(coded.images.size());
    for (int level = 0; level < kProgressiveLevels; ++level) {
        for_each_index(decoded.size(), [&](std::size_t v) {
            const CodedImage& image = coded.images[v];
            if (coded.levels[v] != level || !image.loaded()) return;
            for (auto& plane : decoded[v]) plane = Image<std::uint8_t>(coded.coded_width(), coded.coded_height());
            std::array<ConstPlaneViews, 2> references;
            for (std::size_t r = 0; r < static_cast<std::size_t>(image.head.references()); ++r) {
                references[r] = plane_views(std::as_const(decoded[image.head.reference[r]]));
            }
            for (std::size_t t = 0; t < image.tiles.size(); ++t) decode(v, t, references, plane_views(decoded[v]));
        });
    }
    return decoded;
}

void decode_images(RaySpaceObject& object) {
    const CodedImages& coded = *object.coded;
    std::vector<Planes> decoded =
        decode_planes(coded, [&](std::size_t view, std::size_t tile, const auto& references, const PlaneViews& out) {
            decode_tile(coded, view, tile, references, nullptr, out);
        });
    for_each_index(decoded.size(), [&](std::size_t v) {
        if (decoded[v][0].empty()) return;
        PlanarImage& image = object.images[v];
        image.chroma_shift = 0;
        Image<std::uint8_t>* const planes[4] = {&image.y, &image.u, &image.v, &image.a};
        for (std::size_t p = 0; p < 4; ++p) {
            *planes[p] = Image<std::uint8_t>(object.width, object.height);
            for (int y = 0; y < object.height; ++y) {
                std::memcpy(planes[p]->row(y), decoded[v][p].row(y), static_cast<std::size_t>(object.width));
            }
            decoded[v][p] = {};
        }
    });
}

}  // namespace rs::codec
