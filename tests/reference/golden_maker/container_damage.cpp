// FORMAT.md, "Container" and the order of "Chunks".
#include "tests/reference/golden_maker/golden_damage.hpp"

#include <xxhash.h>

#include <algorithm>

namespace rs::golden {
namespace {

using namespace object_chunks;

constexpr std::size_t kTable = 48;
const std::string kBase = "raw";

void fit_header_checksum(Bytes& file) {
    set_number(file, 40, static_cast<std::int64_t>(XXH64(file.data(), 40, 0)), 8);
}

// Changes a number of the header.
Damage header_damage(const std::string& name, std::size_t offset, std::size_t size, std::int64_t value,
                     const std::string& words) {
    return {name, kBase, words, [=](Draft& draft) {
                draft.afterwards = [=](Bytes& file) {
                    set_number(file, offset, value, size);
                    fit_header_checksum(file);
                };
            }};
}

// Changes a number of the first table entry.
Damage table_damage(const std::string& name, std::size_t offset, std::size_t size, std::int64_t value,
                    const std::string& words) {
    return {name, kBase, words, [=](Draft& draft) {
                draft.afterwards = [=](Bytes& file) {
                    set_number(file, kTable + offset, value, size);
                    fuzz::seal(file);
                };
            }};
}

// Changes any bytes, without new checksums.
Damage bytes_damage(const std::string& name, const std::string& words, const std::function<void(Bytes&)>& change) {
    return {name, kBase, words, [=](Draft& draft) { draft.afterwards = change; }};
}

Damage missing(const std::string& base, ChunkName chunk, std::uint32_t index, const std::string& words) {
    std::string name = "chunk-missing-" + to_string(chunk) + "-" + std::to_string(index);
    std::ranges::transform(name, name.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
    return {name, base, words,
            [=](Draft& d) { d.chunks.erase(d.chunks.begin() + static_cast<std::ptrdiff_t>(d.place(chunk, index))); }};
}

struct Key {
    ChunkName name{};
    std::uint32_t index = 0;
};

Damage swapped(const std::string& name, const std::string& base, Key a, Key b, const std::string& words) {
    return {"order-" + name, base, words,
            [=](Draft& d) { std::swap(d.chunks[d.place(a.name, a.index)], d.chunks[d.place(b.name, b.index)]); }};
}

// Moves `chunk` to just before `before`.
Damage moved(const std::string& name, const std::string& base, Key chunk, Key before, const std::string& words) {
    return {"order-" + name, base, words, [=](Draft& d) {
                const auto from = d.chunks.begin() + static_cast<std::ptrdiff_t>(d.place(chunk.name, chunk.index));
                fuzz::SoupChunk taken = *from;
                d.chunks.erase(from);
                d.chunks.insert(d.chunks.begin() + static_cast<std::ptrdiff_t>(d.place(before.name, before.index)),
                                std::move(taken));
            }};
}

Damage added(const std::string& name, const std::string& base, fuzz::SoupChunk chunk, const std::string& words) {
    return {"chunk-" + name, base, words, [=](Draft& d) { d.chunks.push_back(chunk); }};
}

}  // namespace

std::vector<Damage> container_damages() {
    return {
        bytes_damage("magic-other", "is not a ray-space object", [](Bytes& file) { set_number(file, 1, 'P', 1); }),
        bytes_damage("magic-text-mode", "text mode", [](Bytes& file) { file.erase(file.begin() + 4); }),
        bytes_damage("header-cut", "ends inside its header", [](Bytes& file) { file.resize(47); }),
        header_damage("version-3", 8, 2, 3, "format version 3 | newer"),
        header_damage("version-1", 8, 2, 1, "format 1.0 | rs-encode build"),
        header_damage("version-0", 8, 2, 0, "format version 0"),
        bytes_damage("header-checksum", "the header's checksum", [](Bytes& file) { set_number(file, 10, 77, 2); }),
        header_damage("file-size-stated", 24, 8, 12345, "bytes long instead of 12345"),
        bytes_damage("file-cut", "bytes long instead of", [](Bytes& file) { file.resize(file.size() - 16); }),
        header_damage("table-offset", 16, 8, 64, "its table is not where"),
        header_damage("chunks-0", 12, 4, 0, "claims 0 chunks"),
        header_damage("chunks-65537", 12, 4, 65537, "claims 65537 chunks"),
        header_damage("chunks-beyond-the-end", 12, 4, 5000, "its table reaches beyond"),
        bytes_damage("table-checksum", "the table's checksum", [](Bytes& file) { set_number(file, kTable + 4, 9, 4); }),
        table_damage("table-name-sign", 3, 1, '!', "table entry 0 | letters and digits"),
        table_damage("table-name-digit-first", 0, 1, '1', "table entry 0 | letters and digits"),
        table_damage("table-offset-of-a-chunk", 8, 8, 16, "chunk HEAD 0 | does not begin"),
        table_damage("table-size-above-2-30", 16, 8, (std::int64_t{1} << 30) + 1, "chunk HEAD 0 | larger than 1 GiB"),
        table_damage("table-chunk-beyond-the-end", 16, 8, 1 << 20, "chunk HEAD 0 | beyond the end"),
        bytes_damage("bytes-behind-the-last-chunk", "behind its last chunk",
                     [](Bytes& file) {
                         file.resize(file.size() + 16);
                         fuzz::seal(file);
                     }),
        {"table-twins", kBase, "chunk PICT 1 | there twice", [](Draft& d) { d.chunks[d.place(kImage, 2)].index = 1; }},
        table_damage("payload-checksum", 24, 8, 1, "chunk HEAD 0 | its checksum"),
        bytes_damage("padding", "chunk HEAD 0 | padding",
                     [](Bytes& file) {
                         const auto head = static_cast<std::size_t>(number_at(file, kTable + 8, 7));
                         set_number(file, head + static_cast<std::size_t>(number_at(file, kTable + 16, 7)), 1, 1);
                     }),
    };
}

std::vector<Damage> order_damages() {
    const Bytes one_byte(1);
    const std::string kBoard = "board-random-small";
    const std::string kShaped = "raw-shape";
    const std::string kStanding = "raw-33x21-foot";
    const std::string kTurned = "raw-axis";
    const std::string kUnknown = "unknown or out of place";
    return {
        added("unknown", kBase, {{'N', 'E', 'W', 'S'}, 0, one_byte}, "chunk NEWS 0 | " + kUnknown),
        added("picture-too-many", kBase, {kImage, 99, one_byte}, "chunk PICT 99 | " + kUnknown),
        added("second-code", kBoard, {kCode, 1, one_byte}, "chunk CODE 1 | " + kUnknown),
        added("shape-of-no-ring", kShaped, {kShape, 9, one_byte}, "chunk shap 9 | out of place"),
        added("second-foot", kStanding, {kFoot, 1, Bytes(4)}, "chunk foot 1 | out of place"),
        added("axis-of-no-ring", kTurned, {kAxis, 9, Bytes(16)}, "chunk AXIS 9 | out of place"),
        moved("axis-before-ring", kTurned, {kAxis, 1}, {kRing, 1}, "chunk AXIS 1 | out of place"),
        moved("axis-behind-map", kTurned, {kAxis, 1}, {kImage, 3}, kUnknown),
        moved("foot-before-view", kStanding, {kFoot, 0}, {kViews, 0}, "chunk foot 0 | out of place"),
        moved("foot-behind-ring", kStanding, {kFoot, 0}, {kMap, 0}, kUnknown),
        missing(kBase, kHead, 0, "no chunk HEAD 0"),
        missing(kBase, kRig, 0, "no chunk RIGJ 0"),
        missing(kBase, kViews, 0, "no chunk VIEW 0"),
        missing(kBase, kRing, 0, "no chunk RING 0"),
        missing(kBase, kMap, 0, kUnknown),
        missing(kBase, kImage, 0, kUnknown),
        missing(kBase, kImage, 1, "no chunk PICT 1"),
        missing(kBoard, kCode, 0, kUnknown),
        swapped("view-before-rig", kBase, {kRig, 0}, {kViews, 0}, kUnknown),
        swapped("map-before-ring", kBase, {kRing, 0}, {kMap, 0}, kUnknown),
        swapped("rings", kShaped, {kRing, 0}, {kRing, 1}, kUnknown),
        swapped("pictures", kBase, {kImage, 0}, {kImage, 1}, kUnknown),
        moved("head-last", kBase, {kHead, 0}, {kImage, 0}, kUnknown),
        moved("code-behind-maps", kBoard, {kCode, 0}, {kMap, 0}, kUnknown),
        moved("shape-before-map", kShaped, {kShape, 1}, {kMap, 1}, "chunk shap 1 | out of place"),
        moved("shape-behind-another-map", kShaped, {kShape, 1}, {kRing, 1}, "chunk shap 1 | out of place"),
        moved("shape-behind-a-picture", kShaped, {kShape, 1}, {kImage, 1},
              "out of place, where chunk shap 1 should stand"),
    };
}

}  // namespace rs::golden
