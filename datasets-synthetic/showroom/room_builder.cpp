#include "datasets-synthetic/showroom/room_builder.hpp"

#include "datasets-synthetic/shapes/surfaces.hpp"
#include "rayspace/api/types/check.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/image/linear_light.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace rs::synthetic {

const std::vector<ObjectShape>& object_shapes() {
    static const std::vector<ObjectShape> kShapes = {{"vase", 3.375F, 0.6F},     {"flower", 2.611F, 0.36F},
                                                     {"doll", 1.969F, 0.75F},    {"lamp", 5.212F, 0.85F},
                                                     {"lattice", 1.938F, 0.55F}, {"blocks", 2.07F, 0.8F}};
    return kShapes;
}

const ObjectShape& object_shape(const std::string& name) {
    const std::vector<ObjectShape>& shapes = object_shapes();
    const auto found =
        std::find_if(shapes.begin(), shapes.end(), [&](const auto& shape) { return shape.name == name; });
    RS_CHECK(found != shapes.end());
    return *found;
}

namespace {

using glm::vec2;
using glm::vec3;

void append_triangle(capture::Mesh& mesh, const std::array<vec3, 3>& corners) {
    const auto first = static_cast<unsigned>(mesh.positions.size());
    const vec3 normal = glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
    for (const vec3& corner : corners) {
        mesh.positions.push_back(corner);
        mesh.normals.push_back(normal);
    }
    mesh.triangles.emplace_back(first, first + 1, first + 2);
}

void append_quad(capture::Mesh& mesh, const std::array<vec3, 4>& corners) {
    const auto first = static_cast<unsigned>(mesh.positions.size());
    const vec3 normal = glm::normalize(glm::cross(corners[2] - corners[0], corners[3] - corners[1]));
    for (const vec3& corner : corners) {
        mesh.positions.push_back(corner);
        mesh.normals.push_back(normal);
    }
    mesh.triangles.emplace_back(first, first + 1, first + 2);
    mesh.triangles.emplace_back(first, first + 2, first + 3);
}

// The sides of a box as sheets: front (+Z), right, back, left, bottom, top.
std::array<SheetFrame, 6> sides_of(vec3 low, vec3 high) {
    const vec3 x{high.x - low.x, 0, 0};
    const vec3 y{0, high.y - low.y, 0};
    const vec3 z{0, 0, high.z - low.z};
    return {{{low + z, x, y}, {low + x + z, -z, y}, {low + x, -x, y}, {low, z, y}, {low, x, z}, {low + y + z, x, -z}}};
}

}  // namespace

float foot_radius(const std::string& object, float height_m) {
    const ObjectShape& shape = object_shape(object);
    return height_m * shape.foot_radii / shape.height_radii;
}

void RoomBuilder::set_frame(vec3 origin, float turn_deg) {
    frame_ = {origin, rotation({0, 1, 0}, static_cast<float>(radians(static_cast<double>(turn_deg))))};
}

capture::Mesh& RoomBuilder::add(const std::string& look, int solid) {
    RS_CHECK(world_.looks.contains(look));
    world_.parts.push_back({room_, look, solid, {}});
    return world_.parts.back().mesh;
}

int RoomBuilder::next_solid() const {
    return static_cast<int>(world_.parts.size());
}

void RoomBuilder::transform_to_room(capture::Mesh& mesh, std::size_t first_vertex) const {
    for (std::size_t i = first_vertex; i < mesh.positions.size(); ++i) {
        mesh.positions[i] = frame_.point(mesh.positions[i]);
        mesh.normals[i] = frame_.direction(mesh.normals[i]);
    }
}

void RoomBuilder::face(capture::Mesh& mesh, const SheetFrame& place, vec2 uv_low, vec2 uv_high) const {
    const std::size_t first = mesh.positions.size();
    append_quad(mesh, {place.corner, place.corner + place.right, place.corner + place.right + place.up,
                       place.corner + place.up});
    mesh.uvs.insert(mesh.uvs.end(), {uv_low, {uv_high.x, uv_low.y}, uv_high, {uv_low.x, uv_high.y}});
    transform_to_room(mesh, first);
}

void RoomBuilder::append_grained(capture::Mesh& mesh, std::span<const SheetFrame> sides) const {
    // Every part uses another section of the wood texture.
    const float offset = static_cast<float>(world_.parts.size() % 64) * 0.37F;
    for (const SheetFrame& side : sides) {
        const vec2 size{glm::length(side.right), glm::length(side.up)};
        if (size.x >= size.y) {
            face(mesh, side, {offset, 0}, {offset + size.x, size.y});
            continue;
        }
        face(mesh, {side.corner + side.right, side.up, -side.right}, {offset, 0}, {offset + size.y, size.x});
    }
}

void RoomBuilder::painted_look(const std::string& name, vec2 size_m, float px_per_m, const Painter& painter,
                               Look look) {
    const auto pixels = [&](float side_m) {
        return std::clamp(static_cast<int>(std::ceil(side_m * px_per_m * texture_scale_)), 4, 2048);
    };
    Image<Rgba8> image(pixels(size_m.x), pixels(size_m.y));
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) {
            const vec2 share{(static_cast<float>(x) + 0.5F) / static_cast<float>(image.width()),
                             1.0F - (static_cast<float>(y) + 0.5F) / static_cast<float>(image.height())};
            const vec3 colour = painter(share * size_m);
            image(x, y) = {srgb8_from_linear(colour.x), srgb8_from_linear(colour.y), srgb8_from_linear(colour.z), 255};
        }
    }
    look.texture = name + ".png";
    RS_CHECK(!world_.textures.contains(look.texture));
    world_.textures[look.texture] = std::move(image);
    world_.looks[name] = std::move(look);
}

void RoomBuilder::box(const std::string& look, vec3 low, vec3 high) {
    RS_CHECK(low.x < high.x && low.y < high.y && low.z < high.z);
    capture::Mesh& mesh = add(look, next_solid());
    const auto sides = sides_of(low, high);
    append_grained(mesh, sides);
}

void RoomBuilder::box_with_top(const std::string& look, const std::string& top_name, vec3 low, vec3 high,
                               float px_per_m, const Painter& painter) {
    const int solid = next_solid();
    const auto sides = sides_of(low, high);
    capture::Mesh& mesh = add(look, solid);
    append_grained(mesh, std::span(sides).first(5));
    Look top_look = world_.looks.at(look);
    painted_look(top_name, {high.x - low.x, high.z - low.z}, px_per_m, painter, std::move(top_look));
    face(add(top_name, solid), sides[5], {0, 0}, {1, 1});
}

void RoomBuilder::soft_box(const std::string& look, vec3 low, vec3 high, float bevel) {
    const vec3 half = 0.5F * (high - low);
    RS_CHECK(bevel > 0 && bevel < half.x && bevel < half.y && bevel < half.z);
    const vec3 middle = 0.5F * (low + high);
    capture::Mesh& mesh = add(look, next_solid());
    // The corner of octant `signs` on the side perpendicular to `axis`.
    const auto corner = [&](vec3 signs, int axis) {
        vec3 p = half - bevel;
        p[axis] = half[axis];
        return middle + signs * p;
    };
    const auto sign = [](int bit) { return bit != 0 ? 1.0F : -1.0F; };
    for (int axis = 0; axis < 3; ++axis) {
        const int a = (axis + 1) % 3;
        const int b = (axis + 2) % 3;
        for (int side = 0; side < 2; ++side) {
            const auto at = [&](float sa, float sb) {
                vec3 signs;
                signs[axis] = sign(side);
                signs[a] = sa;
                signs[b] = sb;
                return corner(signs, axis);
            };
            std::array<vec3, 4> corners{at(-1, -1), at(1, -1), at(1, 1), at(-1, 1)};
            if (side == 0) std::swap(corners[1], corners[3]);
            append_quad(mesh, corners);
        }
        // The four bevels along this axis, between the sides across a and b.
        for (int k = 0; k < 4; ++k) {
            vec3 low_signs;
            low_signs[axis] = -1;
            low_signs[a] = sign(k & 1);
            low_signs[b] = sign(k & 2);
            vec3 high_signs = low_signs;
            high_signs[axis] = 1;
            std::array<vec3, 4> corners{corner(low_signs, a), corner(low_signs, b), corner(high_signs, b),
                                        corner(high_signs, a)};
            const vec3 normal = glm::cross(corners[2] - corners[0], corners[3] - corners[1]);
            if (glm::dot(normal, corners[0] - middle) < 0) std::swap(corners[1], corners[3]);
            append_quad(mesh, corners);
        }
    }
    for (int k = 0; k < 8; ++k) {
        const vec3 signs{sign(k & 1), sign(k & 2), sign(k & 4)};
        std::array<vec3, 3> corners{corner(signs, 0), corner(signs, 1), corner(signs, 2)};
        if (signs.x * signs.y * signs.z < 0) std::swap(corners[1], corners[2]);
        append_triangle(mesh, corners);
    }
    mesh.uvs.assign(mesh.positions.size(), vec2{0, 0});
    transform_to_room(mesh, 0);
}

void RoomBuilder::sheet(const std::string& look, const SheetFrame& place, vec2 uv_low, vec2 uv_high) {
    face(add(look, -1), place, uv_low, uv_high);
}

void RoomBuilder::painted_sheet(const std::string& name, const SheetFrame& place, float px_per_m,
                                const Painter& painter, Look look) {
    painted_look(name, {glm::length(place.right), glm::length(place.up)}, px_per_m, painter, std::move(look));
    sheet(name, place);
}

void RoomBuilder::lathe(const std::string& look, vec3 foot, std::initializer_list<vec2> profile, int segments,
                        float crease_rad) {
    capture::Mesh& mesh = add(look, next_solid());
    LatheStyle style;
    style.segments = segments;
    style.crease_rad = crease_rad;
    append_lathe(mesh, std::span<const vec2>(profile.begin(), profile.size()), style);
    for (vec3& p : mesh.positions) p += foot;
    transform_to_room(mesh, 0);
}

void RoomBuilder::tube(const std::string& look, std::span<const vec3> path, float radius, int sides) {
    capture::Mesh& mesh = add(look, next_solid());
    SweepStyle style;
    style.sides = sides;
    append_tube(mesh, path, std::span<const float>(&radius, 1), style);
    transform_to_room(mesh, 0);
}

void RoomBuilder::image_frame(const std::string& look, const SheetFrame& outer, std::span<const vec2> profile) {
    RS_CHECK(profile.size() >= 2);
    capture::Mesh& mesh = add(look, -1);
    const vec3 right = glm::normalize(outer.right);
    const vec3 up = glm::normalize(outer.up);
    const vec3 away = glm::cross(right, up);
    const std::array<vec3, 4> corners{outer.corner, outer.corner + outer.right, outer.corner + outer.right + outer.up,
                                      outer.corner + outer.up};
    const std::array<vec3, 4> inwards{right + up, up - right, -right - up, right - up};
    for (std::size_t i = 0; i < 4; ++i) {
        const std::size_t next = (i + 1) % 4;
        for (std::size_t j = 0; j + 1 < profile.size(); ++j) {
            const auto at = [&](std::size_t corner, vec2 p) {
                return corners[corner] + inwards[corner] * p.x + away * p.y;
            };
            append_quad(mesh,
                        {at(i, profile[j]), at(next, profile[j]), at(next, profile[j + 1]), at(i, profile[j + 1])});
        }
    }
    mesh.uvs.assign(mesh.positions.size(), vec2{0, 0});
    transform_to_room(mesh, 0);
}

void RoomBuilder::object(const std::string& name, vec3 foot, float turn_deg, float height_m) {
    const vec3 ahead = frame_.direction({0, 0, 1});
    const double frame_turn_deg = degrees(portable::atan2(static_cast<double>(ahead.x), static_cast<double>(ahead.z)));
    world_.objects.push_back({room_, name, frame_.point(foot), turn_deg + static_cast<float>(frame_turn_deg),
                              height_m / object_shape(name).height_radii});
}

}  // namespace rs::synthetic
