#include "engine/core/fast/renderer.hpp"

#include "engine/core/definition/mix_rings.hpp"
#include "engine/core/definition/ray_setup.hpp"
#include "engine/core/definition/shape_pixel.hpp"
#include "engine/core/fast/column_walk.hpp"
#include "engine/core/fast/shape_walk.hpp"
#include "rayspace/base/parallel_loop.hpp"
#include "rayspace/format/object_file.hpp"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <cstdlib>
#include <utility>
#include <vector>

namespace rs::engine {
namespace {

constexpr int kRowsPerTile = 128;

ColumnStrip set_up_strip(const RaySpaceObject& object, const TexelStore& texels, const ViewRegisters& registers,
                         int first_column) {
    ColumnStrip strip{};
    const int columns = std::min(kStripColumns, registers.width - first_column);
    strip.first_used = registers.height;
    strip.last_full = registers.height;
    for (int lane = 0; lane < columns; ++lane) {
        const RaySetup ray = set_up_ray(object, registers, first_column + lane, 0);
        ViewRows rows;
        if (ray.image >= 0) {
            texels.ensure(ray.image, ray.column, ray.column);
            const RowSpan occupied = texels.occupied(ray.image, ray.column);
            rows = rows_within(ray, occupied.begin, occupied.end, registers.height);
            strip.start[lane] = texels.column_start(ray.image, ray.column);
            // Modulo 2^32, see ColumnStrip.
            strip.row_0_q16[lane] = static_cast<std::int32_t>(ray.row_0_q16);
            strip.row_step_q16[lane] = static_cast<std::int32_t>(ray.row_step_q16);
        }
        strip.begin[lane] = rows.begin;
        strip.end[lane] = rows.end;
        strip.first_full = std::max(strip.first_full, rows.begin);
        strip.last_full = std::min(strip.last_full, rows.end);
        if (rows.begin == rows.end) continue;
        strip.first_used = std::min(strip.first_used, rows.begin);
        strip.last_used = std::max(strip.last_used, rows.end);
    }
    if (columns < kStripColumns) strip.last_full = 0;  // unused lanes are transparent
    return strip;
}

int strip_count(const ViewRegisters& registers) {
    return (registers.width + kStripColumns - 1) / kStripColumns;
}

// Writes pixel(i, j) for every pixel of the view.
template <class Pixel>
void render_pixels(const Pixel& pixel, ImageView<Rgba8> out, ImageView<std::int32_t> lambda) {
    for_each_index(out.height(), [&](int j) {
        for (int i = 0; i < out.width(); ++i) {
            const ShapePixel found = pixel(i, j);
            out(i, j) = found.colour;
            if (!lambda.empty()) lambda(i, j) = found.colour.a > 0 ? found.lambda_q20 : 0;
        }
    });
}

bool is_any_loaded(const Ring& ring, const std::vector<bool>& loaded) {
    return std::any_of(ring.views.begin(), ring.views.end(), [&](std::uint16_t view) { return loaded[view]; });
}

bool are_all_loaded(const Ring& ring, const std::vector<bool>& loaded) {
    return std::all_of(ring.views.begin(), ring.views.end(), [&](std::uint16_t view) { return loaded[view]; });
}

// The RS map with the nearest loaded views in turning order in place of missing ones; without any, kNoImage.
std::vector<std::uint16_t> substituted_cells(const Ring& ring, const std::vector<bool>& loaded) {
    const int count = static_cast<int>(ring.views.size());
    const auto view_at = [&](int n) { return ring.views[static_cast<std::size_t>(n)]; };
    std::vector<std::uint16_t> substitute(loaded.size(), kNoImage);
    for (int n = 0; n < count; ++n) {
        std::uint16_t& found = substitute[view_at(n)];
        for (int away = 0; away <= count / 2 && found == kNoImage; ++away) {
            for (const int candidate : {(n - away + count) % count, (n + away) % count}) {
                if (!loaded[view_at(candidate)]) continue;
                found = view_at(candidate);
                break;
            }
        }
    }
    std::vector<std::uint16_t> cells = ring.cells;
    for (std::uint16_t& cell : cells) {
        if (cell != kNoImage) cell = substitute[cell];
    }
    return cells;
}

}  // namespace

Status substitute_missing_images(RaySpaceObject& object) {
    const bool coded = has_only_coded_images(object);
    std::vector<bool> loaded;
    for (std::size_t view = 0; view < object.views.size(); ++view) {
        loaded.push_back(coded ? object.coded->images[view].loaded() : !object.images[view].empty());
    }
    for (Ring& ring : object.rings) {
        if (!is_any_loaded(ring, loaded)) {
            return Error{object.name + ": a ring has no image loaded; read the object at a higher level"};
        }
        if (!are_all_loaded(ring, loaded)) ring.shape = {};
        ring.cells = substituted_cells(ring, loaded);
    }
    return {};
}

Renderer::Renderer(RaySpaceObject object, TexelStore texels) : object_(std::move(object)), texels_(std::move(texels)) {}

Result<Renderer> Renderer::create(RaySpaceObject object, const RendererOptions& options) {
    const bool is_arriving = options.arrival == ImageArrival::later && has_only_coded_images(object);
    if (!is_arriving) RS_TRY(substitute_missing_images(object));
    RS_ASSIGN_OR_RETURN(TexelStore texels,
                        TexelStore::create(object, options.decoded_budget_bytes,
                                           is_arriving ? ImageArrival::later : ImageArrival::complete));
    object.images.clear();
    object.images.shrink_to_fit();
    Renderer renderer(std::move(object), std::move(texels));
    if (is_arriving) {
        renderer.substituted_ = renderer.object_;
        for (Ring& ring : renderer.substituted_->rings) ring.shape = {};
        renderer.images_arrived();
    } else {
        renderer.decodable_.assign(renderer.object_.views.size(), true);
    }
    return renderer;
}

void Renderer::images_arrived() {
    if (!substituted_) return;
    decodable_ = decodable_images(*object_.coded);
    if (std::all_of(decodable_.begin(), decodable_.end(), [](bool is_decodable) { return is_decodable; })) {
        substituted_.reset();
        return;
    }
    for (std::size_t r = 0; r < object_.rings.size(); ++r) {
        substituted_->rings[r].cells = substituted_cells(object_.rings[r], decodable_);
    }
}

void Renderer::shape_arrived(std::size_t ring, ShapeMap shape) {
    object_.rings[ring].shape = std::move(shape);
}

bool Renderer::has_images(int ring) const {
    return is_any_loaded(object_.rings[static_cast<std::size_t>(ring)], decodable_);
}

std::vector<int> Renderer::images_of(const ViewRegisters& registers) const {
    const Ring& ring = object_.rings[static_cast<std::size_t>(registers.ring)];
    if (!registers.upright()) return {ring.views.begin(), ring.views.end()};
    std::vector<bool> is_read(object_.views.size(), false);
    for (int i = 0; i < registers.width; ++i) {
        if (ring.shape.empty()) {
            const RaySetup ray = set_up_ray(object_, registers, i, 0);
            if (ray.image >= 0) is_read[static_cast<std::size_t>(ray.image)] = true;
            continue;
        }
        const ShapeSetup setup = set_up_shape(object_, registers, i, 0);
        if (!setup.has_ray) continue;
        if (setup.weight < 256) is_read[static_cast<std::size_t>(setup.first.view)] = true;
        if (setup.weight > 0) is_read[static_cast<std::size_t>(setup.second.view)] = true;
    }
    std::vector<int> views;
    for (std::size_t view = 0; view < is_read.size(); ++view) {
        if (is_read[view]) views.push_back(static_cast<int>(view));
    }
    return views;
}

// The object itself if it has all images that a view reads, else the one with substitutes.
const RaySpaceObject& Renderer::object_for(const ViewRegisters& registers) const {
    if (!substituted_) return object_;
    const auto is_decodable = [&](int view) { return bool{decodable_[static_cast<std::size_t>(view)]}; };
    const std::vector<int> views = images_of(registers);
    return std::all_of(views.begin(), views.end(), is_decodable) ? object_ : *substituted_;
}

std::int64_t Renderer::memory_bytes() const {
    return object_memory_bytes(object_) + texels_.memory_bytes();
}

void Renderer::render(const MixedView& view, ImageView<Rgba8> out, ImageView<std::int32_t> lambda_q20) const {
    render(view.nearest, out, lambda_q20);
    if (!view.second) return;
    Image<Rgba8> second(out.width(), out.height());
    Image<std::int32_t> second_lambda(lambda_q20.width(), lambda_q20.height());
    render(*view.second, second, second_lambda);
    mix_rings(out, lambda_q20, second, second_lambda, view.weight_q8);
}

void Renderer::render(const ViewRegisters& registers, ImageView<Rgba8> out, ImageView<std::int32_t> lambda_q20) const {
    RS_CHECK(out.width() == registers.width && out.height() == registers.height);
    RS_CHECK(lambda_q20.empty() || (lambda_q20.width() == registers.width && lambda_q20.height() == registers.height));
    const TexelStore::Reading reading = texels_.read();
    const RaySpaceObject& object = object_for(registers);
    const bool has_shape = !object.rings[static_cast<std::size_t>(registers.ring)].shape.empty();
    if (has_shape && registers.upright() && can_walk_shape()) {
        render_shape_upright(registers, out, lambda_q20);
    } else if (has_shape) {
        render_shape_pixels(registers, out, lambda_q20);
    } else if (registers.upright()) {
        render_upright(object, registers, out, lambda_q20);
    } else {
        render_tilted(object, registers, out, lambda_q20);
    }
}

void Renderer::render_upright(const RaySpaceObject& object, const ViewRegisters& registers, ImageView<Rgba8> out,
                              ImageView<std::int32_t> lambda) const {
    const int strips = strip_count(registers);
    std::vector<ColumnStrip> strip(static_cast<std::size_t>(strips));
    const int grain = texels_.is_coded() ? 1 : 8;  // decoding is slow enough for one task per strip
    for_each_range(strips, grain, [&](int begin, int end) {
        for (int s = begin; s < end; ++s) {
            strip[static_cast<std::size_t>(s)] = set_up_strip(object, texels_, registers, s * kStripColumns);
        }
    });
    const int tiles = (registers.height + kRowsPerTile - 1) / kRowsPerTile;
    for_each_index(tiles, [&](int tile) {
        const int row_begin = tile * kRowsPerTile;
        const int row_end = std::min(row_begin + kRowsPerTile, registers.height);
        for (int s = 0; s < strips; ++s) {
            const int first = s * kStripColumns;
            walk_columns(strip[static_cast<std::size_t>(s)], texels_.texels(), row_begin, row_end,
                         std::min(kStripColumns, registers.width - first), out.row(row_begin) + first, out.stride());
        }
    });
    if (lambda.empty()) return;
    std::vector<std::int32_t> column_lambda;
    for (int i = 0; i < registers.width; ++i) column_lambda.push_back(set_up_ray(object, registers, i, 0).lambda_q20);
    for_each_index(registers.height, [&](int j) {
        for (int i = 0; i < registers.width; ++i) {
            lambda(i, j) = out(i, j).a > 0 ? column_lambda[static_cast<std::size_t>(i)] : 0;
        }
    });
}

void Renderer::render_tilted(const RaySpaceObject& object, const ViewRegisters& registers, ImageView<Rgba8> out,
                             ImageView<std::int32_t> lambda) const {
    const auto pixel = [&](int i, int j) -> ShapePixel {
        const RaySetup ray = set_up_ray(object, registers, i, j);
        if (ray.image < 0) return {};
        const std::int64_t row = ray.row(j);
        if (row < 0 || row >= object.height) return {};
        texels_.ensure(ray.image, ray.column, ray.column);
        return {texels_.texels()[texels_.column_start(ray.image, ray.column) + row], ray.lambda_q20};
    };
    render_pixels(pixel, out, lambda);
}

void Renderer::render_shape_upright(const ViewRegisters& registers, ImageView<Rgba8> out,
                                    ImageView<std::int32_t> lambda) const {
    const ShapeWalk walk = set_up_walk(object_, texels_, registers);
    std::vector<std::int32_t> rise_q24;
    for (int j = 0; j < registers.height; ++j) {
        rise_q24.push_back(registers.rise_q24(0, j));
    }
    rise_q24.resize(rise_q24.size() + kBlockRows);
    tbb::enumerable_thread_specific<ShapeStrip> strip_of_thread;
    for_each_range(strip_count(registers), 1, [&](int begin, int end) {
        ShapeStrip& strip = strip_of_thread.local();
        for (int s = begin; s < end; ++s) {
            const int first = s * kStripColumns;
            set_up_shape_strip(object_, texels_, registers, walk, first, strip);
            ShapeWalkOutput to{out.row(0) + first, out.stride(), nullptr, 0};
            if (!lambda.empty()) {
                to.lambda_q20 = lambda.row(0) + first;
                to.lambda_stride = lambda.stride();
            }
            walk_shape(walk, strip, rise_q24.data(), std::min(kStripColumns, registers.width - first), to);
        }
    });
}

void Renderer::render_shape_pixels(const ViewRegisters& registers, ImageView<Rgba8> out,
                                   ImageView<std::int32_t> lambda) const {
    struct Texels {
        const TexelStore& store;
        [[nodiscard]] std::int32_t index(int view, int column, int row) const {
            store.ensure(view, column, column);
            return store.column_start(view, column) + row;
        }
        [[nodiscard]] Rgba8 color(int view, int column, int row) const {
            return store.texels()[index(view, column, row)];
        }
        [[nodiscard]] int detail(int view, int column, int row) const {
            return store.details()[index(view, column, row)];
        }
    };
    const auto pixel = [&](int i, int j) -> ShapePixel {
        const ShapeSetup setup = set_up_shape(object_, registers, i, j);
        if (!setup.has_ray) return {};
        return shape_pixel(object_, registers, setup, registers.rise_q24(i, j), Texels{texels_});
    };
    render_pixels(pixel, out, lambda);
}

}  // namespace rs::engine
