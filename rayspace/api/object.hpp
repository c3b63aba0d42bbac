#pragma once
/// \file
/// Object: a ray-space object, opened from an .rso file.

#include "rayspace/api/camera.hpp"
#include "rayspace/api/image.hpp"
#include "rayspace/api/result.hpp"
#include "rayspace/api/types/ray_space_object.hpp"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rs::api {

using rs::RaySpaceObject;  ///< \copybrief rs::RaySpaceObject

/// Options of Object::open().
struct OpenOptions {
    /// Photos to load: 0 every 8th of a ring, 1 every 4th, 2 every 2nd, 3 all. Missing ones are replaced by their
    /// nearest loaded neighbours.
    int level = 3;
    std::uint64_t memory_cap_bytes = std::uint64_t{8} << 30;  ///< objects that need more are refused
};

/// Ring of photos: one turn at one elevation.
struct RingInfo {
    double elevation_deg = 0;  ///< of the cameras above the plane through the origin across the ring's axis
    int photos = 0;            ///< number of photos
    int planes = 0;            ///< number of reference planes
    bool has_depth = false;    ///< true if the ring has a depth for every ray; else the object is assumed on the planes
};

/// Ray-space object, unchangeable. Copies are cheap and share the data; all functions may be called from several
/// threads at once.
class Object {
public:
    /// Opens an .rso file. Compressed photos stay compressed in memory.
    /// \return the object; an error that names the file and the place in it
    static Result<Object> open(const std::filesystem::path& path, const OpenOptions& options = {});

    /// Makes an object of its data.
    /// \return the object; an error that names the number that is out of range
    static Result<Object> create(RaySpaceObject data);

    /// True if no photo is missing, as after open() with level 3.
    [[nodiscard]] bool has_all_photos() const;
    /// Name, UTF-8.
    [[nodiscard]] const std::string& name() const;
    /// Width of the photos, px.
    [[nodiscard]] int width() const;
    /// Height of the photos, px.
    [[nodiscard]] int height() const;
    /// Number of photos.
    [[nodiscard]] int photos() const;
    /// Rings, in the file's order; a view is rendered from the ring that is nearest in elevation.
    [[nodiscard]] std::vector<RingInfo> rings() const;
    /// Length of the object radius (of the bounding cylinder about the Y axis) in the units of the capture set.
    [[nodiscard]] double units_per_radius() const;
    /// Y of the ground that the object stands on, in the units of the capture set; nothing if it is not known.
    [[nodiscard]] std::optional<double> ground_height() const;
    /// Cameras of the stored (upright) photos, in the order of photo(); an error if the object has no rig.
    [[nodiscard]] Result<std::vector<CapturedCamera>> captured_cameras() const;

    /// A stored photo, decoded. Cost: the photo and those that it is predicted from.
    /// \param index  0..photos()-1
    /// \return 8-bit sRGB with straight alpha; an error if the index is out of range or the photo is not loaded
    [[nodiscard]] Result<Image<Rgba8>> photo(int index) const;

    /// Cameras of an orbit about the Y axis, at even steps.
    /// \param count  >= 1
    /// \param shape  size and field of view
    /// \return cameras with the distance, height and tilt of the first captured view; an error if the object has no rig
    [[nodiscard]] Result<std::vector<Camera>> orbit(int count, const ViewShape& shape = {}) const;

    /// A camera from an eye to a target, both in object radii.
    /// \return the camera; an error if the points are equal, or the object has no rig
    [[nodiscard]] Result<Camera> look_at(const Vector3& eye, const Vector3& target, const ViewShape& shape = {}) const;

    /// Writes an .rso file, which appears complete or not at all. All photos must be loaded.
    [[nodiscard]] Status write(const std::filesystem::path& path) const;

    /// Writes the stored photos and their transforms.json as a capture set. All photos must be loaded.
    /// \param folder  must not exist, or be an earlier output
    [[nodiscard]] Status extract(const std::filesystem::path& folder) const;

    /// The data, for executors. Compressed photos are only in RaySpaceObject::coded.
    [[nodiscard]] const RaySpaceObject& data() const { return *data_; }

    /// A copy of the data with every loaded photo decoded. Memory: 4 bytes per pixel.
    [[nodiscard]] RaySpaceObject unpacked() const;

private:
    friend class Renderer;
    explicit Object(std::shared_ptr<const RaySpaceObject> data) : data_(std::move(data)) {}
    std::shared_ptr<const RaySpaceObject> data_;
};

}  // namespace rs::api
