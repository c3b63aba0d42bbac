// FORMAT.md, "shap", with its numbers of "Ranges".
#include "tests/reference/golden_maker/golden_damage.hpp"

namespace rs::golden {
namespace {

using object_chunks::kShape;

const std::string kBase = "raw-shape";  // ring 1 has it: 3 views, 3 planes, 3 lines of 5 x 3 cells
constexpr std::uint32_t kRing = 1;
constexpr std::size_t kLines = 48;
constexpr std::size_t kNormalLines = kLines + 2 * 3;
constexpr std::size_t kSurfaces = 40, kCellBytes = 44;

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
void add_to(Bytes& payload, std::size_t offset, std::int64_t difference) {
    set_number(payload, offset, number_at(payload, offset, 4) + difference, 4);
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
        number("cell-bytes", kCellBytes, 4, 1, "chunk shap 1 | bytes long instead of"),
        line("l2", 0, kTop + 1, "ring 1 | normal lines"),
        line("q2", 4, kTop, "ring 1 | normal lines"),
        line("a", 8, kFar, "ring 1 | normal lines"),
        line("c", 12, -kFar, "ring 1 | normal lines"),
    };
}

std::vector<Damage> payloads() {
    return {
        payload_damage("too-many-cells", "chunk shap 1 | at most 134217728",
                       [](Bytes& b) {
                           set_number(b, 4, 4096, 2);
                           set_number(b, 6, 4096, 2);
                           set_number(b, kLines, 9, 2);
                       }),
        payload_damage("short", "chunk shap 1 | bytes long instead of", [](Bytes& b) { b.pop_back(); }),
        payload_damage("long", "chunk shap 1 | bytes long instead of", [](Bytes& b) { b.push_back(std::byte{0}); }),
        payload_damage("surfaces-too-few", "chunk shap 1 | cells with a surface, but has",
                       [](Bytes& b) { add_to(b, kSurfaces, -1); }),
        payload_damage("surfaces-too-many", "chunk shap 1 | cells with a surface, but has",
                       [](Bytes& b) { add_to(b, kSurfaces, 1); }),
        payload_damage("cells-lost", "chunk shap 1 | cells with a surface, but has 0",
                       [](Bytes& b) {
                           b.resize(b.size() - static_cast<std::size_t>(number_at(b, kCellBytes, 4)));
                           set_number(b, kCellBytes, 0, 4);
                       }),
    };
}

}  // namespace

std::vector<Damage> shape_damages() {
    std::vector<Damage> all = numbers();
    for (Damage& damage : payloads()) all.push_back(std::move(damage));
    return all;
}

}  // namespace rs::golden
