#include "datasets-synthetic/street/obj_file.hpp"

#include "datasets-synthetic/shapes/paint.hpp"
#include "rayspace/api/types/check.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <map>
#include <vector>

namespace rs::synthetic {
namespace {

constexpr double kGlassOpacity = 0.22;

std::string numbers(std::initializer_list<float> values) {
    std::string text;
    for (const float value : values) text += " " + obj_number(static_cast<double>(value));
    return text + "\n";
}

std::string colour_line(const char* kind, const glm::vec3& c) {
    return kind + numbers({c.x, c.y, c.z});
}

bool is_glass(const std::string& look) {
    return look == "shop_glass";
}

std::string material_text(const std::string& name, const Look& look, bool unlit) {
    std::string text = "newmtl " + name + "\n";
    const glm::vec3 diffuse = look.texture.empty() ? srgb(look.diffuse) : glm::vec3(1);
    text += "Ns" + numbers({look.specular != 0 ? look.shininess * 128 : 0});
    text += colour_line("Ka", diffuse);
    text += colour_line("Kd", diffuse);
    text += colour_line("Ks", srgb(look.specular));
    text += colour_line("Ke", srgb(look.emissive));
    text += "d " + obj_number(is_glass(name) ? kGlassOpacity : 1) + "\nillum " + (unlit ? "0" : "2") + "\n";
    if (!look.texture.empty()) text += "map_Kd " + look.texture + "\n";
    return text + "\n";
}

class ObjWriter {
public:
    void object(const std::string& name) { text_ += "o " + name + "\n"; }
    void part(const std::string& look, const capture::Mesh& mesh) {
        RS_CHECK(mesh.uvs.size() == mesh.positions.size() && mesh.normals.size() == mesh.positions.size());
        text_ += "usemtl " + look + "\n";
        for (const glm::vec3& p : mesh.positions) text_ += "v" + numbers({p.x, p.y, p.z});
        for (const glm::vec2& uv : mesh.uvs) text_ += "vt" + numbers({uv.x, uv.y});
        for (const glm::vec3& n : mesh.normals) text_ += "vn" + numbers({n.x, n.y, n.z});
        for (const glm::uvec3& t : mesh.triangles) {
            text_ += "f";
            for (int k = 0; k < 3; ++k) {
                const std::string index = std::to_string(first_ + t[k]);
                text_ += " " + index + "/" + index + "/" + index;
            }
            text_ += "\n";
        }
        first_ += mesh.positions.size();
    }
    [[nodiscard]] std::string take(const std::string& library) && { return "mtllib " + library + "\n" + text_; }

private:
    std::string text_;
    std::size_t first_ = 1;
};

}  // namespace

std::string obj_number(double value) {
    std::array<char, 40> digits{};
    const double rounded = std::round(value * 1e4) / 1e4;
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), rounded == 0 ? 0.0 : rounded,
                                   std::chars_format::fixed, 4);
    RS_CHECK(end.ec == std::errc());
    std::string shown(digits.data(), end.ptr);
    while (shown.back() == '0') shown.pop_back();
    if (shown.back() == '.') shown.pop_back();
    return shown;
}

ObjTexts obj_texts(const World& world, const std::string& library, const std::set<std::string>& unlit) {
    // Grouped by object, then by look, which minimises material changes.
    std::map<std::string, std::map<std::string, std::vector<const capture::Mesh*>>> objects;
    for (const WorldPart& part : world.parts) objects[part.room][part.look].push_back(&part.mesh);
    ObjWriter writer;
    for (const auto& [name, looks] : objects) {
        writer.object(name);
        for (const auto& [look, meshes] : looks) {
            for (const capture::Mesh* const mesh : meshes) writer.part(look, *mesh);
        }
    }
    ObjTexts texts;
    texts.obj = std::move(writer).take(library);
    for (const auto& [name, look] : world.looks) texts.mtl += material_text(name, look, unlit.contains(name));
    return texts;
}

}  // namespace rs::synthetic
