#include "rayspace/image_io/backend/file_checks.hpp"

#include "rayspace/image_io/backend/byte_source.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <map>
#include <string_view>
#include <vector>

namespace rs::image_io {
namespace {

using Bytes = std::vector<unsigned char>;

constexpr std::size_t kLargest_bytes = 16 << 20;
constexpr std::size_t kHeader_bytes = 128;
constexpr std::uint32_t kMost = 1000;  // limit of tags, and of texts per tag

bool has_at(std::span<const unsigned char> bytes, std::size_t at, std::string_view text) {
    return at + text.size() <= bytes.size() && std::memcmp(bytes.data() + at, text.data(), text.size()) == 0;
}

bool is_inside(std::span<const unsigned char> bytes, std::uint64_t at, std::uint64_t count) {
    return at + count <= bytes.size();
}

// Checks a tag of texts in several languages: records of 12 bytes with the text's position.
bool has_valid_texts(std::span<const unsigned char> icc, std::uint64_t tag_at) {
    constexpr std::uint64_t kFirstRecord = 16, kRecord_bytes = 12;
    if (!is_inside(icc, tag_at, kFirstRecord)) return false;
    const std::uint32_t records = big_endian(icc.data() + tag_at + 8);
    if (records > kMost || big_endian(icc.data() + tag_at + 12) != kRecord_bytes) return false;
    if (!is_inside(icc, tag_at + kFirstRecord, records * kRecord_bytes)) return false;
    for (std::uint32_t i = 0; i < records; ++i) {
        const unsigned char* const record = icc.data() + tag_at + kFirstRecord + i * kRecord_bytes;
        if (!is_inside(icc, tag_at + big_endian(record + 8), big_endian(record + 4))) return false;
    }
    return true;
}

// Reads the next marker as libjpeg does, skipping other bytes. Returns 0 at the end of the file.
unsigned char next_marker(ByteSource& source) {
    unsigned char byte = 0;
    for (;;) {
        while (byte != 0xFF) {
            if (!source.take(&byte, 1)) return 0;
        }
        while (byte == 0xFF) {
            if (!source.take(&byte, 1)) return 0;
        }
        if (byte != 0) return byte;
    }
}

// Joins the profile's parts by their numbers; stops at the image data.
bool is_jpeg_profile_valid(ByteSource& source) {
    constexpr std::string_view kName("ICC_PROFILE\0", 12);
    constexpr std::size_t kPartAt = kName.size() + 2;  // after the part's number and the number of parts
    std::map<unsigned char, Bytes> parts;
    std::size_t together = 0;
    source.go_to(2);
    for (;;) {
        const unsigned char marker = next_marker(source);
        if (marker == 0 || marker == 0xDA || marker == 0xD9) break;
        if (marker == 0x01 || (marker >= 0xD0 && marker <= 0xD8)) continue;  // no segment follows
        std::array<unsigned char, 2> length{};
        if (!source.take(length.data(), 2)) break;
        const std::size_t size = std::size_t{length[0]} << 8U | length[1];
        if (size < 2) break;
        Bytes payload(size - 2);
        if (!source.take(payload.data(), payload.size())) break;
        if (marker != 0xE2 || !has_at(payload, 0, kName)) continue;
        if (payload.size() < kPartAt) return false;
        together += payload.size();
        if (together > kLargest_bytes) return false;
        Bytes& part = parts[payload[kName.size()]];
        part.insert(part.end(), payload.begin() + kPartAt, payload.end());
    }
    Bytes profile;
    for (const auto& [number, part] : parts) profile.insert(profile.end(), part.begin(), part.end());
    return is_valid_profile(profile);
}

Bytes inflate_profile(std::span<const unsigned char> packed) {
    Bytes profile(kLargest_bytes + 1);
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

bool is_png_profile_valid(ByteSource& source) {
    std::array<unsigned char, 8> head{};  // length, type
    int profiles = 0;
    source.go_to(8);
    while (source.take(head.data(), head.size())) {
        const std::size_t length = big_endian(head.data());
        if (has_at(head, 4, "IDAT") || has_at(head, 4, "IEND")) break;
        if (!has_at(head, 4, "iCCP")) {
            if (!source.skip(length + 4)) break;
            continue;
        }
        if (length > kLargest_bytes || ++profiles > 4) return false;
        Bytes chunk(length);
        if (!source.take(chunk.data(), length) || !source.skip(4)) break;
        const auto name_end = std::find(chunk.begin(), chunk.end(), 0);
        if (chunk.end() - name_end < 2) continue;
        const auto packed = std::span(chunk).subspan(static_cast<std::size_t>(name_end - chunk.begin()) + 2);
        if (!is_valid_profile(inflate_profile(packed))) return false;
    }
    return true;
}

// The first directory, which is the one that readers use, of classic TIFF or BigTIFF, in either byte order.
class TiffDirectory {
public:
    TiffDirectory(ByteSource& source, bool little_endian) : source_(source), little_endian_(little_endian) {}

    bool is_sound() {
        constexpr std::uint64_t kMostEntries = 0xFFFF;
        Bytes head(14);  // version; offset size (BigTIFF); offset
        source_.go_to(2);
        head.resize(source_.take_some(head.data(), head.size()));
        const bool is_big = number(head, 0, 2) == 43;
        const std::size_t offset_bytes = is_big ? 8 : 4, entry_bytes = is_big ? 20 : 12, count_bytes = is_big ? 8 : 2;
        source_.go_to(number(head, is_big ? 6 : 2, offset_bytes));
        Bytes count(count_bytes);
        if (!source_.take(count.data(), count.size())) return true;
        Bytes entries(entry_bytes * std::min(number(count, 0, count_bytes), kMostEntries));
        entries.resize(source_.take_some(entries.data(), entries.size()));
        for (std::size_t at = 0; at + entry_bytes <= entries.size(); at += entry_bytes) {
            constexpr std::uint64_t kIccProfile = 34675, kByte = 1, kUndefined = 7;
            if (number(entries, at, 2) != kIccProfile) continue;
            const std::uint64_t type = number(entries, at + 2, 2), size = number(entries, at + 4, offset_bytes);
            // libtiff converts other types to bytes.
            if ((type != kByte && type != kUndefined) || size > kLargest_bytes) return false;
            Bytes profile(size);
            source_.go_to(number(entries, at + 4 + offset_bytes, offset_bytes));
            if (source_.take(profile.data(), profile.size()) && !is_valid_profile(profile)) return false;
        }
        return true;
    }

private:
    [[nodiscard]] std::uint64_t number(const Bytes& bytes, std::size_t at, std::size_t size) const {
        if (at + size > bytes.size()) return 0;
        std::uint64_t value = 0;
        for (std::size_t i = 0; i < size; ++i) value = value << 8U | bytes[at + (little_endian_ ? size - 1 - i : i)];
        return value;
    }

    ByteSource& source_;
    bool little_endian_;
};

bool is_webp_profile_valid(ByteSource& source) {
    std::array<unsigned char, 8> head{};  // type, length
    source.go_to(12);
    while (source.take(head.data(), head.size())) {
        const std::array<unsigned char, 4> size{head[7], head[6], head[5], head[4]};
        const std::uint64_t length = big_endian(size.data());
        if (!has_at(head, 0, "ICCP")) {
            if (!source.skip(length + length % 2)) break;
            continue;
        }
        if (length > kLargest_bytes) return false;
        Bytes profile(length);
        if (!source.take(profile.data(), length) || (length % 2 == 1 && !source.skip(1))) break;
        if (!is_valid_profile(profile)) return false;
    }
    return true;
}

}  // namespace

bool is_valid_profile(std::span<const unsigned char> icc) {
    constexpr std::uint64_t kEntry_bytes = 12;
    if (icc.size() > kLargest_bytes) return false;
    if (icc.size() < kHeader_bytes + 4 || !has_at(icc, 36, "acsp")) return true;
    const std::uint32_t size = big_endian(icc.data());
    if (size > icc.size() || size < kHeader_bytes + 4) return true;
    icc = icc.first(size);
    const std::uint32_t tags = big_endian(icc.data() + kHeader_bytes);
    if (tags > kMost || !is_inside(icc, kHeader_bytes + 4, tags * kEntry_bytes)) return false;
    for (std::uint32_t i = 0; i < tags; ++i) {
        const unsigned char* const entry = icc.data() + kHeader_bytes + 4 + i * kEntry_bytes;
        const std::uint32_t at = big_endian(entry + 4), tag_size = big_endian(entry + 8);
        if (!is_inside(icc, at, std::max(tag_size, 4U))) return false;
        if (has_at(icc, at, "text") && tag_size < 8) return false;
        if (has_at(icc, at, "desc") && tag_size < 12) return false;
        if (has_at(icc, at, "mluc") && !has_valid_texts(icc, at)) return false;
    }
    return true;
}

Status check_profile_integrity(const std::string& path) {
    ByteSource source(path);
    std::array<unsigned char, 12> begin{};
    source.take_some(begin.data(), begin.size());
    bool sound = true;
    if (has_at(begin, 0, "\xFF\xD8")) {
        sound = is_jpeg_profile_valid(source);
    } else if (has_at(begin, 1, "PNG\r\n")) {
        sound = is_png_profile_valid(source);
    } else if (has_at(begin, 0, "II") || has_at(begin, 0, "MM")) {
        sound = TiffDirectory(source, begin[0] == 'I').is_sound();
    } else if (has_at(begin, 0, "RIFF") && has_at(begin, 8, "WEBP")) {
        sound = is_webp_profile_valid(source);
    } else if (has_at(begin, 0, {"\0\0\1\0", 4}) || has_at(begin, 0, "8BPS") || has_at(begin, 4, "jP  ")) {
        return Error{path + ": icons, Photoshop's and JPEG 2000 files are not read; convert it to PNG or TIFF"};
    }
    if (sound) return {};
    return Error{path +
                 ": its colour profile is damaged; take it out, e.g. with exiftool -icc_profile= or "
                 "mogrify +profile icm"};
}

}  // namespace rs::image_io
