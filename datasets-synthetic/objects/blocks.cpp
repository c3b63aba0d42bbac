#include "datasets-synthetic/objects/blocks.hpp"

#include "datasets-synthetic/objects/blocks_painting.hpp"
#include "datasets-synthetic/objects/object_assembly.hpp"
#include "datasets-synthetic/shapes/frame.hpp"
#include "datasets-synthetic/shapes/grid_surface.hpp"
#include "datasets-synthetic/shapes/parameters.hpp"
#include "datasets-synthetic/shapes/random.hpp"

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace rs::synthetic {
namespace {

using glm::vec2;
using glm::vec3;

constexpr float kHalf = 0.36F;  // half a block's side
constexpr int kBlocks = 7;

// Divisions of -1..1 that follow the bevels closely and leave the flat middle whole.
std::vector<float> divisions(float bevel) {
    constexpr int kBevelSteps = 6;
    std::vector<float> at;
    for (int k = 0; k <= kBevelSteps; ++k) at.push_back(-1.0F + bevel * static_cast<float>(k) / kBevelSteps);
    for (int k = kBevelSteps; k >= 0; --k) at.push_back(1.0F - bevel * static_cast<float>(k) / kBevelSteps);
    return at;
}

// A cube of half side 1 whose edges are rounded with radius `bevel`; `tile_row` is the block's row of the atlas.
void append_block(capture::Mesh& mesh, const Frame& frame, float bevel, int tile_row) {
    const std::vector<float> at = divisions(bevel);
    const int steps = static_cast<int>(at.size()) - 1;
    const std::array<Frame, kBlockFaces> faces{
        frame_facing({}, {0, 1, 0}, {0, 0, 1}),  frame_facing({}, {0, 1, 0}, {1, 0, 0}),
        frame_facing({}, {0, 1, 0}, {0, 0, -1}), frame_facing({}, {0, 1, 0}, {-1, 0, 0}),
        frame_facing({}, {0, 0, -1}, {0, 1, 0}), frame_facing({}, {0, 0, 1}, {0, -1, 0})};
    for (int face = 0; face < kBlockFaces; ++face) {
        Grid grid(steps, steps);
        grid.normals.resize(grid.positions.size());
        for (int j = 0; j <= steps; ++j) {
            for (int i = 0; i <= steps; ++i) {
                const float x = at[static_cast<std::size_t>(i)];
                const float y = at[static_cast<std::size_t>(j)];
                const vec3 on_cube = faces[static_cast<std::size_t>(face)].direction({x, y, 1.0F});
                // A rounded cube is a smaller cube with a ball rolled over it.
                const vec3 core = glm::clamp(on_cube, vec3{bevel - 1.0F}, vec3{1.0F - bevel});
                const vec3 normal = glm::normalize(on_cube - core);
                const std::size_t k = grid.index(i, j);
                grid.positions[k] = frame.point(kHalf * (core + bevel * normal));
                grid.normals[k] = frame.direction(normal);
                grid.uvs[k] = {(static_cast<float>(face) + 0.5F + 0.496F * x) / kBlockFaces,
                               (static_cast<float>(tile_row) + 0.5F + 0.496F * y) / kBlocks};
            }
        }
        append_grid(mesh, std::move(grid));
    }
}

// Four blocks below, two on them, one on top.
std::array<Frame, kBlocks> tower(float untidiness, std::uint64_t seed) {
    Random random(seed, 91);
    constexpr float kSide = 2.0F * kHalf;
    constexpr float kApart = 1.06F * kHalf;
    constexpr std::array<vec2, kBlocks> kPlaces{
        vec2{-kApart, -kApart},      vec2{kApart, -kApart},       vec2{-kApart, kApart}, vec2{kApart, kApart},
        vec2{-0.55F * kSide, 0.04F}, vec2{0.55F * kSide, -0.05F}, vec2{0.02F, 0.03F}};
    std::array<Frame, kBlocks> frames;
    for (std::size_t k = 0; k < kPlaces.size(); ++k) {
        const int layer = k < 4 ? 0 : (k < 6 ? 1 : 2);
        const float loose = layer == 0 ? 0.35F : 1.0F;  // the lower ones stand shoulder to shoulder
        // Each layer as a whole is turned against the one below.
        const float layer_turn_rad = layer == 1 ? 0.45F : (layer == 2 ? -0.35F : 0.0F);
        const glm::mat3 layer_turn = rotation({0, 1, 0}, layer_turn_rad);
        const float turn_rad = untidiness * loose * 0.16F * random.bell();
        const vec2 slip = 0.022F * untidiness * loose * vec2{random.bell(), random.bell()};
        const vec3 place{kPlaces[k].x + slip.x, kHalf + kSide * static_cast<float>(layer), kPlaces[k].y + slip.y};
        const glm::mat3 quarter =
            rotation({0, 1, 0}, 0.5F * static_cast<float>(kPi) * static_cast<float>(random.below(4)));
        frames[k] = {layer_turn * place, layer_turn * rotation({0, 1, 0}, turn_rad) * quarter};
    }
    return frames;
}

}  // namespace

Result<capture::Scene> generate_blocks(const nlohmann::json& parameters, std::uint64_t seed) {
    Parameters in("blocks", parameters);
    const std::string text = in.letters("text", "RAYSPACE", 12);
    const float bevel = in.number("bevel", 0.09F, 0.03F, 0.25F);
    const float untidiness = in.number("untidiness", 0.6F, 0.0F, 1.0F);
    const float gloss = in.number("gloss", 0.25F, 0.05F, 0.6F);
    if (const Status read = in.finish(); !read) return read.error();

    ObjectAssembly assembly("blocks");
    const int texture = assembly.add_texture(paint_blocks(kBlocks, text, seed));
    const int varnish = assembly.add_material({.name = "varnished wood",
                                               .kind = capture::SurfaceKind::glossy,
                                               .colour = vec3{1.0F},
                                               .texture = texture,
                                               .roughness = gloss,
                                               .two_sided = false});
    const std::array<Frame, kBlocks> frames = tower(untidiness, seed);
    for (int k = 0; k < kBlocks; ++k)
        append_block(assembly.add_mesh("block " + std::to_string(k + 1), varnish), frames[static_cast<std::size_t>(k)],
                     bevel, k);
    return std::move(assembly).finish();
}

}  // namespace rs::synthetic
