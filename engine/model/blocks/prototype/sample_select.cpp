#include "engine/model/blocks/prototype/sample_select.hpp"

namespace rs::engine::model {

SampleSelect::SampleSelect(Fifo<SampleTag>& tags, Fifo<MemoryWord>& words, Fifo<YuvaPixel>& out)
    : Block("sample_select", "a word per cycle; a pixel is handed on in the cycle of its Y"),
      tags_(reads(tags)),
      words_(reads(words)),
      out_(writes(out)) {}

Activity SampleSelect::tick(std::uint64_t) {
    if (!tags_.can_pop()) return Activity::idle;
    if (!words_.can_pop()) return Activity::memory_data;
    const SampleTag& tag = tags_.front();
    if (tag.kind == SampleTag::Kind::luma && !out_.can_push()) return Activity::output_full;
    const std::uint64_t word = words_.pop().data;
    const int n = tag.pixel;
    const int lane = tag.lane[n];
    switch (tag.kind) {
        case SampleTag::Kind::alpha:
            for (int p = 0; p < 2; ++p) {
                if (tag.takes[p]) level_[p] = static_cast<int>((word >> (2 * tag.lane[p])) & 3U);
            }
            break;
        case SampleTag::Kind::chroma:
            u_ = static_cast<int>((word >> (16 * lane)) & 255U);
            v_ = static_cast<int>((word >> (16 * lane + 8)) & 255U);
            break;
        case SampleTag::Kind::luma:
            out_.push({tag.view, static_cast<int>((word >> (8 * lane)) & 255U), u_, v_, 85 * level_[n]});
            level_[n] = 0;  // a pixel without alpha of its own is transparent
            break;
    }
    tags_.pop();
    return Activity::busy;
}

}  // namespace rs::engine::model
