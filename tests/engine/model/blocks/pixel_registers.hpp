#pragma once
// Registers and columns for unit tests of the pixel blocks of a parallel board.

#include "engine/model/blocks/parallel/column_setup.hpp"
#include "tests/engine/model/parallel_test_objects.hpp"

namespace rs::engine::model::test {

// A view of 40x30 pixels; a shape map of 7 bands.
struct PixelRegisters {
    PixelRegisters()
        : object(any_object({.views = 8, .planes = 4, .x_cells = 16, .u_cells = 16}, {})), board(parallel(1)) {
        object.rings.front().shape = rs::test::small_shape(object, 0);
        slot = *board.place(object);
        file = board.top().registers;
        file.banks[0].views = {*board.view(
            slot, *prepare_view(object, upright_at(0.4, 3.5, 0, 0.9, 40, 30), engine::TexelFilter::kBilinear))};
    }
    RaySpaceObject object;
    Board board;
    RegisterFile file;
    int slot = 0;
};

inline ScannedPixel pixel_of(int id) {
    return {id, 0, 0, id / kStripeColumns, 0};
}

inline ColumnSetup column_of(RayKind kind, int column) {
    ColumnSetup setup;
    setup.kind = kind;
    setup.column = column;
    setup.weight = 100;
    setup.lambda0_q20 = 3 << 20;
    for (ImageSetup& image : setup.images) {
        image.l0_q20 = 3 << 20;
        image.cx_q16 = 20 << 16;
        image.cy_q16 = 20 << 16;
        image.fl_y_q16 = 60 << 16;
    }
    return setup;
}

}  // namespace rs::engine::model::test
