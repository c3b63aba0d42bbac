#pragma once
// The payloads of coded images: chunk CODE, and chunk PICT with coding 1. encode/FORMAT.md, sections "CODE" and
// "PICT". Parsers check everything that decode_tile() relies on; their messages have no file name, the caller knows it.

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
// Of an object of `views` images of width x height; every image is not loaded then.
Status parse_code(std::span<const std::byte> payload, std::size_t views, int width, int height, CodedImages& coded);

std::vector<std::byte> coded_image_payload(const CodedImages& coded, std::size_t view);
Status parse_coded_image(std::span<const std::byte> payload, std::size_t view, CodedImages& coded);

// What parse_coded_image() will need, beside the payload's own size.
std::uint64_t tile_table_bytes(const CodedImages& coded);

}  // namespace rs::codec
