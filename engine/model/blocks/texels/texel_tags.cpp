#include "engine/model/blocks/texels/texel_tags.hpp"

#include <algorithm>

namespace rs::engine::model {

TexelTags::TexelTags(const RegisterFile& registers, const Ports& ports)
    : Block("texel_tags", "a sample per cycle, one more for each block that is not there"),
      registers_(registers),
      in_(reads(ports.in)),
      fills_(writes(ports.fills)),
      out_(writes(ports.out)) {
    RS_CHECK(ports.out.depth() <= kWaitingSamples);
}

int TexelTags::find(int image, int block_column, int block_row) const {
    const int set = set_of(image, block_column, block_row);
    for (int way = 0; way < 2; ++way) {
        const Line& line = lines_[static_cast<std::size_t>(2 * set + way)];
        if (line.valid && line.image == image && line.block_column == block_column && line.block_row == block_row) {
            return 2 * set + way;
        }
    }
    return -1;
}

// Sets the cache positions of the sample's texels. Returns true, with the first missing block, if one is missing.
bool TexelTags::needs_fill(const PlacedSample& sample, WaitingSample& waiting, TexelFill& fill) {
    for (int n = 0; n < 4; ++n) {
        const bool right = n >= 2;
        const bool bottom = n % 2 == 1;
        if ((right && sample.fx == 0) || (bottom && sample.fy == 0)) continue;  // weight 0
        const int x = sample.left + (right && !sample.right_is_left ? 1 : 0);
        const int y = sample.top + (bottom && !sample.bottom_is_top ? 1 : 0);
        const int line = find(sample.image, x >> 3, y >> 3);
        if (line < 0) {
            fill = {sample.view, sample.image, x >> 3, y >> 3, 0, 0};
            return true;
        }
        waiting.line[static_cast<std::size_t>(n)] = line;
        waiting.texel[static_cast<std::size_t>(n)] = (x & 7) * 8 + (y & 7);
    }
    return false;
}

// Replaces the older line of the block's set. The front sample cannot need that line, because a sample needs only one
// block of a set.
int TexelTags::replace(const TexelFill& fill) {
    const int set = set_of(fill.image, fill.block_column, fill.block_row);
    int& older = older_[static_cast<std::size_t>(set)];
    const int line = 2 * set + older;
    older ^= 1;
    Line& replaced = lines_[static_cast<std::size_t>(line)];
    replaced.valid = true;
    replaced.image = fill.image;
    replaced.block_column = fill.block_column;
    replaced.block_row = fill.block_row;
    return line;
}

std::uint32_t TexelTags::guard_of(const Line& line) const {
    RS_CHECK(line.last_use < std::max<std::int64_t>(samples_, 1));
    return static_cast<std::uint32_t>(std::max(line.last_use, samples_ - kWaitingSamples)) % kSampleNumbers;
}

Activity TexelTags::tick(std::uint64_t) {
    if (!in_.can_pop()) return Activity::idle;
    const PlacedSample& sample = in_.front();
    WaitingSample waiting;
    waiting.head = sample.head;
    waiting.inside = sample.inside;
    waiting.fx = sample.fx;
    waiting.fy = sample.fy;
    if (sample.inside) {
        const std::uint32_t serial = registers_.object_of(sample.view).serial;
        if (serial != serial_) {
            for (Line& line : lines_) line.valid = false;
            serial_ = serial;
        }
        TexelFill fill;
        if (needs_fill(sample, waiting, fill)) {
            if (!fills_.can_push()) return Activity::output_full;
            fill.line = replace(fill);
            fill.guard = guard_of(lines_[static_cast<std::size_t>(fill.line)]);
            fills_.push(fill);
            ++new_fills_;
            ++fills_requested_;
            return Activity::busy;
        }
    }
    if (!out_.can_push()) return Activity::output_full;
    waiting.fills = new_fills_;
    new_fills_ = 0;
    ++samples_;
    if (sample.inside) {
        for (int n = 0; n < 4; ++n) {
            if ((n >= 2 && sample.fx == 0) || (n % 2 == 1 && sample.fy == 0)) continue;
            const auto line = static_cast<std::size_t>(waiting.line[static_cast<std::size_t>(n)]);
            lines_[line].last_use = samples_;
            older_[line / 2] = static_cast<int>(line % 2) ^ 1;
        }
    }
    out_.push(waiting);
    in_.pop();
    return Activity::busy;
}

}  // namespace rs::engine::model
