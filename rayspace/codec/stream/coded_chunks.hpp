#pragma once
// Payloads of coded images: chunk CODE, and chunk PICT with coding 1. encode/FORMAT.md, sections "CODE" and "PICT".
// Parsers check everything that decode_tile() requires. Their messages contain no file name; the caller adds it.

#include "rayspace/base/result.hpp"
#include "rayspace/codec/code/coded_images.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rs::codec {

inline constexpr std::uint8_t kCodedImage = 1;  // the `coding` of a PICT chunk
inline constexpr std::uint32_t kMaxTile_bytes = 65535;

std::vector<std::byte> code_payload(const CodedImages& coded);
/// Parses CODE of an object with `views` images of width x height. All images are unloaded afterwards.
Status parse_code(std::span<const std::byte> payload, std::size_t views, int width, int height, CodedImages& coded);

std::vector<std::byte> coded_image_payload(const CodedImages& coded, std::size_t view);
Status parse_coded_image(std::span<const std::byte> payload, std::size_t view, CodedImages& coded);

/// The memory that parse_coded_image() allocates beside the payload's own size.
std::uint64_t tile_table_bytes(const CodedImages& coded);

}  // namespace rs::codec
