// The Python module: open an object, look into it, render views to NumPy, compare with images.

#include "engine/core/fast/renderer.hpp"
#include "engine/core/views/compare.hpp"
#include "engine/core/views/depth_image.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/format/object_file.hpp"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cmath>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <string>

namespace py = pybind11;

namespace rs::engine {
namespace {

struct Failure : std::runtime_error {
    using std::runtime_error::runtime_error;
};

template <class T>
T value_of(Result<T> result) {
    if (!result) throw Failure(result.error().message);
    return std::move(result).value();
}

template <class Pixel>
py::array to_array(const Image<Pixel>& image, py::ssize_t channels) {
    using Number = std::conditional_t<sizeof(Pixel) == 4 && !std::is_same_v<Pixel, float>, std::uint8_t, Pixel>;
    std::vector<py::ssize_t> shape = {image.height(), image.width()};
    if (channels > 1) shape.push_back(channels);
    py::array_t<Number> array(shape);
    std::memcpy(array.mutable_data(), image.data(), image.pixels().size_bytes());
    return array;
}

// A 4x4 (or 3x4) camera-to-world matrix, row by row as transforms.json has it.
Camera camera_of(const py::array_t<double, py::array::c_style | py::array::forcecast>& pose, int width, int height,
                 std::optional<double> fov_deg, std::optional<double> fl_x, std::optional<double> fl_y,
                 std::optional<double> cx, std::optional<double> cy) {
    if (pose.ndim() != 2 || pose.shape(0) < 3 || pose.shape(0) > 4 || pose.shape(1) != 4) {
        throw Failure("the pose must be a camera-to-world matrix of 4x4 or 3x4 numbers, as in transforms.json");
    }
    if (fov_deg.has_value() == fl_x.has_value()) throw Failure("give either fov_deg or fl_x (pixels)");
    Camera camera;
    camera.width = width;
    camera.height = height;
    camera.fl_x = fl_x ? *fl_x : 0.5 * width / std::tan(0.5 * radians(*fov_deg));
    camera.fl_y = fl_y.value_or(camera.fl_x);
    camera.cx = cx.value_or(0.5 * width);
    camera.cy = cy.value_or(0.5 * height);
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 4; ++column) camera.world_from_camera[column][row] = pose.at(row, column);
    }
    if (!(rotation_error(camera) < 1e-3)) throw Failure("the pose must be a rigid transform: a rotation and a place");
    return camera;
}

class Object {
public:
    explicit Object(const std::string& path)
        : renderer_(value_of(Renderer::create(value_of(read_object(path, {.decode = false}))))) {}

    [[nodiscard]] py::dict info() const {
        const RaySpaceObject& object = renderer_.object();
        py::dict found;
        found["name"] = object.name;
        found["width"] = object.width;
        found["height"] = object.height;
        found["views"] = object.views.size();
        found["rings"] = object.rings.size();
        found["units_per_radius"] = object.units_per_radius;
        found["has_depth"] = !object.rings.empty() && !object.rings[0].shape.empty();
        return found;
    }
    [[nodiscard]] py::object rig() const {
        const std::string& text = renderer_.object().rig_json;
        return text.empty() ? py::none() : py::module_::import("json").attr("loads")(text);
    }
    [[nodiscard]] py::object render(const py::array_t<double, py::array::c_style | py::array::forcecast>& pose,
                                    int width, int height, std::optional<double> fov_deg, std::optional<double> fl_x,
                                    std::optional<double> fl_y, std::optional<double> cx, std::optional<double> cy,
                                    bool depth) const {
        const Camera camera = camera_of(pose, width, height, fov_deg, fl_x, fl_y, cx, cy);
        const ViewRegisters registers = value_of(prepare_view(renderer_.object(), camera));
        Image<Rgba8> image(width, height);
        Image<std::int32_t> lambda;
        if (depth) lambda = Image<std::int32_t>(width, height);
        {
            const py::gil_scoped_release others_may_run;
            renderer_.render(registers, image, lambda);
        }
        if (!depth) return to_array(image, 4);
        return py::make_tuple(to_array(image, 4), to_array(depth_image(renderer_.object(), camera, lambda), 1));
    }
    [[nodiscard]] py::dict compare(const std::string& set) const {
        const Comparison comparison = [&] {
            const py::gil_scoped_release others_may_run;
            return value_of(compare_with_set(renderer_, set));
        }();
        py::list views;
        for (const ComparedView& view : comparison.views) {
            py::dict one;
            one["picture"] = view.image;
            one["psnr_db"] = view.psnr_db;
            one["ssim"] = view.ssim;
            views.append(one);
        }
        py::dict found;
        found["mean_psnr_db"] = comparison.mean_psnr_db;
        found["pooled_psnr_db"] = comparison.pooled_psnr_db;
        found["mean_ssim"] = comparison.mean_ssim;
        found["views"] = views;
        return found;
    }

private:
    Renderer renderer_;
};

}  // namespace
}  // namespace rs::engine

PYBIND11_MODULE(rayspace, module) {
    using rs::engine::Object;
    module.doc() = "Ray-space objects: open one, render views of it, compare it with images.";
    py::register_exception<rs::engine::Failure>(module, "Error", PyExc_RuntimeError);
    module.def(
        "open", [](const py::object& path) { return Object(py::str(path)); }, py::arg("path"),
        "An object from an .rso file. Raises Error, which names the file and the remedy.");
    py::class_<Object>(module, "Object")
        .def_property_readonly("info", &Object::info, "name, width, height, views, rings, units_per_radius, has_depth")
        .def_property_readonly("rig", &Object::rig,
                               "the captured cameras as a transforms.json has them, or None: a dict")
        .def("render", &Object::render, py::arg("pose"), py::arg("width"), py::arg("height"), py::kw_only(),
             py::arg("fov_deg") = py::none(), py::arg("fl_x") = py::none(), py::arg("fl_y") = py::none(),
             py::arg("cx") = py::none(), py::arg("cy") = py::none(), py::arg("depth") = false,
             "A view as uint8 (height, width, 4), straight RGBA; with depth=True and float32 (height, width), axial "
             "depth in the units of the rig, 0 where nothing is shown. pose: camera to world as in transforms.json "
             "(columns right, up, back, place). Either fov_deg, across, or fl_x in pixels.")
        .def("compare", &Object::compare, py::arg("capture_set"),
             "PSNR and SSIM against every image of a capture set: a dict");
}
