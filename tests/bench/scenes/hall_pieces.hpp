#pragma once
// What stands in the halls: each piece is a group of its own whose foot is at the origin.

#include "tests/bench/scenes/model.hpp"

namespace rs::synthetic {

// Of Model::looks.
struct HallLooks {
    int plaster = 0, marble = 1, dark_marble = 2, stone = 3, oak = 4, leather = 5, brass = 6, candle = 7, leaf = 8,
        clay = 9, iron = 10, carpet = 11;
};
std::vector<ModelLook> hall_looks();
// marble.png and dark.png, which the looks name.
std::map<std::string, Image<Rgba8>> hall_images();

inline constexpr float kColumnHeight_m = 5.0F;

// Of `flutes` flutes, each of six columns of fields.
ModelGroup fluted_column(int flutes, int rows);
// 1 m high, for steps and galleries.
ModelGroup baluster();
ModelGroup hall_table();
ModelGroup hall_chair();
ModelGroup hall_bench();
// Hangs from the origin, its ring 2 m below.
ModelGroup chandelier();
// A pot with so many triangles of leaves (0, or at least 6).
ModelGroup plant(std::int64_t leaf_triangles, std::uint64_t seed);

}  // namespace rs::synthetic
