#pragma once
// Fast software renderer: the paper's "Core Module" (section 6). Its images equal those of reconstruct_scalar bit for
// bit.
//
// Upright views are rendered column by column: one set-up per view column, then a SIMD loop over strips of columns
// (column_walk.hpp; shape_walk.hpp for objects with a shape map). Views from tilted cameras need a set-up per pixel
// (about thirty times slower).

#include "engine/core/definition/view_registers.hpp"
#include "engine/core/fast/texel_store.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/image/image.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace rs::engine {

/// Replaces missing images: every map cell of an image that is not loaded gets the loaded image of the ring nearest to
/// it in turning order. The shape map of such a ring is dropped, since it needs all images. \return error if a ring has
/// no loaded image
Status substitute_missing_images(RaySpaceObject& object);

struct RendererOptions {
    // Memory for decoded images that is kept between views, for objects whose images are compressed; 9 bytes per pixel.
    // A view may exceed it while it is rendered.
    std::int64_t decoded_budget_bytes = std::int64_t{256} << 20;
    // `later`: coded images of the object are loaded while it is rendered; images_arrived() must be called then.
    ImageArrival arrival = ImageArrival::complete;
};

class Renderer {
public:
    /// Creates a renderer of a valid object (validate_object; objects of read_object are valid). Substitutes missing
    /// images. If all images are only coded, they are decoded tile by tile as views need them; else they are converted
    /// now, and Y, U, V and alpha are freed.
    static Result<Renderer> create(RaySpaceObject object, const RendererOptions& options = {});

    /// The object without its unpacked images. With ImageArrival::later its RS maps also name missing images.
    [[nodiscard]] const RaySpaceObject& object() const { return object_; }

    /// The texels of its images, decoded on demand.
    [[nodiscard]] const TexelStore& texels() const { return texels_; }
    /// Takes note of coded images that were loaded into the object's `coded`, and of a ring's shape map that was
    /// missing (ImageArrival::later). Until a ring is complete, views are rendered with its shape map if all their
    /// images are there, else without it and with substitutes for missing images. No other thread may use the renderer.
    void images_arrived();
    void shape_arrived(std::size_t ring, ShapeMap shape);
    /// True if a ring has an image that can be decoded.
    [[nodiscard]] bool has_images(int ring) const;
    /// [view]: true if an image can be rendered.
    [[nodiscard]] const std::vector<bool>& decodable() const { return decodable_; }
    /// Views whose images an upright view reads, ascending; all views of the ring for a tilted one.
    [[nodiscard]] std::vector<int> images_of(const ViewRegisters& registers) const;

    /// Memory of the renderer and the object; changes as coded images are decoded and freed.
    [[nodiscard]] std::int64_t memory_bytes() const;

    /// Renders a view. Uses the threads of the calling tbb arena. Thread-safe.
    /// \param registers   from prepare_view for object()
    /// \param out         size of the view; every pixel is written, straight RGBA
    /// \param lambda_q20  empty, or the size of the view: receives the axial depth, 0 where alpha is 0 (as in
    ///                    reconstruct_scalar)
    void render(const ViewRegisters& registers, ImageView<Rgba8> out, ImageView<std::int32_t> lambda_q20 = {}) const;
    /// Renders a view from one ring, or mixes it from two, which takes twice the time.
    void render(const MixedView& view, ImageView<Rgba8> out, ImageView<std::int32_t> lambda_q20 = {}) const;

private:
    Renderer(RaySpaceObject object, TexelStore texels);
    [[nodiscard]] const RaySpaceObject& object_for(const ViewRegisters& registers) const;
    void render_upright(const RaySpaceObject& object, const ViewRegisters& registers, ImageView<Rgba8> out,
                        ImageView<std::int32_t> lambda) const;
    void render_tilted(const RaySpaceObject& object, const ViewRegisters& registers, ImageView<Rgba8> out,
                       ImageView<std::int32_t> lambda) const;
    void render_shape_upright(const ViewRegisters& registers, ImageView<Rgba8> out,
                              ImageView<std::int32_t> lambda) const;
    void render_shape_pixels(const ViewRegisters& registers, ImageView<Rgba8> out,
                             ImageView<std::int32_t> lambda) const;

    RaySpaceObject object_;
    TexelStore texels_;
    std::vector<bool> decodable_;  // [view]
    // The object with substitutes in its RS maps and without shape maps; until all images have arrived.
    std::optional<RaySpaceObject> substituted_;
};

}  // namespace rs::engine
