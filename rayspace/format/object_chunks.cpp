#include "rayspace/format/object_chunks.hpp"

#include "rayspace/base/byte_stream.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/base/zstd_frame.hpp"
#include "rayspace/format/line_coding.hpp"
#include "rayspace/format/map_coding.hpp"

#include <algorithm>
#include <cstring>
#include <optional>
#include <utility>

namespace rs::object_chunks {
namespace {

constexpr std::size_t kView_bytes = 16;
constexpr std::size_t kPictureHeader_bytes = 16;
constexpr std::uint8_t kRawCoding = 0;

Error wrong_size(std::uint64_t found, std::uint64_t expected) {
    return Error{"is " + std::to_string(found) + " bytes long instead of " + std::to_string(expected)};
}

void put_line(const CapturedLine& line, ByteWriter& out) {
    out.put(line.l0_q20);
    out.put(line.l1_q30);
    out.put(line.q0_q16);
    out.put(line.q1_q16);
}

CapturedLine get_line(ByteReader& in) {
    CapturedLine line;
    line.l0_q20 = in.get<std::int32_t>();
    line.l1_q30 = in.get<std::int32_t>();
    line.q0_q16 = in.get<std::int32_t>();
    line.q1_q16 = in.get<std::int32_t>();
    return line;
}

// The lines in what is left of a RING payload.
Result<std::vector<CapturedLine>> parse_lines(ByteReader& in, std::size_t views, int planes, std::uint8_t coding) {
    std::vector<CapturedLine> lines(views * static_cast<std::size_t>(planes));
    const std::size_t plain_bytes = lines.size() * line_coding::kBytesPerLine;
    if (coding == static_cast<std::uint8_t>(LineCoding::kPlain)) {
        if (in.left() != plain_bytes) {
            return Error{"holds " + std::to_string(in.left()) + " bytes of lines instead of " +
                         std::to_string(plain_bytes)};
        }
        for (CapturedLine& line : lines) line = get_line(in);
        return lines;
    }
    if (coding != static_cast<std::uint8_t>(LineCoding::kResiduals)) {
        return Error{"has line coding " + std::to_string(coding) + ", which is not known here; update these tools"};
    }
    const Result<std::vector<std::uint8_t>> plane = zstd_content(in.take(in.left()), plain_bytes, "its lines");
    if (!plane) return plane.error();
    line_coding::put_residuals(*plane, planes, lines);
    return lines;
}

std::string text_of(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace

// ---------------------------------------------------------------------------------------------------------------- HEAD

Payload head_payload(const RaySpaceObject& object) {
    ByteWriter out;
    out.put(static_cast<std::uint32_t>(object.width));
    out.put(static_cast<std::uint32_t>(object.height));
    out.put(static_cast<std::uint32_t>(object.views.size()));
    out.put(static_cast<std::uint32_t>(object.rings.size()));
    out.put(object.units_per_radius);
    out.put(static_cast<std::uint32_t>(object.name.size()));
    out.put(object.name);
    return out.bytes();
}

Status parse_head(std::span<const std::byte> payload, RaySpaceObject& object) {
    ByteReader in(payload);
    const auto width = in.get<std::uint32_t>();
    const auto height = in.get<std::uint32_t>();
    const auto views = in.get<std::uint32_t>();
    const auto rings = in.get<std::uint32_t>();
    object.units_per_radius = in.get_double();
    const auto name_bytes = in.get<std::uint32_t>();
    if (!in.ok()) return Error{"is too short"};
    if (width < 1 || width > kMaxPictureSide_px)
        return out_of_range("the pictures' width", width, 1, kMaxPictureSide_px);
    if (height < 1 || height > kMaxPictureSide_px) {
        return out_of_range("the pictures' height", height, 1, kMaxPictureSide_px);
    }
    if (views < 1 || views > kMaxViews) return out_of_range("the number of views", views, 1, kMaxViews);
    if (rings < 1 || rings > kMaxRings) return out_of_range("the number of rings", rings, 1, kMaxRings);
    if (name_bytes > kMaxName_bytes) return out_of_range("the name's length", name_bytes, 0, kMaxName_bytes);
    if (in.left() != name_bytes) return wrong_size(payload.size(), payload.size() - in.left() + name_bytes);
    object.width = static_cast<int>(width);
    object.height = static_cast<int>(height);
    object.views.resize(views);
    object.rings.resize(rings);
    object.pictures.resize(views);
    object.name = text_of(in.take(name_bytes));
    return {};
}

// ---------------------------------------------------------------------------------------------------------------- RIGJ

Payload rig_payload(const RaySpaceObject& object) {
    return zstd_frame({reinterpret_cast<const std::uint8_t*>(object.rig_json.data()), object.rig_json.size()});
}

Status parse_rig_text(std::span<const std::byte> payload, RaySpaceObject& object) {
    if (payload.size() > kMaxRigJson_bytes)
        return out_of_range("the rig's length", payload.size(), 0, kMaxRigJson_bytes);
    const std::optional<std::uint64_t> expanded_bytes = stated_zstd_bytes(payload);
    if (!expanded_bytes) {  // as it is
        object.rig_json = text_of(payload);
        return {};
    }
    if (*expanded_bytes > kMaxRigJson_bytes) {
        return out_of_range("the rig's length, expanded,", *expanded_bytes, 0, kMaxRigJson_bytes);
    }
    const Result<std::vector<std::uint8_t>> text = zstd_content(payload, *expanded_bytes, "the words of its rig");
    if (!text) return text.error();
    object.rig_json.assign(text->begin(), text->end());
    return {};
}

// ---------------------------------------------------------------------------------------------------------------- VIEW

Payload views_payload(const RaySpaceObject& object) {
    ByteWriter out;
    for (const CapturedView& view : object.views) {
        out.put(view.cx_q16);
        out.put(view.cy_q16);
        out.put(view.fl_y_q16);
        out.put(view.height_q20);
    }
    return out.bytes();
}

Status parse_views(std::span<const std::byte> payload, RaySpaceObject& object) {
    if (payload.size() != object.views.size() * kView_bytes) {
        return wrong_size(payload.size(), object.views.size() * kView_bytes);
    }
    ByteReader in(payload);
    for (CapturedView& view : object.views) {
        view.cx_q16 = in.get<std::int32_t>();
        view.cy_q16 = in.get<std::int32_t>();
        view.fl_y_q16 = in.get<std::int32_t>();
        view.height_q20 = in.get<std::int32_t>();
    }
    return {};
}

// ---------------------------------------------------------------------------------------------------------------- foot

Payload foot_payload(const RaySpaceObject& object) {
    ByteWriter out;
    out.put(object.foot_q20.value());
    return out.bytes();
}

Status parse_foot(std::span<const std::byte> payload, RaySpaceObject& object) {
    if (payload.size() != sizeof(std::int32_t)) return wrong_size(payload.size(), sizeof(std::int32_t));
    object.foot_q20 = ByteReader(payload).get<std::int32_t>();
    return {};
}

// ---------------------------------------------------------------------------------------------------------------- RING

Payload ring_payload(const RaySpaceObject& object, std::size_t index, LineCoding coding) {
    const Ring& ring = object.rings[index];
    ByteWriter out;
    out.put(ring.elevation_udeg);
    out.put(static_cast<std::uint8_t>(ring.planes));
    out.put(static_cast<std::uint8_t>(coding));
    out.put(static_cast<std::uint16_t>(ring.views.size()));
    out.put(static_cast<std::uint16_t>(ring.x_cells));
    out.put(static_cast<std::uint16_t>(ring.u_cells));
    out.put(ring.x_half_q20);
    out.put(ring.x_cells_per_unit_q12);
    out.put(ring.u_half_q28);
    out.put(ring.u_cells_per_unit_q12);
    for (const std::uint16_t view : ring.views) out.put(view);
    std::vector<CapturedLine> lines;
    for (const std::uint16_t view : ring.views) {
        const std::vector<CapturedLine>& of_view = object.views[view].lines;
        lines.insert(lines.end(), of_view.begin(), of_view.end());
    }
    if (coding == LineCoding::kPlain) {
        for (const CapturedLine& line : lines) put_line(line, out);
    } else {
        out.put(std::span<const std::byte>(zstd_frame(line_coding::residual_plane(lines, ring.planes))));
    }
    return out.bytes();
}

Status parse_ring(std::span<const std::byte> payload, RaySpaceObject& object, std::size_t index) {
    Ring& ring = object.rings[index];
    ByteReader in(payload);
    ring.elevation_udeg = in.get<std::int32_t>();
    const auto planes = in.get<std::uint8_t>();
    const auto coding = in.get<std::uint8_t>();
    const auto view_count = in.get<std::uint16_t>();
    const auto x_cells = in.get<std::uint16_t>();
    const auto u_cells = in.get<std::uint16_t>();
    ring.x_half_q20 = in.get<std::int32_t>();
    ring.x_cells_per_unit_q12 = in.get<std::int32_t>();
    ring.u_half_q28 = in.get<std::int32_t>();
    ring.u_cells_per_unit_q12 = in.get<std::int32_t>();
    if (!in.ok()) return Error{"is too short"};
    if (planes < kMinPlanes || planes > kMaxPlanes) {
        return out_of_range("the number of planes", planes, kMinPlanes, kMaxPlanes);
    }
    if (view_count < 1 || view_count > object.views.size()) {
        return out_of_range("the number of views", view_count, 1, object.views.size());
    }
    if (x_cells < 1 || x_cells > kMaxMapSide) return out_of_range("the map's size along x", x_cells, 1, kMaxMapSide);
    if (u_cells < 1 || u_cells > kMaxMapSide) return out_of_range("the map's size along u", u_cells, 1, kMaxMapSide);
    if (in.left() < view_count * sizeof(std::uint16_t)) return Error{"ends inside of its list of views"};
    ring.planes = planes;
    ring.x_cells = x_cells;
    ring.u_cells = u_cells;
    ring.views.resize(view_count);
    for (std::uint16_t& view : ring.views) {
        view = in.get<std::uint16_t>();
        if (view >= object.views.size()) return out_of_range("a view's number", view, 0, object.views.size() - 1);
        if (!object.views[view].lines.empty()) {
            return Error{"names view " + std::to_string(view) + " a second time; a view belongs to one ring, once"};
        }
        object.views[view].lines.resize(planes);
    }
    const Result<std::vector<CapturedLine>> lines = parse_lines(in, view_count, planes, coding);
    if (!lines) return lines.error();
    auto next = lines->begin();
    for (const std::uint16_t view : ring.views) {
        std::copy_n(next, planes, object.views[view].lines.begin());
        next += planes;
    }
    return {};
}

// ---------------------------------------------------------------------------------------------------------------- RMAP

Payload map_payload(const map_coding::Runs& runs) {
    const std::vector<std::byte> frame = zstd_frame(map_coding::residual_plane(runs));
    ByteWriter out;
    out.reserve(sizeof(std::uint32_t) + frame.size());
    out.put(static_cast<std::uint32_t>(runs.views.size()));
    out.put(std::span<const std::byte>(frame));
    return out.bytes();
}

Payload map_payload(const Ring& ring) {
    return map_payload(map_coding::runs_of(ring.cells, ring.u_cells));
}

Result<CodedMap> parse_map_head(std::span<const std::byte> payload, const Ring& ring) {
    ByteReader in(payload);
    CodedMap coded;
    coded.runs = in.get<std::uint32_t>();
    if (!in.ok()) return Error{"ends inside its number of runs"};
    coded.rows = static_cast<std::size_t>(ring.planes) * static_cast<std::size_t>(ring.x_cells);
    const std::uint64_t cells = coded.rows * static_cast<std::uint64_t>(ring.u_cells);
    if (coded.runs < coded.rows || coded.runs > cells) {
        return out_of_range("the number of runs", coded.runs, coded.rows, cells);
    }
    coded.content_bytes = map_coding::residual_bytes(coded.rows, coded.runs);
    coded.frame = in.take(in.left());
    if (Status status = check_zstd_frame(coded.frame, coded.content_bytes, "its runs"); !status) return status.error();
    return coded;
}

Status parse_map(const CodedMap& coded, Ring& ring) {
    std::vector<std::uint8_t> plane;
    if (Status s = expand_zstd_frame(coded.frame, coded.content_bytes, "its runs", plane); !s) return s;
    ring.cells.resize(coded.rows * static_cast<std::size_t>(ring.u_cells));
    return map_coding::put_runs(map_coding::runs_of_residuals(plane, coded.rows, coded.runs), ring.u_cells, ring.cells);
}

// ---------------------------------------------------------------------------------------------------------------- PICT

std::uint64_t raw_picture_bytes(int width, int height) {
    const auto area = [](int w, int h) { return static_cast<std::uint64_t>(w) * static_cast<std::uint64_t>(h); };
    return 2 * area(width, height) + 2 * area(half_size(width), half_size(height));
}

Payload picture_payload(const PlanarPicture& picture) {
    ByteWriter out;
    out.reserve(kPictureHeader_bytes + raw_picture_bytes(picture.y.width(), picture.y.height()));
    out.put(kRawCoding);
    out.put_zeros(kPictureHeader_bytes - sizeof kRawCoding);
    for (const Image<std::uint8_t>* plane : {&picture.y, &picture.u, &picture.v, &picture.a}) out.put(plane->pixels());
    return out.bytes();
}

Status parse_picture(std::span<const std::byte> payload, int width, int height, PlanarPicture& picture) {
    ByteReader in(payload);
    const auto coding = in.get<std::uint8_t>();
    if (!in.ok()) return Error{"is empty"};
    if (coding != kRawCoding) {
        return Error{"has picture coding " + std::to_string(coding) + ", which is not known here; update these tools"};
    }
    if (!in.take_zeros(kPictureHeader_bytes - sizeof kRawCoding)) return Error{"has reserved bytes that are not zero"};
    const std::uint64_t expected_bytes = raw_picture_bytes(width, height);
    if (in.left() != expected_bytes) return wrong_size(payload.size(), kPictureHeader_bytes + expected_bytes);
    picture.y = Image<std::uint8_t>(width, height);
    picture.u = Image<std::uint8_t>(half_size(width), half_size(height));
    picture.v = Image<std::uint8_t>(half_size(width), half_size(height));
    picture.a = Image<std::uint8_t>(width, height);
    for (Image<std::uint8_t>* plane : {&picture.y, &picture.u, &picture.v, &picture.a}) {
        const auto bytes = in.take(plane->pixels().size());
        std::memcpy(plane->data(), bytes.data(), bytes.size());
    }
    return {};
}

}  // namespace rs::object_chunks
