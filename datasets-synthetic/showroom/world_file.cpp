#include "datasets-synthetic/showroom/world_file.hpp"

#include "rayspace/api/types/check.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/image_io/image_io.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <span>
#include <utility>
#include <vector>

namespace rs::synthetic {
namespace {

using glm::vec2;
using glm::vec3;

// VRML text with locale-independent numbers.
class Text {
public:
    Text& operator<<(const std::string& text) {
        text_ += text;
        return *this;
    }
    Text& operator<<(int number) { return *this << std::to_string(number); }
    // Up to four decimals, without trailing zeros.
    Text& operator<<(float number) {
        std::array<char, 32> digits{};
        const double rounded = std::round(static_cast<double>(number) * 1e4) / 1e4;
        const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), rounded == 0 ? 0.0 : rounded,
                                       std::chars_format::fixed, 4);
        RS_CHECK(end.ec == std::errc());
        std::string shown(digits.data(), end.ptr);
        while (shown.back() == '0') shown.pop_back();
        if (shown.back() == '.') shown.pop_back();
        return *this << shown;
    }
    Text& operator<<(vec3 v) { return *this << v.x << " " << v.y << " " << v.z; }
    Text& operator<<(vec2 v) { return *this << v.x << " " << v.y; }
    Text& colour(std::uint32_t hex) {
        return *this << vec3{static_cast<float>((hex >> 16U) & 255U), static_cast<float>((hex >> 8U) & 255U),
                             static_cast<float>(hex & 255U)} /
                            255.0F;
    }
    [[nodiscard]] std::string take() && { return std::move(text_); }

private:
    std::string text_;
};

template <class T>
void list(Text& text, const std::string& name, std::span<const T> values, const std::string& after) {
    text << "          " << name << " [";
    for (std::size_t i = 0; i < values.size(); ++i) text << (i % 6 == 0 ? "\n            " : " ") << values[i] << after;
    text << " ]\n";
}

void write_look(Text& text, const Look& look) {
    text << "        appearance Appearance {\n          material Material { ambientIntensity 1 diffuseColor ";
    text.colour(look.diffuse) << " specularColor ";
    text.colour(look.specular) << " emissiveColor ";
    text.colour(look.emissive) << " shininess " << look.shininess << " }\n";
    if (!look.texture.empty()) text << "          texture ImageTexture { url \"" << look.texture << "\" }\n";
    text << "        }\n";
}

// Writes all parts of a room with the same look as one shape.
void write_shape(Text& text, const World& world, const std::string& room, const std::string& name) {
    std::vector<vec3> points;
    std::vector<vec3> normals;
    std::vector<vec2> uvs;
    std::vector<std::array<int, 3>> faces;
    const Look& look = world.looks.at(name);
    for (const WorldPart& part : world.parts) {
        if (part.room != room || part.look != name) continue;
        const auto first = static_cast<int>(points.size());
        points.insert(points.end(), part.mesh.positions.begin(), part.mesh.positions.end());
        normals.insert(normals.end(), part.mesh.normals.begin(), part.mesh.normals.end());
        uvs.insert(uvs.end(), part.mesh.uvs.begin(), part.mesh.uvs.end());
        for (const glm::uvec3& t : part.mesh.triangles) {
            faces.push_back(
                {first + static_cast<int>(t.x), first + static_cast<int>(t.y), first + static_cast<int>(t.z)});
        }
    }
    text << "      # " << name << "\n      Shape {\n";
    write_look(text, look);
    text << "        geometry IndexedFaceSet {\n          solid TRUE\n          ccw TRUE\n";
    list<vec3>(text, "coord Coordinate { point", points, ",");
    text << "          }\n";
    list<vec3>(text, "normal Normal { vector", normals, ",");
    text << "          }\n";
    if (!look.texture.empty()) {
        RS_CHECK(uvs.size() == points.size());
        list<vec2>(text, "texCoord TextureCoordinate { point", uvs, ",");
        text << "          }\n";
    }
    text << "          coordIndex [";
    for (std::size_t i = 0; i < faces.size(); ++i) {
        text << (i % 8 == 0 ? "\n            " : " ") << faces[i][0] << " " << faces[i][1] << " " << faces[i][2]
             << " -1";
    }
    text << " ]\n        }\n      }\n";
}

void write_light(Text& text, const WorldLight& light) {
    if (light.kind == WorldLightKind::directional) {
        text << "      DirectionalLight { direction " << light.place;
    } else {
        text << "      PointLight { location " << light.place << " attenuation 0 0 " << light.falloff_per_m2
             << " radius " << light.reach_m;
    }
    text << " intensity " << light.intensity << " ambientIntensity " << light.ambient << " color ";
    text.colour(light.colour) << " }\n";
}

void write_viewpoint(Text& text, const WorldView& view) {
    // VRML's orientation rotates the default viewing direction -Z.
    const vec3 sight = glm::normalize(view.at - view.eye);
    const float heading = std::atan2(-sight.x, -sight.z);
    const float pitch = std::asin(sight.y);
    const float ch = std::cos(0.5F * heading);
    const float sh = std::sin(0.5F * heading);
    const float cp = std::cos(0.5F * pitch);
    const float sp = std::sin(0.5F * pitch);
    // The quaternion of heading (about Y) after pitch (about X), as axis and angle.
    const vec3 axis{ch * sp, sh * cp, -sh * sp};
    const float sine = glm::length(axis);
    const float angle = 2.0F * std::atan2(sine, ch * cp);
    text << "Viewpoint { description \"" << view.name << "\" position " << view.eye << " orientation "
         << (sine > 1e-6F ? axis / sine : vec3{0, 1, 0}) << " " << angle << " fieldOfView 0.8 }\n";
}

}  // namespace

std::string vrml_text(const World& world, const std::string& objects) {
    Text text;
    text << "#VRML V2.0 utf8\n\nWorldInfo { title \"Showroom\" }\n";
    text << "NavigationInfo { type [ \"WALK\", \"ANY\" ] avatarSize [ 0.25, 1.6, 0.4 ] speed 1.2 headlight FALSE }\n";
    text << "Background {\n  skyColor [ 0.36 0.55 0.80, 0.62 0.76 0.90, 0.93 0.94 0.93 ]\n  skyAngle [ 1.1, 1.57 ]\n"
            "  groundColor [ 0.45 0.43 0.41, 0.62 0.60 0.57, 0.80 0.79 0.77 ]\n  groundAngle [ 1.3, 1.57 ]\n}\n";
    for (const WorldView& view : world.viewpoints) write_viewpoint(text, view);
    for (const Room& room : world.rooms) {
        text << "\nRaySpaceRoom {\n  description \"" << room.name << "\"\n  bboxCenter "
             << 0.5F * (room.low + room.high) << "\n  bboxSize " << room.high - room.low << "\n  children [\n";
        for (const WorldLight& light : room.lights) write_light(text, light);
        for (const auto& [name, look] : world.looks) {
            for (const WorldPart& part : world.parts) {
                if (part.room != room.name || part.look != name) continue;
                write_shape(text, world, room.name, name);
                break;
            }
        }
        for (const WorldObject& object : world.objects) {
            if (object.room != room.name) continue;
            const auto turn_rad = static_cast<float>(radians(static_cast<double>(object.turn_deg)));
            text << "      Transform {\n        translation " << object.foot << "\n        rotation 0 1 0 " << turn_rad
                 << "\n        children RaySpace { url \"" << objects << "/" << object.name << ".rso\" size "
                 << object.size << " description \"" << object.name << "\" }\n      }\n";
        }
        text << "  ]\n}\n";
    }
    return std::move(text).take();
}

std::string walk_text(const World& world) {
    const auto triple = [](vec3 v) {
        nlohmann::json list = nlohmann::json::array();
        for (int k = 0; k < 3; ++k) list.push_back(std::round(static_cast<double>(v[k]) * 1e4) / 1e4);
        return list;
    };
    nlohmann::json path = nlohmann::json::array();
    for (const WorldView& view : world.walk) path.push_back({{"eye", triple(view.eye)}, {"at", triple(view.at)}});
    const nlohmann::json walk{
        {"camera", {{"path", path}, {"frames", world.walk_frames}, {"closed", false}, {"fov_degrees", 72}}}};
    return walk.dump(1) + "\n";
}

Status write_world(const World& world, const std::filesystem::path& output, const std::string& name,
                   const std::string& objects, bool force) {
    RS_ASSIGN_OR_RETURN(StagedFolder staged, StagedFolder::create(output, "rooms of a showroom", force));
    const auto write_text = [&](const std::string& file, const std::string& text) -> Status {
        return write_file(staged.temporary_path() / file, text);
    };
    for (const auto& [file, image] : world.textures) {
        if (Status status = write_png(staged.temporary_path() / file, image); !status) return status;
    }
    if (Status status = write_text(name + ".wrl", vrml_text(world, objects)); !status) return status;
    if (Status status = write_text(name + "-walk.json", walk_text(world)); !status) return status;
    if (Status status = write_text("evening.json", evening_lights(world)); !status) return status;
    if (Status status = write_text(kDownlightFile, downlight_ies()); !status) return status;
    return staged.commit();
}

namespace {

constexpr double kPower = 1.5;
constexpr double kLumens = 560;
constexpr double kStep_deg = 2.5;
constexpr float kBelowCeiling_m = 0.3F;
constexpr float kApart_m = 2.0F;

double rounded(double value) {
    return std::round(value * 1e4) / 1e4;
}

nlohmann::ordered_json luminaire_at(const glm::vec3& place, const glm::vec3& colour) {
    const auto triple = [](const glm::vec3& v) {
        return nlohmann::ordered_json{rounded(static_cast<double>(v.x)), rounded(static_cast<double>(v.y)),
                                      rounded(static_cast<double>(v.z))};
    };
    return {{"kind", "luminaire"}, {"file", kDownlightFile}, {"location", triple(place)}, {"colour", triple(colour)}};
}

}  // namespace

std::string downlight_ies() {
    // The flux of cos^p over the lower half is 2 pi / (p + 1).
    const double peak = kLumens * (kPower + 1) / (2 * kPi);
    const int rows = static_cast<int>(90 / kStep_deg) + 1;
    std::string text =
        "IESNA:LM-63-2002\n[TEST]none: computed\n[MANUFAC]Rayspace\n[LUMCAT]downlight\n"
        "[LUMINAIRE]round downlight of the showroom\nTILT=NONE\n";
    text += "1 -1 1 " + std::to_string(rows) + " 1 1 2 -0.12 -0.12 0\n1 1 7\n";
    char number[32];
    for (int row = 0; row < rows; ++row) {
        std::snprintf(number, sizeof number, "%g%c", row * kStep_deg, row % 10 == 9 || row + 1 == rows ? '\n' : ' ');
        text += number;
    }
    text += "0\n";
    for (int row = 0; row < rows; ++row) {
        const double candela = peak * std::pow(std::max(std::cos(radians(row * kStep_deg)), 0.0), kPower);
        std::snprintf(number, sizeof number, "%.2f%c", candela, row % 10 == 9 || row + 1 == rows ? '\n' : ' ');
        text += number;
    }
    return text;
}

std::string evening_lights(const World& world) {
    const glm::vec3 warm(1.0F, 0.8F, 0.55F), neutral(1.0F, 0.95F, 0.88F);
    nlohmann::ordered_json list;
    list["replace"] = true;
    list["lights"] = nlohmann::ordered_json::array();
    for (const Room& room : world.rooms) {
        const bool lamps = std::ranges::any_of(
            room.lights, [](const WorldLight& light) { return light.kind == WorldLightKind::point; });
        const glm::vec3 size = room.high - room.low;
        const int columns = std::max(static_cast<int>(std::lround(size.x / kApart_m)), 1);
        const int rows = std::max(static_cast<int>(std::lround(size.z / kApart_m)), 1);
        for (int row = 0; row < rows; ++row) {
            for (int column = 0; column < columns; ++column) {
                const glm::vec3 place(
                    room.low.x + size.x * (static_cast<float>(column) + 0.5F) / static_cast<float>(columns),
                    room.high.y - kBelowCeiling_m,
                    room.low.z + size.z * (static_cast<float>(row) + 0.5F) / static_cast<float>(rows));
                list["lights"].push_back(luminaire_at(place, lamps ? warm : neutral));
            }
        }
        for (const WorldLight& light : room.lights) {
            if (light.kind == WorldLightKind::point) list["lights"].push_back(luminaire_at(light.place, warm));
        }
    }
    return list.dump(1) + "\n";
}

}  // namespace rs::synthetic
