#include "engine/model/blocks/parallel/pixel_rays.hpp"
#include "engine/core/definition/fixed_point.hpp"

#include <algorithm>

namespace rs::engine::model {

PixelScan::PixelScan(const RegisterFile& registers, const StripeShare& share, const Ports& ports)
    : Block("pixel_scan", "1 cycle to begin a view, then a pixel per cycle"),
      registers_(registers),
      share_(share),
      jobs_(reads(ports.jobs)),
      patch_free_(reads(ports.patch_free)),
      view_done_(reads(ports.view_done)),
      patches_(writes(ports.patches)),
      pixels_(writes(ports.pixels)) {}

bool PixelScan::begin_patch() {
    if (free_patches_ == 0 || !patches_.can_push()) return false;
    const BoardView& view = registers_.view(view_);
    patch_ = {view_,
              slot_,
              first_column_,
              first_row_,
              std::min(kStripeColumns, view.width - first_column_),
              std::min(kPatchRows, view.height - first_row_),
              first_row_ + kPatchRows >= view.height,
              false};
    patch_.ends_view = patch_.ends_stripe && first_column_ + share_.pipes * kStripeColumns >= view.width;
    patches_.push(patch_);
    --free_patches_;
    if (first_row_ == 0) rise_q32_ = view.s0_q32;
    column_ = row_ = 0;
    return in_patch_ = true;
}

void PixelScan::end_patch() {
    in_patch_ = false;
    slot_ = (slot_ + 1) % kPatchSlots;
    first_row_ += kPatchRows;
    if (!patch_.ends_stripe) return;
    first_row_ = 0;
    first_column_ += share_.pipes * kStripeColumns;
    stripe_ = (stripe_ + 1) % kStripeNumbers;
    active_ = !patch_.ends_view;
}

Activity PixelScan::tick(std::uint64_t) {
    if (patch_free_.can_pop()) {
        patch_free_.pop();
        ++free_patches_;
    }
    if (view_done_.can_pop()) {
        view_done_.pop();
        --views_;
    }
    if (!active_) {
        if (!jobs_.can_pop()) return Activity::idle;
        if (views_ == kMaxViews) return Activity::output_full;
        view_ = jobs_.pop().view;
        ++views_;
        first_column_ = share_.first_column(view_);
        first_row_ = 0;
        active_ = true;
        return Activity::busy;
    }
    if (!pixels_.can_push() || (!in_patch_ && !begin_patch())) return Activity::output_full;
    ScannedPixel pixel;
    pixel.id = slot_ * kPatchPixels + row_ * kStripeColumns + column_;
    pixel.view = view_;
    pixel.stripe = stripe_;
    pixel.row = first_row_ + row_;
    pixel.rise_q24 = static_cast<std::int32_t>(rise_q32_ >> 8);
    pixels_.push(pixel);
    if (++column_ == patch_.columns) {
        column_ = 0;
        rise_q32_ += registers_.view(view_).sy_q32;
        if (++row_ == patch_.rows) end_patch();
    }
    return Activity::busy;
}

PixelBandRay pixel_band_ray(const ScannedPixel& pixel, const ColumnSetup& column, const ShapeRegisters& shape,
                            std::int32_t b_q20) {
    constexpr std::int32_t kMostPerDepth_q20 = 1 << 22;
    PixelBandRay out;
    out.pixel = pixel;
    if (column.kind != RayKind::shape) return out;
    const auto narrow = [](std::int64_t v) { return static_cast<std::int32_t>(v); };
    const std::int32_t h_q16 = (b_q20 >> 4) + multiply_shift(narrow(column.lambda_foot_q20), pixel.rise_q24, 28);
    const std::int32_t slope_q20 = multiply_shift(pixel.rise_q24, narrow(column.inverse_r_q20), 24);
    const std::int32_t reference_q20 =
        multiply_shift(h_q16 - (shape.reference_height_q20 >> 4), narrow(column.inverse_rho_q20), 16);
    const std::int32_t drift_q20 = multiply_shift(slope_q20 - reference_q20, shape.bands_per_unit_q12, 12);
    out.foot_q12 = multiply_shift(h_q16 - (shape.h_low_q20 >> 4), shape.bands_per_unit_q12, 16);
    out.per_d_q20 =
        std::clamp(multiply_shift(drift_q20, shape.depth_step_q24, 24), -kMostPerDepth_q20, kMostPerDepth_q20);
    return out;
}

RayRise::RayRise(const RegisterFile& registers, const Ports& ports)
    : Block("ray_rise", "latency " + std::to_string(kStages + 1) + ", a pixel per cycle"),
      registers_(registers),
      columns_(reads(ports.columns)),
      in_(reads(ports.in)),
      stage_(kStages, writes(ports.out)) {}

Activity RayRise::tick(std::uint64_t) {
    const bool stores_column = columns_.can_pop();
    if (stores_column) table_.put(columns_.pop());
    const Activity activity = stage_.step([&](std::optional<PixelBandRay>& ray) {
        if (!in_.can_pop() || stores_column || !table_.holds(in_.front()))
            return Activity::idle;  // the table has one port
        const ScannedPixel pixel = in_.pop();
        ray = pixel_band_ray(pixel, table_.of(pixel), registers_.object_of(pixel.view).shape,
                             registers_.view(pixel.view).b_q20);
        return Activity::busy;
    });
    return stores_column ? Activity::busy : activity;
}

}  // namespace rs::engine::model
