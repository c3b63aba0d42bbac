#include "compositor/scene/light/lights_file.hpp"
#include "compositor/scene/reader/scene_file.hpp"
#include "compositor/sequence/frames_file.hpp"
#include "compositor/sequence/model_library.hpp"
#include "compositor/sequence/sequence.hpp"
#include "rayspace/base/printable.hpp"
#include "rayspace/file/input_file.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <set>
#include <utility>

namespace rs::compositor {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxMeshesOfFrames = 1000;  // distinct meshes
constexpr std::size_t kMaxMovingNodes = 100'000;

// Resolved reference of an instance line.
struct ResolvedReference {
    const Model* model = nullptr;
    const ModelObject* object = nullptr;
    const Material* material = nullptr;  // null: the object's own
    fs::path file;                       // of a ray-space object, instead of the other members
};

bool is_object_file(const std::string& id) {
    return lower_case_extension(id) == ".rso";
}

class SequenceReader {
public:
    explicit SequenceReader(SequenceFiles files) : files_(std::move(files)) {}

    Result<Sequence> read() {
        sequence_.name = name_of_map();
        sequence_.frames_per_second = files_.frames_per_second;
        sequence_.weather = files_.weather;
        for (const fs::path& path : files_.models) {
            RS_ASSIGN_OR_RETURN(const ExtendedObj parsed, read_extended_obj(path));
            RS_ASSIGN_OR_RETURN(const Model* model, model_of(path, parsed));
            models_.push_back(model);
        }
        RS_TRY(read_base());
        RS_TRY(read_surroundings());
        for (const fs::path& path : files_.frames) {
            RS_TRY(read_frame(path));
        }
        add_static_objects();
        return std::move(sequence_);
    }

private:
    // NAME of maps/NAME/anim/out/frames.json, else the name of the folder or file.
    [[nodiscard]] std::string name_of_map() const {
        const fs::path file = fs::absolute(files_.file).lexically_normal();
        if (file.extension() == ".obj") return file.stem().string();
        fs::path folder = file.parent_path();
        if (folder.filename() == "out") folder = folder.parent_path();
        if (folder.filename() == "anim") folder = folder.parent_path();
        return folder.filename().string();
    }

    // Reads files with the same mesh once.
    Result<const Model*> model_of(const fs::path& path, const ExtendedObj& parsed) {
        std::string libraries;  // relative to the file's folder
        for (const NamedLine& library : parsed.libraries)
            libraries += (path.parent_path() / library.name).string() + '\n';
        auto& known = read_[{parsed.mesh_digest, libraries}];
        if (known) return known.get();
        if (read_.size() > kMaxMeshesOfFrames) {
            return Error{printable(path.string()) + ": exceeds the limit of meshes, " +
                         std::to_string(kMaxMeshesOfFrames) +
                         "; put static meshes into the base, moving ones into models"};
        }
        Result<Model> model = read_model_objects(path, parsed);
        if (!model) {
            read_.erase({parsed.mesh_digest, libraries});
            return model.error();
        }
        std::vector<std::string>& warnings = sequence_.scene.warnings;
        warnings.insert(warnings.end(), model->warnings.begin(), model->warnings.end());
        known = std::make_unique<Model>(std::move(*model));
        return known.get();
    }

    Status read_base() {
        if (!files_.base) {
            sequence_.scene.floor = Floor{};
        } else if (lower_case_extension(*files_.base) != ".obj") {
            RS_ASSIGN_OR_RETURN(Scene scene, read_scene(*files_.base));
            scene.warnings.insert(scene.warnings.end(), sequence_.scene.warnings.begin(),
                                  sequence_.scene.warnings.end());
            sequence_.scene = std::move(scene);
        } else {
            RS_ASSIGN_OR_RETURN(const ExtendedObj parsed, read_extended_obj(*files_.base));
            if (!parsed.objects.empty()) {
                RS_ASSIGN_OR_RETURN(const Model* model, model_of(*files_.base, parsed));
                base_ = model;
            }
            sequence_.camera = parsed.camera;
            for (const InstanceLine& line : parsed.instances) {
                RS_ASSIGN_OR_RETURN(const ResolvedReference named, find(*files_.base, line, base_));
                add_static(named, line.pose);
            }
        }
        sequence_.scene.shading = Shading::kPhong;
        return {};
    }

    Status read_surroundings() {
        if (files_.background) sequence_.scene.background = *files_.background;
        if (files_.haze_m) {
            const glm::vec3 horizon = background_colour(sequence_.scene.background, {1, 0.02, 0});
            sequence_.scene.fog = Fog{FogKind::kExponential, horizon, *files_.haze_m};
        }
        if (!files_.lights) return {};
        RS_ASSIGN_OR_RETURN(LightList list, read_light_list(*files_.lights));
        Scene& scene = sequence_.scene;
        // Replaces the default light of formats without lights.
        if (list.replace || !files_.base || lower_case_extension(*files_.base) == ".obj") scene.lights.clear();
        scene.lights.insert(scene.lights.end(), list.lights.begin(), list.lights.end());
        if (list.environment) scene.environment = std::move(list.environment);
        return {};
    }

    Status read_frame(const fs::path& path) {
        RS_ASSIGN_OR_RETURN(const ExtendedObj parsed, read_extended_obj(path));
        const Model* own = nullptr;
        if (!parsed.objects.empty()) {
            RS_ASSIGN_OR_RETURN(const Model* model, model_of(path, parsed));
            own = model;
        }
        poses_ += parsed.instances.size();
        if (poses_ > kMaxPoses) {
            return Error{printable(path.string()) + ": has too many instances; a sequence may have " +
                         std::to_string(kMaxPoses) + " instances in all"};
        }
        SequenceFrame frame;
        frame.camera = parsed.camera;
        taken_.clear();
        std::set<const ModelObject*> instanced;
        for (const InstanceLine& line : parsed.instances) {
            RS_ASSIGN_OR_RETURN(const ResolvedReference named, find(path, line, own));
            instanced.insert(named.object);
            const std::optional<std::uint32_t> slot = slot_of(named, line.material, line.pose);
            if (!slot) return limit_error(path);
            frame.poses.push_back({*slot, false, line.pose});
        }
        // Objects of the frame's file without an instance line keep their position.
        for (std::size_t i = 0; own != nullptr && i < own->objects.size(); ++i) {
            const ModelObject& object = own->objects[i];
            if (instanced.contains(&object) || object.parts.empty()) continue;
            const std::optional<std::uint32_t> slot = slot_of({own, &object, nullptr, {}}, "-", {});
            if (!slot) return limit_error(path);
            frame.poses.push_back({*slot, true, {}});
            if (!files_.base) sequence_.scene.floor.reset();  // the default floor would hide such a ground
        }
        sequence_.frames.push_back(std::move(frame));
        return {};
    }

    static Error limit_error(const fs::path& path) {
        return Error{printable(path.string()) + ": shows more than " + std::to_string(kMaxMovingNodes) +
                     " parts at once; make objects of fewer materials"};
    }

    // Resolves the object of a line: in its own file, then in the models, then in the base; indices refer to the first
    // of these that has objects.
    Result<ResolvedReference> find(const fs::path& path, const InstanceLine& line, const Model* own) {
        const auto line_error = [&](const std::string& what) {
            return Error{printable(path.lexically_normal().string()) + ":" + std::to_string(line.line) + ": " + what};
        };
        if (is_object_file(line.id)) return find_object_file(path, line);
        std::vector<const Model*> places;
        if (own != nullptr) places.push_back(own);
        places.insert(places.end(), models_.begin(), models_.end());
        if (base_ != nullptr && base_ != own) places.push_back(base_);
        ResolvedReference named;
        const std::optional<std::size_t> number = parse_index(line.id);
        std::size_t before = 0;  // number of objects in the previous models
        for (const Model* const model : places) {
            if (number && model != own && own != nullptr) break;
            if (number) {
                if (*number >= before && *number - before < model->objects.size()) {
                    named.object = &model->objects[*number - before];
                }
                before += model->objects.size();
            } else {
                named.object = model->object(line.id);
            }
            named.model = model;
            if (named.object != nullptr) break;
        }
        if (named.object == nullptr) {
            return line_error("there is no object '" + printable(line.id) + "'" +
                              (number ? " (there are " + std::to_string(before) + ", counted from 0)" : "") +
                              "; correct the name, or add its file to \"models\"");
        }
        if (line.material != "-" && line.material != "-1") {
            named.material = named.model->material(line.material);
            if (named.material == nullptr) {
                return line_error("there is no material '" + printable(line.material) + "' (there are " +
                                  std::to_string(named.model->materials.size()) +
                                  ", counted from 0); correct it, or give - for the object's own");
            }
        }
        if (base_ != nullptr && named.model == base_) instanced_in_base_.insert(named.object);
        return named;
    }

    static Result<ResolvedReference> find_object_file(const fs::path& path, const InstanceLine& line) {
        const auto line_error = [&](const std::string& what) {
            return Error{printable(path.lexically_normal().string()) + ":" + std::to_string(line.line) + ": " + what};
        };
        const glm::dvec3& scale = line.pose.scale;
        if (scale.x != scale.y || scale.y != scale.z || scale.x < 0) {
            return line_error("a ray-space object keeps its shape; give it three equal scales above 0");
        }
        ResolvedReference named;
        named.file = path.parent_path() / line.id;
        std::error_code error;
        if (!fs::is_regular_file(named.file, error)) {
            return line_error("there is no object " + printable(named.file.lexically_normal().string()) +
                              "; make it with rs-encode build, or correct the name");
        }
        return named;
    }

    // Adds the object's nodes, with the material of the line if given.
    void add_nodes(const ResolvedReference& named, std::optional<std::uint32_t> moving) {
        for (GeometryNode node : named.object->parts) {
            if (named.material != nullptr) node.material = *named.material;
            node.moving = moving;
            sequence_.scene.geometry.push_back(std::move(node));
        }
    }

    RaySpaceNode object_node(const fs::path& file, const InstancePose& pose) const {
        RaySpaceNode node;
        node.file = file;
        node.description = file.stem().string();
        NodeTransform transform = NodeTransform::of(turn_matrix(pose.turn_deg), pose.scale.x);
        transform.translation = pose.move;
        node.chain = {transform};
        return node;
    }

    void add_static(const ResolvedReference& named, const InstancePose& pose) {
        Scene& scene = sequence_.scene;
        if (named.object == nullptr) {
            scene.objects.push_back(object_node(named.file, pose));
            return;
        }
        const std::size_t first = scene.geometry.size();
        add_nodes(named, std::nullopt);
        const glm::dmat4 matrix = instance_matrix(pose, named.object->box.middle());
        for (std::size_t i = first; i < scene.geometry.size(); ++i) {
            scene.geometry[i].world_from_node = matrix * scene.geometry[i].world_from_node;
        }
    }

    // Next free slot of the object, created if necessary.
    std::optional<std::uint32_t> slot_of(const ResolvedReference& named, const std::string& material,
                                         const InstancePose& pose) {
        const std::pair key(static_cast<const void*>(named.object),
                            named.object == nullptr ? named.file.string() : material);
        std::vector<std::uint32_t>& slots = slots_[key];
        const std::size_t number = taken_[key]++;
        if (number < slots.size()) return slots[number];
        SequenceSlot slot;
        Scene& scene = sequence_.scene;
        if (named.object == nullptr) {
            slot.object = scene.objects.size();
            scene.objects.push_back(object_node(named.file, pose));
        } else {
            slot.middle = named.object->box.middle();
            const std::size_t first = scene.geometry.size();
            add_nodes(named, static_cast<std::uint32_t>(sequence_.slots.size()));
            for (std::size_t i = first; i < scene.geometry.size(); ++i) slot.geometry.push_back(i);
            moving_ += scene.geometry.size() - first;
        }
        if (moving_ > kMaxMovingNodes) return std::nullopt;
        sequence_.slots.push_back(std::move(slot));
        slots.push_back(static_cast<std::uint32_t>(sequence_.slots.size() - 1));
        return slots.back();
    }

    // Adds the objects of the base without instance lines.
    void add_static_objects() {
        if (base_ == nullptr) return;
        for (const ModelObject& object : base_->objects) {
            if (instanced_in_base_.contains(&object)) continue;
            add_nodes({base_, &object, nullptr, {}}, std::nullopt);
        }
    }

    SequenceFiles files_;
    Sequence sequence_;
    std::map<std::pair<std::uint64_t, std::string>, std::unique_ptr<Model>> read_;
    std::vector<const Model*> models_;
    const Model* base_ = nullptr;
    std::set<const ModelObject*> instanced_in_base_;
    std::map<std::pair<const void*, std::string>, std::vector<std::uint32_t>> slots_;
    std::map<std::pair<const void*, std::string>, std::size_t> taken_;  // used slots of the current frame
    std::size_t poses_ = 0;
    std::size_t moving_ = 0;
};

}  // namespace

Result<Sequence> read_sequence(const fs::path& folder) {
    RS_ASSIGN_OR_RETURN(SequenceFiles files, find_sequence(folder));
    return SequenceReader(std::move(files)).read();
}

}  // namespace rs::compositor
