#pragma once
// Views from any camera: the nearest surface along each ray, in the colours of the photos that see it from the most
// similar directions ("Unstructured Lumigraph Rendering", Buehler et al. 2001).

#include "encode/posed/posed_photo.hpp"
#include "encode/posed/signed_volume.hpp"
#include "encode/set/packed_view.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"

#include <span>
#include <vector>

namespace rs::encode {

struct SynthesisOptions {
    int blended = 4;  // photos per pixel
    int raster = 2;   // rays along a pixel's side, at most 4
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
    struct Candidate {
        const Source* source = nullptr;
        double cosine = -1;  // of the angle to the view's ray
    };
    struct Pixel {
        RgbaF colour;     // linear light times alpha
        float depth = 0;  // of the nearest surface
    };
    // `candidates` are those of the pixel's tile, found at its first surface.
    [[nodiscard]] Pixel render_pixel(const Camera& camera, int x, int y, std::vector<Candidate>& candidates) const;
    [[nodiscard]] std::vector<Candidate> candidates_near(const Camera& camera, const glm::dvec3& p,
                                                         std::size_t count) const;
    [[nodiscard]] float visibility(const Source& source, const glm::dvec3& seen) const;
    [[nodiscard]] RgbaF blend(const std::vector<Candidate>& candidates, const Camera& camera,
                              const glm::dvec3& p) const;

    const SignedVolume& surface_;
    SynthesisOptions options_;
    std::vector<Source> sources_;
};

}  // namespace rs::encode
