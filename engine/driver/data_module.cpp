#include "engine/driver/data_module.hpp"

#include "engine/core/renderer.hpp"
#include "rayspace/object_file.hpp"

#include <chrono>
#include <condition_variable>
#include <exception>
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
    bool on_board = false;  // known to the board
};

struct PreparedView {
    std::uint32_t object = 0;
    std::shared_ptr<const Renderer> renderer;
    ViewRegisters registers;
    bool board_draws = false;  // if it holds the object
    [[nodiscard]] std::int64_t pixels() const { return std::int64_t{registers.width} * registers.height; }
};

struct Cycle {
    std::vector<PreparedView> views;
    std::vector<Image<Rgba8>> pictures;
    std::optional<Error> failure;  // instead of pictures
    bool done = false;
    bool claimed = false;  // somebody waits in retrieve() for it
};

Error not_loaded(ObjectHandle object) {
    return Error{"object " + std::to_string(object.number) + " is not loaded; load it before asking for its views"};
}

// Seconds per pixel of an executor, as seen lately.
class Pace {
public:
    void saw(std::int64_t pixels, double seconds) {
        if (pixels <= 0) return;
        const double now = seconds / static_cast<double>(pixels);
        per_pixel_ = per_pixel_ == 0 ? now : 0.8 * per_pixel_ + 0.2 * now;
    }
    [[nodiscard]] double of(std::int64_t pixels) const { return per_pixel_ * static_cast<double>(pixels); }

private:
    double per_pixel_ = 0;
};

double seconds_since(std::chrono::steady_clock::time_point begin) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

struct DataModule::State {
    DataModuleLimits limits;
    Sharing sharing = Sharing::kBoardFirst;
    std::unique_ptr<BoardThread> board;  // none: the core draws everything
    mutable std::mutex mutex;
    std::condition_variable changed;
    std::map<std::uint32_t, LoadedObject> objects;
    std::map<std::uint64_t, std::shared_ptr<Cycle>> cycles;  // in the order of submission
    std::uint32_t last_object = 0;
    std::uint64_t last_cycle = 0;
    DataModuleStatistics statistics;
    bool stopping = false;
    Pace board_pace;  // of the worker alone
    Pace core_pace;
    std::thread worker;

    std::shared_ptr<Cycle> next_cycle() const {
        for (const auto& [number, cycle] : cycles) {
            if (!cycle->done) return cycle;
        }
        return nullptr;
    }

    // The views, by their places in the cycle, that the board is to draw. The board is reserved.
    std::vector<std::size_t> share_of_board(const std::vector<PreparedView>& views) {
        std::vector<std::size_t> share;
        std::int64_t by_board = 0;
        std::int64_t by_core = 0;
        for (const PreparedView& view : views) by_core += view.pixels();
        for (std::size_t v = 0; v < views.size(); ++v) {
            if (!views[v].board_draws || !board->holds(views[v].object)) continue;
            if (share.size() == static_cast<std::size_t>(board->device().views_per_cycle())) break;
            const std::int64_t pixels = views[v].pixels();
            if (sharing == Sharing::kBalanced && !share.empty() &&
                board_pace.of(by_board + pixels) > core_pace.of(by_core - pixels)) {
                continue;
            }
            share.push_back(v);
            by_board += pixels;
            by_core -= pixels;
        }
        return share;
    }

    // Whatever is not on the board is loaded behind the cycle that it draws now.
    void want_objects(const std::vector<PreparedView>& views) {
        std::vector<std::uint32_t> wanted;
        for (const PreparedView& view : views) {
            if (view.board_draws) wanted.push_back(view.object);
        }
        board->want(wanted);
    }

    static Image<Rgba8> render_by_core(const PreparedView& view) {
        Image<Rgba8> picture(view.registers.width, view.registers.height);
        view.renderer->render(view.registers, picture);
        return picture;
    }

    // How many views each executor drew.
    struct Drawn {
        std::int64_t by_board = 0;
        std::int64_t by_core = 0;
    };
    Drawn draw(Cycle& cycle) {
        const bool reserved = board && board->reserve();
        std::vector<std::size_t> share = reserved ? share_of_board(cycle.views) : std::vector<std::size_t>();
        std::vector<bool> of_board(cycle.views.size());
        std::vector<BoardThread::Asked> asked;
        std::int64_t board_pixels = 0;
        for (const std::size_t v : share) {
            of_board[v] = true;
            asked.push_back({cycle.views[v].object, cycle.views[v].registers});
            board_pixels += cycle.views[v].pixels();
        }
        const auto begin = std::chrono::steady_clock::now();
        if (reserved) board->draw(std::move(asked));
        if (board) want_objects(cycle.views);
        cycle.pictures.resize(cycle.views.size());
        std::int64_t core_pixels = 0;
        std::optional<Error> failure;
        try {
            for (std::size_t v = 0; v < cycle.views.size(); ++v) {
                if (of_board[v]) continue;
                cycle.pictures[v] = render_by_core(cycle.views[v]);
                core_pixels += cycle.views[v].pixels();
            }
        } catch (const std::exception& escaped) {  // such as std::bad_alloc for fifteen very large views
            failure = Error{std::string("the cycle could not be rendered: ") + escaped.what()};
        }
        core_pace.saw(core_pixels, seconds_since(begin));
        if (!share.empty()) {
            Result<std::vector<Image<Rgba8>>> drawn = board->wait();
            board_pace.saw(board_pixels, seconds_since(begin));
            if (drawn) {
                for (std::size_t n = 0; n < share.size(); ++n) cycle.pictures[share[n]] = std::move((*drawn)[n]);
            } else if (!failure) {  // the core stands in
                for (const std::size_t v : share) cycle.pictures[v] = render_by_core(cycle.views[v]);
                share.clear();
            }
        }
        cycle.failure = failure;
        return {static_cast<std::int64_t>(share.size()), static_cast<std::int64_t>(cycle.views.size() - share.size())};
    }

    void work() {
        std::unique_lock lock(mutex);
        for (;;) {
            changed.wait(lock, [&] { return stopping || next_cycle() != nullptr; });
            if (stopping) return;
            const std::shared_ptr<Cycle> cycle = next_cycle();
            lock.unlock();
            const Drawn drawn = draw(*cycle);
            cycle->views.clear();  // lets go of evicted objects
            lock.lock();
            ++statistics.cycles;
            statistics.views_by_board += drawn.by_board;
            statistics.views_by_core += drawn.by_core;
            cycle->done = true;
            changed.notify_all();
        }
    }
};

DataModule::DataModule(const DataModuleLimits& limits, std::unique_ptr<BoardDevice> board, Sharing sharing)
    : state_(std::make_unique<State>()) {
    state_->limits = limits;
    state_->sharing = sharing;
    if (board) state_->board = std::make_unique<BoardThread>(std::move(board));
    state_->worker = std::thread([state = state_.get()] { state->work(); });
}

DataModule::~DataModule() {
    {
        const std::lock_guard lock(state_->mutex);
        state_->stopping = true;
    }
    state_->changed.notify_all();
    state_->worker.join();
}

Result<ObjectHandle> DataModule::load(const std::filesystem::path& path) {
    Result<RaySpaceObject> object = read_object(path);
    if (!object) return object.error();
    return load(std::move(*object));
}

Result<ObjectHandle> DataModule::load(RaySpaceObject object) {
    const std::string name = object.name;
    if (const Status status = validate_object(object, name); !status) return status.error();
    std::shared_ptr<const RaySpaceObject> for_board;
    if (state_->board && state_->board->device().takes(object)) {
        object = state_->board->device().as_drawn(std::move(object));
        for_board = std::make_shared<const RaySpaceObject>(object);
    }
    Result<Renderer> renderer = Renderer::create(std::move(object));
    if (!renderer) return renderer.error();
    const std::lock_guard lock(state_->mutex);
    if (state_->objects.size() >= static_cast<std::size_t>(state_->limits.objects)) {
        return Error{name + ": " + std::to_string(state_->limits.objects) +
                     " objects are loaded already; evict one first"};
    }
    const ObjectHandle handle{++state_->last_object};
    state_->objects.emplace(handle.number,
                            LoadedObject{std::make_shared<const Renderer>(std::move(*renderer)), for_board != nullptr});
    if (for_board) state_->board->add(handle.number, std::move(for_board));
    return handle;
}

Status DataModule::evict(ObjectHandle object) {
    const std::lock_guard lock(state_->mutex);
    if (state_->objects.erase(object.number) == 0) return not_loaded(object);
    if (state_->board) state_->board->remove(object.number);
    return {};
}

Result<std::shared_ptr<const RaySpaceObject>> DataModule::describe(ObjectHandle object) const {
    const std::lock_guard lock(state_->mutex);
    const auto found = state_->objects.find(object.number);
    if (found == state_->objects.end()) return not_loaded(object);
    return std::shared_ptr<const RaySpaceObject>(found->second.renderer, &found->second.renderer->object());
}

Result<CycleHandle> DataModule::submit(const std::vector<ViewRequest>& views) {
    if (views.size() > static_cast<std::size_t>(state_->limits.views_per_cycle)) {
        return Error{std::to_string(views.size()) + " views in one cycle, more than " +
                     std::to_string(state_->limits.views_per_cycle) + "; split them into cycles"};
    }
    const auto cycle = std::make_shared<Cycle>();
    const std::lock_guard lock(state_->mutex);
    for (const ViewRequest& view : views) {
        const auto found = state_->objects.find(view.object.number);
        if (found == state_->objects.end()) return not_loaded(view.object);
        Result<ViewRegisters> registers = prepare_view(found->second.renderer->object(), view.camera);
        if (!registers) return registers.error();
        const bool board_draws =
            state_->board && found->second.on_board && state_->board->device().draws(*registers).ok();
        cycle->views.push_back({view.object.number, found->second.renderer, std::move(*registers), board_draws});
    }
    if (state_->cycles.size() >= static_cast<std::size_t>(state_->limits.cycles_in_flight)) {
        return Error{std::to_string(state_->cycles.size()) + " cycles are under way; retrieve one first"};
    }
    const CycleHandle handle{++state_->last_cycle};
    state_->cycles.emplace(handle.number, cycle);
    state_->changed.notify_all();
    return handle;
}

bool DataModule::ready(CycleHandle cycle) const {
    const std::lock_guard lock(state_->mutex);
    const auto found = state_->cycles.find(cycle.number);
    return found != state_->cycles.end() && found->second->done;
}

Result<std::vector<Image<Rgba8>>> DataModule::retrieve(CycleHandle handle) {
    std::unique_lock lock(state_->mutex);
    const auto found = state_->cycles.find(handle.number);
    if (found == state_->cycles.end() || found->second->claimed) {
        return Error{"cycle " + std::to_string(handle.number) + " was never submitted or is retrieved already"};
    }
    const std::shared_ptr<Cycle> cycle = found->second;
    cycle->claimed = true;
    state_->changed.wait(lock, [&] { return cycle->done; });
    state_->cycles.erase(handle.number);
    if (cycle->failure) return *cycle->failure;
    return std::move(cycle->pictures);
}

DataModuleStatistics DataModule::statistics() const {
    const std::lock_guard lock(state_->mutex);
    DataModuleStatistics statistics = state_->statistics;
    if (state_->board) statistics.board = state_->board->counts();
    return statistics;
}

}  // namespace rs::engine
