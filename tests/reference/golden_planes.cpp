#include "tests/reference/golden_planes.hpp"

#include "rayspace/format/object_chunks.hpp"

#include <xxhash.h>

namespace rs::golden {
namespace {

using namespace object_chunks;
using Numbers = std::vector<std::uint8_t>;

// The payload; empty if the chunk is missing or damaged.
Numbers payload_of(const ContainerReader& file, ChunkName name, std::uint32_t index) {
    const ChunkEntry* const entry = file.find(name, index);
    if (entry == nullptr) return {};
    const auto payload = file.read(*entry);
    if (!payload) return {};
    const auto* const first = reinterpret_cast<const std::uint8_t*>(payload->data());
    return {first, first + payload->size()};
}

std::size_t u32_at(const Numbers& bytes, std::size_t at) {
    return bytes[at] + 256U * bytes[at + 1] + 65536U * bytes[at + 2] + 16777216U * bytes[at + 3];
}

// FORMAT.md, "Coding 0".
std::string sum_raw(const Numbers& pict, std::size_t width, std::size_t height, PlaneSums& sums) {
    const std::size_t half = ((width + 1) / 2) * ((height + 1) / 2);
    const std::array<std::size_t, 4> samples = {width * height, half, half, width * height};
    if (pict.size() != 16 + samples[0] + samples[1] + samples[2] + samples[3]) return "a raw image has another size";
    std::size_t at = 16;
    for (std::size_t p = 0; p < samples.size(); ++p) {
        sums[p] = XXH64(pict.data() + at, samples[p], 0);
        at += samples[p];
    }
    return "";
}

}  // namespace

std::uint64_t plane_sum(ConstImageView<std::uint8_t> plane, int width, int height) {
    Numbers samples;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) samples.push_back(plane(x, y));
    }
    return XXH64(samples.data(), samples.size(), 0);
}

FileSums reference_sums(const ContainerReader& file) {
    const Numbers head = payload_of(file, kHead, 0);
    if (head.size() < 28) return {"no HEAD", {}};
    const std::size_t width = u32_at(head, 0);
    const std::size_t height = u32_at(head, 4);
    std::vector<Numbers> picts;
    for (std::uint32_t v = 0; v < u32_at(head, 8); ++v) picts.push_back(payload_of(file, kImage, v));
    FileSums sums;
    sums.views.resize(picts.size());
    if (file.find(kCode, 0) == nullptr) {
        for (std::size_t v = 0; v < picts.size() && sums.error.empty(); ++v) {
            sums.error = sum_raw(picts[v], width, height, sums.views[v]);
        }
        return sums;
    }
    const reference::Images images = reference::decode_reference(static_cast<int>(width), static_cast<int>(height),
                                                                 payload_of(file, kCode, 0), picts);
    if (!images.error.empty()) return {images.error, {}};
    for (std::size_t v = 0; v < picts.size(); ++v) {
        for (std::size_t p = 0; p < 4; ++p) {
            const reference::DecodedImage& image = images.views[v];
            sums.views[v][p] = plane_sum({image.planes[p].data(), image.width, image.height, image.width},
                                         static_cast<int>(width), static_cast<int>(height));
        }
    }
    return sums;
}

std::vector<PlaneSums> object_sums(const RaySpaceObject& object) {
    std::vector<PlaneSums> sums;
    for (const PlanarImage& image : object.images) {
        const auto sum = [](const Image<std::uint8_t>& plane) {
            return plane_sum(plane.view(), plane.width(), plane.height());
        };
        sums.push_back({sum(image.y), sum(image.u), sum(image.v), sum(image.a)});
    }
    return sums;
}

}  // namespace rs::golden
