#pragma once
// Expected samples of the golden files: XXH64 (seed 0) of every plane of every image.

#include "rayspace/format/container.hpp"
#include "rayspace/object/ray_space_object.hpp"
#include "tests/reference/decoder/reference_decoder.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace rs::golden {

/// Hashes of Y, U, V and alpha, row by row without gaps, width x height samples; U and V of raw images have half the
/// width and height.
using PlaneSums = std::array<std::uint64_t, 4>;

struct FileSums {
    std::string error;
    std::vector<PlaneSums> views;
};

/// Computes the hashes with the reference decoder; for raw images from the bytes in the file.
[[nodiscard]] FileSums reference_sums(const ContainerReader& file);

/// Computes the hashes with the library, from the object's decoded images.
[[nodiscard]] std::vector<PlaneSums> object_sums(const RaySpaceObject& object);

/// Hash of a plane's first width x height samples.
[[nodiscard]] std::uint64_t plane_sum(ConstImageView<std::uint8_t> plane, int width, int height);

}  // namespace rs::golden
