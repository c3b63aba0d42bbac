#pragma once
// Objects and configurations for the tests of the parallel board.

#include "rayspace/geometry/rig.hpp"
#include "tests/engine/model/coded_test_objects.hpp"
#include "tests/support/random_shape.hpp"

#include <numeric>

namespace rs::engine::model::test {

inline BoardConfig parallel(int pipes = 8) {
    Result<BoardConfig> config = read_board_config("parallel");
    EXPECT_TRUE(config.ok());
    config->pipes = pipes;
    return *config;
}

inline const std::vector<std::unique_ptr<ParallelPipe>>& pipes(Board& board) {
    return dynamic_cast<ParallelBoard&>(*board.top().body).pipes;
}

// Shuffles the views, so that their order differs from that of the ring.
inline void shuffle_views(RaySpaceObject& object, std::mt19937_64& random) {
    std::vector<std::size_t> from(object.views.size());
    std::iota(from.begin(), from.end(), std::size_t{0});
    std::shuffle(from.begin(), from.end(), random);
    std::vector<std::uint16_t> to(from.size());
    for (std::size_t n = 0; n < from.size(); ++n) to[from[n]] = static_cast<std::uint16_t>(n);
    const Rig rig = rig_from_json(object.rig_json, "ring").value();
    Rig shuffled = rig;
    const RaySpaceObject was = object;
    for (std::size_t n = 0; n < from.size(); ++n) {
        shuffled.views[n] = rig.views[from[n]];
        object.views[n] = was.views[from[n]];
        object.images[n] = was.images[from[n]];
    }
    object.rig_json = rig_to_json(shuffled);
    Ring& ring = object.rings.front();
    for (std::uint16_t& view : ring.views) view = to[view];
    for (std::uint16_t& cell : ring.cells) {
        if (cell != kNoImage) cell = to[cell];
    }
}

struct AnyObject {
    bool coded = false;
    bool shape = false;
};
inline RaySpaceObject any_object(const rs::test::RingObjectOptions& options, const AnyObject& kind,
                                 bool shuffled = false) {
    RaySpaceObject object = rs::test::ring_object(options);
    std::mt19937_64 random(options.seed);
    if (shuffled) shuffle_views(object, random);
    if (kind.shape) {
        const double empty = std::uniform_real_distribution<double>(0, 0.7)(random);
        object.rings.front().shape = rs::test::random_shape(object, 0, random, empty);
    }
    if (!kind.coded) return object;
    codec::CodedImages coded = random_images(object, random);
    return with_coded(std::move(object), std::move(coded));
}

}  // namespace rs::engine::model::test
