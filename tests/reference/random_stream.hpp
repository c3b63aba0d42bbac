#pragma once
// Valid random payloads of CODE and PICT: any bytes of a tile decode to some samples.

#include "rayspace/codec/code/coded_images.hpp"
#include "tests/reference/decoder/reference_chunks.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace rs::reference {

struct Stream {
    int width = 0;  // px
    int height = 0;
    std::vector<std::uint8_t> code;
    std::vector<std::vector<std::uint8_t>> picts;  // [view]
};

/// Deterministic. 2 .. 5 views of at most 96 x 96, or 420 x 32 or 32 x 420.
[[nodiscard]] Stream random_stream(std::uint64_t seed, Profile profile);

/// Runs the library's parsers on the stream; returns "" or their message. All images are loaded then.
[[nodiscard]] std::string parse_stream(const Stream& stream, codec::CodedImages& coded);

inline std::span<const std::byte> as_payload(const std::vector<std::uint8_t>& bytes) {
    return std::as_bytes(std::span(bytes));
}

}  // namespace rs::reference
