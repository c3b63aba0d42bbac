// Renders an orbit of an object to PNG files.
//
//     render_orbit OBJECT.rso FOLDER [COUNT]

#include <rayspace/api/image.hpp>
#include <rayspace/api/object.hpp>
#include <rayspace/api/renderer.hpp>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

namespace {

rs::Status render_orbit(const std::string& object_file, const std::filesystem::path& folder, int count) {
    RS_ASSIGN_OR_RETURN(const auto object, rs::api::Object::open(object_file));
    RS_ASSIGN_OR_RETURN(const auto cameras, object.orbit(count));
    RS_ASSIGN_OR_RETURN(const auto renderer, rs::api::Renderer::create(object));

    std::error_code failure;
    std::filesystem::create_directories(folder, failure);
    if (failure) return rs::Error{folder.string() + ": cannot be created: " + failure.message()};
    for (int i = 0; i < count; ++i) {
        RS_ASSIGN_OR_RETURN(const auto view, renderer.render(cameras[static_cast<std::size_t>(i)]));
        char name[32];
        std::snprintf(name, sizeof name, "%04d.png", i);
        if (rs::Status written = rs::api::write_png(folder / name, view.image); !written) return written;
    }
    std::printf("%s: %d views of %s\n", folder.c_str(), count, object.name().c_str());
    return {};
}

}  // namespace

int main(int argc, char** argv) {
    const int count = argc > 3 ? std::atoi(argv[3]) : 36;
    if (argc < 3 || argc > 4 || count < 1) {
        std::fprintf(stderr, "usage: render_orbit OBJECT.rso FOLDER [COUNT]\n");
        return 2;
    }
    const rs::Status status = render_orbit(argv[1], argv[2], count);
    if (!status) std::fprintf(stderr, "render_orbit: %s\n", status.error().message.c_str());
    return status ? 0 : 1;
}
