#include "compositor/scene/gzip.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <limits>

namespace rs::compositor {
namespace {

struct Inflater {
    z_stream stream{};
    bool ready = false;

    Inflater() { ready = inflateInit2(&stream, 15 + 16) == Z_OK; }
    Inflater(const Inflater&) = delete;
    Inflater& operator=(const Inflater&) = delete;
    ~Inflater() {
        if (ready) inflateEnd(&stream);
    }
};

}  // namespace

bool is_gzip(std::span<const std::byte> bytes) {
    return bytes.size() >= 2 && bytes[0] == std::byte{0x1f} && bytes[1] == std::byte{0x8b};
}

Result<std::string> gunzip(std::span<const std::byte> bytes, std::uint64_t cap_bytes, const std::string& file) {
    const Error damaged{file + ": is a damaged or truncated gzip file; get it again"};
    Inflater inflater;
    if (!inflater.ready || bytes.size() > std::numeric_limits<uInt>::max()) return damaged;
    z_stream& stream = inflater.stream;
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<std::byte*>(bytes.data()));
    stream.avail_in = static_cast<uInt>(bytes.size());
    std::string text;
    std::array<char, 1 << 16> block{};
    while (true) {
        stream.next_out = reinterpret_cast<Bytef*>(block.data());
        stream.avail_out = static_cast<uInt>(block.size());
        const int state = inflate(&stream, Z_NO_FLUSH);
        if (state != Z_OK && state != Z_STREAM_END) return damaged;
        text.append(block.data(), block.size() - stream.avail_out);
        if (text.size() > cap_bytes) {
            return Error{file + ": unpacks to more than " + std::to_string(cap_bytes >> 20) + " MiB; make it smaller"};
        }
        if (state != Z_STREAM_END) continue;
        if (stream.avail_in == 0) return text;
        if (inflateReset(&stream) != Z_OK) return damaged;
    }
}

}  // namespace rs::compositor
