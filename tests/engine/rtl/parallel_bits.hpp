#pragma once
// Messages of a pipe of `parallel` as packed structures of engine/rtl/messages.svh.

#include "engine/model/signals/parallel_messages.hpp"
#include "tests/engine/rtl/bits.hpp"

namespace rs::engine::rtl {

inline BitsWriter& put(BitsWriter& writer, const model::SampleHead& m) {
    return writer.put(m.id, 9)
        .put(m.is_there, 1)
        .put(m.second, 1)
        .put(m.weight, 9)
        .put(m.last, 1)
        .put(m.final, 1)
        .put(m.next.begin, 9);
}
inline Bits pack(const model::PatchJob& m) {
    return BitsWriter(m.kBits)
        .put(m.view, 4)
        .put(m.slot, 2)
        .put(m.first_column / model::kStripeColumns, 5)
        .put(m.first_row / model::kPatchRows, 6)
        .put(m.columns, 5)
        .put(m.rows, 4)
        .put(m.ends_stripe, 1)
        .put(m.ends_view, 1)
        .bits();
}
inline BitsWriter& put(BitsWriter& writer, const model::ScannedPixel& m) {
    return writer.put(m.id, 9).put(m.view, 4).put(m.stripe, 2).put(m.row, 9).put(m.rise_q24, 28);
}
inline Bits pack(const model::ScannedPixel& m) {
    BitsWriter writer(m.kBits);
    return put(writer, m).bits();
}
inline Bits pack(const model::PixelBandRay& m) {
    BitsWriter writer(m.kBits);
    return put(writer, m.pixel).put(m.foot_q12, 30).put(m.per_d_q20, 24).bits();
}
inline Bits pack(const model::SurfaceHit& m) {
    BitsWriter writer(m.kBits);
    return put(writer, m.pixel).put(m.depth_q3, 11).put(m.final, 1).put(m.next.begin, 9).put(m.lean, 5).bits();
}
// An empty pixel is its number alone.
inline Bits pack(const model::FinishedPixel& m, int width_bits) {
    BitsWriter writer(width_bits);
    writer.put(m.id, 9);
    return width_bits == m.kBitsOfEmpty ? writer.bits() : writer.put(m.rgba, 32).bits();
}
inline Bits pack(const model::ReturnedPixel& m) {
    return BitsWriter(m.kBits).put(m.id, 9).put(m.state.begin, 9).bits();
}
inline Bits pack(const model::TexelFill& m) {
    return BitsWriter(m.kBits)
        .put(m.view, 4)
        .put(m.image, 7)
        .put(m.block_column, 6)
        .put(m.block_row, 6)
        .put(m.line, 7)
        .put(m.guard, 10)
        .bits();
}
inline Bits pack(const model::FillTarget& m) {
    return BitsWriter(m.kBits).put(m.line, 7).put(m.guard, 10).bits();
}
inline Bits pack(const model::FillKind& m) {
    return BitsWriter(m.kBits).put(m.coded, 1).bits();
}
inline Bits pack(const model::TexelQuad& m) {
    BitsWriter writer(m.kBits);
    put(writer, m.head).put(m.inside, 1).put(m.fx, 3).put(m.fy, 3);
    for (std::size_t n = m.rgba.size(); n-- > 0;) writer.put(m.rgba[n], 32);
    return writer.bits();
}
inline Bits pack(const model::FilteredSample& m) {
    BitsWriter writer(m.kBits);
    return put(writer, m.head).put(m.inside, 1).put(m.a, 14).put(m.r, 22).put(m.g, 22).put(m.b, 22).bits();
}
inline BitsWriter& put(BitsWriter& writer, const model::BracketedRay& m) {
    return writer.put(m.view, 4)
        .put(static_cast<int>(m.kind), 2)
        .put(m.plane, 4)
        .put(m.x_q20, 23)
        .put(m.lambda_q20, 29)
        .put(m.n_q28, 31)
        .put(m.t_q28, 32)
        .put(m.first, 7)
        .put(m.second, 7)
        .put(m.from_first_q20, 31)
        .put(m.width_q20, 31)
        .put(m.lines, 11)
        .put(m.first_line, 27)
        .put(m.lines_before, 1)
        .put(m.lines_behind, 1);
}
inline Bits pack(const model::BracketedRay& m) {
    BitsWriter writer(m.kBits);
    return put(writer, m).bits();
}
inline Bits pack(const model::RayWithLines& m) {
    BitsWriter writer(m.kBits);
    put(writer, m.ray);
    for (const model::ImageLine& line : m.image) {
        for (const std::int32_t value : {line.cx_q16, line.cy_q16, line.fl_y_q16, line.height_q20, line.l0_q20,
                                         line.l1_q30, line.q0_q16, line.q1_q16, line.l2_q30, line.q2_q16}) {
            writer.put(value, 32);
        }
    }
    return writer.bits();
}
inline BitsWriter& put(BitsWriter& writer, const model::ImageSetup& m) {
    return writer.put(m.image, 7)
        .put(m.l0_q20, 30)
        .put(m.l1_q24, 20)
        .put(m.q0_q12, 31)
        .put(m.q1_q12, 22)
        .put(m.cx_q16, 31)
        .put(m.cy_q16, 31)
        .put(m.fl_y_q16, 31)
        .put(m.height_q20, 29);
}
// All of it, or the part that a block stores; that of sample_place has the image of an object without a shape map as
// its first one.
inline Bits pack(const model::ColumnSetup& m, int width_bits) {
    BitsWriter writer(width_bits);
    writer.put(m.view, 4).put(static_cast<int>(m.kind), 2).put(m.stripe, 2).put(m.column, 4);
    if (width_bits == m.kRiseBits) {
        return writer.put(m.lambda_foot_q20, 30).put(m.inverse_r_q20, 25).put(m.inverse_rho_q20, 22).bits();
    }
    if (width_bits == m.kMarchBits) {
        return writer.put(m.weight, 9).put(m.line_part, 3).put(m.p_part, 3).put(m.same_cells, 1).bits();
    }
    if (width_bits == m.kPlaceBits) {
        model::ImageSetup first = m.images[0];
        if (m.kind == model::RayKind::plane) first.image = m.image;
        writer.put(m.row_0_q16, 46).put(m.row_step_q16, 36).put(m.image_column, 9);
        return put(put(writer, m.images[1]), first)
            .put(m.weight, 9)
            .put(m.lambda0_q20, 31)
            .put(m.lambda1_q21, 22)
            .bits();
    }
    writer.put(m.image, 7).put(m.image_column, 9).put(m.row_0_q16, 46).put(m.row_step_q16, 36);
    put(put(writer, m.images[1]), m.images[0]).put(m.weight, 9);
    writer.put(m.lambda_foot_q20, 30).put(m.lambda0_q20, 31).put(m.lambda1_q21, 29);
    writer.put(m.inverse_r_q20, 25).put(m.inverse_rho_q20, 22);
    writer.put(m.map_line[1], 27).put(m.map_line[0], 27).put(m.map_place[1], 13).put(m.map_place[0], 13);
    return writer.put(m.line_part, 3).put(m.p_part, 3).bits();
}
inline Bits pack(const model::PlacedSample& m) {
    BitsWriter writer(m.kBits);
    return put(writer, m.head)
        .put(m.view, 4)
        .put(m.inside, 1)
        .put(m.image, 7)
        .put(m.left, 9)
        .put(m.top, 9)
        .put(m.fx, 3)
        .put(m.fy, 3)
        .put(m.right_is_left, 1)
        .put(m.bottom_is_top, 1)
        .bits();
}
inline Bits pack(const model::WaitingSample& m) {
    BitsWriter writer(m.kBits);
    put(writer, m.head).put(m.inside, 1).put(m.fx, 3).put(m.fy, 3);
    for (std::size_t n = m.line.size(); n-- > 0;) writer.put(m.line[n], 7);
    for (std::size_t n = m.texel.size(); n-- > 0;) writer.put(m.texel[n], 6);
    return writer.put(m.fills, 3).bits();
}

}  // namespace rs::engine::rtl
