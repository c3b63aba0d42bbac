#include "engine/model/layout/object_image.hpp"

#include "engine/model/blocks/shared/map_reader.hpp"
#include "engine/model/limits/coded_layout.hpp"
#include "engine/model/limits/parallel_layout.hpp"
#include "engine/model/signals/messages.hpp"
#include "rayspace/codec/prediction_unit.hpp"

#include <algorithm>

namespace rs::engine::model {
namespace {

constexpr int words_of(int items, int items_per_word) {
    return (items + items_per_word - 1) / items_per_word;
}

// Columns of a plane, `bits` to a sample; sample (x, y) is value(image, x, y).
template <class Value>
MemorySegment columns(WordAddress address, const RaySpaceObject& object, int width, int height, int bits,
                      Value&& value) {
    const int per_word = 64 / bits;
    const auto pitch = static_cast<std::size_t>(words_of(height, per_word));
    MemorySegment segment{address, {}};
    segment.words.resize(object.images.size() * static_cast<std::size_t>(width) * pitch);
    std::uint64_t* column = segment.words.data();
    for (const PlanarImage& image : object.images) {
        for (int x = 0; x < width; ++x, column += pitch) {
            for (int y = 0; y < height; ++y) {
                column[y / per_word] |= static_cast<std::uint64_t>(value(image, x, y)) << (bits * (y % per_word));
            }
        }
    }
    return segment;
}

MemorySegment map_and_lines(WordAddress address, const RaySpaceObject& object) {
    const Ring& ring = object.rings.front();
    MemorySegment segment{address, {}};
    segment.words.resize((ring.cells.size() + 7) / 8);
    for (std::size_t n = 0; n < ring.cells.size(); ++n) {
        const std::uint64_t cell = ring.cells[n] == kNoImage ? kNoImageByte : ring.cells[n];
        segment.words[n / 8] |= cell << (8 * (n % 8));
    }
    for (const CapturedView& view : object.views) {
        segment.words.push_back(word_pair(view.cx_q16, view.cy_q16));
        segment.words.push_back(word_pair(view.fl_y_q16, view.height_q20));
        for (const CapturedLine& line : view.lines) {
            segment.words.push_back(word_pair(line.l0_q20, line.l1_q30));
            segment.words.push_back(word_pair(line.q0_q16, line.q1_q16));
        }
    }
    return segment;
}

void add_raw_images(const RaySpaceObject& object, const Placement& placement, ObjectRegisters& r,
                    std::vector<MemorySegment>& segments) {
    const auto at = [&](Region region) { return placement.first[static_cast<std::size_t>(region)]; };
    r.luma_pitch = words_of(object.height, 8);
    r.chroma_pitch = words_of(half_size(object.height), 4);
    r.alpha_pitch = words_of(object.height, 32);
    r.luma = at(Region::luma);
    r.chroma = at(Region::chroma);
    r.alpha = at(Region::alpha);
    segments.push_back(columns(r.alpha, object, object.width, object.height, 2, [](const PlanarImage& p, int x, int y) {
        return codec::level_of_alpha(p.a(x, y), kAlphaBits);
    }));
    segments.push_back(columns(r.chroma, object, half_size(object.width), half_size(object.height), 16,
                               [](const PlanarImage& p, int x, int y) { return p.u(x, y) | p.v(x, y) << 8; }));
    segments.push_back(columns(r.luma, object, object.width, object.height, 8,
                               [](const PlanarImage& p, int x, int y) { return p.y(x, y); }));
}

}  // namespace

Status has_raw_images(const RaySpaceObject& object) {
    if (object.coded != nullptr) {
        return Error{object.name + ": its images are of profile " + codec::name_of(object.coded->profile) +
                     ", but this board holds raw images (U and V at half size); encode it with --profile raw" +
                     (object.coded->profile == codec::Profile::kBoard
                          ? ", or use compressed-2000"
                          : ", or with --profile board for compressed-2000")};
    }
    if (object.images.size() != object.views.size() ||
        std::any_of(object.images.begin(), object.images.end(), [](const PlanarImage& p) { return p.empty(); })) {
        return Error{object.name + ": not all of its images are loaded; read it at its full level, unpacked"};
    }
    for (const PlanarImage& image : object.images) {
        if (image.chroma_shift != 1) {
            return Error{object.name +
                         ": stores colour at full size, but the board has U and V at half size; encode it "
                         "with colour at half size"};
        }
    }
    return {};
}

RaySpaceObject with_board_alpha(RaySpaceObject object) {
    for (PlanarImage& image : object.images) {
        for (std::uint8_t& a : image.a.pixels()) {
            a = static_cast<std::uint8_t>(codec::alpha_of_level(codec::level_of_alpha(a, kAlphaBits), kAlphaBits));
        }
    }
    return object;
}

void set_map_registers(const RaySpaceObject& object, ObjectRegisters& r) {
    const Ring& ring = object.rings.front();
    r.width = object.width;
    r.height = object.height;
    r.images = static_cast<int>(object.views.size());
    r.planes = ring.planes;
    r.x_cells = ring.x_cells;
    r.u_cells = ring.u_cells;
    r.x_half_q20 = ring.x_half_q20;
    r.x_cells_per_unit_q12 = ring.x_cells_per_unit_q12;
    r.u_half_q28 = ring.u_half_q28;
    r.u_cells_per_unit_q12 = ring.u_cells_per_unit_q12;
}

Status ObjectLayout::fit_together(std::span<const RaySpaceObject> objects, const BoardLimits& limits) const {
    if (objects.size() > static_cast<std::size_t>(limits.objects)) {
        return Error{std::to_string(objects.size()) + " objects, more than the board's " +
                     std::to_string(limits.objects) + "; load fewer at a time"};
    }
    std::uint64_t needed_bytes = image_buffer_bytes(limits);
    for (const RaySpaceObject& object : objects) needed_bytes += footprint(object).total_bytes();
    if (needed_bytes > limits.memory_bytes) {
        return Error{"the objects and the image buffer need " + std::to_string(needed_bytes) +
                     " bytes of board memory, more than its " + std::to_string(limits.memory_bytes) +
                     "; load fewer objects or encode them smaller"};
    }
    return {};
}

Status ObjectLayout::fits(const RaySpaceObject& object, const BoardLimits& limits) const {
    RS_TRY(within_limits(object, limits));
    return fit_together({&object, 1}, limits);
}

namespace {

using Words = std::array<std::uint64_t, kObjectRegions>;

// Footprint of the RS maps, and of `line_words` words per view and per line of a view.
BoardFootprint maps_and_lines(const RaySpaceObject& object, std::uint64_t line_words) {
    BoardFootprint footprint;
    for (const Ring& ring : object.rings) {
        footprint.map_bytes += ring.cells.size();
        footprint.lines_bytes += 8 * line_words * ring.views.size() * (1 + static_cast<std::uint64_t>(ring.planes));
    }
    return footprint;
}

void add_coded(const codec::CodedImages& coded, BoardFootprint& footprint) {
    footprint.tile_bytes = 8 * (image_words(coded, false) + image_words(coded, true));
    footprint.tile_table_bytes = 8 * tile_table_words(coded);
    footprint.book_bytes = 8 * book_words(coded.board);
}

// Boards of 2000: one ring, its map and lines in one table; the derived class adds the images.
class SingleRingLayout : public ObjectLayout {
public:
    [[nodiscard]] Status drawable(const RaySpaceObject& object, const BoardLimits& limits) const override {
        if (object.rings.empty() || object.views.empty()) return Error{object.name + ": holds no ring of views"};
        if (Status images = has_images(object); !images) {
            if (object.rings.front().shape.empty()) return images;
            return Error{images.error().message +
                         "; it also has a shape map: add --raymap plane, or use parallel, which takes --profile board "
                         "and --profile raw"};
        }
        RS_TRY(fits(object, limits));
        if (object.rings.front().shape.empty()) return {};
        return Error{object.name +
                     ": has a shape map, which the published board does not support (it renders surfaces on "
                     "reference planes only); encode it with --raymap plane, or use parallel"};
    }

    [[nodiscard]] Words words(const RaySpaceObject& object) const override {
        const Ring& ring = object.rings.front();
        Words words = image_words(object);
        words[static_cast<std::size_t>(Region::tables)] +=
            (ring.cells.size() + 7) / 8 + 2 * object.views.size() * static_cast<std::uint64_t>(1 + ring.planes);
        return words;
    }

    [[nodiscard]] ObjectImage image(const RaySpaceObject& object, const Placement& placement) const override {
        const Ring& ring = object.rings.front();
        ObjectImage image;
        ObjectRegisters& r = image.registers;
        set_map_registers(object, r);
        r.map = placement.first[static_cast<std::size_t>(Region::tables)];
        r.lines = r.map + static_cast<WordAddress>((ring.cells.size() + 7) / 8);
        image.segments.push_back(map_and_lines(r.map, object));
        add_images(object, placement, r.map + static_cast<WordAddress>(image.segments.back().words.size()), image);
        return image;
    }

protected:
    [[nodiscard]] virtual Status has_images(const RaySpaceObject& object) const = 0;
    [[nodiscard]] virtual Words image_words(const RaySpaceObject& object) const = 0;
    // `behind_tables`: first free word of the region of the tables.
    virtual void add_images(const RaySpaceObject& object, const Placement& placement, WordAddress behind_tables,
                            ObjectImage& image) const = 0;
};

class RawLayout final : public SingleRingLayout {
public:
    [[nodiscard]] BoardFootprint footprint(const RaySpaceObject& object) const override {
        const std::uint64_t images = object.views.size();
        const auto area = [](int width, int height) {
            return static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
        };
        BoardFootprint footprint = maps_and_lines(object, 2);
        footprint.luma_bytes = images * area(object.width, object.height);
        footprint.chroma_bytes = images * 2 * area(half_size(object.width), half_size(object.height));
        footprint.alpha_bytes = images * ((area(object.width, object.height) * kAlphaBits + 7) / 8);
        return footprint;
    }
    [[nodiscard]] RaySpaceObject as_rendered(RaySpaceObject object) const override {
        return with_board_alpha(std::move(object));
    }

private:
    [[nodiscard]] Status has_images(const RaySpaceObject& object) const override { return has_raw_images(object); }
    [[nodiscard]] Words image_words(const RaySpaceObject& object) const override {
        const auto columns_of = [&](int width, int words) {
            return object.views.size() * static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(words);
        };
        return {columns_of(object.width, words_of(object.height, 8)),
                columns_of(half_size(object.width), words_of(half_size(object.height), 4)),
                columns_of(object.width, words_of(object.height, 32)), 0};
    }
    void add_images(const RaySpaceObject& object, const Placement& placement, WordAddress,
                    ObjectImage& image) const override {
        add_raw_images(object, placement, image.registers, image.segments);
    }
};

class CodedLayout final : public SingleRingLayout {
public:
    [[nodiscard]] BoardFootprint footprint(const RaySpaceObject& object) const override {
        BoardFootprint footprint = maps_and_lines(object, 2);
        add_coded(*object.coded, footprint);
        return footprint;
    }

private:
    [[nodiscard]] Status has_images(const RaySpaceObject& object) const override { return has_board_images(object); }
    [[nodiscard]] Words image_words(const RaySpaceObject& object) const override { return coded_words(*object.coded); }
    void add_images(const RaySpaceObject& object, const Placement& placement, WordAddress behind_tables,
                    ObjectImage& image) const override {
        add_coded_images(*object.coded, placement, behind_tables, image.registers, image.segments);
    }
};

class ParallelLayout final : public ObjectLayout {
public:
    [[nodiscard]] BoardFootprint footprint(const RaySpaceObject& object) const override {
        BoardFootprint footprint = maps_and_lines(object, 4);
        if (object.coded != nullptr) {
            add_coded(*object.coded, footprint);
        } else {
            footprint.luma_bytes = 8 * object.views.size() * raw_image_words(object.width, object.height);
        }
        for (const Ring& ring : object.rings) footprint.shape_bytes += 8 * cell_words(ring.shape);
        return footprint;
    }
    [[nodiscard]] Status drawable(const RaySpaceObject& object, const BoardLimits& limits) const override {
        if (object.rings.empty() || object.views.empty()) return Error{object.name + ": holds no ring of views"};
        if (object.coded != nullptr && object.coded->profile != codec::Profile::kBoard) {
            return Error{object.name + ": its images are of profile " + codec::name_of(object.coded->profile) +
                         ", but the board decodes images of profile board; encode it with --profile board or --profile "
                         "raw"};
        }
        const bool coded = object.coded != nullptr;
        RS_TRY(coded ? has_board_images(object) : has_raw_images(object));
        return fits(object, limits);
    }
    [[nodiscard]] Words words(const RaySpaceObject& object) const override { return parallel_object_words(object); }
    [[nodiscard]] ObjectImage image(const RaySpaceObject& object, const Placement& placement) const override {
        return parallel_object_image(object, placement);
    }
};

}  // namespace

const ObjectLayout& layout_of(BoardKind kind) {
    static const RawLayout kRaw;
    static const CodedLayout kCoded;
    static const ParallelLayout kParallel;
    switch (kind) {
        case BoardKind::raw_images:
            return kRaw;
        case BoardKind::coded_images:
            return kCoded;
        case BoardKind::any_object:
            break;
    }
    return kParallel;
}

}  // namespace rs::engine::model
