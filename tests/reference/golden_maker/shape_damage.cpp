// FORMAT.md, "shap", with its numbers of "Ranges".
#include "tests/reference/golden_maker/golden_damage.hpp"

#include "rayspace/base/check.hpp"

#include <array>

namespace rs::golden {
namespace {

using object_chunks::kShape;

const std::string kBase = "raw-shape";  // ring 1 has it: 3 views, 3 planes, 3 lines of 5 x 3 cells
constexpr std::uint32_t kRing = 1;
constexpr std::size_t kLines = 52;
constexpr std::size_t kNormalLines = kLines + 2 * 3;
constexpr std::size_t kFrames = kNormalLines + 16 * 3 * 3;
constexpr std::size_t kSurfaces = 40, kFrameSizes = 44;

using Frames = std::array<Bytes, 2>;  // shown, residuals of depth

Frames frames_of(const Bytes& payload) {
    Frames frames;
    auto at = payload.begin() + kFrames;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const auto size = static_cast<std::ptrdiff_t>(number_at(payload, kFrameSizes + 4 * i, 4));
        frames[i].assign(at, at + size);
        at += size;
    }
    RS_CHECK(at == payload.end());
    return frames;
}

void put_frames(Bytes& payload, const Frames& frames) {
    payload.resize(kFrames);
    for (std::size_t i = 0; i < frames.size(); ++i) {
        set_number(payload, kFrameSizes + 4 * i, static_cast<std::int64_t>(frames[i].size()), 4);
        payload.insert(payload.end(), frames[i].begin(), frames[i].end());
    }
}

Damage number(const std::string& name, std::size_t offset, std::size_t size, std::int64_t value,
              const std::string& words) {
    return number_damage("shape-" + name, kBase, kShape, kRing, offset, size, value, words);
}
Damage line(const std::string& name, std::size_t offset, std::int64_t value, const std::string& words) {
    return number("normal-line-" + name, kNormalLines + 16 * 4 + offset, 4, value, words);
}
Damage payload_damage(const std::string& name, const std::string& words, const std::function<void(Bytes&)>& change) {
    return {"shape-" + name, kBase, words, [=](Draft& d) { change(d.payload(kShape, kRing)); }};
}
Damage frames_damage(const std::string& name, const std::string& words,
                     const std::function<void(Bytes&, Frames&)>& change) {
    return payload_damage(name, words, [=](Bytes& payload) {
        Frames frames = frames_of(payload);
        change(payload, frames);
        put_frames(payload, frames);
    });
}

void add_to(Bytes& payload, std::size_t offset, std::int64_t difference) {
    set_number(payload, offset, number_at(payload, offset, 4) + difference, 4);
}

std::size_t first_cell_with_surface(const Bytes& bits) {
    for (std::size_t i = 0; i < 4 * bits.size(); ++i) {
        if ((bits[i / 4] >> 2 * (i % 4) & std::byte{3}) != std::byte{0}) return i;
    }
    RS_CHECK(false);
    return 0;
}

std::vector<Damage> numbers() {
    constexpr std::int64_t kTop = std::int64_t{1} << 30, kFar = std::int64_t{1} << 28;
    return {
        number("coding-1", 0, 1, 1, "chunk shap 1 | older than format 2.3"),
        number("coding-3", 0, 1, 3, "chunk shap 1 | shape coding 3"),
        number("jump-0", 1, 1, 0, "ring 1 | jump"),
        number("reserved", 3, 1, 1, "chunk shap 1 | reserved"),
        number("p-cells-0", 4, 2, 0, "chunk shap 1 | each side"),
        number("bands-4097", 6, 2, 4097, "chunk shap 1 | each side"),
        number("p-half", 8, 4, (1 << 20) - 1, "ring 1 | half width along p"),
        number("p-cells-per-unit", 12, 4, 1, "ring 1 | cells per unit"),
        number("h-low", 16, 4, kFar, "ring 1 | lowest height"),
        number("bands-per-unit-0", 20, 4, 0, "ring 1 | bands per unit"),
        number("reference-distance", 24, 4, 1 << 20, "ring 1 | reference distance"),
        number("reference-height", 28, 4, -kFar, "ring 1 | reference height"),
        number("depth-low", 32, 4, -(1 << 21) - (1 << 16) - 1, "ring 1 | lowest depth"),
        number("depth-step-0", 36, 4, 0, "ring 1 | depth step"),
        number("surfaces-more-than-cells", kSurfaces, 4, 46, "chunk shap 1 | claims 46 cells with a surface"),
        number("lines-1025", kLines, 2, 1025, "chunk shap 1 | 1025 lines"),
        number("frame-size", kFrameSizes, 4, 1, "chunk shap 1 | bytes long instead of"),
        line("l2", 0, kTop + 1, "ring 1 | normal lines"),
        line("q2", 4, kTop, "ring 1 | normal lines"),
        line("a", 8, kFar, "ring 1 | normal lines"),
        line("c", 12, -kFar, "ring 1 | normal lines"),
    };
}

std::vector<Damage> frames() {
    return {
        payload_damage("too-many-cells", "chunk shap 1 | at most 134217728",
                       [](Bytes& b) {
                           set_number(b, 4, 4096, 2);
                           set_number(b, 6, 4096, 2);
                           set_number(b, kLines, 9, 2);
                       }),
        payload_damage("short", "chunk shap 1 | bytes long instead of", [](Bytes& b) { b.pop_back(); }),
        payload_damage("long", "chunk shap 1 | bytes long instead of", [](Bytes& b) { b.push_back(std::byte{0}); }),
        frames_damage("frame-no-zstandard", "chunk shap 1 | shown of its cells are no Zstandard frame",
                      [](Bytes&, Frames& f) { f[0][0] = std::byte{0x27}; }),
        frames_damage("frame-without-size", "chunk shap 1 | shown of its cells do not state",
                      [](Bytes&, Frames& f) { f[0] = frame_of(content_of(f[0]), false, false); }),
        frames_damage("frame-other-size", "chunk shap 1 | depths do not state",
                      [](Bytes&, Frames& f) { f[1] = fewer(f[1]); }),
        frames_damage("frame-and-more", "chunk shap 1 | depths are not one whole",
                      [](Bytes&, Frames& f) { f[1].push_back(std::byte{0}); }),
        frames_damage("frame-cut", "chunk shap 1 | depths are not one whole",
                      [](Bytes&, Frames& f) { f[1].pop_back(); }),
        frames_damage("frame-damaged", "chunk shap 1 | shown of its cells cannot be decompressed",
                      [](Bytes&, Frames& f) {
                          f[0] = frame_of(content_of(f[0]), true, true);
                          f[0].back() ^= std::byte{1};
                      }),
        frames_damage("bits-behind-the-last-cell", "chunk shap 1 | behind its last cell",
                      [](Bytes&, Frames& f) {
                          Bytes bits = content_of(f[0]);
                          bits.back() |= std::byte{0x40};
                          f[0] = frame_of(bits, false, true);
                      }),
        frames_damage("surfaces-too-few", "chunk shap 1 | cells with a surface, but its bits show",
                      [](Bytes& payload, Frames& f) {
                          add_to(payload, kSurfaces, -1);
                          f[1] = fewer(f[1]);
                      }),
        frames_damage("bits-too-few", "chunk shap 1 | cells with a surface, but its bits show",
                      [](Bytes&, Frames& f) {
                          Bytes bits = content_of(f[0]);
                          const std::size_t cell = first_cell_with_surface(bits);
                          bits[cell / 4] &= ~(std::byte{3} << 2 * (cell % 4));
                          f[0] = frame_of(bits, false, true);
                      }),
    };
}

}  // namespace

std::vector<Damage> shape_damages() {
    std::vector<Damage> all = numbers();
    for (Damage& damage : frames()) all.push_back(std::move(damage));
    return all;
}

}  // namespace rs::golden
