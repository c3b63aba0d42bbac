// Opens an object, renders one view of it and saves that: a program of somebody else's.
//     consumer vase.rso view.png
#include <engine/core/fast/renderer.hpp>
#include <engine/core/views/orbit.hpp>
#include <rayspace/format/object_file.hpp>
#include <rayspace/light/light.hpp>
#include <rayspace/pictures/picture_io.hpp>

#include <cstdio>

static rs::Status draw(const char* object_file, const char* image_file) {
    rs::Result<rs::RaySpaceObject> object = rs::read_object(object_file);
    if (!object) return object.error();
    const auto cameras = rs::engine::orbit_cameras(*object, 1, {});
    if (!cameras) return cameras.error();
    const auto view = rs::engine::prepare_view(*object, cameras->front());
    if (!view) return view.error();
    const auto renderer = rs::engine::Renderer::create(std::move(*object));
    if (!renderer) return renderer.error();
    rs::Image<rs::Rgba8> image(cameras->front().width, cameras->front().height);
    renderer->render(*view, image);
    return rs::write_png(image_file, image);
}

// Lights are in the library, too.
static bool has_lights() {
    return rs::area_of(rs::rectangle_light({}, {2, 0, 0}, {0, 3, 0}, glm::vec3(1))) == 6;
}

int main(int argc, char** argv) {
    if (argc != 3) return std::fprintf(stderr, "usage: consumer OBJECT.rso IMAGE.png\n"), 2;
    if (!has_lights()) return std::fprintf(stderr, "consumer: a rectangle has another area\n"), 1;
    const rs::Status done = draw(argv[1], argv[2]);
    if (!done) std::fprintf(stderr, "consumer: %s\n", done.error().message.c_str());
    return done ? 0 : 1;
}
