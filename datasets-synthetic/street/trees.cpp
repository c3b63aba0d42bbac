#include "datasets-synthetic/street/street_models.hpp"

#include "datasets-synthetic/shapes/curve.hpp"
#include "datasets-synthetic/shapes/noise.hpp"
#include "datasets-synthetic/shapes/random.hpp"
#include "datasets-synthetic/shapes/surfaces.hpp"
#include "rayspace/image/linear_light.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace rs::synthetic {
namespace {

using glm::vec2;
using glm::vec3;

constexpr int kFoliage_px = 256;
constexpr int kLevels = 3;  // trunk, limbs, branches

// Paints one pointed leaf from `stalk` along `direction` (px), opaque, with a pale midrib.
void paint_leaf(Image<Rgba8>& image, vec2 stalk, vec2 direction, vec3 colour) {
    const float length = glm::length(direction);
    const vec2 along = direction / length;
    const vec2 low = glm::min(stalk, stalk + direction) - length * 0.3F;
    const vec2 high = glm::max(stalk, stalk + direction) + length * 0.3F;
    for (int y = std::max(static_cast<int>(low.y), 0); y < std::min(static_cast<int>(high.y), image.height()); ++y) {
        for (int x = std::max(static_cast<int>(low.x), 0); x < std::min(static_cast<int>(high.x), image.width()); ++x) {
            const vec2 p = vec2{static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F} - stalk;
            const float u = glm::dot(p, along) / length;
            const float v = (p.y * along.x - p.x * along.y) / length;
            if (u < 0 || u > 1 || std::abs(v) > 1.1F * u * (1 - u)) continue;
            const float rib = std::abs(v) < 0.022F ? 1.35F : 1.0F;
            const vec3 tone = colour * rib * (v > 0 ? 1.12F : 0.9F) * (0.8F + 0.35F * u);
            image(x, y) = {srgb8_from_linear(tone.x), srgb8_from_linear(tone.y), srgb8_from_linear(tone.z), 255};
        }
    }
}

// Twigs with leaves on a transparent ground, for leaf cards. Texture transparency is a mask.
Image<Rgba8> foliage_image(std::uint32_t seed, float scale) {
    const int side = std::max(static_cast<int>(kFoliage_px * scale), 32);
    const auto px = static_cast<float>(side);
    Image<Rgba8> image(side, side, Rgba8{58, 82, 34, 0});
    Random random(seed, 9);
    for (int i = 0; i < 120; ++i) {
        const float angle = random.uniform(0, portable::kTwoPiF);
        const float radius = px * 0.40F * std::sqrt(random.uniform());
        const vec2 out{portable::cos(angle), portable::sin(angle)};
        const float turn = angle + random.uniform(-1.2F, 1.2F);
        const float length = px * random.uniform(0.10F, 0.15F);
        const float bright = random.uniform(0.65F, 1.7F) * (0.6F + 0.01F * static_cast<float>(i) * 0.5F);
        const float yellow = random.uniform(0, 1);
        const vec3 colour = bright * glm::mix(vec3(0.045F, 0.105F, 0.018F), vec3(0.13F, 0.18F, 0.03F), yellow);
        paint_leaf(image, px * 0.5F + radius * out, length * vec2{portable::cos(turn), portable::sin(turn)}, colour);
    }
    return image;
}

struct TreeShape {
    float trunk_m = 2.6F;
    float trunk_radius_m = 0.15F;
    float limb_m = 2.0F;
    float spread = 0.85F;  // of limbs: tangent of the angle from the trunk
    int limbs = 6;
    int branches = 5;  // of each limb
    int cards = 5;     // of each branch
    float card_m = 1.15F;
    float lowest_m = 2.9F;   // of the cards' centres
    float crown_y_m = 4.5F;  // centre of the crown, for the leaves' normals
};

// Grows a tree into one mesh of wood and one of leaves.
class Tree {
public:
    Tree(const TreeShape& shape, std::uint32_t seed) : shape_(shape), random_(seed, 5) {}

    void grow(capture::Mesh& wood) {
        branch(wood, {0, -0.15F, 0}, {0, 1, 0}, shape_.trunk_m + 0.15F, shape_.trunk_radius_m, 0);
    }
    void leaves(capture::Mesh& mesh) {
        for (const vec3& tip : tips_) {
            for (int i = 0; i < shape_.cards; ++i) {
                vec3 middle = tip + 0.55F * random_.direction() * shape_.card_m;
                middle.y = std::max(middle.y, shape_.lowest_m);
                card(mesh, middle);
            }
        }
    }

private:
    void branch(capture::Mesh& wood, vec3 foot, vec3 direction, float length, float radius, int level) {
        const bool last = level + 1 == kLevels;
        const std::size_t steps = last ? 2 : 4;
        std::vector<vec3> path{foot};
        std::vector<float> radii{level == 0 ? radius * 1.5F : radius};
        vec3 way = direction;
        for (std::size_t i = 1; i <= steps; ++i) {
            way = glm::normalize(way + (level == 0 ? 0.06F : 0.2F) * random_.direction() + vec3(0, 0.08F, 0));
            path.push_back(path.back() + way * (length / static_cast<float>(steps)));
            radii.push_back(radius * (1 - (last ? 0.4F : 0.14F) * static_cast<float>(i)));
        }
        SweepStyle style;
        style.sides = level == 0 ? 8 : last ? 3 : 5;
        style.v_per_length = 0.5F;
        style.rounded_ends = false;
        append_tube(wood, path, radii, style);
        if (last) {
            tips_.push_back(path.back());
            return;
        }
        const int count = level == 0 ? shape_.limbs : shape_.branches;
        float turn = random_.uniform(0, portable::kTwoPiF);
        for (int i = 0; i < count; ++i) {
            turn += 2.4F + random_.uniform(-0.3F, 0.3F);  // about the golden angle
            const float share = level == 0 ? 0.72F + 0.28F * static_cast<float>(i) / static_cast<float>(count)
                                           : 0.35F + 0.65F * static_cast<float>(i) / static_cast<float>(count - 1);
            const auto at = std::min(static_cast<std::size_t>(share * 4), std::size_t{3});
            const vec3 from = glm::mix(path.at(at), path.at(at + 1), share * 4 - static_cast<float>(at));
            const vec3 along = glm::normalize(path.at(at + 1) - path.at(at));
            const vec3 side = any_perpendicular(along);
            const vec3 out = side * portable::cos(turn) + glm::cross(along, side) * portable::sin(turn);
            const float lean = (level == 0 ? shape_.spread : 0.9F) * random_.uniform(0.7F, 1.2F);
            const float size = (level == 0 ? shape_.limb_m : length * 0.52F) * random_.uniform(0.8F, 1.15F);
            branch(wood, from, glm::normalize(along + lean * out), size, radii.at(at) * 0.52F, level + 1);
        }
    }

    // A square of leaves that faces outwards, lit like a part of the whole crown.
    void card(capture::Mesh& mesh, vec3 middle) {
        const vec3 crown = glm::normalize(middle - vec3(0, shape_.crown_y_m, 0) + vec3(0, 0.01F, 0));
        const vec3 facing = glm::normalize(crown + 0.75F * random_.direction());
        const Frame frame = frame_facing(middle, any_perpendicular(facing), facing);
        const float turn = random_.uniform(0, portable::kTwoPiF);
        const float half = 0.5F * shape_.card_m * random_.uniform(0.75F, 1.2F);
        const auto first = static_cast<unsigned>(mesh.positions.size());
        for (int k = 0; k < 4; ++k) {
            const float angle = turn + portable::kTwoPiF * (static_cast<float>(k) + 0.5F) / 4;
            const vec2 corner{portable::cos(angle), portable::sin(angle)};
            const vec3 p = frame.point(vec3{corner * half * 1.414F, 0});
            mesh.positions.push_back(p);
            mesh.normals.push_back(glm::normalize(crown + 0.35F * facing + vec3(0, 0.25F, 0)));
            mesh.uvs.emplace_back(k == 0 || k == 3 ? 1.0F : 0.0F, k < 2 ? 1.0F : 0.0F);
        }
        mesh.triangles.emplace_back(first, first + 1, first + 2);
        mesh.triangles.emplace_back(first, first + 2, first + 3);
    }

    const TreeShape& shape_;
    Random random_;
    std::vector<vec3> tips_;
};

void build_tree(World& world, const std::string& object, const std::string& foliage, const TreeShape& shape,
                std::uint32_t seed) {
    Pen pen(world, object);
    Tree tree(shape, seed);
    pen.surface("bark", [&](capture::Mesh& mesh) { tree.grow(mesh); });
    if (object != "bush") {
        pen.quad(
            "soil",
            {vec3{-0.55F, 0.008F, 0.55F}, {0.55F, 0.008F, 0.55F}, {0.55F, 0.008F, -0.55F}, {-0.55F, 0.008F, -0.55F}});
    }
    pen.surface(foliage, [&](capture::Mesh& mesh) { tree.leaves(mesh); });
}

}  // namespace

void add_tree_looks(World& world, RoomBuilder& builder, float texture_scale) {
    for (int kind = 0; kind < 2; ++kind) {
        const std::string name = "foliage_" + std::to_string(kind);
        world.textures[name + ".png"] = foliage_image(static_cast<std::uint32_t>(40 + kind), texture_scale);
        world.looks[name] = {.texture = name + ".png"};
    }
    builder.painted_look("bark", {1, 2}, 96, [](vec2 p) {
        const float ridges = layered_noise({p.x * 16, p.y * 3, 0.2F}, 4, 33, 16);
        return vec3(0.13F, 0.1F, 0.075F) * (1 + 1.3F * ridges);
    });
}

void build_trees(World& world) {
    build_tree(world, "tree_0", "foliage_0", {}, 3);
    build_tree(world, "tree_1", "foliage_1",
               {.trunk_m = 2.3F, .limb_m = 1.8F, .spread = 1.15F, .limbs = 7, .branches = 4, .crown_y_m = 3.9F}, 8);
    build_tree(world, "tree_2", "foliage_0",
               {.trunk_m = 2.9F, .limb_m = 2.3F, .spread = 0.55F, .limbs = 6, .branches = 5, .crown_y_m = 5.2F}, 14);
    build_tree(world, "bush", "foliage_1",
               {.trunk_m = 0.5F,
                .trunk_radius_m = 0.1F,
                .limb_m = 1.6F,
                .spread = 1.5F,
                .limbs = 5,
                .branches = 2,
                .cards = 7,
                .card_m = 1.5F,
                .lowest_m = 0.6F,
                .crown_y_m = 0.9F},
               21);
}

}  // namespace rs::synthetic
