#include "compositor/web/view/shader_inputs.hpp"

#include "compositor/gpu/shader/view_uniforms.hpp"

#include <cstddef>

namespace rs::web {

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
