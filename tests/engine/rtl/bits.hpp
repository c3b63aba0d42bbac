#pragma once
// Bit vectors of RTL ports: messages of the model as packed structures of engine/rtl/messages.svh, and their transfer
// from and to the ports of a verilated module.

#include "engine/model/signals/coded_messages.hpp"
#include "engine/model/signals/messages.hpp"
#include "rayspace/api/types/check.hpp"

#include <verilated.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <type_traits>

namespace rs::engine::rtl {

/// Value of a port of at most 896 bits, in words of 32 bits, the lowest first.
struct Bits {
    static constexpr int kWords = 28;
    std::array<std::uint32_t, kWords> words{};
    bool operator==(const Bits&) const = default;
};

inline std::string text(const Bits& bits) {
    constexpr const char* kDigits = "0123456789abcdef";
    std::string hex;
    for (int n = Bits::kWords * 8 - 1; n >= 0; --n) {
        const std::uint32_t digit = bits.words[static_cast<std::size_t>(n / 8)] >> static_cast<unsigned>(n % 8 * 4);
        if ((digit & 15U) != 0 || !hex.empty() || n == 0) hex += kDigits[digit & 15U];
    }
    return "0x" + hex;
}

/// Appends fields from the highest bit of a packed structure downwards. The widths must add up to those of the
/// structure; a field keeps its low bits.
class BitsWriter {
public:
    explicit BitsWriter(int width_bits) : left_bits_(width_bits) { RS_CHECK(width_bits <= 32 * Bits::kWords); }

    BitsWriter& put(std::int64_t value, int width_bits) {
        left_bits_ -= width_bits;
        RS_CHECK(left_bits_ >= 0);
        for (int bit = 0; bit < width_bits; ++bit) {
            const int place = left_bits_ + bit;
            const std::uint32_t is_set = static_cast<std::uint32_t>(value >> bit) & 1U;
            bits_.words[static_cast<std::size_t>(place / 32)] |= is_set << static_cast<unsigned>(place % 32);
        }
        return *this;
    }
    [[nodiscard]] const Bits& bits() const {
        RS_CHECK(left_bits_ == 0);
        return bits_;
    }

private:
    Bits bits_;
    int left_bits_;
};

inline Bits pack(const model::ViewJob& m) {
    return BitsWriter(m.kBits).put(m.view, 4).bits();
}
inline Bits pack(const model::ColumnRay& m) {
    return BitsWriter(m.kBits)
        .put(m.view, 4)
        .put(m.has_ray, 1)
        .put(m.plane, 4)
        .put(m.n_q28, 31)
        .put(m.t_q28, 32)
        .bits();
}
// With slope and direction where the width has them.
template <class Ray>
Bits with_direction(BitsWriter& writer, const Ray& m, int width_bits) {
    if (width_bits == m.kBitsWithDirection) writer.put(m.u_q28, 30).put(m.n_q28, 31).put(m.t_q28, 32);
    return writer.bits();
}
inline Bits pack(const model::RayPoint& m, int width_bits) {
    BitsWriter writer(width_bits);
    writer.put(m.view, 4)
        .put(m.has_ray, 1)
        .put(m.plane, 4)
        .put(m.x_q20, 23)
        .put(m.lambda_q20, 29)
        .put(static_cast<std::int64_t>(m.cell_byte), 30);
    return with_direction(writer, m, width_bits);
}
inline Bits pack(const model::MappedRay& m, int width_bits) {
    BitsWriter writer(width_bits);
    writer.put(m.view, 4).put(m.has_ray, 1).put(m.plane, 4).put(m.x_q20, 23).put(m.lambda_q20, 29).put(m.image, 7);
    return with_direction(writer, m, width_bits);
}
inline Bits pack(const model::RayLine& m) {
    BitsWriter writer(m.kBits);
    writer.put(m.view, 4).put(m.has_ray, 1).put(m.x_q20, 23).put(m.lambda_q20, 29).put(m.image, 7);
    for (const std::int32_t value :
         {m.cx_q16, m.cy_q16, m.fl_y_q16, m.height_q20, m.l0_q20, m.l1_q30, m.q0_q16, m.q1_q16}) {
        writer.put(value, 32);
    }
    return writer.bits();
}
inline Bits pack(const model::ColumnWalk& m) {
    return BitsWriter(m.kBits)
        .put(m.view, 4)
        .put(m.has_ray, 1)
        .put(m.image, 7)
        .put(m.column, 9)
        .put(m.row_0_q16, 46)
        .put(m.row_step_q16, 36)
        .bits();
}
inline Bits pack(const model::PlacedColumn& m) {
    return BitsWriter(m.kBits)
        .put(m.view, 4)
        .put(m.has_ray, 1)
        .put(m.row_0_q16, 46)
        .put(m.row_step_q16, 36)
        .put(m.luma, 27)
        .put(m.chroma, 27)
        .put(m.alpha, 27)
        .bits();
}
inline Bits pack(const model::PixelPair& m) {
    return BitsWriter(m.kBits)
        .put(m.view, 4)
        .put(m.is_visible[0], 1)
        .put(m.is_visible[1], 1)
        .put(m.row[0], 9)
        .put(m.row[1], 9)
        .put(m.luma, 27)
        .put(m.chroma, 27)
        .put(m.alpha, 27)
        .bits();
}
inline Bits pack(const model::MemoryRead& m) {
    return BitsWriter(m.kBits).put(m.address, 27).put(m.null, 1).bits();
}
inline Bits pack(const model::MemoryWord& m) {
    return BitsWriter(m.kBits).put(static_cast<std::int64_t>(m.data), 64).bits();
}
inline Bits pack(const model::MemoryWrite& m) {
    return BitsWriter(m.kBits).put(m.address, 27).put(static_cast<std::int64_t>(m.data), 64).put(m.last, 1).bits();
}
inline Bits pack(const model::SampleTag& m) {
    BitsWriter writer(m.kBits);
    writer.put(m.view, 4).put(static_cast<int>(m.kind), 2).put(m.pixel, 1);
    for (const int n : {0, 1}) writer.put(m.has_alpha[n], 1).put(m.lane[n], 5);
    return writer.bits();
}
// With the level of alpha, of which the model holds 85 times, or with alpha of 8 bits.
inline Bits pack(const model::YuvaPixel& m, int width_bits) {
    BitsWriter writer(width_bits);
    writer.put(m.view, 4).put(m.y, 8).put(m.u, 8).put(m.v, 8);
    return width_bits == m.kBits ? writer.put(m.alpha / 85, 2).bits() : writer.put(m.alpha, 8).bits();
}
inline Bits pack(const model::RgbaPixel& m) {
    return BitsWriter(m.kBits).put(m.view, 4).put(m.rgba, 32).bits();
}
inline Bits pack(const model::ImageWord& m) {
    return BitsWriter(m.kBits).put(static_cast<std::int64_t>(m.data), 64).put(m.head, 1).put(m.last_view, 1).bits();
}
// The number of an image buffer or of an object, or 0; its FIFO has as many bits as the number needs.
inline Bits pack(const model::Done& m) {
    return BitsWriter(32).put(m.number, 32).bits();
}
inline Bits pack(const model::StartCommand& m) {
    return BitsWriter(m.kBits).put(static_cast<std::int64_t>(m.program), 1).bits();
}

inline BitsWriter& put(BitsWriter& writer, const model::BlockRequest& m) {
    return writer.put(m.view, 4)
        .put(m.first, 1)
        .put(m.down, 1)
        .put(m.image, 7)
        .put(m.column, 9)
        .put(m.block_row, 6)
        .put(m.rows, 8);
}
inline Bits pack(const model::BlockRequest& m) {
    BitsWriter writer(m.kBits);
    return put(writer, m).bits();
}
inline Bits pack(const model::FoundTile& m) {
    BitsWriter writer(m.kBits);
    return put(writer, m.request).put(m.same, 1).put(m.high, 1).bits();
}
inline Bits pack(const model::RequestedTile& m) {
    BitsWriter writer(m.kBits);
    return put(writer, m.request).put(static_cast<int>(m.kind), 2).put(m.address, 27).bits();
}
inline Bits pack(const model::RequestedRecord& m) {
    BitsWriter writer(m.kBits);
    return put(writer, m.request)
        .put(m.class_number, 3)
        .put(m.predicted_image, 1)
        .put(m.references[0], 7)
        .put(m.references[1], 7)
        .put(m.lane / 2, 2)
        .put(m.words, 3)
        .bits();
}
// The bytes of an array, that of index 0 in the low bits.
template <class Bytes>
BitsWriter& put_bytes(BitsWriter& writer, const Bytes& bytes) {
    for (std::size_t n = bytes.size(); n-- > 0;) writer.put(bytes[n], 8);
    return writer;
}
inline std::uint8_t class_byte(const codec::RecordClass& record) {
    return static_cast<std::uint8_t>((record.quarter_stages << 4) | (record.block_stages << 2) |
                                     (static_cast<int>(record.alpha) << 1) | static_cast<int>(record.predicted));
}
inline Bits pack(const model::BlockRecord& m) {
    BitsWriter writer(m.kBits);
    writer.put(m.block_row, 6)
        .put(m.empty, 1)
        .put(class_byte(m.record_class), 8)
        .put(m.motion_y, 7)
        .put(m.reference_column, 3);
    put_bytes(writer, m.flat);
    put_bytes(writer, m.block);
    for (std::size_t stage = m.quarter.size(); stage-- > 0;) put_bytes(writer, m.quarter[stage]);
    return put_bytes(writer, m.alpha).bits();
}
// With as many look-ups as the width has; those of hops that the pixel has not passed are 0.
inline Bits pack(const model::CodedPixel& m, int width_bits) {
    BitsWriter writer(width_bits);
    writer.put(m.view, 4).put(m.is_visible, 1).put(m.begins, 1).put(m.pending, 1).put(m.row, 9).put(m.column, 3);
    if (width_bits == model::CodedPixel::bits(0)) return writer.bits();
    put_bytes(writer, m.flat).put(static_cast<int>(m.alpha), 2).put(m.alpha_entry, 8);
    for (int n = 0; model::CodedPixel::bits(n) < width_bits; ++n) {
        const model::HopLookup& hop = m.hop[static_cast<std::size_t>(n)];
        writer.put(hop.predicted, 1).put(hop.block_stages, 2).put(hop.quarter_stages, 3);
        put_bytes(writer, hop.block);
        put_bytes(writer, hop.quarter).put(hop.x, 3).put(hop.y, 3);
    }
    return writer.bits();
}

/// Writes the low `width_bits` bits to a port.
template <class Port>
void write_port(Port& port, const Bits& bits, int width_bits) {
    if constexpr (std::is_integral_v<Port>) {
        const std::uint64_t value = bits.words[0] | std::uint64_t{bits.words[1]} << 32U;
        port = static_cast<Port>(width_bits == 64 ? value : value & ((std::uint64_t{1} << width_bits) - 1));
    } else {
        const int words = (width_bits + 31) / 32;
        for (int n = 0; n < words; ++n) port[static_cast<std::size_t>(n)] = bits.words[static_cast<std::size_t>(n)];
        if (width_bits % 32 != 0) port[static_cast<std::size_t>(words - 1)] &= (1U << (width_bits % 32)) - 1;
    }
}

template <class Port>
Bits read_port(const Port& port, int width_bits) {
    Bits bits;
    if constexpr (std::is_integral_v<Port>) {
        bits.words[0] = static_cast<std::uint32_t>(port);
        bits.words[1] = static_cast<std::uint32_t>(static_cast<std::uint64_t>(port) >> 32U);
    } else {
        for (int n = 0; n < (width_bits + 31) / 32; ++n) {
            bits.words[static_cast<std::size_t>(n)] = port[static_cast<std::size_t>(n)];
        }
    }
    return bits;
}

}  // namespace rs::engine::rtl
