#pragma once
// A capture set as the encoder takes it: cameras checked, made upright where they are not, images read on demand.
//
// The engine walks images down their columns, so every stored image must be that of an upright camera: each column
// a vertical plane of rays. Images of a rig whose cameras are upright already are used as they are, untouched.
// Otherwise every image is resampled once, in linear light, to an upright camera at the same place (a rotation about
// the camera's own centre, so no ray is lost but those outside of the frame).

#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/geometry/rig.hpp"
#include "rayspace/image/image.hpp"

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>

namespace rs::encode {

// By their number in the set: images that cut-outs lack a part of, with it.
using CompletedImages = std::map<int, Image<Rgba8>>;

struct CaptureSet {
    std::filesystem::path folder;
    Rig captured;  // as read
    Rig upright;   // the cameras of the images that read_upright_image returns; object_radius is set
    bool resampled = false;
    int width = 0;  // px, of the upright images
    int height = 0;
    CompletedImages completed = {};  // that read_upright_image() gives in place of what the files show
};

// Reads transforms.json, plans the upright cameras, and measures the object radius from the silhouettes where the rig
// does not give it. Cameras may be pitched up to 60 degrees. Images are read only where that needs them; those that
// are missing show at the latest in read_upright_image. Errors: no views, missing or unreadable images, differing
// sizes, lens distortion, a camera within the object radius, more images than the machine has memory for.
Result<CaptureSet> open_capture_set(const std::filesystem::path& path, Progress* progress = nullptr);

// What encoding a set takes at most for every pixel of its upright images, as it was measured.
inline constexpr std::int64_t kEncodingBytesPerPixel = 16;

// An error where encoding the set takes more than `memory_bytes`: cameras on a hemisphere have upright images many
// times as high as those that were taken. open_capture_set() looks up the machine's memory.
Status check_memory(const CaptureSet& set, std::int64_t memory_bytes);

// The name of the set's folder, however that was given: what objects and pages are called where nobody names them.
std::string name_of(const CaptureSet& set);

// Image `view` of the set, seen by upright.views[view].camera. Thread-safe.
Result<Image<Rgba8>> read_upright_image(const CaptureSet& set, int view);

// The same set with only the views `views` (indices into the rig, each once, at least one), in that order. Radius,
// image size and framing stay those of the whole set, so its views remain comparable; no image is read.
CaptureSet with_views(const CaptureSet& set, std::span<const int> views);

}  // namespace rs::encode
