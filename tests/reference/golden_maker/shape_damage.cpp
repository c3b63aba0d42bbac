// FORMAT.md, "shap", with its numbers of "Ranges".
#include "tests/reference/golden_maker/golden_damage.hpp"

#include "rayspace/check.hpp"

#include <array>

namespace rs::golden {
namespace {

using object_chunks::kShape;

const std::string kBase = "raw-shape";  // ring 1 has it: 3 views, 3 planes, 3 lines of 5 x 3 cells
constexpr std::uint32_t kRing = 1;
constexpr std::size_t kLines = 64;
constexpr std::size_t kNormalLines = kLines + 2 * 3;
constexpr std::size_t kFrames = kNormalLines + 16 * 3 * 3;
constexpr std::size_t kLayer0Cells = 40, kLayer1Cells = 44, kFrameSizes = 48;

using Frames = std::array<Bytes, 4>;  // rays, depths of layer 0 and of layer 1, backs

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

// The first cell with these rays gets others.
void replace_rays(Bytes& frame, unsigned from, unsigned to) {
    Bytes rays = content_of(frame);
    for (std::byte& two_cells : rays) {
        if ((two_cells & std::byte{15}) != static_cast<std::byte>(from)) continue;
        two_cells = (two_cells & std::byte{0xF0}) | static_cast<std::byte>(to);
        frame = frame_of(rays, false, true);
        return;
    }
    RS_CHECK(false);
}

std::vector<Damage> numbers() {
    constexpr std::int64_t kTop = std::int64_t{1} << 30, kFar = std::int64_t{1} << 28;
    return {
        number("coding-1", 0, 1, 1, "chunk shap 1 | shape coding 1"),
        number("reserved", 2, 1, 1, "chunk shap 1 | reserved"),
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
        number("layer0-more-than-cells", kLayer0Cells, 4, 46, "chunk shap 1 | claims 46 cells with layer 0"),
        number("layer1-more-than-layer0", kLayer1Cells, 4, 45, "chunk shap 1 | 45 with layer 1"),
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
        frames_damage("frame-no-zstandard", "chunk shap 1 | rays are no Zstandard frame",
                      [](Bytes&, Frames& f) { f[0][0] = std::byte{0x27}; }),
        frames_damage("frame-without-size", "chunk shap 1 | rays do not state",
                      [](Bytes&, Frames& f) { f[0] = frame_of(content_of(f[0]), false, false); }),
        frames_damage("frame-other-size", "chunk shap 1 | depths of layer 0 do not state",
                      [](Bytes&, Frames& f) { f[1] = fewer(f[1]); }),
        frames_damage("frame-and-more", "chunk shap 1 | depths of layer 1 are not one whole",
                      [](Bytes&, Frames& f) { f[2].push_back(std::byte{0}); }),
        frames_damage("frame-cut", "chunk shap 1 | backs are not one whole",
                      [](Bytes&, Frames& f) { f[3].pop_back(); }),
        frames_damage("frame-damaged", "chunk shap 1 | rays cannot be decompressed",
                      [](Bytes&, Frames& f) {
                          f[0] = frame_of(content_of(f[0]), true, true);
                          f[0].back() ^= std::byte{1};
                      }),
        frames_damage("bits-behind-the-last-cell", "chunk shap 1 | behind its last cell",
                      [](Bytes&, Frames& f) {
                          Bytes rays = content_of(f[0]);
                          rays.back() |= std::byte{0x10};
                          f[0] = frame_of(rays, false, true);
                      }),
        frames_damage("layer1-without-layer0", "ring 1 | layer 1 without layer 0",
                      [](Bytes& payload, Frames& f) {
                          replace_rays(f[0], 0, 4);
                          add_to(payload, kLayer1Cells, 1);
                          Bytes depths = content_of(f[2]);
                          depths.push_back(std::byte{0});
                          f[2] = frame_of(depths, false, true);
                      }),
        frames_damage("layer0-count", "chunk shap 1 | cells with layer 0, but its rays show",
                      [](Bytes& payload, Frames& f) {
                          add_to(payload, kLayer0Cells, -1);
                          f[1] = fewer(f[1]);
                          f[3] = fewer(f[3]);
                      }),
        frames_damage("layer1-count", "chunk shap 1 | cells with layer 1, but its rays show",
                      [](Bytes& payload, Frames& f) {
                          add_to(payload, kLayer1Cells, -1);
                          f[2] = fewer(f[2]);
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
