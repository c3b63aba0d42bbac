#include "engine/model/blocks/decompression/book_lookup.hpp"

#include <algorithm>

namespace rs::engine::model {
namespace {

std::array<int, 3> sum_of_entries(const BookBanks& banks, const HopLookup& hop) {
    const std::size_t set = hop.predicted ? 1 : 0;
    const auto x = static_cast<std::size_t>(hop.x);
    const auto y = static_cast<std::size_t>(hop.y);
    std::array<int, 3> sum{};
    for (std::size_t s = 0; s < static_cast<std::size_t>(hop.block_stages); ++s) {
        const std::int8_t* const entry =
            banks.block[set][s].data() + std::size_t{hop.block[s]} * codec::kBlockDimensions;
        const std::size_t pair = y / 2 * 4 + x / 2;
        sum[0] += entry[8 * y + x];
        sum[1] += entry[64 + pair];
        sum[2] += entry[80 + pair];
    }
    for (std::size_t s = 0; s < static_cast<std::size_t>(hop.quarter_stages); ++s) {
        const std::int8_t* const entry =
            banks.quarter[set][s].data() + std::size_t{hop.quarter[s]} * codec::kQuarterDimensions;
        const std::size_t place = y % 4 * 4 + x % 4;
        for (std::size_t plane = 0; plane < 3; ++plane) sum[plane] += entry[16 * plane + place];
    }
    return sum;
}

}  // namespace

void BookBanks::set_byte(const BookCounts& counts, std::size_t place, std::uint8_t value) {
    for (std::size_t set = 0; set < 2; ++set) {
        for (std::size_t s = 0; s < static_cast<std::size_t>(counts.block[set]); ++s) {
            if (place < kBlockBytes) {
                block[set][s][place] = static_cast<std::int8_t>(value);
                return;
            }
            place -= kBlockBytes;
        }
        for (std::size_t s = 0; s < static_cast<std::size_t>(counts.quarter[set]); ++s) {
            if (place < kQuarterBytes) {
                quarter[set][s][place] = static_cast<std::int8_t>(value);
                return;
            }
            place -= kQuarterBytes;
        }
    }
    if (place < kAlphaBytes) alpha[place] = value;
}

YuvaPixel decode_coded_pixel(const BookBanks& banks, const CodedPixel& pixel) {
    YuvaPixel out;
    out.view = pixel.view;
    if (!pixel.is_visible || pixel.alpha == CodedPixel::Alpha::none) return out;
    std::array<int, 3> samples = {pixel.flat[0], pixel.flat[1], pixel.flat[2]};
    for (int h = pixel.hops - 1; h >= 0; --h) {
        const std::array<int, 3> sum = sum_of_entries(banks, pixel.hop[static_cast<std::size_t>(h)]);
        for (std::size_t plane = 0; plane < 3; ++plane) {
            samples[plane] = std::clamp(samples[plane] + sum[plane], 0, 255);
        }
    }
    out.y = samples[0];
    out.u = samples[1];
    out.v = samples[2];
    const HopLookup& first = pixel.hop[0];
    const auto place = static_cast<std::size_t>(first.y % 4 * 4 + first.x % 4);
    out.alpha = pixel.alpha == CodedPixel::Alpha::full ? 255 : banks.alpha[std::size_t{16} * pixel.alpha_entry + place];
    return out;
}

BookLookup::BookLookup(const RegisterFile& registers, const Ports& ports)
    : Block("book_lookup", "latency " + std::to_string(kStages + 1) +
                               ", a pixel per cycle, one more for each prediction but the first; a word of new books "
                               "per cycle"),
      registers_(registers),
      in_(reads(ports.in)),
      requests_(writes(ports.requests)),
      words_(reads(ports.words)),
      stage_(kStages, writes(ports.out)) {}

Activity BookLookup::load() {
    const ObjectRegisters& object = registers_.object_of(in_.front().view);
    Activity activity = requested_ < object.book_words ? Activity::memory_port : Activity::memory_data;
    if (requested_ < object.book_words && requests_.can_push()) {
        requests_.push({object.books + requested_++, false});
        activity = Activity::busy;
    }
    if (words_.can_pop()) {
        const std::uint64_t word = words_.pop().data;
        for (std::size_t n = 0; n < 8; ++n) {
            banks_.set_byte(object.book_counts, 8 * std::size_t{written_} + n,
                            static_cast<std::uint8_t>(word >> (8 * n)));
        }
        ++written_;
        activity = Activity::busy;
    }
    if (written_ == object.book_words) {
        resident_ = object.serial;
        loading_ = false;
    }
    return activity;
}

Activity BookLookup::look_up(std::optional<YuvaPixel>& out) {
    if (!in_.can_pop()) return Activity::idle;
    if (in_.front().is_visible && registers_.object_of(in_.front().view).serial != resident_) {
        if (!stage_.empty()) return Activity::busy;  // drain the pipeline first
        loading_ = true;
        requested_ = written_ = 0;
        ++book_loads_;
        return load();
    }
    // Flat and predicted banks process one hop each per cycle; the pixel leaves with its last prediction.
    if (turns_ < in_.front().hops - 2) {
        ++turns_;
        return Activity::busy;
    }
    out = decode_coded_pixel(banks_, in_.front());
    in_.pop();
    turns_ = 0;
    return Activity::busy;
}

Activity BookLookup::tick(std::uint64_t) {
    if (loading_) return load();
    return stage_.step([&](auto& out) { return look_up(out); });
}

}  // namespace rs::engine::model
