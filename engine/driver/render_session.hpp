#pragma once
// The ray-space data module: the interface between an application and whatever renders (paper, section 6). Objects are
// loaded and evicted, views are requested a cycle at a time, images are handed out when they are ready.
//
// A *rendering cycle* is a list of views that are rendered together. Cycles wait in a queue and are rendered in order
// on threads of the module, so submit() does not block while an image is drawn.
//
// Two executors: the software core, which draws everything, and, if the module is given one, a board. The board's
// memory holds the objects that were requested last; the core draws what the board does not hold or cannot draw, at the
// same time, and stands in for the board when it fails. Either gives the same bits: with a board,
// objects that it takes are drawn as it holds them (Executor::as_rendered).
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
#include <vector>

namespace rs::engine {

struct ObjectHandle {
    std::uint32_t number = 0;  // 0 = none; numbers are never used twice
    bool operator==(const ObjectHandle&) const = default;
};

struct ViewRequest {
    ObjectHandle object;
    Camera camera;       // in the units of the object's rig
    bool depth = false;  // axial depth is needed too
};

struct CycleHandle {
    std::uint64_t number = 0;
};

struct RenderSessionLimits {
    int objects = 20;          // loaded at a time
    int views_per_cycle = 15;  // the board's; see model/limits/board_limits.hpp
    int cycles_in_flight = 2;  // queued, being rendered, or rendered and not yet retrieved: double buffering
};

// An object that costs nothing more to load: made beforehand, on whatever thread, for objects that must not keep one
// waiting.
struct PreparedObject {
    std::shared_ptr<const Renderer> renderer;         // not null
    std::shared_ptr<const RaySpaceObject> for_board;  // of the same object, RenderSession::as_board_draws(); or null
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
    ~RenderSession();  // waits for the cycle being rendered; drops queued ones
    RenderSession(const RenderSession&) = delete;
    RenderSession& operator=(const RenderSession&) = delete;

    // Reads, checks and prepares an object. Fails when the file does, or when too many are loaded.
    Result<ObjectHandle> load(const std::filesystem::path& path);
    Result<ObjectHandle> load(RaySpaceObject object);
    Result<ObjectHandle> load(PreparedObject object);

    // For a PreparedObject: where the module's board takes the object, a copy for it, and `object` becomes as the board
    // draws it; else null. The object has passed validate_object.
    [[nodiscard]] std::shared_ptr<const RaySpaceObject> as_board_draws(RaySpaceObject& object) const;

    [[nodiscard]] const RenderSessionLimits& limits() const;
    [[nodiscard]] bool has_board() const;

    // The object takes no new views; its memory goes when the cycles that use it are done.
    Status evict(ObjectHandle object);

    // Waits until the objects are in the board's memory, as far as they go there: for those who must see what it
    // draws from the first image on. Without a board, nothing happens. While nobody else submits.
    void load_on_board(const std::vector<ObjectHandle>& objects);

    // The object without its images, while it is loaded.
    Result<std::shared_ptr<const RaySpaceObject>> describe(ObjectHandle object) const;

    // Queues a cycle. Fails, with nothing queued, when a view's object is not loaded or its camera cannot be rendered
    // (prepare_view), when there are too many views, or when cycles_in_flight are already under way: retrieve one
    // first.
    Result<CycleHandle> submit(const std::vector<ViewRequest>& views);

    [[nodiscard]] bool ready(CycleHandle cycle) const;

    // Waits for a cycle and hands out its images, one per view in the order of submit(). Each cycle once.
    Result<std::vector<DrawnView>> retrieve_views(CycleHandle cycle);
    // The images alone.
    Result<std::vector<Image<Rgba8>>> retrieve(CycleHandle cycle);

    [[nodiscard]] RenderSessionStatistics statistics() const;

private:
    struct State;
    Result<ObjectHandle> load_checked(RaySpaceObject object);
    std::unique_ptr<State> state_;
};

}  // namespace rs::engine
