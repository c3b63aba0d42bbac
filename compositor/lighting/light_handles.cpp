#include "compositor/lighting/light_handles.hpp"

#include "rayspace/light/light_model.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace rs::compositor {
namespace {

constexpr double kAxis_px = 80;
constexpr double kAim_px = 120;
constexpr double kArrow_px = 34;
constexpr double kShape_px = 46;
constexpr double kSun_px = 12;
constexpr double kNearest = 1e-3;  // minimum axial depth of visible strokes

constexpr double kDotReach_px = 11;
constexpr double kLineReach_px = 6;
constexpr float kThin_px = 1.6F;
constexpr float kThick_px = 2.4F;
constexpr glm::vec3 kSelected{1, 0.45F, 0.02F};
constexpr glm::vec3 kUnderPointer{1, 0.9F, 0.25F};
constexpr glm::vec3 kWhite{1};
constexpr std::array kAxisColours = {glm::vec3(0.9F, 0.05F, 0.05F), glm::vec3(0.1F, 0.65F, 0.05F),
                                     glm::vec3(0.08F, 0.2F, 1)};

double units_per_px(const glm::dvec3& place, const Camera& camera) {
    return std::max(glm::dot(place - camera.centre(), camera.forward()), kNearest) / camera.fl_x;
}

// The light's colour, scaled to a visible brightness.
glm::vec3 colour_of(const LightEntry& entry) {
    const glm::dvec3 colour = entry.radiance ? *entry.radiance * entry.colour : entry.colour;
    const double most = std::max({colour.x, colour.y, colour.z});
    if (!(most > 0)) return glm::vec3(0.3F);
    return glm::vec3(glm::mix(glm::dvec3(0.5), colour / most, 0.7));
}

// Builds the strokes of one light.
class Icon {
public:
    Icon(const LightEntry& entry, const Camera& camera, const glm::vec3& colour, float width_px)
        : entry_(entry),
          camera_(camera),
          place_(handle_position(entry, camera)),
          px_(units_per_px(place_, camera)),
          colour_(colour),
          width_px_(width_px) {
        dot(place_, 7);
        if (!model_of(entry).words.has_place) arrow(dome_of(camera).centre);
        const LightOutline outline = model_of(entry).outline(entry);
        if (outline.lines.empty()) {
            sun();
        } else {
            shape(outline);
        }
    }

    [[nodiscard]] const std::vector<HandleStroke>& strokes() const { return strokes_; }

private:
    void line(const glm::dvec3& from, const glm::dvec3& to) { strokes_.push_back({from, to, colour_, width_px_}); }
    void dot(const glm::dvec3& at, float width_px) { strokes_.push_back({at, at, colour_, width_px}); }

    void arrow(const glm::dvec3& to) {
        constexpr double kHead = 0.25;
        const glm::dvec3 way = to - place_;
        const glm::dvec3 aside = glm::cross(way, camera_.forward());
        line(place_, to);
        for (const double side : {-0.5, 0.5}) line(to, to - kHead * (way + side * aside));
    }

    void sun() {
        constexpr int kRays = 8;
        for (int i = 0; i < kRays; ++i) {
            const double turn = 2 * kPi * i / kRays;
            const glm::dvec3 out = std::cos(turn) * camera_.right() + std::sin(turn) * camera_.up();
            line(place_ + 0.55 * kSun_px * px_ * out, place_ + kSun_px * px_ * out);
        }
    }

    void shape(const LightOutline& outline) {
        const glm::dvec3 aim = unit_vector(entry_.aim);
        const AimedAxes axes = aimed_axes(aim, radians(entry_.turn_deg));
        const glm::dmat3 world_from_outline =
            (outline.to_scale ? 1 : kShape_px * px_) * glm::dmat3(axes.across, axes.along, aim);
        for (const std::vector<glm::dvec3>& points : outline.lines) {
            for (std::size_t i = 1; i < points.size(); ++i) {
                if (points[i] == points[i - 1]) continue;
                line(place_ + world_from_outline * points[i - 1], place_ + world_from_outline * points[i]);
            }
        }
        if (model_of(entry_).form == LightForm::kArea) arrow(place_ + kArrow_px * px_ * aim);
    }

    const LightEntry& entry_;
    const Camera& camera_;
    glm::dvec3 place_;
    double px_;  // scene units
    glm::vec3 colour_;
    float width_px_;
    std::vector<HandleStroke> strokes_;
};

// Distance from a position to a stroke on the screen, pixels; infinite for strokes behind the camera.
double distance_px(const HandleStroke& stroke, const Camera& camera, const glm::dvec2& at) {
    const glm::dvec3 a = camera.project(stroke.from);
    const glm::dvec3 b = camera.project(stroke.to);
    if (!(a.z > kNearest && b.z > kNearest)) return std::numeric_limits<double>::infinity();
    const glm::dvec2 from(a);
    const glm::dvec2 way = glm::dvec2(b) - from;
    const double length2 = glm::dot(way, way);
    const double t = length2 > 0 ? std::clamp(glm::dot(at - from, way) / length2, 0.0, 1.0) : 0.0;
    return glm::distance(at, from + t * way);
}

HandleStroke dot_at(const glm::dvec3& place) {
    return {place, place, kWhite, 1};
}

std::optional<HandlePart> part_at(const LightEntry& entry, const Camera& camera, const glm::dvec2& at_px) {
    if (const auto aim = aim_position(entry, camera)) {
        if (distance_px(dot_at(*aim), camera, at_px) <= kDotReach_px) return HandlePart::kAim;
    }
    if (!model_of(entry).words.has_place) return std::nullopt;
    const glm::dvec3 place = handle_position(entry, camera);
    std::optional<HandlePart> nearest;
    double least = kLineReach_px;
    for (const HandlePart axis : kAxisParts) {
        // Starts outside the body handle.
        const glm::dvec3 end = axis_end(entry, axis, camera);
        const double distance = std::min(distance_px({glm::mix(place, end, 0.2), end, kWhite, 1}, camera, at_px),
                                         distance_px(dot_at(end), camera, at_px) - kLineReach_px / 2);
        if (distance > least) continue;
        least = distance;
        nearest = axis;
    }
    return nearest;
}

}  // namespace

Dome dome_of(const Camera& camera) {
    constexpr double kDistance = 0.05;  // in front of the scene
    constexpr double kPlace = 0.16;     // distance from the image's top over its height
    constexpr double kSize = 0.09;
    return {camera.centre() + kDistance * camera.ray(0.5 * camera.width, kPlace * camera.height),
            kDistance * kSize * camera.height / camera.fl_y};
}

glm::dvec3 handle_position(const LightEntry& entry, const Camera& camera) {
    if (model_of(entry).words.has_place) return entry.location;
    const Dome dome = dome_of(camera);
    return dome.centre - dome.radius * unit_vector(entry.aim);
}

glm::dvec3 direction_of(HandlePart axis) {
    return {axis == HandlePart::kAxisX ? 1 : 0, axis == HandlePart::kAxisY ? 1 : 0, axis == HandlePart::kAxisZ ? 1 : 0};
}

glm::dvec3 axis_end(const LightEntry& entry, HandlePart axis, const Camera& camera) {
    return entry.location + kAxis_px * units_per_px(entry.location, camera) * direction_of(axis);
}

std::optional<glm::dvec3> aim_position(const LightEntry& entry, const Camera& camera) {
    if (const LightWords& words = model_of(entry).words; !words.has_place || !words.has_aim) return std::nullopt;
    return entry.location + kAim_px * units_per_px(entry.location, camera) * unit_vector(entry.aim);
}

std::vector<HandleStroke> light_strokes(const LightingState& state, std::optional<std::size_t> selected,
                                        const std::optional<HandleHit>& under_pointer, const Camera& camera) {
    std::vector<HandleStroke> strokes;
    const auto add_icon = [&](std::size_t i) {
        const bool is_selected = i == selected;
        const bool hovered = under_pointer && under_pointer->light == i && under_pointer->part == HandlePart::kBody;
        const LightEntry& entry = state.entries[i];
        const glm::vec3 colour = hovered ? kUnderPointer : is_selected ? kSelected : colour_of(entry);
        const Icon icon(entry, camera, colour, is_selected || hovered ? kThick_px : kThin_px);
        strokes.insert(strokes.end(), icon.strokes().begin(), icon.strokes().end());
    };
    for (std::size_t i = 0; i < state.entries.size(); ++i) {
        if (i != selected) add_icon(i);
    }
    if (!selected) return strokes;
    const LightEntry& entry = state.entries[*selected];
    const auto colour_of_part = [&](HandlePart part, const glm::vec3& usual) {
        return under_pointer == HandleHit{*selected, part} ? kUnderPointer : usual;
    };
    if (const auto aim = aim_position(entry, camera)) {
        const glm::vec3 colour = colour_of_part(HandlePart::kAim, kWhite);
        strokes.push_back({entry.location, *aim, colour, kThin_px});
        strokes.push_back({*aim, *aim, colour, 12});
    }
    if (model_of(entry).words.has_place) {
        for (std::size_t i = 0; i < 3; ++i) {
            const glm::dvec3 end = axis_end(entry, kAxisParts[i], camera);
            const glm::vec3 colour = colour_of_part(kAxisParts[i], kAxisColours[i]);
            strokes.push_back({entry.location, end, colour, 3.2F});
            strokes.push_back({end, end, colour, 11});
        }
    }
    add_icon(*selected);
    return strokes;
}

std::optional<HandleHit> handle_at(const LightingState& state, std::optional<std::size_t> selected,
                                   const Camera& camera, const glm::dvec2& at_px) {
    if (selected) {
        if (const auto part = part_at(state.entries[*selected], camera, at_px)) return HandleHit{*selected, *part};
    }
    std::optional<HandleHit> nearest;
    double least = kDotReach_px;
    const auto offer = [&](std::size_t i, double distance) {
        if (distance > least) return;
        least = distance;
        nearest = HandleHit{i, HandlePart::kBody};
    };
    for (std::size_t i = 0; i < state.entries.size(); ++i) {
        offer(i, distance_px(dot_at(handle_position(state.entries[i], camera)), camera, at_px));
    }
    if (nearest) return nearest;
    least = kLineReach_px;  // outlines of area lights are large
    for (std::size_t i = 0; i < state.entries.size(); ++i) {
        if (model_of(state.entries[i]).form != LightForm::kArea) continue;
        const Icon icon(state.entries[i], camera, kWhite, 1);
        for (const HandleStroke& stroke : icon.strokes()) offer(i, distance_px(stroke, camera, at_px));
    }
    return nearest;
}

}  // namespace rs::compositor
