#include "datasets-synthetic/objects/generators.hpp"

#include "datasets-synthetic/objects/object_assembly.hpp"
#include "datasets-synthetic/objects/petal.hpp"
#include "datasets-synthetic/shapes/curve.hpp"
#include "datasets-synthetic/shapes/noise.hpp"
#include "datasets-synthetic/shapes/paint.hpp"
#include "datasets-synthetic/shapes/parameters.hpp"
#include "datasets-synthetic/shapes/surfaces.hpp"

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace rs::synthetic {
namespace {

using capture::Mesh;
using glm::vec2;
using glm::vec3;

constexpr int kSide_px = 256;

// Textures. u runs across a petal or leaf, v from base to tip.

// Dark throat, fine veins that fan out, a pale edge. `hue_turns` as in hue_colour.
capture::Texture paint_petal(float hue_turns, std::uint32_t seed) {
    Canvas canvas(kSide_px, kSide_px, vec3{0.0F});
    const vec3 throat = hue_colour(hue_turns + 0.02F, 0.92F, 0.50F);
    const vec3 middle = hue_colour(hue_turns, 0.72F, 0.93F);
    const vec3 edge = hue_colour(hue_turns - 0.015F, 0.38F, 0.98F);
    canvas.shade({0, 0}, vec2{kSide_px}, [&](vec2 p, vec3) {
        const float across = 2.0F * p.x / kSide_px - 1.0F;
        const float along = p.y / kSide_px;
        const float fibre = layered_noise({across * 14.0F, along * 1.6F, 0.0F}, 3, seed);
        const float cloud = layered_noise({across * 2.0F, along * 3.0F, 7.0F}, 3, seed + 9U);
        vec3 colour = glm::mix(throat, middle, smooth_step(0.02F, 0.55F, along + 0.18F * fibre));
        colour = glm::mix(colour, edge, smooth_step(0.45F, 1.1F, along + 0.3F * std::abs(across) + 0.25F * cloud));
        const float vein = smooth_step(0.12F, 0.34F, fibre) * (1.0F - 0.75F * along);
        return glm::mix(colour, throat, 0.55F * vein);
    });
    return std::move(canvas).texture("petal");
}

// Midrib, side veins, mottled green.
capture::Texture paint_leaf(std::uint32_t seed) {
    Canvas canvas(kSide_px, kSide_px, vec3{0.0F});
    canvas.shade({0, 0}, vec2{kSide_px}, [&](vec2 p, vec3) {
        const float across = std::abs(2.0F * p.x / kSide_px - 1.0F);
        const float along = p.y / kSide_px;
        const float cloud = layered_noise({p.x / 40.0F, p.y / 40.0F, 3.0F}, 4, seed);
        vec3 colour = glm::mix(srgb(0x2C5B22), srgb(0x5E8F35), 0.45F + 0.6F * cloud);
        colour = glm::mix(colour, srgb(0x8AA845), 0.35F * smooth_step(0.75F, 1.0F, across));
        // Side veins leave the midrib at 45 degrees.
        const float side = (along - 0.42F * across) * 9.0F;
        const float off = std::abs(side - std::floor(side) - 0.5F);
        const float vein = smooth_step(0.38F, 0.5F, off) * (1.0F - across);
        const float midrib = 1.0F - smooth_step(0.02F, 0.075F, across);
        return glm::mix(colour, srgb(0xA3BC66), std::fmax(0.6F * vein, 0.85F * midrib));
    });
    return std::move(canvas).texture("leaf");
}

// Fired clay with lime blooming through, turned in fine grooves. Wraps around along u.
capture::Texture paint_terracotta(std::uint32_t seed) {
    constexpr int kAround_px = 1024;
    constexpr int kUp_px = 384;
    Canvas canvas(kAround_px, kUp_px, vec3{0.0F});
    canvas.shade({0, 0}, {kAround_px, kUp_px}, [&](vec2 p, vec3) {
        const float turn = p.x / kAround_px;
        const float cloud = layered_noise({turn * 8.0F, p.y / 90.0F, 0.0F}, 5, seed, 8);
        const float groove = layered_noise({turn * 6.0F, p.y / 2.5F, 5.0F}, 2, seed + 3U, 6);
        const float speck = gradient_noise({turn * 220.0F, p.y / 4.6F, 1.0F}, seed + 5U, 220);
        vec3 colour = glm::mix(srgb(0x9A4A2B), srgb(0xC9744A), 0.5F + 0.8F * cloud);
        colour *= 1.0F + 0.16F * groove;
        const float lime =
            smooth_step(0.12F, 0.42F, layered_noise({turn * 10.0F, p.y / 70.0F, 20.0F}, 5, seed + 7U, 10));
        colour = glm::mix(colour, srgb(0xD9C2AC), 0.55F * lime);
        return glm::mix(colour, srgb(0x5A2A1A), 0.6F * smooth_step(0.45F, 0.7F, speck));
    });
    return std::move(canvas).texture("terracotta");
}

constexpr float kGoldenAngle_rad = 2.3999632F;
constexpr float kSoilHeight = 0.53F;
constexpr int kPetalColours = 4;

struct FlowerParameters {
    int blooms, petals, leaves;
    float spread, hue;
};

class FlowerBuilder {
public:
    FlowerBuilder(const FlowerParameters& parameters, std::uint64_t seed) : parameters_(parameters), seed_(seed) {}

    capture::Scene build() {
        pot();
        stems_and_blooms();
        ground_leaves();
        ObjectAssembly assembly("flower");
        const auto texture_seed = static_cast<std::uint32_t>(seed_ * 77U);
        add(assembly, pot_, {.name = "terracotta", .two_sided = false}, paint_terracotta(texture_seed));
        add(assembly, soil_, {.name = "soil", .colour = srgb(0x3A291E)});
        add(assembly, pebbles_, {.name = "pebbles", .colour = srgb(0x8D8071)});
        add(assembly, stems_, {.name = "stems", .colour = srgb(0x55803A)});
        add(assembly, leaves_, {.name = "leaves", .translucency = 0.22F}, paint_leaf(texture_seed + 50U));
        add(assembly, pollen_, {.name = "florets", .colour = srgb(0xF0B429)});
        add(assembly, hearts_, {.name = "hearts", .colour = srgb(0x7A4A16)});
        constexpr std::array<float, kPetalColours> kHueShifts{0.0F, 0.055F, -0.06F, 0.11F};
        for (int k = 0; k < kPetalColours; ++k) {
            const auto index = static_cast<std::size_t>(k);
            add(assembly, petals_[index], {.name = "petals " + std::to_string(k + 1), .translucency = 0.38F},
                paint_petal(parameters_.hue + kHueShifts[index], texture_seed + static_cast<std::uint32_t>(k)));
        }
        return std::move(assembly).finish();
    }

private:
    static void add(ObjectAssembly& assembly, Mesh& mesh, capture::Material material, capture::Texture texture = {}) {
        if (!texture.pixels.empty()) {
            material.texture = assembly.add_texture(std::move(texture));
            material.colour = vec3{1.0F};
        }
        const std::string name = material.name;
        Mesh& target = assembly.add_mesh(name, assembly.add_material(std::move(material)));
        const int index = target.material;
        target = std::move(mesh);
        target.name = name;
        target.material = index;
    }

    void pot() {
        const std::vector<vec2> profile{{0.0F, 0.0F},    {0.25F, 0.0F},   {0.275F, 0.02F}, {0.355F, 0.44F},
                                        {0.40F, 0.445F}, {0.415F, 0.46F}, {0.435F, 0.59F}, {0.43F, 0.61F},
                                        {0.41F, 0.615F}, {0.39F, 0.605F}, {0.375F, 0.45F}};
        append_lathe(pot_, profile, {.segments = 128, .crease_rad = 0.9F});

        Random random(seed_, 21);
        constexpr int kColumns = 96;
        constexpr int kRows = 20;
        Grid soil(kColumns, kRows, true);
        for (int j = 0; j <= kRows; ++j) {
            const float radius = 0.39F * (1.0F - static_cast<float>(j) / kRows);
            for (int i = 0; i <= kColumns; ++i) {
                vec3 p = portable::around(2.0F * portable::kPiF * static_cast<float>(i) / kColumns, radius, 0.0F);
                p.y = kSoilHeight + 0.02F * (1.0F - radius / 0.39F) +
                      0.05F * layered_noise(p * 9.0F + vec3{0.0F, 4.5F, 0.0F}, 4, static_cast<std::uint32_t>(seed_));
                soil.positions[soil.index(i, j)] = p;
            }
        }
        for (int i = 0; i <= kColumns; ++i) soil.positions[soil.index(i, kRows)] = soil.positions[soil.index(0, kRows)];
        append_grid(soil_, std::move(soil));
        for (int k = 0; k < 70; ++k) {
            // One draw per statement: the evaluation order of arguments is unspecified.
            const float angle_rad = random.uniform(0.0F, 2.0F * portable::kPiF);
            const float reach = 0.36F * std::sqrt(random.uniform());
            const vec3 centre = portable::around(angle_rad, reach, kSoilHeight + 0.018F);
            const float size = random.uniform(0.006F, 0.02F);
            const vec3 radii{size * random.uniform(0.8F, 1.4F), size * 0.7F, size};
            const vec3 up = random.direction();
            append_ellipsoid(pebbles_, {frame_facing(centre, up, random.direction()), radii}, 10, 6);
        }
    }

    void stems_and_blooms() {
        for (int k = 0; k < parameters_.blooms; ++k) {
            Random random(seed_, 100U + static_cast<std::uint64_t>(k));
            // Sunflower arrangement of the tips, which minimises occlusion between blooms.
            const float share =
                parameters_.blooms == 1
                    ? 0.0F
                    : std::sqrt((static_cast<float>(k) + 0.15F) / static_cast<float>(parameters_.blooms));
            const float angle_rad = kGoldenAngle_rad * static_cast<float>(k) + 0.2F * random.bell();
            const float reach = parameters_.spread * 1.15F * share;
            const float height = 1.98F - 0.78F * share * share + 0.07F * random.bell();
            const vec3 tip = portable::around(angle_rad, reach, height);
            const vec3 root = portable::around(angle_rad, 0.05F + 0.12F * share, kSoilHeight - 0.02F);
            vec3 knee = glm::mix(root, tip, 0.55F) + 0.04F * random.direction();
            knee.y += 0.10F * share;
            const vec3 facing =
                glm::normalize(portable::around(angle_rad + 0.3F * random.bell(), 0.35F + 0.75F * share, 0.75F));
            const std::vector<vec3> controls{root, glm::mix(root, knee, 0.5F) + vec3{0.0F, 0.05F, 0.0F}, knee,
                                             tip - facing * 0.10F, tip};
            const std::vector<vec3> path = smooth_curve<vec3>(controls, 9);
            std::vector<float> radii;
            for (std::size_t i = 0; i < path.size(); ++i)
                radii.push_back(0.021F - 0.008F * static_cast<float>(i) / static_cast<float>(path.size()));
            append_tube(stems_, path, radii, {.sides = 10});
            if (k % 4 == 3) bud(path, random);
            stem_leaves(path, k, random);
            bloom(frame_facing(tip, facing, random.direction()), k, random);
        }
    }

    // A flower that faces along the frame's Y axis.
    void bloom(const Frame& frame, int number, Random& random) {
        const float size = random.uniform(0.27F, 0.33F);
        Mesh& petals = petals_[static_cast<std::size_t>(number % kPetalColours)];
        const auto ring = [&](int count, float length, float lift_rad, float curl_rad, float height, Mesh& mesh,
                              float width_share) {
            for (int k = 0; k < count; ++k) {
                const float turn = (static_cast<float>(k) + 0.12F * random.bell()) / static_cast<float>(count);
                const vec3 outwards = frame.direction(portable::around(2.0F * portable::kPiF * turn, 1.0F, 0.0F));
                const vec3 axis = frame.axes[1];
                const float lift = lift_rad + 0.10F * random.bell();
                const vec3 along = outwards * portable::cos(lift) + axis * portable::sin(lift);
                PetalShape shape;
                shape.length = length * random.uniform(0.92F, 1.08F);
                shape.width = width_share * 2.0F * portable::kPiF * length / static_cast<float>(count);
                shape.base_width = 0.32F;
                shape.widest_at = 0.66F;
                shape.pointedness = 0.25F;
                shape.curl_rad = curl_rad + 0.12F * random.bell();
                shape.cup = 0.20F + 0.08F * random.bell();
                shape.ripple = 0.14F;
                shape.ripple_waves = random.uniform(1.5F, 2.6F);
                shape.ripple_phase_rad = random.uniform(0.0F, 2.0F * portable::kPiF);
                // Every other petal is a little higher, so that neighbours overlap without intersecting.
                const float level = height + (k % 2 == 0 ? 0.0F : 0.012F);
                append_petal(mesh, frame_facing(frame.origin + axis * level + outwards * 0.05F, along, axis), shape);
            }
        };
        ring(parameters_.petals, size, 0.16F, 0.50F, 0.0F, petals, 1.15F);
        ring(std::max(5, parameters_.petals * 2 / 3), 0.72F * size, 0.55F, 0.62F, 0.020F, petals, 0.95F);
        ring(6, 0.42F * size, -0.15F, -0.5F, -0.02F, leaves_, 0.6F);  // sepals

        const float heart = 0.27F * size;
        append_ellipsoid(hearts_, {{frame.origin + frame.axes[1] * 0.01F, frame.axes}, {heart, 0.55F * heart, heart}},
                         24, 12);
        constexpr int kFlorets = 120;
        for (int k = 0; k < kFlorets; ++k) {
            const float share = std::sqrt((static_cast<float>(k) + 0.5F) / kFlorets);
            const vec3 on_dome = portable::around(kGoldenAngle_rad * static_cast<float>(k), share,
                                                  std::sqrt(1.0F - 0.92F * share * share));
            const vec3 p = frame.point(vec3{0.0F, 0.01F, 0.0F} + on_dome * vec3{heart, 0.6F * heart, heart});
            const vec3 out = glm::normalize(frame.direction(on_dome * vec3{1.0F, 1.8F, 1.0F}));
            const float r = 0.0075F * random.uniform(0.8F, 1.2F);
            append_ellipsoid(k % 4 == 0 && share > 0.5F ? hearts_ : pollen_,
                             {frame_facing(p, out, vec3{1, 0, 0}), {r, 2.4F * r, r}}, 8, 5);
        }
    }

    // A side shoot with a closed flower.
    void bud(const std::vector<vec3>& stem, Random& random) {
        const vec3 from = stem[stem.size() * 6 / 10];
        vec3 out = random.direction();
        out.y = 0.9F;
        out = glm::normalize(out);
        const vec3 to = from + 0.24F * out;
        const std::vector<vec3> controls{from, glm::mix(from, to, 0.5F) + vec3{0.0F, -0.02F, 0.0F}, to};
        const float radius = 0.010F;
        append_tube(stems_, smooth_curve<vec3>(controls, 6), {&radius, 1}, {.sides = 8});
        const Frame frame = frame_facing(to, out, random.direction());
        for (int k = 0; k < 6; ++k) {
            const vec3 side =
                frame.direction(portable::around(portable::kPiF / 3.0F * static_cast<float>(k), 1.0F, 0.0F));
            const Frame base = frame_facing(to + side * 0.012F, out + 0.35F * side, -side);
            PetalShape petal{
                .length = 0.13F, .width = 0.075F, .base_width = 0.4F, .widest_at = 0.45F, .pointedness = 0.5F};
            petal.curl_rad = -0.75F;
            petal.cup = 0.6F;
            append_petal(petals_[0], base, petal);
            petal.length = 0.075F;
            petal.pointedness = 1.0F;
            append_petal(leaves_, frame_facing(to + side * 0.020F, out + 0.6F * side, -side), petal);
        }
    }

    void stem_leaves(const std::vector<vec3>& stem, int number, Random& random) {
        const int count = parameters_.leaves * 2 / 3 / std::max(1, parameters_.blooms);
        for (int k = 0; k < count; ++k) {
            const float t = 0.22F + 0.55F * (static_cast<float>(k) + random.uniform()) / static_cast<float>(count);
            const auto i = static_cast<std::size_t>(t * static_cast<float>(stem.size() - 2));
            const vec3 up = glm::normalize(stem[i + 1] - stem[i]);
            const vec3 out = portable::around(kGoldenAngle_rad * static_cast<float>(k + 3 * number) * 1.7F, 1.0F, 0.0F);
            leaf(stem[i], glm::normalize(out + 0.75F * up), up, random.uniform(0.30F, 0.44F), random);
        }
    }

    void ground_leaves() {
        Random random(seed_, 31);
        const int count = parameters_.leaves - parameters_.leaves * 2 / 3;
        for (int k = 0; k < count; ++k) {
            const float angle_rad = kGoldenAngle_rad * static_cast<float>(k) + 0.2F * random.bell();
            const vec3 out = portable::around(angle_rad, 1.0F, random.uniform(0.7F, 1.5F));
            const vec3 base = portable::around(angle_rad, random.uniform(0.06F, 0.2F), kSoilHeight);
            leaf(base, glm::normalize(out), vec3{0, 1, 0}, random.uniform(0.42F, 0.60F), random);
        }
    }

    void leaf(vec3 base, vec3 along, vec3 up, float length, Random& random) {
        PetalShape shape;
        shape.length = length;
        shape.width = 0.36F * length * random.uniform(0.85F, 1.15F);
        shape.base_width = 0.08F;
        shape.widest_at = 0.45F;
        shape.pointedness = 1.0F;
        shape.curl_rad = random.uniform(0.7F, 1.5F);
        shape.cup = 0.28F;
        shape.ripple = 0.16F;
        shape.ripple_waves = 2.5F;
        shape.ripple_phase_rad = random.uniform(0.0F, 2.0F * portable::kPiF);
        shape.rows = 18;
        append_petal(leaves_, frame_facing(base, along, up), shape);
    }

    FlowerParameters parameters_;
    std::uint64_t seed_;
    Mesh pot_, soil_, pebbles_, stems_, leaves_, pollen_, hearts_;
    std::array<Mesh, kPetalColours> petals_;
};

}  // namespace

Result<capture::Scene> generate_flower(const nlohmann::json& parameters, std::uint64_t seed) {
    Parameters in("flower", parameters);
    FlowerParameters flower{};
    flower.blooms = in.whole_number("blooms", 7, 1, 12);
    flower.petals = in.whole_number("petals", 13, 6, 24);
    flower.leaves = in.whole_number("leaves", 40, 0, 60);
    flower.spread = in.number("spread", 0.62F, 0.2F, 0.9F);
    flower.hue = in.number("hue", 0.93F, 0.0F, 1.0F);
    RS_TRY(in.finish());
    return FlowerBuilder(flower, seed).build();
}

}  // namespace rs::synthetic
