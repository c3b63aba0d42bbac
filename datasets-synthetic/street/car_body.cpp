#include "datasets-synthetic/street/car_body.hpp"

#include "datasets-synthetic/shapes/surfaces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace rs::synthetic {
namespace {

using glm::vec2;
using glm::vec3;

// Rows of a cross-section, from the sill over the roof's centre to the other sill.
constexpr int kBeltRow = 6;
constexpr int kGlassTopRow = 8;
constexpr int kScreenRow = 10;  // screens begin here, beside the pillars
constexpr int kCentreRow = 12;
constexpr int kRows = 2 * kCentreRow;
constexpr float kArchGap_m = 0.06F;
constexpr float kSeam_m = 0.012F;
constexpr int kEndColumns = 8;

// Heights of the rows below the belt as shares of its height, and their half-widths as shares of the body's.
constexpr std::array<vec2, 7> kSide{vec2{0, 0.95F},  {0.2F, 0.985F},  {0.42F, 1.0F}, {0.62F, 1.0F},
                                    {0.78F, 0.985F}, {0.92F, 0.965F}, {1.0F, 0.93F}};

bool is_inside(const std::vector<vec2>& ranges, float x) {
    return std::any_of(ranges.begin(), ranges.end(), [&](vec2 r) { return x > r.x && x < r.y; });
}

float linear_at(const Profile& profile, float x) {
    if (x <= profile.front().x) return profile.front().y;
    for (std::size_t i = 1; i < profile.size(); ++i) {
        const vec2 a = profile[i - 1];
        const vec2 b = profile[i];
        if (x < b.x) return a.y + (b.y - a.y) * (x - a.x) / (b.x - a.x);
    }
    return profile.back().y;
}

// Lower edge of the side: the sill, and arches around the wheels.
float lower_edge(const CarShape& shape, float x) {
    const float r = shape.wheel_radius + kArchGap_m;
    float edge = shape.sill;
    for (const float axle : shape.axles) {
        const float square = r * r - (x - axle) * (x - axle);
        if (square > 0) edge = std::max(edge, shape.wheel_radius + std::sqrt(square));
    }
    return edge;
}

// Positions of the cross-sections, ascending: where materials change, and further ones at some distance from these.
std::vector<float> stations_of(const CarShape& shape) {
    const float back = shape.roof.front().x;
    const float front = shape.roof.back().x;
    std::vector<float> stations{back, front};
    for (const auto& ranges : {shape.side_windows, shape.screens}) {
        for (const vec2 range : ranges) stations.insert(stations.end(), {range.x, range.y});
    }
    for (const float seam : shape.seams) stations.insert(stations.end(), {seam - kSeam_m / 2, seam + kSeam_m / 2});
    const auto add = [&](float x) {
        const bool is_near =
            std::any_of(stations.begin(), stations.end(), [&](float s) { return std::abs(s - x) < 0.03F; });
        if (!is_near && x > back && x < front) stations.push_back(x);
    };
    for (const float axle : shape.axles) {
        for (int i = 0; i <= 8; ++i) {
            const float c = portable::cos(portable::kPiF * static_cast<float>(i) / 8);
            add(axle + (shape.wheel_radius + kArchGap_m) * c);
        }
    }
    for (const float end : {0.035F, 0.09F}) {
        add(back + end);
        add(front - end);
    }
    const int steps = static_cast<int>((front - back) / 0.3F);
    for (int i = 1; i < steps; ++i) add(back + (front - back) * static_cast<float>(i) / static_cast<float>(steps));
    std::sort(stations.begin(), stations.end());
    return stations;
}

vec3 body_point(const CarShape& shape, float x, int row) {
    const bool other_side = row > kCentreRow;
    const int j = other_side ? kRows - row : row;
    const float width = profile_at(shape.width, x, shape.rounding_m);
    const float roof = profile_at(shape.roof, x, shape.rounding_m);
    const float belt = std::min(profile_at(shape.belt, x, shape.rounding_m), roof - 0.02F);
    const float crown = std::min(0.06F, 0.5F * (roof - belt));
    const float edge = roof - crown;
    const float belt_width = width * kSide.back().y;
    const float roof_width = belt_width - shape.lean * (edge - belt) - 0.02F;
    vec2 p;  // height, half-width
    if (j <= kBeltRow) {
        const vec2 side = kSide.at(static_cast<std::size_t>(j));
        const float height = shape.sill + side.x * (belt - shape.sill);
        const float lowest = lower_edge(shape, x) + 0.004F * static_cast<float>(j);
        p = {std::max(height, lowest), side.y * width};
    } else if (j <= kGlassTopRow) {
        const float share = j == kBeltRow + 1 ? 0.05F : 0.9F;
        p = glm::mix(vec2{belt, belt_width}, vec2{edge, roof_width}, share);
    } else {
        constexpr std::array<float, 4> kAcross{0.95F, 0.86F, 0.45F, 0};
        const float across = kAcross.at(static_cast<std::size_t>(j - kGlassTopRow - 1));
        p = {roof - crown * across * across * across * across, across * roof_width};
    }
    return {x, p.x, other_side ? -p.y : p.y};
}

std::string look_of_face(const CarShape& shape, const std::string& paint, float x, int row) {
    const int j = row < kCentreRow ? row : kRows - 1 - row;
    if (j == 0) return "trim";
    const bool at_seam = std::any_of(shape.seams.begin(), shape.seams.end(),
                                     [&](float seam) { return std::abs(x - seam) < kSeam_m / 2; });
    if (at_seam && j <= kBeltRow) return "grille";
    if (j > kBeltRow && j < kGlassTopRow && is_inside(shape.side_windows, x)) return shape.side_glass;
    if (j == kBeltRow && is_inside(shape.side_windows, x)) return "trim";
    if (j >= kScreenRow && is_inside(shape.screens, x)) return "car_glass";
    return paint;
}

// Appends the faces of a grid to one mesh per look; normals are smooth across looks.
void split_by_look(Pen& pen, const Grid& grid, const std::function<std::string(int column, int row)>& look) {
    capture::Mesh whole;
    append_grid(whole, grid);
    std::map<std::string, std::vector<glm::uvec3>> faces;
    for (const glm::uvec3& t : whole.triangles) {
        // The first corner of both triangles of a face is its lower left one (append_grid).
        const auto row = static_cast<int>(t.x) / (grid.columns + 1);
        const auto column = static_cast<int>(t.x) % (grid.columns + 1);
        faces[look(column, row)].push_back(t);
    }
    for (const auto& face : faces) {
        pen.surface(face.first, [&](capture::Mesh& mesh) {
            std::map<unsigned, unsigned> copied;
            const auto copy = [&](unsigned vertex) {
                const auto [entry, added] = copied.emplace(vertex, static_cast<unsigned>(mesh.positions.size()));
                if (added) {
                    mesh.positions.push_back(whole.positions[vertex]);
                    mesh.normals.push_back(whole.normals[vertex]);
                    mesh.uvs.push_back(whole.uvs[vertex]);
                }
                return entry->second;
            };
            for (const glm::uvec3& t : face.second) {
                const unsigned a = copy(t.x);
                const unsigned b = copy(t.y);
                mesh.triangles.emplace_back(a, b, copy(t.z));
            }
        });
    }
}

void build_shell(Pen& pen, const std::string& paint, const CarShape& shape) {
    const std::vector<float> stations = stations_of(shape);
    Grid grid(static_cast<int>(stations.size()) - 1, kRows);
    for (int row = 0; row <= kRows; ++row) {
        for (int i = 0; i <= grid.columns; ++i) {
            grid.positions[grid.index(i, row)] = body_point(shape, stations[static_cast<std::size_t>(i)], row);
        }
    }
    split_by_look(pen, grid, [&](int column, int row) {
        const auto i = static_cast<std::size_t>(column);
        return look_of_face(shape, paint, 0.5F * (stations[i] + stations[i + 1]), row);
    });
}

// Closes the shell: lines between mirrored points of its last cross-section, bulging outwards.
void build_end(Pen& pen, const std::string& paint, const CarShape& shape, bool front) {
    const float x = front ? shape.roof.back().x : shape.roof.front().x;
    Grid grid(kEndColumns, kCentreRow);
    for (int row = 0; row <= kCentreRow; ++row) {
        const vec3 side = body_point(shape, x, row);
        for (int i = 0; i <= kEndColumns; ++i) {
            const float t = 1 - 2 * static_cast<float>(i) / static_cast<float>(kEndColumns);
            const float z = front ? t * side.z : -t * side.z;
            const float bulge = 0.05F * (1 - t * t) * (row == kCentreRow ? 0.0F : 1.0F);
            grid.positions[grid.index(i, row)] = {x + (front ? bulge : -bulge), side.y, z};
        }
    }
    split_by_look(pen, grid, [&](int column, int row) -> std::string {
        const bool inner = column > 0 && column + 1 < kEndColumns;
        if (shape.glass_ends && row >= kBeltRow && row < kGlassTopRow && inner) return "car_glass";
        return row < 2 ? "trim" : paint;
    });
}

// A surface of revolution about the Z axis at `centre`, its profile given outwards along `side` * Z.
void turned(Pen& pen, const std::string& look, vec3 centre, float side, std::initializer_list<vec2> profile) {
    pen.surface(look, [&](capture::Mesh& mesh) {
        LatheStyle style;
        style.segments = 16;
        append_lathe(mesh, std::span<const vec2>(profile.begin(), profile.size()), style);
        const auto turn = [&](vec3 p) { return vec3{p.x, -side * p.z, side * p.y}; };
        for (vec3& p : mesh.positions) p = centre + turn(p);
        for (vec3& n : mesh.normals) n = turn(n);
    });
}

void build_wheel(Pen& pen, vec3 centre, float side, float r) {
    turned(pen, "tyre", centre, side,
           {{0.93F * r, -0.2F}, {r, -0.16F}, {r, -0.03F}, {0.95F * r, 0}, {0.66F * r, -0.01F}});
    turned(pen, "trim", centre, side, {{0.68F * r, -0.07F}, {0, -0.07F}});
    // Rim: a ring and five double spokes.
    turned(pen, "rim", centre, side, {{0.68F * r, -0.01F}, {0.6F * r, -0.03F}, {0.58F * r, -0.07F}});
    turned(pen, "rim", centre, side, {{0.17F * r, -0.05F}, {0.14F * r, -0.02F}, {0, -0.015F}});
    for (int i = 0; i < 5; ++i) {
        const float angle = portable::kTwoPiF * (static_cast<float>(i) + 0.25F) / 5;
        const vec3 out{portable::cos(angle), portable::sin(angle), 0};
        const vec3 across{-out.y, out.x, 0};
        const auto at = [&](float radius, float half, float depth) {
            return centre + r * (radius * out + half * across) + vec3(0, 0, side * depth);
        };
        std::array<vec3, 4> spoke{at(0.1F, -0.09F, -0.025F), at(0.62F, -0.065F, -0.028F), at(0.62F, 0.065F, -0.028F),
                                  at(0.1F, 0.09F, -0.025F)};
        if (side < 0) std::swap(spoke[1], spoke[3]);
        pen.quad("rim", spoke);
    }
}

}  // namespace

float profile_at(const Profile& profile, float x, float rounding_m) {
    constexpr int kSamples = 9;
    float sum = 0;
    for (int i = 0; i < kSamples; ++i) {
        sum += linear_at(profile, x + rounding_m * (2 * (static_cast<float>(i) + 0.5F) / kSamples - 1));
    }
    return sum / kSamples;
}

void build_car_body(Pen& pen, const std::string& paint, const CarShape& shape) {
    build_shell(pen, paint, shape);
    build_end(pen, paint, shape, true);
    build_end(pen, paint, shape, false);
    const float back = shape.roof.front().x + 0.1F;
    const float front = shape.roof.back().x - 0.1F;
    float half = 9;  // of the underbody, between the wheels
    for (const float axle : shape.axles) half = std::min(half, profile_at(shape.width, axle, shape.rounding_m));
    const float inner = half - 0.24F;
    pen.box("trim", {back, shape.sill - 0.02F, -inner}, {front, shape.sill + 0.12F, inner});
    for (const float axle : shape.axles) {
        const float r = shape.wheel_radius;
        pen.box("trim", {axle - r - 0.1F, shape.sill, -inner}, {axle + r + 0.1F, 2.2F * r, inner});
        for (const float side : {-1.0F, 1.0F}) build_wheel(pen, {axle, r, side * (half * 0.985F)}, side, r);
    }
}

}  // namespace rs::synthetic
