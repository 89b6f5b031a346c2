/// OpenGL 3.3 core contexts that need no display, chosen by name. Nothing links libGL: each backend's library is opened
/// when it is asked for, and glad takes its functions from there.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope {

enum class Backend {
    automatic,  ///< OSMesa, then EGL: Mesa removed OSMesa in 25.1
    osmesa,     ///< off-screen Mesa, libOSMesa.so.8 or .6
    egl,        ///< EGL on Mesa's surfaceless platform, libEGL.so.1
};

/// "auto", "osmesa" or "egl"; nothing for any other name.
std::optional<Backend> backend_from_name(std::string_view name);

/// A context and what it complained about. One thread at a time; a process may hold several, of different backends.
class GlContext {
  public:
    /// Opens a context. Throws MachineError saying which libraries were tried and why each failed.
    static std::unique_ptr<GlContext> open(Backend backend);

    virtual ~GlContext() = default;
    GlContext(const GlContext&) = delete;
    GlContext& operator=(const GlContext&) = delete;

    /// The backend's name, "osmesa" or "egl".
    virtual std::string_view name() const = 0;

    /// Makes this the calling thread's context and points glad's functions at it.
    void make_current();

    /// Throws MachineError with all errors that OpenGL reported (KHR_debug) and all warnings of its shader compiler
    /// since the last call. `doing` says what was under way.
    void check(std::string_view doing);

    /// Notes a complaint for the next check.
    void complain(std::string message) { complaints_.push_back(std::move(message)); }

  protected:
    GlContext() = default;

    using Function = void (*)();
    virtual void bind() = 0;
    virtual Function function(const char* name) const = 0;

  private:
    std::vector<std::string> complaints_;
};

}  // namespace mobbscope
