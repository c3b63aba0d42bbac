#pragma once
// The images of profile `board` as the board's disk and memory hold them: coded_layout.hpp.

#include "engine/model/blocks/memory/disk_controller.hpp"
#include "engine/model/layout/memory_map.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <array>
#include <vector>

namespace rs::engine::model {

// Fails where the object's images are not all there, or are none of profile `board`, with the remedy.
Status has_board_images(const RaySpaceObject& object);

// Words per region, of the images and codebooks alone.
std::array<std::uint64_t, kObjectRegions> coded_words(const codec::CodedImages& coded);

// Adds the segments and sets the registers of the images. `books`: where the codebooks go.
void add_coded_images(const codec::CodedImages& coded, const Placement& placement, WordAddress books,
                      ObjectRegisters& registers, std::vector<MemorySegment>& segments);

}  // namespace rs::engine::model
