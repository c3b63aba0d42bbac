#pragma once
// The fast software renderer: the paper's "Core Module" (section 6). Its images equal reconstruct_scalar's bit for
// bit.
//
// Upright views go column by column: one set-up for each view column, then strips of columns walk down the captured
// images together (column_walk.hpp; shape_walk.hpp for objects with a shape map). Views from tilted cameras are set
// up pixel by pixel (some thirty times slower).

#include "engine/core/definition/view_registers.hpp"
#include "engine/core/fast/texel_store.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/image/image.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <cstdint>

namespace rs::engine {

// Lets the loaded images of each ring stand in for those that are not: every map cell of a missing image gets the
// loaded image nearest to it in turning order, and a ring's shape map, which needs all of its images, is dropped.
// Does nothing where all are loaded. Fails where a ring has no image.
Status substitute_missing_images(RaySpaceObject& object);

struct RendererOptions {
    // Memory for decoded images that is kept between views, 9 bytes per pixel, of objects whose images are
    // compressed. A view may exceed it while it is rendered.
    std::int64_t decoded_budget_bytes = std::int64_t{256} << 20;
};

class Renderer {
public:
    // Takes the object, which must have passed validate_object (as read_object's have). Missing images are
    // substituted. Where all of its images are only coded, they are decoded tile by tile as views need them; else
    // they are converted now, and Y, U, V and alpha released.
    static Result<Renderer> create(RaySpaceObject object, const RendererOptions& options = {});

    // The object without its unpacked images.
    [[nodiscard]] const RaySpaceObject& object() const { return object_; }

    // What it takes in memory, the object included; grows and shrinks with what is decoded of coded images.
    [[nodiscard]] std::int64_t memory_bytes() const;

    // `out` has the view's size; straight RGBA, every pixel is written. `lambda_q20`, where not empty, has that size
    // too and receives the axial depth of what is shown, 0 where alpha is 0 (as in reconstruct_scalar). `registers`
    // come from prepare_view on object(). Uses the threads of the calling tbb arena; may be called from several threads
    // at once.
    void render(const ViewRegisters& registers, ImageView<Rgba8> out, ImageView<std::int32_t> lambda_q20 = {}) const;

private:
    Renderer(RaySpaceObject object, TexelStore texels);
    void render_upright(const ViewRegisters& registers, ImageView<Rgba8> out, ImageView<std::int32_t> lambda) const;
    void render_tilted(const ViewRegisters& registers, ImageView<Rgba8> out, ImageView<std::int32_t> lambda) const;
    void render_shape_upright(const ViewRegisters& registers, ImageView<Rgba8> out,
                              ImageView<std::int32_t> lambda) const;
    void render_shape_pixels(const ViewRegisters& registers, ImageView<Rgba8> out,
                             ImageView<std::int32_t> lambda) const;

    RaySpaceObject object_;
    TexelStore texels_;
};

}  // namespace rs::engine
