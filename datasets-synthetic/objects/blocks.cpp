#include "datasets-synthetic/objects/generators.hpp"

#include "datasets-synthetic/objects/object_assembly.hpp"
#include "datasets-synthetic/shapes/curve.hpp"
#include "datasets-synthetic/shapes/frame.hpp"
#include "datasets-synthetic/shapes/noise.hpp"
#include "datasets-synthetic/shapes/paint.hpp"
#include "datasets-synthetic/shapes/parameters.hpp"
#include "datasets-synthetic/shapes/portable_math.hpp"
#include "datasets-synthetic/shapes/random.hpp"
#include "datasets-synthetic/shapes/surfaces.hpp"

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace rs::synthetic {
namespace {

using glm::vec2;
using glm::vec3;

constexpr int kBlockFaces = 6;
constexpr int kTile_px = 256;
constexpr float kTile = static_cast<float>(kTile_px);

vec3 toy_colour(int index) {
    constexpr std::array<std::uint32_t, 6> kColours{0xC8281E, 0x1C5FA8, 0xE0A010, 0x2C8540, 0xD8601A, 0x6A3A8C};
    return srgb(kColours[static_cast<std::size_t>(index) % kColours.size()]);
}

class BlockPainter {
public:
    BlockPainter(Canvas& canvas, std::uint64_t seed)
        : canvas_(canvas), seed_(static_cast<std::uint32_t>(seed)), random_(seed, 81) {}

    // Sawn maple: a cut through slightly wavy growth rings.
    void wood(vec2 corner_px, std::uint32_t board) {
        const auto row = board / 64U;
        const vec3 offset{static_cast<float>(board % 64U) * 3.1F, static_cast<float>(row) * 5.7F, 0.0F};
        canvas_.shade(corner_px, corner_px + kTile, [&](vec2 p, vec3) {
            const vec2 q = (p - corner_px) / kTile;
            const float warp = layered_noise(vec3{q.x * 1.2F, q.y * 2.0F, 0.3F} + offset, 3, seed_);
            const float rings = (q.x + 0.35F * warp) * 13.0F;
            const float ring = rings - std::floor(rings);
            const float fibre = layered_noise(vec3{q.x * 90.0F, q.y * 5.0F, 1.0F} + offset, 2, seed_ + 1U);
            const vec3 colour = glm::mix(srgb(0xDDB782), srgb(0xB98350), 0.65F * ring * ring + 0.35F * fibre);
            return colour * (1.0F + 0.10F * fibre);
        });
    }

    void frame(vec2 corner_px, vec3 colour) {
        constexpr float kInset = 0.105F * kTile;
        const auto at = [&](float x, float y) { return corner_px + vec2{x, y}; };
        const std::vector<vec2> square{at(kInset, kInset), at(kTile - kInset, kInset),
                                       at(kTile - kInset, kTile - kInset), at(kInset, kTile - kInset),
                                       at(kInset, kInset)};
        const float radius_px = 0.032F * kTile;
        canvas_.stroke(square, {&radius_px, 1}, {colour, 0.95F, 0.18F, 0.2F, random_.next()});
        const float inner = kInset + 0.058F * kTile;
        const std::vector<vec2> thin{at(inner, inner), at(kTile - inner, inner), at(kTile - inner, kTile - inner),
                                     at(inner, kTile - inner), at(inner, inner)};
        const float thin_px = 0.006F * kTile;
        canvas_.stroke(thin, {&thin_px, 1}, {colour, 0.9F, 0.1F, 0.0F, random_.next()});
    }

    void letter(vec2 corner_px, char which, vec3 colour) {
        const Letter letter = pen_letter(which);
        const float size_px = 0.46F * kTile;
        const vec2 origin = corner_px + vec2{0.5F * (kTile - letter.width * size_px), 0.27F * kTile};
        // A shadow line first, then the colour, then a light line along the upper left.
        const std::array<std::pair<vec2, float>, 3> passes{
            {{{3.0F, -3.0F}, 0.066F}, {{0.0F, 0.0F}, 0.062F}, {{-2.5F, 3.0F}, 0.012F}}};
        const std::array<Ink, 3> inks{Ink{srgb(0x2A1C12), 0.9F, 0.1F, 0.0F, random_.next()},
                                      Ink{colour, 0.98F, 0.12F, 0.1F, random_.next()},
                                      Ink{srgb(0xFFF4DC), 0.75F, 0.3F, 0.0F, random_.next()}};
        for (std::size_t pass = 0; pass < passes.size(); ++pass) {
            const float radius_px = passes[pass].second * kTile;
            for (const std::vector<vec2>& stroke : letter.strokes) {
                std::vector<vec2> path;
                path.reserve(stroke.size());
                for (const vec2& p : stroke) path.push_back(origin + passes[pass].first + p * size_px);
                canvas_.stroke(path, {&radius_px, 1}, inks[pass]);
            }
        }
    }

    // Star, heart, sun, fish-scale ring or checkers.
    void image(vec2 corner_px, int which, vec3 colour) {
        const vec2 centre = corner_px + 0.5F * kTile;
        const Ink ink{colour, 0.96F, 0.18F, 0.2F, random_.next()};
        switch (which % 5) {
            case 0:
                return canvas_.fill(star(centre, 5, 0.30F * kTile, 0.13F * kTile), ink);
            case 1:
                return canvas_.fill(heart(centre, 0.27F * kTile), ink);
            case 2: {
                canvas_.fill(star(centre, 14, 0.31F * kTile, 0.20F * kTile), ink);
                const float radius_px = 0.15F * kTile;
                return canvas_.stroke({&centre, 1}, {&radius_px, 1},
                                      {srgb(0xF3D27A), 1.0F, 0.1F, 0.1F, random_.next()});
            }
            case 3: {
                for (int ring = 3; ring >= 1; --ring) {
                    const float radius_px = 0.09F * kTile * static_cast<float>(ring);
                    canvas_.stroke({&centre, 1}, {&radius_px, 1},
                                   {ring == 2 ? srgb(0xF0E2C4) : colour, 0.98F, 0.12F, 0.1F, random_.next()});
                }
                return;
            }
            default:
                return checkers(corner_px, ink);
        }
    }

private:
    static std::vector<vec2> star(vec2 centre, int points, float outer_px, float inner_px) {
        std::vector<vec2> outline;
        for (int k = 0; k < 2 * points; ++k) {
            const float angle_rad =
                0.25F * portable::kTwoPiF + portable::kTwoPiF * static_cast<float>(k) / static_cast<float>(2 * points);
            const float radius_px = k % 2 == 0 ? outer_px : inner_px;
            outline.push_back(centre + radius_px * vec2{portable::cos(angle_rad), portable::sin(angle_rad)});
        }
        return outline;
    }

    static std::vector<vec2> heart(vec2 centre, float size_px) {
        std::vector<vec2> outline;
        constexpr int kPoints = 60;
        for (int k = 0; k < kPoints; ++k) {
            const float a = portable::kTwoPiF * static_cast<float>(k) / kPoints;
            const float s = portable::sin(a);
            const vec2 p{s * s * s, (13.0F * portable::cos(a) - 5.0F * portable::cos(2.0F * a) -
                                     2.0F * portable::cos(3.0F * a) - portable::cos(4.0F * a)) /
                                        16.0F};
            outline.push_back(centre + size_px * p);
        }
        return outline;
    }

    void checkers(vec2 corner_px, const Ink& ink) {
        constexpr int kFields = 4;
        const float field_px = 0.60F * kTile / kFields;
        for (int k = 0; k < kFields * kFields; ++k) {
            const int row = k / kFields;
            if ((k + row) % 2 != 0) continue;
            const vec2 low =
                corner_px + 0.20F * kTile + field_px * vec2{static_cast<float>(k % kFields), static_cast<float>(row)};
            const std::array<vec2, 4> square{low, low + vec2{field_px, 0}, low + field_px, low + vec2{0, field_px}};
            canvas_.fill(square, ink);
        }
    }

    Canvas& canvas_;
    std::uint32_t seed_;
    Random random_;
};

// An atlas of square tiles, kBlockFaces to a row of tiles and one row per block: tile (f, b) covers u in [f, f+1] /
// kBlockFaces and v in [b, b+1] / blocks. Faces 0 to 3 are the sides, counter-clockwise seen from above; 4 is the top,
// 5 the underside. The letters of `text` are repeated around the blocks' sides.
capture::Texture paint_blocks(int blocks, const std::string& text, std::uint64_t seed) {
    Canvas canvas(kTile_px * kBlockFaces, kTile_px * blocks, vec3{0.0F});
    BlockPainter painter(canvas, seed);
    for (int block = 0; block < blocks; ++block) {
        for (int face = 0; face < kBlockFaces; ++face) {
            const vec2 corner_px{kTile * static_cast<float>(face), kTile * static_cast<float>(block)};
            painter.wood(corner_px, static_cast<std::uint32_t>(block * kBlockFaces + face));
            painter.frame(corner_px, toy_colour(block + face));
            const vec3 colour = toy_colour(block + face + 1 + face / 2);
            // Letters on three sides, an image on the fourth and at the ends; neighbours differ.
            if (face < 3)
                painter.letter(corner_px, text[static_cast<std::size_t>(block + face * 3) % text.size()], colour);
            else
                painter.image(corner_px, block + 2 * face, colour);
        }
    }
    return std::move(canvas).texture("block faces");
}

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
        const float loose = layer == 0 ? 0.35F : 1.0F;  // the lower blocks are close together
        // Rotates each layer as a whole against the one below.
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
    RS_TRY(in.finish());

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
