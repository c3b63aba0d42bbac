#include "compositor/gl/context.hpp"

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <array>
#include <cstdlib>
#include <string_view>
#include <utility>

namespace rs::gl {
namespace {

Error no_context(const std::string& reason) {
    return Error{"OpenGL: " + reason +
                 "; install Mesa's EGL (Debian: libegl1 libegl-mesa0 libgl1-mesa-dri), which needs no GPU or display"};
}

void GLAPIENTRY record_message(GLenum /*source*/, GLenum type, GLuint /*id*/, GLenum severity, GLsizei length,
                               const GLchar* message, const void* user) {
    if (type != GL_DEBUG_TYPE_ERROR && severity != GL_DEBUG_SEVERITY_HIGH) return;
    auto& errors = *static_cast<std::vector<std::string>*>(const_cast<void*>(user));
    errors.emplace_back(message, static_cast<std::size_t>(length));
}

// The current program exists until another one is used: it counts only if not released.
bool is_unreleased_program(GLuint name) {
    GLint released = GL_TRUE;
    if (glIsProgram(name) == GL_TRUE) glGetProgramiv(name, GL_DELETE_STATUS, &released);
    return released == GL_FALSE;
}

std::vector<std::string> all_names_alive() {
    constexpr GLuint kLastName = 8192;  // drivers assign the lowest free names
    struct Kind {
        const char* what;
        PFNGLISTEXTUREPROC is_object;
    };
    const std::array<Kind, 8> kinds{{{"textures", glIsTexture},
                                     {"buffers", glIsBuffer},
                                     {"vertex arrays", glIsVertexArray},
                                     {"framebuffers", glIsFramebuffer},
                                     {"renderbuffers", glIsRenderbuffer},
                                     {"shaders", glIsShader},
                                     {"samplers", glIsSampler},
                                     {"queries", glIsQuery}}};
    std::vector<std::string> alive;
    for (const Kind& kind : kinds) {
        int count = 0;
        for (GLuint name = 1; name <= kLastName; ++name) count += kind.is_object(name) == GL_TRUE ? 1 : 0;
        if (count > 0) alive.push_back(std::to_string(count) + " " + kind.what);
    }
    int programs = 0;
    for (GLuint name = 1; name <= kLastName; ++name) programs += is_unreleased_program(name) ? 1 : 0;
    if (programs > 0) alive.push_back(std::to_string(programs) + " programs");
    return alive;
}

// Displays of the machine's GPUs in EGL's order; empty if software rendering is requested.
std::vector<EGLDisplay> gpu_displays() {
    std::vector<EGLDisplay> displays;
    const char* const software = std::getenv("LIBGL_ALWAYS_SOFTWARE");
    if (software != nullptr && std::string_view(software) != "0") return displays;
    const auto has = [](const char* extension) { return epoxy_has_egl_extension(EGL_NO_DISPLAY, extension); };
    const bool lists_devices =
        has("EGL_EXT_device_base") || (has("EGL_EXT_device_enumeration") && has("EGL_EXT_device_query"));
    if (!lists_devices || !has("EGL_EXT_platform_device")) return displays;
    constexpr EGLint kMaxDevices = 64;
    std::array<EGLDeviceEXT, kMaxDevices> devices{};
    EGLint count = 0;
    if (!eglQueryDevicesEXT(kMaxDevices, devices.data(), &count)) return displays;
    for (EGLint n = 0; n < count; ++n) {
        const EGLDeviceEXT device = devices[static_cast<std::size_t>(n)];
        const char* const extensions = eglQueryDeviceStringEXT(device, EGL_EXTENSIONS);
        const bool on_cpu = extensions == nullptr ||
                            std::string_view(extensions).find("EGL_MESA_device_software") != std::string_view::npos;
        if (!on_cpu) displays.push_back(eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, device, nullptr));
    }
    return displays;
}

}  // namespace

struct Context::State {
    EGLDisplay display = EGL_NO_DISPLAY;
    EGLContext context = EGL_NO_CONTEXT;
    std::string device_name;
    std::vector<std::string> errors;
    std::function<void(const std::vector<std::string>&)> at_end;

    // Applies the conventions of the header to the current context.
    void apply_conventions(const ContextOptions& options) {
        at_end = options.at_end;
        device_name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
        if (options.debug) {
            glEnable(GL_DEBUG_OUTPUT);
            glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
            glDebugMessageCallback(record_message, &errors);
        }
        glClipControl(GL_UPPER_LEFT, GL_ZERO_TO_ONE);
        glEnable(GL_FRAMEBUFFER_SRGB);
        glPixelStorei(GL_PACK_ALIGNMENT, 1);
    }

    // Leaves its context current.
    static Result<std::unique_ptr<State>> open(EGLDisplay display, const ContextOptions& options) {
        auto state = std::make_unique<State>();
        state->display = display;
        if (display == EGL_NO_DISPLAY || !eglInitialize(display, nullptr, nullptr)) {
            return no_context("EGL's display cannot be opened");
        }
        for (const char* extension : {"EGL_KHR_no_config_context", "EGL_KHR_surfaceless_context"}) {
            if (!epoxy_has_egl_extension(display, extension)) {
                return no_context(std::string("EGL lacks ") + extension);
            }
        }
        if (!eglBindAPI(EGL_OPENGL_API)) return no_context("EGL offers no desktop OpenGL");
        const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                     4,
                                     EGL_CONTEXT_MINOR_VERSION,
                                     5,
                                     EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                     EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                     EGL_CONTEXT_OPENGL_DEBUG,
                                     options.debug ? EGL_TRUE : EGL_FALSE,
                                     EGL_NONE};
        state->context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
        if (state->context == EGL_NO_CONTEXT) {
            return no_context(
                "the driver has no OpenGL 4.5 core; with LIBGL_ALWAYS_SOFTWARE=1 Mesa draws on the CPU instead");
        }
        if (!eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, state->context)) {
            return no_context("the context cannot be made current");
        }
        state->apply_conventions(options);
        return state;
    }

    std::vector<std::string> take_errors() {
        for (GLenum code = glGetError(); code != GL_NO_ERROR; code = glGetError()) {
            errors.push_back("OpenGL error " + std::to_string(code));
        }
        return std::exchange(errors, {});
    }

    State() = default;
    State(const State&) = delete;
    State& operator=(const State&) = delete;
    ~State() {
        if (at_end) {
            std::vector<std::string> left = take_errors();
            for (std::string& names : all_names_alive()) left.push_back(std::move(names));
            at_end(left);
        }
        if (context == EGL_NO_CONTEXT) return;
        eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        eglDestroyContext(display, context);
        // The display is shared by the process and may serve other contexts, so it is not terminated.
    }
};

Context::Context(std::unique_ptr<State> state) : state_(std::move(state)) {}
Context::Context(Context&&) noexcept = default;
Context& Context::operator=(Context&&) noexcept = default;
Context::~Context() = default;

Result<Context> Context::create_surfaceless(const ContextOptions& options) {
    // epoxy aborts when a function of a missing library is called: check before the first call.
    if (!epoxy_has_egl()) return no_context("libEGL cannot be loaded");
    Result<std::unique_ptr<State>> state = no_context("EGL has no surfaceless platform");
    for (const EGLDisplay display : gpu_displays()) {
        state = State::open(display, options);
        if (state) break;
    }
    if (!state && epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless")) {
        state =
            State::open(eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr), options);
    }
    if (!state) return state.error();
    return Context(std::move(state).value());
}

Result<Context> Context::adopt_current(const ContextOptions& options) {
    if (!epoxy_is_desktop_gl() || epoxy_gl_version() < 45) {
        return Error{"OpenGL: the window's context is of version " + std::to_string(epoxy_gl_version() / 10) + "." +
                     std::to_string(epoxy_gl_version() % 10) + "; 4.5 is needed: update the graphics driver"};
    }
    auto state = std::make_unique<State>();
    state->apply_conventions(options);
    return Context(std::move(state));
}

const std::string& Context::device_name() const {
    return state_->device_name;
}

std::vector<std::string> Context::take_errors() {
    return state_->take_errors();
}

std::vector<std::string> Context::live_objects() const {
    return all_names_alive();
}

}  // namespace rs::gl
