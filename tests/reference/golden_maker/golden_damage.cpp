#include "tests/reference/golden_maker/golden_damage.hpp"

#include "rayspace/api/types/check.hpp"

#include <zstd.h>

#include <utility>

namespace rs::golden {

std::size_t Draft::place(ChunkName name, std::uint32_t index) const {
    for (std::size_t i = 0; i < chunks.size(); ++i) {
        if (chunks[i].name == name && chunks[i].index == index) return i;
    }
    RS_CHECK(false);
    return 0;
}

Bytes& Draft::payload(ChunkName name, std::uint32_t index) {
    return chunks[place(name, index)].payload;
}

void set_number(Bytes& bytes, std::size_t offset, std::int64_t value, std::size_t size) {
    RS_CHECK(offset + size <= bytes.size());
    for (std::size_t i = 0; i < size; ++i) {
        bytes[offset + i] = static_cast<std::byte>(static_cast<std::uint64_t>(value) >> (8 * i));
    }
}

std::int64_t number_at(const Bytes& bytes, std::size_t offset, std::size_t size) {
    RS_CHECK(offset + size <= bytes.size() && size < 8);
    std::int64_t value = 0;
    for (std::size_t i = 0; i < size; ++i) {
        value += static_cast<std::int64_t>(bytes[offset + i]) << static_cast<int>(8 * i);
    }
    return value;
}

Damage number_damage(std::string name, std::string base, ChunkName chunk, std::uint32_t index, std::size_t offset,
                     std::size_t size, std::int64_t value, std::string words) {
    return {std::move(name), std::move(base), std::move(words), [=](Draft& draft) {
                Bytes& payload = draft.payload(chunk, index);
                const Bytes before = payload;
                set_number(payload, offset, value, size);
                RS_CHECK(payload != before);
            }};
}

Bytes frame_of(const Bytes& content, bool has_checksum, bool states_size) {
    ZSTD_CCtx* const context = ZSTD_createCCtx();
    ZSTD_CCtx_setParameter(context, ZSTD_c_checksumFlag, has_checksum ? 1 : 0);
    ZSTD_CCtx_setParameter(context, ZSTD_c_contentSizeFlag, states_size ? 1 : 0);
    Bytes frame(ZSTD_compressBound(content.size()));
    frame.resize(ZSTD_compress2(context, frame.data(), frame.size(), content.data(), content.size()));
    ZSTD_freeCCtx(context);
    return frame;
}

Bytes content_of(const Bytes& frame) {
    Bytes content(ZSTD_getFrameContentSize(frame.data(), frame.size()));
    RS_CHECK(ZSTD_decompress(content.data(), content.size(), frame.data(), frame.size()) == content.size());
    return content;
}

Bytes fewer(const Bytes& frame) {
    Bytes content = content_of(frame);
    content.pop_back();
    return frame_of(content, false, true);
}

}  // namespace rs::golden
