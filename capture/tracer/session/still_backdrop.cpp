#include "capture/tracer/session/still_backdrop.hpp"

#include "capture/tracer/scene/texture_lookup.hpp"
#include "capture/tracer/session/seeded_draws.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace rs::capture {

namespace {

// Random streams of the seed.
enum BackdropPurpose : std::uint64_t { kGrain = 20, kMarks = 21, kPlaster = 30 };

double lattice_value(std::int64_t x, std::int64_t y, std::uint64_t seed) {
    const std::uint64_t bits = mix_bits(
        seed ^ mix_bits(static_cast<std::uint64_t>(x) * 0x9E3779B97F4A7C15ULL ^ static_cast<std::uint64_t>(y)));
    return static_cast<double>(bits >> 11U) * 0x1p-52 - 1;
}

// Value noise, about -1..1, one feature per unit and two octaves finer.
double noise(glm::dvec2 p, std::uint64_t seed) {
    double sum = 0, strength = 0.6;
    for (int octave = 0; octave < 3; ++octave, p *= 2.03, strength *= 0.5) {
        const glm::dvec2 cell(std::floor(p.x), std::floor(p.y));
        const glm::dvec2 f = p - cell;
        const glm::dvec2 w = f * f * (3.0 - 2.0 * f);
        const auto x = static_cast<std::int64_t>(cell.x), y = static_cast<std::int64_t>(cell.y);
        const auto at = [&](int dx, int dy) {
            return lattice_value(x + dx, y + dy, seed + static_cast<unsigned>(octave));
        };
        sum += strength * glm::mix(glm::mix(at(0, 0), at(1, 0), w.x), glm::mix(at(0, 1), at(1, 1), w.x), w.y);
    }
    return sum;
}

// A soft-edged upright rectangle on the wall.
struct Mark {
    glm::dvec2 middle, half;
    glm::dvec3 tint;
};

// Wall and table intersect in a line parallel to the image plane at depth `edge_z` (negative: behind the axis).
struct StillRoom {
    double unit;  // scene units per noise feature
    double edge_z;
    double table_y;
    double disc_radius;
    std::vector<Mark> marks;
    std::uint64_t seed;

    [[nodiscard]] glm::dvec3 table(const glm::dvec3& p) const {
        const double grain = noise({p.x / unit * 1.2, p.z / unit * 6}, seed + kGrain) * 0.10;
        const double r = std::hypot(p.x, p.z);
        const double shade =
            disc_radius > 0 ? 0.5 * std::exp(-std::max(r - disc_radius, 0.0) / (0.12 * disc_radius)) : 0.0;
        return glm::dvec3(0.30, 0.24, 0.19) * ((1 + grain) * (1 - shade));
    }
    [[nodiscard]] glm::dvec3 wall(const glm::dvec2& q) const {
        glm::dvec3 colour = glm::dvec3(0.36, 0.37, 0.36) * (1 + 0.10 * noise(q / unit * 2.5, seed + kPlaster));
        for (const Mark& mark : marks) {
            const glm::dvec2 inside = (mark.half - glm::abs(q - mark.middle)) / (0.03 * unit);
            colour *= 1.0 + (mark.tint - 1.0) * (soft_step(inside.x) * soft_step(inside.y));
        }
        return colour;
    }
};

RgbaF opaque(const glm::dvec3& colour) {
    return {static_cast<float>(colour.r), static_cast<float>(colour.g), static_cast<float>(colour.b), 1};
}

}  // namespace

Image<RgbaF> wall_backdrop(const SessionPlan& plan, const Turntable& turntable, std::uint64_t seed) {
    const Lens& lens = plan.model.lens;
    const CameraPose& pose = plan.model.pose;
    const glm::dvec3 eye(0, plan.camera_height, plan.distance);
    const TableRays rays(lens, pose);
    const auto ray = [&](double x, double y) { return rays.through({x, y}).value_or(glm::dvec3(0, 0, -1)); };

    StillRoom room;
    room.unit = 0.25 * plan.distance;
    room.table_y = turntable.bottom();
    room.disc_radius = turntable.surface == DiscSurface::none ? 0 : turntable.radius;
    room.seed = seed;
    // The line lies in the upper third of the image, but always behind the disc and never beyond a few distances.
    const glm::dvec3 to_line = ray(lens.cx, 0.3 * lens.height);
    const double steep = to_line.y < 0 ? (room.table_y - eye.y) / to_line.y : 1e9;
    room.edge_z = std::clamp(eye.z + steep * to_line.z, -4 * plan.distance, -1.1 * turntable.reach() - 0.1 * room.unit);
    SeededDraws draws(seed, kMarks);
    for (int i = 0; i < 14; ++i) {
        Mark mark;
        mark.middle = {draws.uniform(-5, 5) * room.unit, room.table_y + draws.uniform(0.1, 3) * room.unit};
        mark.half = glm::dvec2(draws.uniform(0.08, 0.5), draws.uniform(0.08, 0.4)) * room.unit;
        mark.tint = {draws.uniform(0.75, 1.25), draws.uniform(0.75, 1.25), draws.uniform(0.75, 1.25)};
        room.marks.push_back(mark);
    }

    Image<RgbaF> image(lens.width, lens.height);
    for (int y = 0; y < lens.height; ++y) {
        for (int x = 0; x < lens.width; ++x) {
            const glm::dvec3 d = ray(x + 0.5, y + 0.5);
            const glm::dvec3 on_wall = eye + d * ((room.edge_z - eye.z) / std::min(d.z, -1e-3));
            const double share = soft_step((on_wall.y - room.table_y) / (0.02 * room.unit));  // of the wall
            glm::dvec3 colour = room.wall({on_wall.x, on_wall.y}) * share;
            if (share < 1) {
                const glm::dvec3 on_table = eye + d * ((room.table_y - eye.y) / std::min(d.y, -1e-3));
                colour += room.table(on_table) * (1 - share);
            }
            image(x, y) = opaque(colour);
        }
    }
    return image;
}

Image<RgbaF> uniform_backdrop(const Lens& lens, const glm::vec3& colour) {
    Image<RgbaF> image(lens.width, lens.height);
    const double corner2 = lens.cx * lens.cx + lens.cy * lens.cy;
    for (int y = 0; y < lens.height; ++y) {
        for (int x = 0; x < lens.width; ++x) {
            const glm::dvec2 v(x + 0.5 - lens.cx, y + 0.5 - lens.cy);
            image(x, y) = opaque(glm::dvec3(colour) * (1 - glm::dot(v, v) / corner2 / 7));
        }
    }
    return image;
}

Image<RgbaF> image_backdrop(const Lens& lens, Image<RgbaF> image) {
    const Texture texture{"backdrop", std::move(image)};
    constexpr int kSide = 4;  // samples along a pixel's side
    Image<RgbaF> result(lens.width, lens.height);
    for (int y = 0; y < lens.height; ++y) {
        for (int x = 0; x < lens.width; ++x) {
            glm::dvec3 sum(0);
            for (int i = 0; i < kSide * kSide; ++i) {
                const int column = i % kSide, row = i / kSide;
                const double u = (x + (column + 0.5) / kSide) / lens.width;
                const double v = 1 - (y + (row + 0.5) / kSide) / lens.height;
                const RgbaF p = sample_texture(texture, {static_cast<float>(u), static_cast<float>(v)});
                sum += glm::dvec3(p.r, p.g, p.b);
            }
            result(x, y) = opaque(sum / static_cast<double>(kSide * kSide));
        }
    }
    return result;
}

}  // namespace rs::capture
