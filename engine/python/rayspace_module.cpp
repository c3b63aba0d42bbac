// Python module `rayspace`: bindings of the public library (rayspace/api) under the same names. rayspace.pyi has its
// type stubs; tests/python/stub_test.py compares both.

#include "rayspace/api/builder.hpp"
#include "rayspace/api/evaluation.hpp"
#include "rayspace/api/renderer.hpp"
#include "rayspace/api/version.hpp"

#include <pybind11/functional.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>

namespace py = pybind11;

namespace rs::api {
namespace {

using Path = std::filesystem::path;
using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Bytes = py::array_t<std::uint8_t, py::array::c_style | py::array::forcecast>;
using Floats = py::array_t<float, py::array::c_style | py::array::forcecast>;

struct Failure : std::runtime_error {
    using std::runtime_error::runtime_error;
};

template <class T>
T value_of(Result<T> result) {
    if (!result) throw Failure(result.error().message);
    return std::move(result).value();
}

void check(const Status& status) {
    if (!status) throw Failure(status.error().message);
}

// Calls `function` with the interpreter lock (GIL) released.
template <class Function>
auto unlocked(const Function& function) {
    const py::gil_scoped_release other_threads_run;
    return function();
}

py::array_t<std::uint8_t> to_array(const Image<Rgba8>& image) {
    py::array_t<std::uint8_t> array({image.height(), image.width(), 4});
    std::memcpy(array.mutable_data(), image.data(), image.pixels().size_bytes());
    return array;
}

py::array_t<float> to_array(const Image<float>& image) {
    py::array_t<float> array({image.height(), image.width()});
    std::memcpy(array.mutable_data(), image.data(), image.pixels().size_bytes());
    return array;
}

ConstImageView<Rgba8> image_of(const Bytes& array) {
    if (array.ndim() != 3 || array.shape(2) != 4) throw Failure("the image must be uint8 of shape (height, width, 4)");
    const auto width = static_cast<int>(array.shape(1));
    return {reinterpret_cast<const Rgba8*>(array.data()), width, static_cast<int>(array.shape(0)), width};
}

ConstImageView<float> depth_of(const Floats& array) {
    if (array.ndim() != 2) throw Failure("the depth must be float32 of shape (height, width)");
    const auto width = static_cast<int>(array.shape(1));
    return {array.data(), width, static_cast<int>(array.shape(0)), width};
}

Camera make_camera(const Numbers& world_from_camera, int width, int height, std::optional<double> fov_x_rad,
                   std::optional<double> fl_x, std::optional<double> fl_y, std::optional<double> cx,
                   std::optional<double> cy) {
    const Numbers& pose = world_from_camera;
    if (pose.ndim() != 2 || pose.shape(0) < 3 || pose.shape(0) > 4 || pose.shape(1) != 4) {
        throw Failure("world_from_camera must be a matrix of 4x4 or 3x4 numbers, as in transforms.json");
    }
    if (fov_x_rad.has_value() == fl_x.has_value()) throw Failure("give either fov_x_rad or fl_x (pixels)");
    Camera camera;
    camera.width = width;
    camera.height = height;
    camera.fl_x = fl_x ? *fl_x : 0.5 * width / std::tan(0.5 * *fov_x_rad);
    camera.fl_y = fl_y.value_or(camera.fl_x);
    camera.cx = cx.value_or(0.5 * width);
    camera.cy = cy.value_or(0.5 * height);
    for (py::ssize_t row = 0; row < pose.shape(0); ++row) {
        for (py::ssize_t column = 0; column < 4; ++column) {
            camera.world_from_camera[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] =
                pose.at(row, column);
        }
    }
    return camera;
}

py::array_t<double> pose_of(const Camera& camera) {
    py::array_t<double> array({4, 4});
    std::memcpy(array.mutable_data(), camera.world_from_camera.data(), sizeof camera.world_from_camera);
    return array;
}

Renderer make_renderer(const Object& object, const std::string& executor, std::int64_t decoded_budget_bytes) {
    return unlocked([&] {
        if (executor == "core") {
            return value_of(Renderer::create(object, {.decoded_budget_bytes = decoded_budget_bytes}));
        }
        return value_of(Renderer::create(object, value_of(ExecutorTable().create(executor))));
    });
}

py::object depth_or_none(const RenderedView& view) {
    return view.depth.empty() ? py::none() : py::object(to_array(view.depth));
}

// Wraps a callback: its exceptions are reported as unraisable and do not stop the call.
ProgressCallback guarded(std::optional<ProgressCallback> progress) {
    if (!progress) return {};
    return [progress = std::move(*progress)](const std::string& stage, double fraction) {
        const py::gil_scoped_acquire lock;
        try {
            progress(stage, fraction);
        } catch (py::error_already_set& error) {
            error.discard_as_unraisable("rayspace progress");
        }
    };
}

void add_images(py::module_& module) {
    py::class_<ImageScore>(module, "ImageScore",
                           "Similarity of two images, over pixels where either image's alpha is above 0.")
        .def_readonly("psnr_db", &ImageScore::psnr_db, "peak 255 over R, G, B; 99 if equal")
        .def_readonly("ssim", &ImageScore::ssim, "mean over R, G, B; 1 if equal");
    module.def(
        "read_image", [](const Path& path) { return to_array(unlocked([&] { return value_of(read_image(path)); })); },
        py::arg("path"), "Reads an image file as uint8 (height, width, 4): sRGB with straight alpha.");
    module.def(
        "write_png", [](const Path& path, const Bytes& image) { check(write_png(path, image_of(image))); },
        py::arg("path"), py::arg("image"), "Writes uint8 (height, width, 4) as a PNG file.");
    module.def(
        "write_depth_exr", [](const Path& path, const Floats& depth) { check(write_depth_exr(path, depth_of(depth))); },
        py::arg("path"), py::arg("depth"), "Writes float32 (height, width) as channel Z of an OpenEXR file.");
    module.def(
        "compare_images",
        [](const Bytes& a, const Bytes& b) { return value_of(compare_images(image_of(a), image_of(b))); }, py::arg("a"),
        py::arg("b"), "PSNR and SSIM of two images, uint8 (height, width, 4).");
}

void add_cameras(py::module_& module) {
    py::class_<Camera>(
        module, "Camera",
        "Pinhole camera with OpenGL axes: +X right, +Y up, viewing direction -Z. Lengths are in the units "
        "of the object's capture set.")
        .def(py::init(&make_camera), py::arg("world_from_camera"), py::arg("width"), py::arg("height"), py::kw_only(),
             py::arg("fov_x_rad") = py::none(), py::arg("fl_x") = py::none(), py::arg("fl_y") = py::none(),
             py::arg("cx") = py::none(), py::arg("cy") = py::none(),
             "world_from_camera: 4x4 or 3x4, the transform_matrix of a transforms.json. Either fov_x_rad, the "
             "horizontal field of view, or fl_x in pixels. The principal point is the middle if not given.")
        .def_readwrite("width", &Camera::width, "px")
        .def_readwrite("height", &Camera::height, "px")
        .def_readwrite("fl_x", &Camera::fl_x, "focal length, px")
        .def_readwrite("fl_y", &Camera::fl_y, "focal length, px")
        .def_readwrite("cx", &Camera::cx, "principal point, px from the left edge")
        .def_readwrite("cy", &Camera::cy, "principal point, px from the top edge")
        .def_property_readonly("world_from_camera", &pose_of, "float64 (4, 4), a copy");
    py::class_<CapturedCamera>(module, "CapturedCamera", "Camera of a photo of a capture set.")
        .def_readonly("file", &CapturedCamera::file, "path of the photo relative to the set's folder")
        .def_readonly("camera", &CapturedCamera::camera, "in the set's units");
    module.def(
        "look_at",
        [](const Vector3& eye, const Vector3& target, double fov_x_rad, int width, int height) {
            return value_of(look_at(eye, target, fov_x_rad, width, height));
        },
        py::arg("eye"), py::arg("target"), py::arg("fov_x_rad"), py::arg("width"), py::arg("height"),
        "A camera with square pixels and the principal point in the middle.");
    module.def(
        "read_cameras", [](const Path& set) { return value_of(read_cameras(set)); }, py::arg("set"),
        "The cameras of a capture set: a folder with a transforms.json, or that file.");
}

void add_object(py::module_& module) {
    py::class_<RingInfo>(module, "RingInfo", "Ring of photos: one turn at one elevation.")
        .def_readonly("elevation_deg", &RingInfo::elevation_deg, "of the cameras above the horizontal plane")
        .def_readonly("photos", &RingInfo::photos, "number of photos")
        .def_readonly("planes", &RingInfo::planes, "number of reference planes")
        .def_readonly("has_depth", &RingInfo::has_depth, "True if the ring has a depth for every ray");
    py::class_<Object>(module, "Object", "Ray-space object. Open one with Object.open().")
        .def_static(
            "open",
            [](const Path& path, int level, std::uint64_t memory_cap_bytes) {
                return unlocked([&] { return value_of(Object::open(path, {level, memory_cap_bytes})); });
            },
            py::arg("path"), py::kw_only(), py::arg("level") = OpenOptions{}.level,
            py::arg("memory_cap_bytes") = OpenOptions{}.memory_cap_bytes,
            "Opens an .rso file. level: 0 loads every 8th photo of a ring, 1 every 4th, 2 every 2nd, 3 all.")
        .def_property_readonly("has_all_photos", &Object::has_all_photos, "True if no photo is missing")
        .def_property_readonly("name", &Object::name, "name of the object")
        .def_property_readonly("width", &Object::width, "of the photos, px")
        .def_property_readonly("height", &Object::height, "of the photos, px")
        .def_property_readonly("photos", &Object::photos, "number of photos")
        .def_property_readonly("rings", &Object::rings, "list of RingInfo")
        .def_property_readonly("units_per_radius", &Object::units_per_radius,
                               "length of the object radius in the units of the capture set")
        .def_property_readonly("ground_height", &Object::ground_height,
                               "Y of the ground in the units of the capture set, or None")
        .def(
            "captured_cameras", [](const Object& object) { return value_of(object.captured_cameras()); },
            "Cameras of the stored photos, in the order of photo().")
        .def(
            "photo",
            [](const Object& object, int index) {
                return to_array(unlocked([&] { return value_of(object.photo(index)); }));
            },
            py::arg("index"), "A stored photo as uint8 (height, width, 4).")
        .def(
            "orbit",
            [](const Object& object, int count, std::optional<int> width, std::optional<int> height,
               std::optional<double> fov_x_rad) {
                return value_of(object.orbit(count, {width, height, fov_x_rad}));
            },
            py::arg("count"), py::kw_only(), py::arg("width") = py::none(), py::arg("height") = py::none(),
            py::arg("fov_x_rad") = py::none(),
            "Cameras of an orbit about the Y axis at even steps, with the distance, height and tilt of the first "
            "photo.")
        .def(
            "look_at",
            [](const Object& object, const Vector3& eye, const Vector3& target, std::optional<int> width,
               std::optional<int> height, std::optional<double> fov_x_rad) {
                return value_of(object.look_at(eye, target, {width, height, fov_x_rad}));
            },
            py::arg("eye"), py::arg("target"), py::kw_only(), py::arg("width") = py::none(),
            py::arg("height") = py::none(), py::arg("fov_x_rad") = py::none(),
            "A camera from an eye to a target, both in object radii.")
        .def(
            "write",
            [](const Object& object, const Path& path) { check(unlocked([&] { return object.write(path); })); },
            py::arg("path"), "Writes an .rso file.")
        .def(
            "extract",
            [](const Object& object, const Path& folder) { check(unlocked([&] { return object.extract(folder); })); },
            py::arg("folder"), "Writes the stored photos and their transforms.json as a capture set.");
}

void add_renderer(py::module_& module) {
    py::enum_<Filter>(module, "Filter", "Sampling of the photos of objects with depth.")
        .value("AUTO", Filter::kAuto, "by the scale of the view")
        .value("SHARP", Filter::kSharp, "close to bicubic")
        .value("BILINEAR", Filter::kBilinear, "mean of four pixels")
        .value("SMOOTH", Filter::kSmooth, "low-pass, for views smaller than the photos");
    py::class_<RenderedView>(module, "RenderedView", "A rendered view.")
        .def_property_readonly(
            "image", [](const RenderedView& view) { return to_array(view.image); },
            "uint8 (height, width, 4): sRGB with straight alpha")
        .def_property_readonly("depth", &depth_or_none,
                               "float32 (height, width): axial depth in the units of the capture set, 0 where alpha "
                               "is 0; None if not requested");
    py::class_<Renderer>(module, "Renderer", "Renders views of one object. Create one with Renderer.create().")
        .def_static("create", &make_renderer, py::arg("object"), py::kw_only(), py::arg("executor") = "core",
                    py::arg("decoded_budget_bytes") = RendererOptions{}.decoded_budget_bytes,
                    "executor: one of executor_names(). decoded_budget_bytes: memory of the core for decoded photos.")
        .def_property_readonly("object", &Renderer::object, "the object")
        .def(
            "render",
            [](const Renderer& renderer, const Camera& camera, Filter filter, bool depth) {
                return unlocked([&] { return value_of(renderer.render(camera, {filter, depth})); });
            },
            py::arg("camera"), py::kw_only(), py::arg_v("filter", Filter::kAuto, "Filter.AUTO"),
            py::arg("depth") = false, "Renders a view. Thread-safe.");
    module.def(
        "executor_names", [] { return ExecutorTable().names(); },
        "Names of the executors, such as \"scalar, core, board:CONFIG\".");
}

void add_builder(py::module_& module) {
    py::enum_<MapKind>(module, "MapKind", "RS map of an object.")
        .value("SHAPE", MapKind::kShape, "a depth for every ray, found from the photos")
        .value("PLANE", MapKind::kPlane, "the object is assumed to lie on the reference planes");
    py::enum_<PhotoCoding>(module, "PhotoCoding", "Storage of the photos.")
        .value("DENSE", PhotoCoding::kDense, "smallest")
        .value("BOARD", PhotoCoding::kBoard, "records of fixed sizes, for hardware")
        .value("RAW", PhotoCoding::kRaw, "uncompressed, 2.5 bytes per pixel");
    py::class_<BuiltObject>(module, "BuiltObject", "A built object.")
        .def_readonly("object", &BuiltObject::object, "in memory; Object.write() stores it")
        .def_readonly("warnings", &BuiltObject::warnings, "properties of the set that limit the quality, one line each")
        .def_readonly("photos_psnr_db", &BuiltObject::photos_psnr_db, "fidelity of compressed photos, or None");
    module.def(
        "build_object",
        [](const Path& set, const std::string& name, MapKind map, int planes, PhotoCoding coding, double quality,
           std::optional<double> psnr_db, std::optional<std::uint64_t> photos_bytes, int effort,
           std::optional<int> alpha_bits, std::optional<ProgressCallback> progress) {
            const BuildOptions options{name,    map,          planes, coding,     quality,
                                       psnr_db, photos_bytes, effort, alpha_bits, guarded(std::move(progress))};
            return unlocked([&] { return value_of(build_object(set, options)); });
        },
        py::arg("set"), py::kw_only(), py::arg("name") = "", py::arg_v("map", MapKind::kShape, "MapKind.SHAPE"),
        py::arg("planes") = 12, py::arg_v("coding", PhotoCoding::kDense, "PhotoCoding.DENSE"),
        py::arg("quality") = 75.0, py::arg("psnr_db") = py::none(), py::arg("photos_bytes") = py::none(),
        py::arg("effort") = 5, py::arg("alpha_bits") = py::none(), py::arg("progress") = py::none(),
        "Builds an object from a capture set. The first given option of photos_bytes, psnr_db and quality is used. "
        "progress is called with the stage and its fraction done.");
}

void add_evaluation(py::module_& module) {
    py::class_<ViewScore>(module, "ViewScore", "Score of one view.")
        .def_readonly("photo", &ViewScore::photo, "path relative to the set's folder")
        .def_readonly("score", &ViewScore::score, "rendered view against the photo");
    py::class_<Evaluation>(module, "Evaluation", "Scores of all views.")
        .def_readonly("views", &Evaluation::views, "list of ViewScore, in the set's order")
        .def_readonly("mean_psnr_db", &Evaluation::mean_psnr_db, "mean of the views' dB")
        .def_readonly("pooled_psnr_db", &Evaluation::pooled_psnr_db, "dB of all object pixels taken together")
        .def_readonly("mean_ssim", &Evaluation::mean_ssim, "mean of the views' SSIM");
    module.def(
        "compare_with_photos",
        [](const Renderer& renderer, const Path& set, Filter filter) {
            return unlocked([&] { return value_of(compare_with_photos(renderer, set, {.filter = filter})); });
        },
        py::arg("renderer"), py::arg("set"), py::kw_only(), py::arg_v("filter", Filter::kAuto, "Filter.AUTO"),
        "Renders every pose of a capture set and compares it with the set's photo.");
    module.def(
        "evaluate_held_out",
        [](const Path& set, int every, MapKind map, int planes, std::optional<ProgressCallback> progress) {
            const HoldOutOptions options{every, map, planes, guarded(std::move(progress))};
            return unlocked([&] { return value_of(evaluate_held_out(set, options)); });
        },
        py::arg("set"), py::kw_only(), py::arg("every") = 2, py::arg_v("map", MapKind::kShape, "MapKind.SHAPE"),
        py::arg("planes") = 12, py::arg("progress") = py::none(),
        "Builds an object from some photos of a set, renders the poses of the others, and compares. The middle one of "
        "each "
        "`every` neighbouring photos of a ring is held out.");
}

}  // namespace
}  // namespace rs::api

PYBIND11_MODULE(rayspace, module) {
    module.doc() = "Ray-space objects: build one from photos, open it, render views of it, score them.";
    py::register_exception<rs::api::Failure>(module, "Error", PyExc_RuntimeError).attr("__doc__") =
        "Failure; the message names the file, the place and the remedy.";
    module.def(
        "version",
        [] {
            const rs::api::Version version = rs::api::version();
            return py::make_tuple(version.major, version.minor, version.patch);
        },
        "Version as (major, minor, patch).");
    module.def("version_text", &rs::api::version_text, "Version as text, such as \"1.2.3\".");
    rs::api::add_images(module);
    rs::api::add_cameras(module);
    rs::api::add_object(module);
    rs::api::add_renderer(module);
    rs::api::add_builder(module);
    rs::api::add_evaluation(module);
}
