// FORMAT.md, "CODE", and "PICT" of coding 1.
#include "tests/reference/golden_maker/golden_damage.hpp"

#include "rayspace/api/types/check.hpp"

#include <optional>

namespace rs::golden {
namespace {

using namespace object_chunks;

Damage of_codec(Damage damage) {
    damage.is_of_codec = true;
    return damage;
}

// Offset of the fields after the levels in CODE.
std::size_t rest_of_code(const Draft& draft) {
    std::size_t views = 0;
    for (const fuzz::SoupChunk& chunk : draft.chunks) views += chunk.name == kImage ? 1 : 0;
    return 8 + views;
}

Damage code(const std::string& name, const std::string& base, const std::string& words,
            const std::function<void(Bytes&)>& change) {
    return of_codec({"code-" + name, base, "chunk CODE 0 | " + words, [=](Draft& d) { change(d.payload(kCode)); }});
}
Damage code_byte(const std::string& name, const std::string& base, std::size_t offset, int value,
                 const std::string& words) {
    return of_codec(number_damage("code-" + name, base, kCode, 0, offset, 1, value, "chunk CODE 0 | " + words));
}

std::vector<Damage> dense_code(const Draft& valid) {
    const std::string base = "dense-random-small";
    const std::size_t listed = rest_of_code(valid);
    const std::size_t probabilities = listed + 181;
    return {
        code_byte("profile-3", base, 0, 3, "profile 3"),
        code_byte("profile-0", base, 0, 0, "profile 0"),
        code_byte("tile-width-3", base, 1, 3, "tile's side is 3"),
        code_byte("tile-height-7", base, 2, 7, "tile's side is 7"),
        code_byte("alpha-bits-0", base, 3, 0, "alpha bits is 0"),
        code_byte("alpha-bits-5", base, 3, 5, "alpha bits is 5"),
        code_byte("u-offset-32", base, 4, 32, "offset is 32"),
        code_byte("v-offset-minus-128", base, 5, -128, "offset is -128"),
        code_byte("alpha-coding-3", base, 6, 3, "coding of alpha is 3"),
        code_byte("masks-alpha-bits-3", "dense-16x16-alpha1", 3, 3, "alpha bits is 3"),
        code_byte("depths-alpha-bits-2", "dense-64x64-alpha3", 3, 2, "alpha bits is 2"),
        code_byte("depths-alpha-bits-7", "dense-64x64-alpha3", 3, 7, "alpha bits is 7"),
        code_byte("features-8", base, 7, 8, "set of features is 8"),
        code_byte("level-4", base, 8, 4, "level of image 0 is 4"),
        code("context-1447", base, "contexts", [=](Bytes& b) { b[listed + 180] |= std::byte{0x80}; }),
        code_byte("probability-0", base, probabilities, 0, "context 0 | probability of zero"),
        code("short", base, "too short", [](Bytes& b) { b.pop_back(); }),
        code("shorter-than-its-contexts", base, "contexts", [=](Bytes& b) { b.resize(listed + 180); }),
        code("shorter-than-its-levels", base, "too short", [=](Bytes& b) { b.resize(listed - 1); }),
        code("long", base, "behind its last", [](Bytes& b) { b.push_back(std::byte{1}); }),
    };
}

std::vector<Damage> dense_code_of_masks(const Draft& valid) {
    const std::string base = "dense-random-masks-small";
    const bool has_edge_alpha = valid.chunks[valid.place(kCode)].payload[3] == std::byte{1};
    const std::size_t listed = rest_of_code(valid) + (has_edge_alpha ? 24 : 0);
    // For encoded objects with 9 views.
    const auto with_edge_alpha = [](const std::string& name, const std::string& words, const auto& change) {
        return code("edge-alpha-" + name, "dense-16x16-alpha1", words, change);
    };
    return {
        with_edge_alpha("128", "alpha of edges is 128", [](Bytes& b) { b[17 + 23] = std::byte{128}; }),
        with_edge_alpha("short", "alpha of edges", [](Bytes& b) { b.resize(17 + 23); }),
        code("masks-context-1649", base, "contexts", [=](Bytes& b) { b[listed + 206] |= std::byte{0x02}; }),
        code("masks-shorter-than-its-contexts", base, "contexts", [=](Bytes& b) { b.resize(listed + 206); }),
    };
}

std::vector<Damage> board_code(const Draft& valid) {
    const std::string base = "board-random-small";
    const std::size_t classes = rest_of_code(valid);
    const std::size_t frame = classes + 14;
    // Replaces the frame by one of changed content, or by another frame of the same content.
    const auto reframe = [=](Bytes& payload, int more_bytes, bool has_checksum, bool states_size) {
        Bytes content = content_of(Bytes(payload.begin() + static_cast<std::ptrdiff_t>(frame), payload.end()));
        content.resize(static_cast<std::size_t>(static_cast<int>(content.size()) + more_bytes));
        const Bytes anew = frame_of(content, has_checksum, states_size);
        payload.resize(frame);
        payload.insert(payload.end(), anew.begin(), anew.end());
    };
    return {
        code_byte("board-tile-width-4", base, 1, 4, "tile's side is 4"),
        code_byte("board-tile-height-6", base, 2, 6, "tile's side is 6"),
        code_byte("board-alpha-bits-2", base, 3, 2, "alpha bits is 2"),
        code_byte("board-u-offset-1", base, 4, 1, "offset is 1"),
        code_byte("board-v-offset-minus-1", base, 5, -1, "offset is -1"),
        code_byte("board-alpha-coding-1", base, 6, 1, "coding of alpha is 1"),
        code_byte("board-features", base, 7, 2, "set of features is 2"),
        code_byte("board-level-4", base, 8, 4, "level of image 0 is 4"),
        code_byte("board-block-stages-3", base, classes + 9, 3 << 2, "class 3 | cannot be"),
        code_byte("board-quarter-stages-5", base, classes + 9, 5 << 4, "class 3 | cannot be"),
        code_byte("board-predicted-without-references", base, classes, 1, "class 1 | cannot be"),
        code("board-short", base, "too short", [=](Bytes& b) { b.resize(classes + 13); }),
        code("board-no-frame", base, "codebooks are no Zstandard frame", [=](Bytes& b) { b.resize(frame); }),
        code("board-frame-cut", base, "codebooks are not one whole", [](Bytes& b) { b.pop_back(); }),
        code("board-frame-and-more", base, "codebooks are not one whole", [](Bytes& b) { b.push_back(std::byte{0}); }),
        code("board-frame-too-small", base, "codebooks do not state", [=](Bytes& b) { reframe(b, -1, false, true); }),
        code("board-frame-too-large", base, "codebooks do not state", [=](Bytes& b) { reframe(b, 1, false, true); }),
        code("board-frame-without-size", base, "codebooks do not state",
             [=](Bytes& b) { reframe(b, 0, false, false); }),
        code("board-frame-damaged", base, "codebooks cannot be decompressed",
             [=](Bytes& b) {
                 reframe(b, 0, true, true);
                 b.back() ^= std::byte{1};
             }),
    };
}

// Offsets of the numbers of a PICT.
struct ImageFields {
    std::uint32_t view = 0;
    int reference_a = 0;
    std::size_t tiles = 0;
    std::size_t sizes = 0;  // offset of the first present tile's size
    std::size_t size_bytes = 0;
};

ImageFields fields_of(const Draft& valid, int width, int height) {
    const Bytes& code = valid.chunks[valid.place(kCode)].payload;
    const auto tiles_along = [&](int side, std::size_t log2_at) {
        const int tile = 1 << static_cast<int>(number_at(code, log2_at, 1));
        return static_cast<std::size_t>((side + tile - 1) / tile);
    };
    ImageFields fields;
    fields.tiles = tiles_along(width, 1) * tiles_along(height, 2);
    fields.sizes = 16 + (fields.tiles + 7) / 8;
    for (const fuzz::SoupChunk& chunk : valid.chunks) {
        if (chunk.name != kImage || number_at(chunk.payload, 4, 2) == 65535) continue;
        fields.view = chunk.index;
        fields.reference_a = static_cast<int>(number_at(chunk.payload, 2, 2));
        fields.size_bytes = (number_at(chunk.payload, fields.sizes, 1) & 128) != 0 ? 2 : 1;
        RS_CHECK(fields.tiles % 8 != 0);
        return fields;
    }
    RS_CHECK(false);
    return fields;
}

}  // namespace

std::vector<Damage> code_damages(const Draft& dense, const Draft& masks, const Draft& board) {
    std::vector<Damage> all = dense_code(dense);
    for (Damage& damage : dense_code_of_masks(masks)) all.push_back(std::move(damage));
    for (Damage& damage : board_code(board)) all.push_back(std::move(damage));
    return all;
}

std::vector<Damage> image_damages(const std::string& base, const Draft& valid) {
    const Bytes& head = valid.chunks[valid.place(kHead)].payload;
    const ImageFields at =
        fields_of(valid, static_cast<int>(number_at(head, 0, 4)), static_cast<int>(number_at(head, 4, 4)));
    const auto views = number_at(head, 8, 4);
    const bool is_board = base.rfind("board", 0) == 0;
    const std::string prefix = is_board ? "board-picture-" : "dense-picture-";
    const std::string place = "chunk PICT " + std::to_string(at.view) + " | ";

    const auto number = [&](const std::string& name, std::size_t offset, std::size_t size, std::int64_t value,
                            const std::string& words) {
        return of_codec(number_damage(prefix + name, base, kImage, at.view, offset, size, value, place + words));
    };
    const auto change = [&](const std::string& name, const std::string& words,
                            const std::function<void(Bytes&)>& apply) {
        const std::uint32_t view = at.view;
        return of_codec({prefix + name, base, place + words, [=](Draft& d) { apply(d.payload(kImage, view)); }});
    };
    // Stores the first tile's size in another form.
    const auto size_form = [&](const std::string& name, const std::function<Bytes(int)>& form_of) {
        return change(name, "in its shortest form", [=](Bytes& b) {
            int size = static_cast<int>(number_at(b, at.sizes, 1)) & 127;
            if (at.size_bytes == 2) size += 128 * static_cast<int>(number_at(b, at.sizes + 1, 1));
            const Bytes form = form_of(size);
            const auto begin = b.begin() + static_cast<std::ptrdiff_t>(at.sizes);
            b.insert(b.erase(begin, begin + static_cast<std::ptrdiff_t>(at.size_bytes)), form.begin(), form.end());
        });
    };
    const auto bytes = [](std::initializer_list<int> values) {
        Bytes result;
        for (const int value : values) result.push_back(static_cast<std::byte>(value));
        return result;
    };
    return {
        number("coding-2", 0, 1, 2, "image coding 2"),
        number("raw", 0, 1, 0, "image coding 0"),
        number("step", 1, 1, is_board ? 1 : 64, "quantiser step is"),
        number("only-reference-b", 2, 2, 65535, "second reference without a first"),
        number("references-the-same", 4, 2, at.reference_a, "same reference twice"),
        number("reference-no-view", 2, 2, views, "a reference is " + std::to_string(views)),
        number("reference-itself", 2, 2, at.view, "level is not lower"),
        number("usual-a-x", 6, 2, is_board ? 1 : 1024, "global motion vector is"),
        number("usual-b-y", 12, 2, is_board ? -1 : -1024, "global motion vector is"),
        number("reserved", 15, 1, 1, "reserved"),
        change("tile-that-does-not-exist", "list of tiles", [=](Bytes& b) { b[at.sizes - 1] |= std::byte{0x80}; }),
        change("short", "too short", [](Bytes& b) { b.resize(15); }),
        change("shorter-than-its-list", "list of tiles", [=](Bytes& b) { b.resize(at.sizes - 1); }),
        change("shorter-than-its-sizes", "in its shortest form", [=](Bytes& b) { b.resize(at.sizes); }),
        size_form("size-longer-form",
                  [=](int size) {
                      return size < 128 ? bytes({128 + size, 0}) : bytes({128 + size % 128, 128 + size / 128, 0});
                  }),
        size_form("size-65536",
                  [=](int) {
                      return bytes({0x80, 0x80, 0x04});
                  }),
        size_form("size-of-4-bytes",
                  [=](int) {
                      return bytes({0x81, 0x80, 0x80, 0x00});
                  }),
        change("tile-cut", "bytes of tiles instead of", [](Bytes& b) { b.pop_back(); }),
        change("long", "bytes of tiles instead of", [](Bytes& b) { b.push_back(std::byte{0}); }),
    };
}

}  // namespace rs::golden
