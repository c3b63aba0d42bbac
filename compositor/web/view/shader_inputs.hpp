#pragma once
// Inputs of the reconstruction shader for a page that draws an object with WebGL: per view its set-ups and uniforms,
// and the object's textures (compositor/gpu/shader).

#include "compositor/gpu/shader/view_setup.hpp"
#include "compositor/web/view/object_view.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace rs::web {

/// Inputs of one view.
struct ShaderView {
    int setup_rows = 0;                                 // 1: upright; else one row of set-ups per view row
    std::vector<compositor::SetupTexel> setups;         // compositor::set_up_rows(); empty if there are too many
    std::vector<int> photos;                            // that the view needs, ascending
    std::vector<std::array<std::int32_t, 4>> uniforms;  // of compositor::view_uniforms(), in their order
};

/// Computes inputs of views. Keeps the bounds of the columns of shape maps.
class ShaderInputs {
public:
    /// Set-ups per pixel are computed for at most this many pixels (112 bytes each).
    static constexpr std::int64_t kMaxSetups = 1 << 19;

    /// \param registers  valid for the object; every object needs inputs of its own
    ShaderView prepare(const RaySpaceObject& object, const engine::ViewRegisters& registers);

private:
    std::vector<std::vector<compositor::ColumnBounds>> bounds_;  // [ring]
};

}  // namespace rs::web
