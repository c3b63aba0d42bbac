#include "capture/tracer/scene/ply_file.hpp"

#include "capture/tracer/scene/ply_header.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/image/linear_light.hpp"

#include <assimp/BaseImporter.h>
#include <assimp/importerdesc.h>
#include <assimp/material.h>
#include <assimp/mesh.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace rs::capture {

namespace {

constexpr std::uint64_t kMaxPly_bytes = std::uint64_t{4} << 30;

using Problem = std::optional<std::string>;

// Calls `visit` with a zero of the C++ type of `type`.
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

// Sequential reader of the numbers in the body.
class Body {
public:
    Body(std::string_view bytes, PlyEncoding encoding) : rest_(bytes), encoding_(encoding) {}

    // Empty at the end of the body or if the next token is not a number of this type.
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

// Properties used by the mesh, each with its index in a row; all others go to the row's last element.
using PlyRow = std::array<float, 12>;
constexpr std::size_t kNormalAt = 3, kTextureAt = 6, kColourAt = 8, kRestAt = 11;  // after a vertex' position
constexpr std::size_t kSpecularAt = 3, kPowerAt = 6, kOpacityAt = 7;               // after a material's diffuse colour
using PlyColumn = std::pair<std::string_view, std::size_t>;
constexpr PlyColumn kVertexColumns[] = {{"x", 0},
                                        {"y", 1},
                                        {"z", 2},
                                        {"nx", 3},
                                        {"ny", 4},
                                        {"nz", 5},
                                        {"u", 6},
                                        {"s", 6},
                                        {"tx", 6},
                                        {"texture_u", 6},
                                        {"v", 7},
                                        {"t", 7},
                                        {"ty", 7},
                                        {"texture_v", 7},
                                        {"red", kColourAt},
                                        {"green", kColourAt + 1},
                                        {"blue", kColourAt + 2},
                                        {"diffuse_red", kColourAt},
                                        {"diffuse_green", kColourAt + 1},
                                        {"diffuse_blue", kColourAt + 2},
                                        {"f_dc_0", kColourAt},
                                        {"f_dc_1", kColourAt + 1},
                                        {"f_dc_2", kColourAt + 2}};
constexpr float kHarmonicOfDegree0 = 0.28209479F;  // 3D Gaussian splats: sRGB = 0.5 + this * f_dc
constexpr PlyColumn kMaterialColumns[] = {{"diffuse_red", 0},           {"diffuse_green", 1},   {"diffuse_blue", 2},
                                          {"specular_red", 3},          {"specular_green", 4},  {"specular_blue", 5},
                                          {"specular_power", kPowerAt}, {"opacity", kOpacityAt}};

template <class T>
T* new_array(const std::vector<T>& values) {
    T* const array = new T[values.size()];
    std::ranges::copy(values, array);
    return array;
}

aiMaterial* new_material(const PlyRow& row, const std::vector<std::string>& texture_files) {
    auto* const material = new aiMaterial;
    const aiColor3D diffuse(row[0], row[1], row[2]);
    const aiColor3D specular(row[kSpecularAt], row[kSpecularAt + 1], row[kSpecularAt + 2]);
    const float exponent = row[kPowerAt] * 15;  // as in Assimp
    material->AddProperty(&diffuse, 1, AI_MATKEY_COLOR_DIFFUSE);
    material->AddProperty(&specular, 1, AI_MATKEY_COLOR_SPECULAR);
    material->AddProperty(&exponent, 1, AI_MATKEY_SHININESS);
    material->AddProperty(&row[kOpacityAt], 1, AI_MATKEY_OPACITY);
    if (texture_files.empty()) return material;
    const aiString texture(texture_files.back());
    material->AddProperty(&texture, AI_MATKEY_TEXTURE_DIFFUSE(0));
    return material;
}

// Passes a scene from our PLY reader to Assimp's post-processing.
class PlyLoader : public Assimp::BaseImporter {
public:
    explicit PlyLoader(std::unique_ptr<aiScene> scene) : scene_(std::move(scene)) {}
    bool CanRead(const std::string&, Assimp::IOSystem*, bool) const override { return true; }

protected:
    [[nodiscard]] const aiImporterDesc* GetInfo() const override {
        static constexpr aiImporterDesc kPly = {"PLY", "", "", "", 0, 0, 0, 0, 0, "ply"};
        return &kPly;
    }
    void InternReadFile(const std::string&, aiScene* to, Assimp::IOSystem*) override {
        std::swap(to->mMeshes, scene_->mMeshes);
        std::swap(to->mNumMeshes, scene_->mNumMeshes);
        std::swap(to->mMaterials, scene_->mMaterials);
        std::swap(to->mNumMaterials, scene_->mNumMaterials);
        std::swap(to->mRootNode, scene_->mRootNode);
    }

private:
    std::unique_ptr<aiScene> scene_;
};

// Reads the body element by element.
float linear(float srgb) {
    return srgb > 0 ? linear_from_srgb(std::min(srgb, 1.0F)) : 0;
}

class PlyReader {
public:
    PlyReader(const PlyHeader& header, std::string_view body, PlyUse use)
        : body_(body, *header.encoding), displayed_(use == PlyUse::kDisplay) {
        for (const PlyElement& element : header.elements) {
            if (element.name == "vertex") vertex_count_ = static_cast<double>(element.count);
        }
    }

    Problem read(const PlyElement& element) {
        const bool strips = element.name == "tristrips";
        const bool faces = element.name == "face" || strips;
        choose_targets(element);
        for (std::uint64_t i = 0; i < element.count; ++i) {
            Problem problem = read_instance(element);
            if (!problem && faces && !vertices_exist(strips)) problem = "a face refers to a vertex that does not exist";
            if (problem) return element.name + " " + std::to_string(i) + ": " + *problem;
            if (element.name == "vertex") append_vertex();
            if (element.name == "material" && !material_) material_ = row_;
            if (strips) append_strip();
            if (element.name == "face") append_face();
        }
        if (!faces || element.count == 0 || !faces_.empty()) return std::nullopt;
        return "has no faces; a mesh with triangles or polygons is needed";
    }

    // Moves the data to the scene; call once.
    [[nodiscard]] std::unique_ptr<aiScene> scene(const std::vector<std::string>& texture_files) && {
        if (faces_.empty()) {
            for (std::size_t i = 0; i < positions_.size(); ++i) append_polygon({static_cast<double>(i)});
        }
        auto scene = std::make_unique<aiScene>();
        auto* const mesh = new aiMesh;
        scene->mMeshes = new_array<aiMesh*>({mesh});
        scene->mNumMeshes = 1;
        mesh->mNumVertices = static_cast<unsigned>(positions_.size());
        mesh->mNumUVComponents[0] = uvs_.empty() ? 0 : 2;
        mesh->mNumFaces = static_cast<unsigned>(faces_.size());
        mesh->mVertices = new_array(std::exchange(positions_, {}));
        if (!normals_.empty()) mesh->mNormals = new_array(std::exchange(normals_, {}));
        if (!uvs_.empty()) mesh->mTextureCoords[0] = new_array(std::exchange(uvs_, {}));
        if (!colours_.empty()) mesh->mColors[0] = new_array(colours_);
        mesh->mFaces = new aiFace[faces_.size()];
        for (std::size_t i = 0; i < faces_.size(); ++i) {  // copying a face allocates
            std::swap(mesh->mFaces[i].mNumIndices, faces_[i].mNumIndices);
            std::swap(mesh->mFaces[i].mIndices, faces_[i].mIndices);
        }
        scene->mMaterials =
            new_array<aiMaterial*>({new_material(material_.value_or(default_material()), texture_files)});
        scene->mNumMaterials = 1;
        scene->mRootNode = new aiNode;
        scene->mRootNode->mMeshes = new_array<unsigned>({0});
        scene->mRootNode->mNumMeshes = 1;
        return scene;
    }

private:
    struct Target {
        std::size_t at = kRestAt;
        float one = 1;  // integer colours are divided by their type's maximum
        float zero = 0;
    };

    [[nodiscard]] PlyRow default_material() const {
        if (!displayed_) return {1, 1, 1, 1, 1, 1, 0, 1};
        const float diffuse = colours_.empty() ? 0.8F : 1.0F;
        return {diffuse, diffuse, diffuse, 0, 0, 0, 0, 1};
    }

    void choose_targets(const PlyElement& element) {
        const bool vertices = element.name == "vertex";
        const bool materials = element.name == "material";
        std::span<const PlyColumn> columns;
        if (vertices) columns = kVertexColumns;
        if (materials) columns = kMaterialColumns;
        row_ = {};
        row_[kOpacityAt] = materials ? 1 : 0;
        targets_.clear();
        for (const PlyProperty& property : element.properties) {
            Target& target = targets_.emplace_back();
            const auto found = std::ranges::find(columns, property.name, &PlyColumn::first);
            if (found == columns.end() || property.is_list()) continue;
            target.at = found->second;
            has_normals_ = has_normals_ || (vertices && target.at >= kNormalAt && target.at < kTextureAt);
            has_uvs_ = has_uvs_ || (vertices && target.at >= kTextureAt && target.at < kColourAt);
            const bool is_vertex_colour = vertices && target.at >= kColourAt;
            has_colours_ = has_colours_ || is_vertex_colour;
            if (property.name.starts_with("f_dc_")) {
                target.zero = 0.5F;
                target.one = 1 / kHarmonicOfDegree0;
            }
            const bool is_colour = is_vertex_colour || (materials && target.at < kPowerAt);
            if (!is_colour || !is_integer(property.type)) continue;
            target.one = with_type(property.type, [](auto zero) {
                return static_cast<float>(std::numeric_limits<decltype(zero)>::max());
            });
        }
    }

    // `values`: null if unused.
    Problem read_list(const PlyProperty& property, std::vector<double>* values) {
        const auto count = body_.next(*property.count_type);
        if (!count || *count < 0 || *count != std::floor(*count)) return "a list has no valid length";
        if (values != nullptr) values->clear();
        for (double i = 0; i < *count; ++i) {
            const auto value = body_.next(property.type);
            if (!value) return "a list is too short or contains a value that is not a number";
            if (values != nullptr) values->push_back(*value);
        }
        return std::nullopt;
    }

    Problem read_instance(const PlyElement& element) {
        texcoords_.clear();
        for (std::size_t i = 0; i < element.properties.size(); ++i) {
            const PlyProperty& property = element.properties[i];
            if (property.is_list()) {
                std::vector<double>* const values = property.is_vertex_list()     ? &vertices_
                                                    : property.name == "texcoord" ? &texcoords_
                                                                                  : nullptr;
                if (Problem problem = read_list(property, values)) return problem;
                continue;
            }
            const auto value = body_.next(property.type);
            if (!value) return property.name + " is missing or not a number of its type; the file may be truncated";
            row_[targets_[i].at] = static_cast<float>(*value) / targets_[i].one + targets_[i].zero;
        }
        return std::nullopt;
    }

    [[nodiscard]] bool vertices_exist(bool strips) const {
        return std::ranges::all_of(vertices_, [&](double vertex) {
            return (vertex >= 0 && vertex < vertex_count_) || (strips && vertex == -1);
        });
    }

    void append_vertex() {
        positions_.emplace_back(row_[0], row_[1], row_[2]);
        if (has_normals_) normals_.emplace_back(row_[kNormalAt], row_[kNormalAt + 1], row_[kNormalAt + 2]);
        if (has_uvs_) uvs_.emplace_back(row_[kTextureAt], row_[kTextureAt + 1], 0.0F);
        if (has_colours_) {
            colours_.emplace_back(linear(row_[kColourAt]), linear(row_[kColourAt + 1]), linear(row_[kColourAt + 2]),
                                  1.0F);
        }
    }

    void append_polygon(const std::vector<double>& corners) {
        aiFace& face = faces_.emplace_back();
        face.mNumIndices = static_cast<unsigned>(corners.size());
        face.mIndices = new unsigned[corners.size()];
        std::ranges::transform(corners, face.mIndices, [](double vertex) { return static_cast<unsigned>(vertex); });
    }

    void append_face() {
        if (vertices_.size() < 3) return;
        append_polygon(vertices_);
        if (texcoords_.size() != 2 * vertices_.size()) return;
        uvs_.resize(positions_.size());
        for (std::size_t i = 0; i < vertices_.size(); ++i) {
            uvs_[static_cast<std::size_t>(vertices_[i])] = {static_cast<float>(texcoords_[2 * i]),
                                                            static_cast<float>(texcoords_[2 * i + 1]), 0.0F};
        }
    }

    // Every vertex after the second forms a triangle with the two before it, with alternating winding.
    void append_strip() {
        std::size_t begin = 0;  // of the current strip
        for (std::size_t i = 0; i < vertices_.size(); ++i) {
            const std::size_t turned = (i - begin) % 2;
            if (vertices_[i] == -1) {
                begin = i + 1;
            } else if (i >= begin + 2) {
                append_polygon({vertices_[i - 2 + turned], vertices_[i - 1 - turned], vertices_[i]});
            }
        }
    }

    Body body_;
    bool displayed_;
    double vertex_count_ = 0;
    std::vector<Target> targets_;  // [property of the element]
    PlyRow row_{};
    std::vector<double> vertices_, texcoords_;
    bool has_normals_ = false, has_uvs_ = false, has_colours_ = false;
    std::vector<aiVector3D> positions_, normals_, uvs_;
    std::vector<aiColor4D> colours_;
    std::vector<aiFace> faces_;
    std::optional<PlyRow> material_;  // the first one is the mesh's
};

}  // namespace

Result<std::unique_ptr<aiScene>> read_ply_file(const std::filesystem::path& path, PlyUse use) {
    RS_ASSIGN_OR_RETURN(const auto bytes, read_file(path, kMaxPly_bytes));
    const auto wrong = [&](const std::string& problem) {
        return Error{path.string() + ": cannot be read as a mesh: " + problem};
    };
    const std::string_view file(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    PlyHeader header;
    if (const Problem problem = parse_ply_header(file, header, use == PlyUse::kDisplay)) return wrong(*problem);
    PlyReader reader(header, file.substr(header.size_bytes), use);
    for (const PlyElement& element : header.elements) {
        if (const Problem problem = reader.read(element)) return wrong(*problem);
    }
    return std::move(reader).scene(header.texture_files);
}

void pass_to_importer(std::unique_ptr<aiScene> ply, Assimp::Importer& importer) {
    importer.RegisterLoader(new PlyLoader(std::move(ply)));  // the importer takes it over
    importer.ReadFileFromMemory("ply", 3, 0, "ply");
}

}  // namespace rs::capture
