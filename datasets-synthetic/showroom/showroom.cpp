#include "datasets-synthetic/showroom/showroom.hpp"

#include "datasets-synthetic/showroom/furniture.hpp"

namespace rs::synthetic {

World make_showroom(const ShowroomOptions& options) {
    World world;
    RoomBuilder everywhere(world, "", options.texture_scale);
    add_furniture_looks(everywhere);
    build_shop(world, options.texture_scale);
    build_museum(world, options.texture_scale);
    world.viewpoints = {
        {"shop", {1.05F, 1.6F, 6.45F}, {-0.75F, 1.15F, 1.6F}},
        {"shelves", {-1.75F, 1.6F, 5.2F}, {-3.8F, 1.3F, 3.3F}},
        {"counter", {0.35F, 1.6F, 4.3F}, {2.7F, 1.12F, 2.9F}},
        {"table", {-0.2F, 1.6F, 5.35F}, {-1.4F, 0.95F, 3.7F}},
        {"doorway", {0.15F, 1.6F, 2.6F}, {0.0F, 1.5F, -5.0F}},
        {"museum", {-3.0F, 1.65F, -0.95F}, {0.7F, 1.35F, -5.6F}},
        {"lattice", {1.35F, 1.6F, -3.1F}, {0.0F, 1.3F, -4.8F}},
        {"paintings", {1.5F, 1.6F, -5.2F}, {-0.6F, 1.6F, -9.0F}},
        {"street", {-1.2F, 1.6F, -6.9F}, {0.4F, 1.4F, 2.0F}},
    };
    world.walk = {
        {"", {1.1F, 1.6F, 6.5F}, {-0.9F, 1.25F, 2.0F}},   {"", {0.1F, 1.6F, 5.9F}, {-2.6F, 1.2F, 3.2F}},
        {"", {-1.4F, 1.6F, 5.35F}, {-3.8F, 1.3F, 3.6F}},  {"", {-2.55F, 1.6F, 4.9F}, {-3.85F, 1.35F, 2.9F}},
        {"", {-2.7F, 1.6F, 3.3F}, {-3.8F, 1.3F, 1.3F}},   {"", {-2.2F, 1.6F, 2.0F}, {0.0F, 1.2F, 1.2F}},
        {"", {-0.5F, 1.6F, 1.95F}, {2.2F, 1.15F, 2.5F}},  {"", {0.6F, 1.6F, 2.6F}, {2.6F, 1.1F, 2.6F}},
        {"", {0.45F, 1.6F, 1.9F}, {0.6F, 1.3F, -2.0F}},   {"", {0.05F, 1.6F, 0.5F}, {0.0F, 1.4F, -4.8F}},
        {"", {0.1F, 1.6F, -1.1F}, {0.0F, 1.35F, -4.8F}},  {"", {1.55F, 1.6F, -1.9F}, {3.2F, 1.35F, -2.6F}},
        {"", {1.9F, 1.6F, -3.3F}, {0.3F, 1.3F, -4.8F}},   {"", {2.1F, 1.6F, -4.9F}, {0.0F, 1.35F, -4.9F}},
        {"", {1.7F, 1.6F, -6.5F}, {0.6F, 1.55F, -9.0F}},  {"", {0.2F, 1.6F, -7.2F}, {-1.2F, 1.5F, -9.2F}},
        {"", {-1.6F, 1.6F, -6.5F}, {-3.6F, 1.4F, -5.2F}}, {"", {-2.0F, 1.6F, -4.8F}, {-2.6F, 1.4F, -2.2F}},
        {"", {-1.9F, 1.6F, -3.4F}, {0.2F, 1.3F, -4.6F}},  {"", {-2.6F, 1.65F, -1.3F}, {0.6F, 1.35F, -5.4F}},
    };
    world.walk_frames = 780;
    return world;
}

}  // namespace rs::synthetic
