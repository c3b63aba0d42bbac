#include "rayspace/pictures/backend/profile_integrity.hpp"

#include "rayspace/pictures/backend/byte_source.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <map>
#include <string_view>
#include <vector>

namespace rs::pictures {
namespace {

using Bytes = std::vector<unsigned char>;

constexpr std::size_t kLargest_bytes = 16 << 20;
constexpr std::size_t kHeader_bytes = 128;
constexpr std::size_t kMarkAt = 36;  // "acsp"
constexpr std::string_view kMark = "acsp";

bool has_at(std::span<const unsigned char> bytes, std::size_t at, std::string_view text) {
    return at + text.size() <= bytes.size() && std::memcmp(bytes.data() + at, text.data(), text.size()) == 0;
}

bool lies_inside(std::span<const unsigned char> bytes, std::uint64_t at, std::uint64_t count) {
    return at + count <= bytes.size();
}

// Texts in several languages: 12 bytes about each, which say where it is.
bool has_sound_texts(std::span<const unsigned char> icc, std::uint64_t tag_at) {
    constexpr std::uint64_t kFirstRecord = 16, kRecord_bytes = 12;
    if (!lies_inside(icc, tag_at, kFirstRecord)) return false;
    const std::uint32_t records = big_endian(icc.data() + tag_at + 8);
    if (big_endian(icc.data() + tag_at + 12) != kRecord_bytes) return false;
    if (!lies_inside(icc, tag_at + kFirstRecord, records * kRecord_bytes)) return false;
    for (std::uint32_t i = 0; i < records; ++i) {
        const unsigned char* const record = icc.data() + tag_at + kFirstRecord + i * kRecord_bytes;
        if (!lies_inside(icc, tag_at + big_endian(record + 8), big_endian(record + 4))) return false;
    }
    return true;
}

// The segments' parts in the order of their numbers; ends at the picture's data.
Bytes profile_of_jpeg(ByteSource& source) {
    constexpr std::string_view kName("ICC_PROFILE\0", 12);
    std::map<unsigned char, Bytes> parts;
    std::array<unsigned char, 2> marker{};
    source.go_to(2);
    while (source.take(marker.data(), 2) && marker[0] == 0xFF) {
        if (marker[1] == 0xFF) {  // filling
            while (marker[1] == 0xFF && source.take(&marker[1], 1)) {
            }
        }
        if (marker[1] == 0xDA || marker[1] == 0xD9) break;
        std::array<unsigned char, 2> length{};
        if (!source.take(length.data(), 2)) break;
        const std::size_t size = std::size_t{length[0]} << 8U | length[1];
        if (size < 2) break;
        Bytes payload(size - 2);
        if (!source.take(payload.data(), payload.size())) break;
        if (marker[1] != 0xE2 || !has_at(payload, 0, kName) || payload.size() < kName.size() + 2) continue;
        Bytes& part = parts[payload[kName.size()]];
        part.insert(part.end(), payload.begin() + static_cast<std::ptrdiff_t>(kName.size()) + 2, payload.end());
    }
    Bytes profile;
    for (const auto& [number, part] : parts) profile.insert(profile.end(), part.begin(), part.end());
    return profile;
}

Bytes inflated(std::span<const unsigned char> packed) {
    Bytes profile(kLargest_bytes);
    z_stream stream{};
    if (inflateInit(&stream) != Z_OK) return {};
    stream.next_in = const_cast<unsigned char*>(packed.data());
    stream.avail_in = static_cast<uInt>(packed.size());
    stream.next_out = profile.data();
    stream.avail_out = static_cast<uInt>(profile.size());
    inflate(&stream, Z_FINISH);
    profile.resize(stream.total_out);
    inflateEnd(&stream);
    return profile;
}

Bytes profile_of_png(ByteSource& source) {
    std::array<unsigned char, 8> head{};  // length, type
    source.go_to(8);
    while (source.take(head.data(), head.size())) {
        const std::size_t length = big_endian(head.data());
        if (has_at(head, 4, "IDAT") || has_at(head, 4, "IEND")) break;
        if (!has_at(head, 4, "iCCP") || length > kLargest_bytes) {
            if (!source.skip(length + 4)) break;
            continue;
        }
        Bytes chunk(length);
        if (!source.take(chunk.data(), length)) break;
        const auto name_end = std::find(chunk.begin(), chunk.end(), 0);
        if (chunk.end() - name_end < 2) break;
        return inflated(std::span(chunk).subspan(static_cast<std::size_t>(name_end - chunk.begin()) + 2));
    }
    return {};
}

// Every place that has a profile's mark.
bool has_sound_profiles(ByteSource& source) {
    constexpr std::size_t kPiece = 1 << 20;
    Bytes piece(kPiece);
    for (std::uint64_t at = 0;;) {
        source.go_to(at);
        const std::size_t got = source.take_some(piece.data(), kPiece);
        const std::string_view text(reinterpret_cast<const char*>(piece.data()), got);
        for (std::size_t found = text.find(kMark); found != std::string_view::npos;
             found = text.find(kMark, found + 1)) {
            if (at + found < kMarkAt) continue;
            source.go_to(at + found - kMarkAt);
            std::array<unsigned char, 4> size{};
            if (!source.take(size.data(), size.size()) || big_endian(size.data()) > kLargest_bytes) continue;
            Bytes profile(big_endian(size.data()));
            source.go_to(at + found - kMarkAt);
            if (source.take(profile.data(), profile.size()) && !is_sound_profile(profile)) return false;
        }
        if (got < kPiece) return true;
        at += got - kMark.size();
    }
}

}  // namespace

bool is_sound_profile(std::span<const unsigned char> icc) {
    constexpr std::uint64_t kEntry_bytes = 12;
    if (icc.size() < kHeader_bytes + 4 || !has_at(icc, kMarkAt, kMark)) return true;
    if (big_endian(icc.data()) != icc.size()) return true;
    const std::uint32_t tags = big_endian(icc.data() + kHeader_bytes);
    if (!lies_inside(icc, kHeader_bytes + 4, tags * kEntry_bytes)) return false;
    for (std::uint32_t i = 0; i < tags; ++i) {
        const unsigned char* const entry = icc.data() + kHeader_bytes + 4 + i * kEntry_bytes;
        const std::uint32_t at = big_endian(entry + 4), size = big_endian(entry + 8);
        if (!lies_inside(icc, at, std::max(size, 4U))) return false;
        if (has_at(icc, at, "text") && size < 8) return false;
        if (has_at(icc, at, "desc") && size < 12) return false;
        if (has_at(icc, at, "mluc") && !has_sound_texts(icc, at)) return false;
    }
    return true;
}

Status check_profile_integrity(const std::string& path) {
    ByteSource source(path);
    std::array<unsigned char, 12> begin{};
    source.take_some(begin.data(), begin.size());
    bool sound = true;
    if (has_at(begin, 0, "\xFF\xD8\xFF")) {
        sound = is_sound_profile(profile_of_jpeg(source));
    } else if (has_at(begin, 1, "PNG\r\n")) {
        sound = is_sound_profile(profile_of_png(source));
    } else if (has_at(begin, 0, "II*") || has_at(begin, 0, "II+") || has_at(begin, 0, {"MM\0", 3}) ||
               has_at(begin, 0, "8BPS") || has_at(begin, 8, "WEBP") || has_at(begin, 4, "jP  ")) {
        sound = has_sound_profiles(source);
    }
    if (sound) return {};
    return Error{path +
                 ": its colour profile is damaged; take it out, e.g. with exiftool -icc_profile= or "
                 "mogrify +profile icm"};
}

}  // namespace rs::pictures
