#pragma once
// Rendering session: the interface between an application and the executors (the paper's data module, section 6).
// Objects are loaded and evicted, views are submitted in rendering cycles, and images are retrieved.
//
// A *rendering cycle* is a list of views that are rendered together. Cycles are queued and rendered in order on threads
// of the session, so submit() does not block while images are rendered.
//
// A session has one or two executors: the software core, which supports everything, and an optional board. The board's
// memory holds the most recently requested objects. The core concurrently renders the views that the board cannot
// render, and replaces the board if it fails. Both give the same bits: with a board, objects that it supports are
// rendered in the board's representation (Executor::as_rendered).
//
// Thread-safety: every member function may be called from any thread.

#include "engine/driver/board_thread.hpp"
#include "engine/driver/cycle_executor.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/geometry/camera.hpp"
#include "rayspace/image/image.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace rs::engine {

struct ObjectHandle {
    std::uint32_t number = 0;  // 0: none; numbers are never reused
    bool operator==(const ObjectHandle&) const = default;
};

struct ViewRequest {
    ObjectHandle object;
    Camera camera;       // in the units of the object's rig
    bool depth = false;  // also compute axial depth
    // Accept ExecutedView::deferred of the board, which the caller then renders.
    bool may_defer = false;
};

struct CycleHandle {
    std::uint64_t number = 0;
};

struct RenderSessionLimits {
    int objects = 20;          // loaded at the same time
    int views_per_cycle = 15;  // limit of the board, see model/limits/board_limits.hpp
    int cycles_in_flight = 2;  // queued, being rendered, or rendered and not yet retrieved: double buffering
};

// Object prepared in advance, on any thread, so that load() takes no time.
struct PreparedObject {
    std::shared_ptr<const Renderer> renderer;         // not null
    std::shared_ptr<const RaySpaceObject> for_board;  // from RenderSession::convert_for_board(), or null
    std::string not_on_board = {};                    // its error, if it failed
};

// Object that the core renders although the session has a board.
struct CoreFallback {
    ObjectHandle object;
    std::string reason;  // "NAME: what is wrong; what to do"
};

struct RenderSessionStatistics {
    std::int64_t cycles = 0;
    std::int64_t views_by_board = 0;
    std::int64_t views_by_core = 0;
    BoardThreadCounts board;
};

class RenderSession {
public:
    explicit RenderSession(const RenderSessionLimits& limits = {}, std::unique_ptr<Executor> board = nullptr);
    ~RenderSession();  // waits for the current cycle; drops queued ones
    RenderSession(const RenderSession&) = delete;
    RenderSession& operator=(const RenderSession&) = delete;

    /// Reads, validates and prepares an object. \return error if the file is invalid or too many objects are loaded
    Result<ObjectHandle> load(const std::filesystem::path& path);
    Result<ObjectHandle> load(RaySpaceObject object);
    Result<ObjectHandle> load(PreparedObject object);

    /// Converts a valid object (validate_object) to the board's representation.
    /// \return copy for PreparedObject::for_board; null if the session has no board; an error, with `object` unchanged,
    ///         if the board does not support the object: the text of PreparedObject::not_on_board
    [[nodiscard]] Result<std::shared_ptr<const RaySpaceObject>> convert_for_board(RaySpaceObject& object) const;

    [[nodiscard]] const RenderSessionLimits& limits() const;
    [[nodiscard]] bool has_board() const;

    /// Removes an object. Its memory is freed when the cycles that use it are finished.
    Status evict(ObjectHandle object);

    /// Waits until the objects are in the board's memory or cannot be loaded, so that the board renders from the first
    /// cycle on. No effect without a board. Requires that no other thread submits.
    void load_on_board(const std::vector<ObjectHandle>& objects);

    /// Loaded object without its images.
    Result<std::shared_ptr<const RaySpaceObject>> describe(ObjectHandle object) const;

    /// Queues a cycle.
    /// \return error, with nothing queued, if a view's object is not loaded, its camera cannot be rendered
    /// (prepare_view),
    ///         there are too many views, or cycles_in_flight cycles are not yet retrieved
    Result<CycleHandle> submit(const std::vector<ViewRequest>& views);

    /// True if the cycle is rendered and not yet retrieved.
    [[nodiscard]] bool ready(CycleHandle cycle) const;

    /// Waits for a cycle and returns its views in the order of submit(). Each cycle can be retrieved once.
    Result<std::vector<DrawnView>> retrieve_views(CycleHandle cycle);
    /// Images of retrieve_views().
    Result<std::vector<Image<Rgba8>>> retrieve(CycleHandle cycle);

    [[nodiscard]] RenderSessionStatistics statistics() const;

    /// Objects submitted since the last call that the core renders because the board cannot: it does not support the
    /// object or a view of it, has no room, or failed. Each object is reported once, with the first reason. Objects
    /// that only wait for their load are not reported.
    std::vector<CoreFallback> take_fallbacks();

private:
    struct State;
    Result<ObjectHandle> load_checked(RaySpaceObject object);
    std::unique_ptr<State> state_;
};

}  // namespace rs::engine
