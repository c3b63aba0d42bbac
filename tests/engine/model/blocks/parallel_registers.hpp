#pragma once
// Register files of a parallel board's views for the timing tests of its blocks.

#include "tests/engine/model/parallel_test_objects.hpp"

#include <vector>

namespace rs::engine::model::test {

// Views 0 and 1 show a coded object, 2 a raw one, 3 another coded one.
struct ViewsOfThreeObjects {
    ViewsOfThreeObjects() : board(test::parallel(1)) {
        for (std::uint64_t n = 0; n < 3; ++n) {
            const RaySpaceObject object = test::any_object(
                {.views = 6, .width = 80, .height = 70, .planes = 4, .x_cells = 16, .u_cells = 16, .seed = 3 + n},
                {.coded = n != 1});
            slots[n] = *board.place(object);
            views.push_back(*board.view(slots[n], *prepare_view(object, test::upright_at(0.4, 3.5, 0, 0.9, 40, 20),
                                                                engine::TexelFilter::kBilinear)));
        }
        file = board.top().registers;
        file.banks[0].views = {views[0], views[0], views[1], views[2]};
    }
    Board board;
    int slots[3] = {};
    std::vector<BoardView> views;
    RegisterFile file;
};

}  // namespace rs::engine::model::test
