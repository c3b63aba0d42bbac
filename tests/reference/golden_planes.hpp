#pragma once
// The golden files' expected samples: XXH64 (seed 0) of every plane of every image.

#include "rayspace/format/container.hpp"
#include "rayspace/object/ray_space_object.hpp"
#include "tests/reference/decoder/reference_decoder.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace rs::golden {

// Of Y, U, V and alpha, row by row without gaps, width x height samples; U and V of raw images half as many each way.
using PlaneSums = std::array<std::uint64_t, 4>;

struct FileSums {
    std::string error;
    std::vector<PlaneSums> views;
};

// By the second decoder; of raw images of the bytes as they stand in the file.
[[nodiscard]] FileSums reference_sums(const ContainerReader& file);

// By the library: of the object's images, which are unpacked.
[[nodiscard]] std::vector<PlaneSums> object_sums(const RaySpaceObject& object);

// Of a plane's first width x height samples.
[[nodiscard]] std::uint64_t plane_sum(ConstImageView<std::uint8_t> plane, int width, int height);

}  // namespace rs::golden
