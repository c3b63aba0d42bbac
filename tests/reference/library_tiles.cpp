#include "tests/reference/library_tiles.hpp"

#include "rayspace/codec/stream/decode_image.hpp"

#include <algorithm>

namespace rs::reference {

std::vector<LibraryPlanes> decode_by_tiles(const codec::CodedImages& coded) {
    std::vector<LibraryPlanes> decoded(coded.images.size());
    for (auto& planes : decoded) {
        for (auto& plane : planes) plane = Image<std::uint8_t>(coded.coded_width(), coded.coded_height(), 77);
    }
    const auto plane_views = [](auto& planes) {
        return codec::PlaneViews{planes[0].view(), planes[1].view(), planes[2].view(), planes[3].view()};
    };
    for (int level = 0; level < kProgressiveLevels; ++level) {
        for (std::size_t v = 0; v < decoded.size(); ++v) {
            if (coded.levels[v] != level) continue;
            const codec::CodedImage& image = coded.images[v];
            std::array<codec::ConstPlaneViews, 2> references;
            for (std::size_t r = 0; r < static_cast<std::size_t>(image.head.references()); ++r) {
                std::ranges::copy(plane_views(decoded[image.head.reference[r]]), references[r].begin());
            }
            for (std::size_t t = 0; t < image.tiles.size(); ++t) {
                codec::decode_tile(coded, v, t, references, nullptr, plane_views(decoded[v]));
            }
        }
    }
    return decoded;
}

}  // namespace rs::reference
