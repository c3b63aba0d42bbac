#include "rayspace/api/renderer.hpp"

#include "engine/core/definition/mix_rings.hpp"
#include "engine/core/definition/view_registers.hpp"
#include "engine/core/fast/renderer.hpp"
#include "rayspace/api/internal/type_conversion.hpp"
#include "rayspace/base/result.hpp"

#include <mutex>
#include <utility>

namespace rs::api {
namespace {

std::optional<TexelFilter> filter_of(Filter filter) {
    switch (filter) {
        case Filter::kSharp:
            return TexelFilter::kSharp;
        case Filter::kBilinear:
            return TexelFilter::kBilinear;
        case Filter::kSmooth:
            return TexelFilter::kSmooth;
        case Filter::kAuto:
            break;
    }
    return std::nullopt;
}

}  // namespace

// One of `core` and `executor`.
struct Renderer::State {
    std::optional<Object> object;  // none where object() shares the core's
    std::optional<engine::Renderer> core;
    std::unique_ptr<Executor> executor;
    int slot = 0;
    mutable std::mutex one_at_a_time;

    [[nodiscard]] Status check(const ViewRegisters& registers, const RenderOptions& options) const {
        const ExecutorTraits& traits = executor->traits();
        if (options.depth && !traits.depth) return Error{"executor " + traits.name + ": renders no depth"};
        if (!traits.filters && registers.filter != TexelFilter::kBilinear) {
            return Error{"executor " + traits.name + ": has only the bilinear filter"};
        }
        if (!traits.tilted && !registers.upright()) {
            return Error{"executor " + traits.name + ": renders no views of tilted cameras"};
        }
        if (const Status status = executor->can_render(registers); !status) {
            return Error{"executor " + traits.name + ": " + status.error().message};
        }
        return {};
    }

    [[nodiscard]] Result<ExecutedView> execute(const ViewRegisters& registers, const RenderOptions& options) const {
        if (core) {
            ExecutedView view{Image<Rgba8>(registers.width, registers.height), {}};
            if (options.depth) view.depth_q20 = Image<std::int32_t>(registers.width, registers.height);
            core->render(registers, view.image, view.depth_q20);
            return view;
        }
        const std::lock_guard lock(one_at_a_time);
        RS_TRY(check(registers, options));
        RS_ASSIGN_OR_RETURN(std::vector<ExecutedView> views, executor->render({{slot, registers, options.depth}}));
        const bool complete = views.size() == 1 && views.front().image.width() == registers.width &&
                              views.front().image.height() == registers.height &&
                              (!options.depth || (views.front().depth_q20.width() == registers.width &&
                                                  views.front().depth_q20.height() == registers.height));
        if (!complete) return Error{"executor " + executor->traits().name + ": returned a view of another size"};
        return std::move(views.front());
    }
};

Renderer::Renderer(std::shared_ptr<State> state) : state_(std::move(state)) {}
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;
Renderer::~Renderer() = default;

Result<Renderer> Renderer::create(const Object& object, const RendererOptions& options) {
    if (options.decoded_budget_bytes < 0) return Error{"renderer: decoded_budget_bytes is negative"};
    RS_ASSIGN_OR_RETURN(
        engine::Renderer core,
        engine::Renderer::create(object.data(), {.decoded_budget_bytes = options.decoded_budget_bytes}));
    auto state = std::make_shared<State>();
    state->core.emplace(std::move(core));
    // The core keeps compressed photos, so object() can share its data; raw photos it converts and releases.
    if (object.data().coded == nullptr) state->object = object;
    return Renderer(std::move(state));
}

Result<Renderer> Renderer::create(const Object& object, std::unique_ptr<Executor> executor) {
    RS_CHECK(executor != nullptr);
    const std::string name = "executor " + executor->traits().name + ": ";
    if (!object.has_all_photos()) return Error{name + "photos are not loaded; open the object at level 3"};
    if (const Status status = executor->supports(object.data()); !status) return Error{name + status.error().message};
    const Result<std::optional<int>> slot = executor->load(object.data());
    if (!slot) return Error{name + slot.error().message};
    if (!slot->has_value()) return Error{name + "has no free memory for the object"};
    auto state = std::make_shared<State>();
    state->object = object;
    state->slot = **slot;
    state->executor = std::move(executor);
    return Renderer(std::move(state));
}

Object Renderer::object() const {
    if (state_->object) return *state_->object;
    return Object(std::shared_ptr<const RaySpaceObject>(state_, &state_->core->object()));
}

Result<RenderedView> Renderer::render(const Camera& camera, const RenderOptions& options) const {
    const RaySpaceObject& object = state_->core ? state_->core->object() : state_->object->data();
    const rs::Camera internal = to_internal(camera);
    std::optional<TexelFilter> filter = filter_of(options.filter);
    if (state_->executor && !state_->executor->traits().filters && !filter) filter = TexelFilter::kBilinear;
    RS_ASSIGN_OR_RETURN(const engine::MixedView prepared, engine::prepare_mixed_view(object, internal, filter));
    RS_ASSIGN_OR_RETURN(ExecutedView view, state_->execute(prepared.nearest, options));
    if (prepared.second) {
        RS_ASSIGN_OR_RETURN(const ExecutedView second, state_->execute(*prepared.second, options));
        engine::mix_rings(view.image, view.depth_q20, second.image, second.depth_q20, prepared.weight_q8);
    }
    RenderedView rendered{std::move(view.image), {}};
    if (options.depth) rendered.depth = engine::depth_image(object, internal, view.depth_q20);
    return rendered;
}

}  // namespace rs::api
