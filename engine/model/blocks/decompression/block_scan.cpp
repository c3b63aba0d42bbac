#include "engine/model/blocks/decompression/block_scan.hpp"

namespace rs::engine::model {

BlockScan::BlockScan(const RegisterFile& registers, const Ports& ports)
    : Block("block_scan", "1 cycle to take a column, then a pixel per cycle; a run of at most " +
                              std::to_string(kMaxPixels) + " pixels is asked for in the cycle after its last"),
      registers_(registers),
      in_(reads(ports.in)),
      asks_(writes(ports.asks)),
      pixels_(writes(ports.pixels)) {}

Activity BlockScan::tick(std::uint64_t) {
    if (!active_) {
        if (run_ > 0) {  // last run of the previous column
            if (!asks_.can_push()) return Activity::output_full;
            asks_.push(request_);
            run_ = 0;
            if (!in_.can_pop()) return Activity::busy;
        }
        if (!in_.can_pop()) return Activity::idle;
        column_ = in_.pop();
        row_q16_ = column_.row_0_q16;
        view_row_ = 0;
        first_ = active_ = true;
        return Activity::busy;
    }
    if (!pixels_.can_push()) return Activity::output_full;
    const BoardView& view = registers_.view(column_.view);
    const std::int64_t row = row_q16_ >> 16;
    const bool is_visible =
        column_.has_ray && view_row_ < view.height && row >= 0 && row < registers_.object_of(column_.view).height;
    const int block_row = static_cast<int>(is_visible ? row >> 3 : 0);
    const bool joins = is_visible && run_ > 0 && run_ < kMaxPixels && block_row == request_.block_row;
    if (run_ > 0 && !joins) {
        if (!asks_.can_push()) return Activity::output_full;
        asks_.push(request_);
        run_ = 0;
    }
    CodedPixel pixel;
    pixel.view = column_.view;
    pixel.is_visible = pixel.pending = is_visible;
    if (is_visible) {
        if (run_ == 0) {
            request_ = {column_.view, first_, column_.row_step_q16 >= 0, column_.image, column_.column, block_row, 0};
            first_ = false;
            pixel.begins = true;
        }
        request_.rows |= 1U << (row & 7);
        ++run_;
        pixel.row = static_cast<int>(row);
        pixel.column = column_.column & 7;
    }
    pixels_.push(pixel);
    row_q16_ += column_.row_step_q16;
    active_ = ++view_row_ < 2 * view.words_per_column();
    return Activity::busy;
}

}  // namespace rs::engine::model
