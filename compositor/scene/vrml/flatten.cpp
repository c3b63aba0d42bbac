#include "compositor/scene/vrml/flatten.hpp"

#include "compositor/scene/vrml/appearance.hpp"
#include "compositor/scene/vrml/node_conversion.hpp"
#include "compositor/scene/vrml/shapes.hpp"
#include "rayspace/base/printable.hpp"
#include "rayspace/file/file_reference.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace rs::compositor::vrml {
namespace {

constexpr int kMaxInlines = 16;  // nesting depth of Inline
constexpr std::size_t kMaxDraws = 100'000;
constexpr double kMaxWork = 1e9;  // sum of ShapeCheck::work over all shapes: about 10 s

struct LimitExceeded {};

class Flattener {
public:
    Flattener(const Loader& load, Scene& scene) : load_(load), scene_(scene) {}

    void walk_file(const std::shared_ptr<const LoadedFile>& file, const TraversalState& state) {
        open_files_.push_back(file);
        kept_files_.insert(file);
        if (warned_files_.insert(file.get()).second) {
            for (const std::string& warning : file->graph.warnings) warn(warning);
        }
        walk_children(file->graph.roots, state);
        open_files_.pop_back();
    }

    void finish() {
        if (more_warnings_ > 0) scene_.warnings.push_back("and " + std::to_string(more_warnings_) + " more warnings");
        scene_.viewpoints.insert(scene_.viewpoints.end(), inlined_viewpoints_.begin(), inlined_viewpoints_.end());
    }

private:
    [[nodiscard]] const std::filesystem::path& path() const { return open_files_.back()->path; }
    [[nodiscard]] std::filesystem::path folder() const { return path().parent_path(); }

    void warn(const std::string& text) {
        if (!warned_.insert(text).second) return;
        if (scene_.warnings.size() < 2 * kMaxWarnings) {
            scene_.warnings.push_back(printable(text));
        } else {
            ++more_warnings_;
        }
    }

    void warn(const Node& node, const std::string& what) {
        warn(path().string() + ": line " + std::to_string(node.line) + ": " + node.type + ": " + what);
    }

    // Lights that are not global apply to their siblings and everything below these.
    void walk_children(const std::vector<NodePointer>& children, TraversalState state) {
        for (const NodePointer& child : children) {
            if (!is_light(*child) || child->flag("global") || !child->flag("on")) continue;
            state.lights.push_back(static_cast<std::uint32_t>(scene_.lights.size()));
            scene_.lights.push_back(light_of(*child, state));
        }
        for (const NodePointer& child : children) walk(*child, state);
    }

    static bool is_light(const Node& node) {
        return node.type == "DirectionalLight" || node.type == "PointLight" || node.type == "SpotLight";
    }

    void walk(const Node& node, const TraversalState& above) {
        if (++visits_ > kMaxVisits || scene_.geometry.size() > kMaxDraws) throw LimitExceeded{};
        TraversalState state = above;
        if (++state.height > kMaxHeight) throw LimitExceeded{};
        const std::string& type = node.type;
        if (type == "Shape") return add_shape(node, state);
        if (type == "Transform" || type == "CADPart") {
            if (descend(node, state)) walk_children(node.field("children").nodes, state);
        } else if (type == "Switch") {
            const std::vector<NodePointer>& choice = node.field("choice").nodes;
            const double which = node.number("whichChoice");
            if (which >= 0 && which < static_cast<double>(choice.size())) {
                walk_children({choice[static_cast<std::size_t>(which)]}, state);
            }
        } else if (type == "LOD") {
            // Finest level.
            if (!node.field("level").nodes.empty()) walk_children({node.field("level").nodes.front()}, state);
        } else if (type == "Inline" || type == "InlineLoadControl") {
            if (node.flag("load")) include(node, state);
        } else if (type == "RaySpace") {
            add_object(node, state);
        } else if (type == "RaySpaceRoom") {
            walk_room(node, state);
        } else if (is_light(node)) {
            if (node.flag("on") && node.flag("global")) scene_.lights.push_back(light_of(node, state));
        } else if (type == "CADFace") {
            walk_children(node.field("shape").nodes, state);
        } else if (node.has("children")) {
            walk_children(node.field("children").nodes, state);
        } else {
            add_bindable(node, state);
        }
    }

    void add_shape(const Node& shape, const TraversalState& state) {
        const NodePointer geometry = shape.node("geometry");
        const std::shared_ptr<const Mesh> mesh = geometry ? mesh_of(*geometry) : nullptr;
        if (!mesh) return;
        const NodePointer appearance = shape.node("appearance");
        const auto key = std::pair(appearance.get(), mesh->topology);
        auto known = materials_.find(key);
        if (known == materials_.end()) {
            const Material material = material_of(appearance.get(), mesh->topology, folder(), images_,
                                                  [&](const Node& node, const std::string& what) { warn(node, what); });
            known = materials_.emplace(key, material).first;
        }
        scene_.geometry.push_back({mesh, known->second, state.world_from_node, state.lights});
    }

    // Null if there is nothing to draw.
    std::shared_ptr<const Mesh> mesh_of(const Node& given) {
        const auto [entry, is_new] = meshes_.emplace(&given, nullptr);
        if (!is_new) return entry->second;
        const NodePointer converted = to_vrml97(given);
        const Node& geometry = converted ? *converted : given;
        const ShapeCheck check = check_shape(geometry);
        if (!check.fault.empty()) {
            warn(geometry, check.fault + "; left out");
        } else if (work_ + check.work > kMaxWork) {
            warn(geometry, "its triangulation would take too long; left out");
        } else if (!check.empty) {
            work_ += check.work;
            for (const std::string& field : check.unusable) warn(geometry, field + " does not fit the shape; left out");
            entry->second = triangulate(geometry, check);
        }
        return entry->second;
    }

    void add_object(const Node& node, const TraversalState& state) {
        RaySpaceNode object;
        const std::vector<std::string>& urls = node.field("url").texts;
        const auto file = urls.empty() ? std::nullopt : resolve_reference(urls.front(), folder());
        if (!file) return warn(node, "has no url of a local file; left out");
        if (!(node.number("size") > 0)) return warn(node, "its size must be above 0; left out");
        if (!state.deviation.empty()) warn(node, state.deviation + "; drawn without");
        object.file = *file;
        object.chain = state.chain;
        NodeTransform size;
        size.scale = node.number("size");
        object.chain.push_back(size);
        object.standing = node.flag("standing");
        object.room = state.room;
        object.description = node.text("description").empty() ? node.name : node.text("description");
        scene_.objects.push_back(std::move(object));
    }

    void walk_room(const Node& node, TraversalState state) {
        const std::size_t room = scene_.rooms.size();
        const std::size_t geometry = scene_.geometry.size();
        const std::size_t objects = scene_.objects.size();
        scene_.rooms.push_back({node.text("description").empty() ? node.name : node.text("description"), {}});
        state.room = room;
        walk_children(node.field("children").nodes, state);
        const glm::dvec3 size = node.triple("bboxSize");
        const glm::dvec3 centre = node.triple("bboxCenter");
        const bool has_size = size.x >= 0 && size.y >= 0 && size.z >= 0;
        scene_.rooms[room].box =
            has_size ? BoundingBox{centre - size * 0.5, centre + size * 0.5}.moved(state.world_from_node)
                     : bounds_from(scene_, geometry, objects);
    }

    void add_bindable(const Node& node, const TraversalState& state) {
        if (node.type == "Viewpoint") {
            (state.inlined ? inlined_viewpoints_ : scene_.viewpoints).push_back(viewpoint_of(node, state));
            return;
        }
        if (state.inlined || bound_.contains(node.type)) return;
        if (node.type == "NavigationInfo") scene_.navigation = navigation_of(node, state);
        if (node.type == "Fog" && node.number("visibilityRange") > 0) scene_.fog = fog_of(node, state);
        if (node.type == "Background") {
            std::string fault;
            scene_.background = background_of(node, state, folder(), images_, fault);
            if (!fault.empty()) warn(node, fault + "; drawn without");
        }
        bound_.insert(node.type);
    }

    void include(const Node& node, const TraversalState& state) {
        if (open_files_.size() > kMaxInlines) return warn(node, "files include each other too deep; left out");
        const auto file = load_(node.field("url").texts, folder());
        if (!file) return warn(node, file.error().message + "; left out");
        for (const auto& open : open_files_) {
            if (open->path == (*file)->path) return warn(node, "the file includes itself; left out");
        }
        TraversalState inside = state;
        inside.inlined = true;
        walk_file(*file, inside);
    }

    const Loader& load_;
    Scene& scene_;
    SceneImages images_;
    std::map<std::pair<const Node*, Topology>, Material> materials_;
    std::vector<std::shared_ptr<const LoadedFile>> open_files_;
    std::map<const Node*, std::shared_ptr<const Mesh>> meshes_;
    double work_ = 0;
    std::set<std::shared_ptr<const LoadedFile>> kept_files_;  // keep the keys of materials_ and meshes_ valid
    std::set<const LoadedFile*> warned_files_;
    std::set<std::string> warned_;
    std::set<std::string> bound_;
    std::vector<Viewpoint> inlined_viewpoints_;
    double visits_ = 0;
    int more_warnings_ = 0;
};

}  // namespace

Status flatten(const std::shared_ptr<const LoadedFile>& file, const Loader& load, Scene& scene) {
    Flattener flattener(load, scene);
    try {
        flattener.walk_file(file, {});
    } catch (const LimitExceeded&) {
        return Error{file->path.string() + ": USE, PROTO and Inline expand to too many nodes; use them less"};
    }
    flattener.finish();
    return {};
}

}  // namespace rs::compositor::vrml
