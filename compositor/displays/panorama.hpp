#pragma once
// Equirectangular panoramas of the full sphere, from six images of the faces of a cube. Pure; thread-safe.
//
// Layout of environment maps and light probes (capture::probe_direction()): twice as wide as high, row 0 is +Y, the
// central column is ahead, columns increase to the right. Each pixel is interpolated bilinearly, in linear light, in
// the face that its direction points to; faces have a margin, so that pixels at a border are interpolated within one
// face.

#include "rayspace/geometry/camera.hpp"
#include "rayspace/image/image.hpp"

#include <array>
#include <cstddef>

namespace rs::compositor {

/// Faces in the order ahead, right, back, left, up, down.
inline constexpr std::size_t kPanoramaFaces = 6;

struct PanoramaLayout {
    int width = 2048;   // px, even, >= 4; the height is half of it
    int margin_px = 2;  // of a face beyond its 90 degrees, on each side, >= 1

    [[nodiscard]] int height() const { return width / 2; }
    /// Side of a face without its margin: at its middle, where it is coarsest, as fine as the panorama.
    [[nodiscard]] int face_px() const;
};

/// Cameras of the faces, at the centre of `camera`. Y is up; ahead is the horizontal part of its viewing direction. Of
/// a camera that looks straight up or down it is the horizontal direction that its image shows at the bottom or the
/// top.
std::array<Camera, kPanoramaFaces> panorama_cameras(const Camera& camera, const PanoramaLayout& layout);

/// \param faces opaque images of panorama_cameras()
Image<Rgba8> panorama_from_faces(const std::array<Image<Rgba8>, kPanoramaFaces>& faces, const PanoramaLayout& layout);

}  // namespace rs::compositor
