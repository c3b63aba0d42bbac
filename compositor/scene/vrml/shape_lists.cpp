// Checks of geometry nodes.

#include "compositor/scene/vrml/shapes.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace rs::compositor::vrml {
namespace {

constexpr double kMaxGridPoints = 1 << 20;
constexpr std::size_t kMaxCorners = 4096;      // of one face, or of an extrusion's cross-section
constexpr std::size_t kMaxText_bytes = 20000;  // per Text

// Measured costs in units of 10 ns: per corner; per pair of corners of a possibly concave face; per pair of faces at a
// point with smoothed normals; per grid and extrusion point; per byte of text.
constexpr double kCornerWork = 100;
constexpr double kConcaveWork = 0.7;
constexpr double kSmoothWork = 1;
constexpr double kGridWork = 4000;
constexpr double kExtrusionWork = 8000;
constexpr double kTextWork = 8500;

std::size_t count_in(const NodePointer& node, std::string_view field, std::size_t numbers_each) {
    return node ? node->field(field).numbers.size() / numbers_each : 0;
}

// Processes index lists face by face.
class ListValidator {
public:
    ListValidator(const Node& shape, std::size_t least_corners)
        : shape_(shape), indices_(shape.field("coordIndex").numbers), least_(least_corners) {}

    ShapeCheck fit() {
        ShapeCheck check;
        const std::size_t points = count_in(shape_.node("coord"), "point", 3);
        for (std::size_t begin = 0; begin < indices_.size();) {
            std::size_t end = begin;
            while (end < indices_.size() && indices_[end] >= 0) ++end;
            for (std::size_t i = begin; i < end; ++i) {
                if (indices_[i] < static_cast<double>(points)) continue;
                check.fault = "coordIndex names point " + std::to_string(static_cast<long>(indices_[i])) + " of " +
                              std::to_string(points);
                return check;
            }
            if (end - begin > kMaxCorners) {
                check.fault = "a face of " + std::to_string(end - begin) + " corners; at most " +
                              std::to_string(kMaxCorners) + " can be drawn";
                return check;
            }
            faces_.push_back({begin, end});
            begin = end + 1;
        }
        check.lists.coord = spread([&](std::size_t i) { return indices_[i]; });
        check.empty = check.lists.coord.empty();
        const bool is_face = least_ == 3;
        check.work = is_face ? face_work(points) : kCornerWork * static_cast<double>(indices_.size());
        fit_list("color", "colorIndex", shape_.flag("colorPerVertex"), count_in(shape_.node("color"), "color", 3),
                 check.lists.color, check.unusable);
        if (!is_face) return check;
        fit_list("normal", "normalIndex", shape_.flag("normalPerVertex"), count_in(shape_.node("normal"), "vector", 3),
                 check.lists.normal, check.unusable);
        fit_list("texCoord", "texCoordIndex", true, count_in(shape_.node("texCoord"), "point", 2), check.lists.texture,
                 check.unusable);
        return check;
    }

private:
    // Cost is quadratic in the corners of concave faces, and in the number of faces at a smoothed point.
    [[nodiscard]] double face_work(std::size_t points) const {
        double work = kCornerWork * static_cast<double>(indices_.size());
        for (const Face& face : faces_) {
            const auto corners = static_cast<double>(face.end - face.begin);
            if (!shape_.flag("convex")) work += kConcaveWork * corners * corners;
        }
        std::vector<double> faces_at(points, 0);
        for (const double index : indices_) {
            if (index >= 0) faces_at[static_cast<std::size_t>(index)] += 1;
        }
        for (const double faces : faces_at) work += kSmoothWork * faces * faces;
        return work;
    }

    struct Face {
        std::size_t begin;
        std::size_t end;
    };
    [[nodiscard]] bool drawn(const Face& face) const { return face.end - face.begin >= least_; }

    // One entry per corner of the drawn faces, -1 after each face.
    template <class EntryAt>
    std::vector<std::int32_t> spread(const EntryAt& entry_at) const {
        std::vector<std::int32_t> list;
        for (const Face& face : faces_) {
            if (!drawn(face)) continue;
            for (std::size_t i = face.begin; i < face.end; ++i) list.push_back(static_cast<std::int32_t>(entry_at(i)));
            list.push_back(-1);
        }
        return list;
    }

    void fit_list(const char* field, const char* index_field, bool per_vertex, std::size_t available,
                  std::vector<std::int32_t>& list, std::vector<std::string>& unusable) const {
        if (!shape_.node(field)) return;
        const std::vector<double>& given = shape_.field(index_field).numbers;
        bool fits = true;
        const auto entry = [&](std::size_t i, double otherwise) {
            const double index = given.empty() ? otherwise : i < given.size() ? given[i] : -1;
            if (index >= 0 && index < static_cast<double>(available)) return index;
            fits = false;
            return 0.0;
        };
        if (per_vertex) {
            list = spread([&](std::size_t i) { return entry(i, indices_[i]); });
        } else {
            for (std::size_t i = 0; i < faces_.size(); ++i) {
                if (drawn(faces_[i])) list.push_back(static_cast<std::int32_t>(entry(i, static_cast<double>(i))));
            }
        }
        if (fits) return;
        list.clear();
        unusable.emplace_back(field);
    }

    const Node& shape_;
    const std::vector<double>& indices_;
    std::size_t least_;
    std::vector<Face> faces_;
};

bool all_above_0(const Node& node, std::initializer_list<const char*> fields) {
    for (const char* field : fields) {
        for (const double number : node.field(field).numbers) {
            if (!(number > 0)) return false;
        }
    }
    return true;
}

ShapeCheck check_grid(const Node& grid) {
    ShapeCheck check;
    const double columns = grid.number("xDimension");
    const double rows = grid.number("zDimension");
    if (columns < 2 || rows < 2) {
        check.empty = true;
        return check;
    }
    if (columns * rows > kMaxGridPoints || !all_above_0(grid, {"xSpacing", "zSpacing"}) ||
        static_cast<double>(grid.field("height").numbers.size()) < columns * rows) {
        check.fault = "the grid has fewer heights than points, too many points, or no spacing";
        return check;
    }
    const auto require = [&](const char* field, const char* list, std::size_t numbers, bool per_vertex) {
        const double needed = per_vertex ? columns * rows : (columns - 1) * (rows - 1);
        const NodePointer node = grid.node(field);
        if (node && static_cast<double>(count_in(node, list, numbers)) < needed) check.unusable.emplace_back(field);
    };
    require("color", "color", 3, grid.flag("colorPerVertex"));
    require("normal", "vector", 3, grid.flag("normalPerVertex"));
    require("texCoord", "point", 2, true);
    check.work = kGridWork * columns * rows;
    return check;
}

// Sum over distinct points of the squared number of occurrences.
double repetitions(const std::vector<double>& numbers, std::size_t numbers_each) {
    std::map<std::vector<double>, double> times;
    for (std::size_t i = 0; i + numbers_each <= numbers.size(); i += numbers_each) {
        const auto begin = numbers.begin() + static_cast<std::ptrdiff_t>(i);
        times[{begin, begin + static_cast<std::ptrdiff_t>(numbers_each)}] += 1;
    }
    double sum = 0;
    for (const auto& [point, count] : times) sum += count * count;
    return sum;
}

ShapeCheck check_extrusion(const Node& extrusion) {
    ShapeCheck check;
    const std::size_t section = extrusion.field("crossSection").numbers.size() / 2;
    const std::size_t spine = extrusion.field("spine").numbers.size() / 3;
    const std::size_t scales = extrusion.field("scale").numbers.size() / 2;
    const std::size_t turns = extrusion.field("orientation").numbers.size() / 4;
    if (section < 2 || spine < 2) {
        check.empty = true;
    } else if (section > kMaxCorners || static_cast<double>(section) * static_cast<double>(spine) > kMaxGridPoints) {
        check.fault = "the extrusion has too many points";
    } else if ((scales != 1 && scales < spine) || (turns != 1 && turns < spine)) {
        check.fault = "scale and orientation must have one value, or one for each point of the spine";
    }
    const auto corners = static_cast<double>(section);
    check.work = kExtrusionWork * corners * static_cast<double>(spine) + 2 * kConcaveWork * corners * corners;
    // All faces of coincident points meet there.
    const std::vector<double>& scale = extrusion.field("scale").numbers;
    const bool collapses = std::find(scale.begin(), scale.end(), 0.0) != scale.end();
    check.work += 36 * kSmoothWork * repetitions(extrusion.field("spine").numbers, 3) *
                  (collapses ? corners * corners : repetitions(extrusion.field("crossSection").numbers, 2));
    return check;
}

ShapeCheck check_text(const Node& text) {
    ShapeCheck check;
    std::size_t size_bytes = 0;
    for (const std::string& line : text.field("string").texts) size_bytes += line.size();
    if (size_bytes > kMaxText_bytes) check.fault = "a text of more than " + std::to_string(kMaxText_bytes) + " bytes";
    check.empty = size_bytes == 0;
    check.work = kTextWork * static_cast<double>(size_bytes);
    const NodePointer style = text.node("fontStyle");
    if (style && !(style->number("size") > 0 && style->number("spacing") >= 0)) {
        check.fault = "the font's size must be above 0";
    }
    return check;
}

}  // namespace

ShapeCheck check_shape(const Node& geometry) {
    ShapeCheck check;
    const std::string& type = geometry.type;
    const auto require_above_0 = [&](std::initializer_list<const char*> fields) {
        if (!all_above_0(geometry, fields)) check.fault = "its sizes must be above 0";
    };
    if (type == "IndexedFaceSet") return ListValidator(geometry, 3).fit();
    if (type == "IndexedLineSet") return ListValidator(geometry, 2).fit();
    if (type == "ElevationGrid") return check_grid(geometry);
    if (type == "Extrusion") return check_extrusion(geometry);
    if (type == "Text") return check_text(geometry);
    if (type == "Box") require_above_0({"size"});
    if (type == "Sphere") require_above_0({"radius"});
    if (type == "Cone") require_above_0({"bottomRadius", "height"});
    if (type == "Cylinder") require_above_0({"radius", "height"});
    if (type == "PointSet") {
        const std::size_t points = count_in(geometry.node("coord"), "point", 3);
        check.empty = points == 0;
        if (geometry.node("color") && count_in(geometry.node("color"), "color", 3) < points) {
            check.unusable.emplace_back("color");
        }
    }
    return check;
}

}  // namespace rs::compositor::vrml
