#pragma once
// Streams a scene's objects for a moving visitor. Objects are loaded room by room before they come into view and are
// evicted behind the visitor, within a memory budget (object_cache.hpp, load_priority.hpp). Nodes display placeholders
// while their objects load (displayed_nodes.hpp).
//
// Independent of OpenGL. Single-threaded; never waits for a file unless the options require it.

#include "compositor/scene/scene.hpp"
#include "compositor/viewer/drawing/displayed_nodes.hpp"
#include "compositor/viewer/residency/load_priority.hpp"
#include "compositor/viewer/residency/object_cache.hpp"
#include "engine/driver/render_session.hpp"
#include "rayspace/base/result.hpp"

#include <glm/glm.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rs::compositor {

/// Half of the machine's physical memory.
std::int64_t default_memory_budget();

struct ShowroomOptions {
    std::int64_t memory_bytes = default_memory_budget();  // limit for objects, including those being read
    // Every update waits for all objects that are needed and fit, so that images are reproducible. Otherwise objects
    // fade in when they are loaded.
    bool waits = false;
};

class Showroom {
public:
    /// \param board null: the software core renders all objects
    /// \param source null: the scene's files
    Showroom(const Scene& scene, const ShowroomOptions& options, std::unique_ptr<engine::Executor> board = nullptr,
             std::unique_ptr<ObjectSource> source = nullptr);

    /// Arguments of FrameCompositor::create().
    [[nodiscard]] std::shared_ptr<engine::RenderSession> engine() const { return engine_; }
    [[nodiscard]] std::shared_ptr<const DisplayedNodes> nodes() const { return nodes_; }

    /// Call it before each frame. Fails if a required object cannot be read.
    /// \param seconds since the previous frame
    /// \param destination end of a flight to a viewpoint; objects around it are loaded in advance
    Status update(const glm::dvec3& eye, double seconds, const std::optional<glm::dvec3>& destination = std::nullopt);

    /// Sets the placement of an object from the next frame on; nullopt hides it.
    void move_object(std::size_t node, const std::optional<TransformChain>& chain);

    /// Waits for all objects that are needed at `eye` and fit.
    Status wait_for_all(const glm::dvec3& eye);
    /// Reason for which a node's object is missing, in two or three words for display.
    [[nodiscard]] std::string absence(std::size_t node) const;
    /// Objects in memory.
    [[nodiscard]] std::vector<PlacedObject> placed() const;

    /// New warnings about objects that cannot be shown, and, once for each file, about objects that the core draws
    /// instead of the board.
    std::vector<std::string> take_warnings();
    /// True if nothing will be loaded or evicted while the visitor does not move.
    [[nodiscard]] bool settled() const { return priorities_taken_ && cache_.settled(); }
    [[nodiscard]] CacheStatistics statistics() const { return cache_.statistics(); }
    /// Duration of the last load of the node's object in seconds; 0 before the first.
    [[nodiscard]] double load_seconds(std::size_t node) const { return cache_.load_seconds(plan_.file_of_node(node)); }

private:
    Status take_events();
    Status wait();
    Status add_loaded(const CacheEvent& event);
    void evict(CacheEvent event);
    Status record_failure(const CacheEvent& event);
    void warn_of_core_objects();
    void load_on_board(const glm::dvec3& eye);
    void fade(double seconds);
    [[nodiscard]] Placeholder placeholder_of(std::size_t node) const;

    struct Node {
        RaySpaceNode description;
        std::optional<UprightExtent> extent;  // set by the first load
        bool failed = false;
    };
    std::vector<Node> scene_nodes_;
    RoomPlan plan_;
    bool waits_;
    std::string board_name_;  // of the executor; empty: the software core
    std::shared_ptr<engine::RenderSession> engine_;
    std::shared_ptr<DisplayedNodes> nodes_;
    std::vector<engine::ObjectHandle> handles_;  // [file]; 0 if not loaded
    std::vector<std::string> warnings_;
    std::vector<bool> core_warned_;  // [file]; a warning says that the core draws it instead of the board
    std::optional<glm::dvec3> eye_;  // in the last frame
    glm::dvec3 velocity_{0};         // scene units per second
    bool priorities_taken_ = false;  // the cache has accepted those of the last frame
    ObjectCache cache_;
};

}  // namespace rs::compositor
