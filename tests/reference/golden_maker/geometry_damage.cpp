// FORMAT.md, "HEAD", "RIGJ", "VIEW", "RING", "AXIS", "RMAP", and "PICT" of coding 0, with their numbers of "Ranges".
#include "tests/reference/golden_maker/golden_damage.hpp"

#include "rayspace/api/types/check.hpp"

#include <algorithm>
#include <cstring>
#include <limits>
#include <span>

namespace rs::golden {
namespace {

using namespace object_chunks;

const std::string kBase = "raw";                 // 3 views, 3 planes, maps of 2 x 3 cells
const std::string kStanding = "raw-33x21-foot";  // 8 views, coded lines
const std::string kTurned = "raw-axis";          // its second ring has another axis
constexpr std::size_t kViewCount = 3, kPlanes = 3;
constexpr std::size_t kViewList = 28;
constexpr std::size_t kLines = kViewList + 2 * kViewCount;

Damage head(const std::string& name, std::size_t offset, std::size_t size, std::int64_t value,
            const std::string& words) {
    return number_damage("head-" + name, kBase, kHead, 0, offset, size, value, "chunk HEAD 0 | " + words);
}
Damage view(const std::string& name, std::size_t offset, std::int64_t value, const std::string& words) {
    return number_damage("view-" + name, kBase, kViews, 0, 16 + offset, 4, value, "view 1 | " + words);
}
Damage ring(const std::string& name, std::size_t offset, std::size_t size, std::int64_t value,
            const std::string& words) {
    return number_damage("ring-" + name, kBase, kRing, 0, offset, size, value, words);
}
Damage line(const std::string& name, std::size_t offset, std::int64_t value, const std::string& words) {
    const std::size_t second_line_of_view_1 = kLines + 16 * (kPlanes + 1);
    return ring("line-" + name, second_line_of_view_1 + offset, 4, value, "view 1 | " + words);
}
map_coding::Runs runs_in(const Bytes& map, std::size_t rows) {
    constexpr std::size_t kFrame = 4;
    const Bytes content = content_of(Bytes(map.begin() + kFrame, map.end()));
    const std::span plane(reinterpret_cast<const std::uint8_t*>(content.data()), content.size());
    return map_coding::decode_run_residuals(plane, rows, (plane.size() - 2 * rows) / 4);
}
Damage map(const std::string& name, const std::string& words, const std::function<void(map_coding::Runs&)>& change,
           const std::string& base = kBase) {
    return {"map-" + name, base, words, [=](Draft& d) {
                Bytes& map = d.payload(kMap);
                const Bytes before = map;
                const auto planes = static_cast<std::size_t>(number_at(d.payload(kRing), 4, 1));
                map_coding::Runs runs =
                    runs_in(map, planes * static_cast<std::size_t>(number_at(d.payload(kRing), 8, 2)));
                change(runs);
                map = map_payload(runs);
                RS_CHECK(map != before);
            }};
}
Damage map_frame(const std::string& name, const std::string& words, const std::function<void(Bytes&)>& change) {
    return {"map-" + name, kBase, "chunk RMAP 0 | " + words, [=](Draft& d) {
                constexpr std::size_t kFrame = 4;
                Bytes& map = d.payload(kMap);
                Bytes frame(map.begin() + kFrame, map.end());
                change(frame);
                map.resize(kFrame);
                map.insert(map.end(), frame.begin(), frame.end());
            }};
}
Damage coded_lines(const std::string& name, const std::function<void(Bytes&)>& change) {
    return {"ring-lines-" + name, kStanding, "chunk RING 0 | its lines", [=](Draft& d) {
                constexpr std::size_t kFrame = kViewList + 2 * 8;
                Bytes& ring = d.payload(kRing);
                Bytes frame(ring.begin() + kFrame, ring.end());
                change(frame);
                ring.resize(kFrame);
                ring.insert(ring.end(), frame.begin(), frame.end());
            }};
}
Damage longer(const std::string& name, ChunkName chunk, int bytes, const std::string& words) {
    return {name, kBase, "chunk " + to_string(chunk) + " 0 | " + words, [=](Draft& d) {
                Bytes& payload = d.payload(chunk);
                payload.resize(static_cast<std::size_t>(std::max(0, static_cast<int>(payload.size()) + bytes)));
            }};
}

// Changes the units per radius.
Damage radius(const std::string& name, double value) {
    std::int64_t bits = 0;
    static_assert(sizeof bits == sizeof value);
    std::memcpy(&bits, &value, sizeof bits);
    return number_damage("head-radius-" + name, kBase, kHead, 0, 16, 8, bits, "units per radius");
}

Damage axis(const std::string& name, const std::string& words, const std::function<void(Bytes&)>& change) {
    return {"axis-" + name, kTurned, words, [=](Draft& d) { change(d.payload(kAxis, 1)); }};
}

std::vector<Damage> axes() {
    constexpr std::int64_t kOne = std::int64_t{1} << 30;
    return {
        axis("short", "chunk AXIS 1 | bytes long", [](Bytes& payload) { payload.pop_back(); }),
        axis("long", "chunk AXIS 1 | bytes long", [](Bytes& payload) { payload.push_back(std::byte{0}); }),
        axis("identity", "chunk AXIS 1 | identity",
             [=](Bytes& payload) {
                 payload.assign(16, std::byte{0});
                 set_number(payload, 12, kOne, 4);
             }),
        axis("zero", "ring 1 | unit quaternion", [](Bytes& payload) { payload.assign(16, std::byte{0}); }),
        // The sum of squares is 1 + 1.4e-6.
        axis("not-unit", "ring 1 | unit quaternion",
             [](Bytes& payload) { set_number(payload, 8, number_at(payload, 8, 4) + 1100, 4); }),
    };
}

std::vector<Damage> sizes() {
    return {
        longer("head-short", kHead, -1, "bytes long"),         longer("head-long", kHead, 1, "bytes long"),
        longer("view-short", kViews, -1, "bytes long"),        longer("view-long", kViews, 1, "bytes long"),
        longer("ring-short", kRing, -1, "bytes of lines"),     longer("ring-long", kRing, 1, "bytes of lines"),
        longer("map-empty", kMap, -1000000, "number of runs"), longer("picture-short", kImage, -1, "bytes long"),
        longer("picture-long", kImage, 1, "bytes long"),
    };
}

std::vector<Damage> ranges() {
    constexpr std::int64_t kTop = std::int64_t{1} << 30;
    return {
        head("width-0", 0, 4, 0, "width is 0"),
        head("width-8193", 0, 4, 8193, "width is 8193"),
        head("height-0", 4, 4, 0, "height is 0"),
        head("views-0", 8, 4, 0, "number of views is 0"),
        head("views-4097", 8, 4, 4097, "number of views is 4097"),
        head("rings-0", 12, 4, 0, "number of rings is 0"),
        head("rings-65", 12, 4, 65, "number of rings is 65"),
        head("name-256", 24, 4, 256, "name's length is 256"),
        number_damage("head-name-control", kBase, kHead, 0, 28, 1, 0x1B, "name | UTF-8"),
        number_damage("head-name-not-utf8", kBase, kHead, 0, 28, 1, 0xC0, "name | UTF-8"),
        radius("0", 0),
        radius("2e12", 2e12),
        radius("nan", std::numeric_limits<double>::quiet_NaN()),
        view("cx", 0, kTop, "principal point"),
        view("cy", 4, -kTop, "principal point"),
        view("focal-0", 8, 0, "focal length"),
        view("focal-large", 8, kTop, "focal length"),
        view("height", 12, std::int64_t{1} << 28, "256 object radii"),
        ring("elevation", 0, 4, 90000001, "ring 0 | elevation"),
        ring("planes-2", 4, 2, 2, "number of planes is 2"),
        ring("planes-65", 4, 2, 65, "number of planes is 65"),
        ring("line-coding-2", 5, 1, 2, "chunk RING 0 | line coding 2"),
        ring("views-0", 6, 2, 0, "number of views is 0"),
        ring("views-4", 6, 2, 4, "number of views is 4"),
        ring("x-cells-0", 8, 2, 0, "size along x is 0"),
        ring("u-cells-4097", 10, 2, 4097, "size along u is 4097"),
        ring("x-half-small", 12, 4, (1 << 20) - 1, "ring 0 | half width along x"),
        ring("x-half-large", 12, 4, (1 << 21) + (1 << 16), "ring 0 | half width along x"),
        ring("x-cells-per-unit", 16, 4, 7000, "ring 0 | cells per unit"),
        ring("u-half-small", 20, 4, 464943848, "ring 0 | half width along u"),  // 2^28 tan 60 degrees
        ring("u-cells-per-unit-0", 24, 4, 0, "ring 0 | cells per unit"),
        ring("view-number", kViewList + 2, 2, 3, "view's number is 3"),
        ring("view-twice", kViewList + 2, 2, 0, "names view 0 a second time"),
        line("l0", 0, std::int64_t{1} << 28, "depth of one of its lines"),
        line("l1", 4, kTop + 1, "depth of one of its lines"),
        line("q0", 8, -(std::int64_t{1} << 31), "columns of one of its lines"),
        line("q1", 12, kTop, "columns of one of its lines"),
        number_damage("foot-far", kStanding, kFoot, 0, 0, 4, std::int64_t{1} << 28, "foot | 256 object radii"),
    };
}

std::vector<Damage> rules() {
    return {
        {"rig-no-json", kBase, "rig", [](Draft& d) { d.payload(kRig) = Bytes(5, std::byte{'x'}); }},
        {"rig-cut", kBase, "the words of its rig", [](Draft& d) { d.payload(kRig).pop_back(); }},
        {"rig-other-number-of-frames", kBase, "as many frames as views",
         [](Draft& d) {
             const std::string text = R"({"fl_x":9,"fl_y":9,"cx":1,"cy":1,"w":3,"h":2,"frames":[{"file_path":"a.png",)"
                                      R"("transform_matrix":[[1,0,0,0],[0,1,0,0],[0,0,1,3],[0,0,0,1]]}]})";
             const auto bytes = std::as_bytes(std::span(text));
             d.payload(kRig).assign(bytes.begin(), bytes.end());
         }},
        coded_lines("no-frame", [](Bytes& frame) { frame.clear(); }),
        coded_lines("frame-cut", [](Bytes& frame) { frame.pop_back(); }),
        coded_lines("frame-and-more", [](Bytes& frame) { frame.push_back(std::byte{0}); }),
        coded_lines("frame-without-size", [](Bytes& frame) { frame = frame_of(content_of(frame), false, false); }),
        coded_lines("frame-of-fewer", [](Bytes& frame) { frame = fewer(frame); }),
        {"foot-short", kStanding, "chunk foot 0 | bytes long", [](Draft& d) { d.payload(kFoot).pop_back(); }},
        {"view-in-no-ring", kBase, "view 2 belongs to no ring",
         [](Draft& d) {
             // A ring of the first two views. The third view has no image, which would have no position in the order,
             // and no cell of the map.
             d.chunks.erase(d.chunks.begin() + static_cast<std::ptrdiff_t>(d.place(kImage, 2)));
             Bytes& ring = d.payload(kRing);
             ring.resize(kLines + 16 * kPlanes * 2);
             ring.erase(ring.begin() + kViewList + 4, ring.begin() + kViewList + 6);
             set_number(ring, 6, 2, 2);
             constexpr std::uint16_t kNoImage = 65535, kWidth = 3;
             d.payload(kMap) = map_payload({std::vector<std::uint16_t>(kPlanes * 2, 1),
                                            std::vector<std::uint16_t>(kPlanes * 2, kNoImage),
                                            std::vector<std::uint16_t>(kPlanes * 2, kWidth)});
         }},
        map("run-of-0", "chunk RMAP 0 | a run of 0", [](map_coding::Runs& r) { r.lengths[0] = 0; }),
        map("run-too-long", "chunk RMAP 0 | a run of 4", [](map_coding::Runs& r) { r.lengths[0] = 4; }),
        map("no-runs", "chunk RMAP 0 | row 0", [](map_coding::Runs& r) { r.counts[0] = 0; }),
        map("row-unfilled", "chunk RMAP 0 | row 0 fills",
            [](map_coding::Runs& r) {
                // The last cell of the first row.
                const std::size_t last = r.counts[0] - std::size_t{1};
                if (--r.lengths[last] > 0) return;
                --r.counts[0];
                r.views.erase(r.views.begin() + static_cast<std::ptrdiff_t>(last));
                r.lengths.erase(r.lengths.begin() + static_cast<std::ptrdiff_t>(last));
            }),
        map("runs-behind-the-last-row", "chunk RMAP 0 | runs behind its last row",
            [](map_coding::Runs& r) {
                r.views.push_back(0);
                r.lengths.push_back(1);
            }),
        map("more-runs-than-there-are", "chunk RMAP 0 | more runs than there are",
            [](map_coding::Runs& r) { ++r.counts.back(); }),
        number_damage("map-fewer-runs-than-rows", kBase, kMap, 0, 0, 4, 5, "chunk RMAP 0 | the number of runs is 5"),
        number_damage("map-more-runs-than-cells", kBase, kMap, 0, 0, 4, 19, "chunk RMAP 0 | the number of runs is 19"),
        map_frame("no-frame", "its runs", [](Bytes& frame) { frame.clear(); }),
        map_frame("frame-cut", "its runs", [](Bytes& frame) { frame.pop_back(); }),
        map_frame("frame-and-more", "its runs", [](Bytes& frame) { frame.push_back(std::byte{0}); }),
        map_frame("frame-without-size", "its runs",
                  [](Bytes& frame) { frame = frame_of(content_of(frame), false, false); }),
        map_frame("frame-of-fewer", "its runs", [](Bytes& frame) { frame = fewer(frame); }),
        map("view-number", "names view 3", [](map_coding::Runs& r) { r.views[0] = 3; }),
        map(
            "view-of-another-ring", "ring 0 | not one of the ring's", [](map_coding::Runs& r) { r.views[0] = 5; },
            "raw-shape"),
        {"map-cell-behind-the-camera", kBase, "looks away",
         [](Draft& d) {
             // All lines of the first row's view.
             const std::size_t named = runs_in(d.payload(kMap), kPlanes * 2).views[0];
             for (std::size_t k = 0; k < kPlanes; ++k) {
                 set_number(d.payload(kRing), kLines + 16 * (named * kPlanes + k), -(std::int64_t{1} << 27), 4);
             }
         }},
        number_damage("picture-coding-7", kBase, kImage, 1, 0, 1, 7, "chunk PICT 1 | image coding 7"),
        number_damage("picture-coded-without-code", kBase, kImage, 1, 0, 1, 1, "chunk PICT 1 | image coding 1"),
        number_damage("picture-reserved", kBase, kImage, 1, 15, 1, 1, "chunk PICT 1 | reserved"),
    };
}

}  // namespace

std::vector<Damage> geometry_damages() {
    std::vector<Damage> all = sizes();
    for (auto* const list : {&ranges, &rules, &axes}) {
        for (Damage& damage : (*list)()) all.push_back(std::move(damage));
    }
    return all;
}

}  // namespace rs::golden
