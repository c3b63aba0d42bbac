#pragma once
// Random registers and requests of boards with compressed images.

#include "engine/model/blocks/decompression/book_lookup.hpp"
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

/// random_coded_registers() whose objects have codebooks, by preference few.
inline model::RegisterFile random_registers_with_books(Random& random) {
    model::RegisterFile file = random_coded_registers(random);
    std::uint32_t serial = 1;
    for (model::ObjectRegisters& object : file.objects) {
        object.serial = serial++;
        object.books = static_cast<model::WordAddress>(random.in(0, (1 << 27) - 1));
        object.book_counts.alpha = random.chance(0.5);
        std::size_t bytes = object.book_counts.alpha ? model::BookBanks::kAlphaBytes : 0;
        for (const std::size_t set : {0U, 1U}) {
            int& blocks = object.book_counts.block[set];
            int& quarters = object.book_counts.quarter[set];
            blocks = random.chance(0.6) ? 0 : static_cast<int>(random.in(1, codec::kMaxBlockStages));
            quarters = random.chance(0.4) ? 0 : static_cast<int>(random.in(1, codec::kMaxQuarterStages));
            bytes += static_cast<std::size_t>(blocks) * model::BookBanks::kBlockBytes +
                     static_cast<std::size_t>(quarters) * model::BookBanks::kQuarterBytes;
        }
        object.book_words = static_cast<std::uint32_t>(bytes / 8);
    }
    return file;
}

/// A word of codebooks: differences of all lengths, so that sums are clamped sometimes.
inline std::uint64_t random_book_word(Random& random) {
    std::uint64_t word = 0;
    for (int n = 0; n < 8; ++n) word = word << 8U | static_cast<std::uint8_t>(random.of_any_length(8));
    return word;
}

/// A pixel of a view behind its last hop.
inline model::CodedPixel random_complete_pixel(const model::RegisterFile& file, int view, Random& random) {
    const model::BookCounts& counts = file.object_of(view).book_counts;
    model::CodedPixel pixel;
    pixel.view = view;
    pixel.is_visible = random.chance(0.9);
    if (!pixel.is_visible) return pixel;
    const auto last = static_cast<int>(random.in(0, random.chance(0.5) ? 1 : model::kHops - 1));
    for (int n = 0; n <= last; ++n) {
        model::HopLookup hop = random_lookup(random);
        hop.predicted = n < last;
        const auto set = static_cast<std::size_t>(hop.predicted);
        hop.block_stages = static_cast<int>(random.in(0, counts.block[set]));
        hop.quarter_stages = static_cast<int>(random.in(0, counts.quarter[set]));
        pixel.hop[static_cast<std::size_t>(pixel.hops++)] = hop;
    }
    random_colour(pixel, random);
    if (pixel.alpha == model::CodedPixel::Alpha::book && !counts.alpha) {
        pixel.alpha = model::CodedPixel::Alpha::full;
    }
    if (last > 0 && pixel.alpha == model::CodedPixel::Alpha::none) pixel.alpha = model::CodedPixel::Alpha::full;
    return pixel;
}

// Register look-ups of the chain of a hop of the module `m`, in a member function of a bench.
#define RS_RTL_LOOK_UP_HOP(hop)                                                                                      \
    do {                                                                                                             \
        const model::ObjectRegisters& found = this->object(m.finder_##hop##_view);                                   \
        m.finder_##hop##_object_tile_columns = static_cast<CData>(found.tile_columns);                               \
        m.finder_##hop##_object_table_pitch = static_cast<CData>(found.table_pitch);                                 \
        m.finder_##hop##_object_tile_table = found.tile_table;                                                       \
        const model::ObjectRegisters& read = this->object(m.reader_##hop##_view);                                    \
        m.reader_##hop##_object_record_sizes = record_sizes(read.classes[0]);                                        \
        m.reader_##hop##_object_predicted_sizes = record_sizes(read.classes[1]);                                     \
        const model::ObjectRegisters& moved = this->object(m.motion_##hop##_view);                                   \
        m.motion_##hop##_object_classes = class_bytes(moved.classes[0]);                                             \
        m.motion_##hop##_object_predicted_classes = class_bytes(moved.classes[1]);                                   \
        m.motion_##hop##_object_coded_width = static_cast<SData>(moved.coded_width);                                 \
        m.motion_##hop##_object_coded_height = static_cast<SData>(moved.coded_height);                               \
        m.select_##hop##_object_coded_height = static_cast<SData>(this->object(m.select_##hop##_view).coded_height); \
    } while (false)

}  // namespace rs::engine::rtl
