#include "capture/tracer/scene/plain_ply.hpp"

#include "capture/tracer/scene/ply_header.hpp"
#include "rayspace/file/file_output.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace rs::capture {

namespace {

constexpr std::uint64_t kMaxPly_bytes = std::uint64_t{4} << 30;

using Problem = std::optional<std::string>;

// Calls `visit` with a zero of the C++ type that `type` stands for.
template <class Visit>
auto with_type(PlyScalar type, Visit visit) {
    switch (type) {
        case PlyScalar::int8:
            return visit(std::int8_t{});
        case PlyScalar::uint8:
            return visit(std::uint8_t{});
        case PlyScalar::int16:
            return visit(std::int16_t{});
        case PlyScalar::uint16:
            return visit(std::uint16_t{});
        case PlyScalar::int32:
            return visit(std::int32_t{});
        case PlyScalar::uint32:
            return visit(std::uint32_t{});
        case PlyScalar::float32:
            return visit(float{});
        case PlyScalar::float64:
            break;
    }
    return visit(double{});
}

bool fits(double value, PlyScalar type) {
    return with_type(type, [&](auto zero) {
        using T = decltype(zero);
        if constexpr (std::is_floating_point_v<T>) {
            return !std::isfinite(value) || std::abs(value) <= static_cast<double>(std::numeric_limits<T>::max());
        }
        return value == std::floor(value) && value >= static_cast<double>(std::numeric_limits<T>::lowest()) &&
               value <= static_cast<double>(std::numeric_limits<T>::max());
    });
}

// Takes numbers from the body, one after the other.
class Body {
public:
    Body(std::string_view bytes, PlyEncoding encoding) : rest_(bytes), encoding_(encoding) {}

    // Nothing where the body ends, or holds something that is no number of this type.
    std::optional<double> next(PlyScalar type) {
        if (encoding_ != PlyEncoding::ascii) {
            return with_type(type, [&](auto zero) { return take<decltype(zero)>(); });
        }
        const auto value = next_text();
        return value && fits(*value, type) ? value : std::nullopt;
    }

private:
    std::optional<double> next_text() {
        const std::size_t begin = rest_.find_first_not_of(" \t\r\n");
        if (begin == std::string_view::npos) return std::nullopt;
        const std::size_t end = std::min(rest_.find_first_of(" \t\r\n", begin), rest_.size());
        const std::string_view token = rest_.substr(begin, end - begin);
        rest_.remove_prefix(end);
        double value = 0;
        const std::size_t sign = token.starts_with('+') ? 1 : 0;
        const auto [stop, error] = std::from_chars(token.data() + sign, token.data() + token.size(), value);
        if (error != std::errc{} || stop != token.data() + token.size()) return std::nullopt;
        return value;
    }

    template <class T>
    std::optional<double> take() {
        if (rest_.size() < sizeof(T)) return std::nullopt;
        char bytes[sizeof(T)];
        const bool swap = encoding_ == PlyEncoding::big_endian;
        for (std::size_t i = 0; i < sizeof(T); ++i) bytes[swap ? sizeof(T) - 1 - i : i] = rest_[i];
        rest_.remove_prefix(sizeof(T));
        T value;
        std::memcpy(&value, bytes, sizeof(T));
        return static_cast<double>(value);
    }

    std::string_view rest_;
    PlyEncoding encoding_;
};

// Little-endian, as are all machines that this runs on.
void append(std::string& bytes, double value, PlyScalar type) {
    with_type(type, [&](auto zero) {
        const auto typed = static_cast<decltype(zero)>(value);
        bytes.append(reinterpret_cast<const char*>(&typed), sizeof typed);
    });
}

void append_list(std::string& bytes, const std::vector<double>& values, PlyScalar type) {
    append(bytes, static_cast<double>(values.size()), PlyScalar::uint32);
    for (const double value : values) append(bytes, value, type);
}

// Rewrites the body, element by element.
class Rewriter {
public:
    Rewriter(const PlyHeader& header, std::string_view body) : body_(body, *header.encoding) {
        header_ = "ply\nformat binary_little_endian 1.0\n";
        for (const std::string& file : header.texture_files) header_ += "comment TextureFile " + file + "\n";
        // Assimp drops a body's first byte where it is a line feed; this one never is. Of elements that Assimp does not
        // know it loses the count; edges it knows and leaves alone.
        header_ += "element edge 1\nproperty uchar padding\n";
        bytes_.push_back('\0');
        for (const PlyElement& element : header.elements) {
            if (element.name == "vertex") vertex_count_ = static_cast<double>(element.count);
        }
    }

    Problem rewrite(const PlyElement& element) {
        const bool strips = element.name == "tristrips";
        const bool faces = element.name == "face" || strips;
        const bool numbers = element.name == "vertex" || element.name == "material";
        texcoord_type_.reset();
        if (const auto found = std::ranges::find_if(element.properties, &Rewriter::is_texcoord);
            found != element.properties.end() && !strips) {
            texcoord_type_ = found->type;
        }
        for (std::uint64_t i = 0; i < element.count; ++i) {
            Problem problem = numbers ? rewrite_numbers(element) : read_instance(element, strips);
            if (problem) return element.name + " " + std::to_string(i) + ": " + *problem;
            if (strips) append_strip();
            if (element.name == "face") append_face();
        }
        if (numbers) announce_numbers(element);
        if (faces && element.count > 0) {
            if (face_count_ == 0) return "has no faces; a mesh with triangles or polygons is needed";
            header_ += "element face " + std::to_string(face_count_) + "\nproperty list uint uint vertex_indices\n";
            if (texcoord_type_) {
                header_ += std::string("property list uint ") + ply_name(*texcoord_type_) + " texcoord\n";
            }
        }
        return std::nullopt;
    }

    [[nodiscard]] std::string take_file() && {
        bytes_.insert(0, header_ + "end_header\n");
        return std::move(bytes_);
    }

private:
    static bool is_texcoord(const PlyProperty& property) { return property.name == "texcoord" && property.is_list(); }

    Problem read_list(const PlyProperty& property, std::vector<double>& values) {
        const auto count = body_.next(*property.count_type);
        if (!count || *count < 0 || *count != std::floor(*count)) return "a list has no valid length";
        values.clear();
        for (double i = 0; i < *count; ++i) {
            const auto value = body_.next(property.type);
            if (!value) return "a list ends too early or holds something that is no number";
            values.push_back(*value);
        }
        return std::nullopt;
    }

    static std::string missing(const PlyProperty& property) {
        return property.name + " is missing or no number of its type; the file may be cut off";
    }

    Problem rewrite_numbers(const PlyElement& element) {
        for (const PlyProperty& property : element.properties) {
            if (property.count_type) {
                if (Problem problem = read_list(property, ignored_)) return problem;
                continue;
            }
            const auto value = body_.next(property.type);
            if (!value) return missing(property);
            append(bytes_, *value, property.type);
        }
        return std::nullopt;
    }

    void announce_numbers(const PlyElement& element) {
        if (element.count == 0 || std::ranges::all_of(element.properties, &PlyProperty::is_list)) return;
        header_ += "element " + element.name + " " + std::to_string(element.count) + "\n";
        for (const PlyProperty& property : element.properties) {
            if (!property.count_type)
                header_ += std::string("property ") + ply_name(property.type) + " " + property.name + "\n";
        }
    }

    Problem read_instance(const PlyElement& element, bool strips) {
        texcoords_.clear();
        for (const PlyProperty& property : element.properties) {
            if (!property.count_type) {
                if (!body_.next(property.type)) return missing(property);
                continue;
            }
            std::vector<double>& values = property.is_vertex_list() ? vertices_
                                          : is_texcoord(property)   ? texcoords_
                                                                    : ignored_;
            if (Problem problem = read_list(property, values)) return problem;
        }
        if (element.name != "face" && !strips) return std::nullopt;
        for (const double vertex : vertices_) {
            const bool exists = vertex >= 0 && vertex < vertex_count_;
            if (!exists && !(strips && vertex == -1)) return "a face names a vertex that does not exist";
        }
        return std::nullopt;
    }

    void append_face() {
        if (vertices_.size() < 3) return;
        append_list(bytes_, vertices_, PlyScalar::uint32);
        ++face_count_;
        if (!texcoord_type_) return;
        if (texcoords_.size() != 2 * vertices_.size()) texcoords_.clear();
        append_list(bytes_, texcoords_, *texcoord_type_);
    }

    // Every vertex after the second makes a triangle with the two before it; each second one is turned around.
    void append_strip() {
        std::size_t begin = 0;  // of the strip since the last -1
        for (std::size_t i = 0; i < vertices_.size(); ++i) {
            if (vertices_[i] == -1) {
                begin = i + 1;
            } else if (i >= begin + 2) {
                const bool turned = (i - begin) % 2 == 1;
                const double a = vertices_[i - 2];
                const double b = vertices_[i - 1];
                append_list(bytes_, {turned ? b : a, turned ? a : b, vertices_[i]}, PlyScalar::uint32);
                ++face_count_;
            }
        }
    }

    Body body_;
    std::string header_;
    std::string bytes_;
    double vertex_count_ = 0;
    std::uint64_t face_count_ = 0;
    std::optional<PlyScalar> texcoord_type_;
    std::vector<double> vertices_, texcoords_, ignored_;
};

}  // namespace

Result<std::string> read_plain_ply(const std::filesystem::path& path) {
    const auto bytes = read_file(path, kMaxPly_bytes);
    if (!bytes) return bytes.error();
    const auto wrong = [&](const std::string& problem) {
        return Error{path.string() + ": cannot be read as a mesh: " + problem};
    };
    const std::string_view file(reinterpret_cast<const char*>(bytes->data()), bytes->size());
    PlyHeader header;
    if (const Problem problem = parse_ply_header(file, header)) return wrong(*problem);
    Rewriter rewriter(header, file.substr(header.size_bytes));
    for (const PlyElement& element : header.elements) {
        if (const Problem problem = rewriter.rewrite(element)) return wrong(*problem);
    }
    return std::move(rewriter).take_file();
}

}  // namespace rs::capture
