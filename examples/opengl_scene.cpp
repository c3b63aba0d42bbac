// Puts an object into an OpenGL scene: the rendered view is a texture, its depth another, and the fragment shader
// writes the depth of each pixel, so that the scene and the object hide each other.
//
//     opengl_scene OBJECT.rso FRAME.png     draws one frame without a window
//     opengl_scene OBJECT.rso               opens a window and walks around the object (Esc closes it)

#include <rayspace/api/image.hpp>
#include <rayspace/api/object.hpp>
#include <rayspace/api/renderer.hpp>

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

namespace {

namespace api = rs::api;

constexpr int kWidth = 640;
constexpr int kHeight = 480;
constexpr int kViewsPerTurn = 90;
constexpr int kPillars = 6;

// A box, as 14 vertices of a triangle strip.
constexpr const char* kBoxVertex = R"(#version 450 core
uniform mat4 clip_from_world;
uniform vec3 low, high;
out float shade;
void main() {
    int bits = 1 << gl_VertexID;
    bvec3 side = bvec3((0x287a & bits) != 0, (0x02af & bits) != 0, (0x31e3 & bits) != 0);
    shade = side.y ? 1.0 : 0.55;
    gl_Position = clip_from_world * vec4(mix(low, high, vec3(side)), 1.0);
})";
constexpr const char* kBoxFragment = R"(#version 450 core
uniform vec3 colour;
in float shade;
out vec4 result;
void main() { result = vec4(colour * shade, 1.0); })";

constexpr const char* kViewVertex = R"(#version 450 core
void main() { gl_Position = vec4((gl_VertexID & 1) * 4 - 1, (gl_VertexID >> 1) * 4 - 1, 0.0, 1.0); })";
constexpr const char* kViewFragment = R"(#version 450 core
layout(binding = 0) uniform sampler2D image;
layout(binding = 1) uniform sampler2D depth;  // axial; 0 where there is nothing
uniform vec2 depth_range;                     // near and far plane
out vec4 result;
void main() {
    ivec2 texel = ivec2(gl_FragCoord.x, textureSize(image, 0).y - 1 - int(gl_FragCoord.y));  // row 0 is the top
    vec4 colour = texelFetch(image, texel, 0);
    float d = texelFetch(depth, texel, 0).r;
    if (colour.a == 0.0 || d <= 0.0) discard;
    gl_FragDepth = depth_range.y * (d - depth_range.x) / (d * (depth_range.y - depth_range.x));
    result = vec4(colour.rgb * colour.a, colour.a);
})";

using Matrix = std::array<float, 16>;  // column by column, as OpenGL takes it

// From world coordinates to clip coordinates of the camera.
Matrix clip_from_world(const api::Camera& camera, double near, double far) {
    const api::Matrix4& pose = camera.world_from_camera;
    double view[4][4] = {};  // the inverse of a rigid transform
    for (int row = 0; row < 3; ++row) {
        for (int k = 0; k < 3; ++k) {
            view[row][k] = pose[static_cast<std::size_t>(k)][static_cast<std::size_t>(row)];
            view[row][3] -= view[row][k] * pose[static_cast<std::size_t>(k)][3];
        }
    }
    view[3][3] = 1;
    const double projection[4][4] = {{2 * camera.fl_x / camera.width, 0, 1 - 2 * camera.cx / camera.width, 0},
                                     {0, 2 * camera.fl_y / camera.height, 2 * camera.cy / camera.height - 1, 0},
                                     {0, 0, (near + far) / (near - far), 2 * near * far / (near - far)},
                                     {0, 0, -1, 0}};
    Matrix product{};
    for (int row = 0; row < 4; ++row) {
        for (int column = 0; column < 4; ++column) {
            double sum = 0;
            for (int k = 0; k < 4; ++k) sum += projection[row][k] * view[k][column];
            product[static_cast<std::size_t>(4 * column + row)] = static_cast<float>(sum);
        }
    }
    return product;
}

rs::Result<GLuint> make_program(const char* vertex, const char* fragment) {
    const GLuint program = glCreateProgram();
    for (const auto& [kind, text] : {std::pair(GL_VERTEX_SHADER, vertex), std::pair(GL_FRAGMENT_SHADER, fragment)}) {
        const GLuint shader = glCreateShader(static_cast<GLenum>(kind));
        glShaderSource(shader, 1, &text, nullptr);
        glCompileShader(shader);
        glAttachShader(program, shader);
        glDeleteShader(shader);
    }
    glLinkProgram(program);
    GLint linked = GL_FALSE;
    glGetProgramiv(program, GL_LINK_STATUS, &linked);
    if (linked == GL_TRUE) return program;
    char log[1024] = "";
    glGetProgramInfoLog(program, sizeof log, nullptr, log);
    return rs::Error{std::string("shader: ") + log};
}

GLuint make_texture(GLenum format) {
    GLuint texture = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &texture);
    glTextureStorage2D(texture, 1, format, kWidth, kHeight);
    glTextureParameteri(texture, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    return texture;
}

// The object with pillars around it. Its context is current.
class Scene {
public:
    static rs::Result<Scene> create(const api::Object& object) {
        RS_ASSIGN_OR_RETURN(auto cameras, object.orbit(kViewsPerTurn, {.width = kWidth, .height = kHeight}));
        RS_ASSIGN_OR_RETURN(auto renderer, api::Renderer::create(object));
        RS_ASSIGN_OR_RETURN(const auto boxes, make_program(kBoxVertex, kBoxFragment));
        RS_ASSIGN_OR_RETURN(const auto view, make_program(kViewVertex, kViewFragment));
        return Scene(std::move(cameras), std::move(renderer), boxes, view);
    }

    // Draws frame `n` of the turn into the framebuffer that is bound. `visible` receives the number of the object's
    // pixels that the scene does not hide, of `all`.
    rs::Status draw(int n, GLuint* visible, GLuint* all) {
        const api::Camera& camera = cameras_[static_cast<std::size_t>(n % kViewsPerTurn)];
        RS_ASSIGN_OR_RETURN(const auto view, renderer_.render(camera, {.depth = true}));
        const double radius = renderer_.object().units_per_radius();
        const api::Matrix4& pose = camera.world_from_camera;
        const double distance = std::hypot(pose[0][3], pose[1][3], pose[2][3]);
        const double near = distance / 50;
        const double far = distance + 20 * radius;

        glViewport(0, 0, kWidth, kHeight);
        glEnable(GL_FRAMEBUFFER_SRGB);  // colours are blended as linear light
        glEnable(GL_DEPTH_TEST);
        glDisable(GL_BLEND);
        glClearColor(0.05F, 0.06F, 0.08F, 1);
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        draw_boxes(clip_from_world(camera, near, far), radius);

        glTextureSubImage2D(image_, 0, 0, 0, kWidth, kHeight, GL_RGBA, GL_UNSIGNED_BYTE, view.image.data());
        glTextureSubImage2D(depth_, 0, 0, 0, kWidth, kHeight, GL_RED, GL_FLOAT, view.depth.data());
        glBindTextureUnit(0, image_);
        glBindTextureUnit(1, depth_);
        glUseProgram(view_program_);
        glUniform2f(glGetUniformLocation(view_program_, "depth_range"), static_cast<float>(near),
                    static_cast<float>(far));
        glEnable(GL_BLEND);
        glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
        glBeginQuery(GL_SAMPLES_PASSED, query_);
        glDrawArrays(GL_TRIANGLES, 0, 3);
        glEndQuery(GL_SAMPLES_PASSED);
        glGetQueryObjectuiv(query_, GL_QUERY_RESULT, visible);
        *all = 0;
        for (const rs::Rgba8& pixel : view.image.pixels()) *all += pixel.a > 0 ? 1 : 0;
        return {};
    }

private:
    Scene(std::vector<api::Camera> cameras, api::Renderer renderer, GLuint box_program, GLuint view_program)
        : cameras_(std::move(cameras)),
          renderer_(std::move(renderer)),
          box_program_(box_program),
          view_program_(view_program),
          image_(make_texture(GL_SRGB8_ALPHA8)),
          depth_(make_texture(GL_R32F)) {
        GLuint vertices = 0;
        glCreateVertexArrays(1, &vertices);  // the shaders make their vertices
        glBindVertexArray(vertices);
        glGenQueries(1, &query_);
    }

    void draw_boxes(const Matrix& clip, double radius) const {
        glUseProgram(box_program_);
        glUniformMatrix4fv(glGetUniformLocation(box_program_, "clip_from_world"), 1, GL_FALSE, clip.data());
        const double ground = renderer_.object().ground_height().value_or(-radius);
        draw_box({-3 * radius, ground - 0.1 * radius, -3 * radius}, {3 * radius, ground, 3 * radius}, {0.2, 0.2, 0.22});
        for (int i = 0; i < kPillars; ++i) {
            const double angle = 2 * 3.14159265358979 * (i + 0.2) / kPillars;
            const double x = 1.2 * radius * std::sin(angle);
            const double z = 1.2 * radius * std::cos(angle);
            const double half = 0.08 * radius;
            draw_box({x - half, ground, z - half}, {x + half, ground + 1.6 * radius, z + half}, {0.6, 0.3, 0.1});
        }
    }

    void draw_box(const api::Vector3& low, const api::Vector3& high, const api::Vector3& colour) const {
        const auto set = [&](const char* name, const api::Vector3& v) {
            glUniform3f(glGetUniformLocation(box_program_, name), static_cast<float>(v[0]), static_cast<float>(v[1]),
                        static_cast<float>(v[2]));
        };
        set("low", low);
        set("high", high);
        set("colour", colour);
        glDrawArrays(GL_TRIANGLE_STRIP, 0, 14);
    }

    std::vector<api::Camera> cameras_;
    api::Renderer renderer_;
    GLuint box_program_;
    GLuint view_program_;
    GLuint image_;
    GLuint depth_;
    GLuint query_ = 0;
};

// A current context without a window or a display: Mesa's surfaceless platform.
rs::Status make_surfaceless_context() {
    const rs::Error missing{
        "EGL has no surfaceless platform; install Mesa (Debian: libegl1 libegl-mesa0 libgl1-mesa-dri)"};
    if (!epoxy_has_egl() || !epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless")) return missing;
    const EGLDisplay display = eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (display == EGL_NO_DISPLAY || !eglInitialize(display, nullptr, nullptr)) return missing;
    const EGLint version[] = {EGL_CONTEXT_MAJOR_VERSION, 4, EGL_CONTEXT_MINOR_VERSION, 5, EGL_NONE};
    if (!eglBindAPI(EGL_OPENGL_API)) return missing;
    const EGLContext context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, version);
    if (context == EGL_NO_CONTEXT || !eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context)) {
        return rs::Error{"the driver has no OpenGL 4.5; with LIBGL_ALWAYS_SOFTWARE=1 Mesa draws on the CPU"};
    }
    return {};
}

rs::Status draw_frame(const api::Object& object, const std::string& file) {
    if (rs::Status made = make_surfaceless_context(); !made) return made;
    RS_ASSIGN_OR_RETURN(auto scene, Scene::create(object));
    GLuint buffers[2];
    GLuint framebuffer = 0;
    glCreateRenderbuffers(2, buffers);
    glNamedRenderbufferStorage(buffers[0], GL_SRGB8_ALPHA8, kWidth, kHeight);
    glNamedRenderbufferStorage(buffers[1], GL_DEPTH_COMPONENT32F, kWidth, kHeight);
    glCreateFramebuffers(1, &framebuffer);
    glNamedFramebufferRenderbuffer(framebuffer, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, buffers[0]);
    glNamedFramebufferRenderbuffer(framebuffer, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, buffers[1]);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    GLuint visible = 0;
    GLuint all = 0;
    if (rs::Status drawn = scene.draw(0, &visible, &all); !drawn) return drawn;

    rs::Image<rs::Rgba8> rows_from_below(kWidth, kHeight);
    glReadPixels(0, 0, kWidth, kHeight, GL_RGBA, GL_UNSIGNED_BYTE, rows_from_below.data());
    rs::Image<rs::Rgba8> frame(kWidth, kHeight);
    for (int y = 0; y < kHeight; ++y) {
        std::copy_n(rows_from_below.row(kHeight - 1 - y), kWidth, frame.row(y));
    }
    if (const GLenum error = glGetError(); error != GL_NO_ERROR) {
        return rs::Error{"OpenGL error " + std::to_string(error)};
    }
    std::printf("%s: %u of the object's %u pixels are in front of the scene\n", file.c_str(), visible, all);
    return api::write_png(file, frame);
}

rs::Status show_window(const api::Object& object) {
    if (glfwInit() != GLFW_TRUE) return rs::Error{"there is no display; give FRAME.png to draw without a window"};
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_SRGB_CAPABLE, GLFW_TRUE);
    glfwWindowHint(GLFW_RESIZABLE, GLFW_FALSE);
    GLFWwindow* const window = glfwCreateWindow(kWidth, kHeight, object.name().c_str(), nullptr, nullptr);
    if (window == nullptr) return rs::Error{"a window with OpenGL 4.5 cannot be opened"};
    glfwMakeContextCurrent(window);
    glfwSwapInterval(1);
    auto scene = Scene::create(object);
    rs::Status status = scene ? rs::Status() : rs::Status(scene.error());
    for (int n = 0; status && glfwWindowShouldClose(window) == GLFW_FALSE; ++n) {
        GLuint visible = 0;
        GLuint all = 0;
        status = scene->draw(n, &visible, &all);
        glfwSwapBuffers(window);
        glfwPollEvents();
        if (glfwGetKey(window, GLFW_KEY_ESCAPE) == GLFW_PRESS) glfwSetWindowShouldClose(window, GLFW_TRUE);
    }
    glfwTerminate();
    return status;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 2 || argc > 3) {
        std::fprintf(stderr, "usage: opengl_scene OBJECT.rso [FRAME.png]\n");
        return 2;
    }
    const auto object = api::Object::open(argv[1]);
    const rs::Status status = !object    ? rs::Status(object.error())
                              : argc > 2 ? draw_frame(*object, argv[2])
                                         : show_window(*object);
    if (!status) std::fprintf(stderr, "opengl_scene: %s\n", status.error().message.c_str());
    return status ? 0 : 1;
}
