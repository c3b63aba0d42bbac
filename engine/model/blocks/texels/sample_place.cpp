#include "engine/model/blocks/texels/sample_place.hpp"

#include "engine/core/definition/fixed_point.hpp"
#include "engine/core/definition/shape_pixel.hpp"

#include <algorithm>

namespace rs::engine::model {
namespace {

constexpr std::int32_t narrow(std::int64_t value) {
    return static_cast<std::int32_t>(value);
}

void place_texels(PlacedSample& out, std::int32_t column_q8, std::int32_t row_q8, const ObjectRegisters& object) {
    const int x_q3 = (column_q8 - 112) >> 5;
    const int y_q3 = (row_q8 - 112) >> 5;
    out.inside = true;
    out.left = std::max(x_q3 >> 3, 0);
    out.top = std::max(y_q3 >> 3, 0);
    out.right_is_left = std::min((x_q3 >> 3) + 1, object.width - 1) == out.left;
    out.bottom_is_top = std::min((y_q3 >> 3) + 1, object.height - 1) == out.top;
    out.fx = x_q3 & 7;
    out.fy = y_q3 & 7;
}

void place_in_image(PlacedSample& out, const ImageSetup& image, int d_q3, std::int32_t y_q16,
                    const ObjectRegisters& object) {
    constexpr std::int64_t kNearest_q20 = std::int64_t{1} << 17;
    out.image = image.image;
    const std::int64_t l_q20 = image.l0_q20 + ((d_q3 * image.l1_q24) >> 7);
    if (l_q20 < kNearest_q20) return;
    const auto inverse_q20 = narrow(divide(std::int64_t{1} << 40, l_q20).value);
    const std::int32_t q_q12 = narrow(image.q0_q12 + ((d_q3 * image.q1_q12) >> 3));
    const std::int32_t column_q8 = (image.cx_q16 >> 8) + multiply_shift(q_q12, inverse_q20, 24);
    const std::int32_t m_q12 = multiply_shift(image.fl_y_q16 >> 8, inverse_q20, 16);
    const std::int32_t row_q8 = (image.cy_q16 >> 8) - multiply_shift(m_q12, y_q16 - (image.height_q20 >> 4), 20);
    if (column_q8 < 0 || column_q8 >= object.width << 8 || row_q8 < 0 || row_q8 >= object.height << 8) return;
    place_texels(out, column_q8, row_q8, object);
}

}  // namespace

SurfaceSamples place_samples(const SurfaceHit& met, const ColumnSetup& column, const ObjectRegisters& object,
                             std::int32_t b_q20) {
    SurfaceSamples samples;
    PlacedSample blank;
    blank.view = met.pixel.view;
    blank.head.id = met.pixel.id;
    blank.head.final = met.final;
    blank.head.next = met.next;
    if (column.kind == RayKind::plane) {  // one texel, unfiltered
        PlacedSample& out = samples.sample[static_cast<std::size_t>(samples.count++)] = blank;
        const std::int64_t row = (column.row_0_q16 + met.pixel.row * column.row_step_q16) >> 16;
        out.head.is_there = true;
        out.image = column.image;
        out.inside = row >= 0 && row < object.height;
        out.left = column.image_column;
        out.top = static_cast<int>(out.inside ? row : 0);
    } else {
        blank.head.weight = apply_lean(column.weight, met.lean);
        const std::int64_t lambda_q20 = column.lambda0_q20 + ((met.depth_q3 * column.lambda1_q21) >> 4);
        const std::int32_t y_q16 = (b_q20 >> 4) + multiply_shift(narrow(lambda_q20), met.pixel.rise_q24, 28);
        for (int second = 0; second < 2; ++second) {
            if (lambda_q20 <= 0 || column.weight == (second == 0 ? 256 : 0)) continue;
            PlacedSample& out = samples.sample[static_cast<std::size_t>(samples.count++)] = blank;
            out.head.is_there = true;
            out.head.second = second == 1;
            place_in_image(out, column.images[static_cast<std::size_t>(second)], met.depth_q3, y_q16, object);
        }
    }
    if (samples.count == 0) samples.sample[static_cast<std::size_t>(samples.count++)] = blank;
    samples.sample[static_cast<std::size_t>(samples.count) - 1].head.last = true;
    return samples;
}

SamplePlace::SamplePlace(const RegisterFile& registers, const Ports& ports)
    : Block("sample_place", "latency " + std::to_string(kStages + 1) + ", a sample per cycle"),
      registers_(registers),
      columns_(reads(ports.columns)),
      in_(reads(ports.in)),
      stage_(kStages, writes(ports.out)) {}

Activity SamplePlace::tick(std::uint64_t) {
    if (columns_.can_pop()) table_.put(columns_.pop());
    return stage_.step([&](std::optional<PlacedSample>& sample) {
        if (!in_.can_pop()) return Activity::idle;
        if (taken_ == 0) {
            const SurfaceHit& met = in_.front();
            RS_CHECK(table_.holds(met.pixel));
            surface_ = place_samples(met, table_.of(met.pixel), registers_.object_of(met.pixel.view),
                                     registers_.view(met.pixel.view).b_q20);
        }
        sample = surface_.sample[static_cast<std::size_t>(taken_)];
        if (++taken_ == surface_.count) {
            in_.pop();
            taken_ = 0;
        }
        return Activity::busy;
    });
}

}  // namespace rs::engine::model
