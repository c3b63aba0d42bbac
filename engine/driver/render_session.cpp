#include "engine/driver/render_session.hpp"

#include "engine/core/fast/renderer.hpp"
#include "rayspace/format/object_file.hpp"

#include <condition_variable>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>

namespace rs::engine {
namespace {

struct LoadedObject {
    std::shared_ptr<const Renderer> renderer;
    bool on_board = false;        // added to the board
    std::string not_on_board;     // why it was not, if the session has a board
    bool fallback_noted = false;  // in State::fallbacks, now or earlier
};

struct Cycle {
    std::vector<PreparedView> views;
    std::optional<Result<std::vector<DrawnView>>> drawn;  // empty until rendered
    bool claimed = false;                                 // a thread waits for it in retrieve()
};

Error not_loaded(ObjectHandle object) {
    return Error{"object " + std::to_string(object.number) + " is not loaded; load it first"};
}

// Fails, with the reason, if the board cannot render the view, now or later. Objects that wait for their load can be.
Status board_renders(const BoardThread& board, const ViewRequest& view, const LoadedObject& object,
                     const ViewRegisters& registers) {
    const std::string name = object.renderer->object().name + ": ";
    if (!object.on_board) return object.not_on_board.empty() ? Status() : Error{object.not_on_board};
    if (view.depth && !board.device().traits().depth) return Error{name + "the board gives no depth of pixels"};
    if (const Status can = board.device().can_render(registers); !can) return Error{name + can.error().message};
    return {};
}

}  // namespace

struct RenderSession::State {
    State(const RenderSessionLimits& its_limits, std::unique_ptr<Executor> device)
        : limits(its_limits), executor(std::move(device)) {}

    RenderSessionLimits limits;
    CycleExecutor executor;
    mutable std::mutex mutex;
    std::condition_variable changed;
    std::map<std::uint32_t, LoadedObject> objects;
    std::map<std::uint64_t, std::shared_ptr<Cycle>> cycles;  // in the order of submission
    std::uint32_t last_object = 0;
    std::uint64_t last_cycle = 0;
    RenderSessionStatistics statistics;
    std::vector<CoreFallback> fallbacks;  // not yet taken
    bool stopping = false;
    std::thread worker;

    std::shared_ptr<Cycle> next_cycle() const {
        for (const auto& [number, cycle] : cycles) {
            if (!cycle->drawn) return cycle;
        }
        return nullptr;
    }

    // Requires the mutex.
    void note_fallback(std::uint32_t number, std::string reason) {
        const auto found = objects.find(number);
        if (found == objects.end() || std::exchange(found->second.fallback_noted, true)) return;
        fallbacks.push_back({{number}, std::move(reason)});
    }

    [[nodiscard]] std::int64_t failed_cycles() const {
        return executor.board() == nullptr ? 0 : executor.board()->counts().failed_cycles;
    }

    // Notes the objects of a cycle in which the board failed. Requires the mutex.
    void note_board_failure(const std::vector<PreparedView>& views) {
        const std::string failure = executor.board()->counts().last_failure;
        for (const PreparedView& view : views) {
            if (!view.board_can_render) continue;
            note_fallback(view.object, view.renderer->object().name + ": the board failed: " + failure);
        }
    }

    void work() {
        std::unique_lock lock(mutex);
        for (;;) {
            changed.wait(lock, [&] { return stopping || next_cycle() != nullptr; });
            if (stopping) return;
            const std::shared_ptr<Cycle> cycle = next_cycle();
            lock.unlock();
            const std::int64_t failed_before = failed_cycles();
            Result<std::vector<DrawnView>> drawn = executor.draw(cycle->views);
            const bool board_failed = failed_cycles() > failed_before;
            std::vector<PreparedView> views = std::exchange(cycle->views, {});
            if (!board_failed) views.clear();  // releases evicted objects
            lock.lock();
            if (board_failed) note_board_failure(views);
            ++statistics.cycles;
            if (drawn) {
                for (const DrawnView& view : *drawn)
                    ++(view.by_board ? statistics.views_by_board : statistics.views_by_core);
            }
            cycle->drawn.emplace(std::move(drawn));
            changed.notify_all();
        }
    }
};

RenderSession::RenderSession(const RenderSessionLimits& limits, std::unique_ptr<Executor> board)
    : state_(std::make_unique<State>(limits, std::move(board))) {
    state_->worker = std::thread([state = state_.get()] { state->work(); });
}

RenderSession::~RenderSession() {
    {
        const std::lock_guard lock(state_->mutex);
        state_->stopping = true;
    }
    state_->changed.notify_all();
    state_->worker.join();
}

const RenderSessionLimits& RenderSession::limits() const {
    return state_->limits;
}

bool RenderSession::has_board() const {
    return state_->executor.board() != nullptr;
}

Result<ObjectHandle> RenderSession::load(const std::filesystem::path& path) {
    RS_ASSIGN_OR_RETURN(RaySpaceObject object, read_object(path));
    return load_checked(std::move(object));
}

Result<ObjectHandle> RenderSession::load(RaySpaceObject object) {
    RS_TRY(validate_object(object, object.name));
    return load_checked(std::move(object));
}

Result<ObjectHandle> RenderSession::load_checked(RaySpaceObject object) {
    const Result<std::shared_ptr<const RaySpaceObject>> for_board = convert_for_board(object);
    RS_ASSIGN_OR_RETURN(Renderer renderer, Renderer::create(std::move(object)));
    return load(PreparedObject{std::make_shared<const Renderer>(std::move(renderer)), for_board ? *for_board : nullptr,
                               for_board ? "" : for_board.error().message});
}

Result<std::shared_ptr<const RaySpaceObject>> RenderSession::convert_for_board(RaySpaceObject& object) const {
    const BoardThread* const board = state_->executor.board();
    if (board == nullptr) return std::shared_ptr<const RaySpaceObject>();
    RS_TRY(board->device().supports(object));
    object = board->device().as_rendered(std::move(object));
    return std::make_shared<const RaySpaceObject>(object);
}

Result<ObjectHandle> RenderSession::load(PreparedObject object) {
    RS_CHECK(object.renderer != nullptr);
    const std::lock_guard lock(state_->mutex);
    if (state_->objects.size() >= static_cast<std::size_t>(state_->limits.objects)) {
        return Error{object.renderer->object().name + ": " + std::to_string(state_->limits.objects) +
                     " objects are loaded already; evict one first"};
    }
    const ObjectHandle handle{++state_->last_object};
    BoardThread* const board = state_->executor.board();
    const bool on_board = board != nullptr && object.for_board != nullptr;
    state_->objects.emplace(handle.number,
                            LoadedObject{std::move(object.renderer), on_board, std::move(object.not_on_board)});
    if (on_board) board->add(handle.number, std::move(object.for_board));
    return handle;
}

void RenderSession::load_on_board(const std::vector<ObjectHandle>& objects) {
    BoardThread* const board = state_->executor.board();
    if (board == nullptr) return;
    std::vector<std::uint32_t> numbers;
    for (const ObjectHandle object : objects) numbers.push_back(object.number);
    board->request(numbers);
    board->wait_for_loads();
}

Status RenderSession::evict(ObjectHandle object) {
    const std::lock_guard lock(state_->mutex);
    if (state_->objects.erase(object.number) == 0) return not_loaded(object);
    if (BoardThread* const board = state_->executor.board()) board->remove(object.number);
    return {};
}

Result<std::shared_ptr<const RaySpaceObject>> RenderSession::describe(ObjectHandle object) const {
    const std::lock_guard lock(state_->mutex);
    const auto found = state_->objects.find(object.number);
    if (found == state_->objects.end()) return not_loaded(object);
    return std::shared_ptr<const RaySpaceObject>(found->second.renderer, &found->second.renderer->object());
}

Result<CycleHandle> RenderSession::submit(const std::vector<ViewRequest>& views) {
    if (views.size() > static_cast<std::size_t>(state_->limits.views_per_cycle)) {
        return Error{std::to_string(views.size()) + " views in one cycle, more than " +
                     std::to_string(state_->limits.views_per_cycle) + "; split them into cycles"};
    }
    const auto cycle = std::make_shared<Cycle>();
    const BoardThread* const board = state_->executor.board();
    std::vector<CoreFallback> refusals;
    const std::lock_guard lock(state_->mutex);
    for (const ViewRequest& view : views) {
        const auto found = state_->objects.find(view.object.number);
        if (found == state_->objects.end()) return not_loaded(view.object);
        const RaySpaceObject& object = found->second.renderer->object();
        const bool is_filtered = !found->second.on_board || board->device().traits().filters;
        Result<MixedView> prepared =
            prepare_mixed_view(object, view.camera, is_filtered ? std::nullopt : std::optional(TexelFilter::kBilinear));
        if (!prepared) return Error{object.name + ": " + prepared.error().message};
        const Status by_board =
            board == nullptr ? Status() : board_renders(*board, view, found->second, prepared->nearest);
        const bool board_can_render = board != nullptr && found->second.on_board && by_board.ok();
        if (!by_board) {
            refusals.push_back({view.object, by_board.error().message});
        } else if (board != nullptr) {
            const std::optional<std::string> refusal = board->load_refusal(view.object.number);
            if (refusal) refusals.push_back({view.object, object.name + ": " + *refusal});
        }
        cycle->views.push_back({.object = view.object.number,
                                .renderer = found->second.renderer,
                                .registers = std::move(prepared->nearest),
                                .second = std::move(prepared->second),
                                .weight_q8 = prepared->weight_q8,
                                .depth = view.depth,
                                .board_can_render = board_can_render,
                                .may_defer = view.may_defer});
    }
    if (state_->cycles.size() >= static_cast<std::size_t>(state_->limits.cycles_in_flight)) {
        return Error{std::to_string(state_->cycles.size()) + " cycles are not yet retrieved; retrieve one first"};
    }
    const CycleHandle handle{++state_->last_cycle};
    state_->cycles.emplace(handle.number, cycle);
    for (CoreFallback& refusal : refusals) state_->note_fallback(refusal.object.number, std::move(refusal.reason));
    state_->changed.notify_all();
    return handle;
}

bool RenderSession::ready(CycleHandle cycle) const {
    const std::lock_guard lock(state_->mutex);
    const auto found = state_->cycles.find(cycle.number);
    return found != state_->cycles.end() && found->second->drawn.has_value();
}

Result<std::vector<DrawnView>> RenderSession::retrieve_views(CycleHandle handle) {
    std::unique_lock lock(state_->mutex);
    const auto found = state_->cycles.find(handle.number);
    if (found == state_->cycles.end() || found->second->claimed) {
        return Error{"cycle " + std::to_string(handle.number) + " was never submitted or was retrieved already"};
    }
    const std::shared_ptr<Cycle> cycle = found->second;
    cycle->claimed = true;
    state_->changed.wait(lock, [&] { return cycle->drawn.has_value(); });
    state_->cycles.erase(handle.number);
    return std::move(*cycle->drawn);
}

Result<std::vector<Image<Rgba8>>> RenderSession::retrieve(CycleHandle handle) {
    RS_ASSIGN_OR_RETURN(std::vector<DrawnView> views, retrieve_views(handle));
    std::vector<Image<Rgba8>> images;
    for (DrawnView& view : views) images.push_back(std::move(view.image));
    return images;
}

std::vector<CoreFallback> RenderSession::take_fallbacks() {
    const std::lock_guard lock(state_->mutex);
    return std::exchange(state_->fallbacks, {});
}

RenderSessionStatistics RenderSession::statistics() const {
    const std::lock_guard lock(state_->mutex);
    RenderSessionStatistics statistics = state_->statistics;
    if (const BoardThread* const board = state_->executor.board()) statistics.board = board->counts();
    return statistics;
}

}  // namespace rs::engine
