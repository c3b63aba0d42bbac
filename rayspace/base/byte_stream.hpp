#pragma once
// Reads and writes little-endian numbers, for the .rso format (encode/FORMAT.md).

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace rs {

class ByteWriter {
public:
    template <std::integral T>
    void put(T number) {
        using Bits = std::make_unsigned_t<T>;
        auto bits = static_cast<Bits>(number);
        for (std::size_t i = 0; i < sizeof(T); ++i) {
            bytes_.push_back(static_cast<std::byte>(bits & 0xFFU));
            // Two shifts of 4, since a shift by 8 is undefined for operands of 8 bits that are not promoted.
            bits = static_cast<Bits>(bits >> 4U >> 4U);
        }
    }
    void put(double number) {
        std::uint64_t bits = 0;
        std::memcpy(&bits, &number, sizeof bits);
        put(bits);
    }
    void put(std::span<const std::byte> bytes) { bytes_.insert(bytes_.end(), bytes.begin(), bytes.end()); }
    void put(std::span<const std::uint8_t> bytes) { put(std::as_bytes(bytes)); }
    void put(const std::string& text) { put(std::as_bytes(std::span(text))); }
    void put_zeros(std::size_t count) { bytes_.resize(bytes_.size() + count); }
    void reserve(std::size_t count) { bytes_.reserve(count); }

    [[nodiscard]] const std::vector<std::byte>& bytes() const { return bytes_; }
    [[nodiscard]] std::size_t size() const { return bytes_.size(); }

private:
    std::vector<std::byte> bytes_;
};

/// Reads past the end return zeros and make ok() false. A parser checks ok() once at its end, and before it allocates
/// memory by a number it has read.
class ByteReader {
public:
    explicit ByteReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

    template <std::integral T>
    T get() {
        using Bits = std::make_unsigned_t<T>;
        const std::span<const std::byte> taken = take(sizeof(T));
        Bits bits = 0;
        for (std::size_t i = 0; i < taken.size(); ++i) {
            bits = static_cast<Bits>(bits | static_cast<Bits>(static_cast<Bits>(taken[i]) << (8 * i)));
        }
        return static_cast<T>(bits);
    }
    double get_double() {
        const auto bits = get<std::uint64_t>();
        double number = 0;
        std::memcpy(&number, &bits, sizeof number);
        return number;
    }
    /// The next `count` bytes; empty if there are fewer.
    std::span<const std::byte> take(std::size_t count) {
        if (count > bytes_.size()) {
            ok_ = false;
            bytes_ = {};
            return {};
        }
        const auto taken = bytes_.first(count);
        bytes_ = bytes_.subspan(count);
        return taken;
    }
    /// True if the next `count` bytes exist and are zero.
    bool take_zeros(std::size_t count) {
        for (const std::byte b : take(count)) {
            if (b != std::byte{0}) return false;
        }
        return ok_;
    }

    [[nodiscard]] bool ok() const { return ok_; }
    [[nodiscard]] bool at_end() const { return ok_ && bytes_.empty(); }
    [[nodiscard]] std::size_t left() const { return bytes_.size(); }

private:
    std::span<const std::byte> bytes_;
    bool ok_ = true;
};

}  // namespace rs
