#pragma once
// Random registers and requests of boards with compressed images.

#include "engine/model/signals/coded_messages.hpp"
#include "tests/engine/rtl/random_registers.hpp"

namespace rs::engine::rtl {

/// random_registers() whose objects have tile tables and record classes.
inline model::RegisterFile random_coded_registers(Random& random) {
    model::RegisterFile file = random_registers(random);
    for (model::ObjectRegisters& object : file.objects) {
        object.tile_columns = (object.width + 31) / 32;
        object.table_pitch = ((object.height + 31) / 32 + 1) / 2 * 2;
        object.tile_table = static_cast<model::WordAddress>(random.in(0, (1 << 27) - 1));
        object.coded_width = (object.width + 7) / 8 * 8;
        object.coded_height = (object.height + 7) / 8 * 8;
        for (const std::size_t set : {0U, 1U}) {
            for (codec::RecordClass& record : object.classes[set]) {
                record.predicted = set == 1 && random.chance(0.7);
                record.alpha = random.chance(0.5);
                record.block_stages = static_cast<int>(random.in(0, codec::kMaxBlockStages));
                record.quarter_stages = static_cast<int>(random.in(0, codec::kMaxQuarterStages));
            }
        }
    }
    return file;
}

/// A request within an image; requests of the same tile follow each other often.
inline model::BlockRequest random_request(const model::RegisterFile& file, model::BlockRequest& last, Random& random) {
    model::BlockRequest request = last;
    request.first = random.chance(0.2);
    if (request.first || request.rows == 0) request.view = random_view(file, random);
    const model::ObjectRegisters& object = file.object_of(request.view);
    if (request.view != last.view || last.rows == 0 || random.chance(0.3)) {
        request.image = static_cast<int>(random.in(0, object.images - 1));
        request.column = static_cast<int>(random.in(0, object.width - 1));
    }
    request.down = random.chance(0.5);
    request.block_row = static_cast<int>(random.in(0, (object.height - 1) / 8));
    request.rows = static_cast<unsigned>(random.in(1, 255));
    last = request;
    return request;
}

/// Half the bytes of a record of each class, 4 bits each, class 0 in the low ones.
inline std::uint32_t record_sizes(const std::array<codec::RecordClass, codec::kBoardClasses>& classes) {
    std::uint32_t sizes = 0;
    for (std::size_t n = 1; n < classes.size(); ++n) {
        sizes |= static_cast<std::uint32_t>(classes[n].bytes() / 2) << (4 * n);
    }
    return sizes;
}

/// The registers with the classes of records, class 0 in the low byte.
inline std::uint64_t class_bytes(const std::array<codec::RecordClass, codec::kBoardClasses>& classes) {
    std::uint64_t bytes = 0;
    for (std::size_t n = classes.size(); n-- > 0;) bytes = bytes << 8U | class_byte(classes[n]);
    return bytes;
}

/// Look-up of a predicted hop, whose unused stages are not 0.
inline model::HopLookup random_lookup(Random& random) {
    model::HopLookup hop;
    hop.predicted = true;
    hop.block_stages = static_cast<int>(random.in(0, codec::kMaxBlockStages));
    hop.quarter_stages = static_cast<int>(random.in(0, codec::kMaxQuarterStages));
    for (std::uint8_t& entry : hop.block) entry = static_cast<std::uint8_t>(random.word());
    for (std::uint8_t& entry : hop.quarter) entry = static_cast<std::uint8_t>(random.word());
    hop.x = static_cast<int>(random.in(0, 7));
    hop.y = static_cast<int>(random.in(0, 7));
    return hop;
}

/// Colour and alpha of a pixel behind hop 0.
inline void random_colour(model::CodedPixel& pixel, Random& random) {
    for (std::uint8_t& sample : pixel.flat) sample = static_cast<std::uint8_t>(random.word());
    pixel.alpha = static_cast<model::CodedPixel::Alpha>(random.in(0, 2));
    pixel.alpha_entry = static_cast<std::uint8_t>(random.word());
}

}  // namespace rs::engine::rtl
