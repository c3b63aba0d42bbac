#include "engine/core/definition/reconstruct.hpp"

#include "engine/core/definition/ray_setup.hpp"
#include "engine/core/definition/shape_pixel.hpp"
#include "engine/core/definition/shape_setup.hpp"
#include "rayspace/object/yuv.hpp"

namespace rs::engine {
namespace {

// Texel source of shape_pixel() for unpacked images.
struct StoredTexels {
    const RaySpaceObject& object;

    [[nodiscard]] const PlanarImage& image(int view) const { return object.images[static_cast<std::size_t>(view)]; }
    [[nodiscard]] Rgba8 color(int view, int column, int row) const { return rgba_at(image(view), column, row); }
    [[nodiscard]] int detail(int view, int column, int row) const { return texel_detail_at(image(view), column, row); }
};

ShapePixel plane_pixel(const RaySpaceObject& object, const ViewRegisters& registers, int i, int j) {
    const RaySetup ray = set_up_ray(object, registers, i, j);
    if (ray.image < 0) return {};
    const std::int64_t row = ray.row(j);
    if (row < 0 || row >= object.height) return {};
    return {rgba_at(object.images[static_cast<std::size_t>(ray.image)], ray.column, static_cast<int>(row)),
            ray.lambda_q20};
}

ShapePixel pixel_with_height(const RaySpaceObject& object, const ViewRegisters& registers, int i, int j) {
    const ShapeSetup setup = set_up_shape(object, registers, i, j);
    if (!setup.has_ray) return {};
    return shape_pixel(object, registers, setup, registers.rise_q24(i, j), StoredTexels{object});
}

}  // namespace

void reconstruct_scalar(const RaySpaceObject& object, const ViewRegisters& registers, ImageView<Rgba8> out,
                        ImageView<std::int32_t> lambda_q20) {
    RS_CHECK(out.width() == registers.width && out.height() == registers.height);
    RS_CHECK(lambda_q20.empty() || (lambda_q20.width() == registers.width && lambda_q20.height() == registers.height));
    const bool has_shape = !object.rings[static_cast<std::size_t>(registers.ring)].shape.empty();
    for (int j = 0; j < registers.height; ++j) {
        for (int i = 0; i < registers.width; ++i) {
            const ShapePixel pixel =
                has_shape ? pixel_with_height(object, registers, i, j) : plane_pixel(object, registers, i, j);
            out(i, j) = pixel.colour;
            if (!lambda_q20.empty()) lambda_q20(i, j) = pixel.colour.a > 0 ? pixel.lambda_q20 : 0;
        }
    }
}

}  // namespace rs::engine
