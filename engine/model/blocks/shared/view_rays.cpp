#include "engine/model/blocks/shared/view_rays.hpp"

#include <algorithm>

namespace rs::engine::model {

RasterGenerator::RasterGenerator(const RegisterFile& registers, const StripeShare& share, const Ports& ports)
    : Block("raster_generator", "a column in K + 1 cycles for K planes; 1 cycle to begin a view"),
      registers_(registers),
      share_(share),
      jobs_(reads(ports.jobs)),
      columns_(writes(ports.columns)) {}

Activity RasterGenerator::tick(std::uint64_t) {
    if (!active_) {
        if (!jobs_.can_pop()) return Activity::idle;
        view_ = jobs_.pop().view;
        const BoardView& view = registers_.view(view_);
        for (std::size_t k = 0; k < kMaxPlanes; ++k) {
            n_q32_[k] = view.planes[k].n0_q32;
            t_q32_[k] = view.planes[k].t0_q32;
        }
        active_ = true;
        column_ = plane_ = 0;
        return Activity::busy;
    }
    const BoardView& view = registers_.view(view_);
    if (plane_ < registers_.object_of(view_).planes) {
        const auto k = static_cast<std::size_t>(plane_);
        const std::int64_t n_q28 = n_q32_[k] >> 4;
        if (plane_ == 0 || n_q28 < smallest_q28_) {
            smallest_q28_ = n_q28;
            best_ = {view_, false, plane_, -n_q28, t_q32_[k] >> 4};
        }
        n_q32_[k] += view.planes[k].nx_q32;
        t_q32_[k] += view.planes[k].tx_q32;
        ++plane_;
        return Activity::busy;
    }
    const bool owns = share_.owns_column(view_, column_);
    if (owns && !columns_.can_push()) return Activity::output_full;
    constexpr std::int64_t kMostEdgeOn_q28 = std::int64_t{1} << 24;
    best_.has_ray = view.planes[static_cast<std::size_t>(best_.plane)].c_q20 > 0 && best_.n_q28 >= kMostEdgeOn_q28;
    if (owns) columns_.push(best_);
    plane_ = 0;
    if (++column_ == view.width) active_ = false;
    return Activity::busy;
}

RayPosition::RayPosition(const RegisterFile& registers, const Ports& ports)
    : SerialStage("ray_position",
                  "latency and interval " + std::to_string(kLatency) + " (" + std::to_string(kMissLatency) +
                      " beside the object, " + std::to_string(kNoRayLatency) + " without a ray)",
                  ports),
      registers_(registers) {}

int RayPosition::work(const ColumnRay& in, RayPoint& out) {
    out = {};
    out.view = in.view;
    if (!in.has_ray) return kNoRayLatency;
    const ObjectRegisters& object = registers_.object_of(in.view);
    const PlaneView& plane = registers_.view(in.view).planes[static_cast<std::size_t>(in.plane)];
    const std::int64_t c_q20 = plane.c_q20;
    constexpr std::int64_t kFarthest_q20 = std::int64_t{1} << 29;

    const Quotient u_q28 = divide(in.t_q28 * (std::int64_t{1} << 28), in.n_q28);
    const Quotient lambda_q20 = divide(c_q20 << 28, in.n_q28);
    if (u_q28.overflow || lambda_q20.overflow || lambda_q20.value >= kFarthest_q20) return kMissLatency;
    const std::int64_t x_q20 = plane.a_q20 + ((u_q28.value * c_q20) >> 28);
    if (x_q20 < -object.x_half_q20 || x_q20 >= object.x_half_q20) return kMissLatency;

    const std::int64_t xi = std::clamp<std::int64_t>(((x_q20 + object.x_half_q20) * object.x_cells_per_unit_q12) >> 32,
                                                     0, object.x_cells - 1);
    const std::int64_t ui = std::clamp<std::int64_t>(
        ((u_q28.value + object.u_half_q28) * object.u_cells_per_unit_q12) >> 40, 0, object.u_cells - 1);
    out.has_ray = true;
    out.plane = in.plane;
    out.x_q20 = x_q20;
    out.u_q28 = u_q28.value;
    out.n_q28 = in.n_q28;
    out.t_q28 = in.t_q28;
    out.lambda_q20 = lambda_q20.value;
    const std::int64_t cell = (std::int64_t{in.plane} * object.x_cells + xi) * object.u_cells + ui;
    out.cell_byte = std::uint64_t{object.map} * 8 + static_cast<std::uint64_t>(cell);
    return kLatency;
}

}  // namespace rs::engine::model
