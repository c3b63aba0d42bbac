#include "datasets-synthetic/shapes/surfaces.hpp"

#include "datasets-synthetic/shapes/portable_math.hpp"
#include "rayspace/api/types/check.hpp"
#include "rayspace/base/conventions.hpp"

#include <utility>
#include <vector>

namespace rs::synthetic {
namespace {

using glm::vec2;

bool bends_sharply(vec2 before, vec2 here, vec2 after, float crease_rad) {
    const vec2 a = glm::normalize(here - before);
    const vec2 b = glm::normalize(after - here);
    return glm::dot(a, b) < portable::cos(crease_rad);
}

// The part of the profile between two creases; `lengths` are cumulative over the whole profile.
void append_smooth_section(capture::Mesh& mesh, std::span<const vec2> profile, std::span<const float> lengths,
                           float total_length, const LatheStyle& style) {
    Grid grid(style.segments, static_cast<int>(profile.size()) - 1, true);
    for (int j = 0; j <= grid.rows; ++j) {
        const vec2 p = profile[static_cast<std::size_t>(j)];
        const float share = lengths[static_cast<std::size_t>(j)] / total_length;
        const float v = style.v_range.x + (style.v_range.y - style.v_range.x) * share;
        for (int i = 0; i <= grid.columns; ++i) {
            const double angle_rad = 2.0 * kPi * i / style.segments;
            grid.positions[grid.index(i, j)] = {style.offset.x + p.x * static_cast<float>(portable::sin(angle_rad)),
                                                p.y,
                                                style.offset.y + p.x * static_cast<float>(portable::cos(angle_rad))};
            grid.uvs[grid.index(i, j)] = {static_cast<float>(i) / static_cast<float>(style.segments), v};
        }
    }
    append_grid(mesh, std::move(grid));
}

}  // namespace

void append_lathe(capture::Mesh& mesh, std::span<const vec2> profile, const LatheStyle& style) {
    RS_CHECK(profile.size() >= 2 && style.segments >= 3);
    std::vector<float> lengths{0.0F};
    for (std::size_t i = 1; i < profile.size(); ++i)
        lengths.push_back(lengths.back() + glm::length(profile[i] - profile[i - 1]));
    std::size_t start = 0;
    for (std::size_t i = 1; i < profile.size(); ++i) {
        const bool last = i + 1 == profile.size();
        if (!last && !bends_sharply(profile[i - 1], profile[i], profile[i + 1], style.crease_rad)) continue;
        const std::size_t count = i - start + 1;
        append_smooth_section(mesh, profile.subspan(start, count),
                              std::span<const float>(lengths).subspan(start, count), lengths.back(), style);
        start = i;
    }
}

}  // namespace rs::synthetic
