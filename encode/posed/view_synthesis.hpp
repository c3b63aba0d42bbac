#pragma once
// Views from any camera: the nearest surface along each ray, in the colours of the photos that see it from the most
// similar directions ("Unstructured Lumigraph Rendering", Buehler et al. 2001).

#include "encode/posed/posed_photo.hpp"
#include "encode/posed/signed_volume.hpp"
#include "encode/set/packed_view.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"

#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace rs::encode {

struct SynthesisOptions {
    int blended = 4;  // photos per pixel
    int raster = 2;   // rays along the side of a pixel with an edge, at most 4
};

class ViewSynthesizer {
public:
    /// Keeps references to the photos and the surface. Memory: 4 bytes per pixel of the photos.
    ViewSynthesizer(std::span<const PosedPhoto> photos, const SignedVolume& surface, const SynthesisOptions& options,
                    Progress* progress = nullptr);

    /// Thread-safe. A view near a photo shows this photo.
    [[nodiscard]] SynthesizedView synthesize(const Camera& camera) const;

private:
    struct Source {
        Camera camera;
        ConstImageView<Rgba8> image;
        Image<float> depth;  // of the surface, axial
    };
    struct Pixel {
        RgbaF colour;     // linear light times alpha
        float depth = 0;  // of the nearest surface
    };
    // The part of a view that shares the photos to blend.
    struct Tile {
        int left = 0, top = 0;
        SignedVolume::Span depths;
        std::vector<const Source*> candidates;  // found at the tile's first surface
    };
    void cast_corners(const Camera& camera, const Tile& tile, Image<float>& corners) const;
    void render_tile(const Camera& camera, const Image<float>& corners, Tile& tile, SynthesizedView& view) const;
    // Casts several rays.
    [[nodiscard]] Pixel render_edge(const Camera& camera, int x, int y, Tile& tile) const;
    [[nodiscard]] RgbaF colour_at(const Camera& camera, const glm::dvec3& p, Tile& tile) const;
    // Those with the least angle to the view's ray.
    [[nodiscard]] std::vector<const Source*> nearest_sources(
        const Camera& camera, const glm::dvec3& p, const std::function<bool(const Source&)>& is_suitable) const;
    [[nodiscard]] float visibility(const Source& source, const glm::dvec3& seen) const;
    // nullopt if no candidate shows the point.
    [[nodiscard]] std::optional<RgbaF> blend(std::span<const Source* const> candidates, const Camera& camera,
                                             const glm::dvec3& p) const;

    const SignedVolume& surface_;
    SynthesisOptions options_;
    std::vector<Source> sources_;
};

}  // namespace rs::encode
