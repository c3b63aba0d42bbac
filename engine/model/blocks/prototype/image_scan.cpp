#include "engine/model/blocks/prototype/image_scan.hpp"
#include "rayspace/object/ray_space_object.hpp"

namespace rs::engine::model {

ColumnAddress::ColumnAddress(const RegisterFile& registers, const Ports& ports)
    : SerialStage(
          "column_address",
          "latency and interval " + std::to_string(kLatency) + " (" + std::to_string(kNoRayLatency) + " without a ray)",
          ports),
      registers_(registers) {}

int ColumnAddress::work(const ColumnWalk& in, PlacedColumn& out) {
    out = {};
    out.view = in.view;
    if (!in.has_ray) return kNoRayLatency;
    const ObjectRegisters& object = registers_.object_of(in.view);
    const int column = in.image * object.width + in.column;
    const int chroma_column = in.image * half_size(object.width) + (in.column >> 1);
    out.has_ray = true;
    out.row_0_q16 = in.row_0_q16;
    out.row_step_q16 = in.row_step_q16;
    out.luma = object.luma + static_cast<WordAddress>(column * object.luma_pitch);
    out.chroma = object.chroma + static_cast<WordAddress>(chroma_column * object.chroma_pitch);
    out.alpha = object.alpha + static_cast<WordAddress>(column * object.alpha_pitch);
    return kLatency;
}

RowScan::RowScan(const RegisterFile& registers, const Ports& ports)
    : Block("row_scan", "1 cycle to take a column, then a pixel per cycle, a pair every second"),
      registers_(registers),
      in_(reads(ports.in)),
      out_(writes(ports.out)) {}

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
        pair_.is_visible[n] = column_.has_ray && row >= 0 && row < registers_.object_of(column_.view).height;
        pair_.row[n] = pair_.is_visible[n] ? static_cast<int>(row) : 0;
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
