#pragma once
// Views of one object for a page: an orbiting camera, and its image from the fast core (engine/core/fast). Steep views
// are rendered by an upright camera and resampled (compositor/viewer/views/upright_image.hpp), as rs-view does in a
// window. Not thread-safe.

#include "compositor/web/view/row_sampling.hpp"
#include "engine/core/definition/view_registers.hpp"
#include "engine/core/fast/renderer.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/geometry/camera.hpp"
#include "rayspace/image/image.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace rs::web {

/// Memory of a page's object, images and maps; browsers limit a module to 2 or 4 GiB.
inline constexpr std::uint64_t kPageMemoryCap_bytes = std::uint64_t{1} << 30;

/// Camera of the captured photos, from the first view of a ring. Lengths in object radii. The target, a point of the
/// axis, is the same for all rings.
struct CapturedCamera {
    double distance = 0;       // from the target
    double elevation_rad = 0;  // above the target's horizontal plane
    double azimuth_rad = 0;    // of the first photo, from +Z towards +X
    double target_height = 0;  // Y of the target, in the middle of the first ring's photo
    double tan_half_x = 0;     // half width of the photo at depth 1
    double tan_half_y = 0;
};
std::vector<CapturedCamera> captured_cameras(const RaySpaceObject& object);  // [ring]

/// Camera on an orbit about the captured target. The captured frame fits into the image.
struct OrbitView {
    int width = 0;  // px
    int height = 0;
    double azimuth_rad = 0;    // from +Z towards +X
    double elevation_rad = 0;  // within +-pi/2
    double distance = 0;       // object radii
};

/// Registers of a view, which two rings may show, and its resampling.
struct PreparedView {
    engine::MixedView rings;
    std::optional<std::vector<SampledRow>> rows;  // if the registers are those of an upright image of the view
};

/// Azimuth of a photo's camera, from +Z towards +X.
double photo_azimuth_rad(const RaySpaceObject& object, const Ring& ring, std::uint16_t view);

class ObjectView {
public:
    /// Opens an .rso file in memory. `name` begins the messages of errors.
    /// \param max_level highest progressive level whose images are read (encode/FORMAT.md)
    static Result<ObjectView> open(std::vector<std::byte> file, const std::string& name, int max_level);

    /// Shows an object whose coded images arrive later (engine::ImageArrival::later).
    static Result<ObjectView> create(RaySpaceObject object);

    [[nodiscard]] const RaySpaceObject& object() const { return renderer_.object(); }
    [[nodiscard]] const engine::Renderer& renderer() const { return renderer_; }
    [[nodiscard]] engine::Renderer& renderer() { return renderer_; }
    [[nodiscard]] const std::vector<CapturedCamera>& captured() const { return captured_; }
    /// Camera of a view. Lengths in object radii.
    [[nodiscard]] Camera camera_of(const OrbitView& view) const;

    /// Photos of the object, decoded on demand.
    [[nodiscard]] const engine::TexelStore& texels() const { return renderer_.texels(); }

    /// Registers of a view. The second ring is left out while it has no photos.
    /// \return error for views outside of the ranges of engine::prepare_view()
    [[nodiscard]] Result<PreparedView> prepare(const OrbitView& view) const;
    /// Renders a view with straight alpha. \return as prepare()
    Status render(const OrbitView& view);
    /// Renders the view of given registers, with depth; for conformance vectors.
    Status render_registers(const engine::ViewRegisters& registers);

    [[nodiscard]] const Image<Rgba8>& image() const { return image_; }
    [[nodiscard]] const Image<std::int32_t>& lambda_q20() const { return lambda_q20_; }

private:
    explicit ObjectView(engine::Renderer renderer);

    engine::Renderer renderer_;
    std::vector<CapturedCamera> captured_;  // [ring]
    Image<Rgba8> image_;
    Image<std::int32_t> lambda_q20_;
};

}  // namespace rs::web
