#include "engine/model/limits/board_limits.hpp"

#include "engine/model/limits/coded_layout.hpp"
#include "engine/model/limits/parallel_layout.hpp"

#include <algorithm>

namespace rs::engine {
namespace {

Error over(const RaySpaceObject& object, const std::string& what, std::int64_t value, std::int64_t limit,
           const std::string& remedy) {
    return Error{object.name + ": " + what + " " + std::to_string(value) + ", more than the board's " +
                 std::to_string(limit) + "; " + remedy};
}

}  // namespace

BoardFootprint board_footprint(const RaySpaceObject& object, const BoardLimits& limits) {
    const std::uint64_t pictures = object.views.size();
    const auto pixels = static_cast<std::uint64_t>(object.width) * static_cast<std::uint64_t>(object.height);
    const auto chroma_pixels =
        static_cast<std::uint64_t>(half_size(object.width)) * static_cast<std::uint64_t>(half_size(object.height));
    BoardFootprint footprint;
    if (limits.any_object() && object.coded == nullptr) {
        footprint.luma_bytes = 8 * pictures * model::raw_picture_words(object.width, object.height);
    } else if (limits.unpacks()) {
        const codec::CodedPictures& coded = *object.coded;
        footprint.tile_bytes = 8 * (model::picture_words(coded, false) + model::picture_words(coded, true));
        footprint.tile_table_bytes = 8 * model::tile_table_words(coded);
        footprint.book_bytes = 8 * model::book_words(coded.board);
    } else {
        footprint.luma_bytes = pictures * pixels;
        footprint.chroma_bytes = pictures * 2 * chroma_pixels;
        footprint.alpha_bytes = pictures * ((pixels * static_cast<std::uint64_t>(limits.alpha_bits) + 7) / 8);
    }
    for (const Ring& ring : object.rings) {
        footprint.map_bytes += ring.cells.size();
        footprint.lines_bytes += ring.views.size() * 16 * (1 + static_cast<std::uint64_t>(ring.planes));
        if (!limits.any_object()) continue;
        footprint.lines_bytes += ring.views.size() * 16 * (1 + static_cast<std::uint64_t>(ring.planes));
        if (ring.shape.empty()) continue;
        const auto bands = static_cast<std::uint64_t>(ring.shape.bands);
        footprint.shape_bytes += ring.shape.cells.size() / bands * ((bands + 3) / 4) * 8;  // columns in whole words
    }
    return footprint;
}

Status fits_board(const RaySpaceObject& object, const BoardLimits& limits) {
    const auto pictures = static_cast<std::int64_t>(object.views.size());
    if (pictures > limits.pictures_per_object) {
        return over(object, "pictures:", pictures, limits.pictures_per_object, "take fewer views");
    }
    if (std::max(object.width, object.height) > limits.picture_side_px) {
        return over(object, "picture side:", std::max(object.width, object.height), limits.picture_side_px,
                    "scale the pictures down");
    }
    for (const Ring& ring : object.rings) {
        if (ring.planes > limits.planes) {
            return over(object, "reference planes:", ring.planes, limits.planes, "encode it with fewer --planes");
        }
        if (std::max(ring.x_cells, ring.u_cells) > limits.map_side) {
            return over(object, "RS map side:", std::max(ring.x_cells, ring.u_cells), limits.map_side,
                        "encode it with fewer --cells");
        }
        if (limits.any_object() && ring.shape.bands > limits.shape_bands) {
            return over(object, "bands of height in its shape map:", ring.shape.bands, limits.shape_bands,
                        "encode it from smaller pictures, or with --raymap plane");
        }
    }
    if (object.rings.size() > 1) {
        return over(object, "rings of views:", static_cast<std::int64_t>(object.rings.size()), 1,
                    "encode each ring as an object of its own");
    }
    return fit_board_together({&object, 1}, limits);
}

Status fit_board_together(std::span<const RaySpaceObject> objects, const BoardLimits& limits) {
    if (objects.size() > static_cast<std::size_t>(limits.objects)) {
        return Error{std::to_string(objects.size()) + " objects, more than the board's " +
                     std::to_string(limits.objects) + "; load fewer at a time"};
    }
    std::uint64_t needed_bytes = image_buffer_bytes(limits);
    for (const RaySpaceObject& object : objects) needed_bytes += board_footprint(object, limits).total_bytes();
    if (needed_bytes > limits.memory_bytes) {
        return Error{"the objects and the image buffer need " + std::to_string(needed_bytes) +
                     " bytes of board memory, more than its " + std::to_string(limits.memory_bytes) +
                     "; load fewer objects or encode them smaller"};
    }
    return {};
}

std::uint64_t image_buffer_bytes(const BoardLimits& limits) {
    const auto side = static_cast<std::uint64_t>(limits.image_buffer_side_px);
    return 2 * static_cast<std::uint64_t>(limits.views_per_cycle) * side * side * sizeof(Rgba8);
}

}  // namespace rs::engine
