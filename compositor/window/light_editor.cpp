#include "compositor/window/light_editor.hpp"

#include "compositor/lighting/light_warnings.hpp"
#include "compositor/scene/light/scene_lights.hpp"
#include "rayspace/base/printable.hpp"
#include "rayspace/file/input_file.hpp"
#include "rayspace/light/light_model.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rs::compositor {
namespace {

constexpr double kHandShakes_px = 4;
constexpr std::size_t kMaxFiles = 500;
constexpr double kLift = 5e-4;  // fraction of the scene's diagonal
constexpr double kAhead = 3;    // distance if no surface is in view, scene units

}  // namespace

LightEditor::LightEditor(const Scene& scene, double exposure_ev, const std::filesystem::path& profile_file)
    : profile(profile_file.string()),
      base_(std::make_shared<const Scene>(scene)),
      lit_(base_),
      edits_(state_of(lights_as_list(scene), exposure_ev)) {
    if (const BoundingBox box = bounds_of(scene); !box.empty()) {
        lift_ = std::clamp(kLift * glm::length(box.highest - box.lowest), 1e-6, 1e3);
    }
    std::filesystem::path folder = profile_file.parent_path();
    for (const LightEntry& entry : edits_.state().entries) {
        if (!entry.file.empty()) folder = entry.file.parent_path();
    }
    folder_ = folder.empty() ? "." : folder;
}

bool LightEditor::take_change() {
    const auto checked = std::pair(edits_.revision(), edits_.selected());
    if (!edits_.in_gesture() && warned_ != checked && open_) {
        warned_ = checked;
        warning_.clear();
        if (edits_.selected() && edits_.revision() == lit_revision_) {
            warning_ = light_warning(*lit_, *edits_.selected());
        } else if (edits_.selected()) {
            warned_.reset();  // warns once the scene is relit
        }
    }
    if (edits_.revision() == lit_revision_) return false;
    relight();
    return true;
}

void LightEditor::relight() {
    lit_revision_ = edits_.revision();
    auto lit = std::make_shared<Scene>(*base_);
    const Status added = add_lights(*lit, list_of(edits_.state()), profile);
    RS_CHECK(added.ok());  // checked by load()
    lit_ = std::move(lit);
}

void LightEditor::set_scene(const Scene& scene) {
    end_drag();
    edits_.end_gesture();
    base_ = std::make_shared<const Scene>(scene);
    warned_.reset();
    if (edits_.can_undo() || edits_.can_redo()) {
        relight();
        return;
    }
    edits_ = LightEdits(state_of(lights_as_list(scene), edits_.state().exposure_ev));
    lit_revision_ = saved_revision_ = edits_.revision();
    lit_ = base_;
}

void LightEditor::open(bool open) {
    open_ = open;
    if (open && files_.empty()) scan_folder(folder_);
    if (open) return;
    end_drag();
    edits_.end_gesture();  // if the panel is closed during a drag
}

void LightEditor::end_drag() {
    if (drag_) edits_.end_gesture();
    drag_.reset();
    grab_.reset();
    pressed_outside_.reset();
}

bool LightEditor::on_event(const Event& event, const EditorView& view) {
    if (!open_) return false;
    if (const auto* const move = std::get_if<MoveEvent>(&event)) {
        pointer_ = move->to_px;
        pointer_moved_ = true;
        return grab_.has_value();
    }
    if (std::holds_alternative<LostFocusEvent>(event)) {
        end_drag();
        return false;
    }
    const auto* const button = std::get_if<ButtonEvent>(&event);
    if (button == nullptr || button->button != Button::kLeft) return grab_.has_value() && button != nullptr;
    if (button->down) {
        pointer_ = button->at_px;
        const auto hit = handle_at(edits_.state(), edits_.selected(), view.camera, button->at_px);
        if (!hit) {
            pressed_outside_ = button->at_px;
            return false;
        }
        edits_.select(hit->light);
        grab_ = HandleGrab{*hit, button->at_px};
        return true;
    }
    if (grab_) {
        pointer_ = button->at_px;
        follow(view);
        end_drag();
        return true;
    }
    // Click outside of all handles.
    if (pressed_outside_ && glm::distance(*pressed_outside_, button->at_px) <= kHandShakes_px)
        edits_.select(std::nullopt);
    pressed_outside_.reset();
    return false;
}

void LightEditor::follow(const EditorView& view) {
    if (!grab_ || grab_->hit.light >= edits_.state().entries.size()) return;
    if (!drag_) {
        if (glm::distance(grab_->at_px, pointer_) <= kHandShakes_px) return;
        edits_.begin_gesture();
        drag_.emplace(edits_.state().entries[grab_->hit.light], grab_->hit.part, view.camera, grab_->at_px, lift_);
    }
    edits_.set_light(grab_->hit.light, drag_->to(pointer_, view.camera, view.surface));
}

void LightEditor::update(const EditorView& view) {
    if (!open_ || !std::exchange(pointer_moved_, false)) return;
    follow(view);
    hovered_ = grab_ ? std::optional(grab_->hit) : handle_at(edits_.state(), edits_.selected(), view.camera, pointer_);
}

bool LightEditor::on_key(Key command) {
    switch (command) {
        case Key::kLights:
            open(!open_);
            return true;
        case Key::kUndo:
            report(edits_.undo() ? "undone" : "nothing to undo");
            return true;
        case Key::kRedo:
            report(edits_.redo() ? "redone" : "nothing to redo");
            return true;
        case Key::kDelete:
            if (!open_) return true;
            end_drag();  // its index would be that of another light
            edits_.remove_selected();
            return true;
        case Key::kDuplicate:
            if (open_) edits_.duplicate({200 * lift_, 0, 0});
            return true;
        default:
            return false;
    }
}

std::vector<HandleStroke> LightEditor::strokes(const Camera& camera) const {
    return light_strokes(edits_.state(), edits_.selected(), hovered_, camera);
}

void LightEditor::add(LightKind kind, const EditorView& view) {
    const Camera& camera = view.camera;
    const glm::dvec2 middle(0.5 * camera.width, 0.5 * camera.height);
    const auto seen = view.surface(middle);
    const glm::dvec3 ahead = camera.ray(middle.x, middle.y);
    // Half-way to the visible surface, so that the light illuminates it and can be grabbed.
    const glm::dvec3 place = seen ? glm::mix(camera.centre(), seen->place, 0.5) : camera.centre() + kAhead * ahead;
    const LightWords& words = model_of(kind).words;
    LightEntry entry = new_light(kind, place);
    entry.name = free_light_name(edits_.state(), words.kind);
    if (words.has_file) {
        if (files_.empty()) {
            report(folder_.string() + ": has no .ies or .ldt file; choose another folder");
            return;
        }
        Result<Luminaire> read = read_luminaire(files_.front());
        if (!read) {
            report(read.error().message);
            return;
        }
        entry.file = files_.front();
        entry.luminaire = std::make_shared<const Luminaire>(std::move(*read));
    }
    edits_.add(std::move(entry));
}

// The scene with no other lights than those of the list.
Result<Scene> LightEditor::scene_with(LightList list, const std::string& from) const {
    Scene scene = *base_;
    list.replace = true;
    RS_TRY(add_lights(scene, std::move(list), from));
    return scene;
}

Status LightEditor::load() {
    RS_ASSIGN_OR_RETURN(LightList list, read_light_list(profile));
    RS_ASSIGN_OR_RETURN(const Scene tried, scene_with(list, profile));
    LightingState state = state_of(list, edits_.state().exposure_ev);
    if (!list.replace) {
        const LightingState& now = edits_.state();
        state.entries.insert(state.entries.begin(), now.entries.begin(), now.entries.end());
        state.headlight = state.headlight || now.headlight;
        if (!state.environment) state.environment = now.environment;
    }
    edits_.set(std::move(state));
    saved_revision_ = edits_.revision();
    const std::vector<std::string> warnings = light_warnings(tried);
    report(warnings.empty() ? profile + ": " + std::to_string(list.entries.size()) + " lights" : warnings.front());
    return {};
}

Status LightEditor::set_lights(const LightList& list, double exposure_ev, const std::string& from) {
    if (const Result<Scene> tried = scene_with(list, from); !tried) return tried.error();
    edits_.set(state_of(list, exposure_ev));
    return {};
}

Status LightEditor::save() {
    RS_TRY(write_light_list(list_of(edits_.state()), profile));
    saved_revision_ = edits_.revision();
    return {};
}

void LightEditor::scan_folder(const std::filesystem::path& folder) {
    folder_ = folder;
    files_.clear();
    std::error_code failed;
    std::filesystem::directory_iterator entries(folder, failed);
    for (; !failed && entries != std::filesystem::directory_iterator() && files_.size() < kMaxFiles;
         entries.increment(failed)) {
        const std::string ending = lower_case_extension(entries->path());
        if (ending == ".ies" || ending == ".ldt") files_.push_back(entries->path());
    }
    std::sort(files_.begin(), files_.end());
    if (failed) report(folder.string() + ": " + failed.message() + "; choose another folder");
}

Status LightEditor::use_file(const std::filesystem::path& file) {
    const auto selected = edits_.selected();
    if (!selected || !model_of(edits_.state().entries[*selected]).words.has_file) return {};
    RS_ASSIGN_OR_RETURN(Luminaire read, read_luminaire(file));
    LightEntry entry = edits_.state().entries[*selected];
    entry.file = file;
    entry.luminaire = std::make_shared<const Luminaire>(std::move(read));
    edits_.set_light(*selected, std::move(entry));
    return {};
}

std::string LightEditor::take_message() {
    return printable(std::exchange(news_, {}));
}

}  // namespace rs::compositor
