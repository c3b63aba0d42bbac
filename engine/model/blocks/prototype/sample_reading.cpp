#include "engine/model/blocks/prototype/sample_reading.hpp"

namespace rs::engine::model {

SampleFetch::SampleFetch(const Ports& ports)
    : Block("sample_fetch", "a read per cycle; 5 reads per pair of pixels, 6 where alpha needs two words"),
      in_(reads(ports.in)),
      requests_(writes(ports.requests)),
      tags_(writes(ports.tags)) {}

Activity SampleFetch::tick(std::uint64_t) {
    if (!in_.can_pop()) return Activity::idle;
    if (!requests_.can_push()) return Activity::memory_port;
    if (!tags_.can_push()) return Activity::output_full;
    const PixelPair& pair = in_.front();
    SampleTag tag;
    tag.view = pair.view;
    MemoryRead read;
    const bool apart = pair.is_visible[0] && pair.is_visible[1] && (pair.row[0] >> 5) != (pair.row[1] >> 5);
    if (slot_ < 2) {
        const int first = slot_ == 0 && pair.is_visible[0] ? 0 : 1;  // pixel whose word is read
        tag.has_alpha[0] = slot_ == 0 && pair.is_visible[0];
        tag.has_alpha[1] = pair.is_visible[1] && (!apart || slot_ == 1);
        tag.lane[0] = pair.row[0] & 31;
        tag.lane[1] = pair.row[1] & 31;
        read = {pair.alpha + static_cast<WordAddress>(pair.row[first] >> 5),
                !pair.is_visible[0] && !pair.is_visible[1]};
        slot_ = slot_ == 0 && apart ? 1 : 2;
    } else {
        const int n = (slot_ - 2) / 2;
        const bool luma = slot_ % 2 == 1;
        const int row = pair.row[n];
        tag.kind = luma ? SampleTag::Kind::luma : SampleTag::Kind::chroma;
        tag.pixel = n;
        tag.lane[n] = luma ? row & 7 : (row >> 1) & 3;
        // A word has eight rows of Y, or four (U, V) pairs for eight rows: both words are the (row >> 3)-th of their
        // column.
        read = {(luma ? pair.luma : pair.chroma) + static_cast<WordAddress>(row >> 3), !pair.is_visible[n]};
        slot_ = slot_ == 5 ? 0 : slot_ + 1;
    }
    requests_.push(read);
    tags_.push(tag);
    if (slot_ == 0) in_.pop();
    return Activity::busy;
}

SampleSelect::SampleSelect(const Ports& ports)
    : Block("sample_select", "a word per cycle; a pixel is handed on in the cycle of its Y"),
      tags_(reads(ports.tags)),
      words_(reads(ports.words)),
      out_(writes(ports.out)) {}

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
                if (tag.has_alpha[p]) level_[p] = static_cast<int>((word >> (2 * tag.lane[p])) & 3U);
            }
            break;
        case SampleTag::Kind::chroma:
            u_ = static_cast<int>((word >> (16 * lane)) & 255U);
            v_ = static_cast<int>((word >> (16 * lane + 8)) & 255U);
            break;
        case SampleTag::Kind::luma:
            out_.push({tag.view, static_cast<int>((word >> (8 * lane)) & 255U), u_, v_, 85 * level_[n]});
            level_[n] = 0;  // default: a pixel without an alpha word is transparent
            break;
    }
    tags_.pop();
    return Activity::busy;
}

}  // namespace rs::engine::model
