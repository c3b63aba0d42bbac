#pragma once
// Reads and writes a RaySpaceObject as an .rso file. Format, chunk by chunk, with every bound: encode/FORMAT.md.

#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/format/container.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace rs {

/// Checks everything that users of an object rely on: sizes and counts within the limits, every map cell empty or a
/// view of its ring with a part of the cell in front of it, every view in one ring, the bit widths of the arithmetic
/// (engine/RECONSTRUCTION.md, section "Ranges"; the full list is FORMAT.md's section "Ranges"), rig_json empty or a rig
/// with one frame per view. Images may be missing. `where` names the object in the error. Cost: one pass over all cells
/// of maps and shape maps.
Status validate_object(const RaySpaceObject& object, const std::string& where);

/// Writes an object that has all its images and passes validate_object(). Images are written in progressive order. The
/// same object gives the same bytes (with a shape map: for the same version of libzstd).
Status write_object(const std::filesystem::path& path, const RaySpaceObject& object, Progress* progress = nullptr);

struct ReadObjectOptions {
    int max_level = kProgressiveLevels - 1;                   // images of higher progressive levels stay empty
    std::uint64_t memory_cap_bytes = std::uint64_t{8} << 30;  // objects that need more are rejected
    bool decode = true;  // decode coded images into `images`; false: only `coded` is filled
};
/// Reads an object; the result has passed validate_object(). Shape maps are read at every level. Chunks of images above
/// max_level are neither read nor checked.
Result<RaySpaceObject> read_object(const std::filesystem::path& path, const ReadObjectOptions& options = {});
Result<RaySpaceObject> read_object(const ContainerReader& container, const ReadObjectOptions& options = {});

/// Memory of the whole object, for callers with a memory budget, including coded images even if they are shared.
/// Thread-safe.
std::int64_t object_memory_bytes(const RaySpaceObject& object);

/// Upper bounds of the memory for read_object(), close to the real values; computed without reading the images.
struct ReadMemory {
    std::int64_t most_bytes = 0;    // peak while reading
    std::int64_t object_bytes = 0;  // the object after reading; at least object_memory_bytes() it
    int width = 0;                  // px, of its images
    int height = 0;
    std::int64_t images = 0;
};
/// Reads the small chunks and the heads of shape maps. Errors as in read_object().
Result<ReadMemory> estimate_read_memory(const ContainerReader& container, const ReadObjectOptions& options = {});

/// Summary of a file's chunks, for `rs-encode info`.
struct ChunkSummary {
    std::string name;
    std::uint64_t count = 0;
    std::uint64_t size_bytes = 0;
};
std::vector<ChunkSummary> summarise_chunks(const ContainerReader& container);

}  // namespace rs
