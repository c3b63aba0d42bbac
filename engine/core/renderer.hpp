#pragma once
// The fast software renderer: the paper's "Core Module" (section 6). Its pictures equal reconstruct_scalar's bit for
// bit.
//
// Upright views go column by column: one set-up for each view column, then strips of columns walk down the captured
// pictures together. Views from tilted cameras are set up pixel by pixel (some thirty times slower).

#include "engine/core/texel_store.hpp"
#include "engine/core/view_registers.hpp"
#include "rayspace/image.hpp"
#include "rayspace/ray_space_object.hpp"
#include "rayspace/result.hpp"

namespace rs::engine {

// Lets the loaded pictures of each ring stand in for those that are not: every map cell of a missing picture gets the
// loaded picture nearest to it in turning order. Does nothing where all are loaded. Fails where a ring has no picture.
Status substitute_missing_pictures(RaySpaceObject& object);

class Renderer {
public:
    // Takes the object, which must have passed validate_object (as read_object's have); Y, U, V and alpha are released
    // after conversion. Missing pictures are substituted.
    static Result<Renderer> create(RaySpaceObject object);

    // The object without its pictures.
    [[nodiscard]] const RaySpaceObject& object() const { return object_; }

    // `out` has the view's size; straight RGBA, every pixel is written. `registers` come from prepare_view on object().
    // Uses the threads of the calling tbb arena; may be called from several threads at once.
    void render(const ViewRegisters& registers, ImageView<Rgba8> out) const;

private:
    Renderer(RaySpaceObject object, TexelStore texels);
    void render_upright(const ViewRegisters& registers, ImageView<Rgba8> out) const;
    void render_shape(const ViewRegisters& registers, ImageView<Rgba8> out) const;
    void render_tilted(const ViewRegisters& registers, ImageView<Rgba8> out) const;

    RaySpaceObject object_;
    TexelStore texels_;
};

}  // namespace rs::engine
