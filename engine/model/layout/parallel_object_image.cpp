#include "engine/model/layout/object_image.hpp"

#include "engine/core/definition/effective_depth.hpp"
#include "engine/model/blocks/shared/map_reader.hpp"
#include "engine/model/limits/coded_layout.hpp"
#include "engine/model/limits/parallel_layout.hpp"
#include "engine/model/signals/messages.hpp"

#include <algorithm>
#include <numeric>

namespace rs::engine::model {
namespace {

// Order of images: those of the ring in turning order, then images that no ray uses but that others may be predicted
// from.
struct ImageOrder {
    explicit ImageOrder(const RaySpaceObject& object) : place_of(object.views.size(), -1) {
        for (const std::uint16_t view : object.rings.front().views) add(view);
        for (std::size_t view = 0; view < place_of.size(); ++view) {
            if (place_of[view] < 0) add(view);
        }
    }
    void add(std::size_t view) {
        place_of[view] = static_cast<int>(view_at.size());
        view_at.push_back(view);
    }
    [[nodiscard]] bool is_file_order() const { return std::is_sorted(view_at.begin(), view_at.end()); }

    std::vector<std::size_t> view_at;  // [place]
    std::vector<int> place_of;         // [view]
};

std::uint64_t map_words(const Ring& ring) {
    return (ring.cells.size() + 7) / 8;
}

void append_map(const Ring& ring, const ImageOrder& order, std::vector<std::uint64_t>& out) {
    const std::size_t first = out.size();
    out.resize(first + map_words(ring));
    for (std::size_t n = 0; n < ring.cells.size(); ++n) {
        const int cell = ring.cells[n] == kNoImage ? kNoImageByte : order.place_of[ring.cells[n]];
        out[first + n / 8] |= static_cast<std::uint64_t>(cell) << (8 * (n % 8));
    }
}

std::uint64_t gap_word(const ShapeMap& shape, std::size_t n) {
    const std::size_t count = shape.gaps.size();
    const auto has_lines = [&](std::size_t gap) { return shape.gaps[gap % count].lines > 0 ? 1 : 0; };
    const int beside = has_lines(n + count - 1) + 2 * has_lines(n + 1);
    return word_pair(shape.gaps[n].lines | beside << 16, static_cast<std::int32_t>(shape.gaps[n].first_line));
}

void append_records(const RaySpaceObject& object, const ImageOrder& order, std::vector<std::uint64_t>& out) {
    const Ring& ring = object.rings.front();
    const bool has_shape = !ring.shape.empty();
    for (std::size_t n = 0; n < ring.views.size(); ++n) {
        const CapturedView& view = object.views[order.view_at[n]];
        out.push_back(word_pair(view.cx_q16, view.cy_q16));
        out.push_back(word_pair(view.fl_y_q16, view.height_q20));
        out.push_back(has_shape ? gap_word(ring.shape, n) : 0);
        out.push_back(0);
        for (std::size_t k = 0; k < static_cast<std::size_t>(ring.planes); ++k) {
            const CapturedLine& line = view.lines[k];
            const NormalLine normal =
                has_shape ? ring.shape.normal_lines[n * static_cast<std::size_t>(ring.planes) + k] : NormalLine{};
            out.push_back(word_pair(line.l0_q20, line.l1_q30));
            out.push_back(word_pair(line.q0_q16, line.q1_q16));
            out.push_back(word_pair(normal.l2_q30, normal.q2_q16));
            out.push_back(word_pair(normal.a_q20, normal.c_q20));
        }
    }
}

void append_cells(const ShapeMap& shape, std::vector<std::uint64_t>& out) {
    for (std::size_t n = 0; n < shape.cells.size(); ++n) {
        const std::size_t band = n % static_cast<std::size_t>(shape.bands);
        const std::uint64_t bits = packed_cell(shape.cells[n]);
        if (band % kCellsPerWord == 0) out.push_back(0);
        out.back() |= bits << (16 * (band % kCellsPerWord));
    }
}

void append_raw_block(const PlanarImage& image, int x0, int y0, std::vector<std::uint64_t>& out) {
    const auto column = [&](const Image<std::uint8_t>& plane, int x) {
        std::uint64_t word = 0;
        for (int n = 0; n < 8; ++n) {
            if (x < plane.width() && y0 + n < plane.height()) word |= std::uint64_t{plane(x, y0 + n)} << (8 * n);
        }
        return word;
    };
    for (int x = x0; x < x0 + 8; x += 2) {
        std::uint64_t chroma = 0;
        for (int n = 0; n < 4; ++n) {
            if (x / 2 >= image.u.width() || y0 / 2 + n >= image.u.height()) continue;
            chroma |= std::uint64_t{image.u(x / 2, y0 / 2 + n)} << (16 * n);
            chroma |= std::uint64_t{image.v(x / 2, y0 / 2 + n)} << (16 * n + 8);
        }
        out.push_back(chroma);
        for (const int at : {x, x + 1}) {
            out.push_back(column(image.y, at));
            out.push_back(column(image.a, at));
        }
    }
}

void add_raw_blocks(const RaySpaceObject& object, const ImageOrder& order, ObjectRegisters& r,
                    std::vector<MemorySegment>& segments) {
    MemorySegment segment{r.raw_blocks, {}};
    for (const std::size_t view : order.view_at) {
        for (int column = 0; column < r.block_columns; ++column) {
            for (int row = 0; row < r.block_rows; ++row) {
                append_raw_block(object.images[view], 8 * column, 8 * row, segment.words);
            }
        }
    }
    segments.push_back(std::move(segment));
}

// The images in the order of `order`.
codec::CodedImages by_place(const codec::CodedImages& coded, const ImageOrder& order) {
    codec::CodedImages out = coded;
    for (std::size_t place = 0; place < order.view_at.size(); ++place) {
        out.images[place] = coded.images[order.view_at[place]];
        codec::ImageHead& head = out.images[place].head;
        for (int n = 0; n < head.references(); ++n) {
            std::uint16_t& reference = head.reference[static_cast<std::size_t>(n)];
            reference = static_cast<std::uint16_t>(order.place_of[reference]);
        }
    }
    return out;
}

ShapeRegisters shape_registers(const ShapeMap& shape, WordAddress cells) {
    ShapeRegisters r;
    if (shape.empty()) return r;
    r.exists = true;
    r.p_cells = shape.p_cells;
    r.bands = shape.bands;
    r.p_half_q20 = shape.p_half_q20;
    r.p_cells_per_unit_q12 = shape.p_cells_per_unit_q12;
    r.h_low_q20 = shape.h_low_q20;
    r.bands_per_unit_q12 = shape.bands_per_unit_q12;
    r.reference_distance_q20 = shape.reference_distance_q20;
    r.reference_height_q20 = shape.reference_height_q20;
    r.depth_low_q20 = shape.depth_low_q20;
    r.depth_step_q24 = shape.depth_step_q24;
    const auto effective = EffectiveDepth(shape).table();
    std::transform(effective.begin(), effective.end(), r.effective_depth_q3.begin(),
                   [](std::int32_t depth_q3) { return static_cast<std::int16_t>(depth_q3); });
    r.foot_d_q3 = static_cast<int>(
        std::clamp<std::int64_t>(-std::int64_t{shape.depth_low_q20} * 128 / shape.depth_step_q24, 0, 255 * 8));
    r.jump = shape.jump;
    r.thickness = shape.thickness;
    r.lines = static_cast<std::int64_t>(shape.cells.size()) / (shape.p_cells * shape.bands);
    r.cells = cells;
    return r;
}

}  // namespace

std::array<std::uint64_t, kObjectRegions> parallel_object_words(const RaySpaceObject& object) {
    const Ring& ring = object.rings.front();
    std::array<std::uint64_t, kObjectRegions> words{};
    if (object.coded != nullptr) {
        words = coded_words(*object.coded);
    } else {
        words[static_cast<std::size_t>(Region::flat_tiles)] =
            object.views.size() * raw_image_words(object.width, object.height);
    }
    words[static_cast<std::size_t>(Region::tables)] +=
        map_words(ring) + ring.views.size() * static_cast<std::uint64_t>(record_words(ring.planes)) +
        cell_words(ring.shape);
    return words;
}

ObjectImage parallel_object_image(const RaySpaceObject& object, const Placement& placement) {
    const Ring& ring = object.rings.front();
    const ImageOrder order(object);
    ObjectImage image;
    ObjectRegisters& r = image.registers;
    set_map_registers(object, r);
    r.images = static_cast<int>(ring.views.size());
    r.map = placement.first[static_cast<std::size_t>(Region::tables)];
    MemorySegment tables{r.map, {}};
    const auto here = [&] { return r.map + static_cast<WordAddress>(tables.words.size()); };
    append_map(ring, order, tables.words);
    r.lines = here();
    append_records(object, order, tables.words);
    r.shape = shape_registers(ring.shape, here());
    append_cells(ring.shape, tables.words);
    const WordAddress books = here();
    image.segments.push_back(std::move(tables));
    r.coded = object.coded != nullptr;
    if (!r.coded) {
        r.raw_blocks = placement.first[static_cast<std::size_t>(Region::flat_tiles)];
        r.block_columns = (object.width + 7) / 8;
        r.block_rows = (object.height + 7) / 8;
        add_raw_blocks(object, order, r, image.segments);
    } else if (order.is_file_order()) {
        add_coded_images(*object.coded, placement, books, r, image.segments);
    } else {
        add_coded_images(by_place(*object.coded, order), placement, books, r, image.segments);
    }
    return image;
}

}  // namespace rs::engine::model
