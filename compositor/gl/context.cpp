#include "compositor/gl/context.hpp"

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <utility>

namespace rs::gl {
namespace {

Error no_context(const std::string& reason) {
    return Error{"OpenGL: " + reason +
                 "; install Mesa's EGL (Debian: libegl1 libegl-mesa0 libgl1-mesa-dri), which needs no GPU or display"};
}

void GLAPIENTRY note_message(GLenum /*source*/, GLenum type, GLuint /*id*/, GLenum severity, GLsizei length,
                             const GLchar* message, const void* user) {
    if (type != GL_DEBUG_TYPE_ERROR && severity != GL_DEBUG_SEVERITY_HIGH) return;
    auto& errors = *static_cast<std::vector<std::string>*>(const_cast<void*>(user));
    errors.emplace_back(message, static_cast<std::size_t>(length));
}

}  // namespace

struct Context::State {
    EGLDisplay display = EGL_NO_DISPLAY;
    EGLContext context = EGL_NO_CONTEXT;
    std::string device_name;
    std::vector<std::string> errors;

    // The conventions of the header, of the context that is current.
    void settle(const ContextOptions& options) {
        device_name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
        if (options.debug) {
            glEnable(GL_DEBUG_OUTPUT);
            glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
            glDebugMessageCallback(note_message, &errors);
        }
        glClipControl(GL_UPPER_LEFT, GL_ZERO_TO_ONE);
        glEnable(GL_FRAMEBUFFER_SRGB);
        glPixelStorei(GL_PACK_ALIGNMENT, 1);
    }

    State() = default;
    State(const State&) = delete;
    State& operator=(const State&) = delete;
    ~State() {
        if (context == EGL_NO_CONTEXT) return;
        eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        eglDestroyContext(display, context);
        // The display is one for the whole process and may serve other contexts: it is not terminated.
    }
};

Context::Context(std::unique_ptr<State> state) : state_(std::move(state)) {}
Context::Context(Context&&) noexcept = default;
Context& Context::operator=(Context&&) noexcept = default;
Context::~Context() = default;

Result<Context> Context::create_surfaceless(const ContextOptions& options) {
    // epoxy ends the process when a function of a library that is not there is called: ask before the first.
    if (!epoxy_has_egl()) return no_context("libEGL cannot be loaded");
    if (!epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless")) {
        return no_context("EGL has no surfaceless platform");
    }
    auto state = std::make_unique<State>();
    state->display = eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (state->display == EGL_NO_DISPLAY || !eglInitialize(state->display, nullptr, nullptr)) {
        return no_context("EGL's surfaceless display cannot be opened");
    }
    for (const char* extension : {"EGL_KHR_no_config_context", "EGL_KHR_surfaceless_context"}) {
        if (!epoxy_has_egl_extension(state->display, extension))
            return no_context(std::string("EGL lacks ") + extension);
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
    state->context = eglCreateContext(state->display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
    if (state->context == EGL_NO_CONTEXT) return no_context("the driver has no OpenGL 4.5 core");
    if (!eglMakeCurrent(state->display, EGL_NO_SURFACE, EGL_NO_SURFACE, state->context)) {
        return no_context("the context cannot be made current");
    }
    state->settle(options);
    return Context(std::move(state));
}

Result<Context> Context::adopt_current(const ContextOptions& options) {
    if (!epoxy_is_desktop_gl() || epoxy_gl_version() < 45) {
        return Error{"OpenGL: the window's context is of version " + std::to_string(epoxy_gl_version() / 10) + "." +
                     std::to_string(epoxy_gl_version() % 10) + "; 4.5 is needed: update the graphics driver"};
    }
    auto state = std::make_unique<State>();
    state->settle(options);
    return Context(std::move(state));
}

const std::string& Context::device_name() const {
    return state_->device_name;
}

std::vector<std::string> Context::take_errors() {
    for (GLenum code = glGetError(); code != GL_NO_ERROR; code = glGetError()) {
        state_->errors.push_back("OpenGL error " + std::to_string(code));
    }
    return std::exchange(state_->errors, {});
}

}  // namespace rs::gl
