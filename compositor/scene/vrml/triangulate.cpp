// Triangulation of geometry nodes by Coin.

#include "compositor/scene/vrml/shapes.hpp"

#include "compositor/scene/vrml/node_table.hpp"
#include "rayspace/image/linear_light.hpp"

#include <Inventor/SoDB.h>
#include <Inventor/SoPrimitiveVertex.h>
#include <Inventor/actions/SoCallbackAction.h>
#include <Inventor/elements/SoLazyElement.h>
#include <Inventor/errors/SoDebugError.h>
#include <Inventor/fields/SoFields.h>
#include <Inventor/nodes/SoComplexity.h>
#include <Inventor/nodes/SoSeparator.h>
#include <Inventor/nodes/SoTexture2.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <initializer_list>
#include <mutex>
#include <span>
#include <unordered_map>
#include <utility>

namespace rs::compositor::vrml {
namespace {

// Coin has global state: it is initialised once and used by one thread at a time.
std::unique_lock<std::mutex> coin_session() {
    static std::mutex lock;
    static const bool started = [] {
        SoDB::init();
        SoDebugError::setHandlerCallback([](const SoError*, void*) {}, nullptr);
        return true;
    }();
    static_cast<void>(started);
    return std::unique_lock(lock);
}

class CoinRoot {
public:
    CoinRoot() : node_(new SoSeparator) { node_->ref(); }
    CoinRoot(const CoinRoot&) = delete;
    CoinRoot& operator=(const CoinRoot&) = delete;
    ~CoinRoot() { node_->unref(); }
    SoSeparator* operator->() const { return node_; }
    [[nodiscard]] SoSeparator* get() const { return node_; }

private:
    SoSeparator* node_;
};

// Coin's tessellation quality of spheres, cylinders and cones, 0..1.
constexpr float kRoundness = 0.8F;

// Collects Coin's primitives. Corners with equal attributes become one vertex.
class MeshCollector {
public:
    explicit MeshCollector(bool clockwise) : clockwise_(clockwise) {}

    void add_to(SoCallbackAction& action) {
        action.addTriangleCallback(
            SoNode::getClassTypeId(),
            [](void* self, SoCallbackAction* at, const SoPrimitiveVertex* a, const SoPrimitiveVertex* b,
               const SoPrimitiveVertex* c) {
                static_cast<MeshCollector*>(self)->add(Topology::kTriangles, at, {a, b, c});
            },
            this);
        action.addLineSegmentCallback(
            SoNode::getClassTypeId(),
            [](void* self, SoCallbackAction* at, const SoPrimitiveVertex* a, const SoPrimitiveVertex* b) {
                static_cast<MeshCollector*>(self)->add(Topology::kLines, at, {a, b});
            },
            this);
        action.addPointCallback(
            SoNode::getClassTypeId(),
            [](void* self, SoCallbackAction* at, const SoPrimitiveVertex* a) {
                static_cast<MeshCollector*>(self)->add(Topology::kPoints, at, {a});
            },
            this);
    }

    [[nodiscard]] Mesh take() { return std::move(mesh_); }

private:
    void add(Topology topology, SoCallbackAction* action, std::initializer_list<const SoPrimitiveVertex*> corners) {
        mesh_.topology = topology;
        for (const SoPrimitiveVertex* corner : corners) mesh_.indices.push_back(vertex_of(*corner, *action));
        // VRML's ccw FALSE: front and back are swapped.
        if (clockwise_ && topology == Topology::kTriangles) std::swap(mesh_.indices.end()[-1], mesh_.indices.end()[-2]);
    }

    std::uint32_t vertex_of(const SoPrimitiveVertex& corner, SoCallbackAction& action) {
        const SbVec3f& p = corner.getPoint();
        const SbVec3f& n = corner.getNormal();
        const SbVec4f& t = corner.getTextureCoords();
        SbColor ambient;
        SbColor diffuse;
        SbColor specular;
        SbColor emissive;
        float shininess = 0;
        float transparency = 0;
        // Coin does not check the index.
        const int last = SoLazyElement::getInstance(action.getState())->getNumDiffuse() - 1;
        action.getMaterial(ambient, diffuse, specular, emissive, shininess, transparency,
                           std::clamp(corner.getMaterialIndex(), 0, std::max(last, 0)));
        MeshVertex vertex;
        vertex.position = {p[0], p[1], p[2]};
        vertex.normal = {n[0], n[1], n[2]};
        const float length = glm::length(vertex.normal);
        vertex.normal = length > 0 && mesh_.topology == Topology::kTriangles ? vertex.normal / length : glm::vec3(0);
        vertex.texture = t[3] != 0 ? glm::vec2(t[0], t[1]) / t[3] : glm::vec2(0);
        vertex.colour = {linear_from_srgb(diffuse[0]), linear_from_srgb(diffuse[1]), linear_from_srgb(diffuse[2]), 1};
        const auto key = std::bit_cast<Key>(std::array<float, 11>{
            vertex.position.x, vertex.position.y, vertex.position.z, vertex.normal.x, vertex.normal.y, vertex.normal.z,
            vertex.texture.x, vertex.texture.y, vertex.colour.r, vertex.colour.g, vertex.colour.b});
        const auto [found, is_new] = known_.emplace(key, static_cast<std::uint32_t>(mesh_.vertices.size()));
        if (is_new) mesh_.vertices.push_back(vertex);
        return found->second;
    }

    bool clockwise_;
    Mesh mesh_;
    using Key = std::array<std::uint32_t, 11>;
    struct Hash {
        std::size_t operator()(const Key& key) const {
            std::size_t hash = 0;
            for (const std::uint32_t word : key) hash = (hash ^ word) * 0x9e3779b97f4a7c15U + (hash >> 29U);
            return hash;
        }
    };
    std::unordered_map<Key, std::uint32_t, Hash> known_;
};

template <class Field>
Field* as(SoField& field) {
    return field.getTypeId() == Field::getClassTypeId() ? static_cast<Field*>(&field) : nullptr;
}

// Sets fields of a geometry node other than node fields.
void set_field(SoField& field, const Value& value) {
    // Some lists are not empty by default.
    if (auto* list = dynamic_cast<SoMField*>(&field)) list->setNum(0);
    const std::vector<double>& n = value.numbers;
    if (n.empty() && value.texts.empty()) return;
    std::vector<float> floats(n.begin(), n.end());
    const auto count = [&](std::size_t each) { return static_cast<int>(floats.size() / each); };
    if (auto* flag = as<SoSFBool>(field)) flag->setValue(n.at(0) != 0);
    if (auto* integer = as<SoSFInt32>(field)) integer->setValue(static_cast<std::int32_t>(n.at(0)));
    if (auto* number = as<SoSFFloat>(field)) number->setValue(floats.at(0));
    if (auto* triple = as<SoSFVec3f>(field)) triple->setValue(floats.at(0), floats.at(1), floats.at(2));
    if (auto* text = as<SoSFString>(field)) text->setValue(value.texts.at(0).c_str());
    if (auto* list = as<SoMFFloat>(field)) list->setValues(0, count(1), floats.data());
    if (auto* list = as<SoMFVec2f>(field))
        list->setValues(0, count(2), reinterpret_cast<const float(*)[2]>(floats.data()));
    if (auto* list = as<SoMFVec3f>(field))
        list->setValues(0, count(3), reinterpret_cast<const float(*)[3]>(floats.data()));
    if (auto* list = as<SoMFColor>(field))
        list->setValues(0, count(3), reinterpret_cast<const float(*)[3]>(floats.data()));
    if (auto* list = as<SoMFRotation>(field)) {
        for (int i = 0; i < count(4); ++i) {
            const float* turn = floats.data() + std::ptrdiff_t{i} * 4;
            list->set1Value(i, SbRotation(SbVec3f(turn[0], turn[1], turn[2]), turn[3]));
        }
    }
    if (auto* list = as<SoMFString>(field)) {
        for (std::size_t i = 0; i < value.texts.size(); ++i)
            list->set1Value(static_cast<int>(i), value.texts[i].c_str());
    }
}

class CoinShape {
public:
    CoinShape(const Node& geometry, const ShapeCheck& check) : check_(check), node_(new_coin_node(geometry)) {
        const IndexedLists& lists = check.lists;
        if (geometry.type != "IndexedFaceSet" && geometry.type != "IndexedLineSet") return;
        set_list("coordIndex", lists.coord);
        set_list("colorIndex", lists.color);
        if (geometry.type == "IndexedLineSet") return;
        set_list("normalIndex", lists.normal);
        set_list("texCoordIndex", lists.texture);
    }
    [[nodiscard]] SoNode* get() const { return node_; }

private:
    SoNode* new_coin_node(const Node& from) const {
        auto* node = static_cast<SoNode*>(SoType::fromName(("VRML" + from.type).c_str()).createInstance());
        for (const auto& [name, spec] : from.spec->fields) {
            SoField* field = node->getField(name.c_str());
            const Value& value = from.field(name);
            const bool usable =
                std::find(check_.unusable.begin(), check_.unusable.end(), name) == check_.unusable.end();
            if (field == nullptr || name.ends_with("Index") || !usable) continue;  // X3D's `solid` of a Box
            if (spec.type != FieldType::kNode) {
                set_field(*field, value);
                continue;
            }
            if (!value.nodes.empty()) static_cast<SoSFNode*>(field)->setValue(new_coin_node(*value.nodes.front()));
        }
        return node;
    }

    void set_list(const char* name, const std::vector<std::int32_t>& list) const {
        auto* field = static_cast<SoMFInt32*>(node_->getField(name));
        field->setNum(0);
        if (!list.empty()) field->setValues(0, static_cast<int>(list.size()), list.data());
    }

    const ShapeCheck& check_;
    SoNode* node_;
};

// True if only the front is visible.
bool is_solid(const Node& node) {
    if (node.has("solid") && !node.flag("solid")) return false;
    // Cones and cylinders are closed unless parts are removed.
    for (const char* part : {"side", "bottom", "top"}) {
        if (node.has(part) && !node.flag(part)) return false;
    }
    return node.type != "Text";
}

// Default texture coordinates of face sets: s along the longest side of the bounding box, t along the second longest,
// both scaled by the longest (ISO/IEC 14772-1, 6.23). For equal sides X precedes Y precedes Z, while Coin prefers Y.
void map_by_box(Mesh& mesh) {
    const BoundingBox box = bounds_of(mesh);
    const glm::dvec3 size = box.highest - box.lowest;
    std::array<int, 3> axes = {0, 1, 2};
    std::stable_sort(axes.begin(), axes.end(), [&](int a, int b) { return size[a] > size[b]; });
    if (!(size[axes[0]] > 0)) return;
    for (MeshVertex& vertex : mesh.vertices) {
        const glm::dvec3 place = (glm::dvec3(vertex.position) - box.lowest) / size[axes[0]];
        vertex.texture = {place[axes[0]], place[axes[1]]};
    }
}

glm::vec4 listed_colour(const std::vector<double>& codes, std::size_t i) {
    const auto linear = [&](std::size_t channel) {
        return linear_from_srgb(std::clamp(static_cast<float>(codes[3 * i + channel]), 0.0F, 1.0F));
    };
    return {linear(0), linear(1), linear(2), 1};
}

// Coin ignores the colours of elevation grids.
void colour_grid(Mesh& mesh, const Node& grid) {
    const std::vector<double>& codes = grid.node("color")->field("color").numbers;
    const double columns = grid.number("xDimension");
    const glm::dvec2 spacing(grid.number("xSpacing"), grid.number("zSpacing"));
    const auto place_of = [&](const MeshVertex& vertex) {
        return glm::round(glm::dvec2(vertex.position.x, vertex.position.z) / spacing);
    };
    if (grid.flag("colorPerVertex")) {
        for (MeshVertex& vertex : mesh.vertices) {
            const glm::dvec2 place = place_of(vertex);
            vertex.colour = listed_colour(codes, static_cast<std::size_t>(place.y * columns + place.x));
        }
        return;
    }
    std::vector<MeshVertex> vertices;  // quads of different colours share no corners
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const std::span<std::uint32_t, 3> corners(mesh.indices.data() + i, 3);
        glm::dvec2 quad = place_of(mesh.vertices[corners[0]]);
        for (const std::uint32_t corner : corners) quad = glm::min(quad, place_of(mesh.vertices[corner]));
        for (std::uint32_t& corner : corners) {
            vertices.push_back(mesh.vertices[corner]);
            vertices.back().colour = listed_colour(codes, static_cast<std::size_t>(quad.y * (columns - 1) + quad.x));
            corner = static_cast<std::uint32_t>(vertices.size() - 1);
        }
    }
    mesh.vertices = std::move(vertices);
}

// Coin draws only the first point of coloured sets.
std::shared_ptr<const Mesh> point_set(const Node& geometry, bool has_colours) {
    const std::vector<double>& points = geometry.node("coord")->field("point").numbers;
    auto mesh = std::make_shared<Mesh>();
    mesh->topology = Topology::kPoints;
    mesh->has_colours = has_colours;
    mesh->two_sided = true;
    for (std::size_t i = 0; i + 3 <= points.size(); i += 3) {
        MeshVertex vertex;
        vertex.position = glm::dvec3(points[i], points[i + 1], points[i + 2]);
        if (has_colours) vertex.colour = listed_colour(geometry.node("color")->field("color").numbers, i / 3);
        mesh->indices.push_back(static_cast<std::uint32_t>(mesh->vertices.size()));
        mesh->vertices.push_back(vertex);
    }
    return mesh;
}

}  // namespace

std::shared_ptr<const Mesh> triangulate(const Node& geometry, const ShapeCheck& check) {
    const bool has_colours = geometry.has("color") && geometry.node("color") != nullptr &&
                             std::find(check.unusable.begin(), check.unusable.end(), "color") == check.unusable.end();
    if (geometry.type == "PointSet") return point_set(geometry, has_colours);
    const auto session = coin_session();
    const CoinRoot root;
    auto* complexity = new SoComplexity;
    complexity->value = kRoundness;
    root->addChild(complexity);
    // Coin omits texture coordinates without a texture.
    auto* image = new SoTexture2;
    constexpr unsigned char kTexel[] = {255};
    image->image.setValue(SbVec2s(1, 1), 1, kTexel);
    root->addChild(image);
    root->addChild(CoinShape(geometry, check).get());
    SoCallbackAction action;
    MeshCollector collector(geometry.has("ccw") && !geometry.flag("ccw"));
    collector.add_to(action);
    action.apply(root.get());
    auto mesh = std::make_shared<Mesh>(collector.take());
    if (mesh->indices.empty()) return nullptr;
    if (geometry.type == "IndexedFaceSet" && check.lists.texture.empty()) map_by_box(*mesh);
    if (geometry.type == "ElevationGrid" && has_colours) colour_grid(*mesh, geometry);
    mesh->has_colours = has_colours;
    mesh->two_sided = mesh->topology != Topology::kTriangles || !is_solid(geometry);
    return mesh;
}

}  // namespace rs::compositor::vrml
