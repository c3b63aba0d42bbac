#include "engine/model/blocks/shared/raster_generator.hpp"

namespace rs::engine::model {

RasterGenerator::RasterGenerator(const RegisterFile& registers, Fifo<ViewJob>& jobs, Fifo<ColumnRay>& columns,
                                 const StripeShare& share)
    : Block("raster_generator", "a column in K + 1 cycles for K planes; 1 cycle to begin a view"),
      registers_(registers),
      share_(share),
      jobs_(reads(jobs)),
      columns_(writes(columns)) {}

Activity RasterGenerator::tick(std::uint64_t) {
    if (!active_) {
        if (!jobs_.can_pop()) return Activity::idle;
        view_ = jobs_.pop().view;
        const BoardView& view = registers_.view(view_);
        for (std::size_t k = 0; k < kMostPlanes; ++k) {
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

}  // namespace rs::engine::model
