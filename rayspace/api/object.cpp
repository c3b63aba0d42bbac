#include "rayspace/api/object.hpp"

#include "encode/build.hpp"
#include "engine/core/views/orbit.hpp"
#include "rayspace/api/internal/type_conversion.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/codec/stream/decode_image.hpp"
#include "rayspace/format/object_file.hpp"
#include "rayspace/object/yuv.hpp"

#include <cmath>
#include <utility>

namespace rs::api {
namespace {

Result<engine::ViewShape> to_internal(const ViewShape& shape) {
    const auto side = [](const std::optional<int>& px) { return !px || (*px >= 1 && *px <= kMaxImageSide_px); };
    if (!side(shape.width) || !side(shape.height)) {
        return Error{"view: its size is outside 1.." + std::to_string(kMaxImageSide_px) + " pixels"};
    }
    if (shape.fov_x_rad && !(*shape.fov_x_rad > 0 && *shape.fov_x_rad < kPi)) {
        return Error{"view: fov_x_rad is outside 0..pi; give radians"};
    }
    return engine::ViewShape{shape.width.value_or(0), shape.height.value_or(0), shape.fov_x_rad};
}

// A coded photo with the photos that it is predicted from, alone.
std::shared_ptr<const codec::CodedImages> coded_photo(const codec::CodedImages& coded, std::size_t view) {
    auto alone = std::make_shared<codec::CodedImages>();
    alone->profile = coded.profile;
    alone->width = coded.width;
    alone->height = coded.height;
    alone->tile_width_log2 = coded.tile_width_log2;
    alone->tile_height_log2 = coded.tile_height_log2;
    alone->dense = coded.dense;
    alone->board = coded.board;
    alone->levels = coded.levels;
    alone->images.resize(coded.images.size());
    std::vector<std::size_t> needed{view};
    while (!needed.empty()) {
        const std::size_t next = needed.back();
        needed.pop_back();
        if (alone->images[next].loaded()) continue;
        const codec::CodedImage& image = alone->images[next] = coded.images[next];
        for (std::size_t r = 0; r < static_cast<std::size_t>(image.head.references()); ++r) {
            needed.push_back(image.head.reference[r]);
        }
    }
    return alone;
}

std::string where(const RaySpaceObject& object) {
    return object.name.empty() ? "object" : object.name;
}

}  // namespace

Result<Object> Object::open(const std::filesystem::path& path, const OpenOptions& options) {
    if (options.level < 0 || options.level >= kProgressiveLevels) {
        return Error{path.string() + ": level " + std::to_string(options.level) + " is outside 0.." +
                     std::to_string(kProgressiveLevels - 1)};
    }
    RS_ASSIGN_OR_RETURN(
        RaySpaceObject object,
        read_object(path, {.max_level = options.level, .memory_cap_bytes = options.memory_cap_bytes, .decode = false}));
    return Object(std::make_shared<const RaySpaceObject>(std::move(object)));
}

Result<Object> Object::create(RaySpaceObject data) {
    RS_TRY(validate_object(data, where(data)));
    return Object(std::make_shared<const RaySpaceObject>(std::move(data)));
}

bool Object::has_all_photos() const {
    for (std::size_t view = 0; view < data_->images.size(); ++view) {
        const bool is_coded = data_->coded && data_->coded->images[view].loaded();
        if (!is_coded && data_->images[view].empty()) return false;
    }
    return true;
}

const std::string& Object::name() const {
    return data_->name;
}

int Object::width() const {
    return data_->width;
}

int Object::height() const {
    return data_->height;
}

int Object::photos() const {
    return static_cast<int>(data_->views.size());
}

std::vector<RingInfo> Object::rings() const {
    std::vector<RingInfo> rings;
    for (const Ring& ring : data_->rings) {
        rings.push_back(
            {ring.elevation_udeg * 1e-6, static_cast<int>(ring.views.size()), ring.planes, !ring.shape.empty()});
    }
    return rings;
}

double Object::units_per_radius() const {
    return data_->units_per_radius;
}

std::optional<double> Object::ground_height() const {
    if (!data_->foot_q20) return std::nullopt;
    return std::ldexp(*data_->foot_q20, -20) * data_->units_per_radius;
}

Result<std::vector<CapturedCamera>> Object::captured_cameras() const {
    if (data_->rig_json.empty()) return Error{where(*data_) + ": holds no rig"};
    RS_ASSIGN_OR_RETURN(const Rig rig, rig_from_json(data_->rig_json, where(*data_) + " (its rig)"));
    return cameras_of(rig);
}

Result<Image<Rgba8>> Object::photo(int index) const {
    if (index < 0 || index >= photos()) {
        return Error{where(*data_) + ": there is no photo " + std::to_string(index) + "; it has " +
                     std::to_string(photos())};
    }
    const auto view = static_cast<std::size_t>(index);
    if (view < data_->images.size() && !data_->images[view].empty()) {
        return rgba_from_planar(data_->images[view]);
    }
    if (!data_->coded || !data_->coded->images[view].loaded()) {
        return Error{where(*data_) + ": photo " + std::to_string(index) + " is not loaded; open the object at level " +
                     std::to_string(kProgressiveLevels - 1)};
    }
    RaySpaceObject alone;
    alone.width = data_->width;
    alone.height = data_->height;
    alone.images.resize(data_->views.size());
    alone.coded = coded_photo(*data_->coded, view);
    codec::decode_images(alone);
    return rgba_from_planar(alone.images[view]);
}

Result<std::vector<Camera>> Object::orbit(int count, const ViewShape& shape) const {
    if (count < 1) return Error{"orbit: " + std::to_string(count) + " views; give 1 or more"};
    RS_ASSIGN_OR_RETURN(const engine::ViewShape internal, to_internal(shape));
    RS_ASSIGN_OR_RETURN(const auto cameras, engine::orbit_cameras(*data_, count, internal));
    std::vector<Camera> orbit;
    for (const rs::Camera& camera : cameras) orbit.push_back(to_public(camera));
    return orbit;
}

Result<Camera> Object::look_at(const Vector3& eye, const Vector3& target, const ViewShape& shape) const {
    RS_ASSIGN_OR_RETURN(const engine::ViewShape internal, to_internal(shape));
    RS_ASSIGN_OR_RETURN(const auto camera, engine::camera_from_eye(*data_, {eye[0], eye[1], eye[2]},
                                                                   {target[0], target[1], target[2]}, internal));
    return to_public(camera);
}

Status Object::write(const std::filesystem::path& path) const {
    return write_object(path, *data_);
}

Status Object::extract(const std::filesystem::path& folder) const {
    if (!has_all_photos()) return Error{where(*data_) + ": photos are not loaded; open the object at level 3"};
    return encode::extract_images(unpacked(), folder);
}

RaySpaceObject Object::unpacked() const {
    RaySpaceObject object = *data_;
    object.images.resize(object.views.size());
    if (object.coded) codec::decode_images(object);
    return object;
}

}  // namespace rs::api
