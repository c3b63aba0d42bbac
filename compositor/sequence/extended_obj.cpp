#include "compositor/sequence/extended_obj.hpp"

#include "rayspace/base/conventions.hpp"
#include "rayspace/base/printable.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <span>

namespace rs::compositor {
namespace {

constexpr double kMaxObjCoordinate = 1e6;  // coordinates, scales
constexpr double kMinScale = 1e-6;
constexpr double kMaxTurns_deg = 36000;
constexpr std::size_t kMaxQuoted_chars = 40;

struct MalformedLine {
    std::string what;  // "...; what to do"
};

using Words = std::vector<std::string_view>;

bool is_space(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

Words words_of(std::string_view line) {
    Words words;
    std::size_t i = 0;
    while (i < line.size()) {
        while (i < line.size() && is_space(line[i])) ++i;
        const std::size_t begin = i;
        while (i < line.size() && !is_space(line[i])) ++i;
        if (i > begin) words.push_back(line.substr(begin, i - begin));
    }
    return words;
}

// Text after the first word, including its blanks.
std::string rest_of(std::string_view line, std::string_view first_word) {
    std::string_view rest = line.substr(line.find(first_word) + first_word.size());
    while (!rest.empty() && is_space(rest.front())) rest.remove_prefix(1);
    while (!rest.empty() && is_space(rest.back())) rest.remove_suffix(1);
    return std::string(rest);
}

std::string in_quotes(std::string_view word) {
    return "'" + printable(word.substr(0, kMaxQuoted_chars)) + (word.size() > kMaxQuoted_chars ? "...'" : "'");
}

// Parses a number; a trailing `f` as in C is accepted if `may_end_in_f`.
double number(std::string_view word, double lowest, double highest, bool may_end_in_f) {
    std::string_view digits = word;
    if (may_end_in_f && digits.size() > 1 && (digits.back() == 'f' || digits.back() == 'F')) digits.remove_suffix(1);
    if (digits.size() > 1 && digits.front() == '+') digits.remove_prefix(1);
    double value = 0;
    const auto end = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (end.ec != std::errc() || end.ptr != digits.data() + digits.size() || !std::isfinite(value)) {
        throw MalformedLine{in_quotes(word) + " is not a number; write it as 1.5"};
    }
    if (value < lowest || value > highest) {
        std::array<char, 96> text{};
        std::snprintf(text.data(), text.size(), "; it must be %g..%g", lowest, highest);
        throw MalformedLine{in_quotes(word) + " is out of range" + text.data()};
    }
    return value;
}

glm::dvec3 triple(std::span<const std::string_view> words, double most) {
    return {number(words[0], -most, most, true), number(words[1], -most, most, true),
            number(words[2], -most, most, true)};
}

bool whole(std::string_view word, long long& value) {
    const auto end = std::from_chars(word.data(), word.data() + word.size(), value);
    return end.ec == std::errc() && end.ptr == word.data() + word.size();
}

// Line-by-line parser.
class Reader {
public:
    void take(std::string_view line, int number_of_line) {
        const Words words = words_of(line);
        if (words.empty() || words[0].front() == '#') return;
        line_ = number_of_line;
        if (words[0] == "instance") return take_instance(words);
        if (words[0] == "camera") return take_camera(words);
        for (const char c : line) digest_ = (digest_ ^ static_cast<unsigned char>(c)) * 0x100000001B3ULL;
        digest_ = (digest_ ^ 10U) * 0x100000001B3ULL;
        take_mesh(words, line);
    }

    ExtendedObj finish() && {
        result_.mesh_digest = digest_;
        return std::move(result_);
    }

private:
    void take_instance(const Words& words) {
        if (words.size() != 12) {
            throw MalformedLine{"an instance has 11 values, not " + std::to_string(words.size() - 1) +
                                "; write: instance ID dx dy dz rx ry rz sx sy sz MATERIAL"};
        }
        if (result_.instances.size() >= kMaxInstances) {
            throw MalformedLine{"too many instances; a file may have " + std::to_string(kMaxInstances)};
        }
        const std::span<const std::string_view> values(words);
        InstanceLine instance;
        instance.line = line_;
        instance.id = std::string(words[1]);
        instance.pose.move = triple(values.subspan(2, 3), kMaxObjCoordinate);
        instance.pose.turn_deg = triple(values.subspan(5, 3), kMaxTurns_deg);
        instance.pose.scale = triple(values.subspan(8, 3), kMaxObjCoordinate);
        for (int axis = 0; axis < 3; ++axis) {
            if (std::abs(instance.pose.scale[axis]) < kMinScale) {
                throw MalformedLine{"the scale " + in_quotes(words[static_cast<std::size_t>(8 + axis)]) +
                                    " is 0; give a non-zero scale"};
            }
        }
        instance.material = std::string(words[11]);
        result_.instances.push_back(std::move(instance));
    }

    void take_camera(const Words& words) {
        if (words.size() != 8) {
            throw MalformedLine{"a camera has 7 values, not " + std::to_string(words.size() - 1) +
                                "; write: camera ex ey ez tx ty tz ANGLE"};
        }
        if (result_.camera) throw MalformedLine{"there are two cameras; keep one"};
        const std::span<const std::string_view> values(words);
        SequenceCamera camera;
        camera.pose.eye = triple(values.subspan(1, 3), kMaxObjCoordinate);
        camera.pose.at = triple(values.subspan(4, 3), kMaxObjCoordinate);
        camera.fov_x_rad = radians(number(words[7], 1, 150, true));
        if (glm::distance(camera.pose.eye, camera.pose.at) < 1e-6) {
            throw MalformedLine{"the eye and the point looked at are the same; move one"};
        }
        result_.camera = camera;
    }

    void take_mesh(const Words& words, std::string_view line) {
        const std::string_view kind = words[0];
        const auto numbers = [&](std::size_t least, std::size_t most) {
            if (words.size() - 1 < least || words.size() - 1 > most) {
                throw MalformedLine{in_quotes(kind) + " has " + std::to_string(words.size() - 1) +
                                    " numbers; it takes " + std::to_string(least) + ".." + std::to_string(most)};
            }
            for (std::size_t i = 1; i < words.size(); ++i) number(words[i], -1e30, 1e30, false);
        };
        const auto name = [&] {
            if (words.size() < 2) throw MalformedLine{in_quotes(kind) + " has no name; give one"};
            // Names end at the next blank, as in the mesh reader.
            return std::string(words[1]);
        };
        if (kind == "v") {
            numbers(3, 7);
            ++vertices_;
        } else if (kind == "vn") {
            numbers(3, 3);
            ++normals_;
        } else if (kind == "vt") {
            numbers(1, 3);
            ++places_;
        } else if (kind == "f" || kind == "l" || kind == "p") {
            take_face(words, kind);
        } else if (kind == "o") {
            object_ = name();
            has_o_ = true;
            node_ = object_;
        } else if (kind == "g") {
            node_ = words.size() < 2 ? object_ : rest_of(line, kind);
            if (!has_o_) object_ = node_;
        } else if (kind == "mtllib") {
            name();
            result_.libraries.push_back({line_, rest_of(line, kind)});
        } else if (kind == "usemtl") {
            name();
        } else if (kind != "s" && kind != "mg" && kind != "vp" && kind != "lod" && kind != "bevel" &&
                   kind != "c_interp" && kind != "d_interp") {
            throw MalformedLine{in_quotes(kind) + " is not a statement of extended OBJ; correct or remove the line"};
        }
    }

    void take_face(const Words& words, std::string_view kind) {
        const std::size_t least = kind == "f" ? 3 : kind == "l" ? 2 : 1;
        if (words.size() - 1 < least) {
            throw MalformedLine{in_quotes(kind) + " has " + std::to_string(words.size() - 1) + " corners; it takes " +
                                std::to_string(least) + " or more"};
        }
        const std::array<long long, 3> counts{vertices_, places_, normals_};
        for (std::size_t i = 1; i < words.size(); ++i) {
            std::string_view corner = words[i];
            for (std::size_t part = 0; part < 3; ++part) {
                const std::size_t end = std::min(corner.find('/'), corner.size());
                check_index(corner.substr(0, end), counts[part], part, words[i]);
                if (end == corner.size()) break;
                corner.remove_prefix(end + 1);
                if (part == 2)
                    throw MalformedLine{"the corner " + in_quotes(words[i]) + " has too many parts; write 1/2/3"};
            }
        }
        register_object();
    }

    static void check_index(std::string_view text, long long count, std::size_t part, std::string_view corner) {
        if (text.empty() && part != 0) return;
        long long index = 0;
        if (!whole(text, index) || index == 0) {
            throw MalformedLine{"the corner " + in_quotes(corner) +
                                " is not an index; write it as 1, 1/2, 1//3 or 1/2/3"};
        }
        // Some exporters write texture coordinate indices without coordinates.
        if (part == 1 && count == 0) return;
        if (index > count || index < -count) {
            constexpr std::array kWhat{"vertices", "texture coordinates", "normals"};
            throw MalformedLine{"the corner " + in_quotes(corner) + " exceeds the " + std::to_string(count) + " " +
                                kWhat.at(part) + " before it; correct the index"};
        }
    }

    void register_object() {
        const auto owner = owner_of_node_.find(node_);
        if (owner == owner_of_node_.end()) {
            owner_of_node_.emplace(node_, object_);
            const auto same = [&](const ObjObject& object) { return object.name == object_; };
            auto found = std::find_if(result_.objects.begin(), result_.objects.end(), same);
            if (found == result_.objects.end()) {
                result_.objects.push_back({object_, {}});
                found = std::prev(result_.objects.end());
            }
            found->nodes.push_back(node_);
        } else if (owner->second != object_) {
            throw MalformedLine{"faces of the group " + in_quotes(node_) + " belong to the objects " +
                                in_quotes(owner->second) + " and " + in_quotes(object_) +
                                "; give the group another name"};
        }
    }

    ExtendedObj result_;
    std::uint64_t digest_ = 0xCBF29CE484222325ULL;
    int line_ = 0;
    long long vertices_ = 0;
    long long places_ = 0;
    long long normals_ = 0;
    bool has_o_ = false;
    std::string object_ = "defaultobject";  // the mesh reader's name of faces before all names
    std::string node_ = "defaultobject";
    std::map<std::string, std::string> owner_of_node_;
};

}  // namespace

glm::dmat3 turn_matrix(const glm::dvec3& turn_deg) {
    glm::dmat3 turn(1.0);
    for (int axis = 0; axis < 3; ++axis) {
        const double c = std::cos(radians(turn_deg[axis]));
        const double s = std::sin(radians(turn_deg[axis]));
        const int u = (axis + 1) % 3;
        const int v = (axis + 2) % 3;
        glm::dmat3 about(1.0);  // rotates u to v
        about[u][u] = c;
        about[u][v] = s;
        about[v][u] = -s;
        about[v][v] = c;
        turn = about * turn;
    }
    return turn;
}

glm::dmat4 instance_matrix(const InstancePose& pose, const glm::dvec3& middle) {
    glm::dmat3 turned = turn_matrix(pose.turn_deg);
    for (int axis = 0; axis < 3; ++axis) turned[axis] *= pose.scale[axis];
    glm::dmat4 matrix(turned);
    matrix[3] = glm::dvec4(pose.move - turned * middle, 1);
    return matrix;
}

Result<ExtendedObj> parse_extended_obj(std::string_view text, const std::string& shown) {
    if (text.size() > kMaxExtendedObj_bytes) {
        return Error{printable(shown) + ": is larger than 64 MiB; split it into a base scene and frames"};
    }
    Reader reader;
    int line = 0;
    try {
        std::string joined;  // lines continued by backslashes
        int first = 0;
        for (std::size_t begin = 0; begin < text.size();) {
            const std::size_t end = std::min(text.find('\n', begin), text.size());
            std::string_view part = text.substr(begin, end - begin);
            begin = end + 1;
            ++line;
            if (first == 0) first = line;
            while (!part.empty() && is_space(part.back())) part.remove_suffix(1);
            const bool goes_on = !part.empty() && part.back() == '\\' && begin < text.size();
            if (goes_on) part.remove_suffix(1);
            if (joined.empty() && !goes_on) {
                reader.take(part, first);
            } else {
                joined += part;
                joined += ' ';
            }
            if (goes_on) continue;
            if (!joined.empty()) reader.take(joined, first);
            joined.clear();
            first = 0;
        }
    } catch (const MalformedLine& malformed) {
        return Error{printable(shown) + ":" + std::to_string(line) + ": " + malformed.what};
    }
    return std::move(reader).finish();
}

}  // namespace rs::compositor
