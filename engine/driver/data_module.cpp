#include "engine/driver/data_module.hpp"

#include "engine/core/renderer.hpp"
#include "rayspace/object_file.hpp"

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

struct PreparedView {
    std::shared_ptr<const Renderer> renderer;
    ViewRegisters registers;
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

}  // namespace

struct DataModule::State {
    DataModuleLimits limits;
    mutable std::mutex mutex;
    std::condition_variable changed;
    std::map<std::uint32_t, std::shared_ptr<const Renderer>> objects;
    std::map<std::uint64_t, std::shared_ptr<Cycle>> cycles;  // in the order of submission
    std::uint32_t last_object = 0;
    std::uint64_t last_cycle = 0;
    bool stopping = false;
    std::thread worker;

    std::shared_ptr<Cycle> next_cycle() const {
        for (const auto& [number, cycle] : cycles) {
            if (!cycle->done) return cycle;
        }
        return nullptr;
    }

    void work() {
        std::unique_lock lock(mutex);
        for (;;) {
            changed.wait(lock, [&] { return stopping || next_cycle() != nullptr; });
            if (stopping) return;
            const std::shared_ptr<Cycle> cycle = next_cycle();
            lock.unlock();
            try {
                for (const PreparedView& view : cycle->views) {
                    Image<Rgba8> picture(view.registers.width, view.registers.height);
                    view.renderer->render(view.registers, picture);
                    cycle->pictures.push_back(std::move(picture));
                }
            } catch (const std::exception& escaped) {  // such as std::bad_alloc for fifteen very large views
                cycle->failure = Error{std::string("the cycle could not be rendered: ") + escaped.what()};
            }
            cycle->views.clear();  // lets go of evicted objects
            lock.lock();
            cycle->done = true;
            changed.notify_all();
        }
    }
};

DataModule::DataModule(const DataModuleLimits& limits) : state_(std::make_unique<State>()) {
    state_->limits = limits;
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
    Result<Renderer> renderer = Renderer::create(std::move(object));
    if (!renderer) return renderer.error();
    const std::lock_guard lock(state_->mutex);
    if (state_->objects.size() >= static_cast<std::size_t>(state_->limits.objects)) {
        return Error{name + ": " + std::to_string(state_->limits.objects) +
                     " objects are loaded already; evict one first"};
    }
    const ObjectHandle handle{++state_->last_object};
    state_->objects.emplace(handle.number, std::make_shared<const Renderer>(std::move(*renderer)));
    return handle;
}

Status DataModule::evict(ObjectHandle object) {
    const std::lock_guard lock(state_->mutex);
    if (state_->objects.erase(object.number) == 0) return not_loaded(object);
    return {};
}

Result<std::shared_ptr<const RaySpaceObject>> DataModule::describe(ObjectHandle object) const {
    const std::lock_guard lock(state_->mutex);
    const auto found = state_->objects.find(object.number);
    if (found == state_->objects.end()) return not_loaded(object);
    return std::shared_ptr<const RaySpaceObject>(found->second, &found->second->object());
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
        Result<ViewRegisters> registers = prepare_view(found->second->object(), view.camera);
        if (!registers) return registers.error();
        cycle->views.push_back({found->second, std::move(*registers)});
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

}  // namespace rs::engine
