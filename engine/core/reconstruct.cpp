#include "engine/core/reconstruct.hpp"

#include "engine/core/ray_setup.hpp"
#include "rayspace/yuv.hpp"

namespace rs::engine {

void reconstruct_scalar(const RaySpaceObject& object, const ViewRegisters& registers, ImageView<Rgba8> out) {
    RS_CHECK(out.width() == registers.width && out.height() == registers.height);
    for (int j = 0; j < registers.height; ++j) {
        for (int i = 0; i < registers.width; ++i) {
            out(i, j) = Rgba8{};
            const RaySetup ray = set_up_ray(object, registers, i, j);
            if (ray.picture < 0) continue;
            const std::int64_t row = ray.row(j);
            if (row < 0 || row >= object.height) continue;
            out(i, j) =
                rgba_at(object.pictures[static_cast<std::size_t>(ray.picture)], ray.column, static_cast<int>(row));
        }
    }
}

}  // namespace rs::engine
