#pragma once
/// \file
/// Building an object from a capture set.

#include "rayspace/api/object.hpp"
#include "rayspace/api/result.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace rs::api {

/// RS map of an object.
enum class MapKind {
    kShape,  ///< a depth for every ray, found from the photos; the two neighbouring photos are blended
    kPlane,  ///< as in the paper: the object is assumed to lie on the reference planes, the nearest ray is shown
};

/// Storage of the photos.
enum class PhotoCoding {
    kDense,  ///< prediction between photos and arithmetic coding: smallest
    kBoard,  ///< records of fixed sizes and codebooks, for hardware
    kRaw,    ///< 2.5 bytes per pixel, as they are
};

/// Called with the stage and its fraction done, 0..1; from several threads, one at a time.
using ProgressCallback = std::function<void(const std::string& stage, double fraction)>;

/// Options of build_object().
struct BuildOptions {
    std::string name = {};                           ///< of the object; empty: the name of the set's folder
    MapKind map = MapKind::kShape;                   ///< RS map
    int planes = 12;                                 ///< reference planes, 3..64
    PhotoCoding coding = PhotoCoding::kDense;        ///< storage of the photos
    double quality = 75;                             ///< of compressed photos, 1..100
    std::optional<double> psnr_db = {};              ///< at least this fidelity, 10..60 dB, in place of the quality
    std::optional<std::uint64_t> photos_bytes = {};  ///< at most these bytes for the photos, in place of both
    int effort = 5;                                  ///< of the dense coding, 1 (fastest) .. 9 (smallest)
    std::optional<int> alpha_bits = {};  ///< of compressed photos' alpha, 1..6; chosen by their content if not given
    ProgressCallback progress = {};      ///< may be empty
};

/// A built object.
struct BuiltObject {
    Object object;                         ///< in memory; Object::write() stores it
    std::vector<std::string> warnings;     ///< one line each: what in the set limits the quality
    std::optional<double> photos_psnr_db;  ///< fidelity of compressed photos over the object's pixels
};

/// Builds an object, on all cores of the machine. Deterministic. Thread-safe.
/// \param set  a folder with a transforms.json and RGBA photos: `rs-capture import` makes one of photos;
///             examples/convert_nerf.py makes one of a NeRF data set. Cameras look at the Y axis, all photos have one
///             size, lens distortion is removed.
/// \param options  what to build
/// \return the object; an error that names the file or the option
Result<BuiltObject> build_object(const std::filesystem::path& set, const BuildOptions& options = {});

}  // namespace rs::api
