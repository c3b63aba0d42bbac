#pragma once
/// \file
/// Renderer: views of an object.

#include "rayspace/api/camera.hpp"
#include "rayspace/api/executor.hpp"
#include "rayspace/api/image.hpp"
#include "rayspace/api/object.hpp"
#include "rayspace/api/result.hpp"

#include <cstdint>
#include <memory>

namespace rs::api {

/// Sampling of the photos of objects with depth (docs/filters.md). Objects without depth fetch the nearest pixel.
enum class Filter {
    kAuto,      ///< by the scale of the view: sharp from 0.95 of the photos' scale, smooth up to 0.75, else bilinear
    kSharp,     ///< close to bicubic
    kBilinear,  ///< mean of four pixels; the only filter of the boards
    kSmooth,    ///< low-pass, for views smaller than the photos
};

/// Options of Renderer::render().
struct RenderOptions {
    Filter filter = Filter::kAuto;  ///< sampling of the photos
    bool depth = false;             ///< also returns depth
};

/// A rendered view.
struct RenderedView {
    Image<Rgba8> image;  ///< of the camera's size; 8-bit sRGB with straight alpha; alpha 0 where the object is not seen
    /// Axial depth (distance along the viewing axis) in the units of the capture set, 0 where alpha is 0; empty if not
    /// wanted.
    Image<float> depth;
};

/// Options of Renderer::create().
struct RendererOptions {
    /// Memory for decoded photos that is kept between views, 9 bytes per pixel, for objects with compressed photos. A
    /// view may exceed it while it is rendered.
    std::int64_t decoded_budget_bytes = std::int64_t{256} << 20;
};

/// Renders views of one object. Move-only. render() may be called from several threads at once; with an executor of
/// your own the views are rendered one after the other.
class Renderer {
public:
    /// A renderer with the fast software core, on all cores of the machine. Upright views of 1024x1024 take some
    /// milliseconds, tilted ones thirty times as long.
    /// \param object   its compressed photos are shared, everything else is copied; it need not be kept
    /// \param options  memory
    /// \return an error if an option is out of range, or a ring has no photo
    static Result<Renderer> create(const Object& object, const RendererOptions& options = {});

    /// A renderer with another executor.
    /// \param object    has all of its photos
    /// \param executor  not null
    /// \return the executor's error if it does not support the object; an error if it has no free memory
    static Result<Renderer> create(const Object& object, std::unique_ptr<Executor> executor);

    Renderer(Renderer&&) noexcept;             ///< moves
    Renderer& operator=(Renderer&&) noexcept;  ///< moves
    ~Renderer();

    /// The object as it is rendered: where photos are missing, their neighbours take their place in the RS maps.
    [[nodiscard]] Object object() const;

    /// Renders a view.
    /// \param camera   in the units of the object's capture set
    /// \param options  filter and depth
    /// \return the view; an error that names the quantity of the camera that is out of range, or what the executor does
    ///         not support (tilted cameras, depth, a filter)
    [[nodiscard]] Result<RenderedView> render(const Camera& camera, const RenderOptions& options = {}) const;

private:
    struct State;
    explicit Renderer(std::shared_ptr<State> state);
    std::shared_ptr<State> state_;
};

}  // namespace rs::api
