#include "compositor/viewer/showroom.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace rs::compositor {
namespace {

constexpr double kFade_s = 0.4;
constexpr std::size_t kObjectsOfBoard = 20;
constexpr double kPrediction_s = 2;           // of the eye position
constexpr double kVelocitySmoothing_s = 0.3;  // time constant

}  // namespace

std::int64_t default_memory_budget() {
    return std::int64_t{sysconf(_SC_PHYS_PAGES)} / 2 * sysconf(_SC_PAGESIZE);
}

Showroom::Showroom(const Scene& scene, const ShowroomOptions& options, std::unique_ptr<engine::Executor> board,
                   std::unique_ptr<ObjectSource> source)
    : plan_(scene),
      waits_(options.waits),
      board_name_(board ? board->traits().name : ""),
      engine_(std::make_shared<engine::RenderSession>(viewer_session_limits(), std::move(board))),
      nodes_(std::make_shared<DisplayedNodes>(scene.objects.size())),
      handles_(plan_.files().size()),
      core_warned_(plan_.files().size()),
      cache_(plan_.files(), source ? std::move(source) : make_file_source(engine_, !options.waits),
             options.memory_bytes) {
    for (const RaySpaceNode& node : scene.objects) scene_nodes_.push_back({node, std::nullopt, false});
}

Placeholder Showroom::placeholder_of(std::size_t node) const {
    const Node& of_scene = scene_nodes_[node];
    Placeholder placeholder;
    placeholder.world_from_object = world_from_node(of_scene.description.chain);
    if (of_scene.extent) {
        placeholder.bottom = of_scene.extent->bottom;
        placeholder.top = of_scene.extent->top;
    }
    if (of_scene.description.standing) {
        placeholder.top -= placeholder.bottom;
        placeholder.bottom = 0;
    }
    placeholder.progress = cache_.progress(plan_.file_of_node(node));
    return placeholder;
}

Status Showroom::add_loaded(const CacheEvent& event) {
    RS_ASSIGN_OR_RETURN(const engine::ObjectHandle handle, engine_->load(prepared(event.object)));
    handles_[event.file] = handle;
    for (std::size_t i = 0; i < scene_nodes_.size(); ++i) {
        if (plan_.file_of_node(i) != event.file) continue;
        DisplayedNode& node = (*nodes_)[i];
        scene_nodes_[i].extent = event.object->extent;
        node.object = place(event.object, scene_nodes_[i].description);
        node.handle = handle;
        node.opacity = waits_ ? 1 : 0;
    }
    return {};
}

void Showroom::evict(CacheEvent event) {
    for (std::size_t i = 0; i < scene_nodes_.size(); ++i) {
        if (plan_.file_of_node(i) != event.file) continue;
        (*nodes_)[i].object.reset();
        (*nodes_)[i].handle = {};
    }
    static_cast<void>(engine_->evict(std::exchange(handles_[event.file], {})));
    cache_.give_back(std::move(event.object));
}

Status Showroom::record_failure(const CacheEvent& event) {
    warnings_.push_back(event.why + "; shown without this object");
    for (std::size_t i = 0; i < scene_nodes_.size(); ++i) {
        if (plan_.file_of_node(i) != event.file) continue;
        scene_nodes_[i].failed = true;
        if (scene_nodes_[i].description.required) return Error{event.why};
    }
    return {};
}

Status Showroom::take_events() {
    for (CacheEvent& event : cache_.events()) {
        Status status;
        if (event.kind == CacheEvent::Kind::kLoaded)
            status = add_loaded(event);
        else if (event.kind == CacheEvent::Kind::kEvicting)
            evict(std::move(event));
        else
            status = record_failure(event);
        if (!status) return status;
    }
    return {};
}

Status Showroom::wait() {
    while (!cache_.settled()) {
        cache_.wait_for_events();
        RS_TRY(take_events());
    }
    return {};
}

Status Showroom::wait_for_all(const glm::dvec3& eye) {
    cache_.set_priorities(plan_.priorities({eye, eye}));
    return wait();
}

// Loads the objects of highest priority at `eye`, up to the capacity of a board.
void Showroom::load_on_board(const glm::dvec3& eye) {
    if (!engine_->has_board()) return;
    const std::vector<LoadPriority> priorities = plan_.priorities({eye, eye});
    std::vector<std::size_t> files;
    for (std::size_t file = 0; file < handles_.size(); ++file) {
        if (handles_[file].number != 0) files.push_back(file);
    }
    std::stable_sort(files.begin(), files.end(), [&](auto a, auto b) { return priorities[a] < priorities[b]; });
    files.resize(std::min(files.size(), kObjectsOfBoard));
    std::vector<engine::ObjectHandle> loaded;
    for (const std::size_t file : files) loaded.push_back(handles_[file]);
    engine_->load_on_board(loaded);
}

void Showroom::fade(double seconds) {
    for (std::size_t i = 0; i < nodes_->size(); ++i) {
        DisplayedNode& node = (*nodes_)[i];
        if (node.object) node.opacity = std::min(node.opacity + static_cast<float>(seconds / kFade_s), 1.0F);
        const bool has_placeholder = !(scene_nodes_[i].failed || (node.object && node.opacity >= 1));
        node.placeholder.reset();
        if (!has_placeholder) continue;
        node.placeholder = placeholder_of(i);
        if (node.object) node.placeholder->opacity = 1 - node.opacity;
    }
}

Status Showroom::update(const glm::dvec3& eye, double seconds, const std::optional<glm::dvec3>& destination) {
    if (eye_ && seconds > 0) {
        velocity_ += ((eye - *eye_) / seconds - velocity_) * (1 - std::exp(-seconds / kVelocitySmoothing_s));
    }
    eye_ = eye;
    const glm::dvec3 soon = destination.value_or(eye + velocity_ * kPrediction_s);
    if (waits_) {
        cache_.set_priorities(plan_.priorities({eye, eye}));
        priorities_taken_ = true;
    } else {
        priorities_taken_ = cache_.try_set_priorities(plan_.priorities({eye, soon}));
    }
    Status status = waits_ ? wait() : take_events();
    if (waits_) load_on_board(eye);
    fade(seconds);
    return status;
}

void Showroom::move_object(std::size_t node, const std::optional<TransformChain>& chain) {
    DisplayedNode& shown = (*nodes_)[node];
    shown.hidden = !chain;
    if (!chain) return;
    scene_nodes_[node].description.chain = *chain;
    if (shown.object) shown.object = place(shown.object->object, scene_nodes_[node].description);
}

std::string Showroom::absence(std::size_t node) const {
    if (scene_nodes_[node].failed) return "cannot be shown";
    const float progress = cache_.progress(plan_.file_of_node(node));
    return progress > 0 ? "being read" : "not in memory";
}

std::vector<PlacedObject> Showroom::placed() const {
    std::vector<PlacedObject> all;
    for (const DisplayedNode& node : *nodes_) {
        if (node.object) all.push_back(*node.object);
    }
    return all;
}

// A file that was evicted and read again has a new handle, so files are marked, not handles.
void Showroom::warn_of_core_objects() {
    for (const engine::CoreFallback& fallback : engine_->take_fallbacks()) {
        const auto handle = std::ranges::find(handles_, fallback.object);
        if (handle == handles_.end()) continue;  // evicted meanwhile
        const auto file = static_cast<std::size_t>(handle - handles_.begin());
        if (core_warned_[file]) continue;
        core_warned_[file] = true;
        warnings_.push_back(fallback.reason + "; drawn by the core, not by " + board_name_);
    }
}

std::vector<std::string> Showroom::take_warnings() {
    warn_of_core_objects();
    return std::exchange(warnings_, {});
}

}  // namespace rs::compositor
