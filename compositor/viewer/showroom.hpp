#pragma once
// A scene's objects for a visitor who walks through it: room by room into memory before they are seen, out of it behind
// the visitor, within a budget (object_cache.hpp, load_priority.hpp); and what each node shows meanwhile
// (shown_parts.hpp).
//
// No OpenGL here. One thread; it never waits for a file unless the options require it.

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

// Half of the machine's memory.
std::int64_t usual_memory_budget();

struct ShowroomOptions {
    std::int64_t memory_bytes = usual_memory_budget();  // that objects may take, while they are read too
    // Every update waits for all objects that are needed and fit: the same images every time. Else objects come when
    // they are read, and fade in.
    bool waits = false;
};

class Showroom {
public:
    // Without a `source`, objects are read from the scene's files.
    Showroom(const Scene& scene, const ShowroomOptions& options, std::unique_ptr<engine::Executor> board = nullptr,
             std::unique_ptr<ObjectSource> source = nullptr);

    // For FrameCompositor::create().
    [[nodiscard]] std::shared_ptr<engine::RenderSession> engine() const { return engine_; }
    [[nodiscard]] std::shared_ptr<const ShownNodes> nodes() const { return nodes_; }

    // Before each frame: where the visitor is, `seconds` after the frame before, and is about to be brought to, if not
    // on foot. Fails where a required object cannot be read.
    Status update(const glm::dvec3& eye, double seconds, const std::optional<glm::dvec3>& destination = std::nullopt);

    // From the next frame on an object stands elsewhere, or nowhere.
    void move_object(std::size_t node, const std::optional<TransformChain>& chain);

    // Waits for all objects that are needed at `eye` and fit.
    Status wait_for_all(const glm::dvec3& eye);
    // Of a node without its object: a word or two about why.
    [[nodiscard]] std::string absence(std::size_t node) const;
    // The objects that are there.
    [[nodiscard]] std::vector<PlacedObject> placed() const;

    // Of objects that cannot be shown, each reported once.
    std::vector<std::string> take_warnings();
    // True where nothing will come or go while the visitor stays.
    [[nodiscard]] bool settled() const { return priorities_taken_ && cache_.settled(); }
    [[nodiscard]] StoreStatistics statistics() const { return cache_.statistics(); }
    // Seconds that reading the object of a node took; 0 before it was.
    [[nodiscard]] double load_seconds(std::size_t node) const { return cache_.load_seconds(plan_.file_of_node(node)); }

private:
    Status take_events();
    Status wait();
    Status arrive(const CacheEvent& event);
    void leave(CacheEvent event);
    Status fail(const CacheEvent& event);
    void load_on_board(const glm::dvec3& eye);
    void fade(double seconds);
    [[nodiscard]] Placeholder placeholder_of(std::size_t node) const;

    struct Node {
        RaySpaceNode description;
        std::optional<UprightExtent> extent;  // once the object has been there
        bool failed = false;
    };
    std::vector<Node> scene_nodes_;
    RoomPlan plan_;
    bool waits_;
    std::shared_ptr<engine::RenderSession> engine_;
    std::shared_ptr<ShownNodes> nodes_;
    std::vector<engine::ObjectHandle> handles_;  // [file]; 0 where it is not there
    std::vector<std::string> warnings_;
    std::optional<glm::dvec3> eye_;  // in the last frame
    glm::dvec3 velocity_{0};         // scene units a second
    bool priorities_taken_ = false;  // by the cache, those of the last frame
    ObjectCache cache_;
};

}  // namespace rs::compositor
