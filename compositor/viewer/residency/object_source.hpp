#pragma once
// Interface of object sources: files, or generated objects in tests.

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

    /// Upper bound of the memory that read() of this file uses at any moment, and so of its result.
    virtual Result<std::int64_t> most_bytes(const std::filesystem::path& file) = 0;

    /// Progress callback, 0 .. 1, non-decreasing.
    using ProgressCallback = std::function<void(float)>;
    /// Fails if it would need more memory than `most_bytes`.
    virtual Result<ViewableObject> read(const std::filesystem::path& file, std::int64_t most_bytes,
                                        const ProgressCallback& on_progress) = 0;
};

/// Source of .rso files, prepared for `engine`.
/// \param background one low-priority reader thread; otherwise all threads are used.
std::unique_ptr<ObjectSource> make_file_source(std::shared_ptr<const engine::RenderSession> engine, bool background);

}  // namespace rs::compositor
