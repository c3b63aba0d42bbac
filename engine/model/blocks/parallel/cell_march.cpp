#include "engine/model/blocks/parallel/cell_march.hpp"

#include <algorithm>
#include <cstdlib>

namespace rs::engine::model {
namespace {

// On a captured line only that image is used, and no second surface is needed.
bool is_alone(const ColumnSetup& column) {
    return column.weight == 0 || column.weight == 256;
}

ShapeCell cell_of(std::uint64_t word, int n) {
    return unpacked_cell(static_cast<std::uint16_t>(word >> (16 * n)));
}

}  // namespace

MarchSteps march_steps(std::int32_t per_d_q20) {
    constexpr int kMostSteps = 64;
    const int steps = std::min((std::abs(per_d_q20) >> 11) + 1, kMostSteps);
    return {steps, 256 / steps};
}

CellMarch::CellMarch(const RegisterFile& registers, const Ports& ports)
    : Block("cell_march", "two looks per cycle, one in a cycle that writes cells; latency " +
                              std::to_string(kStages + 1) + ", " + std::to_string(kStages) + " more for each turn"),
      registers_(registers),
      columns_(reads(ports.columns)),
      words_(reads(ports.words)),
      in_(reads(ports.in)),
      again_(reads(ports.again)),
      met_(writes(ports.met)),
      empty_(writes(ports.empty)) {}

// A column's set-up becomes valid with the last of its cells.
bool CellMarch::load(bool& writes_cells) {
    if (words_left_ == 0) {
        if (!columns_.can_pop()) return false;
        loading_ = columns_.pop();
        const bool has_cells = loading_.kind == RayKind::shape;
        words_of_column_ = has_cells ? column_words(registers_.object_of(loading_.view).shape.bands) : 0;
        words_left_ = 4 * words_of_column_;
        if (words_left_ == 0) table_.put(loading_);
        return true;
    }
    std::uint64_t& held = held_[static_cast<std::size_t>(4 * words_of_column_ - words_left_)];
    if (!loading_.same_cells) {
        if (!words_.can_pop()) return false;
        held = words_.pop().data;
    }
    const std::uint64_t word = held;
    writes_cells = words_left_ % 2 == 1;
    if (writes_cells) {
        store_cells(first_line_word_, word);
    } else {
        first_line_word_ = word;
    }
    if (--words_left_ == 0) table_.put(loading_);
    return true;
}

void CellMarch::store_cells(std::uint64_t first_line, std::uint64_t second_line) {
    const int pair = (4 * words_of_column_ - words_left_) / 2;
    auto& column = cells_[ColumnTable::place(loading_.stripe, loading_.column)];
    auto& cells = column[static_cast<std::size_t>(pair / words_of_column_)];
    const int jump = registers_.object_of(loading_.view).shape.jump;
    for (int n = 0; n < kCellsPerWord; ++n) {
        cells[static_cast<std::size_t>(pair % words_of_column_ * kCellsPerWord + n)] =
            between_lines(cell_of(first_line, n), cell_of(second_line, n), loading_.line_part, jump);
    }
}

// Band at a depth, 0 or greater. A depth behind the last one counts as the last one.
std::int32_t CellMarch::band_q12(const Turn& turn, int d) const {
    const auto& effective = registers_.object_of(turn.ray.pixel.view).shape.effective_depth_q3;
    const std::int32_t effective_q3 = effective[static_cast<std::size_t>(std::min(d, 255))];
    return turn.ray.foot_q12 + ((effective_q3 * (turn.ray.per_d_q20 >> 3)) >> 8);
}

SurfaceStack CellMarch::surfaces_at(const ColumnSetup& column, std::int32_t at_q12) {
    ++looks_;
    const ShapeRegisters& shape = registers_.object_of(column.view).shape;
    const Cells& cells = cells_[ColumnTable::place(column.stripe, column.column)];
    const std::int32_t from_middle_q12 = at_q12 - (1 << 11);
    SurfaceCell around[2][2];
    for (std::size_t p = 0; p < 2; ++p) {
        for (int h = 0; h < 2; ++h) {
            const std::int32_t band = (from_middle_q12 >> 12) + h;
            if (band >= 0 && band < shape.bands) around[p][h] = cells[p][static_cast<std::size_t>(band)];
        }
    }
    return surfaces_between(around, column.p_part, (from_middle_q12 >> 9) & 7, shape.jump);
}

// Takes the next pixel; false if there is none.
bool CellMarch::next_ray(Turn& turn) {
    turn = {};
    if (again_.can_pop()) {
        const ReturnedPixel again = again_.pop();
        turn.ray = pixels_[static_cast<std::size_t>(again.id)];
        turn.state = again.state;
        return true;
    }
    if (!in_.can_pop() || !table_.holds(in_.front().pixel)) return false;
    turn.ray = in_.pop();
    pixels_[static_cast<std::size_t>(turn.ray.pixel.id)] = turn.ray;
    if (march_steps(turn.ray.per_d_q20).steps == 1) turn.state.begin = MarchState::kFoot;
    return true;
}

void CellMarch::look(Turn& turn, const ColumnSetup& column) {
    const int size = march_steps(turn.ray.per_d_q20).size;
    const int begin = turn.state.begin;
    const SurfaceCell cell = surfaces_at(column, band_q12(turn, begin + (size >> 1))).first;
    const int thickness = registers_.object_of(column.view).shape.thickness;
    const int end = begin + size;
    turn.state.begin = std::min(end, MarchState::kFoot);
    if (!cell.exists() || cell.depth_q3 > 8 * end || cell.deepest + thickness < begin) return;
    turn.outcome = Turn::Outcome::met;
    turn.met = {turn.ray.pixel, std::max(cell.depth_q3, 8 * begin), is_alone(column), turn.state, cell.lean};
}

// First look: the surface in the foot's band. Second look: the surface in the band at its depth, or the one behind it.
void CellMarch::look_at_foot(Turn& turn, const ColumnSetup& column) {
    const SurfaceCell& of_foot = turn.foot.first;
    const bool at_its_depth = of_foot.exists();
    SurfaceStack last = surfaces_at(column, at_its_depth ? band_q12(turn, of_foot.depth_q3 >> 3) : turn.ray.foot_q12);
    if (!at_its_depth && last.first.exists()) {
        turn.foot = last;
        return;
    }
    if (!last.first.exists()) last = turn.foot;
    const int state = turn.state.begin;
    const SurfaceCell& cell = state == MarchState::kFoot     ? last.first
                              : state == MarchState::kBehind ? last.behind
                                                             : last.farthest;
    if (!cell.exists() && !is_alone(column)) {
        turn.outcome = Turn::Outcome::empty;
        return;
    }
    const int depth_q3 = cell.exists() ? cell.depth_q3 : registers_.object_of(column.view).shape.foot_d_q3;
    const bool has_behind = state == MarchState::kFoot && last.behind.exists();
    const bool has_farthest = state < MarchState::kFarthest && last.farthest.exists();
    turn.outcome = Turn::Outcome::met;
    turn.met = {turn.ray.pixel,
                depth_q3,
                is_alone(column) || (!has_behind && !has_farthest),
                {has_behind ? MarchState::kBehind : MarchState::kFarthest},
                cell.lean};
}

void CellMarch::take_turn(Turn& turn, int looks) {
    const ColumnSetup& column = table_.of(turn.ray.pixel);
    if (column.kind == RayKind::none) {
        turn.outcome = Turn::Outcome::empty;
    } else if (column.kind != RayKind::shape) {
        turn.outcome = Turn::Outcome::met;
        turn.met = {turn.ray.pixel, 0, true, turn.state};
    }
    for (int n = 0; n < looks && turn.outcome == Turn::Outcome::continues; ++n) {
        // The second look at the foot depends on the result of the first.
        if (turn.state.begin < MarchState::kFoot) {
            look(turn, column);
        } else if (n == 0 || !turn.foot.first.exists()) {
            look_at_foot(turn, column);
        }
    }
}

Activity CellMarch::tick(std::uint64_t) {
    bool writes_cells = false;
    const bool loads = load(writes_cells);
    Turn turn;
    bool continues = false;
    if (line_.has_output()) {
        turn = line_.output();
        continues = turn.outcome == Turn::Outcome::continues;
        const bool met = turn.outcome == Turn::Outcome::met;
        if (!continues && !(met ? met_.can_push() : empty_.can_push())) {  // the whole pipeline stalls
            return loads ? Activity::busy : Activity::output_full;
        }
        if (met) met_.push(turn.met);
        if (!continues && !met) empty_.push({turn.ray.pixel.id, 0});
    }
    if (continues || next_ray(turn)) {
        take_turn(turn, writes_cells ? 1 : 2);
        line_.advance(turn);
        return Activity::busy;
    }
    line_.advance();
    if (loads) return Activity::busy;
    return in_.can_pop() ? Activity::memory_data : Activity::idle;  // waits for the column's cells
}

}  // namespace rs::engine::model
