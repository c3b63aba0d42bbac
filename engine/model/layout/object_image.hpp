#pragma once
// Object in the layout of the board's disk and memory: images column by column, alpha in 2 bits, the RS map a byte per
// cell, cameras and lines in records (layouts: image_scan.hpp and line_reader.hpp).

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

// Sets the registers of the object's RS map.
void set_map_registers(const RaySpaceObject& object, ObjectRegisters& registers);

// Fails if images are not loaded as Y, U and V at half size, and alpha.
Status has_raw_images(const RaySpaceObject& object);

// Bytes of board memory of an object; planes of images and maps are stored without gaps.
struct BoardFootprint {
    std::uint64_t luma_bytes = 0;
    std::uint64_t chroma_bytes = 0;
    std::uint64_t alpha_bytes = 0;
    std::uint64_t map_bytes = 0;    // one byte per cell: at most 120 images and "none"
    std::uint64_t lines_bytes = 0;  // 16 bytes per view, 16 per view and plane
    // Coded images (coded_layout.hpp), instead of luma, chroma and alpha.
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

// Memory layout of objects on boards of one kind. Stateless; thread-safe.
class ObjectLayout {
public:
    ObjectLayout() = default;
    ObjectLayout(const ObjectLayout&) = delete;
    ObjectLayout& operator=(const ObjectLayout&) = delete;
    virtual ~ObjectLayout() = default;

    // Bytes of the object in board memory; boards of coded images require all images loaded.
    [[nodiscard]] virtual BoardFootprint footprint(const RaySpaceObject& object) const = 0;
    // Fails with the limit that the objects exceed together, including the image buffer for a full cycle of views.
    [[nodiscard]] Status fit_together(std::span<const RaySpaceObject> objects, const BoardLimits& limits) const;
    // fit_together() and within_limits() for a single object.
    [[nodiscard]] Status fits(const RaySpaceObject& object, const BoardLimits& limits) const;

    // Fails if the board cannot hold or render the object, with reason and remedy: it does not fit, it has a shape map,
    // or its images are not loaded or not of the board's kind.
    [[nodiscard]] virtual Status drawable(const RaySpaceObject& object, const BoardLimits& limits) const = 0;
    // The object that is actually rendered; bit equality refers to it.
    [[nodiscard]] virtual RaySpaceObject as_rendered(RaySpaceObject object) const { return object; }
    // Words per region of a drawable object, and their contents.
    [[nodiscard]] virtual std::array<std::uint64_t, kObjectRegions> words(const RaySpaceObject& object) const = 0;
    [[nodiscard]] virtual ObjectImage image(const RaySpaceObject& object, const Placement& placement) const = 0;
};
const ObjectLayout& layout_of(BoardKind kind);

// Alpha rounded to 2 bits, as boards of BoardKind::raw_images hold it.
RaySpaceObject with_board_alpha(RaySpaceObject object);

// Images of profile `board` (coded_layout.hpp), defined in coded_object_image.cpp.

// Fails if not all images of the object are loaded, or if they do not have profile `board`; the message names the
// remedy.
Status has_board_images(const RaySpaceObject& object);

// Words per region for images and codebooks only.
std::array<std::uint64_t, kObjectRegions> coded_words(const codec::CodedImages& coded);

// Adds the segments and sets the registers of the images. `books`: address of the codebooks.
void add_coded_images(const codec::CodedImages& coded, const Placement& placement, WordAddress books,
                      ObjectRegisters& registers, std::vector<MemorySegment>& segments);

// Layout of every memory channel of a parallel board (parallel_layout.hpp), defined in parallel_object_image.cpp.

// Words per region. Region::flat_tiles also holds raw images.
std::array<std::uint64_t, kObjectRegions> parallel_object_words(const RaySpaceObject& object);

// `object` must be drawable by a parallel board.
ObjectImage parallel_object_image(const RaySpaceObject& object, const Placement& placement);

}  // namespace rs::engine::model
