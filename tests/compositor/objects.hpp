#pragma once
// Viewable objects created in memory, for the compositor's tests.

#include "compositor/viewer/residency/object_source.hpp"
#include "compositor/viewer/residency/placed_object.hpp"
#include "tests/support/ring_object.hpp"

#include <memory>
#include <optional>

namespace rs::test {

// Drum of radius 1, from about -1 to 1 in height: noise with random alpha, or opaque in one colour.
inline RaySpaceObject drum_object(std::optional<Rgba8> colour = std::nullopt) {
    RingObjectOptions options;
    options.views = 24;
    options.x_cells = 64;
    options.u_cells = 64;
    RaySpaceObject object = ring_object(options);
    if (colour) {
        const Rig rig = ring_rig(options);
        for (std::size_t i = 0; i < object.images.size(); ++i) {
            std::mt19937_64 random(i);
            Image<Rgba8> image = noise_image(rig.views[i].camera, random);
            // Non-empty columns are opaque over their whole height.
            for (int x = 0; x < image.width(); ++x) {
                bool shows = false;
                for (int y = 0; y < image.height(); ++y) shows |= image(x, y).a > 0;
                for (int y = 2; y < image.height() - 3; ++y) image(x, y) = shows ? *colour : Rgba8{};
            }
            object.images[i] = planar_from_rgba(image);
        }
    }
    return object;
}

inline std::shared_ptr<const compositor::ViewableObject> drum(std::optional<Rgba8> colour = std::nullopt) {
    Result<compositor::ViewableObject> viewable = compositor::make_viewable(drum_object(colour));
    RS_CHECK(viewable.ok());
    return std::make_shared<const compositor::ViewableObject>(std::move(*viewable));
}

// Source of one drum for every file.
class ObjectsInMemory final : public compositor::ObjectSource {
public:
    explicit ObjectsInMemory(std::optional<Rgba8> colour = std::nullopt) : colour_(colour) {}
    Result<std::int64_t> most_bytes(const std::filesystem::path& /*file*/) override { return std::int64_t{8} << 20; }
    Result<compositor::ViewableObject> read(const std::filesystem::path& /*file*/, std::int64_t /*most_bytes*/,
                                            const ProgressCallback& /*on_progress*/) override {
        return compositor::make_viewable(drum_object(colour_));
    }

private:
    std::optional<Rgba8> colour_;
};

inline compositor::PlacedObject placed_at(std::shared_ptr<const compositor::ViewableObject> object,
                                          const compositor::NodeTransform& transform = {}) {
    return {std::move(object), transform.parent_from_node()};
}

}  // namespace rs::test
