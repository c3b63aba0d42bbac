#include "compositor/gpu/shader/view_setup.hpp"

#include "compositor/gpu/shader/reconstruction_shader.hpp"
#include "engine/core/definition/ray_setup.hpp"
#include "engine/core/definition/shape_setup.hpp"
#include "rayspace/base/parallel_loop.hpp"

#include <algorithm>
#include <cstddef>
#include <set>

namespace rs::compositor {
namespace {

using engine::ShapeImage;
using engine::ShapeSetup;

using Setup = std::array<SetupTexel, kSetupTexels>;

constexpr int kColumnsPerTask = 16;

std::int32_t kind_bits(SetupKind kind) {
    return static_cast<std::int32_t>(kind);
}

Setup plane_setup(const RaySpaceObject& object, const engine::ViewRegisters& registers, int i, int j) {
    const engine::RaySetup ray = engine::set_up_ray(object, registers, i, j);
    if (ray.image < 0) return {};
    const auto lowest_bits = [](std::int64_t number) { return static_cast<std::int32_t>(number); };
    Setup setup{};
    if (registers.upright()) {
        const engine::ViewRows rows = engine::rows_within(ray, 0, object.height, registers.height);
        setup[0] = {kind_bits(SetupKind::kPlane), lowest_bits(ray.row_0_q16), lowest_bits(ray.row_step_q16),
                    ray.lambda_q20};
        setup[1] = {ray.image, ray.column, rows.begin, rows.end};
        return setup;
    }
    const std::int64_t row = ray.row(j);
    if (row < 0 || row >= object.height) return {};
    setup[0] = {kind_bits(SetupKind::kPlane), lowest_bits(row << 16), 0, ray.lambda_q20};
    setup[1] = {ray.image, ray.column, 0, registers.height};
    return setup;
}

// The cells around a ray: texel 2, and the depths of texel 1.
struct CellNumbers {
    SetupTexel columns{};
    std::int32_t depths = 0;
};

CellNumbers cell_numbers(const ShapeMap& shape, std::span<const ColumnBounds> bounds,
                         const engine::CellColumns& columns) {
    const auto number = [&](int p, int line) { return (columns.at[p][line] - shape.cells.data()) / shape.bands; };
    ColumnBounds all;
    for (const int p : {0, 1}) {
        for (const int line : {0, 1}) {
            const ColumnBounds& column = bounds[static_cast<std::size_t>(number(p, line))];
            all.nearest = std::min(all.nearest, column.nearest);
            all.deepest = std::max(all.deepest, column.deepest);
            all.first_band = std::min(all.first_band, column.first_band);
            all.last_band = std::max(all.last_band, column.last_band);
        }
    }
    const std::ptrdiff_t pairs = shape.bands + 2;  // of a column, gpu_object.hpp
    const auto pair = [&](std::ptrdiff_t column) { return static_cast<std::int32_t>(column * pairs); };
    return {{pair(number(0, 0)), pair(number(0, 1)), pair(number(1, 0) - number(0, 0)),
             all.first_band | all.last_band << 16},
            all.nearest | all.deepest << 8};
}

void set_photo(const RaySpaceObject& object, const ShapeImage& image, SetupTexel& line, SetupTexel& lens) {
    if (image.view < 0) return;
    const CapturedView& view = object.views[static_cast<std::size_t>(image.view)];
    line = {image.l0_q20, image.l1_q24, image.n0_q12, image.n1_q12};
    lens = {view.cx_q16 >> 8, view.cy_q16 >> 8, view.fl_y_q16 >> 8, view.height_q20 >> 4};
}

Setup shape_setup(const RaySpaceObject& object, const engine::ViewRegisters& registers,
                  std::span<const ColumnBounds> bounds, int i, int j) {
    const ShapeSetup ray = engine::set_up_shape(object, registers, i, j);
    if (!ray.has_ray) return {};
    const ShapeMap& shape = object.rings[static_cast<std::size_t>(registers.ring)].shape;
    Setup setup{};
    const SetupKind kind = ray.has_shape() ? SetupKind::kShape : SetupKind::kNoShape;
    setup[0] = {kind_bits(kind) | ray.weight << 2 | ray.cells.p_part << 11 | ray.cells.line_part << 14 |
                    ray.foot_depth_q3 << 17,
                ray.lambda_foot_q20, ray.inverse_r_q20, ray.inverse_rho_q20};
    const CellNumbers cells = ray.has_shape() ? cell_numbers(shape, bounds, ray.cells) : CellNumbers{};
    setup[1] = {ray.lambda0_q20, ray.lambda1_q21, ray.first.view | std::max(ray.second.view, 0) << 16, cells.depths};
    setup[2] = cells.columns;
    set_photo(object, ray.first, setup[3], setup[4]);
    set_photo(object, ray.second, setup[5], setup[6]);
    return setup;
}

}  // namespace

std::vector<ColumnBounds> column_bounds(const ShapeMap& shape) {
    const auto bands = static_cast<std::size_t>(shape.bands);
    std::vector<ColumnBounds> bounds(shape.cells.empty() ? 0 : shape.cells.size() / bands);
    for_each_index(bounds.size(), [&](std::size_t column) {
        ColumnBounds& found = bounds[column];
        for (std::size_t band = 0; band < bands; ++band) {
            const ShapeCell cell = shape.cells[column * bands + band];
            if (!cell.has_surface()) continue;
            found.nearest = std::min(found.nearest, cell.depth);
            found.deepest = std::max(found.deepest, cell.depth);
            found.first_band = std::min(found.first_band, static_cast<std::uint16_t>(band));
            found.last_band = static_cast<std::uint16_t>(band);
        }
    });
    return bounds;
}

std::vector<SetupTexel> set_up_rows(const RaySpaceObject& object, const engine::ViewRegisters& registers,
                                    std::span<const ColumnBounds> bounds, int first_row, int rows) {
    const bool has_shape = !object.rings[static_cast<std::size_t>(registers.ring)].shape.empty();
    const auto width = static_cast<std::size_t>(registers.width);
    std::vector<SetupTexel> texels(static_cast<std::size_t>(rows) * kSetupTexels * width);
    for_each_range(rows * registers.width, kColumnsPerTask, [&](int begin, int end) {
        for (int n = begin; n < end; ++n) {
            const int row = n / registers.width;
            const int i = n % registers.width;
            const Setup setup = has_shape ? shape_setup(object, registers, bounds, i, first_row + row)
                                          : plane_setup(object, registers, i, first_row + row);
            const auto first = static_cast<std::size_t>(row) * kSetupTexels * width + static_cast<std::size_t>(i);
            for (std::size_t t = 0; t < kSetupTexels; ++t) texels[first + t * width] = setup[t];
        }
    });
    return texels;
}

PhotosOfSetup photos_of(const SetupTexel& head, const SetupTexel& view) {
    const auto kind = static_cast<SetupKind>(head[0] & 3);
    if (kind == SetupKind::kNoRay) return {};
    if (kind == SetupKind::kPlane) return {view[0], -1};
    const int weight = (head[0] >> 2) & 511;  // of the second photo, in 1/256
    return {weight < 256 ? view[2] & 0xFFFF : -1, weight > 0 ? (view[2] >> 16) & 0xFFFF : -1};
}

std::vector<int> photos_of(std::span<const SetupTexel> setups, int width) {
    std::set<int> photos;
    const auto columns = static_cast<std::size_t>(width);
    for (std::size_t row = 0; row < setups.size(); row += kSetupTexels * columns) {
        for (std::size_t n = row; n < row + columns; ++n) {
            const auto [first, second] = photos_of(setups[n], setups[n + columns]);
            photos.insert({first, second});
        }
    }
    photos.erase(-1);
    return {photos.begin(), photos.end()};
}

}  // namespace rs::compositor
