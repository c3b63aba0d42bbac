#pragma once
// Where the objects of a scene come from: files, or what a test makes.

#include "compositor/viewer/residency/placed_object.hpp"
#include "engine/driver/render_session.hpp"
#include "rayspace/base/result.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>

namespace rs::compositor {

class ObjectSource {
public:
    ObjectSource() = default;
    ObjectSource(const ObjectSource&) = delete;
    ObjectSource& operator=(const ObjectSource&) = delete;
    virtual ~ObjectSource() = default;

    // The most memory that read() of the file takes at any moment, and so an upper bound of what it leaves.
    virtual Result<std::int64_t> most_bytes(const std::filesystem::path& file) = 0;

    // Tells how far reading has come, 0 .. 1, not decreasing.
    using Tell = std::function<void(float)>;
    // Never takes more than `most_bytes`; fails where it would.
    virtual Result<ViewableObject> read(const std::filesystem::path& file, std::int64_t most_bytes,
                                        const Tell& tell) = 0;
};

// .rso files, made ready for the engine, which outlives the source. In the `background` one thread reads, at low
// priority, else all do.
std::unique_ptr<ObjectSource> object_files(std::shared_ptr<const engine::RenderSession> engine, bool background);

}  // namespace rs::compositor
