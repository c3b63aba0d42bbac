#pragma once
// Furniture of the halls. Each piece is a separate group with its foot at the origin.

#include "tests/bench/scenes/model.hpp"

namespace rs::synthetic {

/// Indices into Model::materials.
struct HallMaterials {
    int plaster = 0, marble = 1, dark_marble = 2, stone = 3, oak = 4, leather = 5, brass = 6, candle = 7, leaf = 8,
        clay = 9, iron = 10, carpet = 11;
};
std::vector<ModelMaterial> hall_materials();
/// marble.png and dark.png, referenced by the materials.
std::map<std::string, Image<Rgba8>> hall_images();

inline constexpr float kColumnHeight_m = 5.0F;

/// \param flutes number of flutes, each of six columns of cells
ModelGroup fluted_column(int flutes, int rows);
/// 1 m high, for stairs and galleries.
ModelGroup baluster();
ModelGroup hall_table();
ModelGroup hall_chair();
ModelGroup hall_bench();
/// Hangs from the origin; its ring is 2 m below.
ModelGroup chandelier();
/// Potted plant.
/// \param leaf_triangles 0, or at least 6
ModelGroup plant(std::int64_t leaf_triangles, std::uint64_t seed);

}  // namespace rs::synthetic
