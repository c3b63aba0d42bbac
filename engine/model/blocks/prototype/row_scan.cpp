#include "engine/model/blocks/prototype/row_scan.hpp"

namespace rs::engine::model {

RowScan::RowScan(const RegisterFile& registers, Fifo<PlacedColumn>& in, Fifo<PixelPair>& out)
    : Block("row_scan", "1 cycle to take a column, then a pixel per cycle, a pair every second"),
      registers_(registers),
      in_(reads(in)),
      out_(writes(out)) {}

Activity RowScan::tick(std::uint64_t) {
    if (!active_) {
        if (!in_.can_pop()) return Activity::idle;
        column_ = in_.pop();
        row_q16_ = column_.row_0_q16;
        view_row_ = 0;
        active_ = true;
        return Activity::busy;
    }
    const BoardView& view = registers_.view(column_.view);
    const int n = view_row_ & 1;
    if (n == 1 && !out_.can_push()) return Activity::output_full;
    if (n == 0) {
        pair_ = {};
        pair_.view = column_.view;
        pair_.luma = column_.luma;
        pair_.chroma = column_.chroma;
        pair_.alpha = column_.alpha;
    }
    if (view_row_ < view.height) {
        const std::int64_t row = row_q16_ >> 16;
        pair_.shows[n] = column_.has_ray && row >= 0 && row < registers_.object_of(column_.view).height;
        pair_.row[n] = pair_.shows[n] ? static_cast<int>(row) : 0;
        row_q16_ += column_.row_step_q16;
    }
    ++view_row_;
    if (n == 1) {
        out_.push(pair_);
        active_ = view_row_ < view.height;
    }
    return Activity::busy;
}

}  // namespace rs::engine::model
