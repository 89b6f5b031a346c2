/// OpenGL 3.3 core contexts. Those that need no display are chosen by name; a window brings its own. Nothing links
/// libGL: each backend's library is opened when it is asked for, and glad takes its functions from there.
#pragma once

#include <render/gl/drawing_policy.h>

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope {

/// The contexts without a display.
enum class Backend {
    automatic,  ///< OSMesa, then EGL: Mesa removed OSMesa in 25.1
    osmesa,     ///< off-screen Mesa, libOSMesa.so.8 or .6
    egl,        ///< EGL on Mesa's surfaceless platform, libEGL.so.1
};

/// "auto", "osmesa" or "egl"; nothing for any other name.
std::optional<Backend> backend_from_name(std::string_view name);

/// Mesa's llvmpipe no longer optimises the shaders that it compiles, so that a process that draws one picture ends
/// sooner. Pixels are the same. Call it before the first context is opened; it does nothing where GALLIVM_PERF is set.
void compile_quickly();

/// A context and what it complained about. One thread at a time; a process may hold several, of different kinds. A kind
/// of context is a class that says how it is made current (`bind`) and where its functions are (`function`).
class GlContext {
  public:
    /// Opens a context without a display. Throws MachineError saying which libraries were tried and why each failed.
    static std::unique_ptr<GlContext> open(Backend backend);

    virtual ~GlContext();
    GlContext(const GlContext&) = delete;
    GlContext& operator=(const GlContext&) = delete;

    /// What messages call it: "osmesa", "egl", or "window" for a window's.
    virtual std::string_view name() const = 0;

    /// Makes this the calling thread's context and points glad's functions at it. False if that cannot be done.
    bool try_make_current() noexcept;
    /// The same; throws MachineError if it cannot be done.
    void make_current();

    // Of a context that was current once.
    /// What OpenGL calls what draws: "llvmpipe (LLVM 15.0.6, 256 bits)".
    const std::string& device() const { return device_; }
    /// Its version of OpenGL, with the driver's where that names it: "3.3 (Core Profile) Mesa 22.3.6".
    const std::string& version() const { return version_; }
    /// How pictures are made in it.
    const DrawingPolicy& policy() const { return policy_; }

    /// Throws MachineError if there was an error of OpenGL since the last call, with what is known of it. `doing` says
    /// what was under way.
    void check(std::string_view doing);

    /// What the driver says of an error; from any thread.
    void complain(std::string message);

    /// What the shader compiler says of shaders that it takes: no user can do anything about it, tests fail on it.
    void warn(std::string message) { warnings_.push_back(std::move(message)); }
    const std::vector<std::string>& warnings() const { return warnings_; }

    // What a kind of context is.
    using Function = void (*)();
    /// Makes this the calling thread's context; false if that cannot be done. It need not be OpenGL 3.3: that is
    /// checked.
    virtual bool bind() noexcept = 0;
    /// The address of an OpenGL function, or null. Called while the context is current.
    virtual Function function(const char* name) const noexcept = 0;

  protected:
    GlContext() = default;

  private:
    std::string device_, version_;
    DrawingPolicy policy_;
    std::mutex telling_;
    std::vector<std::string> complaints_;
    std::vector<std::string> warnings_;
};

}  // namespace mobbscope
