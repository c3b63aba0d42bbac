#include "datasets-synthetic/objects/generators.hpp"

#include "datasets-synthetic/objects/object_assembly.hpp"
#include "datasets-synthetic/objects/porcelain_brush.hpp"
#include "datasets-synthetic/shapes/curve.hpp"
#include "datasets-synthetic/shapes/noise.hpp"
#include "datasets-synthetic/shapes/paint.hpp"
#include "datasets-synthetic/shapes/parameters.hpp"
#include "datasets-synthetic/shapes/portable_math.hpp"
#include "datasets-synthetic/shapes/random.hpp"
#include "datasets-synthetic/shapes/surfaces.hpp"

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

namespace rs::synthetic {
namespace {

using glm::vec2;
using glm::vec3;

struct VasePainting {
    int width_px = 2048;
    int flowers = 5;  // around the belly
    std::uint64_t seed = 1;
};

// The cobalt-blue painting: lappets at the foot, a scroll of peonies around the belly, a meander on the shoulder,
// plantain leaves on the neck, gold at the rim. Wash and pressure vary by stroke, so that all flowers differ and every
// view of the vase is unique.
class VasePainter {
public:
    VasePainter(std::span<const vec2> profile, const VasePainting& painting)
        : profile_(profile), random_(painting.seed, 11), painting_(painting) {
        float widest = 0.0F;
        float along = 0.0F;
        for (std::size_t i = 0; i < profile.size(); ++i) {
            if (i > 0) along += glm::length(profile[i] - profile[i - 1]);
            along_.push_back(along);
            widest = std::max(widest, profile[i].x);
        }
        widest_ = widest;
        px_per_unit_ = static_cast<float>(painting.width_px) / (portable::kTwoPiF * widest);
    }

    capture::Texture paint() {
        const int height_px = static_cast<int>(along_.back() * px_per_unit_);
        Canvas canvas(painting_.width_px, height_px, vec3{0.0F});
        canvas_ = &canvas;
        PorcelainBrush brush(canvas, random_);
        brush_ = &brush;
        glaze();
        lappets(0.05F, 0.235F);
        lines(0.243F);
        scroll(0.25F, 0.60F);
        lines(0.607F);
        meander(0.62F, 0.66F);
        lines(0.672F);
        plantain_leaves(0.685F, 0.90F);
        lines(0.915F);
        rim(0.93F, 1.0F);
        canvas_ = nullptr;
        brush_ = nullptr;
        return std::move(canvas).texture("cobalt painting");
    }

private:
    [[nodiscard]] float y_px(float share) const { return share * along_.back() * px_per_unit_; }

    [[nodiscard]] float stretch_at(float height_px) const {
        const float along = height_px / px_per_unit_;
        const auto it = std::lower_bound(along_.begin(), along_.end(), along);
        const auto i = static_cast<std::size_t>(
            std::min<std::ptrdiff_t>(it - along_.begin(), static_cast<std::ptrdiff_t>(along_.size()) - 1));
        return widest_ / std::max(profile_[i].x, 0.05F);
    }

    Spot spot(float x_turns, float height_px, float size_px, float turn_rad) const {
        return {{x_turns * canvas_->width_px(), height_px}, size_px, turn_rad, stretch_at(height_px)};
    }

    void glaze() {
        const auto seed = static_cast<std::uint32_t>(painting_.seed);
        canvas_->shade({0, 0}, {canvas_->width_px(), canvas_->height_px()}, [&](vec2 p, vec3) {
            const float cloud = layered_noise({p.x / canvas_->width_px() * 12.0F, p.y / 170.0F, 0.5F}, 3, seed, 12);
            return glaze_white() * (1.0F + 0.05F * cloud);
        });
    }

    void lines(float share) {
        const float y = y_px(share);
        canvas_->band(y - 4.0F, y - 1.0F, {srgb(0x0F1A66), 0.9F, 0.3F, 0.0F, random_.next()});
        canvas_->band(y + 2.0F, y + 9.0F, {srgb(0x1B41B4), 0.9F, 0.45F, 0.0F, random_.next()});
        canvas_->band(y + 12.0F, y + 15.0F, {srgb(0x0F1A66), 0.9F, 0.3F, 0.0F, random_.next()});
    }

    // Overlapping upright lotus panels.
    void lappets(float low, float high) {
        constexpr int kPanels = 14;
        const float length_px = y_px(high) - y_px(low) - 8.0F;
        canvas_->band(y_px(low) - 14.0F, y_px(low) - 2.0F, {srgb(0x1B41B4), 0.9F, 0.4F, 0.0F, random_.next()});
        for (int layer = 0; layer < 2; ++layer) {
            for (int k = 0; k < kPanels; ++k) {
                const float turns = (static_cast<float>(k) + (layer == 0 ? 0.5F : 0.0F)) / kPanels;
                Spot at = spot(turns, y_px(low), length_px, 0.02F * random_.bell());
                at.stretch = stretch_at(y_px(0.5F * (low + high)));
                const float width = 0.98F * canvas_->width_px() / kPanels / (length_px * at.stretch);
                if (layer == 0) {
                    brush_->blade(at, {.length = 0.98F, .width = 0.8F * width, .density = 0.5F});
                    continue;
                }
                Spot inner = at;
                brush_->blade(at, {.length = 0.92F, .width = width, .density = 0.10F, .veins = 0, .line_px = 4.5F});
                inner.size_px *= 0.74F;
                inner.centre_px.y += 0.05F * length_px;
                brush_->blade(inner, {.length = 0.92F,
                                      .width = 0.95F * width,
                                      .sway = 0.02F * random_.bell(),
                                      .density = 0.8F,
                                      .veins = 1});
                brush_->dot(at({0.0F, 0.78F}), 4.0F, srgb(0xB0402A));
            }
        }
    }

    // A vine that swings around the belly, a peony in each swing, leaves and tendrils between.
    void scroll(float low, float high) {
        const float middle = 0.5F * (y_px(low) + y_px(high));
        const float half = 0.5F * (y_px(high) - y_px(low));
        const int swings = painting_.flowers;
        const float spacing_px = canvas_->width_px() / static_cast<float>(swings);
        const auto vine = [&](float turns) {
            return vec2{turns * canvas_->width_px(),
                        middle + 0.40F * half * portable::sin(portable::kTwoPiF * turns * static_cast<float>(swings))};
        };
        const int count = 48 * swings;
        std::vector<vec2> path;
        std::vector<float> radii;
        for (int k = 0; k <= count; ++k) {
            path.push_back(vine(static_cast<float>(k) / static_cast<float>(count)));
            radii.push_back(3.4F + 1.0F * gradient_noise({static_cast<float>(k) * 0.2F, 3.5F, 0.0F}, 5));
        }
        radii.back() = radii.front();
        canvas_->stroke(path, radii, brush_->outline());

        constexpr int kLeaves = 14;  // per swing
        const float leaf_px = std::min(0.42F * half, 0.36F * spacing_px);
        for (int k = 0; k < kLeaves * swings; ++k) {
            const float turns = (static_cast<float>(k) + 0.25F * random_.bell()) / static_cast<float>(kLeaves * swings);
            const vec2 root = vine(turns);
            const float side = k % 2 == 0 ? 1.0F : -1.0F;
            Spot at{root, leaf_px * random_.uniform(0.75F, 1.15F), 0.35F * random_.bell() - side * 0.5F,
                    stretch_at(root.y)};
            if (side < 0.0F) at.turn_rad += 0.5F * portable::kTwoPiF;
            if (k % 5 == 2)
                brush_->curl(at, side, 4.0F);
            else
                brush_->blade(at, {.width = 0.46F, .sway = 0.12F * random_.bell(), .density = 0.82F, .line_px = 3.2F});
        }
        const float flower_px = std::min(0.47F * half, 0.33F * spacing_px);
        for (int k = 0; k < 2 * swings; ++k) {
            const float side = k % 2 == 0 ? -1.0F : 1.0F;  // a flower in the hollow, a smaller one above the hill
            const float turns = (static_cast<float>(k) + 0.5F) / static_cast<float>(2 * swings);
            const vec2 centre{turns * canvas_->width_px(), middle + side * 0.36F * half};
            const float size = flower_px * (side < 0 ? 1.0F : 0.86F) * random_.uniform(0.94F, 1.06F);
            brush_->peony({centre, size, random_.uniform(0.0F, portable::kTwoPiF), stretch_at(centre.y)});
        }
    }

    // Greek-key band ("thunder pattern" in Chinese pottery).
    void meander(float low, float high) {
        const float size_px = y_px(high) - y_px(low);
        const float stretch = stretch_at(y_px(0.5F * (low + high)));
        const int keys = std::max(8, static_cast<int>(canvas_->width_px() / (1.3F * size_px * stretch)));
        constexpr vec2 kKey[] = {{0, 0},         {0, 1},         {0.8F, 1},     {0.8F, 0.28F},
                                 {0.36F, 0.28F}, {0.36F, 0.66F}, {0.56F, 0.66F}};
        const float step_px = canvas_->width_px() / static_cast<float>(keys);
        for (int k = 0; k < keys; ++k) {
            std::vector<vec2> path;
            for (const vec2& p : kKey)
                path.push_back(
                    {(static_cast<float>(k) + p.x) * step_px, y_px(low) + p.y * size_px + 0.5F * random_.bell()});
            const float radius_px = 4.2F;
            canvas_->stroke(path, {&radius_px, 1}, brush_->outline());
            const std::vector<vec2> base{path.front(), {path.front().x + step_px, y_px(low)}};
            canvas_->stroke(base, {&radius_px, 1}, brush_->outline());
        }
    }

    void plantain_leaves(float low, float high) {
        constexpr int kLeaves = 9;
        const float length_px = y_px(high) - y_px(low);
        for (int layer = 0; layer < 2; ++layer) {
            for (int k = 0; k < kLeaves; ++k) {
                const float turns = (static_cast<float>(k) + 0.5F * static_cast<float>(layer)) / kLeaves;
                Spot at = spot(turns, y_px(low), length_px, 0.0F);
                at.stretch = stretch_at(y_px(0.5F * (low + high)));
                const float width = 0.95F * canvas_->width_px() / kLeaves / (length_px * at.stretch);
                if (layer == 1) brush_->blade_ground(at, 0.8F, 0.9F * width);
                brush_->blade(at, {.length = layer == 0 ? 0.98F : 0.84F,
                                   .width = width,
                                   .sway = 0.02F * random_.bell(),
                                   .density = layer == 0 ? 0.78F : 0.2F,
                                   .veins = 5,
                                   .line_px = 3.4F});
            }
        }
    }

    void rim(float low, float high) {
        canvas_->band(y_px(low), y_px(0.5F * (low + high)), {srgb(0x1B41B4), 0.85F, 0.5F, 0.0F, random_.next()});
        canvas_->band(y_px(0.975F), y_px(high) + 1.0F, {srgb(0xB98A34), 0.95F, 0.25F, 0.0F, random_.next()});
    }

    std::span<const vec2> profile_;
    std::vector<float> along_;
    float widest_ = 0.0F;
    float px_per_unit_ = 0.0F;
    Random random_;
    VasePainting painting_;
    Canvas* canvas_ = nullptr;  // set while painting
    PorcelainBrush* brush_ = nullptr;
};

// `outer_profile`: (radius, height) from foot to lip; texture v is arc length along it. Pixels are square at the
// largest radius; motifs at smaller radii are widened in compensation.
capture::Texture paint_vase(std::span<const vec2> outer_profile, const VasePainting& painting) {
    return VasePainter(outer_profile, painting).paint();
}

constexpr float kWall = 0.035F;

struct VaseShape {
    float height, belly, neck;

    // From the foot to the middle of the lip.
    [[nodiscard]] std::vector<vec2> outside() const {
        const float h = height / 2.2F;
        const float foot = 0.50F * belly;
        const std::vector<vec2> controls{{foot, 0.0F},
                                         {foot + 0.01F, 0.05F * h},
                                         {0.47F * belly, 0.13F * h},
                                         {0.56F * belly, 0.36F * h},
                                         {0.86F * belly, 0.78F * h},
                                         {belly, 1.14F * h},
                                         {0.86F * belly, 1.42F * h},
                                         {0.5F * (belly + neck) - 0.06F, 1.58F * h},
                                         {neck + 0.02F, 1.76F * h},
                                         {neck, 1.92F * h},
                                         {neck + 0.07F, 2.09F * h},
                                         {neck + 0.19F, 2.19F * h},
                                         {neck + 0.205F, 2.2F * h}};
        return smooth_curve<vec2>(controls, 10);
    }

    // The other side of the wall, from the lip down to the axis inside, one wall thickness away.
    [[nodiscard]] static std::vector<vec2> inside(const std::vector<vec2>& outside) {
        std::vector<vec2> wall{outside.back()};
        const std::size_t floor = 18;  // the inside ends above the foot
        for (std::size_t i = outside.size() - 3; i > floor; i -= 2) {
            const vec2 along = glm::normalize(outside[i + 1] - outside[i - 1]);
            wall.push_back(outside[i] + kWall * vec2{-along.y, along.x});
        }
        const vec2 corner = wall.back();
        wall.push_back({0.7F * corner.x, corner.y - 0.06F});
        wall.push_back({0.0F, corner.y - 0.08F});
        std::vector<vec2> smooth = smooth_curve<vec2>(wall, 3);
        smooth.back().x = 0.0F;
        return smooth;
    }

    // The unglazed foot ring and the hollow underneath, from the axis outwards.
    [[nodiscard]] static std::vector<vec2> underside(vec2 foot) {
        return {{0.0F, foot.y + 0.04F}, {foot.x - 0.06F, foot.y + 0.035F}, {foot.x - 0.045F, foot.y}, foot};
    }
};

}  // namespace

Result<capture::Scene> generate_vase(const nlohmann::json& parameters, std::uint64_t seed) {
    Parameters in("vase", parameters);
    VaseShape shape{};
    shape.height = in.number("height", 2.2F, 1.8F, 2.8F);
    shape.belly = in.number("belly", 0.66F, 0.5F, 0.8F);
    shape.neck = in.number("neck", 0.22F, 0.15F, 0.32F);
    const int flowers = in.whole_number("flowers", 5, 3, 8);
    const float roughness = in.number("roughness", 0.12F, 0.02F, 0.6F);
    RS_TRY(in.finish());

    const std::vector<vec2> outside = shape.outside();
    ObjectAssembly assembly("vase");
    capture::Material painted{.name = "painted porcelain", .kind = capture::SurfaceKind::glossy};
    painted.colour = glm::vec3{1.0F};
    painted.roughness = roughness;
    painted.two_sided = false;
    painted.texture = assembly.add_texture(paint_vase(outside, {.flowers = flowers, .seed = seed}));
    capture::Material white{.name = "white porcelain", .kind = capture::SurfaceKind::glossy};
    white.colour = srgb(0xE0E3E1);
    white.roughness = roughness;
    white.two_sided = false;
    capture::Material clay{.name = "unglazed clay"};
    clay.colour = srgb(0xC9B49A);
    clay.two_sided = false;

    constexpr int kAround = 256;
    const int painted_index = assembly.add_material(std::move(painted));
    const int white_index = assembly.add_material(std::move(white));
    const int clay_index = assembly.add_material(std::move(clay));
    append_lathe(assembly.add_mesh("outside", painted_index), outside, {.segments = kAround, .crease_rad = 3.0F});
    append_lathe(assembly.add_mesh("inside", white_index), VaseShape::inside(outside),
                 {.segments = kAround, .crease_rad = 3.0F});
    append_lathe(assembly.add_mesh("foot", clay_index), VaseShape::underside(outside.front()), {.segments = kAround});
    return std::move(assembly).finish();
}

}  // namespace rs::synthetic
