#pragma once
// The payloads of coded pictures: chunk CODE, and chunk PICT with coding 1. encode/FORMAT.md, sections "CODE" and
// "PICT". Parsers check everything that decode_tile() relies on; their messages have no file name, the caller knows it.

#include "rayspace/base/result.hpp"
#include "rayspace/codec/code/coded_pictures.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rs::codec {

inline constexpr std::uint8_t kCodedPicture = 1;  // the `coding` of a PICT chunk
inline constexpr std::uint32_t kMaxTile_bytes = 65535;

std::vector<std::byte> code_payload(const CodedPictures& coded);
// Of an object of `views` pictures of width x height; every picture is not loaded then.
Status parse_code(std::span<const std::byte> payload, std::size_t views, int width, int height, CodedPictures& coded);

std::vector<std::byte> coded_picture_payload(const CodedPictures& coded, std::size_t view);
Status parse_coded_picture(std::span<const std::byte> payload, std::size_t view, CodedPictures& coded);

// What parse_coded_picture() will need, beside the payload's own size.
std::uint64_t tile_table_bytes(const CodedPictures& coded);

}  // namespace rs::codec
