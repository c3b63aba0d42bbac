#pragma once
// Capture set as the encoder's input: checked cameras, converted to upright cameras if necessary, with images read on
// demand.
//
// The engine processes images by columns, so every stored image must be that of an upright camera, whose columns are
// vertical planes of rays. Images of upright cameras are used unchanged. Otherwise every image is resampled once, in
// linear light, to an upright camera at the same position (a rotation about the camera's centre, so that only rays
// outside of the frame are lost).

#include "encode/set/packed_view.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/geometry/rig.hpp"
#include "rayspace/image/image.hpp"

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace rs::encode {

/// Completed images by view index: photos whose alpha matte lacked a part, with that part added.
using CompletedImages = std::map<int, Image<Rgba8>>;

struct CaptureSet {
    std::filesystem::path file;    // the transforms.json
    std::filesystem::path folder;  // of `file`
    Rig captured;                  // as read
    Rig upright;                   // cameras of the images returned by read_upright_image; object_radius is set
    std::vector<ViewRing> rings;   // of `upright`; empty: those that find_rings() finds
    bool resampled = false;
    // True: the cameras are not rings, `upright` equals `captured`, and sizes may differ. To be encoded, the set needs
    // with_rings() (encode/posed/posed_rings.hpp).
    bool posed = false;
    int width = 0;  // px, of the upright images
    int height = 0;
    // One per view of the rig: nullptr if its image is a file; empty for photographed sets.
    std::vector<std::shared_ptr<const PackedView>> synthesized = {};
    CompletedImages completed = {};     // returned by read_upright_image() instead of the file's contents
    std::vector<std::string> warnings;  // of the checks (set_checks.hpp)
};

/// Reads transforms.json. A set of posed cameras (is_posed() of set_checks.hpp) is returned as it is. Of others,
/// computes the upright cameras, and measures the object radius from the silhouettes if the rig
/// does not contain it. Cameras may be pitched by up to 60 degrees. Images are read only if that requires them;
/// otherwise missing images are detected by read_upright_image. Errors: no views, missing or unreadable images,
/// differing sizes, lens distortion, a camera within the object radius, more images than fit into the machine's memory.
Result<CaptureSet> open_capture_set(const std::filesystem::path& path, Progress* progress = nullptr);

/// Measured upper limit of the encoder's memory per pixel of the upright images.
inline constexpr std::int64_t kEncodingBytesPerPixel = 16;

/// Fails if encoding the set takes more than `memory_bytes`: upright images of cameras on a hemisphere are many times
/// as high as the photos. open_capture_set() calls this with the machine's memory.
Status check_memory(const CaptureSet& set, std::int64_t memory_bytes);

/// The name of the set's folder, which is the default name of objects and pages.
std::string name_of(const CaptureSet& set);

/// Reads image `view` of the set as seen by upright.views[view].camera. Thread-safe.
Result<Image<Rgba8>> read_upright_image(const CaptureSet& set, int view);

/// A subset of the views, in the given order. Radius, image size and framing stay those of the whole set, so that views
/// remain comparable; no image is read.
/// \param views  indices into the rig, each at most once, at least one.
CaptureSet select_views(const CaptureSet& set, std::span<const int> views);

}  // namespace rs::encode
