#include "engine/model/blocks/decompression/record_select.hpp"

#include "engine/model/blocks/decompression/block_motion.hpp"
#include "rayspace/codec/dense_tile.hpp"

namespace rs::engine::model {

CodedPixel apply_hop(const CodedPixel& pixel, const BlockRecord& record, bool is_new_record, int coded_height) {
    CodedPixel out = pixel;
    const int y = pixel.row & 7;
    const auto quarter = static_cast<std::size_t>(y / 4 * 2 + pixel.column / 4);
    HopLookup& hop = out.hop[static_cast<std::size_t>(out.hops++)];
    hop = {};
    hop.x = pixel.column;
    hop.y = y;
    out.pending = out.begins = false;
    if (record.empty) {
        out.flat = {codec::kEmptySample, codec::kEmptySample, codec::kEmptySample};
    } else {
        hop.predicted = record.record_class.predicted;
        hop.block_stages = record.record_class.block_stages;
        hop.quarter_stages = record.record_class.quarter_stages;
        hop.block = record.block;
        for (std::size_t s = 0; s < hop.quarter.size(); ++s) hop.quarter[s] = record.quarter[s][quarter];
        if (record.record_class.predicted) {
            out.pending = true;
            out.begins = is_new_record;
            out.row = clamped_coordinate(pixel.row, record.motion_y, coded_height);
            out.column = record.reference_column;
        } else {
            out.flat = record.flat;
        }
        if (pixel.hops == 0) {  // alpha comes from the first hop
            out.alpha = record.record_class.alpha ? CodedPixel::Alpha::book : CodedPixel::Alpha::full;
            out.alpha_entry = record.alpha[quarter];
        }
    }
    return out;
}

RecordSelect::RecordSelect(int hop, const RegisterFile& registers, const Ports& ports)
    : Block("record_select_" + std::to_string(hop), "a pixel per cycle"),
      registers_(registers),
      in_(reads(ports.in)),
      records_(reads(ports.records)),
      out_(writes(ports.out)) {}

Activity RecordSelect::tick(std::uint64_t) {
    if (!in_.can_pop()) return Activity::idle;
    if (!out_.can_push()) return Activity::output_full;
    const CodedPixel& pixel = in_.front();
    if (!pixel.pending) {
        out_.push(pixel);
        in_.pop();
        return Activity::busy;
    }
    const bool is_new_record = pixel.begins || pixel.row >> 3 != record_.block_row;
    if (is_new_record) {
        if (!records_.can_pop()) return Activity::memory_data;
        record_ = records_.pop();
        RS_CHECK(record_.block_row == pixel.row >> 3);
    }
    out_.push(apply_hop(pixel, record_, is_new_record, registers_.object_of(pixel.view).coded_height));
    in_.pop();
    return Activity::busy;
}

}  // namespace rs::engine::model
