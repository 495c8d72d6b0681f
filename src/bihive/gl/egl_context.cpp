#include "bihive/gl/egl_context.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <dlfcn.h>

#include <array>
#include <cstdlib>
#include <string_view>
#include <utility>
#include <vector>

namespace bihive {
namespace {

Error no_egl(const std::string& what) {
  return {"the graphics processor cannot be used: " + what, "", 0, 0,
          "install an EGL driver (Debian: apt-get install libegl1 libgl1-mesa-dri), or choose an engine of the CPU"};
}

// EGL's functions, all from one library.
struct EglFunctions {
  decltype(&eglBindAPI) BindAPI = nullptr;                       // NOLINT(readability-identifier-naming)
  decltype(&eglChooseConfig) ChooseConfig = nullptr;             // NOLINT(readability-identifier-naming)
  decltype(&eglCreateContext) CreateContext = nullptr;           // NOLINT(readability-identifier-naming)
  decltype(&eglDestroyContext) DestroyContext = nullptr;         // NOLINT(readability-identifier-naming)
  decltype(&eglGetDisplay) GetDisplay = nullptr;                 // NOLINT(readability-identifier-naming)
  decltype(&eglGetProcAddress) GetProcAddress = nullptr;         // NOLINT(readability-identifier-naming)
  decltype(&eglInitialize) Initialize = nullptr;                 // NOLINT(readability-identifier-naming)
  decltype(&eglMakeCurrent) MakeCurrent = nullptr;               // NOLINT(readability-identifier-naming)
  decltype(&eglQueryString) QueryString = nullptr;               // NOLINT(readability-identifier-naming)
  decltype(&eglTerminate) Terminate = nullptr;                   // NOLINT(readability-identifier-naming)
  PFNEGLGETPLATFORMDISPLAYEXTPROC GetPlatformDisplay = nullptr;  // NOLINT(readability-identifier-naming)
  PFNEGLQUERYDEVICESEXTPROC QueryDevices = nullptr;              // NOLINT(readability-identifier-naming)
  PFNEGLQUERYDEVICESTRINGEXTPROC QueryDeviceString = nullptr;    // NOLINT(readability-identifier-naming)
};

// The library stays loaded, because some drivers crash when they are unloaded.
Result<EglFunctions> load_egl() {
  const char* const named = std::getenv("BIHIVE_EGL");  // NOLINT(concurrency-mt-unsafe)
  const char* const file = named != nullptr ? named : "libEGL.so.1";
  void* const library = dlopen(file, RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) return no_egl(std::string("there is no EGL (") + file + ")");

  EglFunctions egl;
  bool complete = true;
  const auto take = [&](auto& function, const char* name) {
    void* const symbol = dlsym(library, name);
    function = reinterpret_cast<std::decay_t<decltype(function)>>(symbol);
    complete = complete && symbol != nullptr;
  };
  take(egl.BindAPI, "eglBindAPI");
  take(egl.ChooseConfig, "eglChooseConfig");
  take(egl.CreateContext, "eglCreateContext");
  take(egl.DestroyContext, "eglDestroyContext");
  take(egl.GetDisplay, "eglGetDisplay");
  take(egl.GetProcAddress, "eglGetProcAddress");
  take(egl.Initialize, "eglInitialize");
  take(egl.MakeCurrent, "eglMakeCurrent");
  take(egl.QueryString, "eglQueryString");
  take(egl.Terminate, "eglTerminate");
  if (!complete) return no_egl(std::string(file) + " is no EGL");

  // Extensions that every EGL of the last ten years has; check for them anyway.
  const auto take_extension = [&](auto& function, const char* name) {
    function = reinterpret_cast<std::decay_t<decltype(function)>>(egl.GetProcAddress(name));
  };
  take_extension(egl.GetPlatformDisplay, "eglGetPlatformDisplayEXT");
  take_extension(egl.QueryDevices, "eglQueryDevicesEXT");
  take_extension(egl.QueryDeviceString, "eglQueryDeviceStringEXT");
  return egl;
}

bool lists(const char* extensions, std::string_view extension) {
  return extensions != nullptr && std::string_view(extensions).find(extension) != std::string_view::npos;
}

// All displays to try, the best first: graphics processors, Mesa without any device, software, the default.
std::vector<EGLDisplay> displays(const EglFunctions& egl) {
  std::vector<EGLDisplay> found;
  const char* const extensions = egl.QueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  std::array<EGLDeviceEXT, 16> devices{};
  EGLint device_count = 0;
  const bool has_devices = egl.GetPlatformDisplay != nullptr && egl.QueryDevices != nullptr &&
                           egl.QueryDeviceString != nullptr && lists(extensions, "EGL_EXT_platform_device");
  if (has_devices && egl.QueryDevices(EGLint(devices.size()), devices.data(), &device_count) != EGL_TRUE)
    device_count = 0;
  const auto add_devices = [&](bool software) {
    for (EGLint i = 0; i < device_count; ++i) {
      EGLDeviceEXT device = devices[static_cast<std::size_t>(i)];
      if (lists(egl.QueryDeviceString(device, EGL_EXTENSIONS), "EGL_MESA_device_software") != software) continue;
      found.push_back(egl.GetPlatformDisplay(EGL_PLATFORM_DEVICE_EXT, device, nullptr));
    }
  };

  add_devices(false);
  if (egl.GetPlatformDisplay != nullptr && lists(extensions, "EGL_MESA_platform_surfaceless"))
    found.push_back(egl.GetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
  add_devices(true);
  found.push_back(egl.GetDisplay(EGL_DEFAULT_DISPLAY));
  return found;
}

}  // namespace

class EglContext::Implementation {
 public:
  Implementation(const EglFunctions& egl, EGLDisplay display, EGLContext context)
      : egl_(egl), display_(display), context_(context) {}
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;
  ~Implementation() {
    egl_.MakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    egl_.DestroyContext(display_, context_);
    egl_.Terminate(display_);
  }

  // Null if the display has no such context.
  static std::unique_ptr<Implementation> on(const EglFunctions& egl, EGLDisplay display) {
    if (display == EGL_NO_DISPLAY || egl.Initialize(display, nullptr, nullptr) != EGL_TRUE) return nullptr;
    const std::array<EGLint, 5> wanted{EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_ES3_BIT, EGL_NONE};
    const std::array<EGLint, 3> version{EGL_CONTEXT_CLIENT_VERSION, 3, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint configs = 0;
    EGLContext context = EGL_NO_CONTEXT;
    if (egl.BindAPI(EGL_OPENGL_ES_API) == EGL_TRUE &&
        egl.ChooseConfig(display, wanted.data(), &config, 1, &configs) == EGL_TRUE && configs > 0)
      context = egl.CreateContext(display, config, EGL_NO_CONTEXT, version.data());
    if (context != EGL_NO_CONTEXT && egl.MakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) == EGL_TRUE)
      return std::make_unique<Implementation>(egl, display, context);
    if (context != EGL_NO_CONTEXT) egl.DestroyContext(display, context);
    egl.Terminate(display);
    return nullptr;
  }

  GlFunctions functions;

 private:
  EglFunctions egl_;
  EGLDisplay display_;
  EGLContext context_;
};

Result<EglContext> EglContext::create() {
  const Result<EglFunctions> egl = load_egl();
  if (!egl) return egl.error();
  for (EGLDisplay display : displays(*egl)) {
    std::unique_ptr<Implementation> made = Implementation::on(*egl, display);
    if (made == nullptr) continue;
    Result<GlFunctions> functions = load_gl_functions(egl->GetProcAddress);
    if (!functions) return functions.error();
    made->functions = *functions;
    return EglContext(std::move(made));
  }
  return no_egl("EGL has no driver for OpenGL ES 3 without a window");
}

EglContext::EglContext(std::unique_ptr<Implementation> implementation) : implementation_(std::move(implementation)) {}
EglContext::EglContext(EglContext&& other) noexcept = default;
EglContext& EglContext::operator=(EglContext&& other) noexcept = default;
EglContext::~EglContext() = default;

const GlFunctions& EglContext::functions() const {
  return implementation_->functions;
}

}  // namespace bihive
