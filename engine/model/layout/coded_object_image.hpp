#pragma once
// Images of profile `board` in the layout of the board's disk and memory (coded_layout.hpp).

#include "engine/model/blocks/memory/disk_controller.hpp"
#include "engine/model/layout/memory_map.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <array>
#include <vector>

namespace rs::engine::model {

// Fails if not all images of the object are loaded, or if they do not have profile `board`; the message names the
// remedy.
Status has_board_images(const RaySpaceObject& object);

// Words per region for images and codebooks only.
std::array<std::uint64_t, kObjectRegions> coded_words(const codec::CodedImages& coded);

// Adds the segments and sets the registers of the images. `books`: address of the codebooks.
void add_coded_images(const codec::CodedImages& coded, const Placement& placement, WordAddress books,
                      ObjectRegisters& registers, std::vector<MemorySegment>& segments);

}  // namespace rs::engine::model
