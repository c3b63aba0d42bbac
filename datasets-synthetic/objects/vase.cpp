#include "datasets-synthetic/objects/vase.hpp"

#include "datasets-synthetic/objects/object_assembly.hpp"
#include "datasets-synthetic/objects/vase_painting.hpp"
#include "datasets-synthetic/shapes/curve.hpp"
#include "datasets-synthetic/shapes/lathe.hpp"
#include "datasets-synthetic/shapes/paint.hpp"
#include "datasets-synthetic/shapes/parameters.hpp"

#include <utility>
#include <vector>

namespace rs::synthetic {
namespace {

using glm::vec2;

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

    // The unglazed ring it stands on and the hollow under it, from the axis outwards.
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
    if (const Status read = in.finish(); !read) return read.error();

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
