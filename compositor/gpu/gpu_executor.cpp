#include "compositor/gpu/gpu_executor.hpp"

#include "compositor/gl/context.hpp"
#include "compositor/gpu/gpu_object.hpp"
#include "compositor/gpu/gpu_renderer.hpp"
#include "compositor/gpu/object_textures.hpp"
#include "compositor/gpu/shader/texture_layout.hpp"

#include <algorithm>
#include <condition_variable>
#include <future>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace rs::compositor {
namespace {

constexpr std::int64_t kMebibyte = std::int64_t{1} << 20;

// Thread that runs one call at a time, for OpenGL contexts, which belong to a thread.
class CallThread {
public:
    CallThread() : thread_([this] { work(); }) {}
    CallThread(const CallThread&) = delete;
    CallThread& operator=(const CallThread&) = delete;
    ~CallThread() {
        hand_over(std::packaged_task<void()>());
        thread_.join();
    }

    /// Waits for the call; rethrows its exception.
    void call(const std::function<void()>& work) {
        std::packaged_task<void()> task(work);
        std::future<void> done = task.get_future();
        hand_over(std::move(task));
        done.get();
    }

private:
    void hand_over(std::packaged_task<void()> task) {
        const std::lock_guard lock(mutex_);
        next_.emplace(std::move(task));
        changed_.notify_one();
    }

    void work() {
        for (;;) {
            std::unique_lock lock(mutex_);
            changed_.wait(lock, [&] { return next_.has_value(); });
            std::packaged_task<void()> task = std::move(*next_);
            next_.reset();
            lock.unlock();
            if (!task.valid()) return;
            task();
        }
    }

    std::mutex mutex_;
    std::condition_variable changed_;
    std::optional<std::packaged_task<void()>> next_;  // one that is not valid ends the thread
    std::thread thread_;
};

// Everything that lives on the thread of the context.
struct GpuState {
    gl::Context context;
    GpuRenderer renderer;
    gl::TextureLimits limits;

    static Result<std::unique_ptr<GpuState>> open(const GpuExecutorOptions& options) {
        RS_ASSIGN_OR_RETURN(gl::Context context, gl::Context::create_surfaceless());
        RS_ASSIGN_OR_RETURN(GpuRenderer renderer, GpuRenderer::create({.memory_bytes = options.memory_bytes}));
        const gl::TextureLimits limits = gl::texture_limits();
        return std::make_unique<GpuState>(GpuState{std::move(context), std::move(renderer), limits});
    }
};

// Memory that an object needs in any case.
std::int64_t least_bytes(const RaySpaceObject& object) {
    return gpu_bytes(object, std::min(static_cast<int>(object.views.size()), kMinPhotoLayers));
}

class GpuExecutor final : public engine::Executor {
public:
    explicit GpuExecutor(const GpuExecutorOptions& options) : options_(options) {}
    ~GpuExecutor() override {
        thread_.call([&] { state_.reset(); });
    }

    Status open() {
        Status opened;
        thread_.call([&] {
            Result<std::unique_ptr<GpuState>> state = GpuState::open(options_);
            if (state) {
                state_ = std::move(*state);
                limits_ = state_->limits;
            } else {
                opened = state.error();
            }
        });
        return opened;
    }

    [[nodiscard]] const engine::ExecutorTraits& traits() const override { return traits_; }

    [[nodiscard]] Status supports(const RaySpaceObject& object) const override {
        RS_TRY(check_texture_limits(object, kMinPhotoLayers, limits_.side, limits_.layers));
        const std::int64_t bytes = least_bytes(object);
        if (bytes <= options_.memory_bytes) return {};
        return Error{object.name + ": needs " + std::to_string(bytes / kMebibyte) +
                     " MiB of GPU memory, more than the limit of " + std::to_string(options_.memory_bytes / kMebibyte) +
                     "; encode it with smaller photos"};
    }

    Result<std::optional<int>> load(const RaySpaceObject& object) override {
        RS_TRY(supports(object));
        const std::int64_t bytes = least_bytes(object);
        if (used_bytes_ + bytes > options_.memory_bytes) return std::optional<int>();
        RS_ASSIGN_OR_RETURN(std::shared_ptr<const GpuObject> loaded, GpuObject::create(object));
        used_bytes_ += bytes;
        objects_[next_slot_] = std::move(loaded);
        return std::optional<int>(next_slot_++);
    }

    Status evict(int slot) override {
        const auto found = objects_.find(slot);
        if (found == objects_.end()) return {};
        used_bytes_ -= least_bytes(found->second->object());
        objects_.erase(found);
        return {};
    }

    Result<std::vector<engine::ExecutedView>> render(const std::vector<engine::SlotView>& views) override {
        std::vector<engine::ExecutedView> drawn;
        for (const engine::SlotView& view : views) {
            const auto found = objects_.find(view.slot);
            if (found == objects_.end()) return engine::no_object_in(view.slot);
            RS_ASSIGN_OR_RETURN(engine::ExecutedView image,
                                view.may_defer ? defer(found->second, view) : draw(found->second, view));
            drawn.push_back(std::move(image));
        }
        return drawn;
    }

private:
    [[nodiscard]] Result<engine::ExecutedView> defer(const std::shared_ptr<const GpuObject>& object,
                                                     const engine::SlotView& view) const {
        auto deferred = std::make_shared<DeferredGpuView>();
        deferred->object = object;
        deferred->registers = view.registers;
        deferred->memory_bytes = options_.memory_bytes;
        return engine::ExecutedView{.image = {}, .depth_q20 = {}, .deferred = std::move(deferred)};
    }

    Result<engine::ExecutedView> draw(const std::shared_ptr<const GpuObject>& object, const engine::SlotView& view) {
        Result<engine::ExecutedView> drawn = engine::ExecutedView();
        thread_.call([&] { drawn = state_->renderer.render(object, view.registers, view.depth); });
        return drawn;
    }

    GpuExecutorOptions options_;
    engine::ExecutorTraits traits_{.name = "gpu"};
    gl::TextureLimits limits_;
    std::map<int, std::shared_ptr<const GpuObject>> objects_;  // by slot
    std::int64_t used_bytes_ = 0;                              // least_bytes() of the objects
    int next_slot_ = 0;
    CallThread thread_;
    std::unique_ptr<GpuState> state_;  // used and destroyed on thread_
};

}  // namespace

Result<std::unique_ptr<engine::Executor>> create_gpu_executor(const GpuExecutorOptions& options) {
    auto executor = std::make_unique<GpuExecutor>(options);
    RS_TRY(executor->open());
    return std::unique_ptr<engine::Executor>(std::move(executor));
}

engine::ExecutorTable executors_with_gpu() {
    engine::ExecutorTable table;
    const Status added = table.add({"gpu", "", [](const std::string&) { return create_gpu_executor(); }});
    RS_CHECK(added.ok());
    return table;
}

}  // namespace rs::compositor
