#pragma once
// An object as it lies on the board's disk and in its memory: images column by column, alpha in 2 bits, the RS map a
// byte per cell, cameras and lines in records (the layouts stand in image_scan.hpp and line_reader.hpp).

#include "engine/model/blocks/memory/disk_controller.hpp"
#include "engine/model/layout/memory_map.hpp"
#include "engine/model/limits/board_limits.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace rs::engine::model {

inline constexpr int kAlphaBits = 2;

// The numbers of its RS map.
void set_map_registers(const RaySpaceObject& object, ObjectRegisters& registers);

// Fails where images are not there as Y, U and V at half size, and alpha.
Status has_raw_images(const RaySpaceObject& object);

// Bytes of board memory that an object takes; planes of images and maps are stored without gaps.
struct BoardFootprint {
    std::uint64_t luma_bytes = 0;
    std::uint64_t chroma_bytes = 0;
    std::uint64_t alpha_bytes = 0;
    std::uint64_t map_bytes = 0;    // one byte per cell: at most 120 images and "none"
    std::uint64_t lines_bytes = 0;  // 16 bytes per view, 16 per view and plane
    // Of coded images (coded_layout.hpp), instead of luma, chroma and alpha.
    std::uint64_t tile_bytes = 0;
    std::uint64_t tile_table_bytes = 0;
    std::uint64_t book_bytes = 0;
    std::uint64_t shape_bytes = 0;  // cells of shape maps
    [[nodiscard]] std::uint64_t total_bytes() const {
        return luma_bytes + chroma_bytes + alpha_bytes + map_bytes + lines_bytes + tile_bytes + tile_table_bytes +
               book_bytes + shape_bytes;
    }
};

struct ObjectImage {
    ObjectRegisters registers;
    std::vector<MemorySegment> segments;
};

// How boards of one kind hold objects. Pure; thread-safe.
class ObjectLayout {
public:
    ObjectLayout() = default;
    ObjectLayout(const ObjectLayout&) = delete;
    ObjectLayout& operator=(const ObjectLayout&) = delete;
    virtual ~ObjectLayout() = default;

    // Bytes that the object takes; of a board of coded images it has them, all loaded.
    [[nodiscard]] virtual BoardFootprint footprint(const RaySpaceObject& object) const = 0;
    // Fails with the limit that the objects exceed together, with the image buffer for a full cycle of views.
    [[nodiscard]] Status fit_together(std::span<const RaySpaceObject> objects, const BoardLimits& limits) const;
    // The same of one, which is within_limits() as well.
    [[nodiscard]] Status fits(const RaySpaceObject& object, const BoardLimits& limits) const;

    // Fails where a board cannot hold or draw the object, with the reason and the remedy: it does not fit, it has a
    // shape map, or its images are not loaded, or not of the board's kind.
    [[nodiscard]] virtual Status drawable(const RaySpaceObject& object, const BoardLimits& limits) const = 0;
    // The object that is really drawn. Bit equality is with this one.
    [[nodiscard]] virtual RaySpaceObject as_rendered(RaySpaceObject object) const { return object; }
    // Of a drawable object: words per region that it takes, and what stands in them.
    [[nodiscard]] virtual std::array<std::uint64_t, kObjectRegions> words(const RaySpaceObject& object) const = 0;
    [[nodiscard]] virtual ObjectImage image(const RaySpaceObject& object, const Placement& placement) const = 0;
};
const ObjectLayout& layout_of(BoardKind kind);

// Alpha rounded to 2 bits, as boards of BoardKind::raw_images hold it.
RaySpaceObject with_board_alpha(RaySpaceObject object);

}  // namespace rs::engine::model
