#include "compositor/web/view/shader_inputs.hpp"

#include "compositor/gpu/shader/view_uniforms.hpp"

#include <cstddef>

namespace rs::web {

PhotoTexels photo_texels(const ObjectView& object, int photo) {
    const int width = object.object().width;
    const int height = object.object().height;
    const engine::TexelStore& store = object.texels();
    const engine::TexelStore::Reading reading = store.read();
    store.ensure(photo, 0, width - 1);
    PhotoTexels texels{Image<Rgba8>(width, height), Image<std::int8_t>(width, height)};
    for (int column = 0; column < width; ++column) {
        const std::int32_t start = store.column_start(photo, column);
        for (int row = 0; row < height; ++row) {
            texels.colours(column, row) = store.texels()[start + row];
            texels.details(column, row) = store.details()[start + row];
        }
    }
    return texels;
}

ShaderView ShaderInputs::prepare(const RaySpaceObject& object, const engine::ViewRegisters& registers) {
    const auto ring = static_cast<std::size_t>(registers.ring);
    const ShapeMap& shape = object.rings[ring].shape;
    bounds_.resize(object.rings.size());
    const std::size_t columns = shape.cells.empty() ? 0 : shape.cells.size() / static_cast<std::size_t>(shape.bands);
    if (bounds_[ring].size() != columns) bounds_[ring] = compositor::column_bounds(shape);
    ShaderView view;
    view.setup_rows = registers.upright() ? 1 : registers.height;
    for (const compositor::ShaderUniform& uniform : compositor::view_uniforms(object, registers)) {
        view.uniforms.push_back(uniform.values);
    }
    if (std::int64_t{view.setup_rows} * registers.width > kMaxSetups) return view;
    view.setups = compositor::set_up_rows(object, registers, bounds_[ring], 0, view.setup_rows);
    view.photos = compositor::photos_of(view.setups, registers.width);
    return view;
}

}  // namespace rs::web
