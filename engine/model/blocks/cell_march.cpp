#include "engine/model/blocks/cell_march.hpp"

#include "engine/model/parallel_layout.hpp"

#include <algorithm>
#include <cstdlib>

namespace rs::engine::model {

MarchSteps march_steps(std::int32_t per_d_q20) {
    constexpr int kMostSteps = 64;
    const int steps = std::min((std::abs(per_d_q20) >> 11) + 1, kMostSteps);
    return {steps, 256 / steps};
}

CellMarch::CellMarch(const RegisterFile& registers, Fifo<ColumnSetup>& columns, Fifo<MemoryWord>& words,
                     Fifo<RisenPixel>& in, Fifo<MarchAgain>& again, Fifo<MetCell>& met, Fifo<FinishedPixel>& empty)
    : Block("cell_march",
            "two looks at cells per cycle, one in the cycle of a column's word; a pixel without bands in 1"),
      registers_(registers),
      columns_(reads(columns)),
      words_(reads(words)),
      in_(reads(in)),
      again_(reads(again)),
      met_(writes(met)),
      empty_(writes(empty)) {}

// A column's set-up counts as there when the last of its cells is.
bool CellMarch::load() {
    if (words_left_ == 0) {
        if (!columns_.can_pop()) return false;
        loading_ = columns_.pop();
        words_left_ = loading_.band_words;
        if (words_left_ == 0) table_.put(loading_);
        return true;
    }
    if (!words_.can_pop()) return false;
    auto& ray = cells_[ColumnTable::place(loading_.stripe, loading_.column)];
    ray[static_cast<std::size_t>(loading_.band_words - words_left_)] = words_.pop().data;
    if (--words_left_ == 0) table_.put(loading_);
    return true;
}

ShapeCell CellMarch::cell_at(const ColumnSetup& column, std::int32_t at_q12) {
    ++looks_;
    const std::int32_t band = at_q12 >> 12;
    if (band < 0 || band >= registers_.object_of(column.view).shape.bands) return {};
    const auto place = static_cast<std::size_t>(band) + (column.odd_cell ? 1U : 0U);
    const std::uint64_t word = cells_[ColumnTable::place(column.stripe, column.column)][place / 2];
    return unpacked_cell(static_cast<std::uint32_t>(word >> (32 * (place % 2))));
}

// Takes the next pixel; false where there is none.
bool CellMarch::begin() {
    state_ = {};
    if (again_.can_pop()) {
        const MarchAgain again = again_.pop();
        ray_ = pixels_[static_cast<std::size_t>(again.id)];
        state_ = again.state;
    } else if (in_.can_pop() && table_.holds(in_.front().pixel)) {
        ray_ = in_.pop();
        pixels_[static_cast<std::size_t>(ray_.pixel.id)] = ray_;
        if (march_steps(ray_.per_d_q20).steps == 1) state_.begin = 256;
    } else {
        return false;
    }
    has_foot_cell_ = false;
    return marching_ = true;
}

void CellMarch::meet(const ShapeCell& cell, bool final) {
    met_.push({ray_.pixel, cell, final, state_});
    marching_ = false;
}

Activity CellMarch::finish_empty() {
    if (!empty_.can_push()) return Activity::output_full;
    empty_.push({ray_.pixel.id, 0});
    marching_ = false;
    return Activity::busy;
}

// The look's result is known before its pixel leaves, so room is asked for first.
Activity CellMarch::march() {
    if (!met_.can_push() || !empty_.can_push()) return Activity::output_full;
    const ColumnSetup& column = table_.of(ray_.pixel);
    switch (column.kind) {
        case RayKind::none:
            return finish_empty();
        case RayKind::plane:
            meet({}, true);
            return Activity::busy;
        case RayKind::foot: {
            ShapeCell foot;
            foot.rays = kFirstSeesLayer0;
            meet(foot, true);
            return Activity::busy;
        }
        case RayKind::shape:
            return state_.begin < 256 ? look(column) : look_at_foot(column);
    }
    return Activity::idle;
}

Activity CellMarch::look(const ColumnSetup& column) {
    const int size = march_steps(ray_.per_d_q20).size;
    const int begin = state_.begin;
    ShapeCell cell = cell_at(column, band_q12(begin + (size >> 1)));
    state_.begin = begin + size;
    if (cell.rays == 0 || cell.nearest() > begin + size || cell.back < begin) return Activity::busy;
    for (std::uint8_t& d : cell.depth) d = static_cast<std::uint8_t>(std::max<int>(d, begin));
    const bool alone = column.weight == 0 || column.weight == 256;
    if (alone) cell.rays = column.weight == 0 ? kFirstSeesLayer0 : kSecondSeesLayer0;
    meet(cell, alone);
    return Activity::busy;
}

// The cell of the foot's band, and then that of the band where that one's surface lies.
Activity CellMarch::look_at_foot(const ColumnSetup& column) {
    const bool alone = column.weight == 0 || column.weight == 256;
    ShapeCell cell = cell_at(column, has_foot_cell_ ? band_q12(foot_cell_.depth[0]) : ray_.foot_q12);
    if (!has_foot_cell_ && cell.rays != 0) {
        has_foot_cell_ = true;
        foot_cell_ = cell;
        return Activity::busy;
    }
    if (has_foot_cell_ && cell.rays == 0) cell = foot_cell_;
    if (alone) {
        if (cell.rays == 0) cell.depth[0] = static_cast<std::uint8_t>(registers_.object_of(column.view).shape.foot_d);
        cell.rays = column.weight == 0 ? kFirstSeesLayer0 : kSecondSeesLayer0;
    } else if (cell.rays == 0) {
        return finish_empty();
    }
    meet(cell, true);
    return Activity::busy;
}

Activity CellMarch::tick(std::uint64_t) {
    const bool loads = load();
    Activity activity = Activity::idle;
    if (marching_ || begin()) activity = march();
    // The second port of the cells' memory, where no word is written. A cell that depends on another one waits for it.
    if (!loads && marching_ && !has_foot_cell_ && activity == Activity::busy) march();
    if (activity == Activity::idle && in_.can_pop()) activity = Activity::memory_data;  // for the column's cells
    return loads ? Activity::busy : activity;
}

}  // namespace rs::engine::model
