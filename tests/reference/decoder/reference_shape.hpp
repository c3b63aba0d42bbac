#pragma once
// FORMAT.md, "shap" and its numbers of "Ranges": the fields, the cells, and everything that must be rejected.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace rs::reference {

struct ShapeSurface {
    int depth = 0;
    int shown = 0;
};

struct Shape {
    int jump = 0;
    int thickness = 0;
    int p_cells = 0;
    int bands = 0;
    std::array<std::int32_t, 8> numbers{};              // p_half .. depth_step, in the order of the table
    std::vector<int> lines;                             // S_n
    std::vector<std::array<std::int32_t, 4>> normal;    // [n * K + k]: l2, q2, a, c
    std::vector<std::optional<ShapeSurface>> surfaces;  // [cell]
};

/// Returns the rule that the payload violates; "" if there is none. `views` and `planes` are those of the ring.
[[nodiscard]] std::string read_shape(std::span<const std::uint8_t> payload, int views, int planes, Shape& shape);

}  // namespace rs::reference
