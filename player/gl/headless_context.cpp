// EGL without surfaces: EGL_MESA_platform_surfaceless, then EGL_EXT_platform_device.
#include "player/gl/headless_context.h"

#include <dlfcn.h>
#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <fmt/format.h>

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "paim/base/error.h"

namespace paim::player::gl {

namespace {

// libepoxy opens libEGL on first use and aborts the program where there is none.
bool has_egl_library() {
    void* library = ::dlopen("libEGL.so.1", RTLD_LAZY | RTLD_LOCAL);
    if (library == nullptr) return false;
    ::dlclose(library);
    return true;
}

// Extensions of a display, or of EGL itself for EGL_NO_DISPLAY; a whole word of the list.
bool has_extension(EGLDisplay display, std::string_view name) {
    const char* text = eglQueryString(display, EGL_EXTENSIONS);
    if (text == nullptr) return false;
    const std::string list = fmt::format(" {} ", text);
    return list.find(fmt::format(" {} ", name)) != std::string::npos;
}

struct Platform {
    std::string name;
    EGLDisplay display = EGL_NO_DISPLAY;
};

std::vector<Platform> candidate_platforms() {
    std::vector<Platform> platforms;
    if (has_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless")) {
        platforms.push_back(
            {"surfaceless", eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA,
                                                     EGL_DEFAULT_DISPLAY, nullptr)});
    }
    if (has_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_device") &&
        has_extension(EGL_NO_DISPLAY, "EGL_EXT_device_enumeration")) {
        std::array<EGLDeviceEXT, 16> devices{};
        EGLint num_devices = 0;
        if (eglQueryDevicesEXT(static_cast<EGLint>(devices.size()), devices.data(), &num_devices)) {
            for (EGLint d = 0; d < num_devices; ++d) {
                platforms.push_back(
                    {fmt::format("device {}", d),
                     eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT,
                                              devices[static_cast<size_t>(d)], nullptr)});
            }
        }
    }
    return platforms;
}

class HeadlessContext : public Context {
  public:
    // Leaves `failure` empty when the context is current.
    HeadlessContext(EGLDisplay display, bool desktop, std::string& failure) : display_(display) {
        failure = start(desktop);
    }
    ~HeadlessContext() override {
        eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        if (context_ != EGL_NO_CONTEXT) eglDestroyContext(display_, context_);
        if (initialized_) eglTerminate(display_);
    }
    HeadlessContext(const HeadlessContext&) = delete;
    HeadlessContext& operator=(const HeadlessContext&) = delete;

  private:
    std::string start(bool desktop) {
        if (display_ == EGL_NO_DISPLAY) return "no such display";
        if (!eglInitialize(display_, nullptr, nullptr)) return failed("eglInitialize");
        initialized_ = true;
        if (!has_extension(display_, "EGL_KHR_surfaceless_context")) {
            return "EGL_KHR_surfaceless_context is missing";
        }
        if (!eglBindAPI(desktop ? EGL_OPENGL_API : EGL_OPENGL_ES_API)) return failed("eglBindAPI");

        const std::array<EGLint, 5> wanted = {EGL_RENDERABLE_TYPE,
                                              desktop ? EGL_OPENGL_BIT : EGL_OPENGL_ES3_BIT,
                                              EGL_SURFACE_TYPE, EGL_DONT_CARE, EGL_NONE};
        EGLConfig config = nullptr;
        EGLint num_configs = 0;
        if (!eglChooseConfig(display_, wanted.data(), &config, 1, &num_configs)) {
            return failed("eglChooseConfig");
        }
        if (num_configs == 0) return "no fitting EGL configuration";

        const std::array<EGLint, 7> core = {EGL_CONTEXT_MAJOR_VERSION,
                                            3,
                                            EGL_CONTEXT_MINOR_VERSION,
                                            3,
                                            EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                            EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                            EGL_NONE};
        const std::array<EGLint, 3> es = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_NONE};
        context_ =
            eglCreateContext(display_, config, EGL_NO_CONTEXT, desktop ? core.data() : es.data());
        if (context_ == EGL_NO_CONTEXT) return failed("eglCreateContext");
        if (!eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_)) {
            return failed("eglMakeCurrent");
        }
        return {};
    }

    static std::string failed(std::string_view call) {
        return fmt::format("{} failed with 0x{:04x}", call, eglGetError());
    }

    EGLDisplay display_;
    bool initialized_ = false;
    EGLContext context_ = EGL_NO_CONTEXT;
};

}  // namespace

std::unique_ptr<Context> make_headless_context(Api api) {
    if (!has_egl_library()) {
        throw_unsupported("drawing without a display needs EGL: libEGL.so.1 cannot be opened");
    }
    std::string failures;
    for (const Platform& platform : candidate_platforms()) {
        for (const bool desktop : {true, false}) {
            if (api != Api::any && desktop != (api == Api::desktop)) continue;
            std::string failure;
            auto context = std::make_unique<HeadlessContext>(platform.display, desktop, failure);
            if (failure.empty()) {
                require_version();
                return context;
            }
            failures += fmt::format("; {} with {}: {}", platform.name,
                                    desktop ? "OpenGL 3.3" : "OpenGL ES 3.0", failure);
        }
    }
    throw_unsupported(
        "drawing without a display needs EGL with EGL_MESA_platform_surfaceless or "
        "EGL_EXT_platform_device{}",
        failures.empty() ? "; this EGL has neither" : failures);
}

}  // namespace paim::player::gl
