#include "compositor/gpu/shader/texture_layout.hpp"

#include "compositor/gpu/shader/reconstruction_shader.hpp"
#include "rayspace/base/parallel_loop.hpp"

#include <algorithm>
#include <cstddef>
#include <string>

namespace rs::compositor {
namespace {

constexpr std::int64_t kBytesPerPhotoTexel = 5;  // RGBA and detail

}  // namespace

std::int64_t cell_texture_rows(const ShapeMap& shape) {
    if (shape.cells.empty()) return 1;
    const std::int64_t pairs = static_cast<std::int64_t>(shape.cells.size()) / shape.bands * (shape.bands + 2);
    return (pairs + kCellTextureWidth - 1) / kCellTextureWidth;
}

std::vector<CellPair> cell_pairs(const ShapeMap& shape) {
    std::vector<CellPair> pairs(static_cast<std::size_t>(cell_texture_rows(shape)) * kCellTextureWidth);
    if (shape.cells.empty()) return pairs;
    const auto bands = static_cast<std::size_t>(shape.bands);
    for_each_index(shape.cells.size() / bands, [&](std::size_t column) {
        const ShapeCell* const cells = shape.cells.data() + column * bands;
        CellPair* const first = pairs.data() + column * (bands + 2);
        for (std::size_t band = 0; band < bands; ++band) {
            const ShapeCell cell = cells[band].has_surface() ? cells[band] : ShapeCell{};
            first[band][2] = first[band + 1][0] = cell.depth;
            first[band][3] = first[band + 1][1] = cell.shown;
        }
    });
    return pairs;
}

std::int64_t gpu_bytes(const RaySpaceObject& object, int photos) {
    std::int64_t bytes = std::int64_t{photos} * object.width * object.height * kBytesPerPhotoTexel;
    for (const Ring& ring : object.rings) {
        bytes += cell_texture_rows(ring.shape) * kCellTextureWidth * std::int64_t{sizeof(CellPair)};
    }
    return bytes;
}

Status check_texture_limits(const RaySpaceObject& object, int photos, int max_side, int max_layers) {
    const auto refused = [&](const std::string& what, std::int64_t count, int limit) {
        return Error{object.name + ": " + what + " " + std::to_string(count) + " exceeds the driver's limit of " +
                     std::to_string(limit) + "; encode it with fewer or smaller photos"};
    };
    if (photos > max_layers) return refused("the number of photos", photos, max_layers);
    const int side = std::max(object.width, object.height);
    if (side > max_side) return refused("the side of the photos of", side, max_side);
    for (const Ring& ring : object.rings) {
        const std::int64_t rows = cell_texture_rows(ring.shape);
        if (rows > max_side) return refused("a shape map with texture rows of", rows, max_side);
    }
    return {};
}

}  // namespace rs::compositor
