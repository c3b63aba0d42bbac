#include "datasets-synthetic/objects/generators.hpp"

#include "datasets-synthetic/objects/bear_body.hpp"
#include "datasets-synthetic/objects/object_assembly.hpp"
#include "datasets-synthetic/shapes/curve.hpp"
#include "datasets-synthetic/shapes/noise.hpp"
#include "datasets-synthetic/shapes/paint.hpp"
#include "datasets-synthetic/shapes/parameters.hpp"
#include "datasets-synthetic/shapes/surfaces.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace rs::synthetic {
namespace {

using capture::Mesh;
using glm::vec3;

constexpr int kShades = 32;  // colour variants of one region's hair

struct FurStyle {
    int strands;
    float hair_length, curl, hue;
};

// A column per shade: dark at the root, sun-bleached at the tip.
capture::Texture paint_hair(BearRegion region, float hue_turns, std::uint64_t seed) {
    constexpr int kRoots_px = 64;
    Random random(seed, region == BearRegion::coat ? 41U : 42U);
    Canvas canvas(kShades, kRoots_px, vec3{0.0F});
    for (int shade = 0; shade < kShades; ++shade) {
        const float hue = hue_turns + 0.012F * random.bell();
        const bool coat = region == BearRegion::coat;
        const float saturation = (coat ? 0.56F : 0.34F) + 0.06F * random.bell();
        const float value = (coat ? 0.84F : 0.96F) + (coat ? 0.07F : 0.03F) * random.bell();
        const vec3 root = hue_colour(hue - 0.01F, saturation + 0.12F, 0.66F * value);
        const vec3 tip = hue_colour(hue + 0.012F, saturation - 0.10F, std::min(0.97F, 1.12F * value));
        const auto x = static_cast<float>(shade);
        canvas.shade({x, 0.0F}, {x + 1.0F, kRoots_px},
                     [&](glm::vec2 p, vec3) { return glm::mix(root, tip, smooth_step(0.0F, 1.0F, p.y / kRoots_px)); });
    }
    return std::move(canvas).texture(region == BearRegion::coat ? "coat hair" : "pale hair");
}

class FurGrower {
public:
    FurGrower(const FurStyle& style, std::uint64_t seed)
        : style_(style),
          seed_(static_cast<std::uint32_t>(seed)),
          random_(seed, 43),
          parts_(bear_parts()),
          bare_(bear_bare_regions()) {
        float sum = 0.0F;
        for (const BearPart& part : parts_) cumulative_.push_back(sum += sampling_weight(part.shape));
    }

    void grow(Mesh& coat, Mesh& pale) {
        constexpr int kSegments = 4;
        for (int grown = 0; grown < style_.strands;) {
            const BearPart& part = pick();
            const RejectionSample draw = sample_surface(part.shape, random_);
            if (!draw.keep || is_covered(part, draw.point.position)) continue;
            const BearRegion region = region_at(part, draw.point.normal, draw.point.position);
            append_strand(region == BearRegion::coat ? coat : pale, strand_at(part, draw.point), kSegments);
            ++grown;
        }
    }

private:
    const BearPart& pick() {
        const float r = random_.uniform() * cumulative_.back();
        const auto it = std::upper_bound(cumulative_.begin(), cumulative_.end() - 1, r);
        return parts_[static_cast<std::size_t>(it - cumulative_.begin())];
    }

    [[nodiscard]] bool is_covered(const BearPart& own, vec3 p) const {
        for (const BearPart& part : parts_) {
            if (&part != &own && part.shape.level(p) < 0.97F) return true;
        }
        return std::any_of(bare_.begin(), bare_.end(), [&](const Ellipsoid& pad) { return pad.level(p) < 1.0F; });
    }

    Strand strand_at(const BearPart& part, const SurfacePoint& point) {
        // Locks: neighbouring hairs lean in similar directions, with individual variation.
        const vec3 lock = vector_noise(point.position * 9.0F, seed_);
        const vec3 wave = vector_noise(point.position * 3.0F, seed_ + 7U);
        const vec3 lie = part.comb - point.normal * glm::dot(part.comb, point.normal);
        Strand strand;
        strand.root = point.position - 0.004F * point.normal;
        strand.direction = glm::normalize(point.normal + 0.35F * lie + 0.55F * lock + 0.22F * random_.direction());
        strand.bend = style_.curl * (0.75F * lie + 0.9F * wave + 0.5F * lock + 0.35F * random_.direction());
        strand.side = random_.direction();
        // A side vector along the hair would make the ribbon degenerate.
        strand.side = glm::normalize(strand.side - 0.9F * strand.direction * glm::dot(strand.side, strand.direction));
        strand.length = style_.hair_length * part.hair_length * random_.uniform(0.65F, 1.15F);
        strand.width = 0.0105F * random_.uniform(0.7F, 1.2F);
        const float mix = 0.5F + 0.35F * lock.y + 0.22F * random_.bell();
        const int shade = std::clamp(static_cast<int>(mix * kShades), 0, kShades - 1);
        strand.u = (static_cast<float>(shade) + 0.5F) / kShades;
        return strand;
    }

    FurStyle style_;
    std::uint32_t seed_;
    Random random_;
    std::vector<BearPart> parts_;
    std::vector<Ellipsoid> bare_;
    std::vector<float> cumulative_;
};

Ellipsoid bead(vec3 centre, vec3 radii) {
    return {{centre, glm::mat3{1.0F}}, radii};
}

void append_eyes(Mesh& mesh) {
    for (const float side : {-1.0F, 1.0F})
        append_ellipsoid(mesh, bead({side * 0.165F, 1.425F, 0.432F}, {0.062F, 0.066F, 0.055F}), 40, 24);
}

void append_nose_and_mouth(Mesh& nose, Mesh& stitches) {
    append_ellipsoid(nose, bead({0.0F, 1.315F, 0.565F}, {0.086F, 0.058F, 0.052F}), 40, 24);
    const float thread = 0.0095F;
    const std::vector<vec3> philtrum{{0.0F, 1.29F, 0.585F}, {0.0F, 1.24F, 0.597F}, {0.0F, 1.20F, 0.588F}};
    append_tube(stitches, smooth_curve<vec3>(philtrum, 6), {&thread, 1}, {.sides = 8});
    for (const float side : {-1.0F, 1.0F}) {
        const std::vector<vec3> smile{
            {0.0F, 1.20F, 0.588F}, {side * 0.05F, 1.175F, 0.575F}, {side * 0.105F, 1.19F, 0.548F}};
        append_tube(stitches, smooth_curve<vec3>(smile, 6), {&thread, 1}, {.sides = 8});
    }
}

}  // namespace

Result<capture::Scene> generate_doll(const nlohmann::json& parameters, std::uint64_t seed) {
    Parameters in("doll", parameters);
    FurStyle fur{};
    fur.strands = in.whole_number("strands", 75000, 1000, 140000);
    fur.hair_length = in.number("hair_length", 0.085F, 0.03F, 0.16F);
    fur.curl = in.number("curl", 0.55F, 0.0F, 1.5F);
    fur.hue = in.number("hue", 0.075F, 0.0F, 1.0F);
    RS_TRY(in.finish());

    ObjectAssembly assembly("doll");
    Mesh coat;
    Mesh pale;
    FurGrower(fur, seed).grow(coat, pale);
    const auto add_hair = [&](Mesh& hair, BearRegion region, const char* name) {
        const int texture = assembly.add_texture(paint_hair(region, fur.hue, seed));
        const int material =
            assembly.add_material({.name = name, .colour = vec3{1.0F}, .texture = texture, .translucency = 0.25F});
        hair.name = name;
        hair.material = material;
        assembly.add_mesh(name, material) = std::move(hair);
    };
    add_hair(coat, BearRegion::coat, "coat");
    add_hair(pale, BearRegion::pale, "pale fur");

    Mesh& skin = assembly.add_mesh(
        "skin", assembly.add_material({.name = "backing cloth", .colour = hue_colour(fur.hue, 0.6F, 0.36F)}));
    for (const BearPart& part : bear_parts()) append_ellipsoid(skin, part.shape, 64, 32);
    Mesh& pads = assembly.add_mesh("foot pads", assembly.add_material({.name = "felt", .colour = srgb(0xC9A27C)}));
    for (const Ellipsoid& pad : bear_foot_pads()) append_ellipsoid(pads, pad, 48, 24);

    const auto glossy = [&](const char* name, vec3 colour, float roughness) {
        return assembly.add_material(
            {.name = name, .kind = capture::SurfaceKind::glossy, .colour = colour, .roughness = roughness});
    };
    append_eyes(assembly.add_mesh("eyes", glossy("black glass", srgb(0x0D0A09), 0.04F)));
    Mesh nose;
    Mesh stitches;
    append_nose_and_mouth(nose, stitches);
    const auto add_part = [&](Mesh& part, const char* name, int material) {
        part.name = name;
        part.material = material;
        assembly.add_mesh(name, material) = std::move(part);
    };
    add_part(nose, "nose", glossy("leather", srgb(0x2A1A14), 0.3F));
    add_part(stitches, "mouth", assembly.add_material({.name = "thread", .colour = srgb(0x24150F)}));
    append_bow(assembly.add_mesh("bow", glossy("satin", srgb(0xB3122B), 0.38F)));
    return std::move(assembly).finish();
}

}  // namespace rs::synthetic
