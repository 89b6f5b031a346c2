/// What this machine offers to draw with, without a display.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace mobbscope {

class Renderer;

struct BackendReport {
    std::string name;      ///< "osmesa" or "egl"
    bool works = false;    ///< can make pictures
    std::string version;   ///< OpenGL's, if it works
    std::string renderer;  ///< what OpenGL calls itself, if it works
    std::string why_not;   ///< else: the libraries that were tried, and what was wrong; a crash
};

/// In the order in which `auto` tries them. Each draws what `draw` asks of it, in a process of its own
/// (driver_watch.h): a driver may open and yet crash, or hang, over its first shaders.
std::vector<BackendReport> report_backends(const std::function<void(Renderer&)>& draw);

class SharedLibrary {
  public:
    /// Opens the first of `names` that there is. Throws std::runtime_error with the reason for each if there is none.
    explicit SharedLibrary(const std::vector<std::string>& names);
    ~SharedLibrary();
    SharedLibrary(const SharedLibrary&) = delete;
    SharedLibrary& operator=(const SharedLibrary&) = delete;

    /// The library's function of that name. Throws std::runtime_error if it has none.
    template <class Function>
    Function function(const char* name) const {
        return reinterpret_cast<Function>(symbol(name));
    }

  private:
    void* symbol(const char* name) const;

    void* handle_ = nullptr;
    std::string name_;
};

}  // namespace mobbscope
