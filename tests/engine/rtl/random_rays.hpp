#pragma once
// Random rays of columns, on their way through the blocks that set up a column.

#include "engine/model/signals/parallel_messages.hpp"
#include "tests/engine/rtl/random_registers.hpp"

#include <algorithm>

namespace rs::engine::rtl {

/// A ray with the line of its photo. Most lines meet the photo, or pass it by a few columns.
inline model::RayLine random_line(const model::RegisterFile& registers, Random& random) {
    const auto number = [&](int width_bits) { return static_cast<std::int32_t>(random.of_any_length(width_bits)); };
    model::RayLine line;
    line.view = random_view(registers, random);
    line.has_ray = random.chance(0.95);
    if (!line.has_ray) return line;
    const model::ObjectRegisters& object = registers.object_of(line.view);
    line.x_q20 = random.of_any_length(22);
    line.lambda_q20 = random.in(0, (std::int64_t{1} << random.in(10, 29)) - 1);
    line.image = static_cast<int>(random.in(0, object.images - 1));
    line.cy_q16 = number(31);
    line.fl_y_q16 = number(30);
    line.height_q20 = number(29);
    line.l1_q30 = number(31);
    line.q1_q16 = number(31);
    const std::int64_t l_q20 = (1 << 17) + random.in(-2, std::int64_t{1} << random.in(2, 28));
    line.l0_q20 = static_cast<std::int32_t>(l_q20 - ((line.x_q20 * line.l1_q30) >> 30));
    line.cx_q16 = static_cast<std::int32_t>(random.in(0, std::int64_t{object.width} << 16));
    const std::int64_t column_q16 = random.in(-2 * 65536, (std::int64_t{object.width} + 2) << 16);
    const std::int64_t lateral_q16 = ((column_q16 - line.cx_q16) * l_q20) >> 20;
    line.q0_q16 =
        random.chance(0.1) ? number(31) : static_cast<std::int32_t>(lateral_q16 - ((line.x_q20 * line.q1_q16) >> 20));
    return line;
}

/// A ray of any kind. The lines of its gap are some of those of the object's shape map, if it has any.
inline model::BracketedRay random_bracketed_ray(const model::RegisterFile& registers, Random& random) {
    model::BracketedRay ray;
    ray.view = random_view(registers, random);
    const model::ObjectRegisters& object = registers.object_of(ray.view);
    const auto image = [&] { return static_cast<int>(random.in(0, object.images - 1)); };
    const auto length = [&](int most_bits) { return random.in(1, (std::int64_t{1} << random.in(1, most_bits)) - 1); };
    ray.kind = static_cast<model::RayKind>(random.in(0, 3));
    ray.plane = static_cast<int>(random.in(0, object.planes - 1));
    ray.x_q20 = random.of_any_length(22);
    ray.lambda_q20 = random.in(0, (1 << 29) - 1);
    ray.n_q28 = random.in(1 << 24, (std::int64_t{1} << random.in(25, 31)) - 1);
    ray.t_q28 = random.of_any_length(32);
    ray.first = image();
    ray.second = image();
    ray.width_q20 = length(31);
    ray.from_first_q20 = random.chance(0.2) ? ray.width_q20 - 1 : random.in(0, ray.width_q20 - 1);
    ray.lines = static_cast<int>(std::min<std::int64_t>(length(11), 1024));
    const std::int64_t last_first_line = std::max<std::int64_t>(0, object.shape.lines - ray.lines);
    ray.first_line = random.chance(0.2) ? 0 : random.chance(0.2) ? last_first_line : random.in(0, last_first_line);
    ray.lines_before = random.chance(0.5);
    ray.lines_behind = random.chance(0.5);
    return ray;
}

}  // namespace rs::engine::rtl
