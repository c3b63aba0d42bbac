#pragma once
// A RaySpaceObject to and from an .rso file. Format, chunk by chunk, with every bound: encode/FORMAT.md.

#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/format/container.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <filesystem>

namespace rs {

// Everything a reader relies on: sizes and counts within the caps, every map cell empty or a view of its ring that has
// some of the cell before it, every view in one ring, the bit widths of the arithmetic (engine/RECONSTRUCTION.md,
// section "Ranges"; the full list is FORMAT.md's section "Ranges"), rig_json empty or a rig with one frame per view.
// Images may be missing. `where` names the object in the error. Cost: one look at every map cell, shape maps' too.
Status validate_object(const RaySpaceObject& object, const std::string& where);

// All images must be there, and validate_object() must pass. Images are written in progressive order. The same
// object gives the same bytes (one with a shape map: from the same version of libzstd).
Status write_object(const std::filesystem::path& path, const RaySpaceObject& object, Progress* progress = nullptr);

struct ReadObjectOptions {
    int max_level = kProgressiveLevels - 1;                   // images of higher progressive levels stay empty
    std::uint64_t memory_cap_bytes = std::uint64_t{8} << 30;  // refuse objects that would need more
    bool decode = true;  // unpack coded images into `images`; else they are left empty, and `coded` alone has them
};
// The result has passed validate_object(); shape maps are read at every level. Chunks of images that are not wanted
// are not touched, and so not checked.
Result<RaySpaceObject> read_object(const std::filesystem::path& path, const ReadObjectOptions& options = {});
Result<RaySpaceObject> read_object(const ContainerReader& container, const ReadObjectOptions& options = {});

// What a file holds, without its images: for `rs-encode info`.
struct ChunkSummary {
    std::string name;
    std::uint64_t count = 0;
    std::uint64_t size_bytes = 0;
};
std::vector<ChunkSummary> summarise_chunks(const ContainerReader& container);

}  // namespace rs
